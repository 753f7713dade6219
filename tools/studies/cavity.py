#!/usr/bin/env python3
"""What inputs/verification/scenes/cavity.json has to find: the pressure on the hole's rim and the work of the stresses.

    python3 tools/studies/cavity.py [--program build/release/tamp] [--scene inputs/verification/scenes/cavity.json]

All points go along one path of stress, from `tamp drive`, see components/problems/cavity.hpp: with e the logarithm of
the stretch of circles, strains are -m e along the radius and e around. The work per undeformed volume is the integral of
J (s_T - m s_R) de with J = exp((1 - m) e), and that of the ring its integral over R. Only the standard library is used.
"""

import argparse
import bisect
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
N_ROWS, N_RINGS = 400, 2000
LEAST_INCREMENT = 1e-5


def material_of(scene_file, scene):
    """Its file, and what the scene lays over it as arguments of `tamp drive`."""
    (material,) = scene["materials"].values()
    own = {key: value for key, value in material.items() if key != "file"}
    return scene_file.parent / material["file"], [f"--set=/{key}={json.dumps(value)}" for key, value in own.items()]


def stress_path(program, material, own, shortening, last):
    """Rows of e and the stresses along the radius and around."""
    with tempfile.TemporaryDirectory() as folder:
        path, table = pathlib.Path(folder, "path.csv"), pathlib.Path(folder, "table.csv")
        lines = ["time,F11,F12,F13,F21,F22,F23,F31,F32,F33"]
        for i in range(N_ROWS + 1):
            e = last * i / N_ROWS
            lines.append(f"{i},{math.exp(-shortening * e)!r},0,0,0,{math.exp(e)!r},0,0,0,1")
        path.write_text("\n".join(lines) + "\n")
        arguments = ["--increment", str(LEAST_INCREMENT), "--set", "/tolerance=1e-8", "--set", "/max_substeps=100000", *own]
        subprocess.run([program, "drive", material, path, "--out", table, *arguments], check=True)
        rows = [line for line in table.read_text().splitlines() if not line.startswith("#")]
    return [(math.log(float(row["F22"])), float(row["s11[Pa]"]), float(row["s22[Pa]"])) for row in csv.DictReader(rows)]


def work_along(path, shortening):
    """Work per undeformed volume at each row, by trapezoids."""
    rates = [math.exp((1 - shortening) * e) * (hoop - shortening * radial) for e, radial, hoop in path]
    work = [0.0]
    for (e0, *_), (e1, *_), rate0, rate1 in zip(path, path[1:], rates, rates[1:]):
        work.append(work[-1] + 0.5 * (rate0 + rate1) * (e1 - e0))
    return work


def at(x, xs, ys):
    k = min(max(bisect.bisect(xs, x), 1), len(xs) - 1)
    return ys[k - 1] + (x - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build/release/tamp")
    parser.add_argument("--scene", type=pathlib.Path, default=ROOT / "inputs/verification/scenes/cavity.json")
    options = parser.parse_args()

    scene = json.loads(options.scene.read_text())
    (body,) = scene["bodies"].values()
    problem = body["problem"]
    inner, outer, shortening = problem["inner_radius"], problem["outer_radius"], problem["shortening"]
    n = 1 + shortening
    growth = inner**n * ((1 + problem["expansion"]) ** n - 1)
    material, own = material_of(options.scene, scene)
    path = stress_path(options.program, material, own, shortening, math.log(1 + problem["expansion"]))
    strains, work = [row[0] for row in path], work_along(path, shortening)
    step = (outer - inner) / N_RINGS
    middles = (inner + (i + 0.5) * step for i in range(N_RINGS))
    total = sum(2 * math.pi * R * step * at(math.log((R**n + growth) ** (1 / n) / R), strains, work) for R in middles)
    print(f"pressure on the rim of the hole at the end: {-path[-1][1]:.8g} Pa")
    print(f"work of the stresses up to the end: {total:.8g} J")


if __name__ == "__main__":
    main()
