#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A robot drives through a building of which there is only a plan: MRPT's pf-localization finds it in the imported plan.
# Usage: imported_plan.sh <ridgemap-simulate> <ridgemap-import> <ridgemap-run>
# Exits 77 (skipped) where pf-localization is not installed.
set -euo pipefail
simulate=$(realpath "$1") import=$(realpath "$2") launcher=$(realpath "$3")
config=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../datasets/config" && pwd)

command -v pf-localization >/dev/null || { echo "pf-localization is not installed"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail()
{
	echo "$1"
	[ ! -e log ] || tail -n 40 log
	exit 1
}

# Two rooms with a door between them, a niche, and a round pillar. No part looks like another.
cat >scene.txt <<'END'
wall 0 0 12 0
wall 12 0 12 5
wall 12 5 9 5
wall 9 5 9 8
wall 9 8 0 8
wall 0 8 0 0
wall 5 0 5 3
wall 5 4.2 5 8
arc 2 6 0.4 0 360
path 1.5 1.5 1.5 3.6 7 3.6 7 6.5 8 2 11 2
END
"$simulate" scene.txt --sensor lidar --odometry-noise 0.02 -o drive >/dev/null

# The plan as an architect has it: in millimetres, with a piece of furniture on a layer that must not count.
{
	printf '<svg xmlns="http://www.w3.org/2000/svg" width="12000mm" height="8000mm" viewBox="0 -8000 12000 8000">\n'
	printf '<g transform="scale(1,-1)"><g id="walls">\n'
	printf '<polygon points="0,0 12000,0 12000,5000 9000,5000 9000,8000 0,8000"/>\n'
	printf '<line x1="5000" y1="0" x2="5000" y2="3000"/><line x1="5000" y1="4200" x2="5000" y2="8000"/>\n'
	printf '<polygon points="'
	awk 'BEGIN { for (i = 0; i < 48; i++) printf "%.1f,%.1f ", 2000 + 400 * cos(i * atan2(0, -1) / 24), 6000 + 400 * sin(i * atan2(0, -1) / 24) }'
	printf '"/></g><g id="furniture"><rect x="500" y="500" width="8000" height="2000"/></g></g></svg>\n'
} >plan.svg
"$import" plan.svg --layer walls -o plan.ridgemap >log || fail "the plan was not imported"
grep -q 'size  *12.000 m x 8.000 m' log || fail "the plan has a wrong size"

sed -e '/^map_file/d' -e "s|^rawlog_file.*|rawlog_file = $folder/drive.rawlog|" \
	-e 's/^init_PDF_min_x.*/init_PDF_min_x = 0/' -e 's/^init_PDF_max_x.*/init_PDF_max_x = 12/' \
	-e 's/^init_PDF_min_y.*/init_PDF_min_y = 0/' -e 's/^init_PDF_max_y.*/init_PDF_max_y = 8/' \
	-e "s|^\[MetricMap_ridgeMap_00_creationOpts\]|&\nfile = $folder/plan.ridgemap|" \
	"$config/pf-localization/ridge-map.ini" >plan.ini

# truth <file>: where the robot stood at last.
read -r _ trueX trueY truePhi < <(tail -n 1 drive_poses.txt)
# A single run of a particle filter may end elsewhere: one of five must not.
for attempt in 1 2 3 4 5; do
	rm -rf LOG_LOCALIZATION*
	"$launcher" pf-localization plan.ini </dev/null >log 2>&1 || fail "pf-localization ended with code $?"
	read -r x y phi < <(grep 'PDF estimation' log | tail -n 1 | sed -E 's/.*estimation: \(([-0-9.]+),([-0-9.]+),([-0-9.]+)deg.*/\1 \2 \3/')
	if awk -v x="$x" -v y="$y" -v phi="$phi" -v tx="$trueX" -v ty="$trueY" -v tphi="$truePhi" 'BEGIN {
		degrees = 180 / atan2(0, -1); turn = (phi - tphi * degrees) % 360; if (turn > 180) turn -= 360; if (turn < -180) turn += 360
		exit !((x - tx) ^ 2 + (y - ty) ^ 2 < 0.1 ^ 2 && turn ^ 2 < 3 ^ 2) }'; then
		echo "the robot is at ($x, $y, $phi deg), believed after $attempt runs; true ($trueX, $trueY, $truePhi rad)"
		exit 0
	fi
done
fail "the robot is believed to be at ($x, $y, $phi deg) in place of ($trueX, $trueY, $truePhi rad)"
