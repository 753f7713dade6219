"""What the page of a run makes of a trace, of pictures, of choices and of memory that are known."""

import pathlib
import tempfile
import unittest

import numpy as np

from tamp import failure, files
from tamp.charts import axes, choices, over_time, page, particles, picture, run_history, run_page, timeline
from tamp.charts.chart import Table
from tamp.charts.timeline import Bar
from tests.page_tags import Tags


def task(step, start, length, name="push", phase="motion", rank=0, worker=0, **args):
    return {"name": name, "cat": phase, "ph": "X", "pid": rank, "tid": worker, "ts": start, "dur": length,
            "args": {"step": step, **args}}


def step(number, start, length, rank=0):
    return task(number, start, length, f"step {number}", "step", rank, 1)


def trace(*events):
    arrow = {"name": "waits for", "cat": "arrow", "ph": "s", "id": 0, "pid": 0, "tid": 0, "ts": 0}
    return {"traceEvents": [arrow, {"name": "process_name", "ph": "M", "pid": 0, "args": {"name": "rank 0"}}, *events]}


def bars(*ends, phase="motion"):
    return [Bar(start, end, phase, "push", 1, end - start) for start, end in ends]


class TheStep(unittest.TestCase):
    def test_is_the_one_of_median_time_among_those_after_the_first(self):
        for lengths, chosen in [([90, 5, 7, 100], 3), ([1, 8, 6], 3), ([4, 9], 2), ([4], 1)]:
            events = [step(k + 1, 1000 * k, length) for k, length in enumerate(lengths)]
            found = timeline.read_step(trace(*events))

            self.assertEqual((found.number, found.n_traced), (chosen, len(lengths)), lengths)

    def test_takes_as_long_as_on_the_slowest_rank(self):
        self.assertAlmostEqual(timeline.read_step(trace(step(3, 0, 10), step(3, 1, 30, rank=1))).duration, 30e-6)

    def test_has_its_tasks_by_worker_from_its_start_on_and_messages_last(self):
        message = task(2, 105, 4, "halo", "message", 0, 3, bytes=8)
        found = timeline.read_step(trace(step(1, 0, 90), task(1, 0, 90), step(2, 100, 10), message,
                                         task(2, 104, 6, patch=3), task(2, 100, 2, "push: mud", material="mud"),
                                         task(2, 101, 9, worker=10), task(2, 101, 9, worker=2, material="mud")))

        self.assertEqual(list(found.lanes), [(0, 0), (0, 2), (0, 10), (0, "messages")])
        first, second = found.lanes[0, 0]
        self.assertEqual((first.task, second.task), ("push: mud", "push, patch 3"))
        self.assertEqual(found.lanes[0, 2][0].task, "push, mud")
        self.assertEqual(first.start, 0)
        self.assertAlmostEqual(second.end, 10e-6)

    def test_there_is_none_in_a_trace_without_steps(self):
        self.assertIsNone(timeline.read_step(trace()))

    def test_is_refused_where_it_takes_no_time(self):
        for length in [0, -1]:
            self.assertRaises(ValueError, timeline.read_step, trace(step(2, 0, length), task(2, 0, 4)))
        self.assertRaises(ValueError, timeline.read_step, trace(step(2, 0, 5), task(2, 0, -4)))

    def test_of_a_damaged_trace_is_refused_without_a_word_of_Python(self):
        whole, part = step(2, 0, 10), task(2, 0, 4)
        nameless = {key: value for key, value in part.items() if key != "name"}
        documents = [None, 3, [], {}, {"traceEvents": None}, trace(3), trace(step(2, 0, 0)), trace(whole, nameless)]
        documents += [trace(whole, {**part, key: value}) for key in part for value in (None, "text", 3, [], {})]
        n_refused = 0
        for document in documents:
            try:
                with files.written_by_tamp("trace.json"):
                    found = timeline.read_step(document)
                    if found:
                        timeline.chart(found, "timeline")
            except failure.Failure as refusal:
                n_refused += 1
                self.assertRegex(str(refusal), "^trace.json: damaged: .+; expected what TAMP has written$")
                self.assertNotRegex(str(refusal), "Error|NoneType|\\bint\\b|object|indices|unhashable", document)

        self.assertGreater(n_refused, 20)

    def test_is_drawn_with_a_text_for_each_task_in_both_widths(self):
        known = timeline.read_step(trace(step(2, 0, 10), task(2, 0, 4, "push <up>"), task(2, 5, 5, phase="stress")))

        chart = timeline.chart(known, "timeline")

        for drawing in [chart.wide, chart.narrow]:
            self.assertIn("<title>push &lt;up&gt;: 4 µs, after 0 s</title>", drawing.svg)
            self.assertEqual(drawing.svg.count("-bar-"), 2)
        self.assertIn("Step 2 takes 10 µs for 2 tasks: worker 0 works for 90 % of it", chart.description)
        self.assertIn("stress 56 %, motion 44 %", chart.description)


