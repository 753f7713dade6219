"""Kills a run at random moments, restarts it each time, and compares its end with that of a straight run.

The run writes a checkpoint every few steps and is killed with SIGKILL. Every restart runs to the end in a copy of the
killed run's folder; the killed run itself goes on to the next kill. The exit code is 1 if any digest or history
differs.
"""

import pathlib
import random
import shutil
import subprocess
import tempfile
import time

from tamp import files, program
from tamp.options import count

SCENE = program.INPUTS / "punch/quick.json"


def kill_at(tamp, n_ranks, words, seconds):
    """Starts a run in a group of its own, and ends all of it; false if it had ended by itself."""
    process = subprocess.Popen(program.command(tamp, "run", *words, "--quiet", ranks=n_ranks), env=program.ENVIRONMENT,
                               start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(seconds)
    running = process.poll() is None
    subprocess.run(["pkill", "-9", "-g" if n_ranks == 1 else "-s", str(process.pid)], check=False)
    process.wait()
    return running


def end_of(folder):
    """(summary, history)"""
    return files.document(folder / "summary.json"), files.text(folder / "history.csv")


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--kills", type=count, default=10)
    parser.add_argument("--ranks", type=count, default=1)
    parser.add_argument("--steps", type=count, default=1200)
    parser.add_argument("--seed", type=int, default=1)


def main(options):
    chance = random.Random(options.seed)
    steps = ["--steps", options.steps]
    n_kills = n_wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        killed, copy = place / "killed", place / "copy"
        begin = time.monotonic()
        program.run(options.tamp, SCENE, place / "straight", *steps)
        length = time.monotonic() - begin
        summary, history = end_of(place / "straight")
        while n_kills < options.kills:
            start = ["--restart", killed] if killed.exists() else ["--out", killed]
            moment = chance.uniform(0.3, length)
            if not kill_at(options.tamp, options.ranks, [SCENE, "--checkpoint-steps", 3, *steps, *start], moment):
                shutil.rmtree(killed)  # It had come to its end: the next begins anew.
                continue
            n_kills += 1
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(killed, copy)
            program.restart(options.tamp, SCENE, copy, *steps, ranks=chance.choice([1, 2, 3]))
            end, its_history = end_of(copy)
            right = end["state_digest"] == summary["state_digest"] and its_history == history
            n_wrong += not right
            print(f"kill {n_kills}: went on from step {end['restarted_at_step']} with ranks {end['ranks']}: "
                  f"{'the same bits' if right else 'DIFFERENT'}", flush=True)
    print(f"{n_wrong} of {options.kills} restarts ended differently")
    return 1 if n_wrong else 0
