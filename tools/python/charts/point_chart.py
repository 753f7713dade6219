"""The error of one quantity against something that each point has, such as its cost: what its charts have in common."""

from math import log
from typing import Callable, NamedTuple

from matplotlib.ticker import NullLocator

from charts.axes import ROW, Entry, Sheet, fitted, has_labels_beside, log_limits, marker_style, set_ticks, text_width, wrapped
from charts.chart import Table, make_chart
from charts.picture import Place
from charts.theme import LIGHT, Style
from charts.words import counted

MOST_REASONS = 7  # rows of failed points; more share a row


class Across(NamedTuple):
    """What is on the x axis."""

    name: str
    of: Callable  # of a point; None where it has none
    text: Callable  # of a value
    ticks_at_values: bool = False


class Plan(NamedTuple):
    """A chart, before it is drawn."""

    study: object
    quantity: object
    across: Across
    lines: list  # [(method, label, points in order)]
    front: list  # points, or None where the chart has no front
    guides: list = ()  # straight lines over x: [(method, [x], [y])]


class Drawn(NamedTuple):
    """The points that can be drawn, and how high: on a logarithmic axis an error of 0 stands at its lower end."""

    points: list
    y: dict
    zeros: list
    limits: tuple


def up(plan, point):
    return point.error(plan.quantity) if plan.quantity.has_reference else point.value(plan.quantity)


def drawable(plan):
    points = [p for p in plan.study.points if not p.failed and up(plan, p) is not None and has_place(plan, p)]
    if not plan.quantity.has_reference:
        values = [up(plan, p) for p in points] or [0, 1]
        pad = 0.08 * (max(values) - min(values)) or 0.1 * abs(values[0]) or 1
        return Drawn(points, {p.id: up(plan, p) for p in points}, [], (min(values) - pad, max(values) + pad))
    errors = [abs(up(plan, p)) for p in points]
    positive = [error for error in errors if error > 0]
    limits = log_limits(positive) if positive else (1e-6, 1)
    uncertainty = shown_uncertainty(plan.quantity, limits)
    if uncertainty:
        limits = min(limits[0], uncertainty / 3), max(limits[1], uncertainty * 1.5)
    if len(positive) < len(errors):
        limits = limits[0] / 3, limits[1]
    return Drawn(points, {p.id: abs(up(plan, p)) or limits[0] for p in points}, [p for p in points if up(plan, p) == 0], limits)


def shown_uncertainty(quantity, limits):
    """None where it lies far below the points, as it then limits nothing."""
    uncertainty = quantity.uncertainty
    return uncertainty if uncertainty and uncertainty > limits[0] / 30 else None


def has_place(plan, point):
    x = plan.across.of(point)
    return x is not None and x > 0


def failed_points(plan):
    """Those with no place along the axis stand at its left end."""
    return [p for p in plan.study.points if p.failed]


def x_limits(plan, drawn):
    values = [plan.across.of(p) for p in [*drawn.points, *failed_points(plan)] if has_place(plan, p)]
    return log_limits(values) if values else (0.1, 10)


# --- drawing -----------------------------------------------------------------------------------------------------------


def draw(plan, title, layout):
    drawn, styles = drawable(plan), plan.study.styles
    groups = groups_of_failed(plan, layout)
    rows = edge_rows(plan, drawn, groups, layout)
    lines = [(m, label, [p for p in points if p in drawn.points]) for m, label, points in plan.lines]
    lines = [line for line in lines if line[2]]
    labelled = ends_of_lines(plan, lines)
    labels = [label for _, label in labelled]
    sheet = Sheet(layout, title, y_label(plan), plan.across.name, legend(plan, drawn, labelled, layout), labels, 1 + max(rows) if rows else 0)
    axis = sheet.axis
    set_axes(plan, drawn, axis)
    draw_uncertainty(plan, drawn, sheet)
    draw_front(plan, drawn, axis)
    for method, xs, ys in plan.guides:
        axis.plot(xs, ys, color=styles[method].colour, lw=1, ls=(0, (1, 2)), zorder=1.5)
    for method, _, points in lines:
        xy = [plan.across.of(p) for p in points], [drawn.y[p.id] for p in points]
        axis.plot(*xy, color=styles[method].colour, lw=1.6, ls=styles[method].dashes, alpha=0.75, zorder=2)
    places = [draw_point(plan, drawn, sheet, point) for point in drawn.points]
    places += draw_edge(plan, sheet, groups, rows)
    if sheet.labels:
        sheet.label_lines([((plan.across.of(end), drawn.y[end.id]), label, styles[method])
                           for (method, label), end in labelled.items()])  # fmt: skip
    if not drawn.points:
        axis.text(0.5, 0.5, "no run has a result here", transform=axis.transAxes, ha="center", color=LIGHT["faint"], size=layout.font)
    return sheet, places


def y_label(plan):
    name = plan.quantity.name
    if plan.quantity.has_reference:
        return f"error of {name}" + (" (of the reference)" if plan.quantity.relative else "")
    return f"{name}, without a reference"


