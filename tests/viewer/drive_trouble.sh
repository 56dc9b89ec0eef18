#!/bin/bash
# drive_trouble.sh PROGRAM SCENE FOLDER: under a device that fails (tests/device_trouble): a light is made a stop brighter in
# three steps and the rig saved, unless it is the window's device that is lost then. Leaves the rig beside the scene and FOLDER/screen.png.
set -euo pipefail
program=$1 scene=$2 folder=$3
. "$(dirname "${BASH_SOURCE[0]}")/screen.sh"

open_viewer "$program" view "$scene" --device cpu --size 960x540 --ui-scale 1
until_true 60 "the panels" panels_shown
sleep 2 # the trouble comes with the first pictures
press bracketright
press bracketright
press bracketright
if [[ $CUTIS_TROUBLE == window:* ]]; then
    touch "${CUTIS_TROUBLE#window:}"
    until_ended
    wait "$viewer" # its status is this script's
fi
press ctrl+s
# The left sphere, of many greys. Out of memory it need not come.
sphere_shown() { [ "$(import -window "$window" -crop 60x60+350+250 -format '%k' info:- 2>/dev/null)" -gt 20 ]; }
if [[ $CUTIS_TROUBLE == crash:* ]]; then until_true 60 "the picture" sphere_shown; fi
sleep 1
import -window "$window" "$folder/screen.png"
close_viewer
