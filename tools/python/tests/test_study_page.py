"""What the drawing of a study makes of one that is known, and of odd ones."""

import contextlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from math import log

from tamp.charts import axes, convergence, formatting, study_page, theme, work_precision
from tamp.charts.study import Study
from tamp.program import ROOT
from tests.page_tags import Tags
from tests.punch_study import REFERENCE, failed, study

DRAW = [sys.executable, ROOT / "tools/python/tamp", "draw"]

SVG = "{http://www.w3.org/2000/svg}"


@contextlib.contextmanager
def drawn(document):
    """The folder of a study that has been drawn."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        study_page.write(Study(document), folder)
        yield folder


@contextlib.contextmanager
def drawn_by_command(document):
    """The folder of one that the command has drawn which `tamp study` calls."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "study.json").write_text(json.dumps(document))
        done = subprocess.run([*DRAW, folder], capture_output=True, text=True)
        assert (done.returncode, done.stderr) == (0, ""), done.stderr
        yield folder


def ids_of(folder, chart):
    root = ElementTree.parse(folder / "charts" / f"{chart}.svg").getroot()
    return [element.get("id") for element in root.iter() if element.get("id")]


def numbered(ids, kind):
    """The numbers of the points drawn as a kind."""
    return sorted(int(found[1]) for found in (re.search(rf"-{kind}-(\d+)(-front)?$", i) for i in ids) if found)


def only(document, *numbers):
    """With some of its points, one quantity and one cost."""
    document["costs"] = document["costs"][:1]
    document["points"] = [p for p in document["points"] if p["id"] in numbers]
    document["quantities"] = document["quantities"][:1]
    document["quantities"][0]["orders"] = []
    document["budgets"] = []
    return document


