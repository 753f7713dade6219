"""Check that results/ and its index agree, and list results whose inputs have changed since they were made.

results/index.json lists the tables: file, title, the command that makes it, the program (commit at which the table was
last entered) and its date, processor and instructions (AVX-512, AVX2), and inputs, which are scenes, studies, data and
tests by the SHA-256 that they had at that commit. "not stated" stands for what was not written down; a note is added
where the numbers need one. Where a command writes the table, made_by says how (`make-results`); of these tables program
is the commit that it was built of. The exit code is 1 where the index and the files do not agree.
"""

import csv
import hashlib
import pathlib
import re

from tamp import files, program
from tamp.research.make_results import recipe

FOLDER = program.ROOT / "results"
TEXTS = ["file", "title", "command", "program", "date", "processor", "instructions"]
KEYS = {*TEXTS, "inputs", "note", "made_by"}
PATTERNS = {"program": r"[0-9a-f]{12,40}", "date": r"\d{4}-\d{2}-\d{2}"}
SHA256 = re.compile(r"[0-9a-f]{64}")


def faults_of_entry(entry):
    """Faults of an entry of the index, in words."""
    if not isinstance(entry, dict):
        return ["no object"]
    found = [f'no "{key}"' for key in [*TEXTS, "inputs"] if key not in entry]
    found += [f'unknown "{key}"' for key in sorted(entry.keys() - KEYS)]
    for key in [*TEXTS, "note"]:
        value = entry.get(key, "")
        if key in entry and not (isinstance(value, str) and re.fullmatch(PATTERNS.get(key, r".*\S.*"), value)):
            found.append(f'"{key}" is {value!r}')
    inputs = entry.get("inputs", {})
    if not isinstance(inputs, dict):
        return found + ['"inputs" is no object']
    return found + [f"{path}: no SHA-256" for path, known in inputs.items() if not SHA256.fullmatch(str(known))]


def faults_of_recipe(path, entry, entries, pointer):
    """What is wrong with made_by, and whether the table has the columns that it makes."""
    found = [f"index.json#{pointer}{fault}" for fault in recipe.faults(entry, entries)]
    if found or not path.is_file():
        return found
    with open(path, encoding="utf-8", errors="replace", newline="") as file:
        heading = next(csv.reader(file), [])
    if not recipe.fits_heading(recipe.recipe_of(entry, entries), heading):
        found.append(f"index.json#{pointer}/made_by/columns: other names than {','.join(heading)}; expected those")
    return found


def faults_of_table(path):
    """Faults of a CSV, in words."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file, strict=True))
    except (csv.Error, UnicodeDecodeError) as error:
        return [f"no CSV in UTF-8: {error}"]
    if len(rows) < 2:
        return ["no rows below a heading"]
    found = [f"row {k}: {len(row)} cells instead of {len(rows[0])}" for k, row in enumerate(rows, start=1)
             if len(row) != len(rows[0])]
    return found + [f"column {k} has no name" for k, name in enumerate(rows[0], start=1) if not name.strip()] + [
        f"two columns are called {name}" for name in sorted(set(rows[0])) if rows[0].count(name) > 1]


def faults(folder):
    """Faults of a folder of results: (file, what) of each."""
    entries = files.document(folder / "index.json")
    if not isinstance(entries, list):
        return [("index.json", "no list of results")]
    found, names = [], []
    for k, entry in enumerate(entries):
        name = entry.get("file") if isinstance(entry, dict) else None
        names.append(str(name or f"index.json, entry {k}"))
        found += [(names[-1], what) for what in faults_of_entry(entry)]
        if name and "made_by" in entry:
            found += [(names[-1], what) for what in faults_of_recipe(folder / str(name), entry, entries, f"/{k}")]
    found += [(name, "twice in index.json") for name in sorted(set(names)) if names.count(name) > 1]
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()} - {"index.json"}
    found += [(name, "not in index.json") for name in sorted(there - set(names))]
    found += [(name, "no such file") for name in sorted(set(names) - there)]
    for name in sorted(there):
        if name.endswith(".csv"):
            found += [(name, what) for what in faults_of_table(folder / name)]
        elif name.endswith(".json"):
            files.document(folder / name)
        else:
            found.append((name, "neither CSV nor JSON"))
    return found


def changed_inputs(entry, root):
    """Inputs of a result that have changed since it was made."""
    def now(path):
        file = root / path
        return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else None

    return [path for path, known in entry["inputs"].items() if now(path) != known]


def add_arguments(parser):
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=FOLDER, help="default: results")


def main(options):
    found = faults(options.folder)
    for name, what in found:
        print(f"{name}: {what}")
    if found:
        return 1
    entries = files.document(options.folder / "index.json")
    stale = [(entry, changed_inputs(entry, program.ROOT)) for entry in entries]
    stale = [(entry, paths) for entry, paths in stale if paths]
    if stale:
        print("Results whose inputs have changed since:")
    for entry, paths in stale:
        more = f" and {len(paths) - 3} more" if len(paths) > 3 else ""
        print(f"  {entry['file']}, {entry['date']}, {entry['program'][:9]}: {', '.join(paths[:3])}{more}")
    n_made = sum("made_by" in entry for entry in entries)
    print(f"{n_made} are written by a command (make-results), {len(entries) - n_made} were collected by hand.")
    print(f"{len(entries)} results, {len(stale)} with inputs that have changed since.")
    return 0
