#!/usr/bin/env bash
# What each setting of free space makes of a door, of glass, of pickets and of a parked trolley: the table and the
# pictures of doc/dynamic.md.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/dynamic-scenes.sh [DIRECTORY]
  Simulates a room with a door that opens after two fifths of the time, one with a glass front, one with a row of pickets
  and one with a trolley that is moved after two fifths of the time, builds maps without free space and with several
  settings, draws them into DIRECTORY (default: doc/images/dynamic), walls black and what was left out red, and prints
  how much of each thing is in the walls (share of its surface with a wall within 5 cm). Needs gnuplot"
case ${1:-} in --help) printf '%s\n' "$usage" && exit ;; esac
out=$(realpath -m "${1:-$root/doc/images/dynamic}")
install_missing "${paper_packages[@]}"
build release ridgemap-simulate ridgemap-build ridgemap-eval >"$root/build-dynamic.log" || die "see build-dynamic.log"
rm -f "$root/build-dynamic.log"
mkdir -p "$out"
bin="$root/build/bin"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# A room of 8 m by 5 m, and the way of the robot: it takes 100 s.
room='wall 0 0 8 0
	wall 8 0 8 5
	wall 0 5 0 0
	path 1.5 1 6.5 1 6.5 4 1.5 4 1.5 1 6.5 1 6.5 4 1.5 4 1.5 1 6.5 1 6.5 4 1.5 4 4 3.7'
declare -A scenes
scenes[door]='wall 0 5 3.5 5
	wall 4.5 5 8 5
	wall 0 8 8 8
	during 0 40 wall 3.5 5 4.5 5
	during 40 1e6 wall 3.5 5 3.5 5.98'
scenes[glass]='wall 0 5 1 5
	wall 3.5 5 4.5 5
	wall 7 5 8 5
	wall 0 8 8 8
	glass 0.5 15 1 5 3.5 5
	glass 0.8 40 4.5 5 7 5'
scenes[pickets]='wall 0 5 8 5
	posts 0.02 0.12 2.5 2.5 5.5 2.5'
scenes[trolley]='wall 0 5 8 5
	during 0 40 wall 3 2.2 4 2.2
	during 0 40 wall 4 2.2 4 2.8
	during 0 40 wall 4 2.8 3 2.8
	during 0 40 wall 3 2.8 3 2.2
	during 40 1e6 wall 4.6 2.2 5.6 2.2
	during 40 1e6 wall 5.6 2.2 5.6 2.8
	during 40 1e6 wall 5.6 2.8 4.6 2.8
	during 40 1e6 wall 4.6 2.8 4.6 2.2'

# Things whose presence in the walls is told, as true surfaces.
thing()
{
	case $1 in
		door-closed) echo 3.5,5,4.5,5 ;;
		door-open) echo 3.5,5,3.5,5.98 ;;
		glass-15) echo 1,5,3.5,5 ;;
		glass-40) echo 4.5,5,7,5 ;;
		pickets) echo 2.5,2.5,5.5,2.5 ;;
		trolley-before) printf '%s\n' 3,2.2,4,2.2 4,2.2,4,2.8 4,2.8,3,2.8 3,2.8,3,2.2 ;;
		trolley-after) printf '%s\n' 4.6,2.2,5.6,2.2 5.6,2.2,5.6,2.8 5.6,2.8,4.6,2.8 4.6,2.8,4.6,2.2 ;;
	esac
}

settings=('--set freeSpace=off' '--set freeSpaceTau=0.3' '--set freeSpaceTau=0.4' '--set freeSpaceTau=0.5'
	'--set freeSpaceTau=0.5 --keep-last 40s')
titles=('no free space' 'tau 0.3' 'tau 0.4' 'tau 0.5' 'tau 0.5, last 40 s')

# lines <file of polylines>: in blocks for gnuplot.
lines() { awk -F, 'NR > 1 { if ($1 != last) print "\n"; last = $1; print $2, $3 }' "$1"; }

# share <map> <thing>: percent of the thing that is in the walls.
share()
{
	thing "$2" >"$scratch/thing.csv"
	"$bin/ridgemap-eval" "$1" --truth "$scratch/thing.csv" --within 0.05 | awk '$1 == "complete" { print $(NF - 1) }'
}

# scene <name> <height> <thing>...: builds all maps of a scene, prints its lines of the table and draws its picture.
scene()
{
	local name=$1 height=$2 i setting data="$scratch/$1"
	shift 2
	printf '%s\n' "$room" "${scenes[$name]}" >"$data.txt"
	"$bin/ridgemap-simulate" "$data.txt" -o "$data" --sensor lidar --field-of-view 360 --beams 721 --noise 0.01,0 \
		--spacing 0.08 --speed 0.4 >/dev/null
	for i in "${!settings[@]}"; do
		read -ra setting <<<"${settings[i]}"
		"$bin/ridgemap-build" "$data.simplemap.gz" -o "$data$i" -q --sigma 0.05 --formats ridgemap,walls,removed \
			"${setting[@]}"
		lines "$data${i}_walls.csv" >"$data$i.walls"
		lines "$data${i}_removed.csv" >"$data$i.removed"
	done
	for thing in "$@"; do
		row "$thing" "$(for i in "${!settings[@]}"; do share "$data$i.ridgemap" "$thing"; done)"
	done
	draw "$name" "$height"
}

row()
{
	local cells
	read -ra cells <<<"$(tr '\n' ' ' <<<"$2")"
	printf '%-16s' "$1"
	printf '%20s' "${cells[@]}"
	printf '\n'
}

# draw <scene> <height>: all maps of a scene side by side, up to this y [m].
draw()
{
	local data="$scratch/$1" i
	awk -F, 'NR % 60 == 2 { print $1, $2 }' "${data}_measurements.csv" >"$data.points"
	{
		cat <<-END
			set terminal pngcairo size 1500,$(awk -v h="$2" 'BEGIN { print int(33.5 * h + 55) }') font 'sans,9'
			set output '$out/$1.png'
			set size ratio -1
			set xrange [-0.2:8.2]
			set yrange [-0.2:$2]
			unset key
			unset tics
			set multiplot layout 1,${#settings[@]} margins 0.005,0.995,0.01,0.9 spacing 0.005
		END
		for i in "${!settings[@]}"; do
			printf "set title '%s'\n" "${titles[i]}"
			printf "plot '%s' with dots lc rgb '#6fa8dc'" "$data.points"
			[ ! -s "$data$i.removed" ] || printf ", '%s' with lines lw 2 lc rgb '#e02020'" "$data$i.removed"
			printf ", '%s' with lines lw 2 lc rgb '#000000'\n" "$data$i.walls"
		done
	} | gnuplot
}

row "in walls [%]" "$(printf '%s\n' off 0.3 0.4 0.5 0.5,last-40s)"
scene door 8.2 door-closed door-open
scene glass 8.2 glass-15 glass-40
scene pickets 5.2 pickets
scene trolley 5.2 trolley-before trolley-after
