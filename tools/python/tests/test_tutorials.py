"""What the tutorials say is typed can be typed, and what they say comes out does.

    cd tools/python; python3 -m tests.test_tutorials [--tamp build/release/tamp]
    python3 -m tests.test_tutorials --write FOLDER    # every run to its end; results/tutorials and their pictures anew

Blocks of a page that are marked ```sh are run in their order, in a scratch folder with `inputs` and the program. A run
ends after 20 steps, but for those `IN_FULL`. The block ```text that follows has beginnings of lines that they print,
with numbers to 2 %. Rows of results/tutorials/PAGE.csv, one for a run, stand in the page as they are.
"""

import argparse
import csv
import functools
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from tamp import files, markdown, program

PAGES = program.ROOT / "docs/tutorials"
TABLES = program.ROOT / "results/tutorials"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
REMEMBERED = re.compile(r"export |[A-Z]+=")  # lines of a shell that later commands go by
SHORT, WHOLE = " --steps 20 --quiet", " --threads 1"  # how runs are made: other tests may use the cores
TAMP = program.USUAL

# Runs of a few seconds.
IN_FULL = {"tamp run ball.json", "tamp run inputs/punch/quick.json --force --out runs/quick"}
NAMES_IN_FULL = {"round", "whole", "half", "large", "small"}


