#!/usr/bin/env python3
"""What a piston that is driven into sand at some speeds has to find: stress, pressure, density and speed of the front.

    python3 tools/studies/hugoniot.py [--program build/release/tamp] [--increment 1e-5] [--set POINTER=VALUE] [SPEED...]

In uniaxial strain sand goes along one path of stress, whatever the rate: sigma(e) from `tamp drive`, e the compaction
1 - V / V0. Where the path stiffens a compression is a shock, and where it softens it spreads; the waves that run into
sand at rest, from the fastest, are the pieces of the path's upper concave hull from 0 to e, and the matter behind them
moves with the sum over pieces of sqrt(d sigma d e / density). Solved for e at the piston's speed. With one piece that
is density U v = sigma, v / U = e. Of another reading of the same sand: --material and --set, as `tamp drive` has it, for
instance --set /elastic_update=state. Only the standard library is used.
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST_COMPACTED = 0.3


def uniaxial_path(program, material, increment, changes):
    """Compaction, stress and pressure, compression positive."""
    with tempfile.TemporaryDirectory() as folder:
        path, table = pathlib.Path(folder, "path.csv"), pathlib.Path(folder, "table.csv")
        path.write_text(f"time,F11,F12,F13,F21,F22,F23,F31,F32,F33\n0,1,0,0,0,1,0,0,0,1\n1,{1 - MOST_COMPACTED},0,0,0,1,0,0,0,1\n")
        arguments = ["--increment", str(increment), "--set", "/tolerance=1e-8", "--set", "/max_substeps=100000"]
        arguments += [argument for change in changes for argument in ("--set", change)]
        subprocess.run([program, "drive", material, path, "--out", table, *arguments], check=True)
        lines = [line for line in table.read_text().splitlines() if not line.startswith("#")]
    return [(1 - float(row["F11"]), -float(row["s11[Pa]"]), float(row["p[Pa]"])) for row in csv.DictReader(lines)]


def density_of(material):
    """Of a material's file, or of the file that it builds on."""
    content = json.loads(material.read_text())
    return content["density"] if "density" in content else density_of(material.parent / content["file"])


def hull(points):
    """The corners of the least concave function that is nowhere below the points."""
    corners = []
    for e, stress, _ in points:
        while len(corners) > 1:
            (e0, s0), (e1, s1) = corners[-2:]
            if (s1 - s0) * (e - e1) > (stress - s1) * (e1 - e0):
                break
            corners.pop()
        corners.append((e, stress))
    return corners


def waves(points, density):
    """Speed of each wave in the matter, and by how much it speeds that up."""
    corners = hull(points)
    for (e0, s0), (e1, s1) in zip(corners, corners[1:]):
        yield math.sqrt((s1 - s0) / (e1 - e0) / density), math.sqrt((s1 - s0) * (e1 - e0) / density)


def behind_front(path, density, speed):
    """Compaction, stress and pressure, and all waves."""
    low, high = 1, len(path) - 1
    speed_of = lambda n: sum(change for _, change in waves(path[: n + 1], density))
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if speed_of(middle) > speed else (middle, high)
    part = (speed - speed_of(low)) / (speed_of(high) - speed_of(low))
    return (*(a + part * (b - a) for a, b in zip(path[low], path[high])), list(waves(path[: low + 1], density)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("speeds", nargs="*", type=float, default=[20, 50, 100, 200], metavar="SPEED")
    parser.add_argument("--program", default=ROOT / "build/release/tamp")
    parser.add_argument("--material", type=pathlib.Path, default=ROOT / "inputs/materials/concrete-sand/table.json")
    parser.add_argument("--increment", type=float, default=1e-5)
    parser.add_argument("--set", action="append", default=[], metavar="POINTER=VALUE", help="replace a value of the material")
    options = parser.parse_args()

    density = density_of(options.material)
    path = uniaxial_path(options.program, options.material, options.increment, options.set)
    print("speed [m/s]  stress [Pa]     pressure [Pa]   density [kg/m3]  last front [m/s]  first wave [m/s]  before the last [m/s]")
    for speed in options.speeds:
        compaction, stress, pressure, fronts = behind_front(path, density, speed)
        precursor = speed - fronts[-1][1]
        print(f"{speed:<12g} {stress:<15.8g} {pressure:<15.8g} {density / (1 - compaction):<16.8g} {fronts[-1][0]:<17.7g}"
              f" {fronts[0][0]:<17.7g} {precursor if len(fronts) > 1 else 0:.3g}")


if __name__ == "__main__":
    main()
