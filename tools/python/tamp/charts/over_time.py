"""Lines over time, or over something else, one for each of a few things that are compared."""

import math
from typing import NamedTuple

import numpy as np

from tamp.charts.axes import (
    NARROW, RIGHT, Entry, Layout, Sheet, linear_ticks, log_limits, log_ticks, room_for_last_tick, room_for_ticks,
    set_ticks,
)
from tamp.charts.chart import Table, make_chart
from tamp.charts.theme import DASHES, HUES, LIGHT, MARKERS, Style, hue
from tamp.charts.formatting import counted, si_text

HALF = Layout("half", 480, 240, 11.5, False)  # two of them beside each other
N_POINTS, N_ROWS, N_MARKERS = 400, 10, 7
# A blow is what is more than three times as high as the curve on nine tenths of its way; of an axis that it goes beyond
# the curve fills two thirds.
BLOW, PART_OF_WAY, ROOM = 3, 0.9, 1.5
SLACK = 0.1  # of the way between two ticks, by which a curve may go beyond the last one


class Line(NamedTuple):
    name: str
    x: list
    y: list
    breaks_off: bool = False  # marked with a cross at its end


class Plot(NamedTuple):
    """Numbers in SI units, x of each line ascending; y above 0 on a logarithmic axis."""

    title: str
    y_name: str
    y_unit: str
    lines: list
    logarithmic: bool = False
    x_name: str = "time"
    x_unit: str = "s"
    through_blow: bool = False  # a short blow may go beyond the axis, which then shows the curve after it


def style_of(k):
    """No two of a dozen have the same colour, or the same dashes and marker."""
    turn = k // len(HUES)
    return Style(hue(k, turn), MARKERS[turn - 1] if turn else "", DASHES[k % len(DASHES)])


def chart(plot, name):
    layouts = (HALF, NARROW)
    return make_chart(name, plot.title, describe(plot), caption(plot), table(plot), lambda layout: draw(plot, layout),
                      layouts)


