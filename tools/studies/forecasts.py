#!/usr/bin/env python3
"""Holds the forecast of whole runs against what they took: memory, steps and processor time.

    tools/studies/forecasts.py [--tamp build/release/tamp] [SCENE...]

SCENE is a scene file, or `million`: a punch into a block of a million particles of sand in space. Unless said otherwise
those are the quick punch, the quick projectile and `million` (about ten minutes on one core). Each runs on one thread to its
end; nothing else should run meanwhile. It prints a row for docs/failures.md.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def million():
    scene = json.loads((ROOT / "inputs/punch/table.json").read_text())
    scene["dimension"] = 3
    scene["grid"] = {"lower": [0, 0, 0], "upper": [1, 1, 1.4], "cell_size": 0.02, "patches": [2, 2, 2]}
    scene["boundaries"] = {side: "symmetry" for side in ["x-", "x+", "y-", "y+", "z-", "z+"]}
    scene["time"].update({"end": 4e-4, "multiplier": 0.4})
    scene["particles_per_cell"] = [2, 2, 2]
    scene["gravity"] = [0, 0, -9.81]
    scene["materials"]["sand"]["file"] = str(ROOT / "inputs/materials/concrete-sand/table.json")
    scene["bodies"]["sand"]["geometry"].update({"lower": [0, 0, 0], "upper": [1, 1, 1]})
    scene["bodies"]["punch"]["geometry"].update({"lower": [0.36, 0.36, 1], "upper": [0.64, 0.64, 1.2]})
    scene["bodies"]["punch"]["velocity"] = [0, 0, -200]
    scene["output"] = {"fields_interval": 4e-4, "history_interval": 1e-5}
    return scene


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--tamp", type=pathlib.Path, default=ROOT / "build/release/tamp")
    arguments.add_argument("scenes", nargs="*", metavar="SCENE",
                           default=[ROOT / "inputs/punch/quick.json", ROOT / "inputs/uxo/quick.json", "million"])
    options = arguments.parse_args()

    print("| scene | particles | memory, forecast / used [MB] | steps, forecast / taken | core-seconds, forecast / taken |")
    print("| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as place:
        for name in options.scenes:
            file = pathlib.Path(name)
            if name == "million":
                file = pathlib.Path(place, "million.json")
                file.write_text(json.dumps(million()))
            out = pathlib.Path(place, "run")
            command = [options.tamp, "run", file, "--threads", "1", "--force", "--out", out]
            process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL)
            _, status, used = os.wait4(process.pid, 0)
            if status != 0:
                sys.exit(f"{name}: exit code {os.waitstatus_to_exitcode(status)}")
            summary = json.loads((out / "summary.json").read_text())
            forecast = summary["forecast"]
            told = lambda number: "none" if number is None else f"{number:,.0f}"
            print(f"| {name if name == 'million' else file.relative_to(ROOT / 'inputs')} | {summary['particles']['total']:,} | "
                  f"{forecast['memory_bytes'] / 1e6:.1f} / {summary['peak_rss_bytes']['max'] / 1e6:.1f} | "
                  f"{told(forecast['steps'])} / {summary['steps']:,} | "
                  f"{told(forecast['core_seconds'])} / {used.ru_utime + used.ru_stime:,.0f} |", flush=True)


if __name__ == "__main__":
    main()
