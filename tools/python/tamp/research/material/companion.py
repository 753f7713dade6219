"""Takes one point of concrete sand along the paths of the report's companion, and prints what comes out beside it.

The companion (Banerjee 2020, PAR-10021867-092020-5) shows single particles along three paths: uniaxial, hydrostatic and
multiaxial. Each is taken here with Table, SVR and MLP, with the strength column read as q and as sqrt(J2), in rate and
in state form. Then: what SVR and MLP do beyond their data, what half the strain does on the multiaxial path, how q / p
compares with dynamic tests, and how far increments and tolerance matter. Everything is compression positive. --svr and
--mlp add other fits, such as the published ones, to the part on the range. --write-paths remakes the CSVs of the paths
and does nothing else. Debian's python3-h5py is used.
"""

import json
import math
import pathlib
import tempfile

import numpy as np

from tamp import files, program, results
from tamp.fit.network import changed_copy
from tamp.fit.support_vectors import SupportVectors
from tamp.markdown import print_table
from tamp.research.material.companion_paths import (
    COMBINATIONS, COMPANION, MULTIAXIAL, NAMES, UNITS, Point, answer, at_time, companion_number, companion_text,
    compared, multiaxial, off, read_texts, uniaxial, write_paths,
)
from tamp.research.material.drive import TIGHT
from tamp.options import positive
from tamp.program import MODELS, SAND

# Ranges beyond what the runs come to, as the files have them: largest total and plastic strain in percent; least and
# largest elastic, least and largest plastic strain.
WIDER = {"svr": [60.0, 40.0], "mlp": [0, 0.3, 0, 0.4]}


def titles(combinations):
    return [f"{reading}, {form}" for reading, form in combinations]


def print_path(point, figures, path, file):
    print(f"### {path.capitalize()}\n")
    rows = []
    for figure in figures:
        if figure["path"] != path or figure["model"] not in MODELS:
            continue
        runs = [point.drive(file, figure["model"], reading, form) for reading, form in COMBINATIONS]
        cells = [compared(answer(run, figure["at"], figure["quantity"]), figure) for run in runs]
        rows.append([NAMES[figure["model"]], f"{figure['quantity']}, {figure['at']}", companion_text(figure), *cells])
    print_table(["model", "quantity", "companion", *titles(COMBINATIONS)], rows)


def print_measured(figures, path):
    """Print the pressure that the companion shows as measured, beside the last row of our measured hydrostat."""
    strain, pressure = (column[-1] for column in results.columns(SAND / "hydrostat.csv").values())
    for figure in figures:
        if (figure["path"], figure["model"]) == (path, "measured"):
            ours = compared(pressure, figure)
            print(f"Measured p at {100 * strain:.1f} %: companion {companion_text(figure)}, ours {ours}.\n")


def print_sums(point, figures):
    """Root mean square of all differences of a path and model."""
    print("### All differences of a path and model, root mean square\n")
    groups = {}
    for figure in figures:
        if figure["model"] in MODELS:
            groups.setdefault((figure["path"], figure["model"]), []).append(figure)
    rows = []
    for (path, model), group in groups.items():
        cells = []
        for reading, form in COMBINATIONS:
            run = point.drive(COMPANION / f"{path}.csv", model, reading, form)
            errors = [off(answer(run, figure["at"], figure["quantity"]), figure) for figure in group]
            cells.append(f"{100 * math.sqrt(sum(e * e for e in errors) / len(errors)):.1f} %")
        rows.append([path, NAMES[model], str(len(group)), *cells])
    print_table(["path", "model", "numbers", *titles(COMBINATIONS)], rows)


# Beyond the range of the fits


def widened_svr(path, copy):
    """A copy whose file says that the data go further: the sum itself is untouched."""
    copy.write_text(json.dumps({**files.document(path), "X_max": WIDER["svr"]}))
    return copy


