"""Damages scenes, data files, checkpoints and kept points of a study at random, and looks at how the program takes it.

A mutated scene is run for three steps, a mutated data file too, and a run whose newest checkpoint is damaged is gone on
with, as a study some of whose kept points are. Right is: an exit code of the list (0, 2, 3, 4), at most 20 seconds of
work, a message on stderr wherever it is not 0, after a damaged checkpoint the bits of a run that was not interrupted,
and after damaged points the values that they had. It prints how many ended how, and the exit code is 1 if any was
wrong; of those, scenes, data and checkpoints are kept in FOLDER.
"""

import collections
import concurrent.futures
import csv
import json
import os
import pathlib
import random
import resource
import shutil
import subprocess
import tempfile

from tamp import files, program
from tamp.failure import Failure
from tamp.options import count

LIMIT = 20  # seconds of processor time; of the clock, on a machine that others use, six times as many
N_STEPS = 3

Verdict = collections.namedtuple("Verdict", "kind code wrong text")

STRANGE_VALUES = [
    0, -0.0, 1, -1, 2, 3, 7, 1e-320, 1e-300, 1e-18, 1e-9, 1e-3, 0.5, 1e3, 1e6, 1e9, 1e18, 1e300, 1.7976931348623157e308,
    2**31, 2**63, 2**64, -2**63, True, False, None, "", "nan", "inf", "symmetry", "steel", "sand", "x" * 5000,
    "\u0000", "../..", "/dev/zero", "/dev/null", "/", [], [0], [0, 0], [1e300, -1e300], [0, 0, 0], [[]], {},
    {"file": "x.json"},
    {"type": "box", "lower": [0, 0], "upper": [1, 1]}, {"type": "ball", "centre": [0.5, 0.5], "radius": 1e-9},
    {"type": "union", "of": []}]


def run(command, folder):
    """The exit code, negative for a signal and None for one that took too long, and what stands on stderr."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 2))

    try:
        done = subprocess.run([str(word) for word in command], cwd=folder, timeout=6 * LIMIT, capture_output=True,
                              preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return None, "took too long"
    return done.returncode, done.stderr.decode(errors="replace")


FOREIGN = ["json.exception", "filesystem error", "std::", "basic_string", "vector::"]  # a library's own text


def judged(kind, code, text, allowed=(0, 2, 3, 4)):
    wrong = (code not in allowed or (code != 0 and not text.startswith("tamp: "))
             or any(words in text for words in FOREIGN))
    return Verdict(kind, code, wrong, text)


def places(value, above=()):
    """Every place in a JSON document, as the keys that lead there."""
    yield above
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield from places(inner, above + (key,))


def holder_of(document, place):
    for key in place[:-1]:
        document = document[key]
    return document


def mutate_json(document, chance):
    """One to three changes: another value, a key less, a key more, two values exchanged, a number scaled."""
    for _ in range(chance.choice([1, 1, 1, 2, 3])):
        all_places = [place for place in places(document) if place]
        if not all_places:
            return
        place = chance.choice(all_places)
        holder, key = holder_of(document, place), place[-1]
        way = chance.randrange(6)
        if way <= 1:
            holder[key] = json.loads(json.dumps(chance.choice(STRANGE_VALUES)))
        elif way == 2 and isinstance(holder[key], (int, float)):
            holder[key] = holder[key] * chance.choice([-1, 1e-12, 1e-6, 0.1, 10, 1e3, 1e6, 1e12])
        elif way == 3:
            del holder[key]
        elif way == 4 and isinstance(holder, dict):
            holder[chance.choice(["file", "type", "title", "rigid", key + "x"])] = chance.choice(STRANGE_VALUES)
        else:
            other = chance.choice(all_places)
            value = holder_of(document, other)[other[-1]]
            holder[key] = json.loads(json.dumps(value))


def mutate_bytes(content, chance):
    """A bit turned, bytes overwritten, cut out, doubled or put in, or the end cut off."""
    content = bytearray(content)
    for _ in range(chance.choice([1, 1, 2, 5, 20])):
        if not content:
            break
        at = chance.randrange(len(content))
        n = min(chance.choice([1, 1, 4, 16, 200]), len(content) - at)
        way = chance.randrange(6)
        if way == 0:
            content[at] ^= 1 << chance.randrange(8)
        elif way == 1:
            content[at:at + n] = bytes(chance.randrange(256) for _ in range(n))
        elif way == 2:
            del content[at:at + n]
        elif way == 3:
            content[at:at] = content[at:at + n]
        elif way == 4:
            content[at:at] = chance.choice([b"\n", b",", b"nan", b"1e999", b"-", b"\xff", b"[", b"}", b'"', b"#"])
        elif chance.random() < 0.2:
            del content[at:]
    return bytes(content)


def damage(file, other, chance):
    """A file damaged, cut off, emptied, gone, another point's, or no file. Whether it is another than it was."""
    content = file.read_bytes()
    way = chance.choice(["bytes", "bytes", "byte", "half", "empty", "gone", "other", "pipe", "folder"])
    if way == "bytes":
        file.write_bytes(mutate_bytes(content, chance))
    elif way == "byte":
        at = chance.randrange(len(content))
        file.write_bytes(content[:at] + bytes([content[at] ^ 1 << chance.randrange(8)]) + content[at + 1:])
    elif way == "half":
        file.write_bytes(content[:chance.randrange(len(content))])
    elif way == "empty":
        file.write_bytes(b"")
    elif way == "other":
        file.write_bytes(other.read_bytes())
    else:
        file.unlink()
        if way == "pipe":
            os.mkfifo(file)
        elif way == "folder":
            file.mkdir()
    return not file.is_file() or file.read_bytes() != content


