#!/usr/bin/env python3
"""Draws a comparison: from FOLDER/compare.json, which `tamp compare` writes, FOLDER/report.html.

    tools/python/draw_compare.py FOLDER

Debian's python3-matplotlib is used. The same compare.json gives the same page, byte for byte."""

import inputs
from charts.script import folder_of_arguments, written_by_tamp


def main():
    folder = folder_of_arguments(__doc__)
    from charts import compare_page

    with written_by_tamp(folder / "compare.json"):
        compare_page.write(compare_page.read_comparison(folder), folder)


if __name__ == "__main__":
    inputs.run(main)
