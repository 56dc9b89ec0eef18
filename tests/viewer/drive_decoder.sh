#!/bin/bash
# drive_decoder.sh PROGRAM SCENE FOLDER DROP BAD: BAD, a scene whose image breaks its decoder (tests/support/bad_decoder.cpp),
# is dropped on the viewer. Meanwhile the first light is made brighter by two steps, by a third when the file was refused, and
# the rig is saved. Leaves FOLDER/screen.png.
set -euo pipefail
program=$1 scene=$2 folder=$3 drop=$4 bad=$5
. "$(dirname "${BASH_SOURCE[0]}")/screen.sh"

open_viewer "$program" view "$scene" --device cpu --size 960x540 --ui-scale 1 2> >(tee "$folder/said" >&2)
until_true 60 "the panels" panels_shown
"$drop" "$window" "$bad"
press bracketright
press bracketright
until_true 60 "the file is refused" grep -q "$(basename "$bad")" "$folder/said"
press bracketright
press ctrl+s
# The left sphere, of many greys.
sphere_shown() { [ "$(import -window "$window" -crop 60x60+350+250 -format '%k' info:- 2>/dev/null)" -gt 20 ]; }
until_true 60 "the picture" sphere_shown
import -window "$window" "$folder/screen.png"
close_viewer
