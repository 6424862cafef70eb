#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# evaluate_rbpf.sh <build directory> [<runs>]: what MRPT's rbpf-slam makes of the run of Debian's mrpt-common, as a table:
# with each INI file of datasets/config/rbpf-slam for ridge maps alone, and with a map of MRPT in their place, all else
# alike. Errors are those of the path to that of icp-slam after rigid alignment; all figures are medians over the runs,
# the greatest error is that of all runs. Memory is the greatest of the program, less that of an empty run, by particle.
# The backquotes are of Markdown.
# shellcheck disable=SC2016
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -ge 1 ] || die "usage: scripts/evaluate_rbpf.sh BUILD [RUNS]"
build=$(cd "$1" && pwd) runs=${2:-3}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
config=$root/datasets/config/rbpf-slam
demo=/usr/share/mrpt/config_files/pf-localization/localization_demo.ini
[ -e "$demo" ] || die "the sample configurations of Debian's package mrpt-common are not installed"

# variant <name> <title> <INI> [<MRPT's map>]: what is compared; without the sections of the ridge map.
names=() titles=()
variant()
{
	names+=("$1")
	titles+=("$2")
	if [ -z "${4:-}" ]; then
		cp "$config/$3" "$scratch/$1.ini"
		return
	fi
	sed -E "s/^ridge[A-Za-z]*_count.*/${4}_count = 1/; /^\[MappingApplication_ridge/,\$d" "$config/$3" >"$scratch/$1.ini"
	if [ "$4" = occupancyGrid ]; then
		awk '/^\[/ { keep = /^\[MetricMap_occupancyGrid_00/ } keep' "$demo" |
			sed 's/MetricMap_/MappingApplication_/' >>"$scratch/$1.ini"
	else
		printf '[MappingApplication_pointsMap_00_insertOpts]\nminDistBetweenLaserPoints = 0.05\n' >>"$scratch/$1.ini"
	fi
}
variant points '`ridgePoints`' ridge-points.ini
variant stock_points 'points map of MRPT, 5 cm' ridge-points.ini pointsMap
variant map '`ridgeMap`' ridge-map.ini
variant stock_grid 'grid of MRPT, 6 cm' ridge-map.ini occupancyGrid
variant auxiliary '`ridgeMap`' ridge-map-auxiliary.ini
variant stock_auxiliary 'grid of MRPT, 6 cm' ridge-map-auxiliary.ini occupancyGrid
# One scan and no particle that moves: what the program itself takes.
sed -E 's/^sampleSize.*/sampleSize = 1/; s/^(insertion|localize)(Lin|Ang)(.*)=.*/\1\2\3 = 1e6/' "$config/ridge-map.ini" >"$scratch/empty.ini"

# measured <name>: runs rbpf-slam in its folder; 'user-seconds KB' is then in the file cpu.
measured()
{
	rm -rf "${scratch:?}/run"
	mkdir "$scratch/run"
	cd "$scratch/run"
	/usr/bin/time -f '%U %M' -o cpu "$build/bin/ridgemap-run" rbpf-slam "$scratch/$1.ini" </dev/null >log 2>&1 || true
}

path() { awk '{ print $1, $2, $3, $'"$2"' }' "$1"; }

(cd "$scratch" && "$build/bin/ridgemap-run" icp-slam "$root/datasets/config/icp-slam/ridge-points.ini" </dev/null >log 2>&1)
path "$scratch/LOG_ICP-SLAM/log_estimated_path.txt" 4 >"$scratch/reference"
measured empty
read -r _ empty <cpu

for ((i = 0; i < runs; i++)); do
	for name in "${names[@]}"; do
		measured "$name"
		path LOG_RBPF-SLAM/log_estimated_path.txt 5 >estimate
		"$build/bin/path-error" estimate "$scratch/reference" | awk -v n="$(wc -l <estimate)" -v e="$empty" \
			-v p="$(sed -nE 's/^sampleSize *= *([0-9]+).*/\1/p' "$scratch/$name.ini")" '
			NR == FNR { ms = 1e3 * $1 / n; mb = ($2 - e) / 1024 / p; next }
			{ for (k = 1; k < NF; k++) if ($k == "rms" && !rms) rms = $(k + 1); else if ($k == "greatest") most = $(k + 1)
			  print ms, mb, rms, most, p }' cpu - >>"$scratch/$name.results"
	done
done

median() { sort -n -k"$1,$1" "$2" | awk -v c="$1" '{ v[NR] = $c } END { print v[int((NR + 1) / 2)] }'; }
printf '| map | `PF_algorithm` | particles | CPU time by step [ms] | memory by particle [MB] | rms [m] | greatest [m] |\n'
printf '|---|---|---|---|---|---|---|\n'
for k in "${!names[@]}"; do
	file=$scratch/${names[k]}.results
	printf '| %s | %s | %d | %.0f | %.0f | %.2f | %.2f |\n' "${titles[k]}" \
		"$(sed -nE 's/^PF_algorithm *= *([0-9]).*/\1/p' "$scratch/${names[k]}.ini")" "$(median 5 "$file")" "$(median 1 "$file")" \
		"$(median 2 "$file")" "$(median 3 "$file")" "$(sort -n -k4,4 "$file" | tail -n 1 | cut -d ' ' -f 4)"
done
