"""Prints the rows of a run's history.csv nearest to some times, and where columns are largest, as Markdown tables:

    python3 tools/python/history_at.py runs/table --times 0.5e-3 1e-3 2e-3 --columns punch.depth sand.p_max
"""

import argparse
import csv
import os


def read_history(folder):
    """(names with units, rows of numbers)"""
    with open(os.path.join(folder, "history.csv"), newline="") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(value) for value in row] for row in rows[1:]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="the run's folder")
    parser.add_argument("--times", type=float, nargs="+", default=[5e-4, 1e-3, 2e-3, 2.6e-3], help="seconds")
    parser.add_argument("--columns", nargs="+", help="without their units; by default all")
    options = parser.parse_args()

    names, rows = read_history(options.run)
    plain = [name.split("[")[0] for name in names]
    unknown = set(options.columns or []) - set(plain)
    if unknown:
        parser.error(f"no such columns: {', '.join(sorted(unknown))}; there are {', '.join(plain)}")
    columns = [plain.index(column) for column in options.columns or plain[1:]]
    time = plain.index("time")

    print("| time[s] | " + " | ".join(names[c] for c in columns) + " |")
    print("| ---" * (len(columns) + 1) + " |")
    for wanted in options.times:
        row = min(rows, key=lambda r: abs(r[time] - wanted))
        print(f"| {row[time]:.5g} | " + " | ".join(f"{row[c]:.4g}" for c in columns) + " |")
    print("\n| column | largest | at time[s] |\n| --- | --- | --- |")
    for c in columns:
        row = max(rows, key=lambda r: r[c])
        print(f"| {names[c]} | {row[c]:.4g} | {row[time]:.5g} |")


if __name__ == "__main__":
    main()
