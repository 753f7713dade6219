#!/usr/bin/env python3
"""The projectile's way into the sand on finer and finer grids, rigid and deformable, with each kind of contact normal.

    tools/studies/projectile_resolution.py [--tamp build/release/tamp] [--cells 5 2.5] [--normals regression projectile]
                                           [--bodies rigid deformable] [--shear-modulus 8e9] [--transfer flip]
                                           [--times 1e-4]

Runs inputs/uxo/quick.json on a part of its box that waves do not leave within 0.1 ms, or on a larger part if it is to
go on for longer, and prints a table. Cells are in mm; each half as wide costs about 16 times as much: on one core the
rigid projectile takes a minute to 0.1 ms on cells of 2.5 mm, the deformable one, with its shorter steps, about six."""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

import ranks

# In cells of 5 mm, so that every grid fits.
EARLY_BOX = ([0, 0.02, 0.04], [0.1, 0.08, 0.16])
BOX = ([0, 0.02, 0.02], [0.15, 0.08, 0.18])
SURFACE = 0.1075


def changes(options, normal, body, millimetres):
    """To quick.json, by JSON pointer."""
    end = max(options.times)
    lower, upper = EARLY_BOX if end <= 1e-4 else BOX
    return {
        "/grid/lower": lower, "/grid/upper": upper, "/grid/cell_size": millimetres / 1000,
        "/bodies/sand/geometry/lower": lower, "/bodies/sand/geometry/upper": [*upper[:2], SURFACE],
        "/bodies/projectile/rigid": body == "rigid", "/materials/projectile/shear_modulus": options.shear_modulus,
        # Particles of the projectile stay about 0.5 mm apart.
        "/materials/projectile/particles_per_axis": max(2, math.ceil(2 * millimetres)),
        "/contact/0/normal": normal, "/transfer": options.transfer, "/time/end": end, "/output/fields_interval": 1}


def run(tamp, given, folder):
    """The rows of the run's history as numbers, and its summary."""
    sets = [word for key, value in given.items() for word in ("--set", f"{key}={json.dumps(value)}")]
    scene = ranks.ROOT / "inputs/uxo/quick.json"
    subprocess.run([tamp, "run", scene, "--out", folder, "--quiet", *sets], check=True)
    with open(folder / "history.csv", newline="") as file:
        rows = [{name: float(text) for name, text in row.items()} for row in csv.DictReader(file)]
    return rows, ranks.summary(folder)


def print_rows(case, times, rows, summary):
    for time in times:
        row = min(rows, key=lambda one: abs(one["time[s]"] - time))
        speed = math.hypot(*(row[f"projectile.velocity_{k}[m/s]"] for k in "xyz"))
        depth = 1000 * (SURFACE - row["projectile.nose_z[m]"])
        print(f"| {case} | {row['step']:.0f} | {summary['wall_s'] * row['step'] / summary['steps']:.0f} s | "
              f"{1e6 * row['time[s]']:.0f} us | {speed:.1f} m/s | {depth:.2f} mm | "
              f"{row['projectile.axis_angle[deg]']:.1f} deg | {row['contact[J]']:.0f} J |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tamp", type=pathlib.Path, default=ranks.ROOT / "build/release/tamp")
    parser.add_argument("--cells", type=float, nargs="+", default=[5, 2.5], help="mm; 5 mm divided by a whole number")
    parser.add_argument("--normals", nargs="+", default=["regression", "projectile", "flatter"])
    parser.add_argument("--bodies", nargs="+", default=["rigid"], choices=["rigid", "deformable"])
    parser.add_argument("--shear-modulus", type=float, default=8e9, help="of the deformable projectile [Pa]")
    parser.add_argument("--transfer", default="flip", choices=["flip", "affine"])
    parser.add_argument("--times", type=float, nargs="+", default=[1e-4], help="to report at [s]")
    options = parser.parse_args()
    print("| normal | cells | body | steps | run | time | speed | nose, depth | axis, downwards | to contact |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for normal in options.normals:
        for millimetres in options.cells:
            for body in options.bodies:
                with tempfile.TemporaryDirectory() as folder:
                    given = changes(options, normal, body, millimetres)
                    rows, summary = run(options.tamp, given, pathlib.Path(folder) / "run")
                print_rows(f"{normal} | {millimetres:g} mm | {body}", options.times, rows, summary)


if __name__ == "__main__":
    main()