def print_range(point, figures, options):
    print("### Beyond the range of the fits: uniaxial, F11 = 0.6, rate form\n")
    svr = [("/modulus/svr", widened_svr(SAND / "support_vectors.json", point.folder / "widened.json"))]
    mlp = [("/modulus/mlp", changed_copy(SAND / "network.h5", point.folder / "widened.h5", range=WIDER["mlp"]))]
    held, widened = "held at the edge, as shipped", "range widened"
    runs = [("svr", held, "q", ()), ("svr", widened, "q", svr), ("svr", widened, "sqrt_J2", svr),
            ("mlp", held, "q", ()), ("mlp", widened, "q", mlp)]
    if options.svr:
        other = [("/modulus/svr", widened_svr(options.svr, point.folder / "other.json"))]
        runs += [("svr", "other fit, held", "q", [("/modulus/svr", options.svr.resolve())])]
        runs += [("svr", "other fit, range widened", "q", other)]
    if options.mlp:
        other = [("/modulus/mlp", options.mlp.resolve()), ("/modulus/scaling", f"[{options.scaling}]")]
        runs += [("mlp", "other fit, held", "q", [*other, ("/modulus/range", options.range)])]
        runs += [("mlp", "other fit, range widened", "q", [*other, ("/modulus/range", str(WIDER["mlp"]))])]
    rows, states = [], []
    for model, what, reading, settings in runs:
        state = at_time(point.drive(COMPANION / "uniaxial.csv", model, reading, settings=settings), 1)
        asked = [figure for figure in figures if (figure["path"], figure["model"]) == ("uniaxial", model)]
        rows.append([NAMES[model], what, reading, *(compared(state[figure["quantity"]], figure) for figure in asked)])
        if model == "svr" and reading == "q":
            states.append(state)
    print_table(["model", "", "column as", *(f"{figure['quantity']} [{figure['unit']}]" for figure in asked)], rows)
    print_sum([("shipped fit", SAND / "support_vectors.json"), ("other fit", options.svr)], *states[:2])


def print_sum(fits, held, widened):
    """The bare sum at the strains that two runs came to, and further."""
    print("### The SVR's sum alone, without a range\n")
    places = [(state["strain_v"], state["plastic_v"]) for state in (held, widened)]
    places += [(0.452, 0.32), *((total, held["plastic_v"]) for total in (0.55, 0.6, 0.65, 0.7))]
    rows = []
    for name, path in fits:
        for total, plastic in sorted(places) if path else []:
            fitted = SupportVectors(path).fitted(np.array([total - plastic]), plastic)
            pressure, modulus = (value[0] for value in fitted)
            rows.append([name, f"{total:.4f}", f"{plastic:.4f}", f"{pressure / 1e9:.3f}", f"{modulus / 1e9:.2f}"])
    print_table(["", "total strain", "plastic strain", "p [GPa]", "K [GPa]"], rows)


# Other questions


def pressure_on_crush_curve(crush_curve, modulus, total):
    """Where p = X(total - p / K): hydrostatic loading in rate form with a K that is constant."""
    low, high = 0.0, modulus * total
    while high - low > 1:
        middle = (low + high) / 2
        low, high = (middle, high) if np.interp(total - middle / modulus, *crush_curve) > middle else (low, middle)
    return low


def print_balance(figures):
    print("### Multiaxial at 1 s: p on the crush curve, with the companion's own K\n")
    crush_curve = list(results.columns(SAND / "crush_curve.csv").values())
    total = -3 * MULTIAXIAL[1][1]
    rows = []
    for model in MODELS:
        asked = {f["quantity"]: f for f in reversed(figures) if (f["path"], f["model"]) == ("multiaxial", model)}
        modulus = companion_number(asked["K"]) * UNITS[asked["K"]["unit"]]
        found = [pressure_on_crush_curve(crush_curve, modulus, share * total) for share in (1, 0.5)]
        cells = [compared(value, asked["p"]) for value in found]
        rows.append([NAMES[model], companion_text(asked["K"]), companion_text(asked["p"]), *cells])
    print_table(["model", "K, companion", "p, companion", f"at {100 * total:.2f} % strain", "at half"], rows)


