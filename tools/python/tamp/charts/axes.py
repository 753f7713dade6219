"""Axes with room for what stands around them. All lengths are points, which a page draws as its pixels."""

import math
import textwrap
from typing import NamedTuple

from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.textpath import TextToPath
from matplotlib.ticker import FixedFormatter, FixedLocator, NullFormatter, NullLocator

from tamp.charts import theme
from tamp.charts.theme import LIGHT


class Layout(NamedTuple):
    """How large a chart is on a wide or on a narrow page."""

    name: str
    width: float
    height: float  # of the axes
    font: float
    labels_beside: bool  # lines are labelled at their ends where there are few of them


WIDE = Layout("wide", 720, 310, 11.5, True)
NARROW = Layout("narrow", 328, 270, 11, False)
RIGHT = 14
ROW = 17  # of a legend, and of failed points
MOST_LABELS_BESIDE = 9
LABEL_GAP = 26

_measure = TextToPath()


def text_width(text, size, weight="normal"):
    width, _, _ = _measure.get_text_width_height_descent(text, FontProperties(size=size, weight=weight), False)
    return width


def fitted(text, width, size):
    """Cut to a width, with an ellipsis."""
    if text_width(text, size) <= width:
        return text
    low, high = 1, len(text)  # characters that fit, and that do not
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if text_width(text[:middle] + "…", size) <= width else (low, middle)
    return text[:low].rstrip() + "…"


def wrapped(text, width, size, weight="normal"):
    n_most = max(int(width / max(text_width(text, size, weight) / max(len(text), 1), 1)), 8)
    return textwrap.wrap(text, n_most) or [""]


class Entry(NamedTuple):
    """An entry of a legend: a stretch of line with its marker, or a filled box."""

    text: str
    style: theme.Style
    filled: bool = False
    hatch: str = ""
    line_width: float = 1.8


class Sheet:
    """A figure with a title, what is on the y axis in words, one pair of axes, and a legend below them. Above the axes
    is a strip of `n_failed_rows` rows, for failed runs, which have no place within them; `foot` is left free below, and
    `right` beside them, where no labels stand."""

    def __init__(self, layout, title, y_label, x_label, legend=(), labels=(), n_failed_rows=0, height=None, left=14,
                 foot=0, right=RIGHT):
        self.layout, font = layout, layout.font
        self.tips = {}  # texts under the mouse, by the gid of what is drawn
        self.labels = list(labels) if has_labels_beside(layout, labels) else []
        beside = max((text_width(fitted(text, 190, font), font) for text in self.labels), default=0)
        right = LABEL_GAP + beside + 18 if self.labels else right
        titles = wrapped(title, layout.width - 12, font + 1, "bold")
        y_labels = wrapped(y_label, layout.width - 12, font) if y_label else []
        rows = legend_rows(legend, layout.width - 12, font)
        x_labels = wrapped(x_label, layout.width - left - RIGHT, font)
        top = 8 + 16 * len(titles) + 15 * len(y_labels) + 10
        bottom = 20 + 15 * len(x_labels) + 8 + ROW * len(rows) + (6 if rows else 0) + foot
        self.failed_height = ROW * n_failed_rows + (8 if n_failed_rows else 0)
        inner = height or layout.height
        self.height = top + self.failed_height + inner + bottom
        self.figure = Figure(figsize=(layout.width / 72, self.height / 72), dpi=72, facecolor=LIGHT["paper"])
        width = layout.width - left - right

        self.under = self.add_axes(0, 0, layout.width, self.height)
        self.under.set(xlim=(0, layout.width), ylim=(0, self.height))
        self.under.axis("off")
        self.under.set_zorder(5)
        self.axis = self.add_axes(left, bottom, width, inner)
        self.failed = self.add_axes(left, bottom + inner, width, self.failed_height) if n_failed_rows else None
        y = self.height - 8
        for line in titles:
            y -= 16
            self.text(6, y + 3, line, weight="bold", size=font + 1)
        for line in y_labels:
            y -= 15
            self.text(6, y + 2, line, color=LIGHT["faint"])
        y = bottom - 20
        for line in x_labels:
            y -= 15
            self.text(left + width / 2, y + 3, line, color=LIGHT["faint"], ha="center")
        self.draw_legend(rows, y - 8)

    def add_axes(self, x, y, width, height):
        across, up = self.layout.width, self.height
        axis = self.figure.add_axes([x / across, y / up, width / across, height / up])
        axis.patch.set_visible(False)
        for side in ["top", "right"]:
            axis.spines[side].set_visible(False)
        for side in ["left", "bottom"]:
            axis.spines[side].set(color=LIGHT["faint"], linewidth=0.8)
        axis.tick_params(labelsize=self.layout.font - 0.5, colors=LIGHT["faint"], labelcolor=LIGHT["ink"], width=0.8)
        axis.tick_params(which="minor", length=2, colors=LIGHT["faint"], width=0.6)
        axis.set_axisbelow(True)
        return axis

    def text(self, x, y, text, **how):
        how = {"size": self.layout.font, "color": LIGHT["ink"], **how}
        return self.under.text(x, y, text, **how)

    def draw_legend(self, rows, y):
        for row in rows:
            y -= ROW
            for x, entry in row:
                draw_sample(self.under, x, y + 4, entry)
                self.text(x + 32, y, fitted(entry.text, self.layout.width - 50, self.layout.font))

    def label_lines(self, ends):
        """Labels beside the axes, as far up as the ends of their lines in data, but never one over another."""
        box = self.axis.get_position()
        x = box.x1 * self.layout.width
        low, high = box.y0 * self.height + 4, box.y1 * self.height
        places = [self.in_points(*end) for end, _, _ in ends]
        heights = apart([place[1] for place in places], 15, low, high)
        for (_, text, style), (from_x, from_y), y in zip(ends, places, heights):
            self.under.plot([from_x, x + 6, x + LABEL_GAP - 8], [from_y, y, y], color=style.colour, lw=0.7, alpha=0.5)
            if style.marker:
                self.under.plot([x + LABEL_GAP - 2], [y], **marker_style(style, 6))
            self.text(x + LABEL_GAP + 6, y - 4, fitted(text, 190, self.layout.font))

    def say_empty(self, text):
        self.axis.annotate(text, (0.5, 0.5), xycoords="axes fraction", ha="center", color=LIGHT["faint"],
                           size=self.layout.font)

    def in_points(self, x, y):
        """From the data of the axes to points from the lower left corner of the figure."""
        return tuple(self.axis.transData.transform((x, y)))

    def share(self, axis, x, y):
        """From the data of an axis to shares from the upper left corner."""
        across, up = axis.transData.transform((x, y))
        return across / self.layout.width, 1 - up / self.height


