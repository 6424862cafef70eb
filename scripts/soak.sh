#!/usr/bin/env bash
# The long forms of the reliability tests: the same programs as in ctest, more of everything. doc/reliability.md says what
# each of them checks.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/soak.sh [--minutes N] [--seed N] [--libfuzzer]
  --minutes N   for each fuzz target (default 10); 20,000 times as many flips, 50 times as many
                cuts of two recordings, 40 + 20 N scenes
  --seed N      of everything random (default: the time in seconds, which is printed)
  --libfuzzer   build the fuzz targets with clang's libFuzzer and the sanitizers, too, and run these"

minutes=10
seed=$(date +%s)
libfuzzer=no
while [ $# -gt 0 ]; do
	case $1 in
		--minutes) minutes=${2:?$usage} && shift ;;
		--seed) seed=${2:?$usage} && shift ;;
		--libfuzzer) libfuzzer=yes ;;
		--help)
			printf '%s\n' "$usage"
			exit
			;;
		*) die "$usage" ;;
	esac
	shift
done

targets=(states map_file text svg plan)
say "seed $seed"
build dev ridgemap-mrpt-damage-unittest apps_keep_going_unittest core_exactness core_purity "${targets[@]/#/fuzz_}"
bin="$root/build-dev/bin"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

say "flipped bits"
RIDGEMAP_FLIPS=$((20000 * minutes)) RIDGEMAP_SEED=$((seed % 1000000)) "$bin/ridgemap-mrpt-damage-unittest" --gtest_filter='DamagedFile.*'
say "cut recordings"
RIDGEMAP_CUTS=$((50 * minutes)) "$bin/apps_keep_going_unittest" --gtest_filter='*cutAtAnyByte'
say "random scenes against the oracle"
RIDGEMAP_SCENES=$((40 + 20 * minutes)) "$bin/core_exactness"
RIDGEMAP_SCENES=$((40 + 20 * minutes)) "$bin/core_purity"

# Portions with seeds of their own until the time is over; a broken promise ends the script, with the seed printed.
for target in "${targets[@]}"; do
	[ -x "$bin/fuzz_$target" ] || continue
	end=$((SECONDS + 60 * minutes))
	runs=0
	while [ $SECONDS -lt $end ]; do
		"$bin/fuzz_$target" -runs=1000 -seed=$(((seed + runs) % 4000000000)) >last.log ||
			die "fuzz_$target failed with -runs=1000 -seed=$(((seed + runs) % 4000000000))"
		runs=$((runs + 1000))
	done
	say "fuzz_$target: $runs executions"
done

[ "$libfuzzer" = yes ] || exit 0
command -v clang++ >/dev/null || die "libFuzzer needs clang: apt install clang"
sanitize="-O1 -g1 -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all"
cmake -S "$root" -B "$root/build-fuzz" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Sanitize \
	-DRIDGEMAP_FUZZ=ON -DCMAKE_CXX_FLAGS="$sanitize" >/dev/null
cmake --build "$root/build-fuzz" --parallel "$(nproc)" --target "${targets[@]/#/fuzz_}"
for target in "${targets[@]}"; do
	mkdir -p "corpus-$target"
	"$bin/fuzz_$target" -write="corpus-$target"
	# The suppressed leaks are of MRPT; a map of 4 kB takes far less than 2 GB.
	ASAN_OPTIONS=detect_leaks=0 "$root/build-fuzz/bin/fuzz_$target" -max_total_time=$((60 * minutes)) -max_len=4096 \
		-rss_limit_mb=2000 -timeout=100 "corpus-$target" 2>fuzz.log || die "$(tail -30 fuzz.log)"
	say "fuzz_$target with libFuzzer: $(tail -1 fuzz.log)"
done
