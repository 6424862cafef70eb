#!/usr/bin/env bash
# Types the commands of the tutorials doc/icp-slam.md, rbpf-slam.md, localization.md and cpp.md, and draws what they leave
# behind: the pictures of these pages. Needs a build in build/, MRPT's programs with their sample data, and gnuplot.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ "${1:-}" != --help ] || { printf 'usage: scripts/tutorial-pictures.sh [DIRECTORY]\n'; exit; }
out=$(realpath -m "${1:-$root/doc/images/tutorials}")
install_missing mrpt-apps "${demo_packages[@]}" "${paper_packages[@]}"
programs=${RIDGEMAP_PROGRAMS:-$root/build/bin}
mkdir -p "$out"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# run <program> <INI file below datasets/config>: leaves what the program says in the file log.
run()
{
	say "$1 $2"
	"$programs/ridgemap-run" "$1" "$root/datasets/config/$2" </dev/null >log 2>&1 || die "$(tail log)"
}

# walls <file>: the polylines of a _walls.csv in blocks for gnuplot.
walls() { awk -F, 'NR > 1 { if ($1 != last) print ""; last = $1; print $2, $3 }' "$1" >walls; }

# draw <name> <width> <height> <x range> <y range> <plots beside the walls>
draw()
{
	gnuplot <<-END
		set terminal pngcairo size $2,$3 font 'sans,10'
		set output '$out/$1.png'
		set size ratio -1
		set xrange [$4]
		set yrange [$5]
		set xlabel 'x [m]'
		set ylabel 'y [m]'
		set grid lc rgb '#eeeeee'
		set bmargin 6
		set key at screen 0.5, 0.02 bottom center horizontal samplen 2
		plot 'walls' with lines lw 1.5 lc rgb '#102060' title 'walls', $6
	END
	say "$out/$1.png"
}

run icp-slam icp-slam/ridge-points.ini
walls LOG_ICP-SLAM/*_walls.csv
draw icp-slam 760 660 -30:20 -26:16 "'LOG_ICP-SLAM/log_odometry_path.txt' using 2:3 with lines dt 2 lw 1.5 lc rgb '#777777' \
	title 'odometry', 'LOG_ICP-SLAM/log_estimated_path.txt' using 2:3 with lines lw 2 lc rgb '#e69138' title 'path'"

run rbpf-slam rbpf-slam/ridge-points.ini
walls LOG_RBPF-SLAM/*_walls.csv
draw rbpf-slam 760 660 -30:20 -26:16 "'LOG_RBPF-SLAM/log_odometry_path.txt' using 2:3 with lines dt 2 lw 1.5 lc rgb '#777777' \
	title 'odometry', 'LOG_RBPF-SLAM/log_estimated_path.txt' using 2:3 with lines lw 2 lc rgb '#e69138' title 'path', \
	'LOG_ICP-SLAM/log_estimated_path.txt' using 2:3 with lines dt 3 lw 1 lc rgb '#000000' title 'path of icp-slam'"

# Particles start at random, and some runs end where the building looks alike: the first that finds the robot is drawn.
for attempt in {1..20}; do
	run pf-localization pf-localization/ridge-map.ini
	sed -n 's/.*PDF estimation: (\([^,]*\),\([^,]*\),.*tr(cov): \(.*\)/\1 \2 \3/p' log >estimates
	! tail -n 1 estimates | awk '{ exit !(($1 - 15.9)^2 + ($2 + 10)^2 < 0.25) }' || break
	[ "$attempt" -lt 20 ] || die "none of $attempt runs found the robot"
done
walls LOG_LOCALIZATION_000_0080000/*_walls.csv
draw localization 900 480 -14:20 -16:4 "'LOG_LOCALIZATION_000_0080000/particles/particles_0_initial.txt' every 40 using 1:2 \
	with points pt 7 ps 0.3 lc rgb '#9fc5f8' title 'first particles', \
	'estimates' using 1:2:(sqrt(\$3 / 2)) with circles lw 1.2 lc rgb '#e69138' title 'estimates, with deviation'"

say "match_scan"
cmake --install "$(dirname "$programs")" --prefix "$scratch/prefix" >log
cmake -S "$root/tests/consumer" -B "$scratch/consumer" -DCMAKE_PREFIX_PATH="$scratch/prefix" >log
cmake --build "$scratch/consumer" --target match_scan >log 2>&1 || die "$(tail log)"
"$programs/ridgemap-simulate" hallway --sensor lidar --seed 1 -o drive >log
"$scratch/consumer/match_scan" drive.simplemap.gz
walls match_scan_walls.csv
draw cpp 560 560 -1:17 -2:16.5 "'match_scan_start.txt' using 1:2 with points pt 7 ps 0.4 lc rgb '#999999' title 'scan at the start', \
	'match_scan_found.txt' using 1:2 with points pt 7 ps 0.4 lc rgb '#e69138' title 'at the pose found'"
