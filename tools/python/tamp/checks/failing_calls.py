"""Lets each call of a run, a restart and a study fail in its turn, and looks at how the program takes it.

A library that is loaded before others (tests/faults/failing_calls.cpp) lets one allocation or one call that writes
fail. Only calls of the program count, itself or in a library that it has called. Right is: exit code 0 or 4, a message
on stderr with 4, nothing of a library's own there, and nothing lost: what is at a file's final name is whole, kept
points of a study are as they were, a run whose checkpoints are there goes on to the bits of a run that was not
interrupted, with all its rows, and a study that is called again ends with the same values. A call that fails and is
made up for ends with 0 and the same bits. HDF5 follows pointers that no memory was found for, or ends the program by
itself: that is counted beside, by the stack at the end, and nothing may be lost by it. It prints how many ended how,
and the exit code is 1 if any was wrong.
"""

import collections
import concurrent.futures
import csv
import itertools
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile

from tamp import files, program
from tamp.checks.mutations import FOREIGN, table_without_costs
from tamp.failure import Failure
from tamp.options import count

LIMIT = 300  # seconds
ALLOCATIONS = ["malloc", "new"]
WRITES = ["write", "pwrite", "fwrite", "fflush", "fclose", "fsync", "ftruncate", "fallocate", "rename"]
LIBRARY = program.ROOT / "build/release/tests/libtamp_failing_calls.so"
SCENE = program.INPUTS / "savings/ball.json"
CELL_SIZE = 0.006  # metres: a few dozen cells
N_STEPS = 4

SYSTEM = ("libtamp_failing_calls", "libc.", "libstdc++", "libgcc_s")

Verdict = collections.namedtuple("Verdict", "reached code in_hdf5 wrong")


def expect_text(content):
    if content and not content.endswith(b"\n"):
        raise ValueError("its last line is cut off")


def expect_json(content):
    json.loads(content)


def expect_csv(content):
    expect_text(content)
    table = list(csv.reader(content.decode().splitlines()))
    if any(len(row) != len(table[0]) for row in table[1:]):
        raise ValueError("a row is not complete")


def expect_hdf5(content):
    """As long as it says of itself; a checkpoint in its seal, which stands before it."""
    if content.startswith(b"TAMP sealed "):
        whole = len(content) == int(content.split()[2])
    else:
        whole = content.startswith(b"\x89HDF\r\n\x1a\n\0") and len(content) >= struct.unpack_from("<Q", content, 40)[0]
    if not whole:
        raise ValueError("is no whole HDF5 file")


EXPECT = {".json": expect_json, ".csv": expect_csv, ".h5": expect_hdf5, ".xdmf": expect_text}


def contents(folder):
    """Files with final names in a folder: no locks, and no files that are not finished."""
    return {file.relative_to(folder): file.read_bytes() for file in folder.rglob("*")
            if file.is_file() and file.suffix not in [".part", ".lock"]}


def what_is_not_whole(kept):
    for name, content in kept.items():
        try:
            EXPECT.get(name.suffix, len)(content)
        except ValueError as error:
            yield f"{name}: {error}"


def what_is_said_wrong(code, text):
    """Faults of an exit code and the text on stderr."""
    if code not in [0, 4]:
        yield f"exit code {code}"
    if code != 0 and not text.startswith("tamp: "):
        yield "no message"
    if any(line and not line.startswith("tamp: ") for line in text.splitlines()):
        yield "a library's own lines"
    yield from (f"{words} is said" for words in FOREIGN if words in text)


def is_ended_by_hdf5(note):
    """Whether it was HDF5 that crashed or ended the program, by the stack at the end."""
    _, _, end = note.partition("crashed\n" if "crashed\n" in note else "ended\n")
    callers = (pathlib.Path(line.split("(")[0]).name for line in end.splitlines())
    return next((name for name in callers if not name.startswith(SYSTEM)), "").startswith("libhdf5")


class Work:
    """A call of the program into a folder, which may fail, and the same once more, which may not."""

    def __init__(self, tamp, place):
        self.tamp, self.place = tamp, place
        self.prepare()

    def prepare(self):
        """Make what there has to be before the first call."""

    def begin(self, folder):
        """Make what there is in the folder before a call."""

    def run(self, *words, environment=None):
        command = [str(word) for word in [self.tamp, *words]]
        try:
            done = subprocess.run(command, capture_output=True, timeout=LIMIT, text=True, errors="replace",
                                  env={**os.environ, "TAMP_PYTHON": "true", **(environment or {})})
        except subprocess.TimeoutExpired:
            return None, "took too long"
        return done.returncode, done.stderr

    def sound(self, *words):
        code, text = self.run(*words)
        if code != 0:
            raise Failure(" ".join(map(str, words)), f"exit code {code}: {text}")
        return text


