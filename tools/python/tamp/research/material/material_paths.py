"""Takes the sand models along paths of one material point, and prints what comes out as Markdown.

Hydrostatic loading and unloading against the measured curves; how far stress gets outside of the yield surface, whether
plastic work ever falls, and what half the increment changes, on uniaxial and multiaxial paths; and what a superposed
rotation changes. PATHs (files of prescribed deformation) are added to the last two.
"""

import bisect
import math
import pathlib
import tempfile

import numpy as np

from tamp import program, results
from tamp.markdown import print_table
from tamp.research.material.drive import diagonal, drive, legs
from tamp.program import MODELS, SAND

FORMS = ["state", "rate"]
INCREMENT = 1e-3
TURN = 90.0  # degrees of superposed rotation at a path's end
AXIS = (1, 2, 2)


# Files


def write_path(path, deformations, turn=0.0):
    """A row of F (nine numbers, row by row) for each unit of time, and an angle that grows evenly to `turn` degrees."""
    with open(path, "w") as file:
        for i, deformation in enumerate(deformations):
            numbers = [i, *deformation, turn * i / (len(deformations) - 1), *AXIS]
            file.write(" ".join(repr(float(number)) for number in numbers) + "\n")
    return path


def read_path(path):
    """(times, deformations)"""
    rows = [[float(word) for word in line.split()] for line in open(path) if line.strip() and line[0] != "#"]
    return [row[0] for row in rows], [row[1:10] for row in rows]


def write_turned(path, source):
    """The path of another file with the superposed rotation added, over its own times."""
    times, deformations = read_path(source)
    with open(path, "w") as file:
        for time, deformation in zip(times, deformations):
            angle = TURN * (time - times[0]) / (times[-1] - times[0])
            file.write(" ".join(repr(number) for number in [time, *deformation, angle, *map(float, AXIS)]) + "\n")
    return path


# Paths, by the corners of their legs


def isotropic(compression):
    """F of a logarithmic volumetric strain."""
    stretch = math.exp(-compression / 3)
    return diagonal(stretch, stretch, stretch)


def uniaxial(*stretches):
    return legs([diagonal(stretch, 1, 1) for stretch in stretches])


def general_paths():
    triaxial = [(0, 0), (-0.009, -0.009), (-0.044, 0.021), (0.028, -0.005), (0.022, 0.016), (-0.019, 0.032)]
    sheared = [
        diagonal(1, 1, 1),
        (0.85, 0, 0, 0, 1, 0, 0, 0, 1),
        (0.85, 0.1, 0, 0, 0.95, 0, 0, 0, 1),
        (0.84, -0.1, 0.05, 0, 0.95, 0.05, 0, 0, 0.97),
        (0.88, -0.1, 0.05, 0, 0.96, -0.05, 0, 0, 0.99),
        (0.8, 0.05, 0, 0.05, 0.93, 0, 0, 0, 0.95),
    ]
    return {
        "uniaxial, to 5 %": uniaxial(1, 0.95),
        "uniaxial, apart to 3 times the length, then to half and back": uniaxial(1, 3, 1, 0.5, 1, 1.02),
        "triaxial, 5 legs near zero stress": legs([diagonal(*(math.exp(e) for e in (a, b, b))) for a, b in triaxial]),
        "compressed, then sheared to and fro": legs(sheared),
    }


# Measured quantities


class Measured:
    """The measured hydrostat, and the unloading curves by their plastic strain."""

    def __init__(self):
        self.hydrostat = results.columns(SAND / "hydrostat.csv")
        table = results.columns(SAND / "unloading.csv")
        self.unloading = {}
        for plastic, elastic, pressure in zip(*table.values()):
            self.unloading.setdefault(plastic, []).append((elastic, pressure))

    def loading_pressure(self, strain):
        return np.interp(strain, self.hydrostat["total_volumetric"], self.hydrostat["pressure"])


def interpolated(xs, ys, x):
    """Straight on beyond the ends."""
    i = min(max(bisect.bisect_right(xs, x), 1), len(xs) - 1)
    return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1])


# Results of a run of the point


class Point:
    def __init__(self, tamp, folder):
        self.tamp, self.folder = tamp, pathlib.Path(folder)

    def drive(self, model, form, path, increment=INCREMENT):
        return drive(self.tamp, SAND / f"{model}.json", path, increment, {"/elastic_update": form})


def stresses(columns):
    """Cauchy stress of each row, off-diagonal components weighted so that the length is the tensor's."""
    weights = {"s11": 1, "s22": 1, "s33": 1, "s23": math.sqrt(2), "s13": math.sqrt(2), "s12": math.sqrt(2)}
    return np.column_stack([weight * columns[name] for name, weight in weights.items()])


def length(vector):
    return np.linalg.norm(vector)


def at_times(columns, values, times):
    return {time: value for time, value in zip(columns["time"], values) if time in times}


def change_by_half_increment(point, model, form, path):
    """The largest change of stress at the path's rows, over the larger of the stress there and 1 % of the largest."""
    times = set(read_path(path)[0])
    runs = [point.drive(model, form, path, increment) for increment in (INCREMENT, INCREMENT / 2)]
    coarse, fine = (at_times(run, stresses(run), times) for run in runs)
    floor = 0.01 * max(length(stress) for stress in fine.values())
    changes = (length(coarse[t] - fine[t]) / max(length(fine[t]), floor) for t in times)
    return max(changes)