def table_without_costs(file):
    """The cells of a study's points.csv that no noise of the machine touches."""
    with open(file, newline="") as stream:
        return [{name: cell for name, cell in row.items() if not name.startswith(("core_s", "front of"))}
                for row in csv.DictReader(stream)]


def published(folder):
    """The sand's curves once more, in the layout of published tables."""
    names = {"plastic_volumetric[-]": "PlasticStrainVol", "total_volumetric[-]": "TotalStrainVol",
             "pressure[Pa]": "Pressure", "q[Pa]": "SqrtJ2"}
    for name in ["yield", "crush_curve", "hydrostat"]:
        lines = [line for line in (folder / f"{name}.csv").read_text().splitlines() if line and line[0] != "#"]
        columns = list(zip(*(line.split(",") for line in lines)))
        lists = {names[column[0].strip()]: [float(x) for x in column[1:]] for column in columns}
        (folder / f"{name}.json").write_text(json.dumps({"Vaango_tabular_data": {"Data": lists}}))


def small_punch():
    """A scene of a few hundred particles, which runs in no time."""
    scene = files.document(program.INPUTS / "punch/quick.json")
    scene["grid"].update({"cell_size": 0.05, "patches": [2, 2]})
    scene["bodies"]["punch"]["geometry"].update({"lower": [0.35, 0.5]})
    return scene


