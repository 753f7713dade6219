"""One quantity over another, of several runs as lines and of what was measured as points, in a file of its own."""

from typing import NamedTuple

from tamp.charts import picture
from tamp.charts.axes import Entry, Layout, Sheet, linear_ticks, marker_style, room_for_ticks, set_ticks
from tamp.charts.curve import corners, with_room_for_last_tick
from tamp.charts.formatting import counted, si_text
from tamp.charts.over_time import N_MARKERS, SLACK, round_limits, style_of
from tamp.charts.theme import LIGHT, Style

# As wide as a phone shows without making the letters too small to read.
LAYOUT = Layout("file", 480, 290, 11.5, False)
MEASURED = Style(LIGHT["ink"], "o", "")
N_TICKS = 7
MOST_DIGITS = 9


class Curve(NamedTuple):
    name: str
    x: list
    y: list
    is_measured: bool = False


class Plot(NamedTuple):
    x_name: str
    x_unit: str
    y_name: str
    y_unit: str
    curves: list


def content(plot, suffix):
    """The content of the file, .svg or .png."""
    drawn = picture.as_picture(draw(plot).figure, "plot", title(plot), describe(plot), png=suffix == ".png")
    return drawn.png or picture.file_text(drawn).encode()


def title(plot):
    return f"{plot.y_name} over {plot.x_name}"


def draw(plot):
    x_limits, y_limits = (round_limits(*ends([getattr(curve, which) for curve in plot.curves]), SLACK)
                          for which in "xy")
    x_text, y_text = tick_text(x_limits, plot.x_unit), tick_text(y_limits, plot.y_unit)
    legend = [Entry(curve.name, style(plot, curve)) for curve in plot.curves]
    sheet = Sheet(LAYOUT, title(plot), "", plot.x_name, legend, left=room_for_ticks(y_limits, y_text, False))
    set_ticks(sheet.axis, "x", with_room_for_last_tick(x_limits), x_text, logarithmic=False)
    set_ticks(sheet.axis, "y", y_limits, y_text, logarithmic=False)
    for k, curve in enumerate(plot.curves):
        draw_curve(sheet.axis, f"curve-{k}", curve, style(plot, curve))
    return sheet


def ends(lists):
    return min(map(min, lists)), max(map(max, lists))


def style(plot, curve):
    return MEASURED if curve.is_measured else style_of(plot.curves.index(curve))


def tick_text(limits, unit):
    """With as many digits as tell the ticks apart: those of a total energy differ in the fifth."""
    ticks = linear_ticks(*limits, N_TICKS)
    digits = next((n for n in range(3, MOST_DIGITS) if len({si_text(tick, unit, n) for tick in ticks}) == len(ticks)),
                  MOST_DIGITS)
    return lambda value: si_text(value, unit, digits)


def draw_curve(axis, gid, curve, its_style):
    kept = corners(curve.x, curve.y)
    x, y = [curve.x[k] for k in kept], [curve.y[k] for k in kept]
    if curve.is_measured:
        axis.plot(x, y, gid=gid, zorder=3, **marker_style(its_style, 5.5))
        return
    is_point = len(x) == 1
    axis.plot(x, y, color=its_style.colour, ls=its_style.dashes, lw=1.6, gid=gid, clip_on=False, ms=4.5,
              marker="o" if is_point else its_style.marker, markevery=max(len(x) // N_MARKERS, 1))


def describe(plot):
    """The plot in words and numbers, for readers who cannot see it."""
    def between(name, unit, values):
        return f"{name} between {si_text(min(values), unit)} and {si_text(max(values), unit)}"

    sentences = []
    for curve in plot.curves:
        what = counted(len(curve.x), "measured point" if curve.is_measured else "row")
        sentences.append(f"{curve.name}, {what}: {between(plot.x_name, plot.x_unit, curve.x)}, "
                         f"{between(plot.y_name, plot.y_unit, curve.y)}.")
    return " ".join(sentences)
