"""A sand whose curves are smooth, for verification: tables remade from formulas, compression positive.

Hydrostatic loading follows A (exp(B v) - 1), unloading from any plastic strain K / n (exp(n e) - 1), and yield is a
cone of slope M from the tension vertex on. The constants make it about as stiff as the concrete sand. Rows are as close
as it takes for the curves between them, straight or cubic, to be within 1e-5 of the greatest pressure.
"""

import math
import pathlib

from tamp import files
from tamp.program import INPUTS

A, B = 20e6, 10.0  # Pa, 1
K, N = 0.4e9, 40.0  # Pa, 1
VERTEX, M = -24.5e3, 0.6  # Pa, 1
LAST_TOTAL, LAST_ELASTIC, LAST_PLASTIC = 0.35, 0.1, 0.3
N_HYDROSTAT, N_UNLOADING = 700, 100


def write(path, what, columns, rows):
    remarks = [f"{what} of a sand that is none: smooth curves, for verification.",
               "Made by tools/python/tamp smooth-sand."]
    files.write_table(path, remarks, columns, rows)


def spaced(last, n):
    return [last * i / n for i in range(n + 1)]


def add_arguments(parser):
    parser.add_argument("--out", type=pathlib.Path, default=INPUTS / "materials/smooth-sand")


def main(options):
    folder = options.out
    hydrostat = [(v, A * math.expm1(B * v)) for v in spaced(LAST_TOTAL, N_HYDROSTAT)]
    unloading = [(e, K / N * math.expm1(N * e)) for e in spaced(LAST_ELASTIC, N_UNLOADING)]
    curves = [(plastic, *point) for plastic in (LAST_PLASTIC / 2, LAST_PLASTIC) for point in unloading]
    cone = [(VERTEX, 0), (1e9, M * (1e9 - VERTEX))]
    write(folder / "hydrostat.csv", "Hydrostatic loading", "total_volumetric[-],pressure[Pa]", hydrostat)
    columns = "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]"
    write(folder / "unloading.csv", "Hydrostatic unloading", columns, curves)
    write(folder / "yield.csv", "Yield in triaxial compression", "pressure[Pa],sqrt_J2[Pa]", cone)
