#!/usr/bin/env python3
"""Kills a run at random moments, restarts it each time, and compares its end with that of a straight run.

    tools/studies/kill_and_restart.py [--tamp build/release/tamp] [--kills 10] [--ranks 1] [--steps 1200] [--seed 1]

The run writes a checkpoint every few steps and is killed with SIGKILL. Every restart runs to the end in a copy of the
killed run's folder; the killed run itself goes on to the next kill. The exit code is 1 if any digest or history
differs."""

import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

import ranks

SCENE = ranks.PUNCH / "quick.json"


def kill_at(tamp, n_ranks, arguments, seconds):
    """Starts a run in a group of its own, and ends all of it; false if it had ended by itself."""
    process = subprocess.Popen(ranks.command(tamp, n_ranks, arguments), env=ranks.ENVIRONMENT, start_new_session=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(seconds)
    running = process.poll() is None
    subprocess.run(["pkill", "-9", "-g" if n_ranks == 1 else "-s", str(process.pid)], check=False)
    process.wait()
    return running


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tamp", type=pathlib.Path, default=ranks.ROOT / "build/release/tamp")
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--steps", type=int, default=1200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    often = ["--checkpoint-steps", 3, "--steps", options.steps]
    n_wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        begin = time.monotonic()
        ranks.run(options.tamp, 1, [SCENE, "--steps", options.steps, "--out", place / "straight"])
        length = time.monotonic() - begin
        expected = ranks.digest(place / "straight")
        history = (place / "straight/history.csv").read_text()
        killed, copy = place / "killed", place / "copy"
        n_kills = 0
        while n_kills < options.kills:
            start = ["--restart", killed] if killed.exists() else ["--out", killed]
            moment = chance.uniform(0.3, length)
            if not kill_at(options.tamp, options.ranks, [SCENE, *often, *start], moment):
                shutil.rmtree(killed)  # It had come to its end: the next begins anew.
                continue
            n_kills += 1
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(killed, copy)
            ranks.run(options.tamp, chance.choice([1, 2, 3]), [SCENE, "--steps", options.steps, "--restart", copy])
            end = ranks.summary(copy)
            right = end["state_digest"] == expected and (copy / "history.csv").read_text() == history
            n_wrong += not right
            print(f"kill {n_kills}: went on from step {end['restarted_at_step']} with ranks {end['ranks']}: "
                  f"{'the same bits' if right else 'DIFFERENT'}", flush=True)
    print(f"{n_wrong} of {options.kills} restarts ended differently")
    return 1 if n_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
