#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# evaluate_icp.sh <build directory> <logs directory> <log>...: path errors of MRPT's icp-slam on real logs, as a table.
# For every log, the directory holds <log>.rawlog and <log>_gt.txt.gz with one true pose 't x y phi' for each scan.
# Compared are the ridge map (datasets/config/icp-slam/ridge-points.ini), the same settings on MRPT's points map, also by
# Levenberg-Marquardt, and on its grid of 5 cm, and the settings of the MRPT demo on both. REPETITIONS=5 perturbs the ridge map's
# runs: another decimation (whose offset changes from one iteration to the next), another eps, and starts 10 and 25 scans
# later, from other poses, the last with another first gate. RIDGES_ONLY=1 leaves the maps of MRPT out.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -ge 3 ] || die "usage: scripts/evaluate_icp.sh BUILD LOGS LOG..."
build=$(cd "$1" && pwd) logs=$(cd "$2" && pwd)
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
tuned=$root/datasets/config/icp-slam/ridge-points.ini
demo=/usr/share/mrpt/config_files/icp-slam/icp-slam_demo_classic.ini

# quiet <ini>: no scenes, no window, one place for the results.
quiet()
{
	sed -E 's/^logOutput_dir.*/logOutput_dir = OUT/; s/^SAVE_3D_SCENE.*/SAVE_3D_SCENE = 0/
		s/^LOG_FREQUENCY.*/LOG_FREQUENCY = 1000000/; s/^SHOW_PROGRESS_3D_REAL_TIME[ =].*/SHOW_PROGRESS_3D_REAL_TIME = 0/' "$1"
}

# as_points <ini>: the same settings for MRPT's points map.
as_points()
{
	sed -E 's/^ridgePoints_count.*/pointsMap_count = 1/; /^\[MappingApplication_ridgePoints/,$d' "$1"
	printf '\n[MappingApplication_pointsMap_00_insertOpts]\nminDistBetweenLaserPoints = 0.05\nfuseWithExisting = false\nisPlanarMap = 1\n'
}

# as_grid <ini>: the same settings for MRPT's grid, matched with itself.
as_grid()
{
	sed -E 's/^pointsMap_count.*/pointsMap_count = 0/; s/^occupancyGrid_count.*//; s/^matchAgainstTheGrid.*/matchAgainstTheGrid = 1/
		/^\[MappingApplication_pointsMap/,$d; s/^\[MappingApplication\].*/&\noccupancyGrid_count = 1/' "$1"
	printf '\n[MappingApplication_occupancyGrid_00_creationOpts]\nresolution = 0.05\n'
	printf '\n[MappingApplication_occupancyGrid_00_insertOpts]\nmaxOccupancyUpdateCertainty = 0.8\nmaxDistanceInsertion = 80\n'
}

# row <title> <ini> <log> [skip]: one run, one line of the table; the path starts that many scans later.
row()
{
	rm -rf "$scratch/run"
	mkdir "$scratch/run"
	local error seconds
	(cd "$scratch/run" && "$build/bin/ridgemap-run" icp-slam "$2" "$logs/$3.rawlog" </dev/null >log 2>&1) || true
	error=$("$build/bin/path-error" "$scratch/run/OUT/log_estimated_path.txt" "$logs/$3_gt.txt.gz" "${4:-0}" 2>&1) || error="failed: $error"
	seconds=$(grep -oE 'total time: [0-9.]+' "$scratch/run/log" | grep -oE '[0-9.]+$' || echo -)
	printf '| %s | %s | %s | %s |\n' "$3" "$1" \
		"$(sed -E 's/poses ([0-9]+)  rms ([0-9.]+) m  greatest ([0-9.]+) m  rms yaw ([0-9.]+) deg/\2 | \3 | \4/' <<<"$error")" "$seconds"
}

quiet "$tuned" >"$scratch/tuned.ini"
as_points "$scratch/tuned.ini" >"$scratch/points.ini"
sed 's/icpClassic/icpLevenbergMarquardt/' "$scratch/points.ini" >"$scratch/lm.ini"
quiet "$demo" >"$scratch/demo.ini"
as_grid "$scratch/points.ini" >"$scratch/grid.ini"
as_grid "$scratch/demo.ini" >"$scratch/grid-demo.ini"
# set_variant <number> <sed program>: a perturbed variant.
set_variant() { sed -E "$2" "$scratch/tuned.ini" >"$scratch/variant$1.ini"; }
set_variant 1 's/^corresponding_points_decimation.*/corresponding_points_decimation = 2/'
set_variant 2 's/^sigma .*/&\neps = 0.002/'
set_variant 3 's/^rawlog_offset.*/rawlog_offset = 21/'
set_variant 4 's/^rawlog_offset.*/rawlog_offset = 51/; s/^thresholdDist.*/thresholdDist = 1.1/'
titles=('decimation 2' 'eps 2 mm' 'starts 10 scans later' 'starts 25 scans later, first gate 1.1 m')
skips=(0 0 10 25)

printf '| log | map | rms [m] | greatest [m] | rms yaw [deg] | time [s] |\n|---|---|---|---|---|---|\n'
for log in "$@"; do
	row 'ridge map' "$scratch/tuned.ini" "$log"
	for ((i = 1; i < ${REPETITIONS:-1} && i <= 4; i++)); do
		row "ridge map, ${titles[i - 1]}" "$scratch/variant$i.ini" "$log" "${skips[i - 1]}"
	done
	[ -z "${RIDGES_ONLY:-}" ] || continue
	row 'points map, same settings' "$scratch/points.ini" "$log"
	row 'points map, Levenberg-Marquardt' "$scratch/lm.ini" "$log"
	row 'points map, MRPT demo' "$scratch/demo.ini" "$log"
	row 'grid, same settings' "$scratch/grid.ini" "$log"
	row 'grid, MRPT demo' "$scratch/grid-demo.ini" "$log"
done
