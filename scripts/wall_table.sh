#!/usr/bin/env bash
# How well walls come out, by seed, sensor, noise and number of scans: the table of doc/walls.md.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/wall_table.sh [DIRECTORY]
       scripts/wall_table.sh --logs INPUT...
  The second form builds maps of recorded runs and prints how many ridges and walls they have and how long these are.
  The first one simulates rooms with doors, a partition of 0.1 m, a panel without thickness, a recess and two pillars, with exact
  poses, builds maps and prints the RMSD of ridges and walls, of walls farther than 0.25 m from corners and near them,
  the share of the seen surface with a wall within 3 cm, and how many lines and vertices the walls have. Files go to
  DIRECTORY (default: wall-output); RIDGEMAP_PROGRAMS names programs that are there already"
case ${1:-} in --help) printf '%s\n' "$usage" && exit ;; esac
bin=${RIDGEMAP_PROGRAMS:-}
if [ -z "$bin" ]; then
	build release ridgemap-simulate ridgemap-build ridgemap-eval >"$root/build-walls.log" || die "see build-walls.log"
	rm -f "$root/build-walls.log"
	bin="$root/build/bin"
fi

# lengths <file>: number of polylines, sum and median of their lengths, vertices.
lengths()
{
	awk -F, 'BEGIN { last = -1 } NR > 1 { if ($1 != last) { if (NR > 2) print sum, n; sum = n = 0; last = $1 } else sum += sqrt(($2 - x)^2 + ($3 - y)^2)
		x = $2; y = $3; n++ } END { print sum, n }' "$1" | sort -g |
		awk '{ length_[NR] = $1; sum += $1; n += $2 } END { printf "%9d %9.1f %9.2f %9d", NR, sum, length_[int(NR / 2) + 1], n }'
}

if [ "${1:-}" = --logs ]; then
	shift
	scratch=$(mktemp -d)
	trap 'rm -rf "$scratch"' EXIT
	printf '%-28s %-7s %9s %9s %9s %9s\n' input lines number "sum m" "median m" vertices
	for input in "$@"; do
		"$bin/ridgemap-build" "$input" -o "$scratch/map" -q --formats ridges,walls
		for lines in ridges walls; do
			printf '%-28s %-7s %s\n' "$(basename "$input")" "$lines" "$(lengths "$scratch/map_$lines.csv")"
		done
	done
	exit
fi

out=$(realpath -m "${1:-$root/wall-output}")
mkdir -p "$out"

cat >"$out/rooms.txt" <<-END
	wall 0 0 3 0
	wall 3.9 0 9 0
	wall 9.9 0 16 0
	wall 16 0 16 7
	wall 16 7 10 7
	wall 10 7 10 7.2
	wall 10 7.2 8.5 7.2
	wall 8.5 7.2 8.5 7
	wall 8.5 7 0 7
	wall 0 7 0 0
	wall 1 0 1 -3
	wall 1 -3 12 -3
	wall 12 -3 12 0
	wall 5 7 5 5.2
	wall 13 2 13 5
	wall 13 5 13.1 5
	wall 13.1 5 13.1 2
	wall 13.1 2 13 2
	arc 4 2 0.3 0 360
	arc 10.5 3 0.1 0 360
	path 1 1 3 3.4 6 3 12 1.2 14.5 2.5 14.5 5.5 12 6 6.5 5.5 3 4 2 6 1 3 3.4 1.2 3.4 -1.5 9.4 -1.5 9.4 1.5
END

# figure <row> <column>: of a table of ridgemap-eval on stdin; "straight" and "corners" are below RMSD.
figure() { awk -v row="$1" -v column="$2" '$1 == "RMSD" { part = 1 } $1 == "maximum" { part = 0 }
	$1 == row { print $column; exit } row == "straight" && part && $1 == "elsewhere" { print $3; exit }
	row == "corners" && part && $1 == "near" { print $4; exit }'; }

# row <what> <sigma> <settings of the map, or -> <options of the simulator>
row()
{
	local what=$1 sigma=$2 setting=$3 data settings=() result
	shift 3
	[ "$setting" = - ] || settings=(--set "$setting")
	data="$out/${what//[^a-z0-9]/_}"
	"$bin/ridgemap-simulate" "$out/rooms.txt" -o "$data" --sensor lidar "$@" >/dev/null
	"$bin/ridgemap-build" "$data.simplemap.gz" -o "$data" -q --sigma "$sigma" "${settings[@]}" --formats ridgemap,walls,png
	result=$("$bin/ridgemap-eval" "$data.ridgemap" --truth "${data}_truth.csv" --within 0.03 --corner-radius 0.25)
	printf '%-28s %6s %7s %7s %9s %8s %11s %6s %9s\n' "$what" "$sigma" "$(figure RMSD 2 <<<"$result")" \
		"$(figure RMSD 3 <<<"$result")" "$(figure straight 3 <<<"$result")" "$(figure corners 3 <<<"$result")" \
		"$(figure complete 3 <<<"$result")" "$(figure polylines 3 <<<"$result")" "$(tail -n +2 "${data}_walls.csv" | wc -l)"
}

printf '%-28s %6s %7s %7s %9s %8s %11s %6s %9s\n' scene sigma ridges walls straight corners "complete %" lines vertices
half=(--field-of-view 180 --spacing 0.1)
for seed in 1 2 3; do row "seed $seed" 0.04 - "${half[@]}" --seed "$seed"; done
row "without sides" 0.04 sides=off "${half[@]}"
row "all around" 0.04 - --field-of-view 360 --beams 721 --spacing 0.1
row "twice the noise" 0.04 - "${half[@]}" --noise 0.04,0
row "twice the noise, wider" 0.08 - "${half[@]}" --noise 0.04,0
row "a tenth of the scans" 0.04 - --field-of-view 180 --spacing 1
row "a tenth of the scans, wider" 0.06 - --field-of-view 180 --spacing 1
