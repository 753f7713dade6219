"""Makes unloading.csv and hydrostat.csv of hydrostatic load-unload tests.

One file a test: volumetric strain in the first column, pressure in the second, both positive in compression, one
loading first and then one unloading. Rows of headings come first and are named; after them every row has to be one of
numbers. Each unloading branch becomes a curve of unloading.csv, from its own plastic strain, and the loading branch of
the test to the largest strain becomes hydrostat.csv. What is written is SI, and thinned to as few points as hold each
curve within 0.1 %. Strains stay what they are, engineering or logarithmic. TAMP is asked whether it takes what is
written. Only the standard library is used.
"""

import pathlib

from tamp import files, made_files, program
from tamp.failure import Refusal
from tamp.laboratory import checks, raw_test
from tamp.laboratory.curves import (
    SLOPE_TOLERANCE, loading_branch, thinned, turning_point, unloading_branch, unloading_curve,
)

HYDROSTAT_HEADER = "total_volumetric[-],pressure[Pa]"
UNLOADING_HEADER = "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]"


def read_tests(paths, strain_unit, pressure_unit):
    """The tests that can be ones of sand, in order of plastic strain."""
    tests = [raw_test.read(path, strain_unit, pressure_unit) for path in paths]
    for test in tests:
        checks.check_test(test)
        say_what_it_is(test)
    tests.sort(key=lambda test: unloading_curve(test.rows)[0])
    checks.check_together(tests)
    return tests


def say_what_it_is(test):
    strain, pressure = test.rows[turning_point(test.rows)]
    plastic, _ = unloading_curve(test.rows)
    print(f"{test.path}: {pressure:g} Pa at a strain of {strain:g}, unloaded to a plastic strain of {plastic:.6f}")
    # The largest pressure belongs to both branches.
    n = len(test.rows) + 1 - len(loading_branch(test.rows)) - len(unloading_branch(test.rows))
    if n > 0:
        print(f"{test.path}: rows left out, where strain or pressure runs back or stands still: {n}")


def hydrostat_rows(tests):
    furthest = max(tests, key=lambda test: test.rows[turning_point(test.rows)][0])
    return thinned(loading_branch(furthest.rows))


def unloading_rows(tests):
    rows = []
    for plastic, points in (unloading_curve(test.rows) for test in tests):
        kept = thinned(points, SLOPE_TOLERANCE)
        if len(kept) == 2:  # a straight line; TAMP wants three points
            kept.insert(1, points[len(points) // 2])
        rows += [(plastic, e, p) for e, p in kept]
    return rows


def write(path, remarks, header, rows):
    """Aside, until all has been checked."""
    files.write_table(made_files.aside(path), remarks, header, rows)
    print(f"{path.name}: {len(rows)} rows")


def check_with_tamp(tamp, hydrostat, unloading, tests):
    """Check that TAMP accepts the files as the curves of a sand. Where it does not, they are left aside."""
    if tamp is None:
        return
    ends = [(points[-1][0], plastic) for plastic, points in (unloading_curve(test.rows) for test in tests)]
    objection = made_files.objection_to_curves(tamp, hydrostat, unloading, ends)
    if objection:
        raise Refusal(f"{objection}, says TAMP; the files are left there (noise in a test?)")


def add_arguments(parser):
    parser.add_argument("tests", nargs="+", type=pathlib.Path, metavar="TEST.csv")
    parser.add_argument("--strain", choices=list(raw_test.STRAINS), required=True)
    parser.add_argument("--pressure", choices=list(raw_test.PRESSURES), required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="FOLDER")
    program.add_option(parser)


def main(options):
    hydrostat, unloading = options.out / "hydrostat.csv", options.out / "unloading.csv"
    tamp = made_files.found(options.tamp)
    files.keep_inputs(options.tests, [hydrostat, unloading])
    tests = read_tests(options.tests, options.strain, options.pressure)

    options.out.mkdir(parents=True, exist_ok=True)
    made = ["Made by tools/python/tamp import. SI units, compression positive."]
    write(hydrostat, ["Hydrostatic loading.", *made], HYDROSTAT_HEADER, hydrostat_rows(tests))
    title = "Hydrostatic unloading, each curve from its own plastic strain."
    write(unloading, [title, *made], UNLOADING_HEADER, unloading_rows(tests))
    check_with_tamp(tamp, made_files.aside(hydrostat), made_files.aside(unloading), tests)
    made_files.put_in_place([hydrostat, unloading])
