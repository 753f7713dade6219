"""Pictures of a run's particles: which material is where, and how fast it is, in squares."""

import math
from typing import NamedTuple

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from tamp.charts.axes import (
    NARROW, RIGHT, Entry, Sheet, linear_ticks, room_for_last_tick, room_for_ticks, set_ticks,
)
from tamp.charts.chart import Table, make_chart
from tamp.charts.formatting import counted, percent_text, si_text
from tamp.charts.over_time import HALF
from tamp.charts.theme import LIGHT, N_LEVELS, Style, hue, level

NOBODY = -1
MOST_HEIGHT = 420


class View(NamedTuple):
    """Squares, rows from below; `kinds` has a number into `names` for each, or NOBODY."""

    title: str
    axes: list
    size: float
    kinds: np.ndarray
    names: list
    colours: list
    materials: np.ndarray  # whose borders are drawn
    caption: str


def views(data):
    """Pictures of the first output and of the last one, and of the speeds in the last, where these are known."""
    pictures = data["pictures"]
    made = [of_materials(picture, data["materials"]) for picture in pictures]
    speeds = of_speeds(pictures[-1]) if pictures else None
    return made + ([speeds] if speeds else [])


def squares(picture, what):
    width, height = picture["n"]
    return np.array([NOBODY if value is None else value for value in picture[what]], float).reshape(height, width)


def caption(picture):
    slab = picture["slab"]
    return f"Particles within half a cell of {slab['axis']} = {si_text(slab['at'], 'm')}." if slab else ""


