#!/usr/bin/env bash
# Replays a recorded robot run that Debian's mrpt-common brings along and draws the walls it saw into demo-output/.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -eq 0 ] || die "usage: scripts/demo.sh"

install_missing "${build_packages[@]}" "${demo_packages[@]}"
say "building"
build release ridgemap-build ridgemap-info

rawlog=$(dpkg -L mrpt-common | grep 'SENA_Telecom Faculty_one_loop_only\.rawlog$') ||
	die "mrpt-common holds no one-loop rawlog; reinstall it with: apt-get install --reinstall mrpt-common"

cd "$root"
mkdir -p demo-output
say "replaying $(basename "$rawlog")"
build/bin/ridgemap-build "$rawlog" -o demo-output/one_loop

say "pictures: $root/demo-output/one_loop.png and .svg"
say "more about the map: build/bin/ridgemap-info demo-output/one_loop.ridgemap"
