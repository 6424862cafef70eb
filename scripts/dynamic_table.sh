#!/usr/bin/env bash
# What is left of walking people and mixed pixels in a map, by the option freeSpaceTau: the tables of doc/dynamic.md.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/dynamic_table.sh [DIRECTORY]
  Simulates rooms with 5 and 20 walking people and 1 % mixed pixels, with exact poses and with 2 cm and 0.25 degrees of
  noise, builds maps without and with free space, and prints ghosts (metres of wall farther than 0.1 m from any static
  surface), completeness (share of the surface with a wall within 3 cm) and RMSD, of all walls and of those that are no
  ghosts. In a line for MRPT's grid of 5 cm, ghosts are occupied cells times 5 cm, inside the house and in all. Files go
  to DIRECTORY (default: dynamic-output)"
case ${1:-} in --help) printf '%s\n' "$usage" && exit ;; esac
out=$(realpath -m "${1:-$root/dynamic-output}")
build release ridgemap-simulate ridgemap-build ridgemap-eval free-space-judge >"$root/build-dynamic.log" || die "see build-dynamic.log"
rm -f "$root/build-dynamic.log"
mkdir -p "$out"
bin="$root/build/bin"

# scene <people>: two rooms and a corridor with pillars, 20 m x 12 m; people walk to and fro.
scene()
{
	cat <<-END
		wall 0 0 20 0
		wall 20 0 20 12
		wall 20 12 0 12
		wall 0 12 0 0
		wall 8 0 8 4
		wall 8 5.2 8 12
		wall 8 7 13 7
		wall 14.2 7 20 7
		arc 4 6 0.3 0 360
		arc 16 3 0.1 0 360
		path 2 2 6 2 6 10 2 10 2 3 7 4.6 10 4.6 18 2 18 5.5 13.6 5.5 13.6 9 18 10 10 10 13.6 9 13.6 5 10 2
	END
	awk -v people="$1" 'BEGIN { srand(7); for (i = 0; i < people; i++) {
		left = rand() < 0.4
		x0 = left ? 1 : 9; x1 = left ? 7 : 19; low = left ? 1 : (i % 2 ? 1 : 8); high = left ? 11 : (i % 2 ? 6 : 11)
		printf "mover 0.2 %.2f %.2f %.2f %.2f %.2f\n", 0.3 + rand(), x0 + rand() * (x1 - x0), low + rand() * (high - low),
			x0 + rand() * (x1 - x0), low + rand() * (high - low) } }'
}

# figure <name>: that of the walls in a table of ridgemap-eval on stdin.
figure() { awk -v name="$1" '$1 == name { print $(NF - 1); exit }'; }

line='%-8s %-10s %-6s %14s %12s %10s %12s\n'
# shellcheck disable=SC2059
row() { printf "$line" "$@"; }

row people poses tau "ghosts m" "complete %" "RMSD mm" "no ghosts mm"
for people in 5 20; do
	scene "$people" >"$out/people$people.txt"
	for noise in 0,0 0.02,0.25; do
		sigma=0.05
		[ "$noise" = 0,0 ] || sigma=0.08
		data="$out/people${people}_${noise/,/_}"
		"$bin/ridgemap-simulate" "$out/people$people.txt" -o "$data" --sensor lidar --field-of-view 360 --beams 721 \
			--outliers 0.01 --spacing 0.1 --speed 0.5 --pose-noise "$noise" >/dev/null
		for tau in off 0.3 0.4 0.5; do
			setting=(--set freeSpace=off)
			[ "$tau" = off ] || setting=(--set "freeSpaceTau=$tau")
			"$bin/ridgemap-build" "$data.simplemap.gz" -o "$data.tau$tau" -q --sigma "$sigma" "${setting[@]}" \
				--formats ridgemap,png --show-removed
			ghosts=$("$bin/ridgemap-eval" "$data.tau$tau.ridgemap" --truth "${data}_truth.csv" --within 0.1)
			near=$("$bin/ridgemap-eval" "$data.tau$tau.ridgemap" --truth "${data}_truth.csv" --within 0.03)
			row "$people" "$noise" "$tau" "$(figure spurious <<<"$ghosts")" "$(figure complete <<<"$near")" \
				"$(figure RMSD <<<"$ghosts")" "$(figure within <<<"$ghosts")"
		done
		row "$people" "$noise" grid "$("$bin/free-space-judge" ghosts "$data.simplemap.gz" "${data}_truth.csv")" - - -
	done
done
