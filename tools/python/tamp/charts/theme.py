"""Colours and fonts. Drawings are made in the colours of paper; in a page each is a CSS property with a dark twin."""

import itertools
import re
from typing import NamedTuple

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({
    "svg.fonttype": "none", "text.parse_math": False, "font.family": "DejaVu Sans", "path.simplify": False,
    "hatch.linewidth": 1.2, "lines.solid_capstyle": "round", "lines.solid_joinstyle": "round",
})

SURFACES = {
    #         light      dark
    "paper": ("#ffffff", "#15171a"),
    "ink": ("#1c1d1f", "#e4e5e7"),
    "faint": ("#5a5e66", "#a5aab3"),
    "rule": ("#e2e5ea", "#2c3037"),
    "front": ("#c3c8d1", "#4c535f"),  # the Pareto front, wide and behind the points
    "band": ("#edf1f6", "#20252c"),  # the reference's own uncertainty
    "failed": ("#faeee9", "#2d211e"),  # where failed runs stand
}
# The colour-blind can tell them apart: 10 or more of OKLab's hundredths between any two for those who see no red or no
# green, and three times as bright or dark as the page at least.
HUES = [
    ("#0b4fae", "#5aa0ff"), ("#dd5f0a", "#ff9440"), ("#2a9d7c", "#3fd0b0"), ("#9c2452", "#d0648f"),
    ("#5a98e8", "#c3d8ff"), ("#4d4000", "#f0e08a"),
]
N_SHADES = 2
# Ends of a scale of one hue for a quantity, from little to much.
LEVELS = ("#cfe0f5", "#08306b"), ("#27384f", "#cfe4ff")
N_LEVELS = 7
MARKERS = "os^DvPhd<*>p"
DASHES = ["-", (0, (7, 2.5)), (0, (1.5, 2)), (0, (8, 2, 1.5, 2)), (0, (4, 2)), (0, (5, 2, 1.5, 2, 1.5, 2))]
FONT_OF_FILES = "'DejaVu Sans', Verdana, sans-serif"
FONT_OF_PAGES = "system-ui, sans-serif"


def mixed(colour, other, share):
    parts = [(int(colour[i : i + 2], 16), int(other[i : i + 2], 16)) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(a + share * (b - a)):02x}" for a, b in parts)


def all_colours():
    colours = dict(SURFACES)
    for k, hue in enumerate(HUES):
        for shade in range(N_SHADES):
            ends = SURFACES["ink"]
            colours[f"hue-{k}-{shade}"] = tuple(mixed(c, end, 0.4 * shade) for c, end in zip(hue, ends))
    for k in range(N_LEVELS):
        colours[f"level-{k}"] = tuple(mixed(little, much, k / (N_LEVELS - 1)) for little, much in LEVELS)
    return colours


COLOURS = all_colours()
LIGHT = {name: light for name, (light, _) in COLOURS.items()}
NAMES = {light: name for name, light in LIGHT.items()}
assert len(NAMES) == len(LIGHT), "each colour of paper has one name"


def hue(family, shade=0):
    return LIGHT[f"hue-{family % len(HUES)}-{shade % N_SHADES}"]


def level(k):
    return LIGHT[f"level-{k}"]


class Style(NamedTuple):
    """How a line and its points look."""

    colour: str
    marker: str = ""
    dashes: object = "-"


def styles_of_methods(methods):
    """Colour by family, shade within it, and a marker of its own for each method; reference methods are dashed."""
    families, seen, styles = [], {}, {}
    for marker, method in zip(itertools.cycle(MARKERS), methods):
        family = method.get("family") or method["name"]
        if family not in families:
            families.append(family)
        k, shade = families.index(family), seen.get(family, 0)
        seen[family] = shade + 1
        styles[method["name"]] = Style(hue(k, shade), marker, DASHES[1] if method.get("dashed") else "-")
    return styles


def style_sheet():
    def block(twin):
        return "; ".join(f"--{name}: {pair[twin]}" for name, pair in COLOURS.items())

    light = f":root {{ color-scheme: light dark; {block(0)} }}\n"
    return light + f"@media (prefers-color-scheme: dark) {{ :root {{ {block(1)} }} }}\n"


def for_page(svg):
    """A drawing that follows the page's colours and font."""
    in_attribute = r'(?:(?<=: )|(?<=="))#[0-9a-f]{6}(?=[;"])'
    svg = re.sub(in_attribute, lambda found: f"var(--{NAMES[found[0]]})" if found[0] in NAMES else found[0], svg)
    return svg.replace(FONT_OF_FILES, FONT_OF_PAGES)
