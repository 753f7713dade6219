#!/usr/bin/env python3
"""Includes follow the arrows between rooms (CONTRIBUTING.md): a room uses those that it names here, and none of those
that use it.

    tests/rooms/test_arrows.py            fails where an include runs against the arrows, or round in a circle
    tests/rooms/test_arrows.py --table    prints files, lines and the includes of other rooms, room by room
"""

import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Rooms of the house, and the folders of each, from those that use none to those that use most. Files that stand in a
# room beside its folders may use these and be used by them, as long as no circle comes of it.
USES = {
    "runtime": [],
    "runtime/grid": [],
    "runtime/data": ["runtime/grid"],
    "runtime/graph": ["runtime/grid", "runtime/data"],
    "runtime/ranks": ["runtime/grid"],
    "runtime/warehouse": ["runtime/data", "runtime/graph", "runtime/ranks"],
    "runtime/execute": ["runtime/graph", "runtime/ranks", "runtime/warehouse"],
    "runtime/profile": ["runtime/data", "runtime/graph", "runtime/ranks", "runtime/execute"],
    "runtime/storage": ["runtime/grid", "runtime/data", "runtime/graph", "runtime/ranks", "runtime/warehouse"],
    "components": [],
    "components/boundary": [],
    "components/curves": [],
    "components/kinematics": [],
    "components/rigid": [],
    "components/shapes": [],
    "components/geometry": ["components/curves"],
    "components/moduli": ["components/curves"],
    "components/materials": ["components/curves", "components/moduli"],
    "components/transfers": ["components/shapes"],
    "components/anti_locking": ["components/kinematics", "components/shapes"],
    "components/contact": ["components/geometry", "components/shapes"],
    "components/loads": ["components/shapes", "components/materials"],
    "components/problems": ["components/curves", "components/geometry", "components/materials"],
    "tasks": ["runtime", "components"],
    "tasks/phases": [],
    "tasks/set_up": [],
    "tasks/report": ["tasks/phases"],
    "tasks/forecast": ["tasks/set_up", "tasks/report"],
    "tools": ["runtime", "components", "tasks"],
    "tools/system": [],
    "tools/scene": ["tools/system"],
    "tools/scene/files": [],
    "tools/scene/json": ["tools/scene/files"],
    "tools/scene/tables": ["tools/scene/files", "tools/scene/json"],
    "tools/scene/materials": ["tools/scene/files", "tools/scene/json", "tools/scene/tables"],
    "tools/scene/bodies": ["tools/scene/files", "tools/scene/json"],
    "tools/scene/keys": ["tools/scene/json", "tools/scene/materials"],
    "tools/advice": ["tools/scene"],
    "tools/run": ["tools/system", "tools/scene", "tools/advice"],
    "tools/study": ["tools/system", "tools/scene", "tools/advice", "tools/run"],
    "tools/bench": ["tools/system", "tools/scene"],
    "tools/commands": ["tools/system", "tools/scene", "tools/advice", "tools/run", "tools/study", "tools/bench"],
}
ROOMS = [room for room in USES if "/" not in room]
INCLUDE = re.compile(r'^#\s*include "([^"]+)"', re.MULTILINE)


def rooms_of(path):
    """The room of a file, the folder there that it is in, and the folder in that."""
    parts = path.split("/")
    return [room for room in ("/".join(parts[:n]) for n in (1, 2, 3)) if room in USES]


def includes():
    """(from, to) for every include, as paths of files."""
    for room in ROOMS:
        for file in sorted((ROOT / room).rglob("*.?pp")):
            for included in INCLUDE.findall(file.read_text()):
                yield str(file.relative_to(ROOT)), included


def arrows():
    """(from, to): the includes, as pairs of files, between different rooms of the house or folders of one room."""
    found = collections.defaultdict(list)
    for path, included in includes():
        for start, end in zip(rooms_of(path), rooms_of(included)):
            if start != end:
                found[start, end].append((path, included))
                break
    return found


def place_of(path):
    """The innermost room of a file; the file itself, as .hpp and .cpp alike, where it stands beside folders."""
    room = (rooms_of(path) or [""])[-1]
    has_folders = any(other.startswith(room + "/") for other in USES)
    return str(pathlib.PurePath(path).with_suffix("")) if has_folders else room


def circles():
    """Folders of a room, and files beside them, that include each other, as a list of those in each circle."""
    used = collections.defaultdict(set)
    for path, included in includes():
        start, end = place_of(path), place_of(included)
        if start != end:
            used[start].add(end)
    reached = {}
    for start in list(used):
        seen, front = set(), [start]
        while front:
            new = used[front.pop()] - seen
            seen |= new
            front.extend(new)
        reached[start] = seen
    in_circles = [a for a in reached if a in reached[a]]
    return {tuple(b for b in sorted(in_circles) if b in reached[a] and a in reached[b]) for a in in_circles}


def print_table(found):
    for room, uses in USES.items():
        files = [f for f in (ROOT / room).rglob("*.?pp")]
        n_lines = sum(len(f.read_text().splitlines()) for f in files)
        counts = ", ".join(f"{end} {len(found[room, end])}" for end in uses if found[room, end])
        print(f"{room:24} {len(files):4} files {n_lines:6} lines   includes of {counts or 'no other room'}")


def main():
    found = arrows()
    if "--table" in sys.argv[1:]:
        print_table(found)
    against = [pair for (start, end), pairs in found.items() if end not in USES[start] for pair in pairs]
    for path, included in against:
        print(f"{path}: includes {included}, against the arrows between rooms")
    in_circles = circles()
    for circle in in_circles:
        print(f"{', '.join(circle)} include each other")
    homeless = {path for path, _ in includes() if path.count("/") > len(rooms_of(path)) and place_of(path) not in USES}
    homeless |= {f"tools/{file.name}" for file in (ROOT / "tools").glob("*.?pp")}
    for path in sorted(homeless):
        print(f"{path}: lies in no room")
    sys.exit(1 if against or in_circles or homeless else 0)


if __name__ == "__main__":
    main()
