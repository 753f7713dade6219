"""Shows what a cheaper scene saves, and that it says the same: pairs of scenes, side by side.

Each pair is run on one thread, in turns, and the least of the times counts; nothing else should run meanwhile. A row
has the steps and the core-seconds of both, how much cheaper the second is, and by how much what is compared differs. It
prints the tables of results/savings.
"""

import argparse
import pathlib
import tempfile
from typing import NamedTuple

from tamp import options as words
from tamp import program, results
from tamp.markdown import print_head, print_row


class Run(NamedTuple):
    scene: str  # below inputs
    settings: dict = {}


class Certificate(NamedTuple):
    """A scene and one that is to say the same for less; what is compared is the depth of `body`, or, where that is
    driven, the work that drives it, of the whole."""

    name: str
    whole: Run
    part: Run
    body: str
    driven: bool = False


MILLISECOND = {"/time/end": 1e-3}
RIGID = {"/bodies/punch/rigid": True}
HALF_OF_PUNCH = {"/grid/lower": [0.5, 0], "/grid/patches": [1, 2]}
WITHOUT_TURNING = {"/centrifuge": None, "/gravity": [0, 0, -196.2], "/time/end": 4e-4}
PROJECTILE = "/bodies/projectile"
STRAIGHT_DOWN = {**WITHOUT_TURNING, f"{PROJECTILE}/geometry/rotation/angle": 270,
                 f"{PROJECTILE}/geometry/translation": [0.075, 0.05, 0.1085],
                 f"{PROJECTILE}/nose": [0.075, 0.05, 0.1085], f"{PROJECTILE}/tail": [0.075, 0.05, 0.1495],
                 f"{PROJECTILE}/velocity": [0, 0, -283]}

WITHOUT_FINS = {f"{PROJECTILE}/geometry/of": {
    "type": "revolved", "start": [0, 0, 0], "axis": [1, 0, 0], "tip_radius": 0.001,
    "profile": [[0, 0], [0.01845, 0.0058], [0.0246, 0.00205], [0.041, 0.00205]]}}
CONE = "/bodies/cone/geometry/of/1/of"
FINE = {"/grid/cell_size": 0.0025}
OF_REPORT = {**MILLISECOND, "/grid/cell_size": 0.01, "/grid/upper": [1.0, 0.8, 0.01], "/grid/patches": [1, 1, 1],
             "/interpolator": "gimp", "/time/rule": "published", "/time/multiplier": 0.05,
             "/artificial_viscosity": {"linear": 0.2, "quadratic": 2.0}, "/contact/0/normal": "flatter",
             "/bodies/punch/geometry/upper": [0.65, 0.7, 0.01], "/bodies/sand/geometry/upper": [1.0, 0.5, 0.01]}
# As only a rigid body is met by its solid.
BY_REGRESSION = {"/contact/0/normal": "regression"}
ON_1_MM_BY_REGRESSION = {"/grid/cell_size": 0.001, **BY_REGRESSION}
TO_100_US, TO_850_US = {"/time/end": 1e-4}, {"/time/end": 8.5e-4}
FINER = {**MILLISECOND, "/grid/cell_size": 0.0125, "/grid/patches": [1, 1]}
HALF_OF_FINER = {**FINER, "/grid/lower": [0.5, 0]}
# A little less than what `tamp check` advises; waves are back from its sides at 0.1 ms.
IN_SMALLER_BOX = {**TO_100_US, **BY_REGRESSION, "/transfer": "tflip",
                  "/grid/lower": [0, 0.05, 0.02], "/grid/upper": [0.085, 0.09, 0.16],
                  "/grid/patches": [1, 1, 1], "/bodies/sand/geometry/lower": [0, 0.05, 0.02],
                  "/bodies/sand/geometry/upper": [0.085, 0.09, 0.107]}
FAST_CONE = {"/grid/upper": [0.06, 0.06, 0.18], "/grid/patches": [1, 1, 1], "/time/end": 0.004,
             "/output/fields_interval": 1,
             "/bodies/sand/geometry/upper": [0.06, 0.06, 0.09], "/bodies/cone/driven/velocities": [[0, 0, 0, -10]],
             "/bodies/cone/geometry/of/0/upper": [0.06, 0.06, 0.18],
             f"{CONE}/0/first_end": [0, 0, 0.09], f"{CONE}/0/second_end": [0, 0, 0.116],
             f"{CONE}/1/first_end": [0, 0, 0.116], f"{CONE}/1/second_end": [0, 0, 0.14]}
