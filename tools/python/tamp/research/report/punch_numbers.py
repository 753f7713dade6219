"""Numbers of sections 4.1 and 4.2 of the report, from our runs of the punch."""

import numpy as np

from tamp import results
from tamp.research.report.numbers import of, of_sand
from tamp.research.report.punch import CAP, ELASTIC, MIDDLE, MILLI, MODULUS, PLASTIC, PRESSURE, SHEAR, SURFACE

DEPTH_TIMES = (0.5e-3, 1e-3, 1.5e-3, 2e-3, 2.6e-3, 3e-3, 4e-3)
PEAK_TIMES = (0.5e-3, 1e-3, 2e-3, 2.6e-3, 2.7e-3)
PLUG_TIMES = (0.3e-3, 0.5e-3, 0.7e-3, 1e-3, 1.5e-3)
WAVE_TIMES = (0.2e-3, 0.3e-3, 0.4e-3, 0.5e-3)
# Numbers in the report's text: field, model, time in milliseconds.
SAID = {
    ("p", "table", 1): "166", ("p", "mlp", 1): "180", ("p", "table", 2): "315", ("p", "mlp", 2): "156",
    ("q", "table", 1): "145", ("q", "mlp", 1): "145", ("q", "table", 2): "276", ("q", "mlp", 2): "124",
    ("q", "table", 2.6): "60", ("q", "mlp", 2.6): "50", ("cap", "table", 2): "400", ("cap", "mlp", 2): "270",
}
PEAKS = {CAP: "12, 19", PRESSURE: "13, 20", SHEAR: "14, 21", MODULUS: "11, 17", ELASTIC: "15, 22", PLASTIC: "16, 23"}
HALF_WIDTH = 0.15  # of the punch
STRESSED = 1e6  # mean stress in Table's sand, above which its elastic strain is compared
STRAINED = 0.01  # plastic strain in Table's sand, above which it is compared
FEW = "within a few percent"


def milliseconds(time):
    return f"{time / MILLI:.2g}"


def sand_at(runs, times):
    return of_sand(runs, times, milliseconds)


def depths(runs):
    found, table = [], results.history(runs[0].folder)
    for run in runs:
        history = results.history(run.folder)
        for time in DEPTH_TIMES:
            if history["time"][-1] < 0.999 * time:
                continue
            number = of(run, milliseconds(time))
            depth, reference = (results.at(h, "punch.depth", time) for h in (history, table))
            speed = results.at(history, "punch.velocity_y", time)
            found.append(number("9", "depth", "cm", 100 * depth))
            found.append(number("9", "depth less Table's", "%", 100 * (depth / reference - 1)))
            found.append(number("9", "speed of the punch, upwards", "m/s", speed))
        deepest = history["punch.depth"].argmax()
        found.append(of(run)("9", "greatest depth of the run", "cm", 100 * history["punch.depth"][deepest]))
        found.append(of(run)("9", "time of the greatest depth", "ms", history["time"][deepest] / MILLI))
    return found


def peaks(runs):
    found = []
    for field, figure in PEAKS.items():
        for number, run, sand in sand_at(runs, PEAK_TIMES):
            if field.key in sand:
                said = SAID.get((field.key, run.model, round(sand.time / MILLI, 1)), "")
                values = field.values(sand)
                found.append(number(figure, field.title, field.unit, values.max(), said, results.exceeded(values)))
    return found


def in_plug(sand, base):
    """The triangle under the punch, as high as half of its width."""
    below = base - sand.position[:, 1]
    return (below > 0) & (np.abs(sand.position[:, 0] - MIDDLE) < HALF_WIDTH - below)


def base_of(run, time):
    """Height of the underside of the punch."""
    return SURFACE - results.at(results.history(run.folder), "punch.depth", time)


def plug_depth(sand, base, speed, aside):
    """How far below the punch the sand moves down with 0.8 of its speed or more, in a column 2 cm wide."""
    column = np.abs(np.abs(sand.position[:, 0] - MIDDLE) - aside) < 0.01
    carried = column & (sand["velocity"][:, 1] < 0.8 * speed) & (sand.position[:, 1] < base)
    return float(base - sand.position[carried, 1].min()) if carried.any() else 0.0


