"""What is read from runs, and how it is put into tables and pictures, on data that can be checked by hand."""

import importlib.util
import pathlib
import tempfile
import unittest

import numpy as np

from tamp import program, results
from tamp.research.report import cost, drawing, numbers, projectile, punch, punch_numbers, sand, scenes

HAS_H5PY = importlib.util.find_spec("h5py") is not None


def particles(x, values):
    places = np.array([[place, 0.25, 0.0] for place in x])
    return results.Particles(1e-3, {"position": places, "p": np.array(values, dtype=float)})


class Columns(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text(text)
            return results.columns(path)

    def test_columns_are_named_without_their_units(self):
        columns = self.read("step,time[s],sand.p_max[Pa]\n0,0,1\n1,0.5,3\n")

        self.assertEqual(list(columns), ["step", "time", "sand.p_max"])
        self.assertEqual(columns["sand.p_max"].tolist(), [1, 3])
        self.assertEqual(results.at(columns, "sand.p_max", 0.25), 2)

    def test_remarks_are_passed_over_and_gaps_are_nan(self):
        columns = self.read("# made by hand\ntime[s],depth[m]\n0,\n1,nan\n")

        self.assertTrue(np.isnan(columns["depth"]).all())

    def test_a_heading_alone_gives_empty_columns(self):
        self.assertEqual(len(self.read("time[s],depth[m]\n")["time"]), 0)


class Shares(unittest.TestCase):
    def test_what_a_share_of_the_sand_is_above(self):
        """Ten of the numbers 0 to 1000 lie above 990."""
        values = np.arange(1001)

        self.assertEqual(results.exceeded(values), (999, 990, 950))
        self.assertEqual((values > 990).sum(), 10)

    def test_a_single_peak_does_not_move_what_five_percent_are_above(self):
        calm, peaked = np.ones(100), np.append(np.ones(99), 500)

        self.assertEqual(results.exceeded(peaked)[2], results.exceeded(calm)[2])


class Halves(unittest.TestCase):
    def test_each_model_keeps_its_own_side(self):
        left, right = particles([0.1, 0.6], [1e6, 2e6]), particles([0.2, 0.7], [3e6, 4e6])

        places, values = punch.halves(left, right, punch.PRESSURE.values, middle=0.5)

        self.assertEqual(places[:, 0].tolist(), [0.1, 0.7])
        self.assertEqual(values.tolist(), [1, 4])

    def test_no_particle_at_the_middle_is_drawn_twice(self):
        both = particles([0.5], [1e6])

        self.assertEqual(len(punch.halves(both, both, punch.PRESSURE.values, middle=0.5)[1]), 1)


class Figures(unittest.TestCase):
    def test_every_figure_of_the_punch_has_a_number_of_its_own(self):
        self.assertEqual(sorted(punch.FIGURES.values()), [str(n) for n in range(10, 24)])

    def test_captions_of_pictures_drawn_earlier_are_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("09", "25a"):
                album = drawing.Album(pathlib.Path(folder))
                figure, _ = drawing.chart("x", "y")
                album.keep(figure, name, f"Caption of {name}; 1.5 m. And more.")
                album.write_captions()
            text = (pathlib.Path(folder) / "captions.md").read_text()

            self.assertIn("## 09. Caption of 09; 1.5 m. And more.", text)
            self.assertIn("## 25a. Caption of 25a; 1.5 m. And more.", text)
            self.assertTrue((pathlib.Path(folder) / "figure-09.png").exists())

    def test_the_mesh_of_the_projectile_is_as_long_as_the_report_says(self):
        corners = projectile.mesh()

        self.assertAlmostEqual(np.ptp(corners[:, :, 0]), 41, places=3)

    def test_neighbours_on_the_lattice_say_how_large_a_particle_is(self):
        lattice = np.array([[x, y, 0.0] for x in (0.0025, 0.0075) for y in (0.0025, 0.0075, 0.0125)])

        self.assertAlmostEqual(results.spacing(lattice), 0.005)


class Numbers(unittest.TestCase):
    def number(self, model, report, ours):
        return numbers.Number("13", "mean stress", model, "1", "MPa", report, ours, (160.0, 120.0, 80.0))

    def test_models_stand_side_by_side_with_what_the_sand_is_above(self):
        text = numbers.as_markdown([self.number("Table", "166", 169.23), self.number("MLP", "180", 174.0)])

        self.assertIn("| 13 | mean stress | 1 | MPa | Table 166, MLP 180 | 169.2 / 160 / 120 / 80 |  | 174 / ", text)

    def test_what_the_report_says_of_all_models_is_said_once(self):
        found = [self.number(model, "145", 1.0) for model in program.MODELS.values()]

        self.assertIn("| MPa | 145 |", numbers.as_markdown(found))

    def test_a_number_without_shares_leaves_those_cells_of_the_csv_empty(self):
        cells = numbers.cells(numbers.Number("9", "depth", "SVR", "1", "cm", "", 15.5))

        self.assertEqual(cells[-4:], ["15.5", "", "", ""])

    def test_every_number_is_a_row_of_the_csv(self):
        with tempfile.TemporaryDirectory() as folder:
            numbers.write([self.number("Table", "166", 169.23)], pathlib.Path(folder))
            rows = (pathlib.Path(folder) / "numbers.csv").read_text().splitlines()

        self.assertEqual(rows[1], "13,mean stress,Table,1,MPa,166,169.2,160,120,80")


class Sand(unittest.TestCase):
    def test_the_heading_says_what_the_strength_is(self):
        self.assertEqual(sand.strength({"q": np.array([3.0])}).tolist(), [3.0])
        self.assertAlmostEqual(sand.strength({"sqrt_J2": np.array([1.0])})[0], np.sqrt(3))

    def test_crushed_sand_has_no_pores(self):
        self.assertEqual(sand.porosity(np.array([0.0, 0.325, 0.4])).tolist(), [0.325, 0, 0])


class Cost(unittest.TestCase):
    def test_time_per_step_is_that_between_rows(self):
        rows = {"step": [0, 10, 10, 30], "time": [0, 1, 2, 3], "processor": [0.5, 1.5, 1.5, 5.5]}
        machine = {name: np.array(values) for name, values in rows.items()}

        time, per_step = cost.per_step(machine)

        self.assertEqual((time.tolist(), per_step.tolist()), ([0.5, 2.5], [0.1, 0.2]))

    def test_a_single_peak_is_smoothed_away(self):
        self.assertEqual(cost.smoothed(np.array([1.0] * 10 + [9.0] + [1.0] * 10)).tolist(), [1.0] * 21)


class Plug(unittest.TestCase):
    def test_only_sand_that_keeps_up_with_the_punch_counts(self):
        places = np.array([[0.5, 0.35, 0], [0.5, 0.25, 0], [0.5, 0.15, 0], [0.62, 0.1, 0]])
        velocity = np.array([[0, -150.0, 0], [0, -130.0, 0], [0, -50.0, 0], [0, -150.0, 0]])
        particles = results.Particles(1e-3, {"position": places, "velocity": velocity})

        self.assertAlmostEqual(punch_numbers.plug_depth(particles, 0.4, -150.0, 0), 0.15)


class Runs(unittest.TestCase):
    def test_only_a_run_that_completed_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            run = scenes.punch_runs(pathlib.Path(folder), {})[0]
            run.folder.mkdir()
            self.assertFalse(run.is_finished)
            statuses = (("interrupted", False), ("unstable", False), ("completed", True),
                        ("completed with warnings", True))
            for status, kept in statuses:
                (run.folder / "summary.json").write_text('{ "status": "%s" }' % status)
                self.assertEqual(run.is_finished, kept, status)

    def test_settings_of_the_command_line_come_last(self):
        run = scenes.projectile_runs(pathlib.Path("runs"), "fine", {"/time/end": "1e-4"})[1]

        words = program.changes(run.settings)

        self.assertEqual(run.scene, program.INPUTS / "uxo/svr.json")
        self.assertIn("/time/end=1e-4", words)
        self.assertNotIn("/time/end=0.00085", words)

    @unittest.skipUnless(HAS_H5PY, "h5py is not here")
    def test_a_stiffer_network_is_a_copy_with_a_higher_mean(self):
        import h5py

        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            table, _, mlp = scenes.with_stiffer_network(scenes.punch_runs(folder, {}), folder, 3e9)
            with h5py.File(mlp.settings["/materials/sand/modulus/mlp"]) as copy, \
                 h5py.File(program.SAND / "network.h5") as original:
                raised = copy.attrs["scaling"] - original.attrs["scaling"]

        self.assertEqual(raised.tolist(), [0, 0, 0, 0, 3e9, 0])
        self.assertEqual((table.folder.name, mlp.folder.name), ("punch-table", "punch-mlp-stiffer"))

    @unittest.skipUnless(HAS_H5PY, "h5py is not here")
    def test_particles_are_given_in_the_order_of_their_numbers(self):
        import h5py

        with tempfile.TemporaryDirectory() as folder:
            with h5py.File(pathlib.Path(folder) / "fields.h5", "w") as file:
                for step, time in ((0, 0.0), (7, 1e-3)):
                    group = file.create_group(f"step_{step:08d}")
                    group.attrs["time"] = time
                    group.create_dataset("particles/sand/id", data=[2, 0, 1])
                    group.create_dataset("particles/sand/p", data=[2.0 + step, 0.0 + step, 1.0 + step])

            found = results.particles(pathlib.Path(folder), "sand", 0.9e-3)

        self.assertEqual((found.time, found["p"].tolist()), (1e-3, [7, 8, 9]))
