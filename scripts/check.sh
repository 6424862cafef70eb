#!/usr/bin/env bash
# Checks the formatting of the sources and the shell scripts; with --fix, formats the sources in place.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$root"

mode=(--dry-run -Werror)
case ${1:-} in
	'') ;;
	--fix) mode=(-i) ;;
	*) die "usage: scripts/check.sh [--fix]" ;;
esac

# tracked <pattern>...: the files under version control that match, one a line.
tracked() { git ls-files -- "$@" || die "git cannot list the files of $root"; }

list=$(tracked '*.h' '*.cpp')
mapfile -t sources <<<"$list"
say "formatting of ${#sources[@]} sources"
clang-format "${mode[@]}" "${sources[@]}" || die "formatting differs; repair it with: scripts/check.sh --fix"

list=$(tracked '*.sh' .ci/run)
mapfile -t scripts <<<"$list"
say "syntax of ${#scripts[@]} scripts"
for file in "${scripts[@]}"; do bash -n "$file"; done
shellcheck --external-sources --source-path=SCRIPTDIR "${scripts[@]}"
