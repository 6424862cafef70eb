#!/usr/bin/env bash
# Lines of the libraries that the tests run: builds them with counters, runs ctest, and prints the share by file. Fails
# below 95 %. Debian: gcovr.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/coverage.sh [--report-only] [CTEST-OPTION...]
  --report-only  do not build and run, but report on what was run before
  CTEST-OPTION   such as -L core: these tests only"

run=yes
case ${1:-} in
	--help)
		printf '%s\n' "$usage"
		exit
		;;
	--report-only)
		run=no
		shift
		;;
esac
command -v gcovr >/dev/null || install_missing gcovr

if [ "$run" = yes ]; then
	build coverage
	find "$root/build-coverage" -name '*.gcda' -delete
	# What a failing test has run counts all the same, but it must be known.
	(cd "$root/build-coverage" && ctest --output-on-failure --parallel 2 "$@") || say "some tests failed"
fi
cd "$root"
gcovr --root . --object-directory build-coverage --filter 'libs/' --exclude-throw-branches \
	--txt build-coverage/coverage.txt --html-details build-coverage/coverage.html --fail-under-line 95
cat build-coverage/coverage.txt