def set_axes(plan, drawn, axis):
    values = sorted({plan.across.of(p) for p in drawn.points + failed_points(plan) if has_place(plan, p)})
    at_values = plan.across.ticks_at_values and 0 < len(values) <= 6
    set_ticks(axis, "x", x_limits(plan, drawn), plan.across.text, ticks=values if at_values else None)
    if plan.quantity.has_reference:
        set_ticks(axis, "y", drawn.limits, lambda tick: plan.quantity.error_text(tick, 2))
    else:
        set_ticks(axis, "y", drawn.limits, plan.quantity.value_text, logarithmic=False)


def draw_uncertainty(plan, drawn, sheet):
    uncertainty = plan.quantity.has_reference and shown_uncertainty(plan.quantity, drawn.limits)
    if not uncertainty:
        return
    sheet.axis.axhspan(drawn.limits[0], uncertainty, color=LIGHT["band"], zorder=0, lw=0)
    sheet.axis.axhline(uncertainty, color=LIGHT["faint"], lw=0.8, ls=(0, (2, 2)), zorder=0.5)
    words = f"the reference itself is uncertain by {plan.quantity.error_text(uncertainty, 2)}: points in the band cannot be told from it"
    box = sheet.axis.get_position()
    lines = wrapped(words, 0.96 * box.width * sheet.layout.width, sheet.layout.font - 1)
    for k, line in enumerate(reversed(lines)):
        sheet.axis.annotate(line, (0, 0), (6, 5 + 13 * k), xycoords="axes fraction", textcoords="offset points",
                            size=sheet.layout.font - 1, color=LIGHT["faint"], zorder=0.6)  # fmt: skip


def draw_front(plan, drawn, axis):
    """From each point of the front what it reaches at its cost and beyond, until the next is better."""
    front = sorted((p for p in plan.front or [] if p in drawn.points), key=plan.across.of)
    if front:
        xs, ys = [plan.across.of(p) for p in front], [drawn.y[p.id] for p in front]
        axis.plot(xs, ys, color=LIGHT["front"], lw=5, drawstyle="steps-post", zorder=1)


def draw_point(plan, drawn, sheet, point):
    x, y = plan.across.of(point), drawn.y[point.id]
    pale = plan.front is not None and point not in plan.front and plan.quantity.has_reference
    size = 6.5 if pale else 7.5
    sheet.axis.plot([x], [y], zorder=3 if pale else 4, gid=f"point-{point.id}" + ("-front" if point in (plan.front or []) else ""),
                    **marker_style(plan.study.styles[point.method], size, pale))  # fmt: skip
    return Place(point.id, *sheet.share(sheet.axis, x, y))


def ends_of_lines(plan, lines):
    """The last point of each label; several lines of a method may have the same."""
    ends = {}
    for method, label, points in lines:
        known = [ends[method, label]] if (method, label) in ends else []
        ends[method, label] = max([*known, *points], key=plan.across.of)
    return ends


def legend(plan, drawn, labelled, layout):
    entries = []
    if not has_labels_beside(layout, labelled):
        entries = [Entry(label, plan.study.styles[method]) for method, label in labelled]
    if any(p in drawn.points for p in plan.front or []):
        entries.append(Entry("Pareto front: no run is both cheaper and better", Style(LIGHT["front"]), line_width=5))
    if plan.guides:
        entries.append(Entry("fit of the order", Style(LIGHT["faint"], dashes=(0, (1, 2))), line_width=1))
    return entries


# --- the edge, where failed points stand ---------------------------------------------------------------------------------


class Group(NamedTuple):
    """Failed points that one text is about."""

    points: list
    text: str


def groups_of_failed(plan, layout):
    failed = failed_points(plan)
    each = [Group([p], p.why) for p in failed]
    if len(failed) > MOST_REASONS:
        reasons = dict.fromkeys(p.why for p in failed)
        each = [Group([p for p in failed if p.why == why], why) for why in reasons]
    if len(each) > MOST_REASONS:
        words = dict.fromkeys(p.ended for p in failed)
        each = [Group([p for p in failed if p.ended == ended], ended) for ended in words]
    return [g if len(g.points) == 1 else Group(g.points, f"{g.text} ({len(g.points)} runs)") for g in each]


def edge_rows(plan, drawn, groups, layout):
    """The row of each group, where its texts and points meet no others."""
    taken, rows = [], []
    for group in groups:
        low, high = extent(plan, drawn, group, layout)
        row = next((r for r, spans in enumerate(taken) if all(high < a or b < low for a, b in spans)), len(taken))
        if row == len(taken):
            taken.append([])
        taken[row].append((low, high))
        rows.append(row)
    return rows


def extent(plan, drawn, group, layout):
    """Rough places along the axis, in points, before it is known how wide the axes come out."""
    width = layout.width - 80
    limits = x_limits(plan, drawn)
    xs = [share_across(plan, p, limits) * width for p in group.points]
    to_right = max(xs) < width / 2
    text = 26 + min(text_width(group.text, layout.font - 1), width - max(xs) if to_right else min(xs))
    return (min(xs) - 10, max(xs) + text) if to_right else (min(xs) - text, max(xs) + 10)


