"""The history of a run by names without units, and when what pushed hardest."""

import math
import re
from typing import NamedTuple

import numpy as np

from tamp import files
from tamp.charts.formatting import is_number, si_text
from tamp.charts.over_time import Line

COLUMN = re.compile(r"(?P<name>[^\[]*)\[(?P<unit>[^\]]*)\]")


class History:
    """Columns of a history, by names without units."""

    def __init__(self, path):
        names, rows = files.written_table(path)
        found = [COLUMN.fullmatch(name) for name in names]
        self.units = {m["name"] if m else name: m["unit"] if m else "" for m, name in zip(found, names)}
        self.columns = dict(zip(self.units, map(list, zip(*rows)))) if rows else {name: [] for name in self.units}

    def ending(self, ending):
        """Beginnings of the names of columns with an ending: `punch` of `punch.depth` for `depth`."""
        return [name[: -len(ending) - 1] for name in self.columns if name.endswith("." + ending)]

    def line(self, label, y, x="time"):
        """Without what is no number, such as the depth of a body that has left the domain."""
        known = [(a, b) for a, b in zip(self.columns[x], self.columns[y]) if is_number(a) and is_number(b)]
        return Line(label, [a for a, _ in known], [b for _, b in known])


def axes_of_force(scene, summary):
    """Those along which a force is one on the whole body: neither what goes away from the axis of an axisymmetric scene
    nor, across a plane of symmetry, what the other side of it takes away."""
    if scene is not None and scene.get("axisymmetric"):
        return "y"
    planes = ((summary or {}).get("part_of_whole") or {}).get("planes", [])  # such as x-; older runs do not say
    return "".join(axis for axis in "xyz" if axis not in {plane[:1] for plane in planes})


def force(history, body, axes="xyz"):
    """The size of the force that others put on a body, by rows."""
    parts = [history.columns[f"{body}.contact_force_{axis}"] for axis in axes
             if f"{body}.contact_force_{axis}" in history.columns]
    return [math.hypot(*row) for row in zip(*parts)]


def is_plane(scene):
    return scene is not None and scene["dimension"] == 2 and not scene.get("axisymmetric")


class Moment(NamedTuple):
    """When something was greatest, a "force" or a "pressure", in words too; `line` is it over time."""

    kind: str
    time: float
    text: str
    name: str
    unit: str
    line: Line

    def at(self, time):
        """How large it is at another time."""
        return float(np.interp(time, self.line.x, self.line.y))


def greatest(history, scene, materials, axes="xyz"):
    """When the contact force on a body was greatest, or else the largest p of some materials; None of neither."""
    unit = "N/m" if is_plane(scene) else "N"
    names = list(dict.fromkeys(name for axis in "xyz" for name in history.ending(f"contact_force_{axis}")))
    forces = [("force", f"contact force on {name}", unit, force(history, name, axes)) for name in names]
    stresses = [("pressure", f"largest p of {name}", "Pa", history.columns[f"{name}.p_max"]) for name in materials
                if f"{name}.p_max" in history.columns]
    for found in (forces, stresses):
        moments = [moment for moment in (moment_of(history, *one) for one in found) if moment]
        if moments:
            return max(moments, key=lambda moment: max(moment.line.y))
    return None


def moment_of(history, kind, name, unit, values):
    """None where there is nothing above 0."""
    known = [(a, b) for a, b in zip(history.columns["time"], values) if is_number(a) and is_number(b)]
    line = Line(name, [a for a, _ in known], [b for _, b in known])
    value, time = max(zip(line.y, (-x for x in line.x)), default=(0, 0))  # the first of equal ones
    if not value > 0:
        return None
    adjective = "greatest " if kind == "force" else ""
    text = f"the {adjective}{name}, {si_text(value, unit)} at {si_text(-time, 's')}"
    return Moment(kind, -time, text, name, unit, line)
