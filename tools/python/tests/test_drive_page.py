"""What the page of a drive makes of rows that are known."""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

from tamp.charts import curve, drive_page
from tamp.files import Damage
from tamp.program import ROOT
from tests.page_tags import Tags

DRAW = [sys.executable, ROOT / "tools/python/tamp", "drive-page"]
ENTRIES = [f"F{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
NAMES = ["time[s]", *ENTRIES, "strain_v[-]", "p[Pa]", "q[Pa]"]


def row(time, p=1e5, q=0.0, **entries):
    """At a deformation gradient that is the identity but for some entries."""
    gradient = {entry: float(entry[1] == entry[2]) for entry in ENTRIES} | entries
    volume = gradient["F11"] * gradient["F22"] * gradient["F33"]
    return [time, *gradient.values(), -math.log(volume), p, q]


def triaxial():
    """From some strain of consolidation on, to a peak and back; axis 1 is axial."""
    return [row(0.0, F11=0.99), row(1.0, 2e5, 3e5, F11=0.9, F22=1.02), row(2.0, 1.5e5, 1e5, F11=0.95, F22=1.03)]


def page_of(rows, title="A <sand> & its test"):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return drive_page.whole_page(title, NAMES, rows)


def titles(rows):
    return [chart.title for chart in drive_page.charts_of(NAMES, rows)]


def abscissa(rows):
    return drive_page.abscissa({name.split("[")[0]: [one[k] for one in rows] for k, name in enumerate(NAMES)})


class ThePage(unittest.TestCase):
    def test_it_holds_four_charts_and_needs_nothing_from_elsewhere(self):
        tags = Tags(page_of(triaxial()))

        self.assertEqual(len(tags.of("figure")), 4)
        self.assertEqual(len(tags.of("svg", role="img")), 8)  # each for wide and for narrow pages
        self.assertEqual((tags.wrong, tags.open), ([], []))
        self.assertTrue(all(source.startswith(("#", "data:")) for source in tags.sources()))
        ids = [a["id"] for _, a in tags.found if "id" in a]
        self.assertEqual(len(ids), len(set(ids)))

    def test_it_holds_the_rows(self):
        data = json.loads(re.search('<script type="application/json" id="rows">(.*?)</script>', page_of(triaxial()))[1])

        self.assertEqual(data, {"columns": NAMES, "rows": triaxial()})

    def test_it_takes_no_text_for_markup(self):
        self.assertIn("A &lt;sand&gt; &amp; its test", page_of(triaxial()))
        self.assertNotIn("</script", drive_page.as_json({"columns": ["</script>"]}))

    def test_what_is_no_table_of_a_drive_is_damaged(self):
        for names, rows, error in [(NAMES, [], Damage), (NAMES[:-1], [triaxial()[0][:-1]], KeyError),
                                   (NAMES, [row(0.0, p=math.nan)], ValueError)]:
            with self.assertRaises(error):
                drive_page.whole_page("sand", names, rows)


class TheCurves(unittest.TestCase):
    def test_they_are_those_of_a_laboratory_test(self):
        self.assertEqual(titles(triaxial()), ["q over axial shortening", "Volumetric strain over axial shortening",
                                              "q over p", "p over volumetric strain"])

    def test_strains_are_counted_from_the_first_row(self):
        along = abscissa(triaxial())

        self.assertEqual(along.values[0], 0)
        self.assertAlmostEqual(along.values[1], math.log(0.99 / 0.9))

    def test_simple_shear_stands_over_the_shear_displacement_by_the_first_height(self):
        for entry, height in [("F12", "F22"), ("F21", "F11")]:
            along = abscissa([row(0.0, **{height: 0.8}), row(1.0, **{height: 0.79, entry: 0.2})])
            self.assertEqual(along.label, f"shear displacement over height, {entry}")
            self.assertAlmostEqual(along.values[1], 0.25)

    def test_time_stands_in_for_a_strain_where_none_changes_or_axes_turn(self):
        across = [row(0.0), row(1.0, F22=0.9)]
        turned = [row(0.0), row(1.0, F11=0.8, F12=-0.6, F21=0.6, F22=0.8)]

        self.assertEqual([abscissa(across).name, abscissa(turned).name], ["time", "time"])

    def test_no_volume_change_but_round_off_is_none(self):
        rows = [[*one[:10], 1e-15 * k, *one[11:]] for k, one in enumerate(triaxial())]

        chart = drive_page.charts_of(NAMES, rows)[1]

        self.assertEqual(chart.caption, "Constant volumetric strain: 0 %.")

    def test_turns_of_both_quantities_are_drawn(self):
        y = [math.sin(0.01 * k) for k in range(5000)]
        x = [math.cos(0.017 * k) for k in range(5000)]

        kept = curve.corners(x, y)

        self.assertLess(len(kept), 1000)
        self.assertEqual({min(x), max(x), x[0], x[-1]} - {x[k] for k in kept}, set())
        self.assertEqual({min(y), max(y)} - {y[k] for k in kept}, set())

    def test_the_largest_stress_is_told(self):
        self.assertEqual(drive_page.charts_of(NAMES, triaxial())[2].caption, "Largest q: 300 kPa, at p 200 kPa.")

    def test_a_single_row_is_drawn(self):
        self.assertEqual(len(titles([row(0.0, p=0.0)])), 4)


class TheCommand(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.rows, self.page = pathlib.Path(holder.name, "rows.csv"), pathlib.Path(holder.name, "page.html")
        lines = [",".join(NAMES), *(",".join(map(str, one)) for one in triaxial())]
        self.rows.write_text("\n".join(lines) + "\n")

    def draw(self, page):
        return subprocess.run([*DRAW, self.rows, page], capture_output=True, text=True)

    def test_the_same_rows_give_the_same_page(self):
        pages = []
        for _ in range(2):
            self.assertEqual(self.draw(self.page).returncode, 0)
            pages.append(self.page.read_bytes())

        self.assertEqual(pages[0], pages[1])

    def test_the_rows_are_not_written_over(self):
        done = self.draw(self.rows)

        self.assertEqual(done.returncode, 2)
        self.assertIn("rows.csv: an input; expected another file to write to", done.stderr)

    def test_rows_without_stress_are_told_in_a_line(self):
        self.rows.write_text("time[s]\n0\n")

        done = self.draw(self.page)

        self.assertEqual(done.returncode, 4)
        self.assertIn("rows.csv: damaged: no ", done.stderr)
        self.assertFalse(self.page.exists())