class Mutations:
    def __init__(self, options, place):
        self.options, self.place = options, place
        self.run_command = [options.tamp.resolve(), "run", "--quiet", "--threads", 1]
        shutil.copytree(program.INPUTS, place / "inputs")
        published(place / "inputs/materials/concrete-sand")
        self.inputs = place / "inputs"

    def keep(self, number, kind, content):
        if self.options.keep:
            self.options.keep.mkdir(parents=True, exist_ok=True)
            (self.options.keep / f"{kind}_{number}").write_bytes(content)

    def scene(self, number):
        chance = random.Random(f"{self.options.seed} scene {number}")
        scene = small_punch()
        sand = scene["materials"]["sand"]
        if chance.random() < 0.5:  # the material's own keys in the scene, so that they are changed too
            material = files.document(self.inputs / "materials/concrete-sand/table.json")
            there = "../materials/concrete-sand/"
            for key in ["hydrostat", "crush_curve"]:
                material[key] = there + material[key]
            material["yield"]["file"] = there + material["yield"]["file"]
            for key in ["table", "svr", "mlp"]:
                material["modulus"][key] = there + material["modulus"][key]
            form = chance.choice(["rate", "state"])
            scene["materials"]["sand"] = {**material, "density": 1050, "elastic_update": form}
        else:
            sand["modulus"] = {"type": chance.choice(["table", "svr", "mlp"])}
        mutate_json(scene, chance)
        content = json.dumps(scene).encode()
        if chance.random() < 0.2:
            content = mutate_bytes(content, chance)
        file = self.inputs / f"punch/mutated_{number}.json"
        file.write_bytes(content)
        out = self.place / f"scene_{number}"
        verdict = judged("scene", *run([*self.run_command, file, "--steps", N_STEPS, "--out", out], self.place))
        shutil.rmtree(out, ignore_errors=True)
        file.unlink()
        if verdict.wrong:
            self.keep(number, "scene", content)
        return verdict

    def data(self, number):
        chance = random.Random(f"{self.options.seed} data {number}")
        folder = self.place / f"data_{number}"
        shutil.copytree(self.inputs, folder)
        sand = folder / "materials/concrete-sand"
        name = chance.choice(["unloading.csv", "yield.csv", "crush_curve.csv", "hydrostat.csv", "support_vectors.json",
                              "network.h5", "yield.json", "crush_curve.json", "hydrostat.json", "table.json"])
        file = sand / name
        if name.endswith(".json") and chance.random() < 0.5:
            document = files.document(file)
            mutate_json(document, chance)
            file.write_text(json.dumps(document))
        else:
            file.write_bytes(mutate_bytes(file.read_bytes(), chance))
        scene = small_punch()
        scene["materials"]["sand"]["elastic_update"] = "state" if name.startswith("hydrostat") else "rate"
        model = {"support_vectors.json": "svr", "network.h5": "mlp"}.get(name, "table")
        scene["materials"]["sand"]["modulus"] = {"type": model}
        there = f"../materials/concrete-sand/{name}"
        if name in ["hydrostat.json", "crush_curve.json"]:
            scene["materials"]["sand"][name.removesuffix(".json")] = there
        elif name == "yield.json":
            scene["materials"]["sand"]["yield"] = {"file": there, "measure": "q"}
        (folder / "punch/scene.json").write_text(json.dumps(scene))
        arguments = [folder / "punch/scene.json", "--steps", N_STEPS, "--out", folder / "out"]
        verdict = judged(f"data {name}", *run([*self.run_command, *arguments], folder))
        if verdict.wrong:
            self.keep(number, f"data_{name}", file.read_bytes())
        shutil.rmtree(folder, ignore_errors=True)
        return verdict

    def prepare_checkpoints(self):
        """A run with two checkpoints, and the digest with which every run that goes on has to end."""
        scene = self.inputs / "punch/small.json"
        scene.write_text(json.dumps(small_punch()))
        self.small = [*self.run_command, scene]
        run([*self.small, "--steps", 20, "--checkpoint-steps", 10, "--out", self.place / "run"], self.place)
        run([*self.small, "--steps", 25, "--out", self.place / "straight"], self.place)
        self.digest = files.document(self.place / "straight/summary.json")["state_digest"]

    def checkpoint(self, number):
        chance = random.Random(f"{self.options.seed} checkpoint {number}")
        folder = self.place / f"checkpoint_{number}"
        shutil.copytree(self.place / "run", folder)
        newest = folder / "checkpoints/step_00000020.h5"
        content = newest.read_bytes()
        damaged = mutate_bytes(content, chance)
        newest.write_bytes(damaged)
        code, text = run([*self.small, "--steps", 25, "--restart", folder], self.place)
        verdict = judged("checkpoint", code, text, allowed=(0,))
        if not verdict.wrong:
            summary = files.document(folder / "summary.json")
            before = 10 if damaged != content else 20
            same = summary["state_digest"] == self.digest and summary["restarted_at_step"] == before
            verdict = verdict._replace(wrong=not same, text=verdict.text if same else f"{text}; ended with other bits")
        if verdict.wrong:
            self.keep(number, "checkpoint", damaged)
        shutil.rmtree(folder, ignore_errors=True)
        return verdict

    def prepare_study(self):
        """A study with four points, of which it asks for columns and fields, and what came out of it."""
        self.study_file = self.inputs / "punch/study.json"
        self.study_file.write_text(json.dumps({
            "measure": {"run": "small.json"}, "repeat": 1,
            "set": {"/time/end": 2e-4, "/output/history_interval": 2e-5, "/output/fields_interval": 1e-4},
            "methods": [{"name": name, "set": {"/transfer": name}} for name in ["flip", "tflip"]],
            "sweep": {"/grid/cell_size": [0.1, 0.05]},
            "quantities": [
                {"name": "depth", "column": "punch.depth[m]", "take": "greatest", "exact": 1e-3},
                {"name": "kinetic", "column": "kinetic[J]", "take": "mean", "at": 1e-4, "exact": 1},
                {"name": "lowest", "take": "quantile", "quantile": 0.1, "field": "position", "component": 1,
                 "material": "sand", "exact": 0.1}]}))
        self.study_command = [self.options.tamp.resolve(), "study", self.study_file, "--quiet", "--out"]
        os.environ["TAMP_PYTHON"] = "true"  # no pages are drawn
        code, text = run([*self.study_command, self.place / "study"], self.place)
        if code != 0:
            raise Failure("the study", f"exit code {code}: {text}")
        self.table = table_without_costs(self.place / "study/points.csv")

    def study(self, number):
        chance = random.Random(f"{self.options.seed} study {number}")
        folder = self.place / f"study_{number}"
        shutil.copytree(self.place / "study", folder)
        (folder / "points.csv").unlink()
        mark = folder / ".tamp-study"
        files = sorted(folder.glob("points/*/*"))
        originals = sorted((self.place / "study").glob("points/*/*"))
        of_mark = chance.random() < 0.1
        has_changed = False
        for file in [mark] if of_mark else chance.sample(files, chance.choice([1, 1, 2, 4])):
            other = chance.choice([one for one in originals if one.name == file.name] or [self.study_file])
            has_changed |= damage(file, other, chance) and file.name != "result.json"
        code, text = run([*self.study_command, folder], self.place)
        verdict = judged("study, its mark" if of_mark else "study, a point", code, text, (0, 2, 4) if of_mark else (0,))
        if code == 0 and table_without_costs(folder / "points.csv") != self.table:
            verdict = verdict._replace(wrong=True, text=f"{text}; ended with other values")
        elif code == 0 and has_changed and not of_mark and "it is run again" not in text:
            verdict = verdict._replace(wrong=True, text="no word of what was damaged")
        shutil.rmtree(folder, ignore_errors=True)
        return verdict


def add_arguments(parser):
    program.add_option(parser)
    for name, number in {"scenes": 2500, "data": 1500, "checkpoints": 300, "studies": 400}.items():
        parser.add_argument(f"--{name}", type=int, default=number, help="how many (%(default)s)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=count, default=2)
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER")


def main(options):
    counts, wrong = collections.Counter(), []
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        mutations = Mutations(options, pathlib.Path(folder))
        mutations.prepare_checkpoints()
        mutations.prepare_study()
        for work, n in [(mutations.scene, options.scenes), (mutations.data, options.data),
                        (mutations.checkpoint, options.checkpoints), (mutations.study, options.studies)]:
            for number, verdict in enumerate(pool.map(work, range(n))):
                counts[verdict.kind, verdict.code] += 1
                if verdict.wrong:
                    wrong.append(verdict)
                    print(f"{verdict.kind} {number}: {verdict.code}: {verdict.text[-300:]}", flush=True)
    for (kind, code), n in sorted(counts.items(), key=str):
        print(f"{kind:30} {'no end' if code is None else code!s:>6} {n:6}")
    print(f"{len(wrong)} of {sum(counts.values())} were wrong")
    return 1 if wrong else 0
