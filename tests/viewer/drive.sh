#!/bin/bash
# drive.sh PROGRAM SCENE FOLDER: the viewer on a virtual screen of its own, driven by real mouse and key events.
# Leaves the rig saved beside the scene, FOLDER/picture.exr as the viewer saved it and FOLDER/screen.png.
# Fails when the program does not do its part in time. All places are of a window of 960x540 at a scale of 1.
set -euo pipefail
program=$1 scene=$2 folder=$3

# Xvfb picks a free display and says which.
mkfifo "$folder/display"
Xvfb -displayfd 3 -screen 0 1280x720x24 -nolisten tcp 3>"$folder/display" >"$folder/xvfb.log" 2>&1 &
server=$!
viewer=
trap 'kill $viewer $server 2>/dev/null || true' EXIT
read -r number <"$folder/display"
export DISPLAY=:$number

cd "$folder"
"$program" view "$scene" --device cpu --size 960x540 --ui-scale 1 &
viewer=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name '^cutis - ' | head -1)
echo "title: $(xdotool getwindowname "$window")"
xdotool windowfocus "$window"

fail() { echo "drive: $1" >&2; import -window root "$folder/failed.png"; exit 1; }
# until_true SECONDS WHAT COMMAND...: tries again until the command succeeds.
until_true() {
    local end=$((SECONDS + $1)) what=$2
    shift 2
    until "$@"; do
        kill -0 "$viewer" 2>/dev/null || fail "the viewer ended before: $what"
        [ $SECONDS -lt $end ] || fail "not in time: $what"
        sleep 0.1
    done
}
# Until the rig panel is there, its place is one dark colour.
panels_shown() {
    local colors
    colors=$(import -window "$window" -crop 240x200+5+30 -format '%k' info:- 2>/dev/null) && [ "$colors" -gt 60 ]
}
press() { xdotool key "$@"; sleep 0.3; }
drag() { # from X Y by DX DY
    xdotool mousemove "$1" "$2" && sleep 0.3
    xdotool mousedown 1 && sleep 0.3
    xdotool mousemove_relative --sync -- "$3" "$4" && sleep 0.3
    xdotool mouseup 1 && sleep 0.3
}
# Answers the dialog that asks for a path.
answer() {
    press ctrl+a
    xdotool type --delay 5 "$1"
    sleep 0.5
    press Return
}

until_true 60 "the panels" panels_shown

# The key light a stop brighter in three steps, the last undone; the second light solo, compared with the state of
# all lights, no longer solo, then muted.
press bracketright
press bracketright
press bracketright
press ctrl+z
press a
press Down
press s
press w
press w
press s
press m

# Turn the view by the mouse, and back by undo.
drag 480 480 60 10
press ctrl+z

# What cannot be opened changes nothing. A file dropped on the window takes the same way.
echo "no scene" >"$folder/bad.glb"
press ctrl+o
answer "$folder/bad.glb"

# Sizes, and a window that is not shown at all.
xdotool windowsize "$window" 1100 700 && sleep 0.5
xdotool windowunmap "$window" && sleep 0.3
xdotool windowmap "$window" && sleep 0.3
xdotool windowfocus "$window"
xdotool windowsize "$window" 960 540 && sleep 0.5

press ctrl+s
press ctrl+p
answer "$folder/picture.exr"
until_true 60 "the picture is saved" test -s "$folder/picture.exr"
xdotool mousemove 480 270
sleep 0.5
import -window "$window" "$folder/screen.png"
press ctrl+q
for _ in $(seq 200); do kill -0 "$viewer" 2>/dev/null || break; sleep 0.1; done
kill -0 "$viewer" 2>/dev/null && fail "the viewer does not end"
wait "$viewer"
