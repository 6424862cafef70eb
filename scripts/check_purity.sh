#!/usr/bin/env bash
# The long form of the tests of exactness and purity: many random scenes, each in many orders and batchings.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: [RIDGEMAP_SCENES=N] scripts/check_purity.sh [--exactness]
  Builds the release preset and compares the ridges and walls of N random scenes (default 200), to the bit, over
  permutations, batchings, erasures, merges, one and two threads; compacted and raw, both step rules, both seed rules.
  --exactness  also checks accuracy, coverage, stitching and walls on N scenes each"

programs=(core_purity)
for argument in "$@"; do
	case $argument in
		--exactness) programs+=(core_exactness) ;;
		--help)
			printf '%s\n' "$usage"
			exit
			;;
		*) die "$usage" ;;
	esac
done

export RIDGEMAP_SCENES=${RIDGEMAP_SCENES:-200}
build release "${programs[@]}"
failed=()
for program in "${programs[@]}"; do
	say "$program with $RIDGEMAP_SCENES scenes"
	"$root/build/bin/$program" || failed+=("$program")
done
[ ${#failed[@]} -eq 0 ] || die "failed: ${failed[*]}"
