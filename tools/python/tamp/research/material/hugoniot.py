"""Exact answers for a piston that is driven into sand at some speeds: stress, pressure, density and speed of the front.

In uniaxial strain sand goes along one path of stress, whatever the rate: sigma(e) from `tamp drive`, e the compaction 1
- V / V0. Where the path stiffens a compression is a shock, and where it softens it spreads; the waves that run into
sand at rest, from the fastest, are the pieces of the path's upper concave hull from 0 to e, and the matter behind them
moves with the sum over pieces of sqrt(d sigma d e / density). Solved for e at the piston's speed. With one piece that
is density U v = sigma, v / U = e. Of another reading of the same sand: --material and --set, as `tamp drive` has it,
for instance --set /elastic_update=state.
"""

import math
import pathlib

from tamp import files, program
from tamp.research.material.drive import TIGHT, diagonal, drive
from tamp.options import add_settings, finite, positive

MOST_COMPACTED = 0.3


def uniaxial_path(tamp, material, increment, settings):
    """Compaction, stress and pressure, compression positive."""
    rows = [(0, diagonal(1, 1, 1)), (1, diagonal(1 - MOST_COMPACTED, 1, 1))]
    run = drive(tamp, material, rows, increment, [*TIGHT.items(), *settings])
    return list(zip((1 - run["F11"]).tolist(), (-run["s11"]).tolist(), run["p"].tolist()))


def density_of(material):
    """The density in a material's file, or in the file that it builds on."""
    content = files.document(material)
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

    def speed_of(n):
        return sum(change for _, change in waves(path[: n + 1], density))

    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if speed_of(middle) > speed else (middle, high)
    part = (speed - speed_of(low)) / (speed_of(high) - speed_of(low))
    return (*(a + part * (b - a) for a, b in zip(path[low], path[high])), list(waves(path[: low + 1], density)))


def add_arguments(parser):
    parser.add_argument("speeds", nargs="*", type=finite, default=[20, 50, 100, 200], metavar="SPEED")
    program.add_option(parser)
    parser.add_argument("--material", type=pathlib.Path, default=program.SAND / "table.json")
    parser.add_argument("--increment", type=positive, default=1e-5)
    add_settings(parser)


def main(options):
    density = density_of(options.material)
    path = uniaxial_path(options.tamp, options.material, options.increment, options.set)
    print("speed [m/s]  stress [Pa]     pressure [Pa]   density [kg/m3]  last front [m/s]  first wave [m/s]  "
          "before the last [m/s]")
    for speed in options.speeds:
        compaction, stress, pressure, fronts = behind_front(path, density, speed)
        precursor = speed - fronts[-1][1]
        print(f"{speed:<12g} {stress:<15.8g} {pressure:<15.8g} {density / (1 - compaction):<16.8g} "
              f"{fronts[-1][0]:<17.7g} {fronts[0][0]:<17.7g} {precursor if len(fronts) > 1 else 0:.3g}")
