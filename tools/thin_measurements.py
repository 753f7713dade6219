#!/usr/bin/env python3
"""Make inputs/materials/concrete-sand/*.csv from the raw measurements.

    python3 tools/thin_measurements.py RAW_FOLDER [OUTPUT_FOLDER]

RAW_FOLDER holds measured/ (DrySand_LoadUnload_*.csv: strains in %, pressures in MPa) and vaango/
(DrySand_HydrostaticCapData.json, DrySand_YieldData.json). What is written is SI, compression positive, and thinned to as
few points as hold each curve within 0.1 %. Only the standard library is used.
"""

import csv
import json
import pathlib
import sys

TOLERANCE = 1e-3  # of the value, everywhere on a curve
SLOPE_TOLERANCE = 2e-4  # the unloading curves are differentiated (bulk modulus), so they keep more points

SOURCE = [
    "Dry, poorly graded concrete sand: Fox et al. (2014), tested at the University of Maryland;",
    "S. Akers (CCDC Army Research Laboratory), private communication; as published with the Vaango code (MIT licence).",
    "Volumetric strains are used as published and taken as logarithmic. SI units, compression positive.",
    "Made by tools/thin_measurements.py.",
]


def numbers(path):
    """The rows (strain %, pressure MPa) of a raw file, without its headings."""
    rows = []
    with open(path, newline="") as file:
        for row in csv.reader(file):
            try:
                rows.append((float(row[0]), float(row[1])))
            except (ValueError, IndexError):
                continue
    return rows


def hydrostat(raw):
    """The loading branch of the test to 45.20 %: the published hydrostat before its strains were cut to 0.01 %."""
    rows = numbers(raw / "measured" / "DrySand_LoadUnload_45.csv")
    turn = max(range(len(rows)), key=lambda i: rows[i][1])
    return ascending([(s / 100, p * 1e6) for s, p in rows[: turn + 1]])


def unloading_curve(path):
    """(plastic strain, [(elastic strain, pressure)]) of the unloading branch, run on to zero pressure."""
    rows = numbers(path)
    turn = max(range(len(rows)), key=lambda i: rows[i][1])
    branch = ascending([(s / 100, p * 1e6) for s, p in reversed(rows[turn:])])
    (s0, p0), (s1, p1) = branch[0], branch[1]
    plastic = s0 - p0 * (s1 - s0) / (p1 - p0)
    return plastic, [(0.0, 0.0)] + [(s - plastic, p) for s, p in branch]


def vaango_table(path, x, y):
    data = json.loads(path.read_text())["Vaango_tabular_data"]["Data"]
    return ascending(list(zip(data[x], data[y])))


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


def write(path, title, header, rows):
    with open(path, "w") as file:
        for line in [title, *SOURCE]:
            file.write(f"# {line}\n")
        file.write(header + "\n")
        for row in rows:
            file.write(",".join(f"{value:.10g}" for value in row) + "\n")
    print(f"{path.name}: {len(rows)} rows")


def main():
    raw = pathlib.Path(sys.argv[1])
    out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "inputs/materials/concrete-sand")
    out.mkdir(parents=True, exist_ok=True)

    loading = hydrostat(raw)
    write(out / "hydrostat.csv", "Hydrostatic loading.", "total_volumetric[-],pressure[Pa]", thinned(loading))

    curves = []
    for path in sorted((raw / "measured").glob("DrySand_LoadUnload_*.csv")):
        plastic, points = unloading_curve(path)
        curves.append((plastic, thinned(points, SLOPE_TOLERANCE)))
    rows = [(plastic, e, p) for plastic, points in curves for e, p in points]
    header = "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]"
    write(out / "unloading.csv", "Hydrostatic unloading, each curve from its own plastic strain.", header, rows)

    header = "plastic_volumetric[-],pressure[Pa]"
    published = vaango_table(raw / "vaango" / "DrySand_HydrostaticCapData.json", "PlasticStrainVol", "Pressure")
    write(out / "crush_curve.csv", "Hydrostatic strength (crush curve), the published one.", header, thinned(published))

    strength = vaango_table(raw / "vaango" / "DrySand_YieldData.json", "Pressure", "SqrtJ2")
    title = "Yield in triaxial compression; the first row is the tension vertex."
    write(out / "yield.csv", title, "pressure[Pa],sqrt_J2[Pa]", thinned(strength))


if __name__ == "__main__":
    main()
