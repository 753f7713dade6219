"""What a plot of runs makes of histories that are known, and what it refuses."""

import contextlib
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings
import xml.etree.ElementTree as ElementTree

from tamp.charts import curves
from tamp.charts.curves import Curve, Plot
from tamp.failure import Failure, Refusal
from tamp.plot import measured, runs, units
from tamp.plot.runs import Column
from tamp.program import ROOT

TOOLS = [sys.executable, ROOT / "tools/python/tamp", "plot"]
HEADING = "step,time[s],ball.depth[m],ball.contact_force_y[N]"
ROWS = ["0,0,0,0", "10,0.1,0.001,5", "20,0.2,0.002,nan"]
DEPTH, FORCE = Column("ball.depth", "m", []), Column("ball.contact_force_y", "N", [])


class InAFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
        return path

    def run_of(self, name="ball", heading=HEADING, rows=ROWS, **others):
        """A run's folder; other files by their names without ending."""
        self.write(f"{name}/history.csv", "\n".join([heading, *rows]) + "\n")
        for file, content in others.items():
            self.write(f"{name}/{file}.{'json' if file == 'summary' else 'csv'}", content)
        return self.folder / name

    def column(self, folder, word):
        return runs.columns_of(runs.read_runs([folder], [word]), word)[0]

    def refused(self, kind, call, *words):
        with self.assertRaises(Refusal) as ended:
            call(*words)
        self.assertIs(type(ended.exception), kind)
        return str(ended.exception).replace(f"{self.folder}/", "")

    def plot(self, *words):
        return subprocess.run([*TOOLS, *words], capture_output=True, text=True, cwd=self.folder)


class Columns(InAFolder):
    def test_they_are_found_with_and_without_their_unit(self):
        run = self.run_of()

        for word in ["ball.depth", "ball.depth[m]"]:
            self.assertEqual(self.column(run, word), Column("ball.depth", "m", [0, 0.001, 0.002]))

    def test_those_of_the_machine_stand_by_the_steps_of_the_history(self):
        run = self.run_of(machine="step,time[s],wall[s]\n10,0.1,7\n0,0,1\n")

        values = self.column(run, "wall").values

        self.assertEqual(values[:2], [1, 7])
        self.assertNotEqual(values[2], values[2])

    def test_one_that_is_not_there_is_refused_with_the_nearest_names(self):
        run = self.run_of(machine="step,time[s],wall[s]\n0,0,1\n")

        for word, said in [("ball.dept", "such as ball.depth"), ("wal", "such as wall"),
                           ("bal.depht", "such as ball.depth"),
                           ("force", "such as ball.contact_force_y"), ("depth", "such as ball.depth"),
                           ("xyz", "expected one of step, time, ball.depth, ball.contact_force_y, wall"),
                           ("ball.depth[mm]", "expected ball.depth[m]")]:
            text = self.refused(Refusal, self.column, run, word)
            self.assertTrue(text.startswith(f"ball/history.csv:1: no column {word}; "), text)
            self.assertIn(said, text)

    def test_one_that_not_all_runs_have_names_a_run_of_either_kind(self):
        folders = [self.run_of("a"), self.run_of("b", "step,time[s],block.depth[m]", ["0,0,0"])]

        text = self.refused(Refusal, runs.columns_of, runs.read_runs(folders, ["ball.depth"]), "ball.depth")

        self.assertIn("b/history.csv:1: no column ball.depth, which a has; expected one of its columns, such as block.",
                      text)

    def test_one_in_two_units_is_refused(self):
        folders = [self.run_of("a"), self.run_of("b", HEADING.replace("[m]", "[mm]"))]

        text = self.refused(Refusal, runs.columns_of, runs.read_runs(folders, ["ball.depth"]), "ball.depth")

        self.assertEqual(text, "b/history.csv:1: ball.depth in mm; expected m, as in a")


