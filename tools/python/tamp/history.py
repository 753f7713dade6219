"""Prints the rows of a run's history.csv nearest to some times, and where columns are largest, as Markdown tables."""

import math
import pathlib

from tamp import files
from tamp.failure import Failure, Refusal
from tamp.markdown import print_table
from tamp.options import finite


def without_unit(name):
    return name.split("[")[0]


def known(rows, column):
    """The rows that have a number there."""
    return [row for row in rows if not math.isnan(row[column])]


def add_arguments(parser):
    parser.add_argument("run", type=pathlib.Path, metavar="RUN", help="the run's folder")
    parser.add_argument("--times", type=finite, nargs="+", default=[5e-4, 1e-3, 2e-3, 2.6e-3], help="seconds")
    parser.add_argument("--columns", nargs="+", help="without their units, as punch.depth sand.p_max; by default all")


def main(options):
    path = options.run / "history.csv"
    names, rows = files.written_table(path)
    plain = [without_unit(name) for name in names]
    unknown = set(options.columns or []) - set(plain)
    if unknown:
        raise Refusal(path, f"no columns {', '.join(sorted(unknown))}", f"some of {', '.join(plain)}")
    columns = [plain.index(column) for column in options.columns or plain[1:]]
    time = plain.index("time") if "time" in plain else None
    rows = known(rows, time) if time is not None else []
    if not rows:
        raise Failure(path, "no times", "a history that TAMP has written")

    nearest = [min(rows, key=lambda r: abs(r[time] - wanted)) for wanted in options.times]
    print_table(["time[s]", *(names[c] for c in columns)],
                [[f"{row[time]:.5g}", *(f"{row[c]:.4g}" for c in columns)] for row in nearest])
    largest = {c: max(known(rows, c), key=lambda r: r[c], default=None) for c in columns}
    print_table(["column", "largest", "at time[s]"],
                [[names[c], f"{row[c]:.4g}", f"{row[time]:.5g}"] if row else [names[c], "nan", "nan"]
                 for c, row in largest.items()])
