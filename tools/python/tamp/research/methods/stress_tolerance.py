"""The effect on a run of the tolerance of the sand's stress, beside that of round-off.

Runs the scene once for each tolerance, and three times at the first one with the density of the sand changed by parts
in 1e12. Prints, for each, how far its results are from those of the first tolerance, relative to the greatest value
that they have in the run: the body's depth (the greatest difference at any time), the sand's peaks of pressure and q,
the greatest cap and plastic volumetric strain, and the energies at the end. The last column is user time over that of
the first run. The rows of round-off tell what of a difference is chance. A shorter run ends at an earlier time, as
`--set /time/end=1e-4`, not after a number of steps, whose sizes differ.
"""

import pathlib
import tempfile
from typing import NamedTuple

import numpy as np

from tamp import files, program, results
from tamp.markdown import print_head, print_row
from tamp.options import add_settings

PEAKS = {"p peak": "p_max", "q peak": "q_max", "cap": "cap_max", "plastic strain": "plastic_volumetric_max"}
ENERGIES = {"plastic energy": "plastic", "total energy": "total"}


class Run(NamedTuple):
    history: dict  # columns, those of the sand without its name
    depth: np.ndarray
    seconds: float  # user time
    summary: dict
    density: float  # of the sand


def run(options, **keys):
    """Runs the scene with these keys of the sand."""
    settings = [*((f"/materials/{options.sand}/{key}", value) for key, value in keys.items()), *options.set]
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place, "run")
        seconds, _ = program.timed_run(options.tamp, options.scene, folder, settings=settings)
        columns, summary = results.history(folder), results.summary(folder)
        density = files.document(folder / "scene.json")["materials"][options.sand]["density"]
    depth = next(values for name, values in columns.items() if name.endswith(".depth"))
    of_sand = {name.removeprefix(f"{options.sand}."): values for name, values in columns.items()}
    return Run(of_sand, depth, seconds, summary, density)


def depth_difference(reference, other):
    """The greatest at any time, over the greatest depth."""
    there = np.interp(reference.history["time"], other.history["time"], other.depth)
    return abs(there - reference.depth).max() / abs(reference.depth).max()


def differences(reference, other):
    a, b, scale = reference.history, other.history, abs(reference.depth).max()
    found = {"depth(t)": depth_difference(reference, other),
             "greatest depth": abs(other.depth.max() - reference.depth.max()) / scale}
    for name, key in PEAKS.items():
        found[name] = abs(b[key].max() / a[key].max() - 1)
    total = a["total"][0] or 1
    for name, key in ENERGIES.items():
        found[name] = abs(b[key][-1] - a[key][-1]) / abs(total)
    return found


def add_options_of_runs(parser):
    program.add_option(parser)
    parser.add_argument("--scene", type=pathlib.Path, default=program.INPUTS / "punch/quick.json")
    parser.add_argument("--sand", default="sand", help="the name of the material")
    add_settings(parser)


def add_arguments(parser):
    add_options_of_runs(parser)
    parser.add_argument("--tolerances", default="1e-6,1e-5,1e-4,1e-3")


def main(options):
    first, *others = options.tolerances.split(",")
    reference = run(options, tolerance=first)
    rows = [(f"round-off {k}", run(options, tolerance=first, density=reference.density * (1 + k * 1e-12)))
            for k in (1, 2, 3)]
    rows += [(tolerance, run(options, tolerance=tolerance)) for tolerance in others]
    print_head(["tolerance", *differences(reference, reference), "time"])
    for title, result in rows:
        cells = [f"{value:.1e}" for value in differences(reference, result).values()]
        print_row([title, *cells, f"{result.seconds / reference.seconds:.2f}"])