class ThePage(unittest.TestCase):
    """The page of the study with everything."""

    @classmethod
    def setUpClass(cls):
        cls.kept = contextlib.ExitStack()
        cls.folder = cls.kept.enter_context(drawn_by_command(study()))
        cls.text = (cls.folder / "index.html").read_text()
        cls.tags = Tags(cls.text)

    @classmethod
    def tearDownClass(cls):
        cls.kept.close()

    def test_every_chart_is_there_as_svg_and_as_png_of_twice_the_size(self):
        charts = {"greatest-depth": ["work-precision", "particle-steps", "convergence", "step-cost", "budget"],
                  "depth-over-time": ["work-precision", "particle-steps", "convergence", "step-cost"]}

        names = sorted(f"{q}-{kind}" for q, kinds in charts.items() for kind in kinds)

        self.assertEqual(sorted(f.stem for f in (self.folder / "charts").glob("*.svg")), names)
        self.assertEqual(sorted(f.stem for f in (self.folder / "charts").glob("*.png")), names)
        png = (self.folder / "charts/greatest-depth-budget.png").read_bytes()
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(int.from_bytes(png[16:20], "big"), 2 * 720)

    def test_each_point_with_an_error_is_drawn_once_and_each_failed_one_at_the_edge(self):
        ids = ids_of(self.folder, "greatest-depth-work-precision")

        self.assertEqual(numbered(ids, "point"), [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14])
        self.assertEqual(numbered(ids, "failed"), [15, 16, 17])

    def test_failed_points_stand_above_all_others(self):
        buttons = {a["data-point"]: float(re.search(r"top:([\d.]+)%", a["style"])[1])
                   for a in self.tags.of("button", class_="point")[:17]}

        self.assertEqual(len(buttons), 17)
        self.assertLess(max(buttons[n] for n in ("15", "16", "17")), min(buttons[str(n)] for n in range(1, 15)))

    def test_the_reason_stands_beside_a_failed_point(self):
        svg = (self.folder / "charts/greatest-depth-work-precision.svg").read_text()

        for reason in ["limit: 600 s, 100 times", "unstable: step 1822: the energy error of 14 %",
                       "refused: a forecast of 9.1 GB"]:
            self.assertIn(reason, svg)

    def test_the_points_of_the_front_are_marked(self):
        ids = ids_of(self.folder, "greatest-depth-work-precision")
        fronted = sorted(int(re.search(r"-point-(\d+)-front$", i)[1]) for i in ids if i.endswith("-front"))

        self.assertEqual(fronted, [p["id"] for p in study()["points"] if "greatest depth" in p["front"]])
        self.assertIn(8, fronted)  # the best of all
        self.assertNotIn(2, fronted)  # point 5 is cheaper and better

    def test_what_was_expected_stands_with_what_was_found(self):
        document = study()
        gate = {"quantity": "greatest depth", "method": "a", "label": "a, fine", "expected": "order at least 1.95",
                "note": "order 1.2 < 2", "why": "theory"}
        document["gates"] = [{**gate, "holds": False}, {**gate, "holds": True},
                             {**gate, "holds": False, "missed": "noise"}]

        with drawn(document) as folder:
            text = (folder / "index.html").read_text()

        self.assertIn("2 of 3 do not hold, 1 of them as is known", text)
        self.assertIn("<td>missed, as known</td>", text)
        self.assertIn("<td>noise</td>", text)
        self.assertIn("<td>DOES NOT HOLD</td><td>greatest depth</td><td>a, fine</td><td>order 1.2 &lt; 2</td>", text)
        self.assertNotIn("What was expected", self.text)

    def test_points_stand_where_their_cost_and_error_are(self):
        """Equal ratios are equal distances: on the way from point 5 to 6 cost grows by 4.8/0.7."""
        at = {}
        for button in self.tags.of("button", class_="point")[:17]:
            left, top = (float(x) for x in re.findall(r":([\d.]+)%", button["style"]))
            at[button["data-point"]] = left, top
        scale_x = (at["8"][0] - at["5"][0]) / log(310 / 0.7)
        errors = [abs(depth / REFERENCE - 1) for depth in (0.1971, 0.2019, 0.2106)]
        scale_y = (at["8"][1] - at["5"][1]) / log(errors[2] / errors[0])

        self.assertAlmostEqual(at["6"][0] - at["5"][0], scale_x * log(4.8 / 0.7), delta=0.03)
        self.assertAlmostEqual(at["6"][1] - at["5"][1], scale_y * log(errors[1] / errors[0]), delta=0.03)
        self.assertGreater(at["8"][1], at["5"][1])  # less error, further down

    def test_the_reference_says_that_it_is_uncertain(self):
        depth, over_time = ((self.folder / f"charts/{name}-work-precision.svg").read_text()
                            for name in ("greatest-depth", "depth-over-time"))
        self.assertIn("the reference itself is uncertain by 1.2 %", depth)
        self.assertNotIn("itself is uncertain", over_time)
        self.assertIn("Differences, which are no errors, are from the finest run. "
                      "No bound: differences do not fall from grid to grid.", self.text)

    def test_orders_stand_beside_the_lines(self):
        self.assertIn("flatter: order 1.02", (self.folder / "charts/greatest-depth-convergence.svg").read_text())

    def test_without_a_bound_there_is_no_error_no_order_and_no_front(self):
        for chart in ["work-precision", "particle-steps", "convergence", "step-cost"]:
            svg = (self.folder / f"charts/depth-over-time-{chart}.svg").read_text()
            self.assertIn("Difference in depth over time against", svg)
            self.assertIn("difference from the finest run, which is no error", svg)
            for claim in ["order", "Pareto", "error of depth", "Error of", "uncertain", "-front"]:
                self.assertNotIn(claim, svg, chart)
        panel = re.search(r'<template id="point-6">(.*?)</template>', self.text, re.S)[1]
        self.assertIn("<td>depth over time</td><td>–</td><td>3.05 % (difference)</td><td></td>", panel)

    def test_another_model_differs_from_the_reference_and_has_no_error(self):
        document = study()
        for p in document["points"]:
            p["differences"] = ["greatest depth"] if p["method"] == "steel" else []
            p["front"] = [] if p["method"] == "steel" else p["front"]

        with drawn(document) as folder:
            text = (folder / "index.html").read_text()
            convergence_svg = (folder / "charts/greatest-depth-convergence.svg").read_text()
            steps = ids_of(folder, "greatest-depth-particle-steps")

        self.assertIn("flatter: order 1.02", convergence_svg)
        self.assertIn("steel: difference", convergence_svg)
        self.assertNotIn("steel: order", convergence_svg)
        self.assertIn("<td>steel</td><td>cell size 0.02</td><td>4.8 s</td><td>5.7 % (difference)</td><td></td>", text)
        self.assertEqual([i for i in steps if re.search(r"-point-[5678]-front$", i)], [])
        self.assertNotRegex(text, r"The least error, [^,]*, has steel")

    def test_a_part_of_a_budget_without_a_bound_is_said_and_hatched(self):
        svg = (self.folder / "charts/greatest-depth-budget.svg").read_text()

        self.assertIn("<pattern", svg)
        self.assertIn("measured scatter without a bound", svg)
        self.assertIn("6.75 %", svg)  # 3.4 + 0.21 + 1.24 + 1.9, and nothing of the model

    def test_every_drawing_has_a_title_and_a_description_with_numbers(self):
        drawings = self.tags.of("svg")

        self.assertEqual(len(drawings), 2 * 9)
        self.assertTrue(all(a.get("role") == "img" for a in drawings))
        ids = {a.get("id") for _, a in self.tags.found}
        for a in drawings:
            self.assertIn(a["aria-labelledby"], ids)
            self.assertIn(a["aria-describedby"], ids)
        for description in re.findall(r"<desc [^>]*>(.*?)</desc>", self.text, re.S):
            self.assertRegex(description, r"\d")

    def test_every_chart_has_its_figures_in_a_table(self):
        self.assertEqual(len(self.tags.of("details")), 9)
        self.assertIn("<td>flatter</td><td>cell size 0.02</td><td>4.5 s</td><td>11.3 %</td><td></td>", self.text)
        self.assertIn("<td>steel</td><td>cell size 0.02</td><td>4.8 s</td><td>5.7 %</td><td>yes</td>", self.text)

    def test_each_point_has_its_settings_its_figures_and_its_command(self):
        panel = re.search(r'<template id="point-6">(.*?)</template>', self.text, re.S)[1]

        for what in ["steel, cell size 0.02", "Done.", "4.8 s (4.7 s to 5.14 s)", "9.6 M",
                     "<code>/grid/cell_size</code>", "202 mm", "5.7 %",
                     "tamp run inputs/punch/quick.json --set /grid/cell_size=0.02 "
                     "--set &#x27;/contact/0/normal=&quot;steel&quot;&#x27;"]:
            self.assertIn(what, panel)
        refused = re.search(r'<template id="point-17">(.*?)</template>', self.text, re.S)[1]
        self.assertIn("Refused: a forecast of 9.1 GB of memory, where 4 GB are free.", refused)
        self.assertIn("/grid/cell_size=0.0025", refused)

    def test_each_drawing_is_reached_by_tab_once(self):
        for drawing in re.findall(r'<div role="group" aria-label="Points">(.*?)</div>', self.text, re.S):
            self.assertEqual(drawing.count('tabindex="0"'), 1)
        self.assertTrue(all(a.get("aria-label") for a in self.tags.of("button")))

    def test_the_page_needs_nothing_else_and_is_well_formed(self):
        self.assertEqual(self.tags.wrong, [])
        self.assertEqual(self.tags.open, [])
        self.assertTrue(self.tags.sources())
        self.assertTrue(all(source.startswith(("#", "data:")) for source in self.tags.sources()))
        self.assertNotIn("url(http", self.text)
        self.assertNotIn("@import", self.text)

    def test_no_id_is_given_twice(self):
        ids = [a["id"] for _, a in self.tags.found if "id" in a]

        self.assertEqual(len(ids), len(set(ids)))

    def test_drawings_take_their_colours_from_the_page(self):
        for svg in re.findall(r"<svg .*?</svg>", self.text, re.S):
            self.assertEqual(re.findall(r"#[0-9a-f]{6}\b", svg), [])
            self.assertIn("var(--paper)", svg)

    def test_the_same_study_gives_the_same_bytes(self):
        with drawn(study()) as again:
            for file in [self.folder / "index.html", *(self.folder / "charts").iterdir()]:
                self.assertEqual(file.read_bytes(), (again / file.relative_to(self.folder)).read_bytes(), file.name)


