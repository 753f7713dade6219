#!/usr/bin/python3
"""How far pressure alternates from one row of compacted particles to the next, by relief, interpolator and other keys.

    tools/studies/pressure_alternation.py [--program PROGRAM] [--scene SCENE] [--time 1e-3] [--compacted 0.1]
                                          [--reliefs none,cell_average,f_bar] [--interpolators gimp,quadratic_spline]
                                          [--set POINTER=VALUE ...]

Runs the scene to the time with each pair. Of the particles that are compacted by at least that part of their volume and
under at least a tenth of the largest pressure of these, it takes those whose neighbours along an axis in the lattice they
started in are such particles too. Prints, along x and along y, the sum of |p(-1) - 2 p + p(+1)| / 2 over that of p: where p
is m + a and m - a in turns this is 2 a / m, and where it is linear it is 0. The same for the fields of the list below. Then
depth, steps, user time, and how much energy is missing. Debian's python3-h5py is used.
"""

import argparse
import csv
import json
import pathlib
import resource
import subprocess
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIELDS = ("p", "J", "elastic_volumetric", "plastic_volumetric")


def lattice_of(step, material, spacing):
    """Each particle's place in the lattice it started in."""
    particles = step[f"particles/{material}"]
    order = numpy.argsort(particles["id"][:])
    return numpy.round(particles["position"][:][order, :2] / spacing - 0.5).astype(int)


def fields_of(step, material):
    particles = step[f"particles/{material}"]
    order = numpy.argsort(particles["id"][:])
    return {name: particles[name][:][order] for name in FIELDS if name in particles}


def alternations(lattice, fields, compacted, axis):
    """Of each field, over the compacted particles; and how many of these there were."""
    shape = lattice.max(axis=0) + 1
    p = fields["p"]
    chosen = fields["J"] < 1 - compacted
    chosen &= p > 0.1 * p[chosen].max()
    on_lattice = numpy.zeros(shape, dtype=bool)
    on_lattice[tuple(lattice.T)] = chosen
    middle = numpy.take(on_lattice, range(1, shape[axis] - 1), axis)
    both = (middle & numpy.take(on_lattice, range(shape[axis] - 2), axis)
            & numpy.take(on_lattice, range(2, shape[axis]), axis))
    found = {}
    for name, values in fields.items():
        # A volume ratio alternates about what is compacted of it.
        field = numpy.zeros(shape)
        field[tuple(lattice.T)] = 1 - values if name == "J" else values
        before, here, after = (numpy.take(field, range(k, shape[axis] - 2 + k), axis)[both] for k in range(3))
        found[name] = numpy.abs(before - 2 * here + after).sum() / 2 / numpy.abs(here).sum()
    return found, int(both.sum())


def run(arguments, changes):
    with tempfile.TemporaryDirectory() as folder:
        command = [arguments.program, "run", arguments.scene, "--out", f"{folder}/run", "--quiet", "--threads", "1"]
        for change in [f"/time/end={arguments.time}", f"/output/fields_interval={arguments.time}"] + changes:
            command += ["--set", change]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        answer = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if answer.returncode not in (0, 3):
            raise SystemExit(answer.stderr)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if answer.returncode == 3:
            return answer.stderr.strip().splitlines()[-1]
        scene, summary = (json.loads(pathlib.Path(f"{folder}/run/{name}.json").read_text())
                          for name in ("scene", "summary"))
        with open(f"{folder}/run/history.csv") as file:
            last = list(csv.DictReader(file))[-1]
        with h5py.File(f"{folder}/run/fields.h5") as file:
            steps = sorted(name for name in file if name.startswith("step_"))
            spacing = scene["grid"]["cell_size"] / scene["particles_per_cell"][0]
            lattice = lattice_of(file[steps[0]], arguments.sand, spacing)
            fields = fields_of(file[steps[-1]], arguments.sand)
    cells = []
    for axis in (0, 1):
        found, n = alternations(lattice, fields, arguments.compacted, axis)
        cells += [f"{n}"] + [f"{part:.1%}" for part in found.values()]
    depth = next(float(last[name]) for name in last if name.endswith(".depth[m]"))
    return " | ".join(cells + [f"{depth:.4f} m", f"{summary['steps']:,}", f"{seconds:.1f} s",
                               f"{summary['energy_error']:.2%}"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build/release/tamp")
    parser.add_argument("--scene", default=ROOT / "inputs/punch/quick.json")
    parser.add_argument("--sand", default="sand", help="the name of the material")
    parser.add_argument("--time", default="1e-3")
    parser.add_argument("--compacted", type=float, default=0.1)
    parser.add_argument("--reliefs", default="none,cell_average,f_bar")
    parser.add_argument("--interpolators", default="gimp,quadratic_spline")
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()

    columns = ["interpolator", "relief"]
    columns += [f"{name} along {axis}" for axis in "xy" for name in ("particles",) + FIELDS]
    columns += ["depth", "steps", "user time", "energy error"]
    print("| " + " | ".join(columns) + " |\n|" + " --- |" * len(columns))
    for interpolator in arguments.interpolators.split(","):
        for relief in arguments.reliefs.split(","):
            cells = run(arguments, [f"/interpolator={interpolator}", f"/relief={relief}"] + arguments.set)
            print(f"| {interpolator} | {relief} | {cells} |", flush=True)


if __name__ == "__main__":
    main()
