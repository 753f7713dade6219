#!/usr/bin/env python3
"""Includes follow the arrows between rooms (CONTRIBUTING.md): a room uses those that it names here, and none of those
that use it.

    tests/rooms/test_arrows.py            fails where an include runs against the arrows
    tests/rooms/test_arrows.py --table    prints files, lines and the includes of other rooms, room by room
"""

import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Rooms of the house, and the folders of a room that has arrows inside, from those that use none to those that use most.
USES = {
    "runtime": [],
    "components": [],
    "tasks": ["runtime", "components"],
    "tools": ["runtime", "components", "tasks"],
    "tools/system": [],
    "tools/scene": ["tools/system"],
    "tools/run": ["tools/system", "tools/scene"],
    "tools/study": ["tools/system", "tools/scene", "tools/run"],
    "tools/bench": ["tools/system", "tools/scene"],
    "tools/commands": ["tools/system", "tools/scene", "tools/run", "tools/study", "tools/bench"],
}
INCLUDE = re.compile(r'^#\s*include "([^"]+)"', re.MULTILINE)


def rooms_of(path):
    """The room of a file and, where that has arrows inside, its folder there."""
    parts = path.split("/")
    return [room for room in (parts[0], "/".join(parts[:2])) if room in USES]


def arrows():
    """(from, to): the includes, as pairs of files, between different rooms of the house or folders of one room."""
    found = collections.defaultdict(list)
    for room in ("runtime", "components", "tasks", "tools"):
        for file in sorted((ROOT / room).rglob("*.?pp")):
            path = str(file.relative_to(ROOT))
            for included in INCLUDE.findall(file.read_text()):
                for start, end in zip(rooms_of(path), rooms_of(included)):
                    if start != end:
                        found[start, end].append((path, included))
                        break
    return found


def print_table(found):
    for room, uses in USES.items():
        files = [f for f in (ROOT / room).rglob("*.?pp")]
        n_lines = sum(len(f.read_text().splitlines()) for f in files)
        counts = ", ".join(f"{end} {len(found[room, end])}" for end in uses if found[room, end])
        print(f"{room:16} {len(files):4} files {n_lines:6} lines   includes of {counts or 'no other room'}")


def main():
    found = arrows()
    if "--table" in sys.argv[1:]:
        print_table(found)
    against = [pair for (start, end), pairs in found.items() if end not in USES[start] for pair in pairs]
    for path, included in against:
        print(f"{path}: includes {included}, against the arrows between rooms")
    homeless = [f for f in (ROOT / "tools").rglob("*.?pp") if len(rooms_of(str(f.relative_to(ROOT)))) < 2]
    for file in homeless:
        print(f"{file.relative_to(ROOT)}: lies in no room of tools")
    sys.exit(1 if against or homeless else 0)


if __name__ == "__main__":
    main()
