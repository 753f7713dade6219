"""Draws what `tamp study`, `tamp compare` or `tamp run` has written into a folder.

From study.json come index.html and charts/*.svg and *.png, from compare.json comes report.html, and so it does from
what a run leaves: summary.json, profile.json and its histories. The same files give the same files, byte for byte.
"""

import os
import pathlib

from tamp.charts import compare_page, run_page, study, study_page
from tamp.failure import Failure, Refusal
from tamp.files import keep_inputs, written_by_tamp


def add_arguments(parser):
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")


def main(options):
    folder = options.folder
    pages = [(folder / "study.json", lambda: study_page.write(study.read_study(folder), folder)),
             (folder / "compare.json", lambda: compare_page.write(compare_page.read_comparison(folder), folder)),
             (folder / "profile.json", lambda: run_page.write(run_page.read_run(folder), folder))]
    written = [(path, draw) for path, draw in pages if os.path.exists(path)]
    if not written:
        raise Refusal(folder, "no study.json, compare.json or profile.json", "the folder of a study, comparison or run")
    check_places(folder)
    for path, draw in written:
        with written_by_tamp(path):
            draw()


def check_places(folder):
    """Check that pages and charts are no links to what they are drawn from, nor pipes, which wait for a reader."""
    pages = [folder / "index.html", folder / "report.html"]
    keep_inputs([path for path in folder.iterdir() if path not in pages], [*pages, *(folder / "charts").glob("*")])
    for page in pages:
        if page.exists() and not page.is_file():
            raise Failure(page, "a folder, a pipe or a device", "a place for a file")
