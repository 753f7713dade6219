"""Draws the curves of a laboratory test into a page, from what `tamp drive` has written.

The page holds the rows, too, as JSON, and needs nothing but itself. The same rows give the same page, byte for byte.
"""

import json
import math
import pathlib

from tamp.charts import curve, page
from tamp.charts.curve import Quantity
from tamp.charts.formatting import counted, escaped, percent_text, si_text
from tamp.files import Damage, keep_inputs, written_by_tamp, written_table

STRAIN = 0.01  # the scale by which a strain is large or small
NOTHING = 1e-9  # beside that: round-off; and of a change of F
NOTE = ("Strains are counted from the first row, volumetric and axial ones as logarithms; compression is positive, "
        "also for the mean stress p. q = √(3 J₂).")


def add_arguments(parser):
    parser.add_argument("rows", type=pathlib.Path, metavar="ROWS.csv", help="what tamp drive has written")
    parser.add_argument("page", type=pathlib.Path, metavar="PAGE.html")
    parser.add_argument("--title", help="by default the name of ROWS.csv")


def main(options):
    keep_inputs([options.rows], [options.page])
    names, rows = written_table(options.rows)
    with written_by_tamp(options.rows):
        text = whole_page(options.title or options.rows.name, names, rows)
    options.page.write_text(text, encoding="utf-8")


def whole_page(title, names, rows):
    if not rows:
        raise Damage("no rows")
    data = as_json({"columns": names, "rows": rows})
    charts = "".join(map(page.figure, charts_of(names, rows)))
    content = (f'<h1>{escaped(title)}</h1>\n<p class="faint">{counted(len(rows), "row")}. {NOTE}</p>\n'
               f'<div class="charts">\n{charts}</div>\n'
               f'<script type="application/json" id="rows">{data}</script>\n')
    return page.whole_page(title, f"<main>\n{content}</main>\n", kind="drive")


def as_json(data):
    """Which ends no script that it stands in."""
    return json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def charts_of(names, rows):
    known = {name.split("[")[0]: [row[k] for row in rows] for k, name in enumerate(names)}
    along, volume = abscissa(known), volumetric(known)
    largest = max(map(abs, known["p"] + known["q"])) or 1
    p = stress("p", "mean stress p", known["p"], largest)
    q = stress("q", "q = √(3 J₂)", known["q"], largest)
    return [curve.chart("shearing", along, q), curve.chart("volume", along, volume), curve.chart("stress-path", p, q),
            curve.chart("compression", volume, p)]


def stress(name, label, values, largest):
    return Quantity(name, label, exact_zeros(values, largest), lambda value: si_text(value, "Pa"), largest)


def strain(name, label, values):
    return Quantity(name, label, exact_zeros(values, STRAIN), percent_text, STRAIN)


def exact_zeros(values, scale):
    return [value if abs(value) > NOTHING * scale else 0.0 for value in values]


def volumetric(known):
    return strain("volumetric strain", "volumetric strain, compression positive",
                  [value - known["strain_v"][0] for value in known["strain_v"]])


def abscissa(known):
    """The strain that changes most of those that a test goes to; time where none does, or axes turn."""
    strains = [] if turns(known) else [*axial(known), shear(known, "F12", "F22"), shear(known, "F21", "F11")]
    widest = max(strains, key=lambda one: width(one.values), default=None)
    if widest is not None and width(widest.values) > NOTHING:
        return widest
    times = known["time"]
    return Quantity("time", "time", times, lambda value: si_text(value, "s"), max(map(abs, times)) or 1)


def axial(known):
    """Nothing where axis 1 is turned upside down."""
    stretch = known["F11"]
    if min(stretch) <= 0:
        return []
    return [strain("axial shortening", "axial shortening, −ln F11",
                   [math.log(stretch[0] / value) for value in stretch])]


def shear(known, entry, height):
    """By the height at the first row, as in a shear box."""
    values, own_height = known[entry], known[height][0]
    return strain("shear displacement", f"shear displacement over height, {entry}",
                  [(value - values[0]) / own_height for value in values])


def turns(known):
    """Whether entries on both sides of the diagonal change: the axes are then no longer those of a test."""
    return any(width(known[f"F{i}{j}"]) > NOTHING and width(known[f"F{j}{i}"]) > NOTHING
               for i, j in [(1, 2), (1, 3), (2, 3)])


def width(values):
    return max(values) - min(values)
