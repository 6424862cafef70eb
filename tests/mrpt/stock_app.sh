#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Loads the plug-in into MRPT's own program observations2map, which has never heard of ridge maps.
# Usage: stock_app.sh <libridgemap-mrpt.so>. Exits 77 (skipped) where MRPT's programs or samples are not installed.
set -euo pipefail
library=$1

command -v observations2map >/dev/null || { echo "observations2map is not installed"; exit 77; }
sample=$(find /usr/share/mrpt* -name localization_demo.simplemap.gz 2>/dev/null | head -n 1)
[ -n "$sample" ] || { echo "MRPT's sample data are not installed"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/map.ini" <<'INI'
[MappingApplication]
ridgeMap_count = 1

[MappingApplication_ridgeMap_00_creationOpts]
sigma = 0.08   // metres

[MappingApplication_ridgeMap_00_insertOpts]
maxRange = 30
INI

run() # run <prefix> [<variable>=<value>]: the program waits for a key on errors, and returns 0 without the plug-in
{
	local prefix=$1
	shift
	env "$@" observations2map "$folder/map.ini" "$sample" "$folder/$prefix" </dev/null >"$folder/$prefix.log" 2>&1
}

fail()
{
	echo "$1"
	tail -n 30 "$folder"/*.log
	ls -l "$folder"
	exit 1
}

run without X=1 || true
[ -z "$(find "$folder" -name '*_walls.csv')" ] || fail "walls without the plug-in: the test is worthless"

run with LD_PRELOAD="$library${LD_PRELOAD:+:$LD_PRELOAD}" || fail "observations2map failed with the plug-in (exit code $?)"
for ending in _ridges.csv _walls.csv .svg .3Dscene; do
	[ "$(find "$folder" -name "with*CRidgeMap2D*$ending" -size +1k | wc -l)" -eq 1 ] || fail "no single file *$ending"
done
walls=$(find "$folder" -name 'with*_walls.csv')
[ "$(head -n 1 "$walls")" = polyline,x,y ] || fail "the header of $walls is wrong"
nodes=$(($(wc -l <"$walls") - 1))
[ "$nodes" -ge 200 ] || fail "only $nodes nodes of walls"
echo "observations2map made $nodes nodes of walls from $sample"
