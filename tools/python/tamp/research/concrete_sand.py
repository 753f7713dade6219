"""Makes inputs/materials/concrete-sand/*.csv from the raw measurements.

RAW_FOLDER holds measured/ (DrySand_LoadUnload_*.csv: strains in %, pressures in MPa) and vaango/
(DrySand_HydrostaticCapData.json, DrySand_YieldData.json). What is written is SI, compression positive, and thinned to
as few points as hold each curve within 0.1 %. Only the standard library is used.
"""

import math
import pathlib

from tamp import files, made_files, program
from tamp.failure import Refusal
from tamp.laboratory import import_tests as curves
from tamp.laboratory.curves import ascending, thinned

SOURCE = [
    "Dry, poorly graded concrete sand: Fox et al. (2014), tested at the University of Maryland;",
    "S. Akers (CCDC Army Research Laboratory), private communication; as published with the Vaango code (MIT licence).",
    "Volumetric strains were measured as engineering ones, 1 - V/V0; the published tables take the same numbers as",
    "logarithmic ones. The material's key strain_measure says which. SI units, compression positive.",
    "Made by tools/python/tamp concrete-sand.",
]


def vaango_table(path, x, y):
    """The points of a published table, in order of x."""
    try:
        data = files.document(path)["Vaango_tabular_data"]["Data"]
        points = ascending((float(a), float(b)) for a, b in zip(data[x], data[y], strict=True))
    except (KeyError, TypeError, ValueError):
        points = []
    if len(points) < 2 or not all(map(math.isfinite, sum(points, ()))):
        raise Refusal(path, "no such table", f"Vaango_tabular_data/Data with numbers {x} and {y} that ascend")
    return points


def add_arguments(parser):
    parser.add_argument("raw", type=pathlib.Path, metavar="RAW_FOLDER")
    parser.add_argument("out", type=pathlib.Path, metavar="OUTPUT_FOLDER", nargs="?",
                        default=pathlib.Path("inputs/materials/concrete-sand"))
    program.add_option(parser)


def main(options):
    raw, out = options.raw, options.out
    tamp = made_files.found(options.tamp)

    paths = sorted((raw / "measured").glob("DrySand_LoadUnload_*.csv"))
    published = [raw / "vaango" / "DrySand_HydrostaticCapData.json", raw / "vaango" / "DrySand_YieldData.json"]
    outputs = [out / f"{name}.csv"
               for name in ["hydrostat", "unloading", "crush_curve", "yield", "yield_sqrt_J2", "yield_from_zero"]]
    hydrostat, unloading = outputs[:2]
    if not paths:
        raise Refusal(raw, "no measured/DrySand_LoadUnload_*.csv", "the raw measurements")
    files.keep_inputs([*paths, *published], outputs)
    tests = curves.read_tests(paths, "percent", "MPa")
    crush = thinned(vaango_table(published[0], "PlasticStrainVol", "Pressure"))
    tested = vaango_table(published[1], "Pressure", "SqrtJ2")
    strength = thinned(tested)
    # Dry sand has no cohesion. Below this pressure the concave hull from zero lies 2 to 15 % above the tests: they are
    # all there, so that a check says so.
    hull_is_close = 3e5
    from_zero = [(0.0, 0.0), *(row for row in tested if 0 < row[0] < hull_is_close),
                 *(row for row in strength if row[0] >= hull_is_close)]

    out.mkdir(parents=True, exist_ok=True)
    # Measured is a "deviatoric yield stress", which is q; the published code reads the same numbers as sqrt(J2).
    yield_title = "Yield in triaxial compression; the first row is the tension vertex."
    tables = [
        # The loading branch of the test to 45.20 %: the published hydrostat before its strains were cut to 0.01 %.
        ("Hydrostatic loading.", curves.HYDROSTAT_HEADER, curves.hydrostat_rows(tests)),
        ("Hydrostatic unloading, each curve from its own plastic strain.", curves.UNLOADING_HEADER,
         curves.unloading_rows(tests)),
        ("Hydrostatic strength (crush curve), the published one.", "plastic_volumetric[-],pressure[Pa]", crush),
        (yield_title, "pressure[Pa],q[Pa]", strength),
        (yield_title, "pressure[Pa],sqrt_J2[Pa]", strength),
        ("Yield in triaxial compression, from no tension.", "pressure[Pa],q[Pa]", from_zero),
    ]
    for path, (title, header, rows) in zip(outputs, tables):
        curves.write(path, [title, *SOURCE], header, rows)
    curves.check_with_tamp(tamp, made_files.aside(hydrostat), made_files.aside(unloading), tests)
    made_files.put_in_place(outputs)
