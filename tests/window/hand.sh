#!/usr/bin/env bash
# What the runs with a real window share: a display of its own, keys, pictures, and what the command line finds.
#
#     source hand.sh FOLDER [PROGRAM]
#
# Needs (Debian) xvfb xdotool imagemagick libgl1-mesa-dri, jq, and a built program.
set -euo pipefail
mkdir -p "$1"
folder="$(cd "$1" && pwd)"
program="$(realpath "${2:-target/debug/chereme}")"
size="${CHEREME_WINDOW_SIZE:-1280x800}"
picture=0

exec 9> "$folder/display"
Xvfb -displayfd 9 -screen 0 "${size}x24" -nolisten tcp > "$folder/xvfb.log" 2>&1 &
server=$!
window=
leave() {
    kill $window 2> /dev/null || true
    kill "$server" 2> /dev/null || true
}
trap leave EXIT
until [ -s "$folder/display" ]; do sleep 0.1; done
DISPLAY=":$(cat "$folder/display")"
export DISPLAY LIBGL_ALWAYS_SOFTWARE=1

open() {
    "$program" studio --folder "$folder" --author Camille "$@" > "$folder/studio.log" 2>&1 &
    window=$!
    local id
    id="$(timeout 30 xdotool search --sync --onlyvisible --name '^Chereme' | head -1)"
    xdotool windowfocus --sync "$id"
    # The mouse rests where no tip opens.
    xdotool mousemove $((${size%x*} - 4)) $((${size#*x} - 4))
    sleep 2
}
shut() {
    keys ctrl+q
    for _ in $(seq 50); do
        kill -0 "$window" 2> /dev/null || return 0
        sleep 0.1
    done
    echo "the window did not close" >&2
    exit 1
}
keys() {
    for key in "$@"; do
        xdotool key "$key"
        sleep 0.3
    done
}
types() {
    xdotool type --delay 50 "$1"
    sleep 0.4
}
# Says to the palette what is wanted, in the words of the menus.
wants() {
    keys ctrl+shift+p
    types "$1"
    keys Return
}
look() {
    sleep "${2:-1}"
    picture=$((picture + 1))
    import -window root "$folder/$(printf '%02d' "$picture")-$1.png"
}
# What the command line finds, as the evidence that a step took place.
holds() {
    local found
    found="$("$program" --json "$@" | jq -c .)"
    printf '%s\n    %s\n' "chereme $*" "$(printf '%s' "$found" | cut -c -300)"
}
