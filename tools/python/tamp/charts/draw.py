"""Draws what `tamp study` or `tamp compare` has written into a folder.

From study.json come index.html and charts/*.svg and *.png, from compare.json comes report.html. The same JSON gives the
same files, byte for byte.
"""

import contextlib
import os
import pathlib

from tamp.charts import compare_page, study, study_page
from tamp.failure import Failure, Refusal


def add_arguments(parser):
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")


@contextlib.contextmanager
def written_by_tamp(path):
    """What is done with a file of TAMP's own, which may be damaged."""
    try:
        yield
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise Failure(path, f"damaged: {error!r}", "what TAMP has written") from None


def main(options):
    folder = options.folder
    pages = [(folder / "study.json", lambda: study_page.write(study.read_study(folder), folder)),
             (folder / "compare.json", lambda: compare_page.write(compare_page.read_comparison(folder), folder))]
    written = [(path, draw) for path, draw in pages if os.path.exists(path)]
    if not written:
        raise Refusal(folder, "neither study.json nor compare.json", "the folder of a study or a comparison")
    for path, draw in written:
        with written_by_tamp(path):
            draw()
