"""How far pressure alternates from one row of compacted particles to the next, by anti-locking and other keys.

Runs the scene to the time with each pair. Of the particles that are compacted by at least that part of their volume and
under at least a tenth of the largest pressure of these, it takes those whose neighbours along an axis in the lattice
they started in are such particles too. Prints, along x and along y, the sum of |p(-1) - 2 p + p(+1)| / 2 over that of
p: where p is m + a and m - a in turns this is 2 a / m, and where it is linear it is 0. The same for the fields of the
list below. Then depth, steps, user time, and how much energy is missing. Debian's python3-h5py is used.
"""

import pathlib
import tempfile

import numpy as np

from tamp import files, program, results
from tamp.markdown import print_head, print_row
from tamp.options import add_settings, positive

FIELDS = ("p", "J", "elastic_volumetric", "plastic_volumetric")


def alternations(lattice, fields, compacted, axis):
    """How far each field alternates over the compacted particles; and how many of these there were."""
    shape = lattice.max(axis=0) + 1
    p = fields["p"]
    chosen = fields["J"] < 1 - compacted
    chosen &= p > 0.1 * p[chosen].max()
    on_lattice = np.zeros(shape, dtype=bool)
    on_lattice[tuple(lattice.T)] = chosen
    middle = np.take(on_lattice, range(1, shape[axis] - 1), axis)
    both = (middle & np.take(on_lattice, range(shape[axis] - 2), axis)
            & np.take(on_lattice, range(2, shape[axis]), axis))
    found = {}
    for name, values in fields.items():
        # A volume ratio alternates about what is compacted of it.
        field = np.zeros(shape)
        field[tuple(lattice.T)] = 1 - values if name == "J" else values
        before, here, after = (np.take(field, range(k, shape[axis] - 2 + k), axis)[both] for k in range(3))
        found[name] = np.abs(before - 2 * here + after).sum() / 2 / np.abs(here).sum()
    return found, int(both.sum())


def run(options, settings):
    ends = [("/time/end", options.time), ("/output/fields_interval", options.time)]
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place, "run")
        seconds, done = program.timed_run(options.tamp, options.scene, folder, settings=[*ends, *settings],
                                          allowed=(0, 3))
        if done.returncode == 3:
            return [done.stderr.strip().splitlines()[-1]]
        scene, summary = files.document(folder / "scene.json"), results.summary(folder)
        history = results.history(folder)
        start, end = (results.particles(folder, options.sand, time) for time in (0, options.time))
    spacing = scene["grid"]["cell_size"] / scene["particles_per_cell"][0]
    lattice = np.round(start.position[:, :2] / spacing - 0.5).astype(int)
    cells = []
    for axis in (0, 1):
        found, n = alternations(lattice, {name: end[name] for name in FIELDS if name in end}, options.compacted, axis)
        cells += [f"{n}", *(f"{part:.1%}" for part in found.values())]
    depth = next(values[-1] for name, values in history.items() if name.endswith(".depth"))
    return [*cells, f"{depth:.4f} m", f"{summary['steps']:,}", f"{seconds:.1f} s", f"{summary['energy_error']:.2%}"]


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--scene", type=pathlib.Path, default=program.INPUTS / "punch/quick.json")
    parser.add_argument("--sand", default="sand", help="the name of the material")
    parser.add_argument("--time", type=positive, default=1e-3)
    parser.add_argument("--compacted", type=positive, default=0.1)
    parser.add_argument("--anti-locking", default="none,cell_average,f_bar")
    parser.add_argument("--interpolators", default="gimp,quadratic_spline")
    add_settings(parser)


def main(options):
    fields = [f"{name} along {axis}" for axis in "xy" for name in ("particles", *FIELDS)]
    print_head(["interpolator", "anti-locking", *fields, "depth", "steps", "user time", "energy error"])
    for interpolator in options.interpolators.split(","):
        for anti_locking in options.anti_locking.split(","):
            chosen = [("/interpolator", interpolator), ("/anti_locking", anti_locking)]
            print_row([interpolator, anti_locking, *run(options, [*chosen, *options.set])])
