#!/usr/bin/env bash
# wall-pictures.sh [<directory>]: draws what each pass does to a wall, before and after, for doc/walls.md. Needs the
# programs (scripts/test.sh builds them) and gnuplot.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
out=$(realpath -m "${1:-$root/doc/images/walls}")
programs=${RIDGEMAP_PROGRAMS:-$root/build/bin}
install_missing "${paper_packages[@]}"
mkdir -p "$out"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

passes=(prune sharpen attach trim straighten correctBends)

# settings <last pass that is on, or none>: of the passes in their order.
settings()
{
	local last=$1 on=true pass
	[ "$last" != none ] || on=false
	for pass in "${passes[@]}"; do
		printf -- '--set %s=%s ' "$pass" "$on"
		[ "$pass" != "$last" ] || on=false
	done
}

# walls <name> <settings>: the walls of the scene, in blocks for gnuplot.
walls()
{
	local name=$1 settings
	read -ra settings <<<"$2"
	"$programs/ridgemap-build" "$scratch/$name.simplemap.gz" -o "$scratch/map" --sigma 0.05 --formats walls -q "${settings[@]}"
	awk -F, 'NR > 1 { if ($1 != last) print "\n"; last = $1; print $2, $3 }' "$scratch/map_walls.csv"
}

# picture <pass> <pass before it> <x range> <y range> <options of the simulator>; the scene is read from the input.
picture() { compare "$1" "$(settings "$2")" "$(settings "$1")" "${@:3}"; }

# compare <pass> <settings before> <settings after> <x range> <y range> <options of the simulator>
compare()
{
	local pass=$1 before=$2 after=$3 x=$4 y=$5
	shift 5
	cat >"$scratch/$pass.scene"
	"$programs/ridgemap-simulate" "$scratch/$pass.scene" -o "$scratch/$pass" --sensor lidar --field-of-view 360 \
		--spacing 0.1 "$@" >/dev/null
	walls "$pass" "$before" >"$scratch/before"
	walls "$pass" "$after" >"$scratch/after"
	awk -F, '/^[-0-9]/ { print $1, $2; print $3, $4; print "\n" }' "$scratch/${pass}_truth.csv" >"$scratch/truth"
	gnuplot <<-END
		set terminal pngcairo size 900,330 font 'sans,10'
		set output '$out/$pass.png'
		set datafile separator whitespace
		set xrange [$x]
		set yrange [$y]
		set grid lc rgb '#eeeeee'
		unset key
		set multiplot layout 1,2
		do for [part in 'before after'] {
			set title part.' the pass $pass [m]'
			plot '< tr , " " <$scratch/${pass}_measurements.csv' using 1:2 with dots lc rgb '#9fc5f8', \
				'$scratch/truth' with lines lw 4 lc rgb '#f6b26b', \
				'$scratch/'.part with linespoints pt 7 ps 0.4 lw 1.5 lc rgb '#000000'
		}
	END
	say "$out/$pass.png"
}

compare sides '--set sides=off' '--set sides=on' -0.15:0.75 -0.12:0.2 <<-END
	wall 0 0 2 0
	wall 2 0 2 0.08
	wall 2 0.08 0 0.08
	wall 0 0.08 0 0
	path 0.3 -0.7 1.7 -0.7 2.7 0 1.7 0.8 0.3 0.8 -0.7 0 0.3 -0.7
END
compare mergeDistance '--set mergeDistance=0' '--set mergeDistance=0.7' 0.4:2.1 -0.12:0.12 --pose-noise 0.01,0 <<-END
	wall 0 0 2 0
	path 0.3 -0.7 1.7 -0.7 2.7 0 1.7 0.7 0.3 0.7
END
picture prune none -0.1:1.6 -0.3:0.6 --outliers 0.15 <<-END
	wall 0 0 1.5 0
	path 0.2 0.5 1.2 0.5
END
picture sharpen prune 0.7:1.3 -0.1:0.3 <<-END
	wall 0 0 1.2 0
	wall 1.2 0 1.2 0.8
	path 0.2 0.6 0.9 0.5
END
picture attach sharpen 0.6:1.4 -0.15:0.45 <<-END
	wall 0 0 2 0
	wall 1 0 1 1
	path 0.2 0.6 0.9 0.5
	path 1.1 0.5 1.8 0.5
END
picture trim attach 0.9:1.3 -0.1:0.1 --noise 0.03,0 <<-END
	wall -1 0 1.2 0
	path -1 0.3 0.6 0.3 -1 0.3 0.6 0.3 -1 0.3 0.6 0.3
END
picture straighten trim -2.2:2.2 -0.05:0.05 --noise 0.03,0 <<-END
	wall -2 0 2 0
	path -2 0.7 2 0.7
END
picture correctBends straighten -0.3:0.3 -0.2:0.2 <<-END
	arc 0 0 0.15 0 360
	path -0.7 -0.6 0.7 -0.6 0.7 0.6 -0.7 0.6 -0.7 -0.6
END
