"""Shows what patches cost that nothing happens on: start-up and memory.

N x N patches of 4 x 4 cells, with a block of steel on one of sand in a corner: 4,800 particles, whatever N is. Each is
run for two steps on one thread; nothing else should run meanwhile. It prints the rows of
results/benchmarks/many_patches.csv.
"""

import json
import os
import pathlib
import tempfile

from tamp import files, program
from tamp.markdown import print_head, print_row
from tamp.program import INPUTS, SAND

CELL = 0.005


def scene_of(n):
    scene = files.document(INPUTS / "punch/quick.json")
    scene["grid"] = {"lower": [0, 0], "upper": [4 * n * CELL] * 2, "cell_size": CELL, "patches": [n, n]}
    scene["materials"]["sand"]["file"] = str(SAND / "table.json")
    scene["bodies"]["sand"]["geometry"].update({"lower": [0.1, 0.11], "upper": [0.3, 0.2]})
    scene["bodies"]["punch"]["geometry"].update({"lower": [0.1, 0.2], "upper": [0.3, 0.26]})
    return scene


def processor_time():
    used = os.times()
    return used.children_user + used.children_system


def add_arguments(parser):
    parser.add_argument("n", nargs="*", type=int, metavar="N", default=[20, 40, 80, 100],
                        help="patches along an axis, 16 or more")
    program.add_option(parser)


def main(options):
    print_head(["patches", "core-seconds", "a patch [ms]", "memory, forecast / ledger / process [MB]", "a patch [kB]"])
    with tempfile.TemporaryDirectory() as place:
        for n in options.n:
            file, out = pathlib.Path(place, "patches.json"), pathlib.Path(place, "run")
            file.write_text(json.dumps(scene_of(n)))
            before = processor_time()
            program.run(options.tamp, file, out, "--threads", 1, "--steps", 2)
            used = processor_time() - before
            memory = files.document(out / "summary.json")["memory"]
            print_row([f"{n * n:,}", f"{used:.2f}", f"{1e3 * used / n**2:.2f}",
                       " / ".join(f"{memory[key] / 1e6:.1f}"
                                  for key in ["forecast_bytes", "ledger_bytes", "process_bytes"]),
                       f"{memory['process_bytes'] / 1e3 / n**2:.1f}"])