def share_across(plan, point, limits):
    if not has_place(plan, point):
        return 0
    return log(plan.across.of(point) / limits[0]) / log(limits[1] / limits[0])


def draw_edge(plan, sheet, groups, rows):
    if not groups:
        return []
    edge, font, places = sheet.edge, sheet.layout.font - 1, []
    limits = sheet.axis.get_xlim()
    edge.set(xscale="log", xlim=limits, ylim=(0, sheet.edge_height), xticks=[], yticks=[])
    edge.xaxis.set_minor_locator(NullLocator())
    edge.spines["bottom"].set_visible(False)
    edge.patch.set(visible=True, facecolor=LIGHT["edge"])
    for group, row in zip(groups, rows):
        y = sheet.edge_height - 4 - ROW * (row + 0.5)
        xs = {p.id: plan.across.of(p) if has_place(plan, p) else limits[0] for p in group.points}
        for point in group.points:
            style = Style(plan.study.styles[point.method].colour, "x")
            edge.plot([xs[point.id]], [y], marker="x", markersize=6.5, markeredgewidth=2, color=style.colour, clip_on=False,
                      gid=f"failed-{point.id}")  # fmt: skip
            places.append(Place(point.id, *sheet.share(edge, xs[point.id], y)))
        to_right = max(share_across(plan, p, limits) for p in group.points) < 0.5
        beside = max(xs.values()) if to_right else min(xs.values())
        across = edge.transAxes.inverted().transform(edge.transData.transform((beside, y)))[0]
        room = (1 - across if to_right else across) * edge.bbox.width - 12
        edge.annotate(fitted(group.text, room, font), (beside, y), (8 if to_right else -8, -4),
                      textcoords="offset points", ha="left" if to_right else "right", size=font, color=LIGHT["ink"])  # fmt: skip
    return places


# --- in words ------------------------------------------------------------------------------------------------------------


def up_text(plan, value):
    return plan.quantity.error_text(value) if plan.quantity.has_reference else plan.quantity.value_text(value)


def describe(plan):
    drawn, failed = drawable(plan), failed_points(plan)
    said = [f"{counted(len(drawn.points), 'point')} of {counted(len({p.method for p in drawn.points}), 'method')}."]
    if drawn.points and plan.quantity.has_reference:
        best = min(drawn.points, key=lambda p: (abs(up(plan, p)), plan.across.of(p)))
        said.append(f"The least error, {up_text(plan, abs(up(plan, best)))}, has {best.name} at {plan.across.text(plan.across.of(best))}.")
    for point in sorted((p for p in plan.front or [] if p in drawn.points), key=plan.across.of):
        said.append(f"On the Pareto front: {point.name}, {plan.across.text(plan.across.of(point))}, {up_text(plan, up(plan, point))}.")
    uncertainty = plan.quantity.has_reference and plan.quantity.uncertainty
    if uncertainty:
        within = [p for p in drawn.points if abs(up(plan, p)) <= uncertainty]
        said.append(f"The reference itself is uncertain by {up_text(plan, uncertainty)}; {counted(len(within), 'point lies', 'points lie')} within that.")
    if drawn.zeros:
        said.append(f"{counted(len(drawn.zeros), 'error')} of 0 at the lower edge.")
    said += [f"No result: {p.name}, {p.why}." for p in failed]
    return " ".join(said)


def caption(plan, about):
    drawn = drawable(plan)
    words = [about]
    if plan.quantity.has_reference and plan.quantity.uncertainty and not shown_uncertainty(plan.quantity, drawn.limits):
        words.append(f"The reference's own uncertainty, {plan.quantity.error_text(plan.quantity.uncertainty)}, lies below the chart.")
    if drawn.zeros:
        words.append("An error of 0 stands at the lower edge.")
    if failed_points(plan):
        words.append("Crosses above the axes are runs without a result, with the reason.")
        if any(not has_place(plan, p) for p in failed_points(plan)):
            words.append("Where nothing is known of them along the axis they stand at its left end.")
    left_out = [p for p in plan.study.points if not p.failed and p not in drawn.points]
    if left_out:
        words.append(f"{counted(len(left_out), 'run has', 'runs have')} no place here, as a figure is missing.")
    return " ".join(words)


def table(plan):
    head = ["method", "settings", plan.across.name, f"error of {plan.quantity.name}" if plan.quantity.has_reference else plan.quantity.name]
    if plan.front is not None:
        head.append("Pareto front")
    rows = []
    for p in plan.study.points:
        x, y = plan.across.of(p), up(plan, p)
        row = [p.method, p.label, plan.across.text(x) if x is not None else "–", p.why if p.failed else up_text(plan, y) if y is not None else "–"]
        rows.append(row + (["yes" if p in plan.front else ""] if plan.front is not None else []))
    return Table([*head], rows)


def make(plan, name, title, about):
    return make_chart(name, title, describe(plan), caption(plan, about), table(plan), lambda layout: draw(plan, title, layout))