class Run(Work):
    begun = ["run", SCENE, "--quiet", "--threads", 1, *program.changes({
        "/grid/cell_size": CELL_SIZE, "/output/history_interval": 1e-8, "/output/fields_interval": 1e-8})]
    kept = ["--checkpoint-steps", 2, "--checkpoint-keep", 9]
    words = [*begun, "--steps", N_STEPS]

    def prepare(self):
        straight = self.place / "straight"
        self.sound(*self.words, *self.kept, "--out", straight)
        self.end = self.end_of(straight)
        self.fields = (straight / "fields.h5").read_bytes()

    def end_of(self, folder):
        return files.document(folder / "summary.json")["state_digest"], files.text(folder / "history.csv")

    def call(self, folder):
        return [*self.words, *self.kept, "--out", folder]

    def what_is_lost(self, folder, code):
        if code != 0:
            if not any((folder / "checkpoints").glob("*.h5")):
                return
            text = self.sound(*self.words, "--restart", folder)
            if "begun anew" in text or "damaged" in text:
                yield f"restarted with {text.strip()}"
        elif (folder / "fields.h5").read_bytes() != self.fields:
            yield "other fields"
        if self.end_of(folder) != self.end:
            yield "ended differently"


class Restart(Run):
    """The restart of a run that was stopped after its first checkpoint."""

    def prepare(self):
        super().prepare()
        self.stopped = self.place / "stopped"
        self.sound(*self.begun, *self.kept, "--steps", 2, "--out", self.stopped)
        whole = self.place / "whole"
        self.begin(whole)
        self.sound(*self.call(whole))
        self.fields = (whole / "fields.h5").read_bytes()

    def begin(self, folder):
        shutil.copytree(self.stopped, folder)

    def call(self, folder):
        return [*self.words, *self.kept, "--restart", folder]


class Study(Work):
    """A study of two points, one of which is kept."""

    def prepare(self):
        self.file = self.place / "study.json"
        study = {"measure": {"run": os.path.relpath(SCENE, self.place)}, "repeat": 1,
                 "set": {"/time/end": 2e-6, "/output/history_interval": 1e-6},
                 "methods": [{"name": name, "set": {"/transfer": name}} for name in ["flip", "tflip"]],
                 "sweep": {"/grid/cell_size": [CELL_SIZE]},
                 "quantities": [{"name": "depth", "column": "ball.depth[m]", "take": "greatest", "exact": 1e-3}]}
        self.file.write_text(json.dumps({**study, "methods": study["methods"][:1]}))
        self.kept = self.place / "kept"
        self.sound(*self.call(self.kept))
        for left in self.kept.glob("[!.]*.*"):
            left.unlink()
        self.file.write_text(json.dumps(study))
        whole = self.place / "whole"
        self.begin(whole)
        self.sound(*self.call(whole))
        self.table = table_without_costs(whole / "points.csv")

    def begin(self, folder):
        shutil.copytree(self.kept, folder)

    def call(self, folder):
        return ["study", self.file, "--quiet", "--out", folder]

    def what_is_lost(self, folder, code):
        before, after = contents(self.kept), contents(folder)
        yield from (f"{name} has changed" for name in before if name.name == "result.json"
                    and after.get(name) != before[name])
        if code != 0:
            text = self.sound(*self.call(folder))
            if "run again" in text:
                yield f"called again with {text.strip()}"
        if table_without_costs(folder / "points.csv") != self.table:
            yield "ended with other values"


WORKS = {"run": Run, "restart": Restart, "study": Study}


