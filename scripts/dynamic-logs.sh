#!/usr/bin/env bash
# What free space takes out of the walls of recorded logs: the table of doc/dynamic.md, and pictures to look at.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/dynamic-logs.sh DIRECTORY SIGMA LOG.simplemap.gz...
  Builds a map of each log without free space and one with it, draws both into DIRECTORY (LOG_before.png and LOG_after.png,
  what was left out in red) and prints a line: walls before and after, what was left out, how much of that has a wall
  within 0.25 m that stays, how much of the walls before has none after [m], and the share of the walls before and after
  within 0.1 m of an occupied cell of MRPT's grid of 5 cm"
case ${1:-} in --help) printf '%s\n' "$usage" && exit ;; esac
[ $# -ge 3 ] || die "$usage"
out=$(realpath -m "$1")
sigma=$2
shift 2
build release ridgemap-build free-space-judge >"$root/build-dynamic.log" || die "see build-dynamic.log"
rm -f "$root/build-dynamic.log"
mkdir -p "$out"
bin="$root/build/bin"

printf '%-16s %8s %8s %8s %8s %8s %9s %9s\n' "" before after removed beside gone "before %" "after %"
for log in "$@"; do
	name=$(basename "$log" .simplemap.gz)
	"$bin/ridgemap-build" "$log" -o "$out/${name}_before" -q --sigma "$sigma" --set freeSpace=off --formats walls,png
	"$bin/ridgemap-build" "$log" -o "$out/${name}_after" -q --sigma "$sigma" --formats walls,removed,png --show-removed
	read -ra figures < <("$bin/free-space-judge" change "$log" "$out/${name}_before_walls.csv" \
		"$out/${name}_after_walls.csv" "$out/${name}_after_removed.csv")
	printf '%-16s %8s %8s %8s %8s %8s %9s %9s\n' "$name" "${figures[@]}"
done
