"""Charts of points: what those of error against cost, against what is refined and against the cost of a step share."""

from tamp.charts.axes import Entry, Sheet, has_labels_beside, marker_style, room_for_ticks, set_ticks, wrapped
from tamp.charts.chart import make_chart
from tamp.charts.failed_runs import draw_failed, groups_of_failed, n_rows, rows_of
from tamp.charts.picture import Place
from tamp.charts.chart_spec import drawable, shown_uncertainty, x_limits
from tamp.charts.theme import LIGHT, Style
from tamp.charts.descriptions import caption, describe, table

MOST_TICKS_AT_VALUES = 6


def make(spec, name, title, about):
    description = describe(spec), caption(spec, about), table(spec)
    return make_chart(name, title, *description, lambda layout: draw(spec, title, layout))


def draw(spec, title, layout):
    """The sheet, and the places of its points."""
    drawn, groups = drawable(spec), groups_of_failed(spec)
    rows = rows_of(spec, drawn, groups, layout)
    lines = [(method, label, [p for p in points if p in drawn.points]) for method, label, points in spec.lines]
    lines = [line for line in lines if line[2]]
    ends = ends_of_lines(spec, lines)
    labels = [label for _, label in ends]
    sheet = Sheet(layout, title, y_label(spec), spec.across.name, legend(spec, drawn, ends, layout), labels,
                  n_rows(rows), left=room_for_ticks(drawn.limits, y_text(spec), spec.quantity.has_reference))
    set_axes(spec, drawn, sheet.axis)
    draw_uncertainty(spec, drawn, sheet)
    draw_front(spec, drawn, sheet.axis)
    draw_lines(spec, drawn, lines, sheet.axis)
    places = [draw_point(spec, drawn, sheet, point) for point in drawn.points]
    places += draw_failed(spec, sheet, groups, rows)
    if sheet.labels:
        sheet.label_lines([((spec.across.of(end), drawn.y[end.id]), label, spec.study.styles[method])
                           for (method, label), end in ends.items()])
    if not drawn.points:
        sheet.say_empty("no run has a result here")
    return sheet, places


def distance_of(quantity):
    """The name, in a title, of the distances from a quantity's reference."""
    return f"Error of {quantity.name}" if quantity.has_bound else f"Difference in {quantity.name}"


def y_label(spec):
    if not spec.quantity.has_reference:
        return f"{spec.quantity.name}, without a reference"
    if not spec.quantity.has_bound:
        which = "the finest run" if spec.quantity.reference["kind"] == "finest" else "one run"
        return f"difference from {which}, which is no error"
    return f"error of {spec.quantity.name}" + (" (of the reference)" if spec.quantity.relative else "")


def set_axes(spec, drawn, axis):
    values = sorted({spec.across.of(p) for p in drawn.points + spec.failed() if spec.has_place(p)})
    at_values = spec.across.ticks_at_values and 0 < len(values) <= MOST_TICKS_AT_VALUES
    set_ticks(axis, "x", x_limits(spec, drawn), spec.across.text, ticks=values if at_values else None)
    set_ticks(axis, "y", drawn.limits, y_text(spec), logarithmic=spec.quantity.has_reference)


def y_text(spec):
    if not spec.quantity.has_reference:
        return spec.quantity.value_text
    return lambda tick: spec.quantity.error_text(tick, 2)


def draw_uncertainty(spec, drawn, sheet):
    uncertainty = shown_uncertainty(spec.quantity, drawn.limits)
    if not uncertainty:
        return
    sheet.axis.axhspan(drawn.limits[0], uncertainty, color=LIGHT["band"], zorder=0, lw=0, gid="band")
    sheet.axis.axhline(uncertainty, color=LIGHT["faint"], lw=0.8, ls=(0, (2, 2)), zorder=0.5)
    text = f"the reference itself is uncertain by {spec.quantity.error_text(uncertainty, 2)}: "
    text += "points in the band cannot be told from it"
    font = sheet.layout.font - 1
    for k, line in enumerate(reversed(wrapped(text, 0.96 * sheet.axis.bbox.width, font))):
        sheet.axis.annotate(line, (0, 0), (6, 5 + 13 * k), xycoords="axes fraction", textcoords="offset points",
                            size=font, color=LIGHT["faint"], zorder=0.6)


def draw_front(spec, drawn, axis):
    """From each point of the front what it reaches at its cost and beyond, until the next is better."""
    front = sorted((p for p in spec.front or [] if p in drawn.points), key=spec.across.of)
    if front:
        xs, ys = [spec.across.of(p) for p in front], [drawn.y[p.id] for p in front]
        axis.plot(xs, ys, color=LIGHT["front"], lw=5, drawstyle="steps-post", zorder=1, gid="pareto-line")


def draw_lines(spec, drawn, lines, axis):
    for method, xs, ys in spec.guides:
        axis.plot(xs, ys, color=spec.study.styles[method].colour, lw=1, ls=(0, (1, 2)), zorder=1.5)
    for method, _, points in lines:
        style = spec.study.styles[method]
        xs, ys = [spec.across.of(p) for p in points], [drawn.y[p.id] for p in points]
        axis.plot(xs, ys, color=style.colour, lw=1.6, ls=style.dashes, alpha=0.75, zorder=2)


def draw_point(spec, drawn, sheet, point):
    """Pale where the chart has a front that the point is not on."""
    x, y = spec.across.of(point), drawn.y[point.id]
    on_front = point in (spec.front or [])
    pale = spec.front is not None and not on_front and spec.quantity.has_reference
    style = marker_style(spec.study.styles[point.method], 6.5 if pale else 7.5, pale)
    name = f"point-{point.id}" + ("-front" if on_front else "")
    sheet.axis.plot([x], [y], zorder=3 if pale else 4, gid=name, **style)
    return Place(point.id, *sheet.share(sheet.axis, x, y))


def ends_of_lines(spec, lines):
    """The last point of each label; several lines of a method may have the same."""
    ends = {}
    for method, label, points in lines:
        known = [ends[method, label]] if (method, label) in ends else []
        ends[method, label] = max([*known, *points], key=spec.across.of)
    return ends


def legend(spec, drawn, ends, layout):
    entries = []
    if not has_labels_beside(layout, ends):
        entries = [Entry(label, spec.study.styles[method]) for method, label in ends]
    if any(p in drawn.points for p in spec.front or []):
        entries.append(Entry("Pareto front: no run is both cheaper and better", Style(LIGHT["front"]), line_width=5))
    if spec.guides:
        entries.append(Entry("fit of the order", Style(LIGHT["faint"], dashes=(0, (1, 2))), line_width=1))
    return entries
