"""What the drawing of a comparison makes of one that is known."""

import copy
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

from tamp.charts import compare_page, over_time
from tamp.charts.axes import NARROW
from tamp.charts.over_time import Line, Plot
from tamp.program import ROOT
from tests.page_tags import Tags

DRAW = [sys.executable, ROOT / "tools/python/tamp", "draw"]


def model(name, **changes):
    """Four samples over 3 ms, and three rounds."""
    return {
        "model": name, "status": "completed", "reason": "", "steps": 6, "simulated_time_s": 3e-3, "wall_s": 6.0,
        "wall_per_step_s": 312e-6, "ratio_to_table": 1.23, "ratio_to_table_lower_quartile": 1.1,
        "ratio_to_table_upper_quartile": 1.4, "dt_mean_s": 5e-4, "modulus_evaluations": 5_670_000,
        "modulus_ns_per_eval": 19.8,
        "peak_rss_bytes": 36.5 * 2**20, "ledger_peak_bytes": 3 * 2**20, "depth_m": 0.15, "depth_max_m": 0.198,
        "depth_at_common_time_m": 0.2, "q_at_common_time_Pa": 2e8,
        "p_max_Pa": 2.5e8, "q_max_Pa": 4e8, "state_digest": "0",
        "series": {"time_s": [0, 1e-3, 2e-3, 3e-3], "dt_s": [0, 5e-4, 6e-4, 1e-9], "wall_s": [0, 2, 4, 6],
                   "punch.depth_m": [0, 0.1, 0.2, 0.15], "sand.p_max_Pa": [0, 1e8, 2e8, 2.5e8],
                   "sand.q_max_Pa": [0, 1e8, 2e8, 4e8]},
        "rounds": {"time_s": [1e-3, 2e-3, 3e-3], "steps": [2, 0, 4], "wall_per_step_s": [3e-4, 0, 3.2e-4]}, **changes}


def comparison(*models):
    return {"scene": "punch", "title": "A <punch> & sand", "version": "0.1.0", "program": "tamp 0.1.0\nEigen 3.4.0",
            "cores": 2, "threads": 1, "particles": 5600, "bodies": ["punch"], "sands": ["sand"], "common_time_s": 2e-3,
            "models": list(models) or [model("table"), model("svr")]}


def page_of(document):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return compare_page.whole_page(copy.deepcopy(document))


def example(*lines, logarithmic=False):
    lines = list(lines) or [Line("table", [0, 1e-3, 2e-3], [0, 0.2, 0.4])]
    return Plot("Depth of punch", "depth", "m", lines, logarithmic)


def path_of(plot, k=0):
    """A line's corners in its wide drawing, in points from the upper left corner."""
    svg = over_time.chart(plot, "plot").wide.svg
    line = re.search(rf'id="plot-line-{k}">\s*<path d="([^"]*)"', svg)[1]
    return [tuple(map(float, pair)) for pair in re.findall(r"([-\d.]+) ([-\d.]+)", line)]