class Neighbours(unittest.TestCase):
    def test_of_one_phase_are_joined_where_they_follow_at_once(self):
        made = timeline.joined(bars((0, 1), (1, 2), (5, 6)) + bars((6, 7), phase="stress"), gap=0.5, alike=True)

        self.assertEqual([(bar.start, bar.end, bar.n) for bar in made], [(0, 2, 2), (5, 6, 1), (6, 7, 1)])
        self.assertEqual(made[0].busy, 2)

    def test_of_any_phase_are_joined_where_they_are_short(self):
        made = timeline.joined(bars((0, 1)) + bars((1, 3), phase="stress") + bars((3, 9)), gap=2, alike=False)

        self.assertEqual([(bar.end, bar.phase, bar.n) for bar in made], [(3, "stress", 2), (9, "motion", 1)])

    def test_are_joined_until_few_enough_are_left_and_no_task_is_lost(self):
        many = [Bar(k, k + 0.9, f"phase {k % 3}", "push", 1, 0.9) for k in range(5000)]

        left = timeline.fewer({(0, 0): many}, 5000, most=100)[0, 0]

        self.assertLessEqual(len(left), 100)
        self.assertEqual(sum(bar.n for bar in left), 5000)
        self.assertAlmostEqual(sum(bar.busy for bar in left), 4500)

    def test_stay_apart_where_there_are_few(self):
        lanes = {(0, 0): bars((0, 1), (1, 2))}

        self.assertEqual(timeline.fewer(lanes, 2), lanes)

    def test_stay_apart_where_each_lane_has_one_or_none_can_be_joined(self):
        single = {(0, k): bars((0, 1)) for k in range(8)}
        at_once = {(0, 0): bars((0, 1), (5, 6))}

        self.assertEqual(timeline.fewer(single, 2, most=5), single)
        self.assertEqual(timeline.fewer(at_once, 0, most=1), at_once)

    def test_of_many_lanes_are_those_of_the_first(self):
        many = {(0, k): bars((0, 1)) for k in range(1000)}

        self.assertEqual(len(timeline.first_lanes(timeline.Step(1, 1, many, 1))), timeline.MOST_LANES)


class Pictures(unittest.TestCase):
    DATA = {"materials": ["steel", "sand"],
            "pictures": [{"n": [3, 2], "size": 0.5, "materials": [1, 1, 1, -1, 0, 0], "time_s": 2e-3,
                          "speeds": [0, 1, 2, None, 30, 30], "slab": {"axis": "y", "at": 0.05},
                          "axes": [{"name": "x", "lower": 1, "upper": 2.5}, {"name": "z", "lower": 0, "upper": 1}]}]}

    def test_cover_all_squares_of_a_kind_once(self):
        random = np.random.default_rng(3)
        kinds = random.integers(-1, 3, (20, 30))

        for kind in range(3):
            covered = np.zeros_like(kinds)
            for row, end_row, column, end_column in particles.rectangles(kinds, kind):
                covered[row:end_row, column:end_column] += 1
            np.testing.assert_array_equal(covered, kinds == kind)

    def test_join_what_is_alike_to_one_rectangle(self):
        self.assertEqual(particles.rectangles(np.zeros((4, 5), int), 0), [(0, 4, 0, 5)])

    def test_say_what_is_where(self):
        materials, speeds = particles.views(self.DATA)

        self.assertEqual(particles.describe(materials),
                         "The particles at 2 ms, x across and z upwards: 2 colours. steel: 40 % of the area drawn, x "
                         "from 1.5 m to 2.5 m, z from 500 mm to 1 m. sand: 60 % of the area drawn, x from 1 m to "
                         "2.5 m, z from 0 m to 500 mm.")
        self.assertEqual(materials.caption, "Particles within half a cell of y = 50 mm.")
        self.assertEqual(speeds.names[0], "0 m/s to 5 m/s")
        self.assertEqual(speeds.names[-1], "25 m/s to 30 m/s")
        self.assertEqual(speeds.kinds.tolist(), [[0, 0, 0], [-1, 5, 5]])

    def test_of_speed_are_left_out_where_nothing_moves_or_nothing_is_known(self):
        for speed in [0, None]:
            data = {**self.DATA, "pictures": [{**self.DATA["pictures"][0], "speeds": [speed] * 6}]}
            self.assertEqual(len(particles.views(data)), 1)

    def test_are_drawn_in_colours_that_the_page_has(self):
        for view in particles.views(self.DATA):
            chart = particles.chart(view, "particles")
            self.assertIn("particles-kind-0", chart.wide.svg)
            self.assertNotRegex(picture.within_page(chart.wide), "(fill|stroke): #")


