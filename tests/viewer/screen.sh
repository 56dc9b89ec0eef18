# What scripts that drive the viewer share: a virtual screen of their own, real mouse and key events.
# Needs $folder; leaves $window, $viewer. Sourced, not run.

# open_viewer PROGRAM ARGUMENTS...: starts the viewer on a virtual screen and waits for its window.
open_viewer() {
    # Xvfb picks a free display and says which.
    mkfifo "$folder/display"
    Xvfb -displayfd 3 -screen 0 1280x720x24 -nolisten tcp 3>"$folder/display" >"$folder/xvfb.log" 2>&1 &
    server=$!
    viewer=
    trap 'kill $viewer $server 2>/dev/null || true' EXIT
    read -r number <"$folder/display"
    export DISPLAY=:$number
    cd "$folder"
    start_viewer "$@"
}
# start_viewer PROGRAM ARGUMENTS...: the same on the screen that there is.
start_viewer() {
    "$@" &
    viewer=$!
    window=$(timeout 60 xdotool search --sync --onlyvisible --name '^cutis - ' | head -1)
    echo "title: $(xdotool getwindowname "$window")"
    xdotool windowfocus "$window"
}

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
# The window under other sizes, and not shown at all.
disturb_window() { # WIDTH HEIGHT, as before
    xdotool windowsize "$window" 1100 700 && sleep 0.5
    xdotool windowunmap "$window" && sleep 0.3
    xdotool windowmap "$window" && sleep 0.3
    xdotool windowfocus "$window"
    xdotool windowsize "$window" "$1" "$2" && sleep 0.5
}
until_ended() {
    # Mesa writes its shader cache on a thread of the lowest priority, which on a busy machine takes its time to end.
    for _ in $(seq 600); do kill -0 "$viewer" 2>/dev/null || return 0; sleep 0.1; done
    fail "the viewer does not end"
}
close_viewer() {
    press ctrl+q
    until_ended
    wait "$viewer"
}