def marker_style(style, size, pale=False):
    face = LIGHT["paper"] if pale else style.colour
    return {"marker": style.marker, "markersize": size, "color": style.colour, "markerfacecolor": face,
            "linestyle": "none", "markeredgecolor": style.colour if pale else LIGHT["paper"],
            "markeredgewidth": 1.2 if pale else 0.6,
            "alpha": 0.55 if pale else None, "clip_on": False}


def has_labels_beside(layout, labels):
    return layout.labels_beside and 0 < len(labels) <= MOST_LABELS_BESIDE


def draw_sample(axis, x, y, entry):
    if entry.filled:
        face = LIGHT["paper"] if entry.hatch else entry.style.colour
        axis.fill([x + 4, x + 26, x + 26, x + 4], [y - 5, y - 5, y + 5, y + 5], facecolor=face,
                  edgecolor=entry.style.colour, hatch=entry.hatch, lw=0.8)
        return
    if entry.style.dashes != "":
        axis.add_line(Line2D([x, x + 27], [y, y], color=entry.style.colour, ls=entry.style.dashes, lw=entry.line_width))
    if entry.style.marker:
        axis.plot([x + 13.5], [y], **marker_style(entry.style, 6.5))


def legend_rows(entries, width, font):
    rows, x = [], 0
    for entry in entries:
        wanted = 32 + min(text_width(entry.text, font), width - 32) + 18
        if not rows or x + wanted - 18 > width:
            rows.append([])
            x = 0
        rows[-1].append((8 + x, entry))
        x += wanted
    return rows