class Histories(InAFolder):
    def read(self, content):
        return runs.read_table(self.write("history.csv", content))

    def test_a_row_that_is_too_short_or_no_number_is_damage(self):
        for row, said in [("1,2", "2 values; expected 4, as"), ("1,2,3,4,5", "5 values; expected 4"),
                          ("1,2,x,4", '"x"; expected a number')]:
            text = self.refused(Failure, self.read, f"{HEADING}\n{ROWS[0]}\n{row}\n")
            self.assertTrue(text.startswith(f"history.csv:3: {said}"), text)

    def test_an_empty_one_and_one_of_zero_bytes_are_damage(self):
        self.assertEqual(self.refused(Failure, self.read, ""),
                         "history.csv: no heading; expected what TAMP has written")
        self.assertIn("zero bytes", self.refused(Failure, self.read, "\0\0\n"))

    def test_one_that_is_missing_is_no_damage(self):
        self.assertEqual(self.refused(Refusal, runs.read_table, self.folder / "history.csv"),
                         "history.csv: no such file")

    def test_a_last_line_without_an_end_is_left_out_with_a_warning(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            table = self.read(f"{HEADING}\n{ROWS[0]}\n1,2,3,4")

        self.assertEqual(len(table.rows), 1)
        self.assertIn("history.csv:3: warning: cut off, and left out", said.getvalue())

    def test_runs_are_told_apart_by_their_folders_names(self):
        folders = [self.run_of(name) for name in ["x/a", "y/a", "b"]]

        self.assertEqual([run.name for run in runs.read_runs(folders, [])], [str(folders[0]), str(folders[1]), "b"])

    def test_a_run_that_is_given_twice_is_refused(self):
        folder = self.run_of()

        text = self.refused(Refusal, runs.read_runs, [folder, folder / "../ball"], [])

        self.assertIn("given twice", text)


class Measured(InAFolder):
    def read(self, content):
        return measured.read(self.write("m.csv", content), (DEPTH, FORCE))

    def test_the_first_two_columns_are_read_into_the_units_of_the_runs(self):
        for content in ["# a test\ndepth[mm],force[kN]\n12,0.5\n20,1\n", "depth (mm),force (kN)\n12,0.5\n20,1\n",
                        "depth [mm];force [kN]\n12;0.5\n20;1\n"]:
            self.assertEqual(self.read(content), [[0.012, 0.02], [500, 1000]])

    def test_columns_with_the_names_are_found_wherever_they_stand(self):
        points = self.read("n[-],ball.contact_force_y[N],ball.depth[cm],remark[-]\n1,7,2,first\n2,8,4\n")

        self.assertEqual(points, [[0.02, 0.04], [7, 8]])

    def test_one_name_in_the_place_of_the_other_is_refused(self):
        self.assertIn("m.csv:1: ball.depth in column 2; expected it in column 1",
                      self.refused(Refusal, self.read, "force[N],ball.depth[m]\n1,2\n"))

    def test_what_has_no_unit_or_another_kind_of_unit_is_refused(self):
        for heading, said in [("depth,force[N]", '"depth" without a unit'), ("1,2", '"1" without a unit'),
                              ("depth[mm],force[MPa]", '"force[MPa]" beside ball.contact_force_y[N]'),
                              ("depth[m]", '"depth[m]" alone')]:
            text = self.refused(Refusal, self.read, f"{heading}\n1,2\n")
            self.assertTrue(text.startswith(f"m.csv:1: {said}; expected "), text)

    def test_rows_that_do_not_fit_are_refused_with_their_line(self):
        for row, said in [("1", "1 values; expected 2"), ("0,5,1,2", "4 values; expected 2"), ("1,x", '"x"')]:
            text = self.refused(Refusal, self.read, f"depth[m],force[N]\n1,2\n{row}\n")
            self.assertTrue(text.startswith(f"m.csv:3: {said}"), text)

    def test_a_heading_alone_and_an_empty_file_are_refused(self):
        self.assertIn("a heading alone", self.refused(Refusal, self.read, "depth[m],force[N]\n"))
        self.assertIn("no heading", self.refused(Refusal, self.read, "\n"))

    def test_units_of_one_kind_go_into_each_other_by_powers_of_ten(self):
        for unit, wanted, power in [("mm", "m", -3), ("kN", "N", 3), ("MPa", "kPa", 3), ("%", "-", -2),
                                    ("deg", "deg", 0), ("\u03bcm", "m", -6), ("kN", "Pa", None), ("rad", "deg", None)]:
            self.assertEqual(units.power_between(unit, wanted), power, (unit, wanted))


class ThePicture(unittest.TestCase):
    def content(self, *its_curves, suffix=".svg"):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return curves.content(Plot("ball.depth", "m", "force", "N", list(its_curves)), suffix)

    def test_it_has_a_line_for_each_run_and_points_for_what_was_measured(self):
        svg = self.content(Curve("loose <1>", [0, 0.01], [0, 5]), Curve("dense", [0, 0.02], [0, 9]),
                           Curve("test.csv", [0.01, 0.015], [4, 6], is_measured=True)).decode()

        root = ElementTree.fromstring(svg)
        self.assertEqual([f'"plot-curve-{k}"' in svg for k in range(4)], [True, True, True, False])
        texts = ["".join(element.itertext()) for element in root.iter()]
        for text in ["loose <1>", "dense", "test.csv", "force over ball.depth", "20 mm", "10 N"]:
            self.assertIn(text, texts)
        self.assertIn("test.csv, 2 measured points: ball.depth between 10 mm and 15 mm, force between 4 N and 6 N.",
                      svg)

    def test_it_is_a_png_where_that_is_asked_for(self):
        self.assertTrue(self.content(Curve("a", [0, 1], [0, 1]), suffix=".png").startswith(b"\x89PNG\r\n"))

    def test_a_single_row_and_constant_columns_are_drawn(self):
        for curve in [Curve("a", [0], [0]), Curve("a", [1, 1], [2, 2]), Curve("a", [0, 1], [-3, -3])]:
            self.assertIn(b"plot-curve-0", self.content(curve))

    def test_ticks_of_what_hardly_changes_differ(self):
        text = curves.tick_text((1000, 1000.5), "J")

        self.assertEqual((text(1000.1), text(1000.2)), ("1.0001 kJ", "1.0002 kJ"))

    def test_no_peak_of_a_long_run_is_lost(self):
        x = [k / 1e4 for k in range(10001)]
        y = [float(k == 5003) for k in range(10001)]

        self.assertIn("force between 0 N and 1 N", self.content(Curve("a", x, y)).decode())
        self.assertIn(5003, curves.corners(x, y))

    def test_by_itself_is_no_wider_than_a_window(self):
        svg = curves.content(Plot("a", "m", "b", "N", [Curve("c", [0, 1], [0, 2])]), ".svg").decode()

        self.assertRegex(svg, r'<svg [^>]*style="max-width: 100%; height: auto"[^>]* width="480pt"')


class TheCommand(InAFolder):
    def test_the_same_runs_give_the_same_picture(self):
        self.run_of()
        made = []
        for _ in range(2):
            done = self.plot("ball", "ball.depth", "ball.contact_force_y", "--out", "curve.svg")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            made.append((self.folder / "curve.svg").read_bytes())

        self.assertEqual(made[0], made[1])
        self.assertIn(b"ball, 2 rows:", made[0])  # the third has no force

    def test_half_a_scene_is_told_where_a_force_is_that_on_the_half(self):
        self.run_of(summary=json.dumps({"part_of_whole": {"factor": 2, "planes": ["x-"]}}))

        for column, told in [("ball.contact_force_y", True), ("ball.depth", False)]:
            self.plot("ball", "time", column, "--out", "curve.svg")
            self.assertEqual("ball (1/2 of the whole)" in (self.folder / "curve.svg").read_text(), told)

    def test_only_a_picture_is_written_over_and_nothing_that_is_read(self):
        self.run_of()
        notes, old = self.write("notes.svg", "mine"), self.write("old.svg", "<svg/>")
        data = self.write("data.svg", "depth[m],force[N]\n1,2\n")
        words = ["ball", "ball.depth", "ball.contact_force_y", "--measured", "data.svg", "--out"]

        refused = {name: self.plot(*words, name) for name in ["notes.svg", "data.svg", "curve.pdf", "ball"]}
        done = self.plot(*words, "old.svg")

        self.assertEqual({name: one.returncode for name, one in refused.items()}, dict.fromkeys(refused, 2))
        self.assertIn("notes.svg: holds something else than a picture", refused["notes.svg"].stderr)
        self.assertIn("data.svg: an input", refused["data.svg"].stderr)
        self.assertIn("--out: curve.pdf; expected a name that ends in .svg or .png", refused["curve.pdf"].stderr)
        self.assertEqual((notes.read_text(), data.read_text()[:5]), ("mine", "depth"))
        self.assertEqual(done.returncode, 0)
        self.assertIn("2 rows", old.read_text())

    def test_a_link_stays_one_and_no_part_is_left(self):
        self.run_of()
        (self.folder / "link.png").symlink_to("real.png")

        self.assertEqual(self.plot("ball", "time", "step", "--out", "link.png").returncode, 0)

        self.assertTrue((self.folder / "link.png").is_symlink())
        self.assertTrue((self.folder / "real.png").read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_a_run_without_a_number_for_both_is_refused(self):
        self.run_of(rows=ROWS[2:])

        done = self.plot("ball", "ball.depth", "ball.contact_force_y", "--out", "curve.svg")

        self.assertEqual(done.returncode, 2)
        self.assertIn("ball/history.csv: 1 row, and none with numbers of ball.depth and ball.contact_force_y",
                      done.stderr)

    def test_a_folder_that_is_not_there_to_write_to_is_a_failure(self):
        self.run_of()

        done = self.plot("ball", "time", "step", "--out", "no/curve.svg")

        self.assertEqual(done.returncode, 4)
        self.assertIn("no: no such folder; expected a place to write to", done.stderr)


if __name__ == "__main__":
    unittest.main()