class Sweep:
    """A call's failures, one after the other, in one kind of work."""

    def __init__(self, name, work, call, options, place):
        self.name, self.work, self.call, self.options, self.place = name, work, call, options, place

    def environment(self, **more):
        path = {"TAMP_FAIL_PATH": str(self.place)} if self.call in WRITES else {}
        return {"LD_PRELOAD": str(self.options.library), "TAMP_FAIL_CALL": self.call, **path, **more}

    def numbers(self):
        """Numbers of the calls that fail."""
        if not self.options.places:
            return itertools.count(self.options.begin, self.options.every)
        listed = self.place / f"{self.name}-{self.call}"
        folder = self.place / f"{self.name}-{self.call}-listed"
        self.work.begin(folder)
        self.work.run(*self.work.call(folder), environment=self.environment(TAMP_FAIL_PLACES=str(listed)))
        shutil.rmtree(folder)
        return sorted({int(line) for line in listed.read_text().split()})[::self.options.every]

    def at(self, number):
        folder, note = (self.place / f"{self.name}-{self.call}-{number}{end}" for end in ["", "-note"])
        self.work.begin(folder)
        before = contents(folder)
        code, text = self.work.run(*self.work.call(folder), environment=self.environment(
            TAMP_FAIL_AT=str(number), TAMP_FAIL_NOTE=str(note)))
        kept = contents(folder) if folder.exists() else {}
        reached = note.exists()
        in_hdf5 = code not in [0, 4] and reached and is_ended_by_hdf5(note.read_text())
        wrong = [*([] if in_hdf5 else what_is_said_wrong(code, text)), *what_is_not_whole(kept)]
        if code == 0 or kept != before:
            wrong += self.lost(folder, code)
        shutil.rmtree(folder, ignore_errors=True)
        if wrong:
            print(f"{self.name}, {self.call} {number}: {'; '.join(wrong)}: {text.strip()[-300:]}", flush=True)
            if reached and self.options.keep:
                self.options.keep.mkdir(parents=True, exist_ok=True)
                note.replace(self.options.keep / note.name)
        note.unlink(missing_ok=True)
        return Verdict(reached, code, in_hdf5, bool(wrong))

    def lost(self, folder, code):
        try:
            return list(self.work.what_is_lost(folder, code))
        except Exception as error:  # whatever is wrong with what the program has left
            return [f"cannot go on: {error}"]

    def verdicts(self, pool):
        """Until calls run out."""
        numbers = itertools.islice(self.numbers(), self.options.first)
        while some := list(itertools.islice(numbers, 20)):
            known = list(pool.map(self.at, some))
            yield from (verdict for verdict in known if verdict.reached or verdict.wrong)
            if not all(verdict.reached for verdict in known):
                return


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--library", type=pathlib.Path, default=LIBRARY, help="that lets calls fail (%(default)s)")
    parser.add_argument("--of", nargs="+", choices=WORKS, default=list(WORKS), help="all by default")
    parser.add_argument("--calls", nargs="+", choices=ALLOCATIONS + WRITES, default=ALLOCATIONS + WRITES,
                        help="all by default")
    parser.add_argument("--first", type=count, default=1000, metavar="N", help="how many of each call (%(default)s)")
    parser.add_argument("--begin", type=count, default=1, metavar="N", help="the first that fails (%(default)s)")
    parser.add_argument("--every", type=count, default=1, metavar="K", help="only every K-th")
    parser.add_argument("--places", action="store_true",
                        help="the first call from each place, by its whole stack, in place of every call")
    parser.add_argument("--jobs", type=count, default=2)
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="for the stacks of what went wrong")


def main(options):
    n_wrong = n_tried = 0
    options.tamp, options.library = options.tamp.resolve(), options.library.resolve()
    files.check_file(options.library)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for name in options.of:
            place = pathlib.Path(folder).resolve() / name
            place.mkdir()
            work = WORKS[name](options.tamp, place)
            for call in options.calls:
                known = list(Sweep(name, work, call, options, place).verdicts(pool))
                codes = collections.Counter(verdict.code for verdict in known)
                wrong = sum(verdict.wrong for verdict in known)
                in_hdf5 = sum(verdict.in_hdf5 for verdict in known)
                crashes = sum((verdict.code is None or verdict.code < 0) and not verdict.in_hdf5 for verdict in known)
                ends = ", ".join(f"{code}: {n}" for code, n in sorted(codes.items(), key=str))
                print(f"{name:8} {call:10} {len(known):6} tried, exit codes {ends or 'none'}; {in_hdf5} ended by "
                      f"HDF5, {crashes} other crashes, {wrong} wrong", flush=True)
                n_tried += len(known)
                n_wrong += wrong
    print(f"{n_wrong} of {n_tried} were wrong")
    return 1 if n_wrong else 0
