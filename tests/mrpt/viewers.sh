#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Drives MRPT's RawLogViewer and SceneViewer3D with the plug-in on a virtual screen, and looks for walls on the screen.
# Usage: viewers.sh <ridgemap-run> [<directory for screenshots>]
# Exits 77 (skipped) where a program or the data of Debian's mrpt-common are not installed.
set -euo pipefail
launcher=$(realpath "$1")
config=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../datasets/config" && pwd)
data=/usr/share/mrpt/datasets

for program in RawLogViewer SceneViewer3D observations2map rawlog-edit Xvfb xdotool import convert; do
	command -v "$program" >/dev/null || { echo "$program is not installed"; exit 77; }
done
[ -e "$data/localization_demo.rawlog" ] || { echo "MRPT's sample data are not installed"; exit 77; }

folder=$(mktemp -d)
shots=${2:-$folder}
started=()
clean_up()
{
	local pid
	for pid in "${started[@]}"; do kill "$pid" 2>/dev/null || true; done
	rm -rf "$folder"
}
trap clean_up EXIT
mkdir -p "$shots"
shots=$(cd "$shots" && pwd)
cd "$folder"

fail()
{
	echo "$1"
	tail -n 20 log 2>/dev/null
	exit 1
}

# start <program> <argument>...: in the background, to be ended with this script.
start()
{
	"$launcher" "$@" </dev/null >log 2>&1 &
	started+=($!)
}

# window <name>: waits for a window and prints its number.
window()
{
	local found
	for ((i = 0; i < 120; i++)); do
		found=$(xdotool search --onlyvisible --name "$1" 2>/dev/null | tail -n 1 || true)
		if [ -n "$found" ]; then
			echo "$found"
			return
		fi
		sleep 0.5
	done
	import -window root "$shots/failed.png" || true
	fail "no window '$1'" >&2
}

# click <x> <y>: and gives the program time to answer.
click() { xdotool mousemove "$1" "$2" click 1 sleep 1; }

# walls_on <picture>: how many pixels have the colour of walls, and how wide the strip is that holds them.
walls_on()
{
	convert "$1" -fuzz 9% -fill white +opaque '#102060' -fill black -opaque '#102060' -fuzz 0 -trim -colorspace Gray \
		-format '%[fx:round((1-mean)*w*h)] %w\n' info:
}

# shows_walls <picture> <pixels>: waits until the screen shows walls over that width at least.
shows_walls()
{
	local n=0 width=0
	for ((i = 0; i < 15; i++)); do
		import -window root "$1"
		read -r n width < <(walls_on "$1")
		if [ "$n" -gt 150 ] && [ "$width" -gt "$2" ]; then
			echo "$(basename "$1"): $n pixels of walls, over $width columns"
			return
		fi
		sleep 0.5
	done
	fail "$(basename "$1"): only $n pixels of walls, over $width columns"
}

# A screen of this test's own: Xvfb looks for a free number and writes it to the pipe.
mkfifo number
Xvfb -displayfd 3 -screen 0 1024x768x24 3>number >/dev/null 2>&1 &
started+=($!)
read -r display <number
export DISPLAY=:$display LIBGL_ALWAYS_SOFTWARE=1 HOME=$folder
cp "$data/localization_demo.rawlog" run.rawlog

"$launcher" rawlog-edit --info -i run.rawlog </dev/null >log 2>&1 || fail "rawlog-edit ended with code $?"
grep -q "37 .3.878" log || fail "rawlog-edit does not count the scans"

"$launcher" observations2map "$config/observations2map/ridge-map.ini" "$data/localization_demo.simplemap.gz" map \
	</dev/null >log 2>&1 || fail "observations2map ended with code $?"
start SceneViewer3D "$(ls map*.3Dscene)"
viewer=$(window 'SceneViewer3D - Part')
xdotool windowmove "$viewer" 0 0 windowsize "$viewer" 1024 768
shows_walls "$shots/scene-viewer.png" 500
kill "${started[-1]}"

# RawLogViewer: a tip, the button "Raw-map", and its dialog with the text of an INI file.
start RawLogViewer run.rawlog
viewer=$(window 'RawlogViewer - Part')
sleep 4
xdotool windowmove "$viewer" 0 0 windowsize "$viewer" 1024 768 sleep 1
click 570 240
click 220 60
window 'Creation of' >/dev/null
click 700 150
xdotool key ctrl+a sleep 0.5
while read -r line; do
	xdotool type --delay 20 -- "$line"
	xdotool sleep 0.3 key Return sleep 0.3
done <<'INI'
[map]
ridgeMap_count = 1
[map_ridgeMap_00_insertOpts]
maxRange = 15
INI
click 160 192
sleep 4
import -window root "$shots/raw-map-dialog.png"
click 333 278
preview=$(window 'Raw-map 3D preview')
xdotool windowmove "$preview" 0 0 windowsize "$preview" 1024 768 sleep 1 mousemove 512 400
xdotool click --repeat 22 --delay 100 5
shows_walls "$shots/raw-map-preview.png" 60
