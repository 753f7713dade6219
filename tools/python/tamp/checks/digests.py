"""State digests of short runs of every shipped scene, beside those of tests/scenes/digests.json.

--tamp may name several programs, of other compilers and processors. Each scene runs for as many steps as the file says,
once as it is and once with the C library's functions for old processors. The exit code is 1 where a digest differs.
--write writes the file anew, for a wanted change of numbers.
"""

import json
import pathlib
import tempfile

from tamp import files, program

FILE = program.ROOT / "tests/scenes/digests.json"
OLD_PROCESSOR = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2"}


def digest(tamp, scene, steps, environment):
    with tempfile.TemporaryDirectory() as folder:
        program.run(tamp, program.INPUTS / scene, f"{folder}/run", "--steps", steps,
                    environment={**program.ENVIRONMENT, **environment})
        return files.document(pathlib.Path(folder, "run/summary.json"))["state_digest"]


def add_arguments(parser):
    program.add_option(parser, nargs="+", default=[program.USUAL])
    parser.add_argument("--write", action="store_true")


def main(options):
    scenes = files.document(FILE)
    if options.write:
        for scene, expected in scenes.items():
            expected["digest"] = digest(options.tamp[0], scene, expected["steps"], {})
        FILE.write_text(json.dumps(scenes, indent=2) + "\n")

    n_different = 0
    for tamp in options.tamp:
        print(tamp)
        for scene, expected in scenes.items():
            found = [digest(tamp, scene, expected["steps"], e) for e in ({}, OLD_PROCESSOR)]
            same = all(f == expected["digest"] for f in found)
            n_different += not same
            verdict = "same" if same else "DIFFERENT"
            print(f"  {scene:20} {expected['steps']:4} steps  {' '.join(found)}  {verdict}", flush=True)
    return 1 if n_different else 0
