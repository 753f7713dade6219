"""Two columns of a measured CSV, in the units of those that they are drawn beside."""

import re

from tamp import files
from tamp.failure import Refusal
from tamp.plot.units import power_between, scaled

NAME = re.compile(r"(?P<name>[^\[\]()]*?)\s*(\[(?P<unit>[^\[\]]*)\]|\((?P<other>[^()]*)\))")
EXAMPLE = "names with units, such as depth[mm],force[kN]"


def read(path, wanted):
    """The values of the columns that go with two columns of runs, each a list."""
    found = [(line, cells) for line, cells in files.rows(path) if cells]
    if not found:
        raise Refusal(path, "no heading", EXAMPLE)
    line, heading = found[0]
    chosen = chosen_columns(f"{path}:{line}", heading, wanted)
    powers = [power_of(f"{path}:{line}", heading[k], column) for k, column in zip(chosen, wanted)]
    if not found[1:]:
        raise Refusal(f"{path}:{line}", "a heading alone", "rows of numbers")
    rows = [numbers(f"{path}:{line}", cells, len(heading), chosen) for line, cells in found[1:]]
    return [[scaled(row[k], power) for row in rows] for k, power in enumerate(powers)]


def chosen_columns(place, heading, wanted):
    """Indices of the columns with the names of the runs' columns, or else of the first two."""
    if len(heading) < 2:
        raise Refusal(place, f'"{",".join(heading)}" alone', f"two columns, {EXAMPLE}")
    plain = [parts(name)[0] for name in heading]
    named = [plain.index(column.name) if column.name in plain else None for column in wanted]
    if None not in named:
        return named
    for column, at, usual in zip(wanted, named, (0, 1)):
        if at not in (None, usual):
            raise Refusal(place, f"{column.name} in column {at + 1}",
                          f"it in column {usual + 1}, or {' and '.join(column.name for column in wanted)} by name")
    return [0, 1]


def parts(name):
    """(name, unit), which is None where there is none."""
    match = NAME.fullmatch(name)
    if not match:
        return name, None
    return match["name"], match["unit"] if match["unit"] is not None else match["other"]


def power_of(place, name, column):
    unit = parts(name)[1]
    if unit is None:
        raise Refusal(place, f'"{name}" without a unit', EXAMPLE)
    power = power_between(unit, column.unit)
    if power is None:
        raise Refusal(place, f'"{name}" beside {column.name}[{column.unit}]', "units that go into each other")
    return power


def numbers(place, cells, n, chosen):
    """Cells that are empty at the end of a row are none."""
    if not max(chosen) < len(cells) <= n:
        raise Refusal(place, f"{len(cells)} values", f"{n}, with a point for decimals")
    return files.row_of_numbers(place, [cells[k] for k in chosen], 2)
