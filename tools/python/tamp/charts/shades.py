"""Colours of a quantity: a scale between round numbers, squares in its colours, and the bar that shows it."""

import io
from typing import NamedTuple

import matplotlib
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from PIL import Image

from tamp.charts.axes import set_ticks
from tamp.charts.formatting import si_text
from tamp.charts.over_time import round_limits
from tamp.charts.raster import NOBODY

VOID, BODY, BORDER = range(3)  # what squares show beside levels
N_LEVELS = 29
BODY_COLOUR, BORDER_COLOUR = "#8f959f", "#17181a"
QUIET = 0.005  # the share of squares that may be beyond either end of a scale
LEAST_SPAN = 0.02  # of a scale of densities, so that its labels differ
# Neither as dark as a dark page nor as bright as a bright one.
SEQUENTIAL = LinearSegmentedColormap.from_list("little-much", matplotlib.colormaps["viridis"](np.linspace(0.17, 0.96)))
SIGNED = LinearSegmentedColormap.from_list("less-more", ["#d0560a", "#e39a55", "#b4b9c2", "#6d9be0", "#1c56b8"])
FOOT = 46  # of a sheet, for the bar


class Scale(NamedTuple):
    low: float
    high: float
    unit: str
    is_signed: bool

    def text(self, value):
        return si_text(value, self.unit)

    def levels(self, values):
        """From 0 to N_LEVELS - 1; what is beyond the ends has their colours."""
        share = (values - self.low) / (self.high - self.low)
        return np.clip(np.floor(share * N_LEVELS), 0, N_LEVELS - 1)

    def colours(self):
        share = (np.arange(N_LEVELS) + 0.5) / N_LEVELS
        if not self.is_signed:
            return SEQUENTIAL(share)
        values = self.low + share * (self.high - self.low)
        return SIGNED(0.5 + 0.5 * values / max(-self.low, self.high))

    def palette(self):
        """Red, green, blue and opacity of all that a square can show."""
        fixed = [(0, 0, 0, 0), *(matplotlib.colors.to_rgba(colour) for colour in (BODY_COLOUR, BORDER_COLOUR))]
        return np.round(255 * np.vstack([fixed, self.colours()])).astype(np.uint8)


def scale_of(quantity, values):
    """A few squares may be beyond its ends, so that one particle does not make all others look alike."""
    is_signed = quantity.field == "plastic_volumetric"
    low, high = (float(v) for v in np.quantile(values, [QUIET, 1 - QUIET])) if len(values) else (0, 1)
    if quantity.field != "density":
        low, high = min(low, 0), max(high, 0)
        low = 0 if low > -0.05 * high else low
        high = 0 if high < 0.05 * -low else high
    least = LEAST_SPAN * max(abs(low), abs(high)) if quantity.field == "density" else 0
    if high - low > least:
        return Scale(*round_limits(low, high), quantity.unit, is_signed)
    middle, around = (low + high) / 2, least / 2 or 1e-3
    return Scale(0 if middle == 0 and not is_signed else middle - around, middle + around, quantity.unit, is_signed)


def indices(frame, field, scale, rigid=()):
    """Indices into the palette; rows from above, as in picture files. `rigid` are the numbers of such materials."""
    values = frame.value[field]
    level = np.where(np.isfinite(values), scale.levels(np.nan_to_num(values)) + BORDER + 1, BODY)
    shown = np.where(frame.kind == NOBODY, VOID, level).astype(np.uint8)
    shown[borders(np.where(np.isin(frame.kind, rigid), NOBODY, frame.kind))] = BORDER
    return shown[::-1]


def borders(kind):
    """Squares beside those of another material; of rigid ones the colour is border enough."""
    found = np.zeros(kind.shape, bool)
    for here, there in [(np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])]:
        found[here] |= (kind[here] != kind[there]) & (kind[here] != NOBODY) & (kind[there] != NOBODY)
    return found


def png(shown, scale):
    """As small as it gets: colours of a palette."""
    image, file = Image.fromarray(shown, "P"), io.BytesIO()
    image.putpalette(scale.palette()[:, :3].tobytes())
    image.save(file, format="PNG", optimize=True, transparency=VOID)
    return file.getvalue()


def draw_bar(sheet, scale, left):
    """At the foot of a sheet."""
    bar = sheet.add_axes(left, FOOT - 16, sheet.layout.width - left - 34, 9)
    bar.imshow(scale.palette()[None, BORDER + 1:], aspect="auto", extent=(scale.low, scale.high, 0, 1),
               interpolation="none")
    bar.set_yticks([])
    bar.spines["left"].set_visible(False)
    set_ticks(bar, "x", (scale.low, scale.high), scale.text, logarithmic=False)
    bar.grid(False)