class ThePage(unittest.TestCase):
    def test_it_holds_six_plots_and_needs_nothing_from_elsewhere(self):
        tags = Tags(page_of(comparison()))

        self.assertEqual(len(tags.of("figure")), 6)
        self.assertEqual(len(tags.of("svg", role="img")), 12)  # each for wide and for narrow pages
        self.assertEqual((tags.wrong, tags.open), ([], []))
        self.assertTrue(all(source.startswith(("#", "data:")) for source in tags.sources()))
        ids = [a["id"] for _, a in tags.found if "id" in a]
        self.assertEqual(len(ids), len(set(ids)))

    def test_it_takes_no_text_for_markup(self):
        page = page_of(comparison(model("<svr>")))

        self.assertIn("A &lt;punch&gt; &amp; sand", page)
        self.assertNotIn("<punch>", page)
        self.assertNotIn("<svr>", page)

    def test_its_table_has_the_figures_with_units_and_the_ratios_with_quartiles(self):
        page = page_of(comparison())

        for cell in ["312 µs", '1.23 <span class="small">(1.1–1.4)</span>', "500 µs", "5.67 M", "19.8 ns", "36.5 MiB",
                     "3.0 MiB",
                     "198 mm", "150 mm", "250 MPa", "400 MPa"]:
            self.assertEqual(page.split("</table>")[0].count(f"<td>{cell}</td>"), 2, cell)
        self.assertIn("Scene punch: 5600 particles, 1 thread, 2 cores.", page)

    def test_what_is_not_known_is_left_open(self):
        page = page_of(comparison(model("svr", ratio_to_table=None, modulus_ns_per_eval=None, peak_rss_bytes=None)))

        self.assertEqual(page.split("</table>")[0].count("<td>–</td>"), 3)

    def test_it_marks_a_model_that_went_wrong_and_says_why(self):
        bad = model("svr", status="unstable", reason="step 3: lost")

        page = page_of(comparison(model("table"), bad))

        self.assertIn("<strong>svr became unstable</strong> at step 3: lost. Its lines end in a cross.", page)
        self.assertIn('id="plot-1-cross-1"', page)
        self.assertNotIn('id="plot-1-cross-0"', page)
        self.assertIn("svr: between 0 s and 6 s, breaks off at 6 s after 3 ms.", page)

    def test_what_a_model_changes_stands_beside_what_the_grid_does(self):
        near, far = ({"depth_at_common_time_m": depth, "q_at_common_time_Pa": q}
                     for depth, q in [(0.202, 1.5e8), (0.23, 2e8)])
        document = {**comparison(model("table"), model("svr", **near), model("mlp", **far)),
                    "coarser": {"depth_at_common_time_m": 0.19, "q_at_common_time_Pa": None}}

        page = page_of(document)

        for row in [["svr", "+1 % (less than by the grid)", "−25 %"], ["mlp", "+15 % (more than by the grid)", "0 %"],
                    ["cells twice as large", "−5 %", "–"]]:
            self.assertIn("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>", page)
        self.assertIn('<th scope="col">difference from table at 2 ms</th>', page)

    def test_it_says_where_what_the_grid_changes_is_not_known(self):
        said = "What the grid changes is not known, as cells twice as large were not run."
        for document in [comparison(), {**comparison(), "coarser": None}]:
            self.assertIn(said, page_of(document))
        self.assertNotIn("the grid changes", page_of(comparison(model("table"))))

    def test_it_says_how_it_was_measured_and_with_what(self):
        page = page_of(comparison())

        self.assertIn("in 3 rounds", page)
        self.assertIn("<pre>tamp 0.1.0\nEigen 3.4.0</pre>", page)

    def test_steps_that_only_had_to_reach_the_end_are_not_drawn(self):
        line = compare_page.step_size(comparison()).lines[0]

        self.assertEqual((line.x, line.y), ([1e-3, 2e-3], [5e-4, 6e-4]))

    def test_rounds_without_a_step_have_no_cost(self):
        plot = compare_page.step_cost(comparison())

        self.assertEqual((plot.lines[0].x, plot.lines[0].y), ([1e-3, 3e-3], [3e-4, 3.2e-4]))
        self.assertFalse(plot.logarithmic)
        far_apart = comparison(model("table"), model("svr", wall_per_step_s=1.3e-3))
        self.assertTrue(compare_page.step_cost(far_apart).logarithmic)

    def test_a_body_that_left_the_domain_has_no_depth_from_then_on(self):
        gone = model("table")
        gone["series"]["punch.depth_m"] = [0, 0.1, None, None]

        page = page_of(comparison(gone))

        self.assertIn("table: between 0 m and 100 mm, ends at 100 mm after 1 ms.", page)
        self.assertNotRegex(page, r"\bnan\b|\bNone\b")

    def test_two_bodies_have_a_plot_and_a_row_each(self):
        document = comparison()
        document["bodies"] = ["punch", "stone"]
        for each in document["models"]:
            each["series"]["stone.depth_m"] = [0, 0.01, 0.02, 0.03]

        page = page_of(document)

        self.assertIn("Depth of stone", page)
        self.assertIn("<td>30 mm</td>", page)

    def test_the_command_writes_the_same_bytes_each_time(self):
        pages = []
        for _ in range(2):
            with tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "compare.json").write_text(json.dumps(comparison()))
                subprocess.run([*DRAW, folder], check=True)
                pages.append((pathlib.Path(folder) / "report.html").read_bytes())

        self.assertEqual(*pages)

    def test_a_page_that_is_a_link_to_what_it_is_drawn_from_is_refused_and_so_is_a_pipe(self):
        with tempfile.TemporaryDirectory() as name:
            document, page = pathlib.Path(name, "compare.json"), pathlib.Path(name, "report.html")
            document.write_text(json.dumps(comparison()))
            page.symlink_to(document.name)
            linked = subprocess.run([*DRAW, name], capture_output=True, text=True, timeout=60)
            page.unlink()
            os.mkfifo(page)
            piped = subprocess.run([*DRAW, name], capture_output=True, text=True, timeout=60)

            self.assertEqual((linked.returncode, piped.returncode), (2, 4))
            self.assertIn("report.html: an input; expected another file to write to", linked.stderr)
            self.assertIn("report.html: a folder, a pipe or a device", piped.stderr)
            self.assertEqual(json.loads(document.read_text()), comparison())