FAST_CONE_IN_PLANE = {"/grid/upper": [0.06, 0.18], "/grid/patches": [1, 1], "/grid/cell_size": 0.005,
                      "/time/end": 0.004, "/output/fields_interval": 1,
                      "/bodies/sand/geometry/upper": [0.06, 0.09], "/bodies/cone/driven/velocities": [[0, 0, -10]],
                      "/bodies/cone/geometry/corners": [[0, 0.09], [0.015, 0.116], [0.015, 0.14], [0, 0.14]]}
FLAT_ROD = {"/time/end": 4e-5, "/bodies/rod/geometry/of/1": {
    "type": "cylinder", "first_end": [0, 0, 0.024], "second_end": [0, 0, 0.048], "radius": 0.006}}
FLAT_ROD_IN_PLANE = {"/time/end": 4e-5, "/bodies/rod/geometry/of": {
    "type": "cylinder", "first_end": [0, 0.024, 0], "second_end": [0, 0.048, 0], "radius": 0.006}}

CERTIFICATES = {
    "half": [
        Certificate("punch, deformable: half", Run("punch/quick.json", MILLISECOND),
                    Run("punch/quick.json", {**MILLISECOND, **HALF_OF_PUNCH}), "punch"),
        Certificate("punch, rigid: half", Run("punch/quick.json", {**MILLISECOND, **RIGID}),
                    Run("punch/half.json", MILLISECOND), "punch"),
        Certificate("punch, deformable: half and rigid", Run("punch/quick.json", MILLISECOND),
                    Run("punch/half.json", MILLISECOND), "punch"),
        Certificate("punch on 1.25 cm, deformable: half", Run("punch/quick.json", FINER),
                    Run("punch/quick.json", HALF_OF_FINER), "punch"),
        Certificate("punch on 1.25 cm, deformable: half and rigid", Run("punch/quick.json", FINER),
                    Run("punch/quick.json", {**HALF_OF_FINER, **RIGID}), "punch"),
        Certificate("projectile at 45 degrees: half", Run("uxo/quick.json", WITHOUT_TURNING),
                    Run("uxo/half.json", {"/time/end": 4e-4}), "projectile"),
        Certificate("projectile straight down: half", Run("uxo/quick.json", STRAIGHT_DOWN),
                    Run("uxo/quick.json", {**STRAIGHT_DOWN, "/grid/lower": [0, 0.05, 0]}), "projectile"),
        Certificate("projectile straight down: quarter", Run("uxo/quick.json", STRAIGHT_DOWN),
                    Run("uxo/quick.json", {**STRAIGHT_DOWN, "/grid/lower": [0.075, 0.05, 0]}), "projectile"),
    ],
    "axisymmetric": [
        Certificate("cone, 3 cells to its radius: quarter, axisymmetric", Run("cone/quick.json", FAST_CONE),
                    Run("cone/axisymmetric.json", FAST_CONE_IN_PLANE), "cone", driven=True),
        Certificate("cone, 6 cells: quarter, axisymmetric", Run("cone/quick.json", {**FAST_CONE, **FINE}),
                    Run("cone/axisymmetric.json", {**FAST_CONE_IN_PLANE, **FINE}), "cone", driven=True),
        Certificate("rod with an ogive, 3 cells: quarter, axisymmetric", Run("studies/scenes/rod.json"),
                    Run("savings/rod.json"), "rod", driven=True),
        Certificate("rod with an ogive, 6 cells: quarter, axisymmetric",
                    Run("studies/scenes/rod.json", {"/grid/cell_size": 0.001}),
                    Run("savings/rod.json", {"/grid/cell_size": 0.001}), "rod", driven=True),
        Certificate("rod with a flat end, 3 cells: quarter, axisymmetric", Run("studies/scenes/rod.json", FLAT_ROD),
                    Run("savings/rod.json", FLAT_ROD_IN_PLANE), "rod", driven=True),
        Certificate("ball, free, 6 cells: quarter, axisymmetric", Run("savings/ball_in_space.json"),
                    Run("savings/ball.json"), "ball"),
        Certificate("projectile without fins, free, 1.2 cells: quarter, axisymmetric",
                    Run("uxo/quick.json", {**STRAIGHT_DOWN, **WITHOUT_FINS, "/grid/lower": [0.075, 0.05, 0]}),
                    Run("savings/projectile_straight_down.json"), "projectile"),
    ],
    "slab": [
        Certificate("punch: slab, plane strain", Run("punch/slab.json", MILLISECOND),
                    Run("punch/quick.json", MILLISECOND), "punch"),
    ],
    "report": [
        Certificate("punch: the report's slab on 1 cm, half on 2.5 cm with `tflip`", Run("punch/slab.json", OF_REPORT),
                    Run("punch/quick.json", {**MILLISECOND, **HALF_OF_PUNCH, "/transfer": "tflip"}), "punch"),
        Certificate("projectile to 0.1 ms: the report's, half and rigid, both on 5 mm",
                    Run("uxo/table.json", TO_100_US), Run("uxo/half.json", {**TO_100_US, **BY_REGRESSION}),
                    "projectile"),
        Certificate("the same, half with `tflip` in a smaller box",
                    Run("uxo/table.json", TO_100_US), Run("uxo/half.json", IN_SMALLER_BOX), "projectile"),
    ],
    "late": [
        Certificate("projectile to 0.85 ms: the report's, half and rigid with `tflip`",
                    Run("uxo/table.json", TO_850_US),
                    Run("uxo/half.json", {**TO_850_US, **BY_REGRESSION, "/transfer": "tflip"}),
                    "projectile"),
        Certificate("the same, with the report's viscosity", Run("uxo/table.json", TO_850_US),
                    Run("uxo/half.json", {**TO_850_US, **BY_REGRESSION, "/transfer": "tflip",
                                          "/artificial_viscosity": {"linear": 0.2, "quadratic": 2.0}}), "projectile"),
    ],
    "rigid": [
        Certificate("punch on 2.5 cm: deformable, rigid", Run("punch/quick.json", MILLISECOND),
                    Run("punch/quick.json", {**MILLISECOND, **RIGID}), "punch"),
        Certificate("projectile on 5 mm to 0.1 ms: deformable, rigid",
                    Run("uxo/quick.json", {"/bodies/projectile/rigid": False, **TO_100_US, **BY_REGRESSION}),
                    Run("uxo/quick.json", {**TO_100_US, **BY_REGRESSION}), "projectile"),
        Certificate("ball on 1 mm, axisymmetric: deformable, rigid",
                    Run("savings/ball.json", {"/bodies/ball/rigid": False, **ON_1_MM_BY_REGRESSION}),
                    Run("savings/ball.json", ON_1_MM_BY_REGRESSION), "ball"),
        Certificate("projectile straight down on 1 mm, axisymmetric, to 0.1 ms: deformable, rigid",
                    Run("savings/projectile_straight_down.json",
                        {"/bodies/projectile/rigid": False, **TO_100_US, **ON_1_MM_BY_REGRESSION}),
                    Run("savings/projectile_straight_down.json", {**TO_100_US, **ON_1_MM_BY_REGRESSION}),
                    "projectile"),
    ],
}


