"""Effects of single settings on the depth and the angle of the projectile, beside the report's.

Runs inputs/uxo/quick.json with a base of settings that is given in full below, and once more for each case, which
changes one thing. The box is a part of the scene's; sand that is torn separates, which takes a third of the steps.
Runs that are finished are kept in --out and not repeated; --print-only prints those and runs nothing. Tables are
Markdown: depths of nose and tail below the first surface and the angle of the axis below the horizontal at five times;
what each case is worth; stresses and plastic strain near the nose; and an estimate from the momentum and from the exact
shock of the piston. On one core a run to 0.85 ms takes about 20 s on cells of 5 mm and 6 to 8 minutes on 2.5 mm; the
deformable projectile takes some 5 minutes on 5 mm.
"""

import bisect
import json
import math
import pathlib

from tamp import files, program, results
from tamp.markdown import print_table
from tamp.options import positive
from tamp.program import INPUTS, ROOT, SAND

UXO = INPUTS / "uxo"
SURFACE = 0.1075
TIMES = [1e-4, 2e-4, 4e-4, 6e-4, 8.5e-4]
NOSE = [0.045, 0.05, 0.1085]
SPEED = 283
DENSITY = 5000

# In cells of 5 mm, so that every grid fits.
LOWER = [0, 0.02, 0.02]
UPPER = [0.15, 0.08, 0.16]


def base(millimetres, end):
    """To quick.json, by JSON pointer: everything that decides, so that the scene's own choices do not."""
    return {
        "/grid/lower": LOWER, "/grid/upper": UPPER, "/grid/patches": [1, 1, 1], "/grid/cell_size": millimetres / 1000,
        "/bodies/sand/geometry/lower": LOWER, "/bodies/sand/geometry/upper": [*UPPER[:2], SURFACE],
        "/interpolator": "gimp", "/transfer": "tflip", "/particles_per_cell": [2, 2, 2],
        "/time/rule": "viscous", "/time/multiplier": 1.0, "/time/end": end,
        "/artificial_viscosity/linear": 0.2, "/artificial_viscosity/quadratic": 2,
        "/materials/sand": {"file": str(SAND / "table.json"), "density": 1624, "elastic_update": "rate",
                            "separation": True},
        "/materials/projectile/density": DENSITY,
        # Particles of the projectile stay fine beside its fins, which are 1 mm thick.
        "/materials/projectile/particles_per_axis": 6 if millimetres >= 5 else 5,
        "/bodies/projectile/rigid": True, "/contact/0/normal": "regression", "/contact/0/friction": 0.1,
        "/output/fields_interval": 1, "/output/history_interval": 2e-6, "/limits/energy_error": "off",
    }


def longer(density):
    """The projectile scaled to the 50 mm of the published mesh."""
    reach = 0.05 / math.sqrt(2)
    tail = [round(NOSE[0] - reach, 8), NOSE[1], round(NOSE[2] + reach, 8)]
    return {"/bodies/projectile/geometry/of/file": str(UXO / "projectile_50mm.json"), "/bodies/projectile/tail": tail,
            "/materials/projectile/density": density, "/grid/upper": [*UPPER[:2], 0.17]}


OWN = {"/contact/0/normal": "projectile", "/transfer": "flip"}
SOLID = {"/bodies/projectile/rigid": False, "/time/rule": "published", "/time/multiplier": 0.2,
         "/materials/projectile/particles_per_axis": 10}
SQRT_J2 = {"/materials/sand/yield/file": str(SAND / "yield_sqrt_J2.csv")}
HEAVIER = 8204  # 15.9 g in the volume of 41 mm
MESH = 4512  # 15.86 g, the published mesh's mass, in ours of 50 mm


def viscosity(linear, quadratic):
    return {"/artificial_viscosity/linear": linear, "/artificial_viscosity/quadratic": quadratic}


