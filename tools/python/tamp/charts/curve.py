"""A curve of one quantity over another, which both may go back and forth, as in a test with cycles."""

from typing import Callable, NamedTuple

from tamp.charts.axes import NARROW, Entry, Sheet, marker_style, room_for_ticks, set_ticks
from tamp.charts.chart import Table, make_chart
from tamp.charts.over_time import HALF, N_POINTS, N_ROWS, round_limits, thinned
from tamp.charts.theme import Style, hue

ROUND_OFF = 1e-5  # of a quantity's scale: what changes less is drawn as constant
START = Style(hue(1), "o", "")


class Quantity(NamedTuple):
    name: str
    label: str  # with its formula
    values: list
    text: Callable  # of a value, with its unit
    scale: float  # the scale by which its values are large or small; above 0


def chart(name, x, y):
    return make_chart(name, title(x, y), describe(x, y), caption(x, y), table(x, y),
                      lambda layout: (draw(x, y, layout), []), (HALF, NARROW))


def title(x, y):
    name = y.name if len(y.name) == 1 else y.name.capitalize()  # symbols stay as they are
    return f"{name} over {x.name}"


def draw(x, y, layout):
    sheet = Sheet(layout, title(x, y), y.label, x.label, [Entry("start", START)],
                  left=room_for_ticks(limits(y), y.text, False))
    set_ticks(sheet.axis, "x", with_room_for_last_tick(limits(x)), x.text, logarithmic=False)
    set_ticks(sheet.axis, "y", limits(y), y.text, logarithmic=False)
    kept = corners(x.values, y.values)
    sheet.axis.plot([x.values[k] for k in kept], [y.values[k] for k in kept], color=hue(0), lw=1.6, gid="line",
                    clip_on=False)
    sheet.axis.plot(x.values[:1], y.values[:1], gid="start", **marker_style(START, 6.5))
    return sheet


def limits(quantity):
    """Limits of an axis; a quantity that is constant but for round-off, such as an undrained volume, begins at zero."""
    low, high = min(quantity.values), max(quantity.values)
    if not is_constant(quantity):
        return round_limits(low, high)
    return round_limits(min(low, 0), max(high, 0)) if low or high else (0, quantity.scale)


def with_room_for_last_tick(limits):
    """Whose label, such as 400 kPa, is wider than the margin at the right."""
    low, high = limits
    return low, high + 0.06 * (high - low)


def is_constant(quantity):
    return max(quantity.values) - min(quantity.values) <= ROUND_OFF * quantity.scale


def corners(x, y):
    """The numbers of the points to draw: no turn of either quantity is lost."""
    order = range(len(x))
    return sorted({*thinned(order, x, N_POINTS)[0], *thinned(order, y, N_POINTS)[0]})


def caption(x, y):
    if is_constant(y):
        return f"Constant {y.name}: {y.text(y.values[0])}."
    k = max(range(len(y.values)), key=lambda k: y.values[k])
    return f"Largest {y.name}: {y.text(y.values[k])}, at {x.name} {x.text(x.values[k])}."


def describe(x, y):
    def point(k):
        return f"{x.name} {x.text(x.values[k])}, {y.name} {y.text(y.values[k])}"

    return (f"From {point(0)} to {point(-1)}; {y.name} between {y.text(min(y.values))} and {y.text(max(y.values))}, "
            f"{x.name} between {x.text(min(x.values))} and {x.text(max(x.values))}.")


def table(x, y):
    """At even steps through the rows."""
    n = len(x.values) - 1
    shown = sorted({round(n * k / N_ROWS) for k in range(N_ROWS + 1)})
    return Table([x.name, y.name], [[x.text(x.values[k]), y.text(y.values[k])] for k in shown])
