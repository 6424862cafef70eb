#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# ridgemap-run passes arguments, exit codes and signals through, and says what is wrong. Usage: run_program.sh <ridgemap-run>
set -euo pipefail
launcher=$1

fail()
{
	echo "$1"
	exit 1
}

# code <expected> <command>...: the command ends with that code.
code()
{
	local expected=$1 got=0
	shift
	"$@" >"$folder/out" 2>"$folder/err" || got=$?
	[ "$got" -eq "$expected" ] || fail "'$*' ended with code $got instead of $expected: $(cat "$folder/err")"
}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

code 0 "$launcher" printf '%s|' 'a b' '' '*' --help
[ "$(cat "$folder/out")" = 'a b||*|--help|' ] || fail "arguments came out as $(cat "$folder/out")"
code 7 "$launcher" bash -c 'exit 7'
code 143 "$launcher" bash -c 'kill -TERM $$'
code 0 "$launcher" bash -c 'grep -q libridgemap-mrpt /proc/$$/maps'
code 0 env LD_PRELOAD=libm.so.6 "$launcher" bash -c 'grep -q libridgemap-mrpt /proc/$$/maps && grep -q libm.so.6 /proc/$$/maps'
code 127 "$launcher" no-such-program
grep -q 'no-such-program.*mrpt-apps' "$folder/err" || fail "a missing program is not explained"
code 126 "$launcher" "$folder"
code 2 "$launcher"
grep -q usage "$folder/err" || fail "no usage"
code 0 "$launcher" --help
cp "$launcher" "$folder/lonely"
code 1 "$folder/lonely" true
grep -q 'is missing' "$folder/err" || fail "a missing library is not explained"
mkdir -p "$folder/with blank/bin" "$folder/with blank/lib"
cp "$launcher" "$folder/with blank/bin/"
: >"$folder/with blank/lib/libridgemap-mrpt.so"
code 1 "$folder/with blank/bin/$(basename "$launcher")" true
grep -q 'blank' "$folder/err" || fail "a path that cannot be preloaded is not explained"
echo "arguments, exit codes, signals and messages are as they should be"