class Labels(unittest.TestCase):
    """Of ticks on the x axis."""

    def expect_whole_and_apart(self, sheet):
        sheet.figure.draw_without_rendering()
        boxes = [label.get_window_extent() for label in sheet.axis.get_xticklabels()]
        self.assertGreater(len(boxes), 1)
        self.assertLessEqual(max(box.x1 for box in boxes), sheet.layout.width)
        for box, following in zip(boxes, boxes[1:]):
            self.assertLess(box.x1, following.x0)

    def test_of_a_tall_plane_stand_apart_and_its_axes_are_as_wide_as_what_is_in_them(self):
        for layout in (axes.WIDE, over_time.HALF, axes.NARROW):
            for width, height in [(0.06, 0.12), (0.1, 0.5), (1, 0.8), (0.4, 0.4), (5, 0.1)]:
                plane = [{"name": "x", "lower": 0, "upper": width}, {"name": "y", "lower": 0, "upper": height}]
                sheet = particles.plane_sheet(layout, "a plane", plane, [])

                self.expect_whole_and_apart(sheet)
                box = sheet.axis.get_position()
                across, up = box.width * layout.width / width, box.height * sheet.height / height
                if box.height * sheet.height > 41:
                    self.assertAlmostEqual(across / up, 1)

    def test_over_time_end_before_the_picture_does(self):
        for layout in (over_time.HALF, axes.NARROW):
            for end in [0.02, 0.6, 123, 4e-7]:
                plot = over_time.Plot("a plot", "y", "J", [over_time.Line("a", [0, end], [0, 2])])
                self.expect_whole_and_apart(over_time.draw(plot, layout)[0])


