"""Columns of what runs have written, history.csv and machine.csv, by the names that a person gives them."""

import difflib
import math
import os
import pathlib
from typing import NamedTuple

from tamp import files
from tamp.failure import Failure, Refusal, say

N_NEAR = 3
LEAST_PART = 3  # letters that tell a part of a name
# Units of the quantities of which half a scene has half (docs/reference/output.md).
OF_THE_PART = {"N", "N m", "N s", "J", "kg", "particles"}


class Table(NamedTuple):
    path: pathlib.Path
    names: list  # with units
    rows: list


class Column(NamedTuple):
    name: str
    unit: str
    values: list


class Run(NamedTuple):
    name: str  # among those that are drawn with it
    folder: pathlib.Path
    history: Table
    machine: Table  # None where there is none, or nobody asks for it


def split(name):
    """(`ball.depth`, `m`) of `ball.depth[m]`."""
    plain, bracket, unit = name.partition("[")
    return plain, unit.removesuffix("]") if bracket else ""


def read_runs(folders, words):
    names = names_of(folders)
    return [read_run(name, folder, words) for name, folder in zip(names, folders)]


def names_of(folders):
    """The names of the folders, with what stands before them where two have the same."""
    places = [folder.resolve() for folder in folders]
    for k, place in enumerate(places):
        if place in places[:k]:
            raise Refusal(folders[k], "given twice", "each run once")
    short = [place.name for place in places]
    return [str(folder) if short.count(name) > 1 else name for folder, name in zip(folders, short)]


def read_run(name, folder, words):
    if not folder.is_dir():
        raise Refusal(folder, "a file" if folder.exists() else "no such folder", "the folder of a run")
    history = read_table(folder / "history.csv")
    path = folder / "machine.csv"
    is_needed = any(index_of(history, word) is None for word in words) and os.path.exists(path)
    return Run(name, folder, history, read_table(path) if is_needed else None)


def read_table(path):
    """The table of a run so far. A line that has no end is being written, or was when the run was killed."""
    files.check_file(path)
    with files.written_by_tamp(path):
        text = files.text(path)
        end = text.rfind("\n") + 1
        found = [(line, cells) for line, cells in files.rows_of(path, text[:end]) if cells]
    if text[end:]:
        n_lines = text.count("\n")
        say(f"{path}:{n_lines + 1}: warning: cut off, and left out")
    if not found:
        raise Failure(path, "no heading", "what TAMP has written")
    names = found[0][1]
    return Table(path, names, [row(f"{path}:{line}", cells, len(names)) for line, cells in found[1:]])


def row(place, cells, n):
    if len(cells) != n:
        raise Failure(place, f"{len(cells)} values", f"{n}, as TAMP has written them")
    values = [files.NO_NUMBER.get(cell, files.number(cell)) for cell in cells]
    if None in values:
        raise Failure(place, f'"{cells[values.index(None)]}"', "a number, as TAMP has written it")
    return values


def index_of(table, word):
    """None where no column has that name, with or without its unit."""
    return next((k for k, name in enumerate(table.names) if word in (name, split(name)[0])), None)


def columns_of(runs, word):
    """The column of that name of each run, all in the same unit."""
    found = [column_of(run, word) for run in runs]
    if None in found:
        lacking = runs[found.index(None)]
        having = [run for run, column in zip(runs, found) if column]
        which = f", which {having[0].folder} has" if having else ""
        raise Refusal(f"{lacking.history.path}:1", f"no column {word}{which}", expected(lacking, word))
    for run, column in zip(runs, found):
        if column.unit != found[0].unit:
            raise Refusal(f"{run.history.path}:1", f"{column.name} in {column.unit}",
                          f"{found[0].unit}, as in {runs[0].folder}")
    return found


def column_of(run, word):
    k = index_of(run.history, word)
    if k is not None:
        return Column(*split(run.history.names[k]), [one[k] for one in run.history.rows])
    k = index_of(run.machine, word) if run.machine else None
    if k is None:
        return None
    by_step = dict(zip(steps(run.machine), (one[k] for one in run.machine.rows)))
    return Column(*split(run.machine.names[k]), [by_step.get(step, math.nan) for step in steps(run.history)])


def steps(table):
    k = index_of(table, "step")
    if k is None:
        raise Failure(f"{table.path}:1", "no column step", "what TAMP has written")
    return [one[k] for one in table.rows]


def expected(run, word):
    """The nearest names, or all."""
    names = run.history.names + (run.machine.names if run.machine else [])
    plain = list(dict.fromkeys(split(name)[0] for name in names))
    if split(word)[0] in plain:  # with another unit
        return names[[split(name)[0] for name in names].index(split(word)[0])]
    near = with_part(word, plain)[:N_NEAR] or difflib.get_close_matches(word, plain, N_NEAR, 0.5)
    return f"one of its columns, such as {' or '.join(near)}" if near else f"one of {', '.join(plain)}"


def with_part(word, names):
    """Names in which a word stands: `ball.contact_force_y` for `force`."""
    return [name for name in names if word in name] if len(word) >= LEAST_PART else []


def part_of_whole(run):
    """How many times as much the whole is of which a run's scene is a part; 1 where the run does not say."""
    path = run.folder / "summary.json"
    if not os.path.exists(path):
        return 1
    with files.written_by_tamp(path):
        return int(files.document(path).get("part_of_whole", {}).get("factor", 1))
