"""Exact answers of inputs/verification/scenes/cavity.json: the pressure on the hole's rim and the work of the stresses.

All points go along one path of stress, from `tamp drive`, see components/problems/cavity.hpp: with e the logarithm of
the stretch of circles, strains are -m e along the radius and e around. The work per undeformed volume is the integral
of J (s_T - m s_R) de with J = exp((1 - m) e), and that of the ring its integral over R.
"""

import math
import pathlib

import numpy as np

from tamp import files, program
from tamp.research.material.drive import TIGHT, diagonal, drive

N_ROWS, N_RINGS = 400, 2000
LEAST_INCREMENT = 1e-5


def material_of(scene_file, scene):
    """Its file, and what the scene lays over it."""
    (material,) = scene["materials"].values()
    own = {f"/{key}": value for key, value in material.items() if key != "file"}
    return scene_file.parent / material["file"], own


def stress_path(tamp, material, own, shortening, last):
    """e, and the stresses along the radius and around."""
    strains = [last * i / N_ROWS for i in range(N_ROWS + 1)]
    rows = [(i, diagonal(math.exp(-shortening * e), math.exp(e), 1)) for i, e in enumerate(strains)]
    run = drive(tamp, material, rows, LEAST_INCREMENT, {**TIGHT, **own})
    return np.log(run["F22"]), run["s11"], run["s22"]


def work_along(strain, radial, hoop, shortening):
    """Work per undeformed volume at each row, by trapezoids."""
    rate = np.exp((1 - shortening) * strain) * (hoop - shortening * radial)
    return np.concatenate([[0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(strain))])


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--scene", type=pathlib.Path, default=program.INPUTS / "verification/scenes/cavity.json")


def main(options):
    scene = files.document(options.scene)
    (body,) = scene["bodies"].values()
    problem = body["problem"]
    inner, outer, shortening = problem["inner_radius"], problem["outer_radius"], problem["shortening"]
    n = 1 + shortening
    growth = inner**n * ((1 + problem["expansion"]) ** n - 1)
    material, own = material_of(options.scene, scene)
    strain, radial, hoop = stress_path(options.tamp, material, own, shortening, math.log(1 + problem["expansion"]))
    step = (outer - inner) / N_RINGS
    R = inner + (np.arange(N_RINGS) + 0.5) * step
    work = np.interp(np.log((R**n + growth) ** (1 / n) / R), strain, work_along(strain, radial, hoop, shortening))
    print(f"pressure on the rim of the hole at the end: {-radial[-1]:.8g} Pa")
    print(f"work of the stresses up to the end: {(2 * math.pi * R * step * work).sum():.8g} J")
