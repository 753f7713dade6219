#!/usr/bin/env python3
"""Make unloading.csv and hydrostat.csv of hydrostatic load-unload tests.

    python3 tools/python/unloading_from_tests.py --strain percent --pressure MPa --out FOLDER TEST.csv ...

One file a test: volumetric strain in the first column, pressure in the second, both positive in compression, loading
first and then unloading; rows that are not numbers are passed over. Each unloading branch becomes a curve of
unloading.csv, from its own plastic strain, and the loading branch of the test to the largest strain becomes
hydrostat.csv. What is written is SI, and thinned to as few points as hold each curve within 0.1 %. Strains stay what
they are, engineering or logarithmic. Only the standard library is used.
"""

import argparse
import csv
import pathlib
import sys

TOLERANCE = 1e-3  # of the value, everywhere on a curve
SLOPE_TOLERANCE = 2e-4  # the unloading curves are differentiated (bulk modulus), so they keep more points

HYDROSTAT_HEADER = "total_volumetric[-],pressure[Pa]"
UNLOADING_HEADER = "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]"


def measured(path, divisor, factor):
    """The rows (strain / divisor, pressure * factor) of a raw file, without its headings."""
    rows = []
    with open(path, newline="") as file:
        for row in csv.reader(file):
            try:
                rows.append((float(row[0]) / divisor, float(row[1]) * factor))
            except (ValueError, IndexError):
                continue
    return rows


def turning_point(rows):
    return max(range(len(rows)), key=lambda i: rows[i][1])


def loading_branch(rows):
    return ascending(rows[: turning_point(rows) + 1])


def unloading_curve(rows):
    """(plastic strain, [(elastic strain, pressure)]) of the unloading branch, cut at zero pressure or run on to it."""
    branch = ascending(reversed(rows[turning_point(rows) :]))
    first = next(i for i, (_, p) in enumerate(branch) if p > 0)
    (s0, p0), (s1, p1) = branch[max(first - 1, 0) :][:2]
    plastic = s0 - p0 * (s1 - s0) / (p1 - p0)
    return plastic, [(0.0, 0.0)] + [(s - plastic, p) for s, p in branch[first:]]


def ascending(points):
    """Points in order of strain; repeats, and points that would make the curve fall, are left out."""
    kept = []
    for x, y in points:
        if not kept or (x > kept[-1][0] and y > kept[-1][1]):
            kept.append((x, y))
    return kept


def thinned(points, tolerance=TOLERANCE):
    """The fewest points, taken greedily, whose chords hold every point left out within `tolerance` of its value."""

    def chord_holds(i, j):
        (x0, y0), (x1, y1) = points[i], points[j]
        slope = (y1 - y0) / (x1 - x0)
        return all(abs(y0 + slope * (x - x0) - y) <= tolerance * abs(y) for x, y in points[i + 1 : j])

    kept, i = [points[0]], 0
    while i < len(points) - 1:
        j = i + 1
        # A chord that fails may hold again with a later end, but never for long: look a little ahead.
        ahead = j
        while ahead < len(points) and ahead - j < 8:
            if chord_holds(i, ahead):
                j = ahead
            ahead += 1
        kept.append(points[j])
        i = j
    return kept


def unloading_rows(tests):
    """Rows of unloading.csv, of tests in any order."""
    curves = sorted(unloading_curve(rows) for rows in tests)
    return [(plastic, e, p) for plastic, points in curves for e, p in thinned(points, SLOPE_TOLERANCE)]


def write(path, comments, header, rows):
    with open(path, "w") as file:
        for line in comments:
            file.write(f"# {line}\n")
        file.write(header + "\n")
        for row in rows:
            file.write(",".join(f"{value:.10g}" for value in row) + "\n")
    print(f"{path.name}: {len(rows)} rows")


def check(path, rows):
    """What would otherwise come out as a wrong curve."""
    if len(rows) < 3:
        sys.exit(f"{path}: {len(rows)} rows of numbers; expected a test: strain in column 1, pressure in column 2")
    turn = turning_point(rows)
    if rows[turn][0] <= 0 or rows[turn][1] <= 0:
        sys.exit(f"{path}: the largest pressure is {rows[turn][1]:g} Pa; expected compression to be positive")
    if rows[turn][0] >= 1:
        sys.exit(f"{path}: a strain of {rows[turn][0]:g}; expected less than 1 (is --strain right?)")
    if len(ascending(reversed(rows[turn:]))) < 2:
        sys.exit(f"{path}: nothing after the largest pressure; expected unloading to zero")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tests", nargs="+", type=pathlib.Path, metavar="TEST.csv")
    parser.add_argument("--strain", choices=["percent", "fraction"], required=True)
    parser.add_argument("--pressure", choices=["Pa", "kPa", "MPa"], required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="FOLDER")
    options = parser.parse_args()

    # Divided, as 3 / 100 is the double next to 0.03 and 3 * 0.01 is not.
    divisor = {"percent": 100, "fraction": 1}[options.strain]
    factor = {"Pa": 1, "kPa": 1e3, "MPa": 1e6}[options.pressure]
    try:
        tests = [measured(path, divisor, factor) for path in options.tests]
    except OSError as error:
        sys.exit(str(error))
    for path, rows in zip(options.tests, tests):
        check(path, rows)

    options.out.mkdir(parents=True, exist_ok=True)
    made = ["Made by tools/python/unloading_from_tests.py. SI units, compression positive."]
    largest = max(tests, key=lambda rows: rows[turning_point(rows)][0])
    loading = thinned(loading_branch(largest))
    write(options.out / "hydrostat.csv", ["Hydrostatic loading.", *made], HYDROSTAT_HEADER, loading)
    title = "Hydrostatic unloading, each curve from its own plastic strain."
    write(options.out / "unloading.csv", [title, *made], UNLOADING_HEADER, unloading_rows(tests))


if __name__ == "__main__":
    main()