class Lines(unittest.TestCase):
    def test_a_plot_names_its_axes_and_its_lines_and_says_what_it_shows(self):
        chart = over_time.chart(example(), "plot")

        for what in [">Depth of punch<", ">depth<", ">time<", ">table<", ">500 µs<", ">400 mm<"]:
            self.assertIn(what, chart.wide.svg)
            self.assertIn(what, chart.narrow.svg)
        self.assertEqual(chart.description,
                         "1 line over 2 ms. table: between 0 m and 400 mm, ends at 400 mm after 2 ms.")

    def test_points_stand_where_the_ticks_put_them(self):
        a, b, c = path_of(example(Line("table", [0, 1e-3, 2e-3], [0, 0.1, 0.4])))

        self.assertAlmostEqual(b[0] - a[0], c[0] - b[0], delta=0.02)
        self.assertAlmostEqual((b[1] - a[1]) * 4, c[1] - a[1], delta=0.05)
        self.assertLess(c[1], a[1])  # upwards

    def test_on_a_logarithmic_axis_equal_ratios_are_equal_distances(self):
        a, b, c = path_of(example(Line("table", [0, 1, 2], [1, 10, 100]), logarithmic=True))

        self.assertAlmostEqual(b[1] - a[1], c[1] - b[1], delta=0.02)
        self.assertLess(c[1], a[1])

    def test_zero_belongs_to_an_axis_unless_it_would_flatten_the_line(self):
        self.assertEqual(over_time.y_limits(example(Line("", [0, 1], [3, 5])))[0], 0)
        self.assertGreater(over_time.y_limits(example(Line("", [0, 1], [4.9, 5])))[0], 4)

    def test_the_axis_encloses_its_values(self):
        for values in [[0, 0], [5, 5], [-3, 11], [-5, -5], [1e-12, 3e-12], [0.31, 0.36], [0, 0.3], [-2e8, -1e8]]:
            low, high = over_time.y_limits(example(Line("", [0, 1], values)))
            self.assertLessEqual(low, min(values))
            self.assertGreaterEqual(high, max(values))
            self.assertLess(low, high)

    def test_a_plot_without_a_point_is_drawn_empty(self):
        chart = over_time.chart(example(Line("table", [], [], True)), "plot")

        self.assertIn("nothing to draw", chart.wide.svg)
        self.assertNotIn("plot-line-0", chart.wide.svg)
        self.assertNotIn("plot-cross-0", chart.wide.svg)

    def test_a_line_that_is_thinned_keeps_its_ends_its_peaks_and_its_order(self):
        x = list(range(10000))
        y = [math.sin(0.01 * i) for i in x]
        y[1234], y[8765] = 50, -50

        few_x, few_y = over_time.thinned(x, y, 400)

        self.assertLessEqual(len(few_x), 402)
        self.assertEqual((few_x[0], few_x[-1]), (0, 9999))
        self.assertEqual(few_x, sorted(few_x))
        self.assertEqual((max(few_y), min(few_y)), (50, -50))

    def test_a_short_line_is_left_as_it_is(self):
        self.assertEqual(over_time.thinned([0, 1, 2], [1, 5, 3], 400), ([0, 1, 2], [1, 5, 3]))
        self.assertEqual(over_time.thinned([], [], 400), ([], []))

    def test_the_table_has_the_values_at_even_times_and_none_beyond_a_line(self):
        rows = over_time.table(example(Line("a", [0, 1], [0, 10]), Line("b", [0, 0.5], [1, 1]))).rows

        self.assertEqual(rows[5], ["500 ms", "5 m", "1 m"])
        self.assertEqual(rows[10], ["1 s", "10 m", "–"])

    def test_a_dozen_lines_differ_in_colour_and_without_it_too(self):
        styles = [over_time.style_of(k) for k in range(12)]

        self.assertEqual(len({style.colour for style in styles}), 12)
        self.assertEqual(len({(str(style.dashes), style.marker) for style in styles}), 12)

    def test_lines_and_their_entries_are_drawn_in_their_styles(self):
        svg = over_time.chart(example(*(Line(f"line {k}", [0, 1, 2], [k, k, k]) for k in range(8))), "plot").wide.svg
        looks = []
        for k in range(8):
            whole = re.search(rf'<g id="plot-line-{k}">(.*?)</g>\s*<g id="plot-(line|patch)', svg, re.S)[1]
            dashes = re.search(r"stroke-dasharray: ([^;]*)", whole)
            looks.append((dashes[1] if dashes else "", "<use" in whole))

        self.assertEqual(len(set(looks)), 8)

    def test_a_blow_goes_beyond_the_axis_which_says_so(self):
        x = [0.001 * k for k in range(101)]
        y = [0, 90, 40] + [2 + 0.01 * k for k in range(98)]
        plot = example(Line("punch", x, y))._replace(through_blow=True)

        chart = over_time.chart(plot, "plot")

        self.assertLess(over_time.y_limits(plot)[1], 6)
        self.assertIn("punch goes beyond the axis, up to 90 m at a time of 1 ms.", chart.caption)
        self.assertIn(">up to 90 m<", chart.wide.svg)
        self.assertIn("punch: between 0 m and 90 m", chart.description)
        self.assertGreaterEqual(over_time.y_limits(plot._replace(through_blow=False))[1], 90)

    def test_an_axis_that_a_curve_fills_is_whole(self):
        x = list(range(101))
        for y in [x, [k**0.5 for k in x], [k**2 for k in x], [math.exp(-k / 20) for k in x], [5] * 101, [0] * 101,
                  [-k for k in x], [1, 5]]:
            plot = example(Line("punch", x[: len(y)], y))._replace(through_blow=True)
            self.assertGreaterEqual(over_time.y_limits(plot)[1], max(y))
            self.assertEqual(over_time.chart(plot, "plot").caption, "")

    def test_the_narrow_drawing_is_as_wide_as_a_phone(self):
        self.assertEqual(over_time.chart(example(), "plot").narrow.width, NARROW.width)
        self.assertLessEqual(NARROW.width, 360 - 2 * 16)
