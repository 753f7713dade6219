"""Draws how an entry of the failure catalogue fails: a column of the history of each of its methods, over time.

    build/release/tamp stability ringing_front
    python3 tools/python/tamp failure runs/stability/ringing_front --column piston.contact_force_x --out ringing.png

Runs that became unstable break off where they did. Needs Debian's
python3-matplotlib and python3-pil.
"""

import io
import pathlib

from tamp import files, results
from tamp.failure import Failure, Refusal


def add_arguments(parser):
    parser.add_argument("entry", type=pathlib.Path, metavar="FOLDER", help="the entry's, within that of tamp stability")
    parser.add_argument("--column", required=True, help="of history.csv, without its unit")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="PICTURE.png")


def unit_of(folder, column):
    names, _ = files.written_table(folder / "history.csv")
    known = dict(name.rstrip("]").split("[", 1) for name in names if "[" in name)
    if column not in known:
        raise Refusal(folder / "history.csv", f"no column {column}", f"one of {', '.join(known)}")
    return known[column]


def curve(folder, column):
    """(times, values) of a run."""
    history = results.history(folder)
    return history["time"].tolist(), history[column].tolist()


def main(options):
    from PIL import Image

    from tamp.charts import over_time, picture
    from tamp.charts.axes import WIDE

    files.keep_inputs([options.entry / "study.json"], [options.out])
    study = files.document(options.entry / "study.json")
    points = [point for point in study["points"] if point.get("folder")]
    if not points:
        raise Failure(options.entry / "study.json", "no runs", "a study that tamp stability has done")
    unit = unit_of(options.entry / points[0]["folder"], options.column)
    lines = [over_time.Line(point["method"], *curve(options.entry / point["folder"], options.column),
                            breaks_off=point["ended"] == "unstable") for point in points]
    plot = over_time.Plot(study["title"], options.column, "" if unit == "-" else unit, lines)
    sheet, _ = over_time.draw(plot, WIDE)
    drawing = picture.as_picture(sheet.figure, options.out.stem, plot.title, over_time.describe(plot), png=True)
    Image.open(io.BytesIO(drawing.png)).convert("RGB").quantize(32).save(options.out, optimize=True)
