"""TAMP itself, which is asked whether it takes what a script has made."""

import json
import os
import pathlib
import subprocess
import tempfile

import inputs

ROOT = pathlib.Path(__file__).resolve().parents[2]
USUAL = ROOT / "build/release/tamp"

# What a sand needs besides its curves; it is asked only whether those are sound.
REST = {"type": "tabular_cap", "density": 1600, "poisson_ratio": 0.2, "elastic_update": "state",
        "strain_measure": "logarithmic", "yield": {"file": "yield.csv", "cap_ellipticity": 0.7}}  # fmt: skip
YIELD = "pressure[Pa],q[Pa]\n-1,0\n1e9,1e9\n2e9,2e9\n"


def add_option(parser):
    parser.add_argument("--tamp", type=pathlib.Path, metavar="PROGRAM", help="asked whether it takes what is made "
                        "(build/release/tamp)")  # fmt: skip


def found(chosen):
    """The program, or None, with a warning, where none is built."""
    program = chosen or USUAL
    if program.is_file() and os.access(program, os.X_OK):
        return program
    if chosen:
        raise inputs.Refusal(chosen, "no program", "TAMP")
    inputs.say(f"{USUAL}: warning: not built; what is made is not checked by TAMP (--tamp names another one)")
    return None


def objection(program, file, states):
    """What TAMP objects to in a material or a model, asked at (elastic, plastic) strains; empty if it takes it."""
    command = [str(program.resolve()), "modulus", str(file)]
    for elastic, plastic in states:
        command += ["--at", f"{elastic!r},{plastic!r}"]
    try:
        answer = subprocess.run(command, capture_output=True, text=True, errors="replace")
    except OSError as error:
        raise inputs.Refusal(program, error.strerror, "TAMP") from None
    if answer.returncode == 0:
        return ""
    return answer.stderr.strip().split("\n")[0].removeprefix("tamp: ") or f"{file}: exit code {answer.returncode}"


def objection_to_curves(program, hydrostat, unloading, states):
    """The same of curves, in a material made for the question."""
    with tempfile.TemporaryDirectory() as folder:
        material = pathlib.Path(folder, "material.json")
        modulus = {"type": "table", "table": str(unloading.resolve())}
        material.write_text(json.dumps({**REST, "modulus": modulus, "hydrostat": str(hydrostat.resolve())}))
        material.with_name("yield.csv").write_text(YIELD)
        return objection(program, material, states).replace(f"{material}#/hydrostat", str(hydrostat.resolve()))


def put_in_place(files):
    """Gives files their own names, once TAMP has taken them."""
    for file in files:
        os.replace(aside(file), file)


def aside(file):
    """Where a file is written before TAMP has taken it; there it stays if TAMP refuses it."""
    return file.with_name(f"{file.stem}.refused{file.suffix}")