class OddStudies(unittest.TestCase):
    def page_of(self, document):
        with drawn(document) as folder:
            for svg in (folder / "charts").glob("*.svg") if (folder / "charts").exists() else []:
                ElementTree.parse(svg)
            text = (folder / "index.html").read_text()
            tags = Tags(text)
            self.assertEqual((tags.wrong, tags.open), ([], []))
            self.assertNotRegex(text, r"\bnan\b|\binf\b")
            return text, folder, sorted(f.stem for f in (folder / "charts").glob("*.svg")), {
                f.stem: ids_of(folder, f.stem) for f in (folder / "charts").glob("*.svg")}

    def test_without_a_reference_the_values_are_drawn(self):
        document = only(study(), 1, 2, 3)
        document["quantities"][0]["reference"] = {"kind": "none"}
        for p in document["points"]:
            p["errors"], p["front"] = {}, []

        text, _, charts, ids = self.page_of(document)

        self.assertEqual(charts, ["greatest-depth-work-precision"])
        self.assertEqual(numbered(ids["greatest-depth-work-precision"], "point"), [1, 2, 3])
        self.assertIn("no error is claimed", text)

    def test_an_error_of_zero_stands_at_the_lower_edge(self):
        document = only(study(), 1, 2, 3)
        document["points"][1]["errors"]["greatest depth"] = 0

        text, _, _, ids = self.page_of(document)

        self.assertEqual(numbered(ids["greatest-depth-work-precision"], "point"), [1, 2, 3])
        self.assertIn("An error of 0 stands at the lower edge.", text)
        buttons = Tags(text).of("button", class_="point")[:3]
        tops = {a["data-point"]: float(re.search(r"top:([\d.]+)%", a["style"])[1]) for a in buttons}
        self.assertGreater(tops["2"], max(tops["1"], tops["3"]))

    def test_errors_that_are_all_zero_are_drawn(self):
        document = only(study(), 1, 2)
        for p in document["points"]:
            p["errors"] = {"greatest depth": 0}
        document["quantities"][0]["reference"]["uncertainty"] = None

        _, _, _, ids = self.page_of(document)

        self.assertEqual(numbered(ids["greatest-depth-work-precision"], "point"), [1, 2])

    def test_a_single_point_is_drawn(self):
        _, _, _, ids = self.page_of(only(study(), 3))

        self.assertEqual(numbered(ids["greatest-depth-convergence"], "point"), [3])

    def test_a_study_whose_runs_all_failed_shows_them_at_the_edge(self):
        document = only(study(), 1, 2, 3)
        document["points"] = [failed(p, "unstable", "the step fell to 0") for p in document["points"]]
        for p in document["points"]:
            p["front"] = []

        text, _, _, ids = self.page_of(document)

        self.assertEqual(numbered(ids["greatest-depth-work-precision"], "failed"), [1, 2, 3])
        self.assertIn("no run has a result here", text)

    def test_many_failed_runs_share_their_reasons(self):
        document = only(study(), 1)
        late = failed(document["points"][0], "limit", "600 s")
        document["points"] += [{**late, "id": 100 + k} for k in range(30)]

        text, _, _, ids = self.page_of(document)

        self.assertEqual(len(numbered(ids["greatest-depth-work-precision"], "failed")), 30)
        self.assertIn("limit: 600 s (30 runs)", text)

    def test_without_refinement_steps_and_budgets_those_charts_are_left_out(self):
        document = only(study(refine=None), 1, 2, 3)
        for p in document["points"]:
            p["refine"] = None
            del p["cost"]["steps"]

        _, _, charts, _ = self.page_of(document)

        self.assertEqual(charts, ["greatest-depth-work-precision"])

    def test_names_cannot_be_taken_for_markup(self):
        name = '<b>&"\'$x$ _\\'
        document = only(study(title=name, about=name, program=name, command=name), 1, 2, 15)
        document["methods"] = [{"name": name, "family": name}]
        document["quantities"][0]["name"] = name
        parts = [{"name": name, "amount": None, "note": name}]
        document["budgets"] = [{"quantity": name, "unit": "m", "of": name, "value": 1, "parts": parts}]
        for p in document["points"]:
            p |= {"method": name, "label": name, "command": name, "settings": {name: name}, "front": [name],
                  "values": {name: 1}, "errors": {name: 0.1}, "reason": name if p["ended"] != "done" else ""}

        text, _, charts, ids = self.page_of(document)

        self.assertNotIn("<b>", text)
        self.assertIn("&lt;b&gt;&amp;", text)
        self.assertIn("b-x-work-precision", charts)
        self.assertEqual(numbered(ids["b-x-work-precision"], "point"), [1, 2])

    def test_a_study_with_hardly_anything_is_drawn(self):
        text, _, charts, _ = self.page_of({"title": "Nothing", "quantities": [{"name": "depth"}], "points": []})

        self.assertIn("<h1>Nothing</h1>", text)
        self.assertEqual(charts, [])

    def test_control_characters_and_missing_numbers_are_passed_over(self):
        document = only(study(title="a\u0001b"), 1, 2, 3)
        document["points"][0]["errors"] = {"greatest depth": None}
        document["points"][1]["cost"]["core_s"] = None

        text, _, _, ids = self.page_of(document)

        self.assertIn("<h1>ab</h1>", text)
        self.assertEqual(numbered(ids["greatest-depth-work-precision"], "point"), [3])
        self.assertIn("2 runs have no place here", text)

    def test_two_quantities_of_like_names_have_files_of_their_own(self):
        document = only(study(), 1, 2)
        document["quantities"].append({**document["quantities"][0], "name": "greatest-depth"})

        _, _, charts, _ = self.page_of(document)

        self.assertIn("greatest-depth-2-work-precision", charts)

    def test_a_point_of_the_second_cost_is_on_the_front_where_none_beats_it(self):
        document = only(study(), 1, 2, 3)
        for p, (cost, error) in zip(document["points"], [(1, 0.3), (2, 0.3), (3, 0.1)]):
            p["cost"]["particle_steps"], p["errors"]["greatest depth"] = cost, error

        known = Study(document)
        across = work_precision.Across("", lambda p: p.cost_of("particle_steps"), str)
        front = work_precision.front_of(known, known.quantities[0], across)

        self.assertEqual([p.id for p in front], [1, 3])

    def test_the_fit_over_a_setting_whose_larger_values_are_finer_falls_with_it(self):
        document = only(study(), 1, 2, 3)
        for p, (value, error) in zip(document["points"], [(1, 0.16), (2, 0.04), (4, 0.01)]):
            p["refine"], p["errors"]["greatest depth"] = value, error

        known = Study(document)
        [(_, xs, ys)] = convergence.guide("flatter", 2, known.points, known.quantities[0])

        self.assertEqual(xs, [1, 4])
        self.assertAlmostEqual(ys[0], 0.16)
        self.assertAlmostEqual(ys[1], 0.01)