# Name: (what it is, what it changes, what it is compared with).
CASES = {
    "base": ("base: q, regression, `tflip`, rigid, 41 mm, 9.7 g, viscosity 0.2 / 2", {}, None),
    "sqrtJ2": ("strength as sqrt(J2)", SQRT_J2, "base"),
    "vis14": ("viscosity 1 / 4", viscosity(1, 4), "base"),
    "vis10": ("viscosity 0.2 / 10", viscosity(0.2, 10), "base"),
    "mass": ("15.9 g in 41 mm", {"/materials/projectile/density": HEAVIER}, "base"),
    "50": ("15.9 g in 50 mm", longer(MESH), "base"),
    "frictionless": ("friction 0 instead of 0.1", {"/contact/0/friction": 0}, "base"),
    "rho1050": ("sand of 1050 kg/m3", {"/materials/sand/density": 1050}, "base"),
    "flip": ("`flip`", {"/transfer": "flip"}, "base"),
    "qa3": ("quadratic splines, `apic`, 3 particles an axis",
            {"/interpolator": "quadratic_spline", "/transfer": "apic", "/particles_per_cell": [3, 3, 3]}, "base"),
    "ca2": ("cubic splines, `apic`", {"/interpolator": "cubic_spline", "/transfer": "apic"}, "base"),
    "cpg": ("`cpgimp`", {"/interpolator": "cpgimp"}, "base"),
    "state": ("state form", {"/materials/sand/elastic_update": "state"}, "base"),
    "svr": ("SVR", {"/materials/sand/modulus/type": "svr"}, "base"),
    "mlp": ("MLP", {"/materials/sand/modulus/type": "mlp"}, "base"),
    "mult05": ("multiplier 0.5 instead of 1", {"/time/multiplier": 0.5}, "base"),
    "together": ("sand that stays together", {"/materials/sand/separation": False}, "base"),
    "flatter": ("normal `flatter`", {"/contact/0/normal": "flatter"}, "base"),
    "own": ("the projectile's normal, `flip`", OWN, "base"),
    "own_aff": ("and `tflip`", {**OWN, "/transfer": "tflip"}, "own"),
    "own_sqrtJ2": ("and strength as sqrt(J2)", {**OWN, **SQRT_J2}, "own"),
    "own_50": ("and 15.9 g in 50 mm", {**OWN, **longer(MESH)}, "own"),
    "own_vis14": ("and viscosity 1 / 4", {**OWN, **viscosity(1, 4)}, "own"),
    "own_vis10": ("and viscosity 0.2 / 10", {**OWN, **viscosity(0.2, 10)}, "own"),
    "own_def": ("and deformable", {**OWN, **SOLID}, "own"),
    "own_def_50": ("and deformable, 15.9 g in 50 mm", {**OWN, **SOLID, **longer(MESH)}, "own"),
    "def": ("deformable", SOLID, "base"),
    "50_vis14": ("15.9 g in 50 mm, viscosity 1 / 4", {**longer(MESH), **viscosity(1, 4)}, "base"),
}


def complete(folder, given):
    mark = folder / "given.json"
    return (folder / "history.csv").exists() and mark.exists() and files.document(mark) == given


