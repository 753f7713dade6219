"""The tables of docs/reference say what the program declares and writes: nothing less, and nothing else.

    cd tools/python; python3 -m tests.test_reference [--tamp build/release/tamp]

What there is comes from `tamp schema`, from the help, and from runs of two steps: every scene of `tamp new`, and a few
more that have what those lack.
"""

import argparse
import csv
import json
import pathlib
import re
import sys
import tempfile
import unittest

from tamp import files, program
from tamp.__main__ import CHECKS, FOR_USERS, RESEARCH

try:
    import h5py
except ModuleNotFoundError:
    h5py = None

PAGES = program.ROOT / "docs"
TAMP = program.USUAL
CODE = re.compile(r"`([^`]+)`")
KEY = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
OPTION = re.compile(r"--[a-z][a-z0-9-]*")

# What `tamp new` has not: settings by which further columns and fields are there.
CAP = {"file": str(program.SAND / "table.json")}
FURTHER = {
    "pressed": ("ball", {"/bodies/ball/nose": [0, 0.0841], "/bodies/ball/tail": [0, 0.1081],
                         "/bodies/sand/pressure": {"value": 10}}),
    "pressed in space": ("ball --in space", {"/bodies/sand/pressure": {"value": 10}}),
    "nose in space": ("cone --in space", {"/bodies/cone/nose": [0, 0, 0.09], "/bodies/cone/tail": [0, 0, 0.144]}),
    "apart": ("punch", {"/materials/sand": {**CAP, "separation": True}}),
}
ELASTIC = {"type": "neo_hookean", "density": 8000, "bulk_modulus": 2e7, "shear_modulus": 1.2e7}
SOIL = {**ELASTIC, "friction_angle": 35, "separation": True}
# By what output.md calls them; rigid bodies do not go around.
MATERIALS = {"elastic": ELASTIC, "drucker_prager": {**SOIL, "type": "drucker_prager"},
             "mohr_coulomb": {**SOIL, "type": "mohr_coulomb"}, "tabular_cap": {**CAP, "gaps": True},
             "bolton_sand": {"file": str(program.INPUTS / "materials/toyoura-sand/medium.json")}}
PERIODIC = {
    "dimension": 2, "grid": {"upper": [10, 4], "cell_size": 1}, "boundaries": {"x-": "periodic", "x+": "periodic"},
    "time": {"end": 1}, "materials": MATERIALS,
    "bodies": {name: {"material": name, "geometry": {"type": "box", "lower": [2 * k, 0], "upper": [2 * k + 1, 1]}}
               for k, name in enumerate(MATERIALS)}}
PROBLEM = program.INPUTS / "verification/scenes/drifting_bar.json"  # with an exact solution
STEPS_OF_PROBLEM = 300  # a profile knows after some 230 how far it is to be trusted

FAMILIES = {"soil": {"drucker_prager", "mohr_coulomb", "bolton_sand"}, "cap": {"tabular_cap"}}
ALIKE = {"hypoelastic": "elastic", "neo_hookean": "elastic", "neo_hookean_log": "elastic"}
BY_NAMES = {"energies_J", "greatest", "materials"}  # of summary.json: by columns of the history, and as it says


# --- what the pages say ---


def page(name):
    return (PAGES / name).read_text(encoding="utf-8")


def section(text, heading):
    """What stands below a heading, up to the next one of any depth."""
    found = re.search(rf"^#+ {re.escape(heading)}\n(.*?)(?=^#+ |\Z)", text, re.MULTILINE | re.DOTALL)
    return found[1]


