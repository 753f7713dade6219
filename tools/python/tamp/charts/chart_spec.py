"""The content of a chart of points: the error of a quantity against something that points have."""

from math import log
from typing import Callable, NamedTuple

from tamp.charts.axes import log_limits


class Across(NamedTuple):
    """The quantity on the x axis."""

    name: str
    of: Callable  # value of a point; None where it has none
    text: Callable  # text of a value
    ticks_at_values: bool = False


class ChartSpec(NamedTuple):
    study: object
    quantity: object
    across: Across
    lines: list  # [(method, label, points in order)]
    front: list  # points, or None where the chart has no front
    guides: list = ()  # straight lines over x: [(method, [x], [y])]

    def up(self, point):
        """The error, or the value where there is no reference; None where there is neither."""
        return point.error(self.quantity) if self.quantity.has_reference else point.value(self.quantity)

    def up_text(self, value):
        return self.quantity.error_text(value) if self.quantity.has_reference else self.quantity.value_text(value)

    def has_place(self, point):
        x = self.across.of(point)
        return x is not None and x > 0

    def failed(self):
        return self.study.failed_in_charts()

    def left_out(self, drawn):
        return [p for p in self.study.charted if not p.failed and p not in drawn.points]


class Drawn(NamedTuple):
    """The points that can be drawn, and how high: on a logarithmic axis an error of 0 stands at its lower end."""

    points: list
    y: dict
    zeros: list
    limits: tuple  # of the y axis


def drawable(spec):
    points = [p for p in spec.study.charted if not p.failed and spec.up(p) is not None and spec.has_place(p)]
    if not spec.quantity.has_reference:
        return Drawn(points, {p.id: spec.up(p) for p in points}, [], limits_of_values([spec.up(p) for p in points]))
    errors = {p.id: abs(spec.up(p)) for p in points}
    limits = limits_of_errors(list(errors.values()), spec.quantity)
    zeros = [p for p in points if errors[p.id] == 0]
    return Drawn(points, {number: error or limits[0] for number, error in errors.items()}, zeros, limits)


def limits_of_values(values):
    low, high = min(values, default=0), max(values, default=1)
    pad = 0.08 * (high - low) or 0.1 * abs(low) or 1
    return low - pad, high + pad


def limits_of_errors(errors, quantity):
    positive = [error for error in errors if error > 0]
    limits = log_limits(positive) if positive else (1e-6, 1)
    uncertainty = shown_uncertainty(quantity, limits)
    if uncertainty:
        limits = min(limits[0], uncertainty / 3), max(limits[1], uncertainty * 1.5)
    return (limits[0] / 3, limits[1]) if len(positive) < len(errors) else limits


def shown_uncertainty(quantity, limits):
    """The reference's uncertainty; None where it lies far below the points, as it then limits nothing."""
    uncertainty = quantity.uncertainty if quantity.has_reference else None
    return uncertainty if uncertainty and uncertainty > limits[0] / 30 else None


def x_limits(spec, drawn):
    values = [spec.across.of(p) for p in [*drawn.points, *spec.failed()] if spec.has_place(p)]
    return log_limits(values) if values else (0.1, 10)


def share_across(spec, point, limits):
    """A point's share of the x axis; failed points that have no place on it stand at its left end."""
    return log(spec.across.of(point) / limits[0]) / log(limits[1] / limits[0]) if spec.has_place(point) else 0
