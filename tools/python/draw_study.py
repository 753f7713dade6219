#!/usr/bin/env python3
"""Draws a study: from FOLDER/study.json, which `tamp study` writes, FOLDER/index.html and charts/*.svg and *.png in it.

    tools/python/draw_study.py FOLDER

Debian's python3-matplotlib is used. The same study.json gives the same files, byte for byte."""

import inputs
from charts.script import folder_of_arguments, written_by_tamp


def main():
    folder = folder_of_arguments(__doc__)
    from charts import study, study_page

    with written_by_tamp(folder / "study.json"):
        study_page.write(study.read_study(folder), folder)


if __name__ == "__main__":
    inputs.run(main)