def change_by_turning(point, model, form, path):
    """The largest change of p and q under a superposed rotation, over the larger of both at that row."""
    straight = point.drive(model, form, path)
    turned = point.drive(model, form, write_turned(point.folder / "turned.inp", path))
    apart = np.maximum(abs(straight["p"] - turned["p"]), abs(straight["q"] - turned["q"]))
    return (apart / np.maximum.reduce([abs(straight["p"]), straight["q"], np.ones(len(apart))])).max()


# Tables


def combinations(models):
    return [(model, form) for model in models for form in FORMS]


def print_loading(point, measured, models):
    strains = [0.01, 0.02, 0.04, 0.06, 0.10, 0.19, 0.28, 0.34, 0.40, 0.43, 0.45]
    path = write_path(point.folder / "hydrostatic.inp", legs([isotropic(0), isotropic(0.45)]))
    columns, worst = [], []
    for model, form in combinations(models):
        run = point.drive(model, form, path)
        strain = run["strain_v"][run["strain_v"] > 0.0099]
        ratio = run["p"][-len(strain) :] / measured.loading_pressure(strain)
        columns.append([interpolated(strain, ratio, wanted) for wanted in strains])
        worst.append(abs(ratio - 1).max())
    print("### Monotone hydrostatic loading: p over the measured hydrostat\n")
    rows = [[f"{strain:.2f}", *(f"{column[i]:.4f}" for column in columns)] for i, strain in enumerate(strains)]
    rows.append(["largest error from 1 % up", *(f"{100 * error:.3g} %" for error in worst)])
    print_table(["strain", *(f"{model}, {form}" for model, form in combinations(models))], rows)


def unloading_errors(run, turn, plastic, curve):
    """Errors of p on the way down from `turn` until the measured sand has no pressure left: relative to the curve at
    equal elastic strain, and at equal total strain, both from 1 % of elastic strain up; and at equal total strain
    everywhere, over the pressure at the turn."""
    elastic, pressure = zip(*curve)
    i = abs(run["strain_v"] - turn).argmin()
    at_elastic = at_total = over_top = 0.0
    while run["strain_v"][i] > plastic + 1e-9:
        by_elastic = interpolated(elastic, pressure, run["elastic_v"][i])
        by_total = interpolated(elastic, pressure, run["strain_v"][i] - plastic)
        over_top = max(over_top, abs(run["p"][i] - by_total) / pressure[-1])
        if run["strain_v"][i] > plastic + 0.01:
            at_elastic = max(at_elastic, abs(run["p"][i] / by_elastic - 1))
            at_total = max(at_total, abs(run["p"][i] / by_total - 1))
        i += 1
    return at_elastic, at_total, over_top


def print_unloading(point, measured, models):
    curves = sorted(measured.unloading.items())
    turns = [plastic + curve[-1][0] for plastic, curve in curves]
    corners = [isotropic(0)]
    for turn, (plastic, _) in zip(turns, curves):
        corners += [isotropic(turn), isotropic(plastic)]
    path = write_path(point.folder / "load-unload.inp", legs(corners))
    print("### Hydrostatic unloading: largest error of p against each measured curve\n")
    measures = ["at equal elastic strain, 1 % and more", "at equal total strain, 1 % elastic and more",
                "at equal total strain, over the largest p"]
    rows = []
    for model, form in combinations(models):
        run = point.drive(model, form, path)
        errors = [unloading_errors(run, turn, *curve) for turn, curve in zip(turns, curves)]
        rows += [[f"{model}, {form}", measure, *(f"{100 * e:.3g} %" for e in error)]
                 for measure, error in zip(measures, zip(*errors))]
    print_table(["model", "unloaded from", *(f"{turn:.4f}" for turn in turns)], rows)


def print_general(point, paths, models):
    print("### Uniaxial and multiaxial paths\n")
    rows = []
    for name, path in paths.items():
        for model, form in combinations(models):
            run = point.drive(model, form, path)
            work = run["plastic_work"]
            least = np.diff(work).min() / max(work[-1], 1e-300)
            change = change_by_half_increment(point, model, form, path)
            rows.append([name, f"{model}, {form}", f"{max(run['outside']):.3g}", f"{least:.3g}",
                         f"{100 * change:.3g} %", f"{sum(run['substeps']):.0f} in {len(work) - 1:.0f}"])
    print_table(["path", "model", "outside of the yield surface, over its length",
                 "least plastic work of an increment, over all of it", "half the increment changes stress by",
                 "substeps in increments"], rows)


def print_objectivity(point, paths, models):
    print(f"### A superposed rotation by {TURN:.0f} degrees about {AXIS}: largest relative change of p and q\n")
    rows = [[name, *(f"{change_by_turning(point, model, form, path):.3g}" for model, form in combinations(models))]
            for name, path in paths.items()]
    print_table(["path", *(f"{model}, {form}" for model, form in combinations(models))], rows)


def add_arguments(parser):
    parser.add_argument("paths", nargs="*", type=pathlib.Path, metavar="PATH", help="files of prescribed deformation")
    parser.add_argument("--models", nargs="+", default=list(MODELS))
    program.add_option(parser)


def main(options):
    measured = Measured()
    with tempfile.TemporaryDirectory() as folder:
        point = Point(options.tamp, folder)
        print_loading(point, measured, options.models)
        print_unloading(point, measured, options.models)
        paths = {name: write_path(point.folder / f"{i}.inp", deformations)
                 for i, (name, deformations) in enumerate(general_paths().items())}
        paths.update((path.stem, path) for path in options.paths)
        print_general(point, paths, options.models)
        print_objectivity(point, paths, options.models)
