"""Tries what used to go wrong, and prints how it ends now: a table of commands, exit codes and first messages.

It takes about two minutes. The exit code is 1 if any ended otherwise than the table says it should.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

from tamp import program
from tamp.markdown import print_head, print_row

BALL = '{"type":"ball","centre":[0.5,0.6],"radius":0.05}'


class Trials:
    def __init__(self, tamp, folder):
        self.tamp, self.folder = tamp.resolve(), folder
        self.n_wrong = 0
        shutil.copytree(program.INPUTS, folder / "inputs")
        print_head(["tried", "command", "exit code", "says"])

    def shell(self, command):
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              env={**os.environ, "PATH": f"{self.tamp.parent}:{os.environ['PATH']}"})
        return done.returncode, done.stderr + done.stdout  # `tamp check` warns on stdout

    def add(self, what, command, code, expected, text):
        self.n_wrong += code != expected
        said = [line for line in text.splitlines() if line.startswith("tamp: ")]
        line = said[0][6:] if said else ""
        line = line.replace(str(self.folder) + "/", "").replace("|", "\\|")
        mark = "" if code == expected else f" (expected {expected})"
        print_row([what, f"`{command}`", f"{code}{mark}", line[:230]])

    def trial(self, what, command, expected, before=""):
        if before:
            self.shell(before)
        code, text = self.shell(command)
        self.add(what, command.replace("|", "\\|"), code, expected, text)

    def in_background(self, what, arguments, number, expected):
        """A run that gets a signal once it has written a checkpoint."""
        out = self.folder / f"signal_{number}"
        command = [self.tamp, "run", "inputs/punch/quick.json", "--quiet", "--checkpoint-steps", "5", "--out", out]
        process = subprocess.Popen([str(word) for word in command], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        while not list(out.glob("checkpoints/*.h5")):
            time.sleep(0.05)
        process.send_signal(number)
        _, text = process.communicate()
        self.add(what, arguments, process.returncode, expected, text)


def folders(trials):
    run = "tamp run inputs/punch/quick.json --quiet"
    trials.trial("two runs at once into one folder",
                 f"{run} --steps 60 --out a & sleep 0.2; {run} --steps 60 --out a", 2)
    trials.trial("`--force` beside a running one",
                 f"{run} --steps 60 --out b & sleep 0.4; {run} --force --out b", 2)
    trials.trial("`--restart` beside a running one",
                 f"{run} --steps 60 --out c & sleep 0.4; {run} --restart c", 2)
    trials.trial("a lock whose process was killed", f"{run} --force --steps 5 --out d", 0,
                 f"{run} --out d & sleep 0.5; kill -9 $!; wait")
    trials.trial("`--force` on a folder that is no run", f"{run} --force --out mine", 2,
                 "mkdir -p mine/checkpoints; touch mine/profile.json mine/checkpoints/mymodel.pt")
    trials.trial("`--force` on the scene's own folder", f"{run} --force --out inputs/punch", 2)
    checkpoint = f"{run} --steps 20 --checkpoint-steps 10 --out e; cp -r inputs changed; " \
                 "sed -i '$ s/.*/9e9,9e9/' changed/materials/concrete-sand/yield.csv"
    trials.trial("restart with other data",
                 "tamp run changed/punch/quick.json --quiet --steps 30 --restart e", 2, checkpoint)
    trials.trial("restart from a copy of the same tree",
                 "tamp run copy/punch/quick.json --quiet --steps 22 --restart e", 0, "cp -r inputs copy")
    trials.trial("restart without history.csv", f"{run} --steps 24 --restart e", 0, "rm e/history.csv")
    trials.trial("restart with fields.h5 emptied", f"{run} --steps 26 --restart e", 0, ": > e/fields.h5")
    for number in (signal.SIGHUP, signal.SIGXCPU, signal.SIGTERM, signal.SIGINT):
        trials.in_background(f"{number.name} while it runs", "tamp run ...", number, 128 + number)
    trials.trial("`--wall-limit`", f"{run} --wall-limit 0.3 --out f", 143)


def budgets(trials):
    check = "tamp check inputs/punch/quick.json"
    trials.trial("outputs without number", f"{check} --set /output/history_interval=1e-18", 2)
    trials.trial("fields without number", f"{check} --set /output/fields_interval=1e-300", 2)
    trials.trial("checkpoints without number", "tamp run inputs/punch/quick.json --checkpoint-time 1e-20", 2)
    trials.trial("particles without number", f"{check} --set /particles_per_cell=[20000,20000]", 2)
    (trials.folder / "deep.json").write_text("[" * 150_000 + "]" * 150_000)
    trials.trial("300 kB of nested JSON", "tamp check deep.json", 2)
    trials.trial("a pipe as scene", "mkfifo fifo; tamp check fifo", 2)
    trials.trial("a device as scene", "tamp check /dev/zero", 2)
    twice = {"type": "union", "of": [{"file": "twice.json"}] * 2}
    (trials.folder / "twice.json").write_text(json.dumps(twice))
    trials.trial("a geometry that names itself twice",
                 f"{check} --set '/bodies/punch/geometry={{\"file\":\"twice.json\"}}'", 2)
    (trials.folder / "nested.json").write_text('{"type":"transform","of":' * 10_000 + BALL + "}" * 10_000)
    trials.trial("10,000 nested transforms", f"{check} --set '/bodies/punch/geometry={{\"file\":\"nested.json\"}}'", 2)
    vectors = json.dumps({"support_vectors": [[0, 0]] * 1_000_000})
    (trials.folder / "many.json").write_text(vectors)
    trials.trial("10^6 support vectors", "tamp modulus many.json --at 0.1,0.1", 2)
    trials.trial("a list's item number 10^6", f"{check} --set /contact/1000000=1", 2)


def resources(trials):
    trials.trial("cells of 0.1 mm in space", "tamp check inputs/uxo/table.json --set /grid/cell_size=0.0001", 2)
    trials.trial("a limit of memory",
                 "ulimit -v 1000000; tamp check inputs/punch/table.json --set /grid/cell_size=0.001", 2)
    run = "tamp run inputs/punch/quick.json --steps 5"
    trials.trial("a closed stdout", f"{run} --out g >&-", 0)
    trials.trial("a reader that goes away", "tamp check inputs/punch/quick.json | true; exit ${PIPESTATUS[0]}", 0)
    trials.trial("a full stdout", "tamp check inputs/punch/quick.json >/dev/full", 4)
    trials.trial("a limit of file size", f"ulimit -f 600; {run} --quiet --out h", 4)


def physics(trials):
    run = "tamp run inputs/punch/quick.json --quiet"
    trials.trial("gravity of 1e6", f"{run} --set /gravity=[0,-1e6] --strict --out i", 3)
    trials.trial("an energy error beyond the limit", f"{run} --set /limits/energy_error=0.0005 --out j", 3)
    (trials.folder / "mpa.csv").write_text("pressure[Pa],sqrt_J2[Pa]\n-0.001,0\n100,50\n1000,200\n")
    trials.trial("a table in MPa", "tamp check inputs/punch/quick.json --set /materials/sand/yield/file=mpa.csv", 0)
    trials.trial("a density of 1e-320", "tamp check inputs/punch/quick.json --set /materials/sand/density=1e-320", 0)
    trials.trial("faster than any wave", "tamp check inputs/punch/quick.json --set /bodies/punch/velocity=[0,-9000]", 0)


def add_arguments(parser):
    program.add_option(parser)


def main(options):
    with tempfile.TemporaryDirectory() as folder:
        trials = Trials(options.tamp, pathlib.Path(folder))
        for group in (folders, budgets, resources, physics):
            group(trials)
    print(f"\n{trials.n_wrong} ended otherwise than they should")
    return 1 if trials.n_wrong else 0