def rows(text):
    """The cells of the first table, without its head."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def names(text):
    return CODE.findall(text)


def keys(text):
    return [name for name in names(text) if KEY.fullmatch(name)]


def first_names(text):
    return [name for cells in rows(text) for name in names(cells[0])]


def differences(there, told):
    """What is not told, and what is told but is not there."""
    return sorted(set(there) - set(told)), sorted(set(told) - set(there))


NOTHING = ([], [])


# --- what the program declares ---


def helped(*words):
    return program.call(TAMP, *words, "--help").stdout


def listed(text, head, what):
    """The names at the beginnings of lines below a head of a help."""
    part = re.search(rf"^{head}:\n(.*?)(?=^\w+:|\Z)", text, re.MULTILINE | re.DOTALL)
    return re.findall(rf"^  ({what})(?= )", part[1], re.MULTILINE) if part else []


def commands():
    return listed(helped(), "Commands", "[a-z]+")


def options_of(command):
    return listed(helped(command), "Options", OPTION.pattern)


def schema():
    whole = json.loads(program.call(TAMP, "schema").stdout)
    return whole["definitions"]["scene"]["else"]["properties"]


class Run:
    """Two steps of a scene, and what they have left."""

    def __init__(self, folder, scene, settings=(), n_steps=2):
        program.run(TAMP, scene, folder, "--steps", n_steps, "--threads", 1, settings=settings)
        self.folder = folder
        self.scene, self.summary = (files.document(folder / f"{name}.json") for name in ("scene", "summary"))

    def columns(self, name="history.csv"):
        with open(self.folder / name, encoding="utf-8", newline="") as file:
            return next(csv.reader(file))

    def family(self, material):
        """What output.md calls a material of this type."""
        kind = self.scene["materials"][material]["type"]
        is_rigid = any(body["material"] == material and body["rigid"] for body in self.scene["bodies"].values())
        return "rigid" if is_rigid else ALIKE.get(kind, kind)


class Runs:
    """Of every kind and geometry of `tamp new`, and of what these lack."""

    folder, all = None, {}

    @classmethod
    def make(cls):
        cls.folder = tempfile.TemporaryDirectory()
        scenes = {}
        for words in every_new_scene():
            scenes[words] = cls.place(f"{words.replace(' ', '_')}.json")
            program.call(TAMP, "new", *words.split()[:1], scenes[words], *words.split()[1:])
            cls.all[words] = Run(cls.place(words), scenes[words])
        for name, (words, settings) in FURTHER.items():
            cls.all[name] = Run(cls.place(name), scenes[words], settings)
        cls.place("periodic.json").write_text(json.dumps(PERIODIC))
        cls.all["periodic"] = Run(cls.place("periodic"), cls.place("periodic.json"))
        cls.all["problem"] = Run(cls.place("problem"), PROBLEM, n_steps=STEPS_OF_PROBLEM)

    @classmethod
    def place(cls, name):
        return pathlib.Path(cls.folder.name, name)


def every_new_scene():
    """`ball`, `ball --in plane` and so on; a kind that a geometry has not is refused."""
    text = " ".join(helped("new").split())
    kinds, geometries = (re.search(pattern, text)[1].split(", ") for pattern in
                         [r"what goes into the ground \(([^)]*)\)", r"pad of a lander \(([^;]*?); by"])
    there = [f"{kind} --in {geometry}" for kind in kinds for geometry in geometries]
    return [*kinds, *(words for words in there if words != "cone --in plane")]


def setUpModule():
    Runs.make()


def tearDownModule():
    Runs.folder.cleanup()


# --- the comparisons ---


def as_pattern(name):
    """Of the columns that a name of the page stands for: a body's, a material's, one for each axis."""
    words = {"BODY": r"[\w-]+", "MATERIAL": r"[\w-]+", "*": "[xyz]"}
    return re.compile("".join(words.get(part) or re.escape(part) for part in re.split(r"(BODY|MATERIAL|\*)", name)))


def unmatched(columns, told):
    """As `differences`, of names with places for those of bodies, materials and axes."""
    patterns = {name: as_pattern(name) for name in told}
    plain = {column: column.replace(".near_nose.", ".") for column in columns}  # "and so on"
    return (sorted(column for column, name in plain.items() if not any(p.fullmatch(name) for p in patterns.values())),
            sorted(name for name, p in patterns.items() if not any(map(p.fullmatch, columns))))


class History(unittest.TestCase):
    def test_columns_are_those_of_the_page(self):
        columns = {column for run in Runs.all.values() for column in run.columns()}

        self.assertEqual(unmatched(columns, first_names(section(page("reference/output.md"), "history.csv"))), NOTHING)

    def test_columns_of_the_machine_are_those_of_the_page(self):
        columns = Runs.all["ball"].columns("machine.csv")

        self.assertEqual(differences(columns, first_names(section(page("reference/output.md"), "machine.csv"))),
                         NOTHING)

    def test_total_is_the_sum_that_the_page_says_of_all_energies(self):
        meaning = next(cells[1] for cells in rows(section(page("reference/output.md"), "history.csv"))
                       if cells[0] == "`total[J]`").split(";")[0]
        signs = {name: -1 if sign == "-" else 1 for sign, name in re.findall(r"([-+]?) ?(\w+)", meaning)}
        for name, run in Runs.all.items():
            columns, last = run.columns(), files.written_table(run.folder / "history.csv")[1][-1]
            energies = {column.removesuffix("[J]"): value for column, value in zip(columns, last)
                        if column.endswith("[J]")}
            total = energies.pop("total")

            self.assertEqual(signs.keys(), energies.keys())
            self.assertAlmostEqual(total, sum(signs[one] * value for one, value in energies.items()), msg=name,
                                   delta=1e-12 * max(map(abs, energies.values())))


class Folder(unittest.TestCase):
    def test_files_are_those_of_the_page(self):
        written = [file.name for file in Runs.all["ball"].folder.iterdir() if not file.name.startswith(".")]

        self.assertEqual(differences(written, first_names(section(page("reference/output.md"), "What a run writes"))),
                         NOTHING)


@unittest.skipUnless(h5py, "h5py is not here")
class Fields(unittest.TestCase):
    def test_of_each_kind_of_material_are_those_of_the_page(self):
        text = section(page("reference/output.md"), "fields.h5")
        told = {(family, name) for cells in rows(text) for name, of in zip(names(cells[0]), owners(cells))
                for family in families_of(of)}
        written = {pair for run in Runs.all.values() for pair in fields_of(run)}

        self.assertEqual(differences(written, told), NOTHING)

    def test_groups_and_attributes_are_those_of_the_page(self):
        text = section(page("reference/output.md"), "fields.h5")
        parts = re.findall(r"^    /step_\d+(?:/(\w+))?", text, re.MULTILINE)
        with h5py.File(Runs.all["ball"].folder / "fields.h5") as file:
            first = file["step_00000000"]
            attributes = [*first.attrs, *first["nodes"].attrs]

            self.assertEqual(differences(first, filter(None, parts)), NOTHING)
            self.assertEqual(differences(attributes, re.findall(r'"(\w+)"', text.split("\n\n")[1])), NOTHING)
            self.assertEqual(differences(first["nodes"], first_names(text))[0], [])


def owners(cells):
    """For each of the names of a row, in words; one for all of them where there is one."""
    of = cells[1].split("; ")
    return of if len(of) > 1 else of * len(names(cells[0]))


def families_of(words):
    """All that `all`, `cap with gaps, soil with separation` and the like stand for."""
    everyone = {*MATERIALS, "rigid"}
    found = set()
    for part in words.split(", "):
        first = part.split()[0].strip("`")
        found |= everyone if first == "all" else FAMILIES.get(first, {first})
    return found - {"rigid"} if "but rigid" in words or "periodic" in words else found


def fields_of(run):
    with h5py.File(run.folder / "fields.h5") as file:
        for material, group in file["step_00000000/particles"].items():
            yield from ((run.family(material), name) for name in group if name not in ("id", "position"))


class Summary(unittest.TestCase):
    def setUp(self):
        self.rows = rows(section(page("reference/output.md"), "summary.json"))

    def test_keys_are_those_of_the_page(self):
        paths = [name.split("/") for cells in self.rows for name in names(cells[0])]
        told, told_below = {path[0] for path in paths}, {tuple(path) for path in paths if path[1:]}
        below = {(key, name) for key, _ in told_below for name in Runs.all["ball"].summary[key]}

        self.assertEqual(differences({key for run in Runs.all.values() for key in run.summary}, told), NOTHING)
        self.assertEqual(differences(below, told_below), NOTHING)

    def test_keys_of_its_objects_are_those_of_the_page(self):
        n_compared = 0
        for cells in self.rows:
            for name in set(names(cells[0])) - BY_NAMES - {"monitors"}:
                there = {key for run in Runs.all.values() for key in keys_of(run, name)}
                if there:
                    n_compared += 1
                    with self.subTest(name):
                        self.assertEqual(differences(there, keys(cells[1])), NOTHING)

        self.assertGreater(n_compared, 10)


def keys_of(run, name):
    """Those of an object, without the names of materials; those of each body."""
    value = run.summary
    for part in name.split("/"):
        value = value[part]
    if name == "bodies":
        return {key for body in value.values() for key in body}
    return set(value) - set(run.scene["materials"]) if isinstance(value, dict) else set()


class Monitors(unittest.TestCase):
    def watched(self):
        """Those of a limit, and what is but counted."""
        found = [(name, one) for run in Runs.all.values() for name, one in run.summary["monitors"].items()]
        return ({name: one for name, one in found if isinstance(one, dict)},
                {name for name, one in found if not isinstance(one, dict)})

    def test_and_their_limits_are_those_of_the_page(self):
        told = {(names(cells[0])[0], float(cells[2])) for cells in rows(page("reference/monitors.md"))}
        limits = schema()["limits"]["properties"]
        watched = self.watched()[0]

        self.assertEqual(differences({(name, one["limit"]) for name, one in watched.items()}, told), NOTHING)
        self.assertEqual(differences({(name, limits[name]["default"]) for name in watched}, told), NOTHING)
        self.assertEqual(differences(limits, [*watched, "energy_error", "courant_number", "sampled_every"]), NOTHING)

    def test_that_are_sampled_are_those_of_the_page(self):
        one = schema()["limits"]["properties"]["sampled_every"]
        told = re.search(r"^(`.*?) are sampled every (\d+)\s+steps", page("reference/monitors.md"),
                         re.MULTILINE | re.DOTALL)

        self.assertEqual(differences(names(one["description"]), names(told[1])), NOTHING)
        self.assertEqual(one["default"], int(told[2]))

    def test_say_what_the_page_says(self):
        first_words = page("reference/monitors.md").split("\n\n")[1]

        self.assertEqual(differences({key for one in self.watched()[0].values() for key in one},
                                     set(keys(first_words)) - {"monitors"}), NOTHING)

    def test_that_are_but_counted_are_those_of_the_page(self):
        cells = next(cells for cells in rows(section(page("reference/output.md"), "summary.json"))
                     if cells[0].startswith("counts"))

        self.assertEqual(differences(self.watched()[1], keys(cells[1])), NOTHING)


class Profile(unittest.TestCase):
    def test_columns_of_the_table_are_those_of_the_page(self):
        printed = program.call(TAMP, "profile", Runs.all["ball"].folder).stdout.splitlines()[0]
        told = first_names(section(page("reference/profile.md"), "The table"))

        self.assertEqual(printed.split(), " ".join(["task", *told]).split())

    def test_columns_of_memory_are_those_of_the_page(self):
        printed = program.call(TAMP, "profile", Runs.all["ball"].folder, "--memory").stdout.split("\n\n")[1]
        told = names(section(page("reference/profile.md"), "Where memory goes").replace("\n", " "))[:3]

        self.assertEqual(sorted(printed.splitlines()[0].split()), sorted(" ".join(["label", *told]).split()))

    def test_keys_of_the_file_are_those_of_the_page(self):
        written = documents_of("profile")
        told = [name for cells in self.rows() for name in names(re.sub("`[^`]*` of a task", "", cells[0]))]
        of_tasks = [name for cells in self.rows() for name in re.findall("`([^`]*)` of a task", cells[0])]
        of_tasks += next(keys(cells[1]) for cells in self.rows() if cells[0] == "`tasks`")

        self.assertEqual(differences({key for document in written for key in document}, told), NOTHING)
        self.assertEqual(differences({key for document in written for task in document["tasks"] for key in task},
                                     of_tasks), NOTHING)

    def test_keys_of_its_objects_are_those_of_the_page(self):
        n_compared = 0
        for cells in self.rows():
            for name in set(names(cells[0])) - {"tasks", "mean_step"}:
                there = {key for document in documents_of("profile") for key in of_one(document.get(name))}
                if there:
                    n_compared += 1
                    told = keys(cells[1].split(", without")[0].split("; also in")[0])
                    with self.subTest(name):
                        self.assertEqual(differences(there, told), NOTHING)

        self.assertGreater(n_compared, 5)

    def rows(self):
        return rows(section(page("reference/profile.md"), "In files"))


def documents_of(name):
    return [files.document(run.folder / f"{name}.json") for run in Runs.all.values()]


def of_one(value):
    """The keys of an object, or of those in a list."""
    found = value if isinstance(value, list) else [value]
    return {key for one in found if isinstance(one, dict) for key in one}


class Commands(unittest.TestCase):
    ALWAYS = {"help", "version", "man"}  # said above the table

    def test_are_those_of_the_page(self):
        told = {word for cells in rows(page("reference/commands.md")) for name in names(cells[0])
                for word in re.findall(r"\btamp ([a-z]+)", name)}

        self.assertEqual(differences(set(commands()) - self.ALWAYS, told), NOTHING)

    def test_are_those_of_the_readme(self):
        told = {word for cells in rows(section(page("../README.md"), "Commands")) for name in names(cells[0])
                for word in re.findall(r"\btamp ([a-z]+)", name)}

        self.assertEqual(differences(set(commands()) - {"version"}, told), NOTHING)

    def test_take_the_options_that_pages_give_them(self):
        known = {command: options_of(command) for command in commands()}
        of_tools = FOR_USERS.keys() | RESEARCH.keys() | CHECKS.keys()
        calls = [(file.name, *call) for file in every_page() for call in calls_of(file.read_text(encoding="utf-8"))]

        self.assertGreater(len(calls), 100)
        self.assertEqual([call for call in calls if call[1] not in known and call[1] not in of_tools], [])
        self.assertEqual([(page, command, option) for page, command, given in calls if command in known
                          for option in given if option not in known[command]], [])

    def test_have_no_option_that_no_page_names(self):
        text = "\n".join(file.read_text(encoding="utf-8") for file in every_page())
        named = set(re.findall(rf"(?<![\w-]){OPTION.pattern}", text))

        self.assertEqual([(command, option) for command in commands() for option in options_of(command)
                          if option not in named], [])


def every_page():
    return [program.ROOT / "README.md", *sorted(PAGES.rglob("*.md"))]


def calls_of(text):
    """(command, its options) of each call of the program in the code of a page."""
    block = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
    blocks = "\n".join([*block.findall(text), *re.findall("^    .*", text, re.MULTILINE)])
    inline = CODE.findall(block.sub("", text).replace("\n", " "))
    for line in blocks.splitlines() + inline:
        for call in re.split(r"#|\||;|&&", line):
            found = re.search(r"(?:^|[\s/])tamp ([a-z][a-z-]*)(?=\s|$)(.*)", call)
            if found and "tools/python" not in call:
                yield found[1], re.findall(rf"(?<!\S){OPTION.pattern}", found[2])


class TheComparison(unittest.TestCase):
    """Fails both ways."""

    TEXT = "# A page\n\n## Here\n\n| key | is |\n| --- | --- |\n| `a`, `b` | `c` |\n| `BODY.d_*[m]` | |\n\n### There\n"

    def test_finds_what_is_not_told_and_what_is_not_there(self):
        told = first_names(section(self.TEXT, "Here"))

        self.assertEqual(told, ["a", "b", "BODY.d_*[m]"])
        self.assertEqual(differences(["a", "e"], told[:2]), (["e"], ["b"]))
        self.assertEqual(unmatched(["a", "b", "sand.d_x[m]"], told), NOTHING)
        self.assertEqual(unmatched(["a", "sand.d[m]", "sand.d_w[m]"], told),
                         (["sand.d[m]", "sand.d_w[m]"], ["BODY.d_*[m]", "b"]))

    def test_finds_a_row_that_the_page_has_lost_or_has_too_many(self):
        columns = {column for run in Runs.all.values() for column in run.columns()}
        text = section(page("reference/output.md"), "history.csv")
        row = next(line for line in text.splitlines() if "`lost_kinetic[J]`" in line)
        lost, added = text.replace("`lost_kinetic[J]`, ", ""), text.replace(row, row + "\n| `found[J]` | |")

        self.assertEqual(unmatched(columns, first_names(lost)), (["lost_kinetic[J]"], []))
        self.assertEqual(unmatched(columns, first_names(added)), ([], ["found[J]"]))

    def test_knows_calls_of_the_program_from_others(self):
        text = ("    mpirun -np 2 build/release/tamp run a.json --out b  # --not\n\nsee `tamp check\n a.json --json`\n"
                "```sh\ntamp plot a b c && ls --all\npython3 tools/python/tamp digests --write\n```\n")

        self.assertEqual(sorted(calls_of(text)), [("check", ["--json"]), ("plot", []), ("run", ["--out"])])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    program.add_option(parser)
    options, rest = parser.parse_known_args()
    TAMP = options.tamp.resolve()
    unittest.main(argv=[sys.argv[0], *rest])
