#!/usr/bin/env bash
# What the runs with a real window share: a display of its own, keys and mouse, pictures, and what the command
# line finds.
#
#     source hand.sh FOLDER [PROGRAM]
#
# Needs (Debian) xvfb xdotool imagemagick libgl1-mesa-dri, jq, and both programs (`cargo build`); with a mouse also dbus
# at-spi2-core libglib2.0-bin python3-gi gir1.2-atspi-2.0: what is clicked is found by the name that assistive
# technology is told.
set -euo pipefail
shopt -s inherit_errexit
tools="$(dirname "${BASH_SOURCE[0]}")"
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

# On a session bus of its own the window is told that somebody uses assistive technology.
if [ -n "${CHEREME_OWN_BUS:-}" ]; then
    gdbus call --session --dest org.a11y.Bus --object-path /org/a11y/bus \
        --method org.freedesktop.DBus.Properties.Set org.a11y.Status ScreenReaderEnabled '<true>' > /dev/null
fi

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
    closed
}
# Waits for the window to go.
closed() {
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
# Where the widget is that is called NAME [ROLE [N]]: x, y, width, height. It waits a while for it to come.
place() {
    for _ in $(seq 40); do
        if "$tools/labels.py" "$@" 2> "$folder/labels.log"; then
            return
        fi
        sleep 0.3
    done
    cat "$folder/labels.log" >&2
    return 1
}
# Its middle.
middle() {
    local box
    box="$(place "$@")"
    set -- $box
    echo $(($1 + $3 / 2)) $(($2 + $4 / 2))
}
# Presses a button of the mouse: 1, or 3 for the other one; twice for a double click.
press() {
    xdotool mousemove "$1" "$2"
    sleep 0.2
    xdotool click --repeat "${4:-1}" --delay 60 "${3:-1}"
    sleep 0.5
}
click() {
    local at
    at="$(middle "$@")"
    press $at
}
other_click() {
    local at
    at="$(middle "$@")"
    press $at 3
}
# Turns the wheel below OVER until NAME lies within so many points below it, and clicks it.
wheel_to() {
    local name="$1" room="$2" over at box
    over="$(middle "$3")"
    for _ in $(seq 40); do
        at="$(middle "$name")"
        box=$((${at#* } - ${over#* }))
        if [ "$box" -gt 0 ] && [ "$box" -lt "$room" ]; then
            press $at
            return
        fi
        xdotool mousemove "${over% *}" $((${over#* } + 60))
        sleep 0.1
        xdotool click $((box > 0 ? 5 : 4))
        sleep 0.4
    done
    echo "the wheel does not reach $name" >&2
    return 1
}
# Turns the wheel over a widget: 4 is up, 5 is down.
wheel_over() {
    local at
    at="$(middle "$1")"
    xdotool mousemove $at
    sleep 0.2
    xdotool click --repeat "$3" --delay 150 "$2"
    sleep 0.6
}
# Drags from one point to another, as a hand does: not at once.
drag() {
    xdotool mousemove "$1" "$2"
    sleep 0.2
    xdotool mousedown 1
    for step in 1 2 3 4 5 6 7 8; do
        xdotool mousemove $(($1 + ($3 - $1) * step / 8)) $(($2 + ($4 - $2) * step / 8))
        sleep 0.06
    done
    sleep 0.2
    xdotool mouseup 1
    sleep 0.5
}
# An entry of a menu of the menu bar.
menu() {
    click "$1" "push button"
    click "$2" "push button" "${3:-1}"
}
look() {
    sleep "${2:-1}"
    picture=$((picture + 1))
    import -window root "$folder/$(printf '%02d' "$picture")-$1.png"
}
# What the command line tells of the corpus.
tells() {
    local found
    found="$("$program" --json "$@" | jq -c .)"
    printf '%s\n    %s\n' "chereme $*" "$(printf '%s' "$found" | cut -c -300)"
}
# That it finds so many, as the evidence that a step took place: the run ends where it does not.
holds() {
    local wanted="$1" total
    shift
    tells "$@"
    total="$("$program" --json "$@" | jq .total)"
    if [ "$total" != "$wanted" ]; then
        echo "$wanted were to be found, not $total: chereme $*" >&2
        exit 1
    fi
}

# A signer that was captured, and annotations of the same name with glosses of either hand on tiers of their own.
make_captured() {
    captured="$folder/captured.chereme"
    cp "$data/motion/bvh/upf-gti-performs/NGT Thanks.bvh" "$folder/thanks.bvh"
    cp "$data/annotation/eaf/eq4all-projects-SignBLEU/weather_001.eaf" "$folder/thanks.eaf"
    "$program" new "$captured" > /dev/null
    "$program" import "$captured" "$folder/thanks.bvh" "$folder/thanks.eaf" --mend-root > /dev/null
    rm "$folder/thanks.bvh" "$folder/thanks.eaf"
}
# Signs that were only ever written down.
make_notated() {
    notated="$folder/notated.chereme"
    "$program" import "$notated" "$data/notation/sigml" > /dev/null
}
