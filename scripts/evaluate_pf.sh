#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# evaluate_pf.sh <build directory> [<runs> [<sed program>...]]: how often MRPT's pf-localization finds the robot of
# Debian's localization_demo, as a table. Every run draws other particles anywhere in a box (init_PDF_mode = 1).
# Compared are datasets/config/pf-localization/ridge-map.ini and the grid of MRPT's demo with its likelihood; each sed
# program changes that INI file and makes one more row. The maps take turns, so that a busy machine is fair to all.
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
	sed -E 's/^ridgeMap_count.*/occupancyGrid_count = 1/; /^\[MetricMap_ridgeMap/,$d' "$ridges"
	awk '/^\[/ { keep = /^\[MetricMap_occupancyGrid_00/ } keep' "$demo"
} >"$scratch/1.ini"
for program in "$@"; do
	sed -E "$program" "$ridges" >"$scratch/${#titles[@]}.ini"
	titles+=("ridge map, \`$program\`")
done

# run <number>: one run; appends 'x y sqrt(tr cov) seconds' to the ends of that map.
run()
{
	rm -rf "$scratch/run"
	mkdir "$scratch/run"
	(cd "$scratch/run" && "$build/bin/ridgemap-run" pf-localization "$scratch/$1.ini" </dev/null >log 2>&1) || true
	sed -nE 's/.*PDF estimation: \(([-0-9.]+),([-0-9.]+),.*tr\(cov\): ([0-9.e-]+).*/\1 \2 \3/p' "$scratch/run/log" |
		tail -n 1 | tr '\n' ' ' >>"$scratch/$1.ends"
	# The first steps, with all particles, take most of the time.
	cat "$scratch"/run/LOG_LOCALIZATION*/exec_times.txt | awk '{ s += $1 } END { print s / NR }' >>"$scratch/$1.ends"
}

for ((i = 0; i < runs; i++)); do
	for number in "${!titles[@]}"; do run "$number"; done
done

# The 95 % region is taken as a circle: the covariance that the program prints is a sum of variances.
printf '| map | runs | near the robot | within 0.05 m | mean of those near | tr(cov) | truth in the 95 %% region | step [ms] |\n'
printf '|---|---|---|---|---|---|---|---|\n'
for number in "${!titles[@]}"; do
	awk -v title="${titles[number]}" '
		{
			d = sqrt(($1 - 15.89) ^ 2 + ($2 + 10) ^ 2)
			times[NR] = $4
			if (d >= 0.5) next
			near++; x += $1; y += $2; t += $3
			good += d <= 0.05
			inside += d <= 2.448 * $3 / sqrt(2)
		}
		END {
			for (i = 2; i <= NR; i++)
				for (k = i; k > 1 && times[k] < times[k - 1]; k--) { h = times[k]; times[k] = times[k - 1]; times[k - 1] = h }
			printf "| %s | %d | %d | %d | (%.3f, %.3f) | %.3f | %d %% | %.1f |\n", title, NR, near, good, x / near,
				y / near, t / near, 100 * inside / near + 0.5, 1e3 * times[int((NR + 1) / 2)]
		}' "$scratch/$number.ends"
done
