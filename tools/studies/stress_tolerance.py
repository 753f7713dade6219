#!/usr/bin/env python3
"""What the tolerance of the sand's stress does to a run, beside what round-off does to it.

    tools/studies/stress_tolerance.py [--program PROGRAM] [--scene SCENE] [--sand NAME]
                                      [--tolerances 1e-6,1e-5,1e-4,1e-3] [--set POINTER=VALUE ...]

Runs the scene once for each tolerance, and three times at the first one with the density of the sand changed by parts in
1e12. Prints, for each, how far its results are from those of the first tolerance, relative to the greatest value that
they have in the run: the body's depth (the greatest difference at any time), the sand's peaks of pressure and q, the
greatest cap and plastic volumetric strain, and the energies at the end. The last column is user time over that of the
first run. The rows of round-off tell what of a difference is chance. A shorter run ends at an earlier time, as
`--set /time/end=1e-4`, not after a number of steps, whose sizes differ.
"""

import argparse
import csv
import json
import pathlib
import resource
import subprocess
import tempfile
import typing

ROOT = pathlib.Path(__file__).resolve().parents[2]
PEAKS = {"p peak": "p_max[Pa]", "q peak": "q_max[Pa]", "cap": "cap_max[Pa]",
         "plastic strain": "plastic_volumetric_max[-]"}
ENERGIES = {"plastic energy": "plastic[J]", "total energy": "total[J]"}


class Run(typing.NamedTuple):
    history: dict  # columns, those of the sand without its name
    depth: list
    seconds: float  # user time
    summary: dict
    density: float  # of the sand


def run(arguments, **keys):
    """Runs the scene with these keys of the sand."""
    sand = f"/materials/{arguments.sand}"
    changes = [f"{sand}/{key}={value}" for key, value in keys.items()] + arguments.set
    with tempfile.TemporaryDirectory() as folder:
        command = [arguments.program, "run", arguments.scene, "--out", f"{folder}/run", "--quiet", "--threads", "1"]
        for change in changes:
            command += ["--set", change]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        with open(f"{folder}/run/history.csv") as file:
            rows = list(csv.DictReader(file))
        scene, summary = (json.loads(pathlib.Path(f"{folder}/run/{name}.json").read_text())
                          for name in ("scene", "summary"))
    depth = next(name for name in rows[0] if name.endswith(".depth[m]"))
    column = {name: [float(row[name]) for row in rows] for name in rows[0] if name and rows[0][name]}
    of_sand = {key.removeprefix(f"{arguments.sand}."): values for key, values in column.items()}
    return Run(of_sand, column[depth], seconds, summary, scene["materials"][arguments.sand]["density"])


def at(times, values, time):
    """Straight between the rows."""
    k = next((i for i, t in enumerate(times) if t >= time), len(times) - 1)
    if k == 0 or times[k] == times[k - 1]:
        return values[k]
    part = min((time - times[k - 1]) / (times[k] - times[k - 1]), 1)
    return values[k - 1] + part * (values[k] - values[k - 1])


def depth_difference(reference, other):
    """The greatest at any time, over the greatest depth."""
    times, depth = other.history["time[s]"], other.depth
    apart = max(abs(at(times, depth, t) - d) for t, d in zip(reference.history["time[s]"], reference.depth))
    return apart / max(map(abs, reference.depth))


def differences(reference, other):
    a, b, depth_a, depth_b = reference.history, other.history, reference.depth, other.depth
    scale = max(map(abs, depth_a))
    found = {"depth(t)": depth_difference(reference, other), "greatest depth": abs(max(depth_b) - max(depth_a)) / scale}
    for name, key in PEAKS.items():
        found[name] = abs(max(b[key]) / max(a[key]) - 1)
    total = a["total[J]"][0] or 1
    for name, key in ENERGIES.items():
        found[name] = abs(b[key][-1] - a[key][-1]) / abs(total)
    return found


def arguments_of_runs(description):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build/release/tamp")
    parser.add_argument("--scene", default=ROOT / "inputs/punch/quick.json")
    parser.add_argument("--sand", default="sand", help="the name of the material")
    parser.add_argument("--set", action="append", default=[])
    return parser


def main():
    parser = arguments_of_runs(__doc__)
    parser.add_argument("--tolerances", default="1e-6,1e-5,1e-4,1e-3")
    arguments = parser.parse_args()

    tolerances = arguments.tolerances.split(",")
    reference = run(arguments, tolerance=tolerances[0])
    rows = [(f"round-off {k}", run(arguments, tolerance=tolerances[0], density=reference.density * (1 + k * 1e-12)))
            for k in (1, 2, 3)]
    rows += [(tolerance, run(arguments, tolerance=tolerance)) for tolerance in tolerances[1:]]
    names = list(differences(reference, reference))
    print("| tolerance | " + " | ".join(names) + " | time |\n|" + " --- |" * (len(names) + 2))
    for title, result in rows:
        found = differences(reference, result)
        cells = " | ".join(f"{found[name]:.1e}" for name in names)
        print(f"| {title} | {cells} | {result.seconds / reference.seconds:.2f} |", flush=True)


if __name__ == "__main__":
    main()
