#!/usr/bin/env bash
# Builds without warnings, checks formatting and scripts, and runs all tests. The last lines are ctest's own.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/test.sh [--sanitize | --tsan] [--no-install]
  --sanitize    build and test with the address and undefined-behaviour sanitizers
  --tsan        build and test with the thread sanitizer
  --no-install  do not install missing Debian packages"

preset=dev
install=yes
for argument in "$@"; do
	case $argument in
		--sanitize) preset=asan ;;
		--tsan) preset=tsan ;;
		--no-install) install=no ;;
		--help)
			printf '%s\n' "$usage"
			exit
			;;
		*) die "$usage" ;;
	esac
done

[ "$install" = no ] || install_missing "${build_packages[@]}" "${test_packages[@]}"
"$root/scripts/check.sh"
say "building ($preset)"
build "$preset"
say "testing ($preset)"
cd "$root"
ctest --preset "$preset" --no-label-summary --parallel 2
