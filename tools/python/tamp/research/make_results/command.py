"""Makes tables of results/ anew: runs the commands that write them, and renews what the index says of them.

made_by in the table's entry of results/index.json says how it comes from what its command writes. A new entry needs
file, title, command and made_by; the rest is added. Table and entry are written once the command has come to its end,
and stay as they were where it fails. A study goes on where it was stopped (--out). --from takes studies from a folder
where they have run before, if they are whole, of this program and processor, and their inputs have not changed. The
program is named by the commit that it was built of.
"""

import csv
import datetime
import fnmatch
import hashlib
import io
import json
import os
import pathlib
import tempfile

from tamp import files, program
from tamp.failure import Refusal
from tamp.research.make_results import recipe
from tamp.research.make_results.runs import Runs, commit_of, machine_of
from tamp.research.make_results.table import rows_of_file, rows_of_markdown, table


def rows_of(wanted, outputs, place):
    """The rows that commands have written, of all of them together."""
    rows = []
    for output in outputs:
        if wanted["file"] == recipe.PRINTED:
            found = rows_of_markdown(f"{place}/file", output.printed, wanted.get("at", "*"))
        else:
            found = rows_of_file(output.folder / wanted["file"], wanted.get("at"))
        rows += [{"study": output.study, **row} for row in found]
    return rows


def hashes(entry, outputs):
    """Inputs by what they are now: those that the runs name, and what the entry has named that is still there."""
    read = dict.fromkeys(path.resolve() for output in outputs for path in output.inputs)
    for path in read:
        if not path.is_relative_to(program.ROOT):
            raise Refusal(path, "an input from elsewhere", f"one below {program.ROOT}, so that the index can name it")
    names = [path.relative_to(program.ROOT).as_posix() for path in read]
    names += [name for name in entry.get("inputs", {}) if (program.ROOT / name).is_file()]
    return {name: hashlib.sha256(files.content(program.ROOT / name)).hexdigest() for name in dict.fromkeys(names)}


def compared(before, now):
    """In words, what is different from the table that was there."""
    if before[:1] != now[:1]:
        return "other columns than before" if before else "a new table"
    n_other = sum(a != b for one, other in zip(before, now) for a, b in zip(one, other))
    return f"{n_other} cells differ" + (f", {len(before) - 1} rows before" if len(before) != len(now) else "")


def write(folder, renewed, made):
    """Puts the table and its entry in place of those that are there."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(made)
    entries = files.document(folder / "index.json")  # which may have changed while the command ran
    entries = [{**entry, **renewed} if entry["file"] == renewed["file"] else entry for entry in entries]
    new = {folder / renewed["file"]: text.getvalue(), folder / "index.json": json.dumps(entries, indent=2) + "\n"}
    asides = {path: path.with_name(path.name + ".new") for path in new}
    try:
        for path, aside in asides.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            aside.write_text(new[path], encoding="utf-8")
        for path, aside in asides.items():
            os.replace(aside, path)
    finally:
        for aside in asides.values():
            aside.unlink(missing_ok=True)


def chosen(entries, names, index):
    """(place, entry, recipe) of the tables that are named."""
    if not isinstance(entries, list) or not all(isinstance(entry, dict) and "file" in entry for entry in entries):
        raise Refusal(index, "no list of results, or one without a file", "an index in which `results` finds no fault")
    found = {}
    for name in names:
        fitting = {k: entry for k, entry in enumerate(entries) if fnmatch.fnmatchcase(entry["file"], name)}
        made = {k: entry for k, entry in fitting.items() if "made_by" in entry}
        if not made:
            raise Refusal(index, f"{name} was collected by hand" if fitting else f"no {name}", "a table with made_by")
        found |= made
    faults = [f"{k}{fault}" for k, entry in found.items() for fault in recipe.faults(entry, entries)]
    if faults:
        raise Refusal(f"{index}#/{faults[0]}")
    return [(f"{index}#/{k}/made_by", found[k], recipe.recipe_of(found[k], entries)) for k in sorted(found)]


def add_arguments(parser):
    parser.add_argument("names", nargs="+", metavar="NAME",
                        help="a file in results, such as verification/bar.csv; * in it stands for any text")
    parser.add_argument("--from", dest="kept", type=pathlib.Path, metavar="FOLDER",
                        help="of a study that has run, or one that holds such folders")
    parser.add_argument("--out", type=pathlib.Path, default=program.ROOT / "runs/results", metavar="FOLDER",
                        help="where studies are run (runs/results)")
    parser.add_argument("--results", type=pathlib.Path, default=program.ROOT / "results", metavar="FOLDER",
                        help="where the tables are (results)")
    program.add_option(parser)


def main(options):
    index = options.results / "index.json"
    tables = chosen(files.document(index), options.names, index)
    machine = machine_of(options.tamp.resolve())
    now = {"program": commit_of(options.tamp, machine), "date": datetime.date.today().isoformat(),
           "processor": f"{machine['processor']}, {machine['cores']} cores", "instructions": machine["instruction_set"]}
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(options, pathlib.Path(folder))
        for place, entry, wanted in tables:
            outputs = [runs.output(words) for words in recipe.commands(entry)]
            names, rows = table(wanted, rows_of(wanted, outputs, place), place)
            file = options.results / entry["file"]
            before = list(csv.reader(io.StringIO(files.text(file), newline=""))) if file.exists() else []
            write(options.results, {"file": entry["file"], **now, "inputs": hashes(entry, outputs)}, [names, *rows])
            print(f"{entry['file']}: {len(rows)} rows; {compared(before, [names, *rows])}")
            if "note" in entry:
                print(f"  its note is as it was: {entry['note']}")
