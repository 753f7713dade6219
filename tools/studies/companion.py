"""Paths of the report's companion, runs of one point along them, and numbers beside the companion's, for the study
companion_paths.py beside this file. Stresses are compression positive."""

import csv
import math
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAND = ROOT / "inputs" / "materials" / "concrete-sand"
COMPANION = ROOT / "inputs" / "studies" / "companion"
MODELS = ["table", "svr", "mlp"]
NAMES = {"table": "Table", "svr": "SVR", "mlp": "MLP", "measured": "measured"}
FORMS = ["rate", "state"]
FILE_ENDS = {"q": "", "sqrt_J2": "_sqrt_J2"}  # of the material files, by how they read the strength column
COMBINATIONS = [(reading, form) for reading in FILE_ENDS for form in FORMS]

# Paths


# Time, logarithmic volumetric strain (compression positive): up to the largest of a test, down to its plastic strain.
HYDROSTATIC = [
    (0, 0), (0.1, 0.0904), (0.2, 0.06279244783), (0.3, 0.1808), (0.4, 0.1450957621), (0.5, 0.2712), (0.6, 0.2259340559),
    (0.7, 0.3616), (0.8, 0.3019145715), (0.9, 0.452), (1, 0.3200070101), (1.1, -0.002998500999),
]  # fmt: skip
# Time, logarithmic strains along the axis and across it (tension positive).
MULTIAXIAL = [
    (0, 0, 0), (1, -0.00944444444, -0.00944444444), (2, -0.04410203987, 0.02121768660),
    (3, 0.02788435327, -0.00477550997), (4, 0.02246575954, 0.01593378690), (5, -0.01897074757, 0.03165204045),
]  # fmt: skip
ROWS_A_LEG = 10  # of the multiaxial path, whose legs are straight in logarithmic strain


def multiaxial(scale):
    """Rows (time, F11, F22), with all strains times `scale`."""
    rows = [(0, 1, 1)]
    for (t0, a0, b0), (t1, a1, b1) in zip(MULTIAXIAL, MULTIAXIAL[1:]):
        for i in range(1, ROWS_A_LEG + 1):
            s = i / ROWS_A_LEG
            between = [(1 - s) * x + s * y for x, y in ((t0, t1), (a0, a1), (b0, b1))]
            rows.append((between[0], *(math.exp(scale * strain) for strain in between[1:])))
    return rows


def write_path(path, what, rows):
    """A file for `tamp drive` of rows (time, F11, F22 = F33)."""
    lines = [f"# {what}", "# Made by tools/studies/companion_paths.py --write-paths."]
    lines.append("time,F11,F12,F13,F21,F22,F23,F31,F32,F33")
    lines += [f"{t:.12g},{a:.12g},0,0,0,{b:.12g},0,0,0,{b:.12g}" for t, a, b in rows]
    path.write_text("\n".join(lines) + "\n")
    return path


def write_paths():
    source = "of the companion (Banerjee 2020, PAR-10021867-092020-5)"
    COMPANION.mkdir(parents=True, exist_ok=True)
    write_path(COMPANION / "uniaxial.csv", f"The uniaxial path {source}.", [(0, 1, 1), (1, 0.6, 1), (4, 1.02, 1)])
    stretches = [(time, *[math.exp(-strain / 3)] * 2) for time, strain in HYDROSTATIC]
    write_path(COMPANION / "hydrostatic.csv", f"The hydrostatic load cycles {source}.", stretches)
    write_path(COMPANION / "multiaxial.csv", f"The multiaxial path {source}.", multiaxial(1))


# Files and runs


def read_rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Point:
    """Runs of `tamp drive`, each done once."""

    def __init__(self, options, folder):
        self.program, self.increment, self.folder = options.program, options.increment, pathlib.Path(folder)
        self.done = {}

    def drive(self, path, model, reading="q", form="rate", settings=(), increment=None):
        """Rows with numbers by name, stresses compression positive."""
        key = (path, model, reading, form, tuple(settings), increment)
        if key not in self.done:
            self.done[key] = self._drive(*key)
        return self.done[key]

    def _drive(self, path, model, reading, form, settings, increment):
        out = self.folder / "out.csv"
        command = [self.program, "drive", SAND / f"{model}{FILE_ENDS[reading]}.json", path, "--out", out]
        command += ["--increment", repr(increment or self.increment), "--set", f"/elastic_update={form}"]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        return [Point._state(row) for row in read_rows(out)]

    @staticmethod
    def _state(row):
        state = {name.split("[")[0]: float(number) for name, number in row.items()}
        for name in ("s11", "s22"):
            state[name] = -state[name]
        state["s11-s22"] = abs(state["s11"] - state["s22"])
        state["q/p"] = state["s11-s22"] / state["p"] if state["p"] > 0 else math.nan
        return state


def at_time(rows, time):
    return min(rows, key=lambda row: abs(row["time"] - time))


def first_leg_apart(rows):
    return [row for row in rows if 1 <= row["time"] <= 2]


def answer(rows, at, quantity):
    """What a row of figures.csv asks for."""
    if at == "peak of s11":
        return max(first_leg_apart(rows), key=lambda row: row["s11"])[quantity]
    if at == "least after 1 s":
        return min(row[quantity] for row in first_leg_apart(rows))
    return at_time(rows, float(at.split()[0]))[quantity]


# Tables


UNITS = {"MPa": 1e6, "GPa": 1e9, "-": 1}


def companion_text(figure):
    number = f"{figure['value']} to {figure['to']}" if figure["to"] else figure["value"]
    return number if figure["unit"] == "-" else f"{number} {figure['unit']}"


def companion_number(figure):
    return (float(figure["value"]) + float(figure["to"] or figure["value"])) / 2


def off(value, figure):
    """The difference from the companion's number, over that number."""
    return value / UNITS[figure["unit"]] / companion_number(figure) - 1


def compared(value, figure):
    return f"{value / UNITS[figure['unit']]:.4g} ({100 * off(value, figure):+.1f} %)"
