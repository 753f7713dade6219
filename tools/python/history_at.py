"""Prints the rows of a run's history.csv nearest to some times, and where columns are largest, as Markdown tables:

    python3 tools/python/history_at.py runs/table --times 0.5e-3 1e-3 2e-3 --columns punch.depth sand.p_max
"""

import argparse
import math
import pathlib

import inputs


def without_unit(name):
    return name.split("[")[0]


def known(rows, column):
    """The rows that have a number there."""
    return [row for row in rows if not math.isnan(row[column])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    time_type = inputs.checked_number(float, lambda _: True, "time")
    parser.add_argument("run", type=pathlib.Path, help="the run's folder")
    parser.add_argument("--times", type=time_type, nargs="+", default=[5e-4, 1e-3, 2e-3, 2.6e-3], help="seconds")
    parser.add_argument("--columns", nargs="+", help="without their units; by default all")
    options = parser.parse_args()

    path = options.run / "history.csv"
    names, rows = inputs.written_table(path)
    plain = [without_unit(name) for name in names]
    unknown = set(options.columns or []) - set(plain)
    if unknown:
        parser.error(f"no such columns: {', '.join(sorted(unknown))}; there are {', '.join(plain)}")
    columns = [plain.index(column) for column in options.columns or plain[1:]]
    time = plain.index("time") if "time" in plain else None
    rows = known(rows, time) if time is not None else []
    if not rows:
        raise inputs.Failure(path, "no times", "a history that TAMP has written")

    print("| time[s] | " + " | ".join(names[c] for c in columns) + " |")
    print("| ---" * (len(columns) + 1) + " |")
    for wanted in options.times:
        row = min(rows, key=lambda r: abs(r[time] - wanted))
        print(f"| {row[time]:.5g} | " + " | ".join(f"{row[c]:.4g}" for c in columns) + " |")
    print("\n| column | largest | at time[s] |\n| --- | --- | --- |")
    for c in columns:
        row = max(known(rows, c), key=lambda r: r[c], default=None)
        print(f"| {names[c]} | {row[c]:.4g} | {row[time]:.5g} |" if row else f"| {names[c]} | nan | nan |")


if __name__ == "__main__":
    inputs.run(main)
