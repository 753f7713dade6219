"""What commands write, and what they have read: runs them once each, or takes studies that have run before."""

import ctypes
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
from typing import NamedTuple

from tamp import files, program
from tamp.failure import Refusal
from tamp.research.make_results import recipe

INPUTS = {"verify": program.INPUTS / "verification", "stability": program.INPUTS / "stability"}


class Output(NamedTuple):
    """What a command has written."""

    folder: pathlib.Path
    printed: str
    study: str = ""  # of `tamp study`, its name
    inputs: tuple = ()  # the files that it says it has read


# The program


def machine_of(tamp):
    """What a run of one step says of program and machine."""
    with tempfile.TemporaryDirectory() as place:
        scene, folder = pathlib.Path(place, "ball.json"), pathlib.Path(place, "run")
        program.call(tamp, "new", "ball", scene)
        program.run(tamp, scene, folder, "--steps", 1, "--threads", 1)
        return files.document(folder / "profile.json")["machine"]


def commit_of(tamp, machine):
    """The commit of the program's sources, in as many digits as the index has."""
    built_of = machine["commit"]
    if not built_of or built_of.endswith("+"):
        what = f"built of sources that differ from commit {built_of[:-1]}" if built_of else "built without git"
        raise Refusal(tamp, what, "a program built of a commit, which the index can name")
    words = ["git", "-C", str(program.ROOT), "rev-parse", "--short=12", f"{built_of}^{{commit}}"]
    said = subprocess.run(words, capture_output=True, text=True)
    if said.returncode != 0:
        raise Refusal(tamp, f"built of commit {built_of}, which git does not know here", "a program of this repository")
    return said.stdout.strip()


# Studies


def studies_of(words):
    """The files of the studies that a command runs."""
    if words[1] == "study":
        return [program.ROOT / word for word in words[2:3]]
    if words[1] not in INPUTS:
        return []
    at = next((k for k, word in enumerate(words) if word.startswith("--")), len(words))
    names = [INPUTS[words[1]] / f"{name}.json" for name in words[2:at]]
    return names or sorted(INPUTS[words[1]].glob("*.json"))


def read_by(folder):
    """(file, hash) of all that a run has read, as it says itself."""
    summary = folder / "summary.json"
    if not summary.exists():
        return []
    with files.written_by_tamp(summary):
        return [(pathlib.Path(one["file"]), one["hash"]) for one in files.document(summary).get("inputs", [])]


def inputs_of(folder):
    """The same of all points of a study."""
    report = folder / "study.json"
    with files.written_by_tamp(report):
        points = [folder / point["folder"] for point in files.document(report)["points"] if point["folder"]]
    return list(dict.fromkeys(one for point in points for one in read_by(point)))


def hash_of(path):
    """A file's hash as the program has it in summary.json."""
    try:
        library = ctypes.CDLL("libxxhash.so.0")
    except OSError:
        raise Refusal("libxxhash.so.0", "not there", "Debian's package libxxhash0, to compare inputs with") from None
    library.XXH3_64bits.argtypes, library.XXH3_64bits.restype = [ctypes.c_char_p, ctypes.c_size_t], ctypes.c_uint64
    data = files.content(path)
    return f"{library.XXH3_64bits(data, len(data)):016x}"


def expect_study(folder, study):
    """That a folder has the whole study that is named, of inputs that are the same now."""
    report = folder / "study.json"
    with files.written_by_tamp(report):
        command = shlex.split(files.document(report)["command"])
        is_meant = f"/{command[2]}".endswith(f"/{study.parent.name}/{study.name}")
    if not is_meant:
        raise Refusal(report, shlex.join(command), f"a run of {study}")
    rehearsed = recipe.REHEARSALS & set(command)
    if rehearsed:
        raise Refusal(report, f"run with {', '.join(sorted(rehearsed))}", "the whole study")
    for path, known in inputs_of(folder):
        if not path.is_file() or hash_of(path) != known:
            raise Refusal(path, f"changed since {report}", "what it was made from")


def kept_study(folder, study):
    """Where in a folder given with --from a study is."""
    for place in (folder, folder / study.stem):
        report = place / "study.json"
        if report.exists():
            with files.written_by_tamp(report):
                name = files.document(report)["name"]
            if name == study.stem:
                expect_study(place, study)
                return place.resolve()
    raise Refusal(folder, f"no study.json of {study.stem}", "the folder of a run of it that came to its end")


# Runs


class Runs:
    """Runs commands, each once. Studies are in `kept`, or else go on in a folder of the command's own below `out`."""

    def __init__(self, options, place):
        self.tamp, self.out, self.kept, self.place = options.tamp.resolve(), options.out.resolve(), options.kept, place
        self.outputs = {}

    def output(self, words):
        text = shlex.join(words)
        if text not in self.outputs:
            print(f"running: {text}", flush=True)
            place = self.place / str(len(self.outputs))
            place.mkdir()
            self.outputs[text] = self.run(words, place)
        return self.outputs[text]

    def run(self, words, place):
        if recipe.is_python(words):
            python = sys.executable if words[0] == "python3" else words[0]
            own = [] if self.tamp == program.USUAL else ["--tamp", self.tamp]
            return Output(place, program.call(python, *words[1:], *own, folder=program.ROOT).stdout)
        if words[1] in recipe.STUDIES:
            return self.run_studies(words, place)
        option, name = recipe.FILES.get(words[1], ("--out", "run"))
        quiet = ["--quiet"] if words[1] in recipe.FOLDERS else []
        program.call(self.tamp, *words[1:], option, place / name, *quiet, folder=program.ROOT)
        folder = place / name if words[1] in recipe.FOLDERS else place
        return Output(folder, "", inputs=tuple(path for path, _ in read_by(folder)))

    def run_studies(self, words, place):
        studies, is_one = studies_of(words), words[1] == "study"
        if self.kept is None:  # --force removes the results of another program alone
            folder, own = self.out / re.sub(r"[^\w.]+", "-", " ".join(words[1:])), ["--force"]
        else:
            folder, own = self.linked(words, studies, place), []
        program.call(self.tamp, *words[1:], "--out", folder, "--quiet", *own, folder=program.ROOT)
        read = [] if "--limit" in words else [
            path for study in studies for path, _ in inputs_of(folder if is_one else folder / study.stem)]
        return Output(folder, "", studies[0].stem if is_one else "", (*studies, *read))

    def linked(self, words, studies, place):
        """A folder whose studies are those of --from. The program itself sees whether there is anything left to run."""
        if "--limit" in words:
            raise Refusal("--from", shlex.join(words), "a study without --limit")
        if words[1] == "study":
            (place / "study").symlink_to(kept_study(self.kept, studies[0]))
            return place / "study"
        for study in studies:
            (place / study.stem).symlink_to(kept_study(self.kept, study))
        return place
