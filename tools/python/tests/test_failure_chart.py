"""The chart of an entry of the failure catalogue, from runs that are known."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from tamp.program import ROOT

STUDY = {"title": "A bar that breaks", "points": [
    {"method": "one", "ended": "unstable", "folder": "points/1"},
    {"method": "four", "ended": "done", "folder": "points/2"}, {"method": "none", "ended": "refused", "folder": ""}]}


class FailureChart(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = pathlib.Path(self.place.name)
        for point, last in (("1", 9), ("2", 1)):
            (self.folder / "points" / point).mkdir(parents=True)
            rows = f"step,time[s],bar.depth[m]\n0,0,0\n1,0.5,0.5\n2,1,{last}\n"
            (self.folder / "points" / point / "history.csv").write_text(rows)
        self.write(STUDY)

    def write(self, study):
        (self.folder / "study.json").write_text(json.dumps(study))

    def draw(self, column, out="chart.png"):
        return subprocess.run([sys.executable, ROOT / "tools/python/tamp", "failure", self.folder, "--column", column,
                               "--out", self.folder / out], capture_output=True, text=True)

    def test_runs_are_drawn_into_a_picture(self):
        done = self.draw("bar.depth")

        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue((self.folder / "chart.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_column_that_no_run_has_is_refused_with_those_there_are(self):
        done = self.draw("bar.width")

        self.assertEqual(done.returncode, 2)
        self.assertIn("no column bar.width; expected one of time, bar.depth", done.stderr)
        self.assertFalse((self.folder / "chart.png").exists())

    def test_an_entry_without_runs_is_damaged(self):
        self.write({**STUDY, "points": STUDY["points"][2:]})

        done = self.draw("bar.depth")

        self.assertEqual(done.returncode, 4)
        self.assertIn("no runs", done.stderr)

    def test_the_study_itself_is_not_drawn_over(self):
        self.assertEqual(self.draw("bar.depth", "study.json").returncode, 2)


if __name__ == "__main__":
    unittest.main()
