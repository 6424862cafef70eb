#!/usr/bin/env bash
# check.sh <build directory> <with MRPT: ON or OFF> [<CMake option>...]
# Installs the build, moves the prefix elsewhere, and uses it from there: the installed programs, and a project that
# finds the package.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
with_mrpt=$2
shift 2

fail()
{
	echo "consumer test: $*" >&2
	exit 1
}

# expect <pattern> <command>...: the command succeeds and prints a line that matches.
expect()
{
	local pattern=$1 output
	shift
	output=$("$@") || fail "$* failed"
	printf '%s\n' "$output"
	grep -qE "$pattern" <<<"$output" || fail "$* printed no line like '$pattern'"
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset LD_LIBRARY_PATH

cmake --install "$build" --prefix "$scratch/first" >"$scratch/log" || fail "cmake --install: $(cat "$scratch/log")"
mv "$scratch/first" "$scratch/moved"
if grep -rF --include='*.cmake' -e "$build" -e "$scratch/first" "$scratch/moved"; then
	fail "the package names directories that are not there any more"
fi

cmake -S "$here" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/moved" "$@" >"$scratch/log" 2>&1 ||
	fail "cmake: $(cat "$scratch/log")"
cmake --build "$scratch/build" >"$scratch/log" 2>&1 || fail "build: $(cat "$scratch/log")"

expect '^[0-9]+ points, (1\.9|2\.)[0-9]* m$' "$scratch/build/main"
if [ "$with_mrpt" = ON ]; then
	expect '^sigma 0\.1 m$' "$scratch/build/map_class"
	expect 'ridgemap-build' "$scratch/moved/bin/ridgemap-build" --help
	expect 'ridgemap-info' "$scratch/moved/bin/ridgemap-info" --help

	# The examples of doc/cpp.md.
	cd "$scratch"
	expect . "$scratch/moved/bin/ridgemap-simulate" hallway --sensor lidar --seed 1 -o drive
	expect '^the start is 0\.36[0-9]* m off, the pose found 0\.00[0-9]* m$' "$scratch/build/match_scan" drive.simplemap.gz
	expect '^the same ridges as from scratch$' "$scratch/build/correct_poses" drive.simplemap.gz
fi
