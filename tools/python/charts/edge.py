"""The edge above the axes, where failed points stand with the reason beside them."""

from typing import NamedTuple

from matplotlib.ticker import NullLocator

from charts.axes import ROW, fitted, text_width
from charts.picture import Place
from charts.plan import share_across, x_limits
from charts.theme import LIGHT

MOST_GROUPS = 7  # with more failed points those that ended alike share a text
ROUGH_MARGINS = 80  # beside the axes, before it is known how wide they come out


class Group(NamedTuple):
    """Failed points that one text is about."""

    points: list
    text: str


def groups_of_failed(plan):
    groups = [Group([p], p.why) for p in plan.failed()]
    for alike in (lambda p: p.why, lambda p: p.ended):
        if len(groups) > MOST_GROUPS:
            groups = grouped(plan.failed(), alike)
    return groups


def grouped(points, alike):
    groups = {}
    for p in points:
        groups.setdefault(alike(p), []).append(p)
    return [Group(members, f"{text} ({len(members)} runs)" if len(members) > 1 else text) for text, members in groups.items()]


def rows_of(plan, drawn, groups, layout):
    """The row of each group, where its text and points meet no others."""
    taken, rows = [], []
    for group in groups:
        low, high = extent(plan, drawn, group, layout)
        row = next((r for r, spans in enumerate(taken) if all(high < a or b < low for a, b in spans)), len(taken))
        taken += [[]] if row == len(taken) else []
        taken[row].append((low, high))
        rows.append(row)
    return rows


def extent(plan, drawn, group, layout):
    """Where a group begins and ends along the axis, in points."""
    width = layout.width - ROUGH_MARGINS
    xs = [share_across(plan, p, x_limits(plan, drawn)) * width for p in group.points]
    text = 26 + min(text_width(group.text, layout.font - 1), width - max(xs) if max(xs) < width / 2 else min(xs))
    return (min(xs) - 10, max(xs) + text) if max(xs) < width / 2 else (min(xs) - text, max(xs) + 10)


def draw_edge(plan, sheet, groups, rows):
    """Gives the places of the points."""
    if not groups:
        return []
    edge, limits = sheet.edge, sheet.axis.get_xlim()
    edge.set(xscale="log", xlim=limits, ylim=(0, sheet.edge_height), xticks=[], yticks=[])
    edge.xaxis.set_minor_locator(NullLocator())
    edge.spines["bottom"].set_visible(False)
    edge.patch.set(visible=True, facecolor=LIGHT["edge"])
    places = []
    for group, row in zip(groups, rows):
        places += draw_group(plan, sheet, group, sheet.edge_height - 4 - ROW * (row + 0.5), limits)
    return places


def draw_group(plan, sheet, group, y, limits):
    xs = [plan.across.of(p) if plan.has_place(p) else limits[0] for p in group.points]
    for point, x in zip(group.points, xs):
        colour = plan.study.styles[point.method].colour
        sheet.edge.plot([x], [y], marker="x", ms=6.5, mew=2, color=colour, clip_on=False, gid=f"failed-{point.id}")
    write_reason(sheet, group.text, y, max(share_across(plan, p, limits) for p in group.points) < 0.5, xs)
    return [Place(point.id, *sheet.share(sheet.edge, x, y)) for point, x in zip(group.points, xs)]


def write_reason(sheet, text, y, to_right, xs):
    """On the side with more room."""
    edge, font = sheet.edge, sheet.layout.font - 1
    beside = max(xs) if to_right else min(xs)
    across = edge.transAxes.inverted().transform(edge.transData.transform((beside, y)))[0]
    room = (1 - across if to_right else across) * edge.bbox.width - 12
    edge.annotate(fitted(text, room, font), (beside, y), (8 if to_right else -8, -4), textcoords="offset points",
                  ha="left" if to_right else "right", size=font, color=LIGHT["ink"])  # fmt: skip
