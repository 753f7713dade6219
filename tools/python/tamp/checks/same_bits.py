"""The state digest of every scene of the punch over ranks and threads, and of runs that go on with other ranks.

With --methods of the quick punch by every interpolator and transfer. Prints a table; the exit code is 1 if any digest
differs from that of one rank and one thread.
"""

import itertools
import json
import pathlib
import re
import tempfile

from tamp import files, program
from tamp.markdown import print_head, print_row
from tamp.options import count

PUNCH = program.INPUTS / "punch"
SCENES = ["quick", "table", "svr", "mlp"]
CREWS = [(r, t) for r in (1, 2, 3, 4) for t in (1, 2, 3)]
RESTARTS = [((1, 1), (3, 1)), ((2, 2), (1, 3)), ((4, 1), (2, 2)), ((3, 2), (4, 1))]


def scenes():
    """By name: the scene's file, and what is changed in it."""
    return {name: (PUNCH / f"{name}.json", {}) for name in SCENES}


def words(tamp, key):
    """The words that a scene may have at a key, as the program describes them: old ones are not described."""
    schema = json.loads(program.call(tamp, "schema").stdout)
    return re.findall(r'`"(\w+)"`:', schema["definitions"]["part_of_scene"]["properties"][key]["description"])


def methods(tamp):
    """The quick punch by every interpolator and transfer that go together. Linear weights have no step rule of their
    own: by the published one, and only in short steps, they endure the impact."""
    found = {}
    for interpolator, transfer in itertools.product(words(tamp, "interpolator"), words(tamp, "transfer")):
        short_steps = {"/time/rule": "published", "/time/multiplier": 0.2} if interpolator == "linear" else {}
        settings = {"/interpolator": interpolator, "/transfer": transfer, **short_steps}
        if program.answer(tamp, "check", PUNCH / "quick.json", *program.changes(settings)).returncode == 0:
            found[f"{interpolator}, {transfer}"] = (PUNCH / "quick.json", settings)
    return found


def straight(tamp, scene, settings, crew, n_steps, folder):
    n_ranks, n_threads = crew
    program.run(tamp, scene, folder, "--steps", n_steps, "--threads", n_threads, settings=settings, ranks=n_ranks)
    return files.document(folder / "summary.json")["state_digest"]


def restarted(tamp, scene, settings, crews, n_steps, folder):
    (ranks_before, threads_before), (ranks_after, threads_after) = crews
    half = n_steps // 2
    program.run(tamp, scene, folder, "--steps", half + 5, "--checkpoint-steps", half, "--threads", threads_before,
                settings=settings, ranks=ranks_before)
    program.restart(tamp, scene, folder, "--steps", n_steps, "--threads", threads_after, settings=settings,
                    ranks=ranks_after)
    summary = files.document(folder / "summary.json")
    assert summary["restarted_at_step"] == half
    return summary["state_digest"]


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--steps", type=count, default=100)
    parser.add_argument("--methods", action="store_true", help="every interpolator and transfer")


def main(options):
    n_different = 0
    print_head(["scene", "digest of one rank, one thread", "ranks x threads with the same", "restarts with the same"])
    for name, scene in (methods(options.tamp) if options.methods else scenes()).items():
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            found = {crew: straight(options.tamp, *scene, crew, options.steps, place / f"{crew[0]}x{crew[1]}")
                     for crew in CREWS}
            again = {crews: restarted(options.tamp, *scene, crews, options.steps, place / f"restart{k}")
                     for k, crews in enumerate(RESTARTS)}
        expected = found[1, 1]
        same = [f"{r}x{t}" for (r, t), digest in found.items() if digest == expected]
        same_again = [f"{a[0]}x{a[1]} to {b[0]}x{b[1]}" for (a, b), digest in again.items() if digest == expected]
        n_different += len(found) - len(same) + len(again) - len(same_again)
        print_row([name, expected, ", ".join(same), ", ".join(same_again)])
    print(f"{n_different} digests differ")
    return 1 if n_different else 0
