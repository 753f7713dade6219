#!/usr/bin/env python3
"""State digests of short runs of every shipped scene, beside those of tests/scenes/digests.json.

    tools/studies/digests.py [PROGRAM...]           compares; programs may be of other compilers and processors
    tools/studies/digests.py --write [PROGRAM]      writes the file anew, for a wanted change of numbers

A program is build/release/tamp unless said otherwise. Each scene runs for as many steps as the file says, once as it is
and once with the C library's functions for old processors. Exits with 1 where a digest differs.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILE = ROOT / "tests/scenes/digests.json"
OLD_PROCESSOR = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2"}


def digest(program, scene, steps, environment):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", ROOT / "inputs" / scene, "--steps", str(steps), "--out", f"{folder}/run", "--quiet"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env={**os.environ, **environment})
        return json.loads(pathlib.Path(folder, "run/summary.json").read_text())["state_digest"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--write", action="store_true")
    arguments.add_argument("programs", nargs="*", metavar="PROGRAM", default=[str(ROOT / "build/release/tamp")])
    options = arguments.parse_args()

    scenes = json.loads(FILE.read_text())
    if options.write:
        for scene, expected in scenes.items():
            expected["digest"] = digest(options.programs[0], scene, expected["steps"], {})
        FILE.write_text(json.dumps(scenes, indent=2) + "\n")

    n_different = 0
    for program in options.programs:
        print(program)
        for scene, expected in scenes.items():
            found = [digest(program, scene, expected["steps"], e) for e in ({}, OLD_PROCESSOR)]
            same = all(f == expected["digest"] for f in found)
            n_different += not same
            print(f"  {scene:20} {expected['steps']:4} steps  {' '.join(found)}  {'same' if same else 'DIFFERENT'}", flush=True)
    sys.exit(1 if n_different else 0)


if __name__ == "__main__":
    main()