def apart(heights, gap, low, high):
    """Heights moved as little as it takes for neighbours to be a gap apart, within the bounds where they fit."""
    order = sorted(range(len(heights)), key=lambda k: heights[k])
    groups = []  # of neighbours that touch: [sum of wanted lowest heights, members]
    for k in order:
        groups.append([heights[k], [k]])
        while len(groups) > 1 and lowest(groups[-2], gap) + gap * len(groups[-2][1]) > lowest(groups[-1], gap):
            wanted, members = groups.pop()
            groups[-1][0] += wanted - gap * len(groups[-1][1]) * len(members)
            groups[-1][1] += members
    placed = list(heights)
    y = low
    for group in groups:
        y = max(y, lowest(group, gap))
        for member in group[1]:
            placed[member] = y
            y += gap
    y = high
    for k in reversed(order):
        y = min(y, placed[k])
        placed[k] = y
        y -= gap
    return placed


def lowest(group, gap):
    wanted, members = group
    return wanted / len(members)


def log_limits(values, least_decades=0.9):
    """A little wider than the values, all above 0."""
    low, high = (math.log10(f(values)) for f in (min, max))
    pad = max(0.06 * (high - low), (least_decades - (high - low)) / 2, 0.08)
    return 10 ** (low - pad), 10 ** (high + pad)


def log_ticks(low, high, n_most=7):
    """Labelled ticks and those between. Powers of ten; 1, 2 and 5 of them where there are few."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    decades = [10.0**e for e in range(first, last + 1)]
    fine = [m * d for d in decades for m in (1, 2, 5)]
    inside = [tick for tick in fine if low <= tick <= high]
    between = [m * d for d in decades for m in range(2, 10) if low <= m * d <= high]
    if len(inside) <= n_most:
        return inside, between
    inside = [tick for tick in decades if low <= tick <= high]
    every = math.ceil(len(inside) / n_most)
    return inside[::every], between if every == 1 else inside


def linear_ticks(low, high, n_wanted=6):
    """Round numbers within the range, 1, 2 or 5 times a power of ten apart."""
    wanted = (high - low) / n_wanted
    decade = 10.0 ** math.floor(math.log10(wanted))
    spacing = next(step * decade for step in (1, 2, 5, 10) if step * decade >= wanted * (1 - 1e-9))
    first, last = math.ceil(low / spacing - 1e-9), math.floor(high / spacing + 1e-9)
    return [k * spacing for k in range(first, last + 1)]


def room_for_ticks(limits, text, logarithmic):
    """How wide the labels of the y axis are, with the margins beside them."""
    ticks = log_ticks(*limits)[0] if logarithmic else linear_ticks(*limits, 7)
    return 16 + max([text_width(text(tick), WIDE.font) for tick in ticks], default=30)


def room_for_last_tick(limits, text, width, size):
    """How wide a margin half of a label wants that stands where axes of about this width end."""
    low, high = limits
    lasts = {linear_ticks(low, high, n)[-1] for n in range(1, 8)}
    beyond = [text_width(text(tick), size) / 2 - (high - tick) / (high - low) * width for tick in lasts]
    return max(RIGHT, max(beyond) + 3)


def have_room(axis, ticks, text):
    """Whether the labels of ticks on the x axis stand clear of each other."""
    places = [axis.transData.transform((tick, 1))[0] for tick in ticks]
    halves = [text_width(text(tick), WIDE.font) / 2 for tick in ticks]
    return all(b - a > half_a + half_b + 6 for a, b, half_a, half_b in zip(places, places[1:], halves, halves[1:]))


def set_ticks(axis, which, limits, text, logarithmic=True, ticks=None):
    """`text` says a tick's value; `ticks` are the values to stand at instead of round ones."""
    one = axis.xaxis if which == "x" else axis.yaxis
    (axis.set_xscale if which == "x" else axis.set_yscale)("log" if logarithmic else "linear")
    (axis.set_xlim if which == "x" else axis.set_ylim)(limits)
    for n_most in range(7, 1 if logarithmic else 0, -1):
        major, minor = log_ticks(*limits, n_most) if logarithmic else (linear_ticks(*limits, n_most), [])
        if ticks is not None:
            major, minor = ticks[:: 1 + (7 - n_most)], []
        if which == "y" or have_room(axis, major, text):
            break
    one.set_major_locator(FixedLocator(major))
    one.set_major_formatter(FixedFormatter([text(tick) if tick else "0" for tick in major]))
    one.set_minor_locator(FixedLocator(minor) if minor else NullLocator())
    one.set_minor_formatter(NullFormatter())
    axis.grid(True, axis=which, color=LIGHT["rule"], linewidth=0.8)
