#!/bin/bash
# drive_loading.sh PROGRAM FOLDER DROP: what people do to a window while it loads: drop bad files on it, resize it, hide it,
# begin an edit of what is not there; once more, and close it before anything is loaded.
set -euo pipefail
program=$1 folder=$2 drop=$3
. "$(dirname "${BASH_SOURCE[0]}")/screen.sh"

echo "no scene" >"$folder/bad.glb"
echo "no sky" >"$folder/bad.exr"
echo "{}" >"$folder/bad.rig.json"
open_viewer "$program" view default --env none --device cpu --size 820x480 --ui-scale 1
! panels_shown || fail "it was loaded before it was disturbed"
"$drop" "$window" "$folder/bad.exr"
xdotool windowsize "$window" 1100 700
"$drop" "$window" "$folder/bad.rig.json"
xdotool windowunmap "$window"
"$drop" "$window" "$folder/bad.glb"
xdotool windowmap "$window"
xdotool windowfocus "$window"
xdotool windowsize "$window" 820 480
press bracketright # there is no light yet
press ctrl+z
until_true 90 "the panels" panels_shown
import -window "$window" "$folder/screen.png"
close_viewer

start_viewer "$program" view default --env none --device cpu --size 820x480 --ui-scale 1
! panels_shown || fail "it was loaded before it was closed"
close_viewer
