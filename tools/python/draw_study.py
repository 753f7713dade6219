#!/usr/bin/env python3
"""Draws a study: from FOLDER/study.json, which `tamp study` writes, FOLDER/index.html and charts/*.svg and *.png in it.

    tools/python/draw_study.py FOLDER

Debian's python3-matplotlib is used. The same study.json gives the same files, byte for byte."""

import argparse
import pathlib

from charts import study_page
from charts.study import read_study


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    folder = parser.parse_args().folder
    study_page.write(read_study(folder), folder)


if __name__ == "__main__":
    main()
