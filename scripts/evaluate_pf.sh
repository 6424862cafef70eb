#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# evaluate_pf.sh <build directory> [<runs> [<sed program>...]]: how often MRPT's pf-localization finds the robot of
# Debian's localization_demo, as a table. Every run draws other particles anywhere in a box (init_PDF_mode = 1).
# Compared are datasets/config/pf-localization/ridge-map.ini and, with the same particles, the grid of MRPT's demo with
# its likelihood (and powFactor = 1, as there); each sed program changes that INI file and makes one more row, of the
# grid if it begins with "grid:". The maps take turns, so that a busy machine is fair to all; times are medians.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -ge 1 ] || die "usage: scripts/evaluate_pf.sh BUILD [RUNS [SED-PROGRAM...]]"
build=$(cd "$1" && pwd) runs=${2:-100}
shift $(($# < 2 ? $# : 2))
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
ridges=$root/datasets/config/pf-localization/ridge-map.ini
demo=/usr/share/mrpt/config_files/pf-localization/localization_demo.ini
[ -e "$demo" ] || die "the sample configurations of Debian's package mrpt-common are not installed"

titles=('ridge map' 'grid 6 cm, MRPT demo')
cp "$ridges" "$scratch/0.ini"
{
	sed -E 's/^ridgeMap_count.*/occupancyGrid_count = 1/; /^powFactor/d; /^\[MetricMap_ridgeMap/,$d' "$ridges"
	awk '/^\[/ { keep = /^\[MetricMap_occupancyGrid_00/ } keep' "$demo"
} >"$scratch/1.ini"
launchers=("$build/bin/ridgemap-run" env)
for program in "$@"; do
	if [[ $program == grid:* ]]; then kind=1; else kind=0; fi
	sed -E "${program#grid:}" "$scratch/$kind.ini" >"$scratch/${#titles[@]}.ini"
	launchers+=("${launchers[kind]}")
	titles+=("${titles[kind]}, \`${program#grid:}\`")
done

# run <number>: one run; appends 'x y sqrt(tr cov) seconds CPU-seconds' to the ends of that map.
run()
{
	local TIMEFORMAT='%U %S'
	rm -rf "$scratch/run"
	mkdir "$scratch/run"
	cd "$scratch/run"
	{ time "${launchers[$1]}" pf-localization "$scratch/$1.ini" </dev/null >log 2>&1 || true; } 2>cpu
	{
		sed -nE 's/.*PDF estimation: \(([-0-9.]+),([-0-9.]+),.*tr\(cov\): ([0-9.e-]+).*/\1 \2 \3/p' log | tail -n 1 | tr '\n' ' '
		# The first steps, with all particles, take most of the time.
		cat LOG_LOCALIZATION*/exec_times.txt | awk '{ s += $1 } END { printf "%g ", s / NR }'
		awk '{ print $1 + $2 }' cpu
	} >>"$scratch/$1.ends"
}

for ((i = 0; i < runs; i++)); do
	for number in "${!titles[@]}"; do run "$number"; done
done

# The 95 % region is taken as a circle: the covariance that the program prints is a sum of variances.
printf '| map | runs | near the robot | within 0.05 m | mean of those near | tr(cov) | truth in the 95 %% region | step [ms] | CPU of a run [s] |\n'
printf '|---|---|---|---|---|---|---|---|---|\n'
for number in "${!titles[@]}"; do
	awk -v title="${titles[number]}" '
		function median(a, i, k, h) {
			for (i = 2; i <= NR; i++)
				for (k = i; k > 1 && a[k] < a[k - 1]; k--) { h = a[k]; a[k] = a[k - 1]; a[k - 1] = h }
			return a[int((NR + 1) / 2)]
		}
		{
			d = sqrt(($1 - 15.89) ^ 2 + ($2 + 10) ^ 2)
			steps[NR] = $4; runs[NR] = $5
			if (d >= 0.5) next
			near++; x += $1; y += $2; t += $3
			good += d <= 0.05
			inside += d <= 2.448 * $3 / sqrt(2)
		}
		END {
			printf "| %s | %d | %d | %d | (%.3f, %.3f) | %.3f | %d %% | %.1f | %.2f |\n", title, NR, near, good, x / near,
				y / near, t / near, 100 * inside / near + 0.5, 1e3 * median(steps), median(runs)
		}' "$scratch/$number.ends"
done