def print_half_strain(point, figures):
    print("### Multiaxial, with half the strain: q, rate form\n")
    path = point.path("half", multiaxial(0.5))
    rows = []
    for figure in figures:
        if figure["path"] == "multiaxial":
            asked = [point.drive(file, figure["model"]) for file in (COMPANION / "multiaxial.csv", path)]
            values = [answer(run, figure["at"], figure["quantity"]) for run in asked]
            name = f"{NAMES[figure['model']]}, {figure['quantity']}, {figure['at']}"
            rows.append([name, companion_text(figure), *(compared(value, figure) for value in values)])
    print_table(["", "companion", "path as published", "half the strain"], rows)


def print_dynamic(point):
    print("### q / p in uniaxial strain beside six dynamic tests of Mason sand\n")
    tests, rows = read_texts(COMPANION / "dynamic_tests.csv"), []
    strains = sorted({float(test["axial_strain[-]"]) for test in tests})
    for name in sorted({test["test"] for test in tests}):
        rows.append([f"test {name}", *(test_text(test) for test in tests if test["test"] == name)])
    path = point.path("compression", uniaxial([(0, 1), *((e, 1 - e) for e in strains)]))
    for measure in ("logarithmic", "engineering"):
        for reading, form in COMBINATIONS:
            run = point.drive(path, "table", reading, form, [("/strain_measure", measure)])
            states = [at_time(run, strain) for strain in strains]
            cells = [f"{state['q/p']:.2f} at {state['p'] / 1e6:.0f}" for state in states]
            rows.append([f"Table, {reading}, {form}, strain read as {measure}", *cells])
    print_table(["q / p at p [MPa], by axial strain", *(f"{100 * strain:.0f} %" for strain in strains)], rows)


def test_text(test):
    mean = float(test["mean_stress[Pa]"])
    return f"{2 * float(test['shear_stress[Pa]']) / mean:.2f} at {mean / 1e6:.0f}"


def print_accuracy(point):
    print("### Table, uniaxial, F11 = 0.6, q, rate form: increments and tolerance\n")
    rows = []
    for increment, settings in ((1e-3, ()), (1e-4, ()), (1e-4, TIGHT.items()), (1e-5, ())):
        state = at_time(point.drive(COMPANION / "uniaxial.csv", "table", settings=settings, increment=increment), 1)
        numbers = [f"{state[name] / 1e9:.5g}" for name in ("s11", "s22", "p", "s11-s22", "cap", "K")]
        rows.append([f"{increment:g}", "1e-8" if settings else "default", *numbers])
    print_table(["increment", "tolerance", "s11 [GPa]", "s22", "p", "q", "cap", "K"], rows)


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--increment", type=positive, default=1e-4)
    parser.add_argument("--svr", type=pathlib.Path, help="another support-vector fit, in the published layout")
    parser.add_argument("--mlp", type=pathlib.Path, help="another network, that does not say its own scaling and range")
    parser.add_argument("--scaling", help="its mean_e,sd_e,mean_p,sd_p,mean_K,sd_K")
    parser.add_argument("--range", default="[0, 0.132, 0, 0.32]", help="its range where it is held (%(default)s)")
    parser.add_argument("--write-paths", action="store_true")


def main(options):
    if options.write_paths:
        return write_paths()

    figures = read_texts(COMPANION / "figures.csv")
    with tempfile.TemporaryDirectory() as folder:
        point = Point(options, folder)
        for path in ("uniaxial", "hydrostatic", "multiaxial"):
            print_path(point, figures, path, COMPANION / f"{path}.csv")
            print_measured(figures, path)
        print_sums(point, figures)
        print_range(point, figures, options)
        print_half_strain(point, figures)
        print_balance(figures)
        print_dynamic(point)
        print_accuracy(point)
