"""The report's numbers beside ours, as numbers.md and numbers.csv."""

import csv
from typing import NamedTuple

from tamp import markdown, results
from tamp.program import MODELS

SHARES = ["0.1 % are above", "1 % are above", "5 % are above"]
HEAD = ["figure", "what", "model", "time", "unit", "report", "ours", *SHARES]
ABOUT = """# The report's numbers and ours

Where a cell has four numbers, the first is the largest of any particle, and the others are what 0.1, 1 and 5 % of the
sand (or of the part of it that is named) are above. Times are in milliseconds for the punch and microseconds for the
projectile. "Report" is what it states for Table, SVR and MLP; empty where it states nothing. Made by
`tools/python/tamp report`; numbers.csv has the same, one number a row.
"""


class Number(NamedTuple):
    figure: str
    what: str
    model: str
    time: str
    unit: str
    report: str
    ours: object  # a number or a text
    exceeded: tuple = ()


def of(run=None, time=""):
    """A function that makes numbers of one run at one time; of the sand itself without a run."""

    def number(figure, what, unit, ours, report="", exceeded=()):
        return Number(figure, what, run.name if run else "", time, unit, report, ours, exceeded)

    return number


def of_sand(runs, times, time_text):
    """(what makes numbers of a run at a time, the run, its sand then)"""
    return [(of(run, time_text(time)), run, results.particles(run.folder, "sand", time))
            for run in runs for time in times]


def text(value):
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    return f"{value:.4g}" if abs(value) < 1e4 else f"{value:.0f}"


def cells(number):
    more = [text(value) for value in number.exceeded] or ["", "", ""]
    return [*number[:6], text(number.ours), *more]


def side_by_side(numbers):
    """(figure, what, time, unit) of each row, and the numbers of the models in it."""
    rows = {}
    for number in numbers:
        key = (number.figure, number.what, number.time, number.unit)
        rows.setdefault(key, {})[number.model] = number
    return rows


def short(number):
    return " / ".join(text(value) for value in (number.ours, *number.exceeded))


def said(found):
    stated = [found[model].report for model in MODELS.values() if model in found and found[model].report]
    if len(set(stated)) == 1 and len(stated) == len(found):
        return stated[0]
    return ", ".join(f"{model} {found[model].report}" for model in MODELS.values()
                     if model in found and found[model].report)


def as_markdown(numbers):
    lines = [ABOUT, markdown.head(["figure", "what", "time", "unit", "report", *MODELS.values()])]
    for (figure, what, time, unit), found in side_by_side(numbers).items():
        if list(found) == [""]:
            ours = [short(found[""]), "", ""]
            lines.append(markdown.line([figure, what, time, unit, found[""].report, *ours]))
            continue
        ours = [short(found[model]) if model in found else "" for model in MODELS.values()]
        lines.append(markdown.line([figure, what, time, unit, said(found), *ours]))
    return "\n".join(lines) + "\n"


def write(numbers, folder):
    (folder / "numbers.md").write_text(as_markdown(numbers))
    with open(folder / "numbers.csv", "w", newline="") as file:
        csv.writer(file).writerows([HEAD, *map(cells, numbers)])
