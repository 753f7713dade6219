"""How files are read: whole, or refused with the line that is wrong."""

import contextlib
import csv
import io
import json
import math
import os
import pathlib
import re
import stat

from tamp.failure import Failure, Refusal, say

MOST_BYTES = 2**30
# No thousands, no decimal commas, and no 0333, which is what is left of 12,0333.
NUMBER = re.compile(r"[-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?")

NO_NUMBER = {"": math.nan, "nan": math.nan, "-nan": math.nan, "inf": math.inf, "-inf": -math.inf}


def number(text):
    """None where a text is no finite number."""
    value = float(text) if NUMBER.fullmatch(text) else math.nan
    return value if math.isfinite(value) else None


def check_file(path):
    """Check that a file is there and can be read. Returns its size."""
    try:
        status = os.stat(path)
        if not stat.S_ISREG(status.st_mode):
            raise Refusal(path, "a folder, a pipe or a device", "a file")
        with open(path, "rb"):
            return status.st_size
    except (FileNotFoundError, NotADirectoryError):
        raise Refusal(path, "no such file") from None
    except OSError as error:
        raise Failure(path, error.strerror, "a file that can be read") from None


def content(path):
    """The bytes of a file that must be there."""
    size = check_file(path)
    if size > MOST_BYTES:
        raise Refusal(path, f"{size} bytes", f"at most {MOST_BYTES}")
    try:
        return pathlib.Path(path).read_bytes()
    except OSError as error:
        raise Failure(path, error.strerror, "a file that can be read") from None


def text(path):
    data = content(path)
    if b"\0" in data:
        raise Refusal(path, "zero bytes, as in UTF-16 or a spreadsheet", "text in UTF-8")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        say(f"{path}:{line}: warning: no UTF-8; read as Latin-1")
        return data.decode("latin-1")


def rows(path):
    """(line, cells) of each line of a CSV with commas or semicolons. Blank lines and remarks have no cells."""
    return rows_of(path, text(path))


def rows_of(path, words):
    """The same of a text, which may be the beginning of a file."""
    lines = list(io.StringIO(words, newline=None))
    is_remark = [line.lstrip().startswith("#") for line in lines]
    delimiter = ";" if any(";" in line for line, remark in zip(lines, is_remark) if not remark) else ","
    made = []
    for i, (line, remark) in enumerate(zip(lines, is_remark), start=1):
        try:
            reader = csv.reader([line.rstrip("\n")], delimiter=delimiter, strict=True)
            cells = [] if remark else next(reader, [])
        except csv.Error as error:
            raise Refusal(f"{path}:{i}", error, "a row of CSV") from None
        cells = [cell.strip() for cell in cells]
        while cells and not cells[-1]:
            cells.pop()
        made.append((i, cells))
    return made


def row_of_numbers(place, cells, n):
    if len(cells) != n:
        raise Refusal(place, f"{len(cells)} values", f"{n}")
    values = [number(cell) for cell in cells]
    for cell, value in zip(cells, values):
        if value is None:
            raise Refusal(place, f'"{cell}"',
                          "a finite number, with a point for decimals and nothing between thousands")
    return values


def table(path, columns):
    """Rows of numbers in the order of `columns`, which are the names in the file's heading."""
    found = [(line, cells) for line, cells in rows(path) if cells]
    if not found or sorted(found[0][1]) != sorted(columns):
        heading = "columns " + ",".join(found[0][1]) if found else "no heading"
        raise Refusal(f"{path}:{found[0][0] if found else 1}", heading, ",".join(columns))
    order = [found[0][1].index(name) for name in columns]
    numbers = [row_of_numbers(f"{path}:{line}", cells, len(columns)) for line, cells in found[1:]]
    if not numbers:
        raise Refusal(path, "a heading alone", "rows of numbers")
    return [[row[k] for k in order] for row in numbers]


def written_table(path):
    """(names, rows) of a CSV that TAMP has written, nan where a number is missing."""
    found = [(line, cells) for line, cells in rows(path) if cells]
    if not found:
        raise Failure(path, "no heading", "what TAMP has written")
    names, numbers = found[0][1], []
    for line, cells in found[1:]:
        values = [NO_NUMBER.get(cell, number(cell)) for cell in cells]
        if None in values or len(values) > len(names):
            raise Failure(f"{path}:{line}", ",".join(cells), f"{len(names)} numbers, as TAMP has written them")
        numbers.append(values + [math.nan] * (len(names) - len(values)))
    return names, numbers


def document(path):
    """The content of a JSON file."""
    try:
        return json.loads(text(path))
    except json.JSONDecodeError as error:
        raise Refusal(f"{path}:{error.lineno}", error.msg, "JSON") from None
    except (ValueError, RecursionError):  # a number of too many digits, too many brackets
        raise Refusal(path, "numbers too long or brackets too deep", "JSON") from None


class Damage(ValueError):
    """A fault of a file of TAMP's own, in words."""


def words_of(error):
    """The fault of a file in words, from the error in reading it: Python's own words are of no help to a reader."""
    if isinstance(error, Damage):
        return str(error)
    if isinstance(error, KeyError):
        return f'no "{error.args[0]}"'
    if isinstance(error, IndexError):
        return "a list that is too short"
    return "a value of another kind" if isinstance(error, (AttributeError, TypeError)) else "a value that cannot be"


@contextlib.contextmanager
def written_by_tamp(path):
    """A context for work with a file of TAMP's own, which may be damaged."""
    try:
        yield
    except Failure:
        raise
    except Refusal as refusal:
        raise Failure(refusal) from None
    except (ArithmeticError, AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise Failure(path, f"damaged: {words_of(error)}", "what TAMP has written") from None


def keep_inputs(sources, outputs):
    """Refuses to write over what is read, and to write two things to one file."""
    for k, output in enumerate(outputs):
        others = [(path, "an input") for path in sources] + [(path, "an output, too") for path in outputs[:k]]
        for other, what in others:
            same = os.path.abspath(output) == os.path.abspath(other)
            if same or os.path.exists(output) and os.path.exists(other) and os.path.samefile(output, other):
                raise Refusal(output, what, "another file to write to")


def write_table(path, remarks, header, rows, digits=10):
    """A CSV of numbers, with remarks above it."""
    lines = [*(f"# {remark}" for remark in remarks), header]
    lines += [",".join(f"{number:.{digits}g}" for number in row) for row in rows]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
