"""Paths of the report's companion, runs of one point along them, and numbers beside the companion's. Stresses are
compression positive."""

import itertools
import math
import pathlib

from tamp import files, results
from tamp.research.material.drive import diagonal, drive, legs, write_path
from tamp.program import INPUTS, MODELS, SAND

COMPANION = INPUTS / "studies/companion"
NAMES = {**MODELS, "measured": "measured"}
FORMS = ["rate", "state"]
FILE_ENDS = {"q": "", "sqrt_J2": "_sqrt_J2"}  # of the material files, by how they read the strength column
COMBINATIONS = [(reading, form) for reading in FILE_ENDS for form in FORMS]

# Paths


# Time, logarithmic volumetric strain (compression positive): up to the largest of a test, down to its plastic strain.
HYDROSTATIC = [
    (0, 0), (0.1, 0.0904), (0.2, 0.06279244783), (0.3, 0.1808), (0.4, 0.1450957621), (0.5, 0.2712), (0.6, 0.2259340559),
    (0.7, 0.3616), (0.8, 0.3019145715), (0.9, 0.452), (1, 0.3200070101), (1.1, -0.002998500999),
]
# Time, logarithmic strains along the axis and across it (tension positive).
MULTIAXIAL = [
    (0, 0, 0), (1, -0.00944444444, -0.00944444444), (2, -0.04410203987, 0.02121768660),
    (3, 0.02788435327, -0.00477550997), (4, 0.02246575954, 0.01593378690), (5, -0.01897074757, 0.03165204045),
]


def uniaxial(corners):
    """Rows of (time, F11)."""
    return [(time, diagonal(stretch, 1, 1)) for time, stretch in corners]


def hydrostatic():
    return [(time, diagonal(*3 * [math.exp(-strain / 3)])) for time, strain in HYDROSTATIC]


def multiaxial(scale):
    """With all strains times `scale`. Legs are straight in logarithmic strain."""
    return [(time, diagonal(math.exp(scale * along), *2 * [math.exp(scale * across)]))
            for time, along, across in legs(MULTIAXIAL)]


def write_paths():
    source = "of the companion (Banerjee 2020, PAR-10021867-092020-5)"
    paths = {"uniaxial": (f"The uniaxial path {source}.", uniaxial([(0, 1), (1, 0.6), (4, 1.02)])),
             "hydrostatic": (f"The hydrostatic load cycles {source}.", hydrostatic()),
             "multiaxial": (f"The multiaxial path {source}.", multiaxial(1))}
    for name, (what, rows) in paths.items():
        made = [what, "Made by tools/python/tamp companion --write-paths."]
        write_path(COMPANION / f"{name}.csv", rows, 12, made)


# Files and runs


def read_texts(path):
    """Each row of a CSV, by the names of its columns."""
    names, *found = [cells for _, cells in files.rows(path) if cells]
    return [dict(itertools.zip_longest(names, cells, fillvalue="")) for cells in found]


class Point:
    """Runs of `tamp drive`, each done once."""

    def __init__(self, options, folder):
        self.tamp, self.increment, self.folder = options.tamp, options.increment, pathlib.Path(folder)
        self.done = {}

    def path(self, name, rows):
        """A file of its own for a path that is made."""
        path = self.folder / f"{name}.csv"
        write_path(path, rows)
        return path

    def drive(self, path, model, reading="q", form="rate", settings=(), increment=None):
        """Rows with numbers by name, stresses compression positive."""
        key = (path, model, reading, form, tuple(settings), increment)
        if key not in self.done:
            material = SAND / f"{model}{FILE_ENDS[reading]}.json"
            settings = [("/elastic_update", form), *settings]
            columns = drive(self.tamp, material, path, increment or self.increment, settings)
            self.done[key] = list(map(compressed, results.rows_of(columns)))
        return self.done[key]


def compressed(state):
    s11, s22 = -state["s11"], -state["s22"]
    apart = abs(s11 - s22)
    ratio = apart / state["p"] if state["p"] > 0 else math.nan
    return {**state, "s11": s11, "s22": s22, "s11-s22": apart, "q/p": ratio}


def at_time(rows, time):
    return min(rows, key=lambda row: abs(row["time"] - time))


def first_leg_apart(rows):
    return [row for row in rows if 1 <= row["time"] <= 2]


def answer(rows, at, quantity):
    """The value that a row of figures.csv asks for."""
    if at == "peak of s11":
        return max(first_leg_apart(rows), key=lambda row: row["s11"])[quantity]
    if at == "least after 1 s":
        return min(row[quantity] for row in first_leg_apart(rows))
    return at_time(rows, float(at.split()[0]))[quantity]


# Tables


UNITS = {"MPa": 1e6, "GPa": 1e9, "-": 1}


def companion_text(figure):
    number = f"{figure['value']} to {figure['to']}" if figure["to"] else figure["value"]
    return number if figure["unit"] == "-" else f"{number} {figure['unit']}"


def companion_number(figure):
    return (float(figure["value"]) + float(figure["to"] or figure["value"])) / 2


def off(value, figure):
    """The difference from the companion's number, over that number."""
    return value / UNITS[figure["unit"]] / companion_number(figure) - 1


def compared(value, figure):
    return f"{value / UNITS[figure['unit']]:.4g} ({100 * off(value, figure):+.1f} %)"