def plug(runs):
    found = []
    for number, run, sand in sand_at(runs, PLUG_TIMES):
        speed = results.at(results.history(run.folder), "punch.velocity_y", sand.time)
        for aside in (0, 0.05, 0.1, 0.14):
            what = f"depth of the sand that the punch carries, {100 * aside:g} cm from its axis"
            found.append(number("10", what, "cm", 100 * plug_depth(sand, base_of(run, sand.time), speed, aside)))
    for number, run, sand in sand_at(runs, PEAK_TIMES):
        if "K" in sand:
            modulus, chosen = MODULUS.values(sand), in_plug(sand, base_of(run, sand.time))
            what = "bulk modulus, median in the triangle under the punch, half as high as wide"
            found.append(number("11, 17", what, "MPa", np.median(modulus[chosen])))
            found.append(number("11, 17", "bulk modulus, median in all other sand", "MPa", np.median(modulus[~chosen])))
    return found


def waves(runs):
    """How deep the sand under the punch has begun to move, and how fast all of it moves."""
    found = []
    for run in runs:
        start = results.particles(run.folder, "sand", 0)
        if "K" in start:
            found.append(of(run, "0")("11, 17", "bulk modulus at the start", "MPa", MODULUS.values(start).max()))
    for number, run, sand in sand_at(runs, WAVE_TIMES):
        under = np.abs(sand.position[:, 0] - MIDDLE) < 0.05
        for speed in (1, 10):
            lowest = sand.position[under & (sand["speed"] > speed), 1].min()
            what = f"depth to which the sand moves faster than {speed} m/s"
            found.append(number("10, 18", what, "cm", 100 * (SURFACE - lowest)))
    for number, run, sand in sand_at(runs, PEAK_TIMES[:-1]):
        speed = np.sqrt((sand["speed"] ** 2).mean())
        highest = sand.position[:, 1].max() - SURFACE
        found.append(number("10, 18", "root mean square speed of the sand", "m/s", speed))
        found.append(number("9, 10", "height of the highest sand above the surface", "cm", 100 * highest))
    return found


def caps(runs):
    """How far the cap has grown. A cap has grown once it is a tenth above that of the start."""
    found = []
    for number, run, sand in sand_at(runs, PEAK_TIMES):
        cap, first = sand["cap"], results.particles(run.folder, "sand", 0)["cap"]
        grown = cap > 1.1 * first
        said = "about 9" if round(sand.time / MILLI, 1) == 0.5 else ""
        found.append(number("12, 19", "share of the sand whose cap has grown", "%", 100 * grown.mean()))
        found.append(number("12, 19", "share of the sand whose cap is above 9 MPa", "%", 100 * (cap > 9e6).mean()))
        median = np.median(CAP.values(sand)[grown])
        found.append(number("12, 19", "cap, median where it has grown", "MPa", median, said))
    return found


def strains(runs):
    """How much of the sand is pulled apart; and particle by particle against Table."""
    found = []
    for number, run, sand in sand_at(runs, PEAK_TIMES):
        tension, stressed = sand["elastic_volumetric"] < 0, sand["p"] > STRESSED
        found.append(number("15, 22", "share of the sand in elastic tension", "%", 100 * tension.mean()))
        found.append(number("13, 20", "share of the sand with p above 1 MPa", "%", 100 * stressed.mean()))
        if run.model != "table":
            found += apart(number, run, sand, results.particles(runs[0].folder, "sand", sand.time))
    return found


def apart(number, run, sand, table):
    stressed = table["p"] > STRESSED
    ratio = sand["elastic_volumetric"][stressed].sum() / table["elastic_volumetric"][stressed].sum()
    said = "about 0.5" if run.model == "mlp" else "above 1"
    found = [number("15, 22", "elastic strain over Table's, sums where Table has p > 1 MPa", "", ratio, said)]

    strained = np.abs(table["plastic_volumetric"]) > STRAINED
    difference = np.abs(sand["plastic_volumetric"] - table["plastic_volumetric"])[strained]
    for name, share in (("half", 0.5), ("90 %", 0.9)):
        what = f"plastic strain less Table's, {name} of the sand strained by 1 % are within"
        found.append(number("16, 23", what, "% of strain", 100 * np.quantile(difference, share), FEW))
    size = np.abs(table["plastic_volumetric"][strained]).sum()
    what = "plastic strain less Table's, mean size over Table's mean size"
    found.append(number("16, 23", what, "%", 100 * difference.sum() / size, FEW))
    return found


def numbers(runs):
    return depths(runs) + peaks(runs) + plug(runs) + waves(runs) + caps(runs) + strains(runs)
