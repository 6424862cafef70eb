#!/usr/bin/env bash
# Measures how long everything takes beside MRPT's maps, in one process each.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/benchmark.sh [--quick] [--docs] [DIRECTORY]
  --quick    without counting instructions (needs valgrind)
  --docs     renew the results in doc/benchmarks.md and the chart
  DIRECTORY  where to write (default: benchmark-output)"

quick=no
docs=no
directory=
for argument in "$@"; do
	case $argument in
		--quick) quick=yes ;;
		--docs) docs=yes ;;
		--help)
			printf '%s\n' "$usage"
			exit
			;;
		-*) die "$usage" ;;
		*) directory=$argument ;;
	esac
done
directory=${directory:-$root/benchmark-output}
mkdir -p "$directory"

install_missing "${build_packages[@]}" "${test_packages[@]}"
say "building"
(cd "$root" && cmake --preset release -DRIDGEMAP_BUILD_BENCHMARKS=ON >/dev/null)
cmake --build "$root/build" --parallel "$(nproc)" --target update_benchmark map_benchmark query_benchmark

commit=$(git -C "$root" rev-parse --short HEAD 2>/dev/null || echo unknown)
[ -z "$(git -C "$root" status --porcelain --untracked-files=no -- libs 2>/dev/null)" ] || commit="$commit with changes"
machine=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)

# tables_of <program>: runs it and prints the tables in Markdown among what it prints.
tables_of()
{
	say "running $1" >&2
	"$root/build/bin/$1" --benchmark_out="$directory/$1.json" --benchmark_out_format=json |
		tee "$directory/$1.txt" | sed -n '/^|/,$p'
}

{
	printf 'Commit %s, %s with %s cores, %s, load %s before it began. Times are CPU\ntime, but for the building at once: by the clock, which tells about threads only while the machine is idle.\n' "$commit" \
		"${machine:-$(uname -m)}" "$(nproc)" "$(date +%F)" "$(cut -d' ' -f1 /proc/loadavg)"
	printf '\n### Core\n\n'
	tables_of update_benchmark
	printf '\n### Maps\n\n'
	tables_of map_benchmark
	printf '\n### Queries\n\n'
	tables_of query_benchmark
	if [ "$quick" = no ] && command -v valgrind >/dev/null; then
		printf '\n### Instructions\n\nOf updates with 400 measurements, each insertion followed by an erasure:\n\n'
		say "counting instructions" >&2
		valgrind --tool=callgrind --callgrind-out-file="$directory/callgrind.out" "$root/build/bin/update_benchmark" \
			--benchmark_filter='update with measurements/400' >/dev/null 2>"$directory/callgrind.txt"
		"$root/scripts/instruction_counts.py" "$directory/callgrind.out"
	fi
} >"$directory/results.md"

if command -v gnuplot >/dev/null; then
	# Counters stand in the order of their names: evaluations, floor, kernels, tiles, time, times the floor.
	sed -n '/^| update with measurements | eval/,/^$/p' "$directory/results.md" | sed -n '3,$p' | tr -d '|' \
		>"$directory/updates.dat"
	gnuplot <<-PLOT
		set terminal pngcairo size 800,500
		set output "$directory/update.png"
		set logscale xy
		set key left top Left reverse
		set yrange [0.1:10]
		set grid
		set xlabel "measurements in the update"
		set ylabel "time [ms]"
		plot "$directory/updates.dat" using 1:6 with linespoints title "update", \
			"" using 1:3 with linespoints title "floor: evaluations and changed cells"
	PLOT
fi

if [ "$docs" = yes ]; then
	page="$root/doc/benchmarks.md"
	mkdir -p "$root/doc/images/benchmarks"
	[ ! -e "$directory/update.png" ] || cp "$directory/update.png" "$root/doc/images/benchmarks/"
	{
		sed '/^<!-- results -->$/q' "$page"
		cat "$directory/results.md"
		sed -n '/^<!-- end of results -->$/,$p' "$page"
	} >"$directory/page.md"
	cp "$directory/page.md" "$page"
fi
say "results: $directory/results.md"