class Choices(unittest.TestCase):
    def test_say_whether_the_scene_names_them(self):
        self.assertEqual(choices.source(["/transfer"], ["/transfer"]), "default")
        self.assertEqual(choices.source(["/transfer"], ["/transfer_other"]), "scene")
        self.assertEqual(choices.source(["/boundaries/x-", "/boundaries/x+"], ["/boundaries/x+"]), "scene and default")
        self.assertEqual(choices.source(["/output/fields"], ["/output"]), "default")
        self.assertEqual(choices.source(["/transfer"], None), "–")

    def test_of_one_word_share_a_row(self):
        word = {"word": "symmetry", "about": "", "meaning": "a `smooth` wall, see [method.md](method.md)"}
        words = [{"key": f"/boundaries/{face}", **word} for face in ["x-", "y+"]]

        self.assertEqual(choices.word_rows(words, []),
                         [["boundaries of x-, y+", "symmetry", "scene", "a smooth wall, see method.md"]])

    def test_that_are_explained_together_show_what_is_said_of_theirs(self):
        about = '`"even"`: in rows; `"round"`, of a `"ball"`: in rings; as `"even"` ones'

        self.assertEqual(choices.of_word(about, "even"), "in rows")
        self.assertEqual(choices.of_word(about, "round"), 'of a `"ball"`: in rings; as `"even"` ones')
        self.assertEqual(choices.of_word(about, "other"), about)
        words = [{"key": "/bodies/ball/particles", "word": "even", "about": about, "meaning": ""}]
        self.assertEqual(choices.word_rows(words, [])[0][-1], "in rows")

    def test_of_a_normal_take_no_word_for_a_material(self):
        pair = {"materials": ["steel", "sand"], "friction": 0.3}
        scene = {"materials": {"steel": {}, "sand": {}}, "contact": [{**pair, "normal": "solid"},
                                                                     {**pair, "normal": "sand"}]}

        self.assertEqual([row[-1] for row in choices.contact_rows(scene, [])],
                         ["its normal is that of the solid of the rigid body",
                          "its normal is that of the surface of sand"])

    def test_of_parts_name_what_they_are_of(self):
        self.assertEqual(choices.place("/materials/sand/modulus/type"), ("modulus type", "sand"))
        self.assertEqual(choices.place("/time/rule"), ("time rule", ""))

    def test_show_values_as_people_read_them(self):
        self.assertEqual(choices.value_text([2, 3], ""), "2 × 3")
        self.assertEqual(choices.value_text([0, -9.81], "m/s²"), "0, −9.81 m/s²")
        self.assertEqual(choices.value_text({"axis": [1, 0], "angular_speed": 6}, ""), "axis (1, 0); angular speed 6")
        self.assertEqual(choices.value_text(None, ""), "off")


class OverTime(unittest.TestCase):
    HISTORY = ("time[s],kinetic[J],total[J],punch.depth[m],punch.velocity_y[m/s],punch.contact_force_y[N],dt[s]\n"
               "0,9,9,0,-1,0,0\n1,8,9,1,-1,2000,1\n2,7,9,2,-1,3000,1\n")

    def plots(self, **scene):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "history.csv")
            path.write_text(self.HISTORY)
            run = {"history": run_page.History(path), "scene": {"axisymmetric": False, **scene} if scene else None}
        return {plot.title: plot for plot in run_page.penetration(run) + run_page.plots(run)}

    def test_forces_and_energies_of_plane_scenes_are_per_metre(self):
        plane = self.plots(dimension=2)
        for title, name in [("Energies", "energy"), ("Force on punch against its depth", "force")]:
            unit = {"energy": "J", "force": "N"}[name]
            self.assertEqual((plane[title].y_name, plane[title].y_unit),
                             (f"{name} per metre across the plane", f"{unit}/m"))
            for whole in [self.plots(dimension=3), self.plots(dimension=2, axisymmetric=True), self.plots()]:
                self.assertEqual((whole[title].y_name, whole[title].y_unit), (name, unit))
        self.assertEqual(plane["Depth"].y_unit, "m")
        self.assertIn("between 2 kN/m and 3 kN/m", over_time.describe(plane["Force on punch against its depth"]))

    def test_axes_end_at_round_numbers_or_a_little_beyond(self):
        for values, limits in [((0, 183), (0, 200)), ((-0.8, 183), (-0.8, 200)), ((-20, 183), (-50, 200)),
                               ((-10, -1), (-10, 0)), ((0, 203), (0, 203)), ((0, 240), (0, 250)), ((0, 0), (0, 1))]:
            self.assertEqual(over_time.round_limits(*values, over_time.SLACK), limits)
        self.assertEqual(over_time.round_limits(-0.8, 183), (-50, 200))

    def test_forces_are_drawn_through_a_blow_and_energies_whole(self):
        through = {title for title, plot in self.plots(dimension=3).items() if plot.through_blow}

        self.assertEqual(through, {"Force on punch against its depth"})


