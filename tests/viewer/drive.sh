#!/bin/bash
# drive.sh PROGRAM SCENE FOLDER DROP: the viewer on a virtual screen of its own, driven by real mouse and key events.
# Leaves the rig saved beside the scene, FOLDER/picture.exr as the viewer saved it and FOLDER/screen.png.
# Fails when the program does not do its part in time. All places are of a window of 960x540 at a scale of 1.
set -euo pipefail
program=$1 scene=$2 folder=$3 drop=$4
. "$(dirname "${BASH_SOURCE[0]}")/screen.sh"

open_viewer "$program" view "$scene" --device cpu --size 960x540 --ui-scale 1
until_true 60 "the panels" panels_shown

# What cannot be opened changes nothing, whether it is dropped on the window or named in the dialog.
echo "no scene" >"$folder/bad.glb"
"$drop" "$window" "$folder/bad.glb"
echo "{}" >"$folder/bad.rig.json"
press ctrl+o
answer "$folder/bad.rig.json"

# The key light a stop brighter in three steps, the last undone; the second light solo, compared with the state of
# all lights by a wipe and in a report, no longer solo, then muted.
press bracketright
press bracketright
press bracketright
press ctrl+z
press a
press Down
press s
press w
press b
press ctrl+e
answer "$folder/panel"
until_true 60 "the comparison is saved" test -s "$folder/panel/index.html"
press w
press s
press m

# Turn the view by the mouse, and back by undo, which leaves alone what has played meanwhile: the third frame.
drag 480 480 60 10
press space
sleep 0.5
press space
press Home
press Right
press Right
press Right
press ctrl+z

# Another scene would take the rig's place: that is asked first.
"$drop" "$window" "$scene"
sleep 0.5
press Escape

disturb_window 960 540
press ctrl+s
press ctrl+p
answer "$folder/picture.exr"
until_true 60 "the picture is saved" test -s "$folder/picture.exr"
xdotool mousemove 480 270
sleep 0.5
import -window "$window" "$folder/screen.png"
close_viewer
