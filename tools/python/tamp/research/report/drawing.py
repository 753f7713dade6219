"""Common parts of all pictures: colours, sizes, captions, particles as squares of their own size."""

import textwrap
from typing import NamedTuple

import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from tamp.charts import theme

COLOURS = {"table": theme.hue(0), "svr": theme.hue(1), "mlp": theme.hue(2)}
FAINT = theme.LIGHT["faint"]
CAPTION_SIZE, DPI = 8.5, 110


class Field(NamedTuple):
    """How a field of the sand is drawn. Limits are in the unit named, which is `per_unit` in SI units."""

    key: str
    title: str
    unit: str
    per_unit: float
    limits: tuple
    logarithmic: bool = False
    colours: str = "viridis"

    def values(self, particles):
        return particles[self.key] / self.per_unit

    @property
    def norm(self):
        return (LogNorm if self.logarithmic else Normalize)(*self.limits)

    @property
    def label(self):
        return f"{self.title} [{self.unit}]" + (", logarithmic" if self.logarithmic else "")


class Album:
    """The pictures of one folder and their captions."""

    def __init__(self, folder):
        self.folder, self.captions = folder, {}
        folder.mkdir(parents=True, exist_ok=True)

    def keep(self, figure, name, caption):
        """`name` is such as 09 or 25a; the caption stands under the picture."""
        caption = caption[:1].upper() + caption[1:]
        title = f"Figure {name.lstrip('0')}. {caption}"
        width, height = figure.get_size_inches()
        lines = textwrap.wrap(title, int(width * 72 / (CAPTION_SIZE * 0.53)))
        room = (len(lines) + 1) * CAPTION_SIZE * 1.35 / 72
        figure.set_size_inches(width, height + room)
        share = room / (height + room)
        layout = figure.get_layout_engine()
        if layout is not None:
            layout.set(rect=(0, share, 1, 1 - share))
        figure.text(0.5, share / 2, "\n".join(lines), ha="center", va="center", size=CAPTION_SIZE)
        figure.savefig(self.folder / f"figure-{name}.png", dpi=DPI, metadata={"Software": None})
        self.captions[name] = caption

    def write_captions(self):
        """Write captions.md; captions of pictures that an earlier call drew are kept."""
        path = self.folder / "captions.md"
        lines = path.read_text().splitlines() if path.exists() else []
        known = dict(line[3:].split(". ", 1) for line in lines if line.startswith("## "))
        known.update(self.captions)
        parts = ["# The counterparts of the report's figures\n"]
        for name, caption in sorted(known.items()):
            parts.append(f"## {name}. {caption}\n\n![figure {name}](figure-{name}.png)\n")
        path.write_text("\n".join(parts))


def panels(n_rows, n_columns, size):
    """(figure, grid of axes), each `size` inches wide and high."""
    whole = (n_columns * size[0], n_rows * size[1])
    figure = Figure(figsize=whole, facecolor=theme.LIGHT["paper"], layout="constrained")
    return figure, figure.subplots(n_rows, n_columns, squeeze=False)


def chart(x_label, y_label, size=(6.4, 4.2)):
    figure, grid = panels(1, 1, size)
    axis = grid[0, 0]
    axis.set_xlabel(x_label)
    axis.set_ylabel(y_label)
    axis.grid(color=theme.LIGHT["rule"], linewidth=0.8)
    axis.set_axisbelow(True)
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)
    return figure, axis


def plain(value, _=None):
    return f"{value:g}"


def three_digits(value):
    return plain(float(f"{value:.3g}"))


def logarithmic(axis, which, linear_below=None):
    """A logarithmic scale with plain numbers at powers of ten; `linear_below` for one that goes on to zero."""
    if linear_below is None:
        axis.set(**{f"{which}scale": "log"})
    else:
        getattr(axis, f"set_{which}scale")("symlog", linthresh=linear_below)
    getattr(axis, f"{which}axis").set_major_formatter(FuncFormatter(plain))
    getattr(axis, f"{which}axis").set_minor_formatter(NullFormatter())


def frame(axis, x, y):
    """Equal scales, and the sizes of what is within."""
    axis.set(xlim=x, ylim=y, aspect="equal", xticks=[], yticks=[])
    for spine in axis.spines.values():
        spine.set(color=FAINT, linewidth=0.6)


def squares(axis, places, side, growth=1.0, **how):
    """Particles as squares of a side in data units, times their growth; after frame(), which sets the scale. They
    overlap a little, so that no background shines through."""
    axis.figure.draw_without_rendering()
    pixels = axis.transData.transform([(0, 0), (side, 0)])
    points = abs(pixels[1, 0] - pixels[0, 0]) * 72 / axis.figure.dpi
    sizes = (1.2 * points * growth) ** 2
    return axis.scatter(places[:, 0], places[:, 1], s=sizes, marker="s", linewidths=0, rasterized=True, **how)


def growth(particles):
    """How much a particle's side has grown, from its change of volume; bounded, as sand may fly apart."""
    return np.clip(np.cbrt(particles["J"]), 0.5, 1.5) if "J" in particles else np.ones(len(particles.position))


def coloured(axis, places, values, sizes, field, side):
    """Largest values on top, so that peaks of single particles are seen."""
    order = np.argsort(values if field.colours == "viridis" else np.abs(values))
    shown = np.clip(values[order], *field.limits)
    return squares(axis, places[order], side, sizes[order], c=shown, cmap=field.colours, norm=field.norm)


def colour_bar(figure, dots, axes, field):
    bar = figure.colorbar(dots, ax=axes, shrink=0.75, pad=0.01, aspect=30)
    bar.set_label(field.label, size=9)
    bar.ax.tick_params(labelsize=8)
    if field.logarithmic:
        bar.set_ticks(LogLocator(subs=(1, 2, 5)).tick_values(*field.limits))
        bar.ax.set_ylim(*field.limits)
        bar.ax.yaxis.set_major_formatter(FuncFormatter(plain))
        bar.ax.yaxis.set_minor_formatter(NullFormatter())
