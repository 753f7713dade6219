#!/usr/bin/env python3
"""The rigid projectile's first way into the sand on finer and finer grids, with each kind of contact normal.

    tools/studies/projectile_resolution.py [--tamp build/release/tamp] [--cells 5 2.5] [--normals regression projectile]

Runs inputs/uxo/quick.json on a part of its box that waves do not leave within the time, and prints a table. Cells are in
mm; each half as wide costs about 16 times as much: 2.5 mm take minutes, 1.25 mm about an hour."""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

import ranks

# In cells of 5 mm, so that every grid fits.
BOX = {"/grid/lower": [0, 0.02, 0.04], "/grid/upper": [0.1, 0.08, 0.16], "/bodies/sand/geometry/lower": [0, 0.02, 0.04],
       "/bodies/sand/geometry/upper": [0.1, 0.08, 0.1075]}
SURFACE = 0.1075


def run(tamp, millimetres, normal, end, folder):
    # Particles of the projectile stay about 0.5 mm apart.
    per_axis = max(2, math.ceil(2 * millimetres))
    given = BOX | {"/grid/cell_size": millimetres / 1000, "/materials/projectile/particles_per_axis": per_axis,
                   "/contact/0/normal": normal, "/time/end": end, "/output/fields_interval": 1}
    sets = [word for key, value in given.items() for word in ("--set", f"{key}={json.dumps(value)}")]
    scene = ranks.ROOT / "inputs/uxo/quick.json"
    subprocess.run([tamp, "run", scene, "--out", folder, "--quiet", *sets], check=True)
    with open(folder / "history.csv", newline="") as file:
        last = list(csv.DictReader(file))[-1]
    return json.loads((folder / "summary.json").read_text()), {name: float(text) for name, text in last.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tamp", type=pathlib.Path, default=ranks.ROOT / "build/release/tamp")
    parser.add_argument("--cells", type=float, nargs="+", default=[5, 2.5], help="mm; 5 mm divided by a whole number")
    parser.add_argument("--normals", nargs="+", default=["regression", "projectile", "flatter"])
    parser.add_argument("--end", type=float, default=1e-4, help="s")
    options = parser.parse_args()
    print("| normal | cells | steps | run | speed | nose below the surface | axis below the horizontal | to contact |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for normal in options.normals:
        for millimetres in options.cells:
            with tempfile.TemporaryDirectory() as folder:
                summary, last = run(options.tamp, millimetres, normal, options.end, pathlib.Path(folder) / "run")
            speed = math.hypot(*(last[f"projectile.velocity_{k}[m/s]"] for k in "xyz"))
            depth = 1000 * (SURFACE - last["projectile.nose_z[m]"])
            print(f"| {normal} | {millimetres:g} mm | {summary['steps']} | {summary['wall_s']:.0f} s | {speed:.0f} m/s | "
                  f"{depth:.1f} mm | {last['projectile.axis_angle[deg]']:.1f} deg | {last['contact[J]']:.0f} J |",
                  flush=True)


if __name__ == "__main__":
    main()