def run(tamp, given, folder):
    """Runs, and marks the run with what was asked and its user time only when it is finished. One that comes to an end
    before its time, such as a projectile that leaves the box, counts as far as it came."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    user, _ = program.timed_run(tamp, UXO / "quick.json", folder, settings=given, allowed=(0, 3))
    (folder / "user_s.txt").write_text(f"{user:.1f}\n")
    (folder / "given.json").write_text(json.dumps(given, indent=1))


class Run:
    """Rows of a finished run."""

    def __init__(self, folder):
        self.rows = results.rows_of(results.history(folder))
        self.end = files.document(folder / "given.json")["/time/end"]
        self.user = float((folder / "user_s.txt").read_text())
        self.steps = int(self.rows[-1]["step"])

    def at(self, time):
        """None beyond the end."""
        row = min(self.rows, key=lambda one: abs(one["time"] - time))
        return row if abs(row["time"] - time) < 4e-6 else None

    def deepest(self):
        return max(self.rows, key=depth)


def depth(row, end="nose"):
    """Below the first surface [mm]."""
    return 1000 * (SURFACE - row[f"projectile.{end}_z"])


def angle(row):
    return row["projectile.axis_angle"]


def speed(row):
    return math.hypot(*(row[f"projectile.velocity_{axis}"] for axis in "xyz"))


def position(row):
    return "" if row is None else f"{depth(row):.1f} / {depth(row, 'tail'):.1f} / {angle(row):.0f}"


def print_positions(runs, millimetres):
    print(f"### {millimetres:g} mm: nose / tail [mm below the surface] / angle [degrees]\n")
    header = ["", *(f"{1e3 * time:g} ms" for time in TIMES), "deepest", "speed at the end", "steps", "user time"]
    rows = []
    for name, one in runs.items():
        deepest, end = one.deepest(), one.rows[-1]
        early = "" if end["time"] >= one.end else f", ends at {1e3 * end['time']:.2f} ms"
        rows.append([CASES[name][0], *(position(one.at(time)) for time in TIMES),
                     f"{depth(deepest):.1f} at {1e3 * deepest['time']:.2f} ms", f"{speed(end):.0f} m/s{early}",
                     f"{one.steps}", f"{one.user:.0f} s"])
    print_table(header, rows)


def print_worth(of_cells):
    """Differences from the case that each is compared with, on every grid where both reached the time."""
    print("### What each is worth: depth of the nose [mm] and angle [degrees]\n")
    header = [""]
    for millimetres in of_cells:
        header += [f"{millimetres:g} mm, {1e3 * time:g} ms" for time in (2e-4, 6e-4)]
    rows = []
    for name, (what, _, other) in CASES.items():
        row = [what]
        for runs in of_cells.values():
            for time in (2e-4, 6e-4):
                ends = [runs[one].at(time) if one in runs else None for one in (name, other)]
                row.append("" if None in ends else f"{depth(ends[0]) - depth(ends[1]):+.1f}, "
                                                   f"{angle(ends[0]) - angle(ends[1]):+.0f}")
        if any(row[1:]):
            rows.append(row)
    print_table(header, rows)


def print_stresses(runs, millimetres):
    print(f"### {millimetres:g} mm: within 1 cm of the nose, p, q [MPa], greatest plastic compaction [%]; "
          "speed [m/s]\n")
    rows = []
    for name, one in runs.items():
        row = [CASES[name][0]]
        for time in TIMES[:4]:
            at = one.at(time)
            near = [] if at is None else [at[f"sand.near_nose.{key}_max"] for key in ("p", "q", "plastic_volumetric")]
            row.append("" if at is None else f"{near[0] / 1e6:.0f}, {near[1] / 1e6:.0f}, {100 * near[2]:.1f}; "
                                             f"{speed(at):.0f}")
        rows.append(row)
    print_table(["", *(f"{1e3 * time:g} ms" for time in TIMES[:4])], rows)


# The estimate

# Speed of a piston [m/s] and the exact axial stress behind its shock [Pa], q, rate form (`hugoniot`).
SHOCK = [(20, 12.979741e6), (50, 35.557124e6), (100, 93.113954e6), (200, 271.96231e6)]
NOSE_LENGTH, RADIUS, TIP = 18.45e-3, 5.8e-3, 1e-3


def shock_stress(velocity):
    """Straight lines between logarithms, and beyond the ends."""
    i = min(max(bisect.bisect([v for v, _ in SHOCK], velocity) - 1, 0), len(SHOCK) - 2)
    (v0, s0), (v1, s1) = SHOCK[i : i + 2]
    return s0 * (velocity / v0) ** (math.log(s1 / s0) / math.log(v1 / v0))


def nose_rings(scale, count=60):
    """(distance of the ring's end from the tip, area, sine and cosine of the surface to the axis)."""
    def radius(x):  # r^2 is a cubic, level at the greatest radius
        return math.sqrt(x * (1 - x) ** 2 * NOSE_LENGTH * 2 * TIP + x * x * (3 - 2 * x) * RADIUS**2)

    rings = []
    for i in range(count):
        along, out = NOSE_LENGTH / count, radius((i + 1) / count) - radius(i / count)
        slant, middle = math.hypot(along, out), (radius((i + 1) / count) + radius(i / count)) / 2
        rings.append((scale * along * (i + 1), scale**2 * 2 * math.pi * middle * slant, out / slant, along / slant))
    return rings


def straight_way(mass, scale, friction=0.1, end=8.5e-4, step=1e-7):
    """Ways along the axis [m] at TIMES, of a nose that meets at every point the stress of a plane shock at the speed at
    which it pushes sand aside there."""
    rings, way, velocity, ways = nose_rings(scale), 0.0, float(SPEED), []
    started = (NOSE[2] - SURFACE) * math.sqrt(2)
    for i in range(round(end / step)):
        force = 0.0
        for edge, area, sine, cosine in rings:
            if edge < way - started and velocity > 0:
                force += shock_stress(velocity * sine) * area * (sine + friction * cosine)
        velocity = max(velocity - force / mass * step, 0.0)
        way += velocity * step
        if any(abs((i + 1) * step - time) < step / 2 for time in TIMES):
            ways.append(way)
    return ways


def print_estimate():
    print("### Estimate\n")
    area, mass = math.pi * RADIUS**2, 9.69e-3
    stops = mass * SPEED / 6e-4 / area
    print(f"Momentum over area and time: {mass * 1e3:.1f} g at {SPEED} m/s over {area * 1e6:.0f} mm2 stop in 0.6 ms "
          f"at a mean stress of {stops / 1e6:.0f} MPa.\n")
    rows = []
    for what, mass, scale in (("41 mm, 9.7 g", 9.69e-3, 1), ("41 mm, 15.9 g", 15.9e-3, 1),
                              ("50 mm, 15.9 g", 15.86e-3, 50 / 41)):
        ways = straight_way(mass, scale)
        rows.append([what, *(f"{1000 * (way / math.sqrt(2) + SURFACE - NOSE[2]):.0f} mm" for way in ways)])
    print_table(["straight at 45 degrees, depth of the nose", *(f"{1e3 * time:g} ms" for time in TIMES)], rows)


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "runs/projectile-report")
    parser.add_argument("--cells", type=positive, nargs="+", default=[5, 2.5],
                        help="mm; 5 mm divided by a whole number")
    parser.add_argument("--cases", nargs="+", default=list(CASES), choices=list(CASES))
    parser.add_argument("--end", type=positive, default=TIMES[-1], help="[s]")
    parser.add_argument("--print-only", action="store_true", help="print the runs that --out has, whatever their end")


def main(options):
    of_cells = {}
    for millimetres in options.cells:
        runs = of_cells[millimetres] = {}
        for name in options.cases:
            folder = options.out / f"{millimetres:g}_{name}"
            given = {**base(millimetres, options.end), **CASES[name][1]}
            if not options.print_only and not complete(folder, given):
                run(options.tamp, given, folder)
            if (folder / "given.json").exists():
                runs[name] = Run(folder)
    for millimetres, runs in of_cells.items():
        print_positions(runs, millimetres)
        print_stresses(runs, millimetres)
    print_worth(of_cells)
    print_estimate()
