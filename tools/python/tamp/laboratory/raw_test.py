"""A laboratory's file of one test: every row is read, named as a heading, or refused."""

import re
from typing import NamedTuple

from tamp import files
from tamp.failure import Refusal

STRAINS = {"percent": 100, "fraction": 1}  # divisors, as 3 / 100 is the double next to 0.03 and 3 * 0.01 is not
PRESSURES = {"Pa": 1, "kPa": 1e3, "MPa": 1e6}
COLUMNS = "strain in column 1, pressure in column 2"

NUMBER_LIKE = re.compile(r"[-+]?(nan|inf(inity)?)|[^A-Za-z]*[0-9][^A-Za-z]*([eE][^A-Za-z]*)?", re.IGNORECASE)
PRESSURE_UNIT = re.compile(r"\b([kMG]?)Pa\b")


class RawTest(NamedTuple):
    path: object
    lines: list  # of the rows, in the file
    rows: list  # (strain, pressure [Pa])


def read(path, strain_unit, pressure_unit):
    rows = files.rows(path)
    filled = [(line, cells) for line, cells in rows if cells]
    n_headings = next((i for i, (_, cells) in enumerate(filled) if not is_heading(cells)), len(filled))
    headings, data = filled[:n_headings], filled[n_headings:]
    if not data:
        found = f'no row of numbers, but "{",".join(filled[0][1])}"' if filled else "no row"
        raise Refusal(path, found, COLUMNS)
    check_names(path, headings, data[0], strain_unit, pressure_unit)

    points = []
    for line, cells in data:
        strain, pressure = values(f"{path}:{line}", cells, data[0])
        points.append((strain / STRAINS[strain_unit], pressure * PRESSURES[pressure_unit]))
    say_rows(path, len(points), headings, len(rows) - len(filled))
    return RawTest(path, [line for line, _ in data], points)


def is_heading(cells):
    """A text first, or texts alone; nan and numbers that are written in another way are none."""
    if NUMBER_LIKE.fullmatch(cells[0]):
        return False
    return bool(cells[0]) or not any(NUMBER_LIKE.fullmatch(cell) for cell in cells[:2])


def values(place, cells, first):
    """Strain and pressure of a row, which is as long as the first one."""
    first_line, first_cells = first
    if len(cells) != len(first_cells):
        raise Refusal(place, f"{len(cells)} values", f"{len(first_cells)}, as in line {first_line}")
    if len(cells) < 2:
        raise Refusal(place, f'"{cells[0]}" alone', f"{COLUMNS}, with a comma or a semicolon between")
    return files.row_of_numbers(place, cells[:2], 2)


def check_names(path, headings, first, strain_unit, pressure_unit):
    """Check that the headings agree with the numbers below them, and with the units asked for."""
    named = [(line, cells) for line, cells in headings if len(cells) > 1]
    if named and len(first[1]) not in [len(cells) for _, cells in named]:
        raise Refusal(f"{path}:{first[0]}", f"{len(first[1])} values (decimal commas?)",
                      f"{len(named[-1][1])}, as line {named[-1][0]} has names")
    for line, (strain, pressure, *_) in named:
        unit = PRESSURE_UNIT.search(pressure)
        if PRESSURE_UNIT.search(strain) or "strain" in pressure.lower() or "%" in pressure:
            raise Refusal(f"{path}:{line}", f'columns "{strain}", "{pressure}"', COLUMNS)
        if unit and unit[0] != pressure_unit:
            raise Refusal(f"{path}:{line}", f'"{pressure}" with --pressure {pressure_unit}', "the same unit")
        if "%" in strain and strain_unit != "percent":
            raise Refusal(f"{path}:{line}", f'"{strain}" with --strain {strain_unit}', "the same unit")


def say_rows(path, n, headings, n_blank):
    text = f"{path}: {n} rows of numbers"
    if headings:
        lines = ", ".join(str(line) for line, _ in headings)
        text += f"; passed over as headings: {len(headings)} (line {lines})"
    if n_blank:
        text += f"; blank or remarks: {n_blank}"
    print(text)
