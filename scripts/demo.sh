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

say "replaying $(basename "$rawlog")"
output="$root/demo-output"
mkdir -p "$output"
"$root/build/bin/ridgemap-build" "$rawlog" -o "$output/one_loop"

say "the map, as ridgemap-info sees it"
"$root/build/bin/ridgemap-info" "$output/one_loop.ridgemap"

say "files in $output"
(cd "$output" && ls -l one_loop*)
say "pictures: $output/one_loop.png and $output/one_loop.svg"
