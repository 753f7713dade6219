"""The strip above the axes, where failed runs stand with the reason beside them."""

from math import inf
from typing import NamedTuple

from matplotlib.ticker import NullLocator

from tamp.charts.axes import ROW, fitted, text_width
from tamp.charts.picture import Place
from tamp.charts.chart_spec import share_across, x_limits
from tamp.charts.theme import LIGHT

MOST_GROUPS = 7  # with more failed points those that ended alike share a text
ROUGH_MARGINS = 80  # beside the axes, before it is known how wide they come out


class Group(NamedTuple):
    """Failed points that one text is about."""

    points: list
    text: str


def groups_of_failed(spec):
    groups = [Group([p], p.why) for p in spec.failed()]
    for alike in (lambda p: p.why, lambda p: p.ended):
        if len(groups) > MOST_GROUPS:
            groups = grouped(spec.failed(), alike)
    return groups


def grouped(points, alike):
    groups = {}
    for p in points:
        groups.setdefault(alike(p), []).append(p)
    counts = {text: f" ({len(members)} runs)" if len(members) > 1 else "" for text, members in groups.items()}
    return [Group(members, text + counts[text]) for text, members in groups.items()]


def rows_of(spec, drawn, groups, layout):
    """The rows of each group. A point has its text beside it, in a row where both meet no others; several points have
    theirs in a row of its own above them."""
    taken, rows = [], []
    for group in groups:
        if len(group.points) > 1:
            rows.append([len(taken), len(taken) + 1])
            taken += [[(-inf, inf)], [(-inf, inf)]]
            continue
        low, high = extent(spec, drawn, group, layout)
        row = next((r for r, spans in enumerate(taken) if all(high < a or b < low for a, b in spans)), len(taken))
        taken += [[]] if row == len(taken) else []
        taken[row].append((low, high))
        rows.append([row])
    return rows


def n_rows(rows):
    return max((row[-1] + 1 for row in rows), default=0)


def extent(spec, drawn, group, layout):
    """Where a group begins and ends along the axis, in points."""
    width = layout.width - ROUGH_MARGINS
    x = share_across(spec, group.points[0], x_limits(spec, drawn)) * width
    text = 26 + min(text_width(group.text, layout.font - 1), max(x, width - x))
    return (x - 10, x + text) if x < width / 2 else (x - text, x + 10)


def draw_failed(spec, sheet, groups, rows):
    """Gives the places of the points."""
    if not groups:
        return []
    strip, limits = sheet.failed, sheet.axis.get_xlim()
    strip.set(xscale="log", xlim=limits, ylim=(0, sheet.failed_height), xticks=[], yticks=[])
    strip.xaxis.set_minor_locator(NullLocator())
    strip.spines["bottom"].set_visible(False)
    strip.patch.set(visible=True, facecolor=LIGHT["failed"])
    places = []
    for group, row in zip(groups, rows):
        heights = [sheet.failed_height - 4 - ROW * (r + 0.5) for r in row]
        places += draw_group(spec, sheet, group, heights, limits)
    return places


def draw_group(spec, sheet, group, heights, limits):
    xs, y = [spec.across.of(p) if spec.has_place(p) else limits[0] for p in group.points], heights[-1]
    for point, x in zip(group.points, xs):
        colour = spec.study.styles[point.method].colour
        sheet.failed.plot([x], [y], marker="x", ms=6.5, mew=2, color=colour, clip_on=False, gid=f"failed-{point.id}")
    if len(heights) > 1:
        write(sheet, group.text, (limits[0], heights[0]), True, sheet.failed.bbox.width - 12)
    else:
        share = share_across(spec, group.points[0], limits)
        write(sheet, group.text, (xs[0], y), share < 0.5, max(share, 1 - share) * sheet.failed.bbox.width - 12)
    return [Place(point.id, *sheet.share(sheet.failed, x, y)) for point, x in zip(group.points, xs)]


def write(sheet, text, at, to_right, room):
    font = sheet.layout.font - 1
    sheet.failed.annotate(fitted(text, room, font), at, (8 if to_right else -8, -4), textcoords="offset points",
                          ha="left" if to_right else "right", size=font, color=LIGHT["ink"])
