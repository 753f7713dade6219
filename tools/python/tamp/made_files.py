"""Files that are made for TAMP, which is asked whether it takes them before they get their own names."""

import json
import os
import pathlib
import tempfile

from tamp.failure import Refusal, say
from tamp.program import USUAL, answer

# Keys of a sand besides its curves; only the curves are judged.
REST = {"type": "tabular_cap", "density": 1600, "poisson_ratio": 0.2, "elastic_update": "state",
        "strain_measure": "logarithmic", "yield": {"file": "yield.csv", "cap_ellipticity": 0.7}}
YIELD = "pressure[Pa],q[Pa]\n-1,0\n1e9,1e9\n2e9,2e9\n"


def found(program):
    """The program, or None, with a warning, where the usual one is not built."""
    if program.is_file() and os.access(program, os.X_OK):
        return program
    if program != USUAL:
        raise Refusal(program, "no program", "TAMP")
    say(f"{USUAL}: warning: not built; what is made is not checked by TAMP (--tamp names another one)")
    return None


def objection(program, file, states):
    """TAMP's objection to a material or a model, asked at (elastic, plastic) strains; empty if it takes it."""
    asked = [word for elastic, plastic in states for word in ("--at", f"{elastic!r},{plastic!r}")]
    said = answer(program.resolve(), "modulus", file, *asked)
    if said.returncode == 0:
        return ""
    return said.stderr.strip().split("\n")[0].removeprefix("tamp: ") or f"{file}: exit code {said.returncode}"


def objection_to_curves(program, hydrostat, unloading, states):
    """TAMP's objection to curves, asked by a material made for the question."""
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