def measure(tamp, run, folder):
    """(user seconds, summary)"""
    seconds, _ = program.timed_run(tamp, program.INPUTS / run.scene, folder, settings=run.settings)
    return seconds, results.summary(folder)


def compared(certificate, summary):
    if certificate.driven:
        return summary["part_of_whole"]["factor"] * summary["energies_J"]["external"]
    return summary["bodies"][certificate.body]["depth_m"]


def row_of(tamp, certificate, n_times):
    with tempfile.TemporaryDirectory() as place:
        pairs = [[measure(tamp, run, pathlib.Path(place, "run")) for run in (certificate.whole, certificate.part)]
                 for _ in range(n_times)]
    seconds = [min(pair[i][0] for pair in pairs) for i in range(2)]
    summaries = [pairs[0][i][1] for i in range(2)]
    values = [compared(certificate, summary) for summary in summaries]
    return [certificate.name, " / ".join(f"{summary['steps']:,}" for summary in summaries),
            " / ".join(f"{s:.2f}" for s in seconds), f"{seconds[0] / seconds[1]:.2f}",
            " / ".join(f"{value:.6g}" for value in values), f"{abs(values[1] / values[0] - 1):.1e}"]


def table_name(text):
    if text not in CERTIFICATES:
        raise argparse.ArgumentTypeError(f"{text}; expected one of {', '.join(CERTIFICATES)}")
    return text


def add_arguments(parser):
    parser.add_argument("chosen", nargs="*", type=table_name, metavar="TABLE",
                        help=f"which tables, by default all: {', '.join(CERTIFICATES)}")
    parser.add_argument("--times", type=words.count, default=3, metavar="N", help="how often each pair is run (3)")
    program.add_option(parser)


def main(options):
    for table in options.chosen or CERTIFICATES:
        print_head(["scene: its part", "steps", "core-seconds", "times cheaper", "compared", "difference"])
        for certificate in CERTIFICATES[table]:
            print_row(row_of(options.tamp, certificate, options.times))
        print()