class Forces(unittest.TestCase):
    def test_are_those_on_the_whole_body(self):
        in_space, round_about = {"dimension": 3, "axisymmetric": False}, {"dimension": 2, "axisymmetric": True}
        quarter = {"part_of_whole": {"factor": 4, "planes": ["x-", "y-"]}}

        self.assertEqual(run_history.axes_of_force(in_space, {}), "xyz")
        self.assertEqual(run_history.axes_of_force(in_space, quarter), "z")
        self.assertEqual(run_history.axes_of_force(round_about, {}), "y")
        self.assertEqual(run_history.axes_of_force(None, None), "xyz")

    def test_on_a_round_body_are_along_its_axis(self):
        history = run_history.History.__new__(run_history.History)
        history.columns = {"time": [0, 1], "ball.depth": [0, 1], "ball.contact_force_x": [3, 3],
                           "ball.contact_force_y": [4, 4]}
        for is_round, force in [(True, 4), (False, 5)]:
            run = {"history": history, "scene": {"dimension": 2, "axisymmetric": is_round}}
            self.assertEqual(run_page.penetration(run)[0].lines[0].y, [force])
            self.assertEqual(max(run_history.greatest(history, run["scene"], [], "y" if is_round else "xyz").line.y),
                             force)

    def test_on_a_part_say_of_which_part(self):
        self.assertIn("those of 1/4 of the whole", run_page.part_of_whole({"part_of_whole": {"factor": 4}}))
        self.assertEqual(run_page.part_of_whole({"part_of_whole": {"factor": 1}}) + run_page.part_of_whole({}), "")


class Stresses(unittest.TestCase):
    def test_of_rigid_materials_are_not_drawn(self):
        history = run_history.History.__new__(run_history.History)
        history.columns = {"time": [0, 1], "dt": [0, 1], "steel.p_max": [0, 0], "sand.p_max": [0, 5]}
        scene = {"dimension": 3, "bodies": {"ball": {"material": "steel", "rigid": True},
                                            "sand": {"material": "sand", "rigid": False}}}
        for known, shown in [(scene, ["sand"]), (None, ["steel", "sand"])]:
            plots = {plot.title: plot for plot in run_page.plots({"history": history, "scene": known})}
            self.assertEqual([line.name for line in plots["Largest mean stress"].lines], shown)


class Tables(unittest.TestCase):
    def test_that_are_too_broad_for_a_phone_say_the_names_of_their_columns_to_the_style_sheet(self):
        broad = page.as_html(Table(["task", "count", 'a "b" <c>\\', "share"], [["push", "1", "2", "3"]]))
        table = Tags(broad).of("table")[0]

        self.assertEqual(table["class"], "broad-table")
        self.assertEqual(table["style"], '--column-2: "count "; --column-3: "a \\22 b\\22  \\3c c\\3e \\5c  "; '
                                         '--column-4: "share "')
        self.assertIn("<td>push</td><td>1</td>", broad)
        self.assertEqual(Tags(page.as_html(Table(["a", "b", "c"], [["1", "2", "3"]]))).of("table"), [{}])


class TheMemory(unittest.TestCase):
    def test_is_drawn_beside_what_was_expected_and_what_the_fields_take(self):
        machine = run_page.History.__new__(run_page.History)
        machine.columns = {"time": [0, 1e-3], "rss": [3e7, 4e7]}
        summary = {"ledger_peak_bytes": 3e6, "forecast": {"memory_bytes": None}}

        plot, = run_page.memory_plots(machine, run_page.memory_levels(summary))

        self.assertEqual([(line.name, line.y) for line in plot.lines],
                         [("resident, all ranks", [3e7, 4e7]), ("labels, at most", [3e6, 3e6])])

    def test_is_not_drawn_where_it_was_not_measured(self):
        self.assertEqual(run_page.memory_plots(None, []), [])


class TheSentence(unittest.TestCase):
    def test_of_a_run_without_a_trace_says_so(self):
        tags = Tags(run_page.one_step(None))

        self.assertEqual((tags.wrong, tags.open, tags.of("svg")), ([], [], []))
        self.assertIn("No step was traced", run_page.one_step(None))


class TheTimeOfSteps(unittest.TestCase):
    def test_is_not_to_be_trusted_of_a_machine_that_was_too_busy(self):
        profile = {"step_s": 1e-3, "longest_chain_s": 5e-4, "between_s": 1e-5, "overhead": 0.02}

        text = run_page.time_of_steps({**profile, "too_busy": True, "core_share": 0.6})

        self.assertIn("too busy to trust these times: other programs had its cores for 40", text)
        self.assertNotIn("too busy", run_page.time_of_steps({**profile, "too_busy": False, "core_share": 0.95}))
        self.assertNotIn("too busy", run_page.time_of_steps(profile))