def draw(plot, layout):
    legend = [Entry(line.name, style_of(k)) for k, line in enumerate(plot.lines)]
    x_limits, x_text = (0, end_of(plot) or 1), lambda tick: si_text(tick, plot.x_unit)
    left = room_for_ticks(y_limits(plot), lambda tick: si_text(tick, plot.y_unit), plot.logarithmic)
    sheet = Sheet(layout, plot.title, plot.y_name, plot.x_name, legend, left=left,
                  right=room_for_last_tick(x_limits, x_text, layout.width - left - RIGHT, layout.font))
    set_ticks(sheet.axis, "x", x_limits, x_text, logarithmic=False)
    set_ticks(sheet.axis, "y", y_limits(plot), lambda tick: si_text(tick, plot.y_unit), logarithmic=plot.logarithmic)
    beyond = blows(plot)
    for k, line in enumerate(plot.lines):
        if not line.x:
            continue
        x, y = thinned(line.x, line.y, N_POINTS)
        style, step = style_of(k), max(len(x) // N_MARKERS, 1)
        sheet.axis.plot(x, y, color=style.colour, ls=style.dashes, lw=1.6, gid=f"line-{k}", clip_on=bool(beyond),
                        marker=style.marker, ms=4.5, markevery=(8 * k % step, step))
        if line.breaks_off:
            sheet.axis.plot(x[-1:], y[-1:], marker="x", ms=9, mew=2, color=style.colour, clip_on=False,
                            gid=f"cross-{k}")
    for _, x, y in beyond:
        write_above(sheet, plot, x, y)
    if not any(line.x for line in plot.lines):
        sheet.say_empty("nothing to draw")
    return sheet, []


def end_of(plot):
    return max((line.x[-1] for line in plot.lines if line.x), default=0)


def y_limits(plot):
    low = min((min(line.y) for line in plot.lines if line.y), default=1)
    high = max((highest(plot, line) for line in plot.lines if line.y), default=2)
    if plot.logarithmic:
        low, high = log_limits([low, high], 0.3)
        ticks = log_ticks(low, high)[0]
        return min([low, *ticks]), max([high, *ticks])
    return round_limits(low, high, SLACK)


def round_limits(low, high, slack=0):
    """Round numbers that enclose the values, or go a little beyond such a number where the values do. Zero belongs to
    them unless that would flatten what there is to see."""
    low = 0 if 0 < low < 0.7 * high else low
    high = high if high > low else low + (abs(low) or 1)
    ticks = linear_ticks(low, high, 5)
    spacing = ticks[1] - ticks[0] if len(ticks) > 1 else high - low
    below, above = (beyond if beyond <= slack * spacing else spacing
                    for beyond in (past(-ticks[0], -low), past(ticks[-1], high)))
    return ticks[0] - below, ticks[-1] + above


def past(tick, value):
    """How far a value is above a tick, but for round-off."""
    return value - tick if value - tick > 1e-9 * abs(tick) else 0


def highest(plot, line):
    """Where a line's axis ends: above it, but for a blow."""
    if not plot.through_blow or len(line.x) < 2:
        return max(line.y)
    ways = np.diff(line.x)
    heights = np.maximum(line.y[1:], line.y[:-1])
    order = np.argsort(heights)
    after = float(heights[order][np.searchsorted(np.cumsum(ways[order]), PART_OF_WAY * ways.sum())])
    return ROOM * after if 0 < BLOW * after < max(line.y) else max(line.y)


def blows(plot):
    """Where the axis ends below a line: its name, and where it is highest."""
    end = y_limits(plot)[1] if plot.through_blow else math.inf
    return [(line.name, *max(zip(line.y, line.x))[::-1]) for line in plot.lines
            if line.y and max(line.y) > end * (1 + 1e-9)]


def write_above(sheet, plot, x, y):
    is_left = x < 0.5 * end_of(plot)
    sheet.axis.annotate(f"up to {si_text(y, plot.y_unit)}", (x, y_limits(plot)[1]), (8 if is_left else -8, -10),
                        textcoords="offset points", ha="left" if is_left else "right", annotation_clip=False,
                        size=sheet.layout.font - 0.5, color=LIGHT["ink"])


def caption(plot):
    """Values beyond the axis, in words."""
    return " ".join(f"{name} goes beyond the axis, up to {si_text(y, plot.y_unit)} at a {plot.x_name} of "
                    f"{si_text(x, plot.x_unit)}." for name, x, y in blows(plot))


def thinned(x, y, n_wanted):
    """About that many points, in order: the ends, and of each stretch its lowest and its highest: no peak is lost."""
    if len(x) <= n_wanted:
        return x, y
    kept = {0, len(x) - 1}
    for stretch in np.array_split(np.arange(1, len(x) - 1), n_wanted // 2):
        values = np.asarray(y)[stretch]
        kept |= {int(stretch[values.argmin()]), int(stretch[values.argmax()])}
    return [x[k] for k in sorted(kept)], [y[k] for k in sorted(kept)]


def describe(plot):
    sentences = [f"{counted(len(plot.lines), 'line')} over {si_text(end_of(plot), plot.x_unit)}."]
    for line in plot.lines:
        if not line.x:
            sentences.append(f"{line.name}: nothing to draw.")
            continue
        end = "breaks off" if line.breaks_off else "ends"
        low, high, last = (si_text(y, plot.y_unit) for y in (min(line.y), max(line.y), line.y[-1]))
        after = si_text(line.x[-1], plot.x_unit)
        sentences.append(f"{line.name}: between {low} and {high}, {end} at {last} after {after}.")
    return " ".join(sentences)


def table(plot):
    """At even times, or whatever x is; between points on a straight line."""
    rows = []
    for x in np.linspace(0, end_of(plot), N_ROWS + 1):
        row = [si_text(float(x), plot.x_unit)]
        for line in plot.lines:
            known = line.x and line.x[0] <= x <= line.x[-1] * (1 + 1e-12)
            row.append(si_text(float(np.interp(x, line.x, line.y)), plot.y_unit) if known else "–")
        rows.append(row)
    return Table([plot.x_name, *(line.name for line in plot.lines)], rows)