class Formatting(unittest.TestCase):
    def test_numbers_have_three_digits_and_a_prefix(self):
        for value, unit, text in [(0.000312, "s", "312 µs"), (2.5e9, "Pa", "2.5 GPa"), (0, "m", "0 m"),
                                  (-0.2, "m", "−200 mm"),
                                  (999.4e-6, "s", "999 µs"), (999.7e-6, "s", "1 ms"), (3e-15, "s", "0.003 ps"),
                                  (48.2, "deg", "48.2 deg"),
                                  (1.2e7, "", "12 M"), (0.034, "", "0.034"), (1500, "ns", "1.5 µs"),
                                  (1e-9, "deg", "10⁻⁹ deg"),
                                  (None, "m", "–"), (float("nan"), "m", "–")]:
            self.assertEqual(formatting.si_text(value, unit), text)

    def test_percent(self):
        self.assertEqual(formatting.percent_text(0.0339), "3.39 %")
        self.assertEqual(formatting.percent_text(2.4e-9), "2.4×10⁻⁷ %")

    def test_logarithmic_ticks_are_within_and_few(self):
        self.assertEqual(axes.log_ticks(3e-4, 4e-3)[0], [5e-4, 1e-3, 2e-3])
        ticks, between = axes.log_ticks(1e-12, 1e3)
        self.assertLessEqual(len(ticks), 8)
        self.assertTrue(set(ticks) <= set(between))

    def test_linear_ticks_are_round_numbers_within(self):
        self.assertEqual(axes.linear_ticks(0, 7, 6), [0, 2, 4, 6])

    def test_labels_are_moved_apart_and_keep_their_order(self):
        placed = axes.apart([10, 12, 11, 90], 15, 0, 100)

        self.assertEqual(sorted(range(4), key=lambda k: placed[k]), [0, 2, 1, 3])
        heights = sorted(placed)
        self.assertTrue(all(b - a >= 15 - 1e-9 for a, b in zip(heights, heights[1:])))
        self.assertGreaterEqual(heights[0], 0)
        self.assertAlmostEqual(placed[3], 90)

    def test_each_method_has_a_marker_of_its_own_and_each_family_a_colour(self):
        styles = theme.styles_of_methods([{"name": str(k), "family": "ab"[k % 2]} for k in range(8)])

        self.assertEqual(len({style.marker for style in styles.values()}), 8)
        self.assertEqual(styles["0"].colour, styles["4"].colour)
        self.assertNotEqual(styles["0"].colour, styles["1"].colour)
