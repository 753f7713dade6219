"""Numbers of section 5 of the report, and of its figure 26, from our runs of the projectile."""

import numpy as np

from tamp import results
from tamp.research.report.numbers import of, of_sand
from tamp.research.report.projectile import LAST, MICRO, MILLI, PLASTIC, PRESSURE, SHEAR, TIMES, surface_of

EARLY = (20e-6, 50e-6, 100e-6)
TIP, NEAR = 5e-3, 10e-3  # how far the sand at the nose's tip and near it reaches
# From figure 26 and the text, at 850 microseconds.
SAID = {
    ("depth of the nose", "table"): "65 (58 to 70)", ("depth of the nose", "mlp"): "68",
    ("depth of the tail", "table"): "20", ("depth of the tail", "mlp"): "31",
    ("angle below the horizontal", "table"): "75", ("angle below the horizontal", "svr"): "75",
    ("angle below the horizontal", "mlp"): "51 to 55", ("speed", "table"): "close to 0",
    ("speed", "svr"): "close to 0", ("speed", "mlp"): "close to 0",
}
SAID_STRAIN = {
    ("table", 400): "12", ("svr", 400): "12", ("mlp", 400): "14",
    ("table", 600): "13.5", ("svr", 600): "13.5", ("mlp", 600): "16.5",
}


def microseconds(time):
    return f"{time / MICRO:.0f}"


def sand_at(runs, times):
    return of_sand(runs, times, microseconds)


def ways(runs):
    found, surface = [], surface_of(runs[0])
    for run in runs:
        history = results.history(run.folder)
        for time in (*TIMES, LAST):
            number = of(run, microseconds(time))
            nose, tail = (surface - results.at(history, f"projectile.{end}_z", time) for end in ("nose", "tail"))
            velocity = [results.at(history, f"projectile.velocity_{axis}", time) for axis in "xyz"]
            angle = results.at(history, "projectile.axis_angle", time)
            measured = {"depth of the nose": ("mm", nose / MILLI), "depth of the tail": ("mm", tail / MILLI),
                        "angle below the horizontal": ("degrees", angle),
                        "speed": ("m/s", np.linalg.norm(velocity))}
            for what, (unit, value) in measured.items():
                said = SAID.get((what, run.model), "") if time == LAST else ""
                found.append(number("25, 26", what, unit, value, said))
        found += turning(of(run), history, surface)
    return found


def turning(number, history, surface):
    depth = surface - history["projectile.nose_z"]
    k = depth.argmax()
    sideways = np.abs(history["projectile.nose_y"] - history["projectile.nose_y"][0]).max()
    ends = [[history[f"projectile.{end}_{axis}"][0] for axis in "xyz"] for end in ("nose", "tail")]
    length = np.linalg.norm(np.subtract(*ends))
    return [
        number("25", "greatest depth of the nose", "mm", depth[k] / MILLI),
        number("25", "time of the greatest depth", "µs", history["time"][k] / MICRO),
        number("25", "rises after that by", "mm", (depth[k] - depth[-1]) / MILLI, "bounces back"),
        number("25", "greatest way of the nose along y", "mm", sideways / MILLI, "a few"),
        number("24", "nose to tail", "mm", length / MILLI, "41 (46.5 in figure 26)"),
    ]


def distance_to_nose(run, sand):
    history = results.history(run.folder)
    nose = [results.at(history, f"projectile.nose_{axis}", sand.time) for axis in "xyz"]
    return np.linalg.norm(sand.position - nose, axis=1)


def stresses(runs):
    found = []
    for number, run, sand in sand_at(runs, (*TIMES, LAST)):
        near = distance_to_nose(run, sand) < NEAR
        for field, figure, said in ((PRESSURE, "27", "50 to 80"), (SHEAR, "28", "about 100 at first")):
            values, title, unit = field.values(sand), field.title, field.unit
            found.append(number(figure, f"{title}, all sand", unit, values.max(), "", results.exceeded(values)))
            if near.any():
                what, said = f"{title} within 1 cm of the nose", said if sand.time < 1.1 * TIMES[0] else ""
                found.append(number(figure, what, unit, values[near].max(), said, results.exceeded(values[near])))
    for run in runs:
        history = results.history(run.folder)
        for time in EARLY:
            value = results.at(history, "sand.near_nose.q_max", time) / SHEAR.per_unit
            what = f"{SHEAR.title} within 1 cm of the nose"
            found.append(of(run, microseconds(time))("28", what, SHEAR.unit, value, "about 100 at first"))
    return found


def strains(runs):
    """Near the nose, what follows the largest is what 5, 25 and 50 % of the particles there are above."""
    found = []
    for number, run, sand in sand_at(runs, (*TIMES, LAST)):
        plastic, away = PLASTIC.values(sand), distance_to_nose(run, sand)
        said = SAID_STRAIN.get((run.model, round(sand.time / 100e-6) * 100), "")
        found.append(number("29", f"{PLASTIC.title}, all sand", "%", plastic.max(), said, results.exceeded(plastic)))
        for name, reach in (("5 mm", TIP), ("1 cm", NEAR)):
            near = plastic[away < reach]
            if len(near):
                said = "1 at the tip, 7 around" if sand.time < 1.1 * TIMES[0] else ""
                what = f"{PLASTIC.title} within {name} of the nose: largest, 5, 25, 50 %"
                shares = results.exceeded(near, (0.05, 0.25, 0.5))
                found.append(number("29", what, "%", near.max(), said, shares))
        volume = (results.spacing(results.particles(run.folder, "sand", 0).position) / MILLI) ** 3
        for least in (3, 7):
            found.append(number("29", f"sand compacted by {least} % or more", "mm³", (plastic > least).sum() * volume))
        found.append(number("29", f"least {PLASTIC.title}", "%", plastic.min(), "large, tensile at the crater"))
    return found


def waves(runs):
    """How much of the sand the wave has reached after 0.2 ms."""
    found = []
    for number, _, sand in sand_at(runs, TIMES[:1]):
        for least in (0.1, 1):
            share = (PRESSURE.values(sand) > least).mean()
            found.append(number("27", f"share of the sand with p above {least:g} MPa", "%", 100 * share))
    return found


def numbers(runs):
    return ways(runs) + stresses(runs) + strains(runs) + waves(runs)
