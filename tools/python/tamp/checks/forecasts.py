"""Holds the forecast of whole runs against what they took: memory, steps and processor time.

SCENE is a scene file, or `million`: a punch into a block of a million particles of sand in space. Unless said otherwise
those are the quick punch, the quick projectile and `million` (about ten minutes on one core). Each runs on one thread
to its end; nothing else should run meanwhile. It prints a row for results/failures/forecasts.csv.
"""

import json
import os
import pathlib
import tempfile

from tamp import files, program
from tamp.markdown import print_head, print_row
from tamp.program import INPUTS, SAND


def million():
    scene = files.document(INPUTS / "punch/table.json")
    scene["dimension"] = 3
    scene["grid"] = {"lower": [0, 0, 0], "upper": [1, 1, 1.4], "cell_size": 0.02, "patches": [2, 2, 2]}
    scene["boundaries"] = {side: "symmetry" for side in ["x-", "x+", "y-", "y+", "z-", "z+"]}
    scene["time"].update({"end": 4e-4, "multiplier": 0.4})
    scene["particles_per_cell"] = [2, 2, 2]
    scene["gravity"] = [0, 0, -9.81]
    scene["materials"]["sand"]["file"] = str(SAND / "table.json")
    scene["bodies"]["sand"]["geometry"].update({"lower": [0, 0, 0], "upper": [1, 1, 1]})
    scene["bodies"]["punch"]["geometry"].update({"lower": [0.36, 0.36, 1], "upper": [0.64, 0.64, 1.2]})
    scene["bodies"]["punch"]["velocity"] = [0, 0, -200]
    scene["output"] = {"fields_interval": 4e-4, "history_interval": 1e-5}
    return scene


def whole(number):
    return "none" if number is None else f"{number:,.0f}"


def shown(file):
    """A scene's name in the table: its path within the inputs, or that of a user's own."""
    return file.relative_to(INPUTS) if file.is_relative_to(INPUTS) else file


def processor_time():
    used = os.times()
    return used.children_user + used.children_system


def add_arguments(parser):
    parser.add_argument("scenes", nargs="*", metavar="SCENE",
                        default=[INPUTS / "punch/quick.json", INPUTS / "uxo/quick.json", "million"])
    program.add_option(parser)


def main(options):
    for name in options.scenes:
        if name != "million":
            files.check_file(name)
    print_head(["scene", "particles", "memory, forecast / ledger / process [MB]", "steps, forecast / taken",
                "core-seconds, forecast / taken"])
    with tempfile.TemporaryDirectory() as place:
        for name in options.scenes:
            file, out = pathlib.Path(name), pathlib.Path(place, "run")
            if name == "million":
                file = pathlib.Path(place, "million.json")
                file.write_text(json.dumps(million()))
            before = processor_time()
            program.run(options.tamp, file, out, "--threads", 1)
            used, summary = processor_time() - before, files.document(out / "summary.json")
            forecast = summary["forecast"]
            print_row([name if name == "million" else shown(file.resolve()),
                       f"{summary['particles']['total']:,}",
                       " / ".join(f"{summary['memory'][key] / 1e6:.1f}"
                                  for key in ["forecast_bytes", "ledger_bytes", "process_bytes"]),
                       f"{whole(forecast['steps'])} / {summary['steps']:,}",
                       f"{whole(forecast['core_seconds'])} / {used:,.0f}"])