def of_materials(picture, names):
    kinds = squares(picture, "materials").astype(int)
    time = si_text(picture["time_s"], "s")
    return View(f"The particles at {time}", picture["axes"], picture["size"], kinds, names,
                [hue(k, k // 6) for k in range(len(names))], kinds, caption(picture))


def of_speeds(picture):
    """In classes that end at round numbers; the fastest few may be beyond the last of them."""
    speeds, materials = squares(picture, "speeds"), squares(picture, "materials").astype(int)
    known = speeds[speeds >= 0]
    top = float(np.quantile(known, 0.998)) if known.size else 0
    if not top > 0:
        return None
    ends = classes(top)
    kinds = np.where(speeds >= 0, np.minimum(np.digitize(speeds, ends[1:]), len(ends) - 2), NOBODY)
    names = [f"{si_text(a, 'm/s')} to {si_text(b, 'm/s')}" for a, b in zip(ends, ends[1:])]
    if known.max() > ends[-1]:
        names[-1] = f"{si_text(ends[-2], 'm/s')} and more"
    colours = [level(round(k * (N_LEVELS - 1) / max(len(names) - 1, 1))) for k in range(len(names))]
    return View(f"Speed at {si_text(picture['time_s'], 's')}", picture["axes"], picture["size"], kinds, names, colours,
                materials, caption(picture))


def classes(top):
    ticks = linear_ticks(0, top, N_LEVELS - 1)
    return ticks + [2 * ticks[-1] - ticks[-2]] if ticks[-1] < top * (1 - 1e-9) else ticks


# --- the drawing ---


def chart(view, name):
    return make_chart(name, view.title, describe(view), view.caption, table(view), lambda layout: draw(view, layout),
                      (HALF, NARROW))


def plane_sheet(layout, title, axes, legend, foot=0):
    """A plane as large as there is room for, both ways alike."""
    across, up = ((axis["lower"], axis["upper"]) for axis in axes)
    left = room_for_ticks(up, metres, False)
    most = layout.width - left - room_for_last_tick(across, metres, layout.width - left - RIGHT, layout.font)
    scale = min(most / (across[1] - across[0]), MOST_HEIGHT / (up[1] - up[0]))
    width, height = scale * (across[1] - across[0]), max(scale * (up[1] - up[0]), 40)
    sheet = Sheet(layout, title, axes[1]["name"], axes[0]["name"], legend, height=height, left=left, foot=foot,
                  right=layout.width - left - width)
    few = linear_ticks(*up, min(height / 30, 7))
    for which, limits, ticks in [("x", across, None), ("y", up, few)]:
        set_ticks(sheet.axis, which, limits, metres, logarithmic=False, ticks=ticks)
        sheet.axis.grid(False, axis=which)
    return sheet


def metres(value):
    return si_text(value, "m")


def draw(view, layout):
    shown = sorted(set(view.kinds.ravel().tolist()) - {NOBODY})
    legend = [Entry(view.names[k], Style(view.colours[k]), filled=True) for k in shown]
    sheet = plane_sheet(layout, view.title, view.axes, legend)
    lower = np.array([axis["lower"] for axis in view.axes])
    for k in shown:
        path = outline(view.kinds, k, lower, view.size)
        # A thin line closes the gaps that browsers leave between neighbours.
        sheet.axis.add_patch(PathPatch(path, facecolor=view.colours[k], edgecolor=view.colours[k], lw=0.3,
                                       gid=f"kind-{k}"))
    draw_borders(view, sheet.axis, lower)
    if not shown:
        sheet.say_empty("no particle here")
    return sheet, []


def rectangles(kinds, kind):
    """(row, end row, column, end column) of all squares of a kind: runs, joined with those below of the same ends."""
    made, growing = [], {}
    for row in range(len(kinds) + 1):
        runs = runs_of(kinds[row] == kind) if row < len(kinds) else []
        for run in [run for run in growing if run not in runs]:
            made.append((growing.pop(run), row, *run))
        for run in runs:
            growing.setdefault(run, row)
    return made


def runs_of(belongs):
    ends = np.flatnonzero(np.diff(np.concatenate([[False], belongs, [False]]).astype(int)))
    return [(int(a), int(b)) for a, b in zip(ends[::2], ends[1::2])]


def outline(kinds, kind, lower, size):
    corners, codes = [], []
    for row, end_row, column, end_column in rectangles(kinds, kind):
        corners += [(column, row), (end_column, row), (end_column, end_row), (column, end_row), (column, row)]
        codes += [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    return Path(lower + size * np.array(corners, float), codes)


def draw_borders(view, axis, lower):
    """Around all materials but the one that there is most of, in pictures of something else."""
    if view.kinds is view.materials:
        return
    rows, columns = view.materials.shape
    x = lower[0] + view.size * (np.arange(-1, columns + 1) + 0.5)
    y = lower[1] + view.size * (np.arange(-1, rows + 1) + 0.5)
    numbers, n_squares = np.unique(view.materials[view.materials != NOBODY], return_counts=True)
    for material in numbers[np.argsort(n_squares)[:-1]]:
        inside = np.pad((view.materials == material).astype(float), 1)
        axis.contour(x, y, inside, levels=[0.5], colors=[LIGHT["ink"]], linewidths=0.9)


# --- the words ---


def ranges(view, kind):
    rows, columns = np.nonzero(view.kinds == kind)
    for axis, places in zip(view.axes, (columns, rows)):
        low, high = axis["lower"] + view.size * places.min(), axis["lower"] + view.size * (places.max() + 1)
        yield f"{si_text(round_to(low, view.size), 'm')} to {si_text(round_to(high, view.size), 'm')}"


def round_to(value, size):
    """Rounds to 0 what is less than half a square from 0."""
    return 0 if abs(value) < size / 2 or not math.isfinite(value) else float(value)


def covered(view):
    all_known = np.count_nonzero(view.kinds != NOBODY)
    for k in sorted(set(view.kinds.ravel().tolist()) - {NOBODY}):
        yield k, np.count_nonzero(view.kinds == k) / all_known


def describe(view):
    first, second = (axis["name"] for axis in view.axes)
    n = len(list(covered(view)))
    sentences = [f"{view.title}, {first} across and {second} upwards: {counted(n, 'colour')}."]
    for k, share in covered(view):
        across, up = ranges(view, k)
        sentences.append(f"{view.names[k]}: {percent_text(share, 2)} of the area drawn, {first} from {across}, "
                         f"{second} from {up}.")
    return " ".join(sentences)


def table(view):
    return Table(["", "share of the area drawn", *(axis["name"] for axis in view.axes)],
                 [[view.names[k], percent_text(share, 2), *ranges(view, k)] for k, share in covered(view)])
