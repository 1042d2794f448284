#!/usr/bin/python3
"""What assistive technology is told of the window: its widgets by their names, and where they are.

    labels.py                  every widget: role, x, y, width, height, name
    labels.py NAME [ROLE [N]]  where the N-th called so is (the last: -1): x, y, width, height

A name may be given by its beginning where no widget has all of it, and a role by its beginning.
It needs the session bus on which `hand.sh` switches assistive technology on.
"""
import sys

import gi

gi.require_version("Atspi", "2.0")
from gi.repository import Atspi, GLib  # noqa: E402


def collect(node, found):
    """Adds the widgets below a node that have a name and a place."""
    for at in range(node.get_child_count()):
        child = node.get_child_at_index(at)
        if child is None:
            continue
        try:
            name, role = child.get_name(), child.get_role_name()
            if name and "Component" in child.get_interfaces():
                box = child.get_extents(Atspi.CoordType.SCREEN)
                found.append((role, box.x, box.y, box.width, box.height, name))
            collect(child, found)
        except GLib.Error:
            # It went away meanwhile.
            continue
    return found


def main():
    # On a session bus of its own the window is the only program.
    found = collect(Atspi.get_desktop(0), [])
    if len(sys.argv) == 1:
        for role, x, y, width, height, name in found:
            print(role, x, y, width, height, " ".join(name.split()), sep="\t")
        return
    name, role, place = (sys.argv[1:] + ["", "", "1"][len(sys.argv) - 1 :])[:3]
    kind = [it for it in found if it[0].startswith(role)]
    fits = [it for it in kind if it[-1] == name] or [it for it in kind if it[-1].startswith(name)]
    place = int(place)
    if len(fits) < abs(place):
        sys.exit(f"nothing is called {name}")
    print(*fits[place - 1 if place > 0 else place][1:5])


main()
