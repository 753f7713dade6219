"""Makes the path of deformation that inputs/studies/return_mapping.json takes a point of sand along.

Straight legs between corners, one a unit of time: hydrostatic loading with unloading to nearly nothing, uniaxial strain
with unloading, shearing to and fro under compression, and then corners drawn at random (always the same ones) with up
to 30 % of volumetric strain (logarithmic, compression positive).
"""

import math
import pathlib
import random

from tamp.research.material.drive import write_path
from tamp.program import INPUTS

SEED, N_RANDOM = 17, 24
MOST_COMPRESSED, LEAST_COMPRESSED = 0.30, 0.05
MOST_SHEARED = 0.08


def stretched(xx, yy, zz, xy=0.0, xz=0.0, yz=0.0):
    """F of logarithmic compressions along the axes, and of shears. Triangular, so that no leg turns it inside out."""
    return [math.exp(-xx), xy, xz, 0, math.exp(-yy), yz, 0, 0, math.exp(-zz)]


def isotropic(compression):
    return stretched(*3 * [compression / 3])


def random_corner(numbers):
    """Compression shared among the axes by chance, with shears of either sign."""
    compression = numbers.uniform(LEAST_COMPRESSED, MOST_COMPRESSED)
    shares = [numbers.uniform(0.2, 1) for _ in range(3)]
    axes = [compression * share / sum(shares) for share in shares]
    return stretched(*axes, *(numbers.uniform(-MOST_SHEARED, MOST_SHEARED) for _ in range(3)))


def corners():
    hydrostatic = [isotropic(c) for c in (0, 0.06, 0.04, 0.12, 0.09, 0.18, 0.14, 0.02)]
    uniaxial = [stretched(c, 0, 0) for c in (0.1, 0.2, 0.15, 0.25, 0.2)]
    sheared = [stretched(0.2, 0, 0, s, 0, -s / 2) for s in (0.06, -0.06, 0.1, -0.02)]
    numbers = random.Random(SEED)
    return [*hydrostatic, *uniaxial, *sheared, *(random_corner(numbers) for _ in range(N_RANDOM))]


def add_arguments(parser):
    parser.add_argument("--out", type=pathlib.Path, default=INPUTS / "studies/return_mapping/path.csv")


def main(options):
    write_path(options.out, list(enumerate(corners())), 6, ["Made by tools/python/tamp return-path."])
