"""What the drawing of a study's map makes of one that is known."""

import contextlib
import pathlib
import re
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from tamp.charts import study_page
from tamp.charts.study import Study
from tests.page_tags import Tags
from tests.punch_study import study

VERDICTS = ["stable", "noisy", "blown", "blown", "refused", "stable"]
DISTANCES = [0.012, 0.15, 2.5, None, None, 0.03]


def with_map(bound=1):
    """Two rows of three steps, of the first six points; the fourth failed and the fifth was refused."""
    document = study()
    document["points"] = document["points"][:6]
    document["points"][3] |= {"ended": "unstable", "reason": "step 31, time 2 s: turned inside out", "errors": {}}
    document["points"][4] |= {"ended": "refused", "reason": "another transfer", "errors": {}}
    cells = [{"row": k // 3, "column": k % 3, "point": k + 1, "verdict": verdict, "distance": distance}
             for k, (verdict, distance) in enumerate(zip(VERDICTS, DISTANCES))]
    sheet = {"name": "Steps", "rows": "/transfer", "rows_name": "transfer", "columns": "/time/multiplier",
             "columns_name": "multiplier", "row_values": ["flip", "a_pic"], "column_values": [0.5, 1, 1.6],
             "bound": bound, "cells": cells}
    document["map"] = {"quantity": "greatest depth", "noisy": 0.1, "blown": 1, "sheets": [sheet]}
    return document


@contextlib.contextmanager
def drawn(document):
    with tempfile.TemporaryDirectory() as folder:
        study_page.write(Study(document), pathlib.Path(folder))
        yield pathlib.Path(folder)


class TheMap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = contextlib.ExitStack()
        cls.folder = cls.kept.enter_context(drawn(with_map()))
        cls.svg = (cls.folder / "charts/greatest-depth-map-1.svg").read_text()
        cls.page = (cls.folder / "index.html").read_text()

    @classmethod
    def tearDownClass(cls):
        cls.kept.close()

    def texts(self):
        return [element.text for element in ElementTree.fromstring(self.svg.encode()).iter() if element.text]

    def test_each_cell_has_the_number_that_decides(self):
        for text in ["1.2 %", "15 %", "250 %", "step 31", "–", "3 %"]:
            self.assertEqual(self.texts().count(text), 1, text)

    def test_each_run_is_a_cell_that_can_be_chosen_with_its_command(self):
        cells = sorted(int(found) for found in re.findall(r'id="greatest-depth-map-1-cell-(\d+)"', self.svg))
        chosen = {a["data-point"] for a in Tags(self.page).of("button", class_="point")}

        self.assertEqual(cells, [1, 2, 3, 4, 5, 6])
        self.assertEqual(chosen, {"1", "2", "3", "4", "5", "6"})
        self.assertIn("tamp run inputs/punch/quick.json --set /grid/cell_size=0.04", self.page)

    def test_the_bound_of_theory_stands_between_the_columns_that_it_parts(self):
        x = float(re.search(r'map-1-bound">\s*<path d="M ([\d.]+)', self.svg)[1])
        place = {text: float(re.search(rf'x="([\d.]+)"[^>]*>{text}</text>', self.svg)[1]) for text in ["1", "1\\.6"]}

        self.assertAlmostEqual(x, (place["1"] + place["1\\.6"]) / 2, delta=0.1)
        self.assertIn("bound of theory", self.svg)
        with drawn(with_map(bound=None)) as folder:
            self.assertNotIn("bound of theory", (folder / "index.html").read_text())

    def test_the_legend_counts_and_the_description_says_every_cell(self):
        for text in ["stable (2)", "noisy (1)", "blown (2)", "refused (1)"]:
            self.assertIn(text, self.texts())
        self.assertIn("6 runs: 2 stable, 1 noisy, 2 blown, 1 refused. flip: 0.5 stable, 1 noisy, 1.6 blown. "
                      "a pic: 0.5 blown, 1 refused, 1.6 stable.", self.svg)

    def test_the_table_has_the_reasons_and_the_caption_the_bars(self):
        self.assertIn("<td>a pic</td><td>0.5</td><td>blown</td><td>–</td><td>step 31, time 2 s: turned inside out</td>",
                      self.page)
        self.assertIn("An error of greatest depth counts as noisy from 10 % on and as blown from 100 % on.", self.page)

    def test_the_page_is_well_formed_and_has_no_other_chart(self):
        tags = Tags(self.page)

        self.assertEqual((tags.wrong, tags.open), ([], []))
        self.assertEqual([f.stem for f in (self.folder / "charts").glob("*.svg")], ["greatest-depth-map-1"])
        self.assertLess((self.folder / "charts/greatest-depth-map-1.png").stat().st_size, 100_000)
