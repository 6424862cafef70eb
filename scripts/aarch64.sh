#!/usr/bin/env bash
# Cross-compiles the core for 64-bit ARM with warnings as errors, and compares the bits of a generated map that it makes
# there, under emulation, with those made by this machine.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -eq 0 ] || die "usage: scripts/aarch64.sh"
install_missing "${build_packages[@]}" g++-aarch64-linux-gnu qemu-user
build dev ridgemap-core
compiler=aarch64-linux-gnu-g++
cross="$root/build-aarch64"
cmake -S "$root" -B "$cross" -G Ninja -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
	-DCMAKE_CXX_COMPILER=$compiler -DCMAKE_BUILD_TYPE=Release -DRIDGEMAP_BUILD_MRPT=OFF \
	-DRIDGEMAP_BUILD_TESTS=OFF -DRIDGEMAP_WERROR=ON >/dev/null
cmake --build "$cross"

# link <compiler> <build folder> <program>
link()
{
	"$1" -O2 -std=c++17 -static -I"$root/libs/ridgemap-core/include" "$root/tests/tools/map_bits.cpp" \
		"$2/lib/libridgemap-core.a" -lpthread -o "$3"
}
link g++ "$root/build-dev" "$cross/map-bits-here"
link $compiler "$cross" "$cross/map-bits-there"
here=$("$cross/map-bits-here")
there=$(qemu-aarch64 "$cross/map-bits-there")
say "here"
printf '%s\n' "$here"
say "aarch64"
printf '%s\n' "$there"
[ "$here" = "$there" ] || die "the maps differ"
say "the same bits"
