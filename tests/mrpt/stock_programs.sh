#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs one of MRPT's programs with one of the INI files of datasets/config and checks what it made.
# Usage: stock_programs.sh <program> <ini> <ridgemap-run>
# Exits 77 (skipped) where the program or the data of Debian's mrpt-common are not installed.
set -euo pipefail
program=$1 ini=$2 launcher=$(realpath "$3")
config=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../datasets/config" && pwd)
data=/usr/share/mrpt/datasets

command -v "$program" >/dev/null || { echo "$program is not installed"; exit 77; }
[ -e "$data/localization_demo.simplemap.gz" ] || { echo "MRPT's sample data are not installed"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail()
{
	echo "$1"
	tail -n 40 log
	find . -type f | head -n 60
	exit 1
}

# run <argument>...: the programs wait for a key on errors.
run() { "$launcher" "$program" "$@" </dev/null >log 2>&1 || fail "$program ended with code $?"; }

# has <pattern> <bytes>: one file of that name, at least that long.
has()
{
	local found
	found=$(find . -path "./$1" -size "+$2c")
	[ "$(wc -w <<<"$found")" -eq 1 ] || fail "no single file $1 of more than $2 bytes"
}

# within <number> <lowest> <highest>
within() { awk -v v="$1" -v a="$2" -v b="$3" 'BEGIN { exit !(v + 0 == v && v >= a && v <= b) }'; }

# metres <walls.csv>: length of all polylines.
metres()
{
	awk -F, 'NR > 1 { if ($1 == last) sum += sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2); last = $1; x = $2; y = $3 } END { print sum }' "$1"
}

# last_pose <path> <column of x> <column of y>: near the end of the one-loop run, as all maps agree on it.
last_pose()
{
	local x y
	read -r x y < <(tail -n 1 "$1" | awk -v i="$2" -v k="$3" '{ print $i, $k }')
	if ! within "$x" "$4" "$5" || ! within "$y" "$6" "$7"; then fail "the path ends at ($x, $y)"; fi
	echo "the path ends at ($x, $y)"
}

walls_between()
{
	local length
	length=$(metres "$(find . -path "./$1")")
	within "$length" "$2" "$3" || fail "$length m of walls"
	echo "$length m of walls"
}

beside_grid() { case $ini in *beside-grid*) has "$1" 1000 ;; esac; }

case $program in
icp-slam)
	run "$config/icp-slam/$ini"
	has 'LOG_ICP-SLAM/*CRidgePointsMap*_walls.csv' 1000
	has 'LOG_ICP-SLAM/*CRidgePointsMap*.svg' 1000
	has 'LOG_ICP-SLAM/_finalmap_.simplemap' 10000
	beside_grid 'LOG_ICP-SLAM/*COccupancyGridMap2D*.png'
	[ "$(wc -l <LOG_ICP-SLAM/log_estimated_path.txt)" -eq 224 ] || fail "the path is not that of 224 scans"
	last_pose LOG_ICP-SLAM/log_estimated_path.txt 2 3 4.0 4.5 -18.8 -18.2
	walls_between 'LOG_ICP-SLAM/*_walls.csv' 100 400
	;;
rbpf-slam)
	# Fewer particles than the file asks for: a test is no experiment.
	sed 's/^sampleSize .*/sampleSize = 2/' "$config/rbpf-slam/$ini" >few.ini
	run few.ini
	has 'LOG_RBPF-SLAM/finalMap_*_walls.csv' 1000
	beside_grid 'LOG_RBPF-SLAM/finalMap*COccupancyGridMap2D*.png'
	[ "$(wc -l <LOG_RBPF-SLAM/log_estimated_path.txt)" -eq 224 ] || fail "the path is not that of 224 scans"
	case $ini in
	ridge-points.ini) last_pose LOG_RBPF-SLAM/log_estimated_path.txt 2 3 3.6 4.8 -19.1 -18 ;;
	ridge-map-auxiliary.ini) last_pose LOG_RBPF-SLAM/log_estimated_path.txt 2 3 3.2 5.2 -19.6 -17.6 ;;
	# Two particles that move by odometry are as good as odometry: only the map is looked at.
	*) walls_between 'LOG_RBPF-SLAM/finalMap_*_walls.csv' 50 600 ;;
	esac
	;;
pf-localization)
	# A room looks like that of the robot, and a single run of a particle filter may end there: one in a few must not.
	x=0 y=0 spread=0
	for attempt in 1 2 3 4 5; do
		rm -rf LOG_LOCALIZATION*
		run "$config/pf-localization/$ini"
		[ "$(grep -c 'PDF estimation' log)" -gt 20 ] || fail "too few steps"
		estimate=$(grep 'PDF estimation' log | tail -n 1 | sed -E 's/.*estimation: \(([-0-9.]+),([-0-9.]+),.*tr\(cov\): ([-0-9.e]+).*/\1 \2 \3/')
		read -r x y spread <<<"$estimate"
		if within "$x" 15.74 16.04 && within "$y" -10.15 -9.85; then break; fi
		[ "$attempt" -lt 5 ] || fail "the robot is believed to be at ($x, $y)"
	done
	has '*/map_*CRidgeMap2D*_walls.csv' 1000
	beside_grid '*/map*COccupancyGridMap2D*.png'
	within "$spread" 0.01 0.2 || fail "tr(cov) is $spread"
	echo "the robot is at ($x, $y), tr(cov) $spread, attempt $attempt"
	;;
observations2map)
	run "$config/observations2map/$ini" "$data/localization_demo.simplemap.gz" out
	has 'out*CRidgeMap2D*_walls.csv' 1000
	beside_grid 'out*COccupancyGridMap2D*.png'
	walls_between 'out*_walls.csv' 100 500
	;;
*)
	fail "nothing is known about $program"
	;;
esac
