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
"$drop" "$window" "$folder/bad.exr"
"$drop" "$window" "$folder/bad.rig.json"
press bracketright
disturb_window 820 480
! panels_shown || fail "it was loaded before it was disturbed"
"$drop" "$window" "$folder/bad.glb"
until_true 90 "the panels" panels_shown
import -window "$window" "$folder/screen.png"
close_viewer

start_viewer "$program" view default --env none --device cpu --size 820x480 --ui-scale 1
! panels_shown || fail "it was loaded before it was closed"
close_viewer