class Scratch:
    """A folder in which the commands of a page are run."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        (self.folder / "inputs").symlink_to(program.INPUTS)
        (self.folder / "build/release").mkdir(parents=True)
        (self.folder / "build/release/tamp").symlink_to(TAMP)
        self.remembered = []

    def run(self, command):
        """The output of a command, and its exit code."""
        if REMEMBERED.match(command):
            self.remembered.append(command)
        script = "\n".join([*self.remembered, command])
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=program.ENVIRONMENT, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.stdout, done.returncode


def blocks(page):
    return BLOCK.findall((PAGES / f"{page}.md").read_text(encoding="utf-8"))


def commands(block):
    return [line for line in block.splitlines() if line.strip()]


def name_of_run(command):
    out = re.search(r"--out runs/(\w+)", command)
    return out[1] if out else pathlib.Path(command.split()[2]).stem


@functools.cache
def is_optimised():
    return "Release" in subprocess.run([TAMP, "--version"], capture_output=True, text=True).stdout


def is_run(command):
    return command.startswith("tamp run ") and "||" not in command


def is_in_full(command):
    return is_optimised() and (command in IN_FULL or name_of_run(command) in NAMES_IN_FULL)


def as_tested(command):
    if not is_run(command):
        return command
    return command + (WHOLE if is_in_full(command) else SHORT)


def is_near(found, told):
    return abs(float(found) - float(told)) <= 0.02 * abs(float(told))


def begins_with(line, beginning):
    """Whether a line has these words at its beginning, and nearly these numbers."""
    words, numbers = NUMBER.split(beginning.rstrip()), NUMBER.findall(beginning)
    # The last number may be the beginning of a longer one in the line only if it is near it.
    found = re.match(f"({NUMBER.pattern})".join(map(re.escape, words)), line)
    return found is not None and all(map(is_near, found.groups(), numbers))


def figures(folder):
    """The entries of a run in a table: [particles, steps, and so on] by the names of columns."""
    names, rows = files.written_table(folder / "history.csv")
    summary = files.document(folder / "summary.json")
    column = {re.sub(r"\[.*", "", name): k for k, name in enumerate(names)}
    body = next(name.split(".")[0] for name in column if name.endswith(".depth"))
    up = "z" if f"{body}.velocity_z" in column else "y"
    depth, speed, force = (column[f"{body}.{name}"] for name in ("depth", f"velocity_{up}", f"contact_force_{up}"))
    particles, steps, last = summary["particles"]["total"] + summary["particles"]["lost"], summary["steps"], rows[-1]
    return {"particles": particles, "steps": steps, "updates [million]": f"{particles * steps / 1e6:.3g}",
            "to [ms]": f"{1e3 * last[column['time']]:.3g}", "depth [mm]": f"{1e3 * last[depth]:.4g}",
            "speed [m/s]": f"{abs(last[speed]):.3g}", "lost to 10 mm [mJ]": lost_energy(rows, depth, speed, 0.01),
            "greatest force [N]": f"{max(row[force] for row in rows):.3g}"}


def lost_energy(rows, depth, speed, at, mass=0.0568201):
    """The kinetic energy that the ball has lost by a depth, between rows."""
    beyond = next((k for k, row in enumerate(rows) if row[depth] >= at), None)
    if beyond is None:
        return ""
    before, after = rows[beyond - 1], rows[beyond]
    part = (at - before[depth]) / (after[depth] - before[depth])
    then = before[speed] + part * (after[speed] - before[speed])
    return f"{500 * mass * (rows[0][speed] ** 2 - then ** 2):.3g}"


def table_of(page):
    with open(TABLES / f"{page}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Tutorials(unittest.TestCase):
    def follow(self, page):
        """Runs what the page says, and compares what it shows."""
        printed, was_shortened, n_compared = "", False, 0
        with tempfile.TemporaryDirectory() as folder:
            scratch = Scratch(folder)
            for kind, block in blocks(page):
                if kind == "sh":
                    printed, was_shortened = "", False
                    for command in commands(block):
                        output, code = scratch.run(as_tested(command))
                        self.assertEqual(code, 0, f"{command}\n{output}")
                        printed += output
                        was_shortened |= is_run(command) and not is_in_full(command)
                elif kind == "text" and not was_shortened:
                    lines = printed.splitlines()
                    for told in block.splitlines():
                        self.assertTrue(any(begins_with(line, told) for line in lines), f"{told}\n{printed}")
                        n_compared += 1
            self.compare_runs(page, scratch)
        self.assertGreater(n_compared, 3)

    def compare_runs(self, page, scratch):
        """The runs that went to their end with the table of the page."""
        if not (TABLES / f"{page}.csv").exists():
            return
        n_compared = 0
        for row in table_of(page):
            folder = scratch.folder / "runs" / row["run"]
            names = {"ball": "tamp run ball.json"}
            if not is_optimised() or not (names.get(row["run"]) in IN_FULL or row["run"] in NAMES_IN_FULL):
                continue
            found = figures(folder)
            for name in {"steps", "depth [mm]"} & row.keys():
                self.assertTrue(is_near(found[name], row[name]), f"{row['run']}: {name} is {found[name]}")
            n_compared += 1
        self.assertEqual(n_compared > 0, is_optimised())

    def test_first_run(self):
        self.follow("first_run")

    def test_ball(self):
        self.follow("ball")

    def test_less(self):
        self.follow("less")


class Figures(unittest.TestCase):
    def test_tables_are_those_of_the_pages(self):
        for page in ("ball", "less"):
            text = (PAGES / f"{page}.md").read_text(encoding="utf-8").splitlines()
            rows = table_of(page)
            shown = [line for line in text if line.startswith("| `")]
            for row in rows:
                with self.subTest(page=page, run=row["run"]):
                    self.assertIn(row_of_page(row), shown)

    def test_a_line_is_compared_by_its_words_and_numbers(self):
        self.assertTrue(begins_with("ball: deepest 0.0389 m at 20 ms, now", "ball: deepest 0.03886 m at 20 ms"))
        self.assertFalse(begins_with("ball: deepest 0.0420 m at 20 ms, now", "ball: deepest 0.03886 m at 20 ms"))
        self.assertFalse(begins_with("bell: deepest 0.0389 m at 20 ms, now", "ball: deepest 0.03886 m at 20 ms"))


def row_of_page(row):
    first, *others = row.values()
    return markdown.line([f"`{first}`", *others])


def write(folder):
    """Runs the pages to their ends and writes tables and pictures."""
    pictures = {"ball": {"curve.svg": "ball-curve.svg", "sands.svg": "ball-sands.svg", "cells.svg": "ball-cells.svg"},
                "first_run": {"speeds.svg": "speeds.svg"}, "less": {}}
    for page, drawn in pictures.items():
        place = folder / page
        place.mkdir(parents=True)
        scratch = Scratch(place)
        for command in (line for kind, block in blocks(page) if kind == "sh" for line in commands(block)):
            print(command, flush=True)
            output, code = scratch.run(command)
            if code != 0:
                sys.exit(output)
        for name, kept in drawn.items():
            os.replace(scratch.folder / name, PAGES / "pictures" / kept)
        if (TABLES / f"{page}.csv").exists():
            write_table(page, scratch)


def write_table(page, scratch):
    rows = table_of(page)
    for row in rows:
        found = figures(scratch.folder / "runs" / row["run"])
        row.update({name: value for name, value in found.items() if name in row})
    with open(TABLES / f"{page}.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    markdown.print_table(rows[0].keys(), [])
    print("\n".join(map(row_of_page, rows)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    program.add_option(parser)
    parser.add_argument("--write", type=pathlib.Path, metavar="FOLDER", help="runs stay there")
    options, rest = parser.parse_known_args()
    TAMP = options.tamp.resolve()
    if options.write:
        write(options.write.resolve())
    else:
        unittest.main(argv=[sys.argv[0], *rest])
