"""Draws a column of runs over another, and what was measured beside them, as SVG or PNG.

    python3 tools/python/tamp plot runs/a runs/b ball.depth ball.contact_force_y --measured test.csv --out curve.svg

Columns are those of history.csv, or of machine.csv; their units may be left out. The first two columns of the CSV are
drawn as points, or those that have the names; its heading has units, such as depth[mm],force[kN].
"""

import os
import pathlib

from tamp import files
from tamp.charts import curves
from tamp.charts.curves import Curve, Plot
from tamp.charts.formatting import counted, is_number, plain
from tamp.failure import Failure, Refusal
from tamp.plot import measured, runs

MOST_RUNS = 12  # that lines tell apart
KINDS = (".svg", ".png")
BEGINNING = 4096  # of a file, in which a picture says that it is one


def add_arguments(parser):
    parser.add_argument("runs", nargs="+", type=pathlib.Path, metavar="RUN", help="a run's folder")
    parser.add_argument("x", metavar="X", help="the column across, such as ball.depth")
    parser.add_argument("y", metavar="Y", help="the column upwards")
    parser.add_argument("--measured", type=pathlib.Path, metavar="CSV", help="points to draw beside")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="FILE", help="the picture, .svg or .png")


def main(options):
    if options.out.suffix not in KINDS:
        raise Refusal("--out", options.out, f"a name that ends in {' or '.join(KINDS)}")
    if len(options.runs) > MOST_RUNS:
        raise Refusal("RUN", f"{len(options.runs)} runs", f"at most {MOST_RUNS}, which lines can tell apart")
    its_runs = runs.read_runs(options.runs, [options.x, options.y])
    plot = plot_of(its_runs, options)
    check_out(options, its_runs)
    write(options.out, curves.content(plot, options.out.suffix))


def plot_of(its_runs, options):
    along, up = (runs.columns_of(its_runs, word) for word in (options.x, options.y))
    x, y = along[0], up[0]
    lines = [Curve(plain(name_of(run, (x, y))), *known(run, *columns)) for run, *columns in zip(its_runs, along, up)]
    if options.measured:
        points = measured.read(options.measured, (x, y))
        lines.append(Curve(plain(options.measured.name), *points, is_measured=True))
    return Plot(plain(x.name), x.unit, plain(y.name), y.unit, lines)


def name_of(run, columns):
    """Which says so where a force is that on a half or a quarter."""
    n_parts = runs.part_of_whole(run) if any(column.unit in runs.OF_THE_PART for column in columns) else 1
    return run.name if n_parts == 1 else f"{run.name} (1/{n_parts} of the whole)"


def known(run, x, y):
    """Without what is no number, such as the depth of a body that has left the domain."""
    pairs = [pair for pair in zip(x.values, y.values) if all(map(is_number, pair))]
    if not pairs:
        n_rows = counted(len(run.history.rows), "row")
        raise Refusal(run.history.path, f"{n_rows}, and none with numbers of {x.name} and {y.name}",
                      "a run that has written some")
    return [list(values) for values in zip(*pairs)]


def check_out(options, its_runs):
    """Check that the picture replaces no file that is read, and no file but a picture."""
    read = [options.measured] if options.measured else []
    for run in its_runs:
        read += [run.history.path, run.folder / "machine.csv", run.folder / "summary.json"]
    files.keep_inputs(read, [options.out])
    if not options.out.parent.is_dir():
        raise Failure(options.out.parent, "no such folder", "a place to write to")
    if os.path.exists(options.out) and not is_picture(options.out):
        raise Refusal(options.out, "holds something else than a picture", "another file to write to")


def is_picture(path):
    size = files.check_file(path)
    with open(path, "rb") as stream:
        beginning = stream.read(BEGINNING)
    return size == 0 or beginning.startswith(b"\x89PNG\r\n") or b"<svg" in beginning


def write(path, content):
    """Whole or not at all; a link stays one."""
    target = path.resolve()
    part = target.with_name(target.name + ".part")
    try:
        part.write_bytes(content)
        os.replace(part, target)
    finally:
        part.unlink(missing_ok=True)
