#!/bin/bash
# drive_default.sh PROGRAM FOLDER: the default scene in a small window, as an artist begins: a light changes, shines
# alone, is compared with all, the rig and a picture are saved. Leaves FOLDER/own.rig.json, picture.exr and screen.png.
set -euo pipefail
program=$1 folder=$2
. "$(dirname "${BASH_SOURCE[0]}")/screen.sh"

# Panels take 580 pixels of the width: the picture is small, which is what keeps this short. So does a dark sky.
open_viewer "$program" view default --env none --device cpu --size 820x430 --ui-scale 1
until_true 90 "the panels" panels_shown

press bracketright
press bracketright
press a
press s
press d
press d
press s
press ctrl+z
press ctrl+z
press ctrl+z

press ctrl+shift+s
answer "$folder/own.rig.json"
until_true 20 "the rig is saved" test -s "$folder/own.rig.json"
press ctrl+p
answer "$folder/picture.exr"
until_true 150 "the picture is saved" test -s "$folder/picture.exr"
xdotool mousemove 410 250
sleep 0.5
import -window "$window" "$folder/screen.png"
close_viewer
