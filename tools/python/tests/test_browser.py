"""The pages of a run, a task graph and a drive, opened in a browser: nothing on the console, and all is drawn.

    cd tools/python; python3 -m tests.test_browser [--tamp build/release/tamp]

Ends with exit code 77, as skipped, where there is no Chromium."""

import argparse
import html
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from tamp import program
from tamp.charts.formatting import si_text
from tamp.checks import look_at_page
from tests.page_tags import Tags

SCENE = program.INPUTS / "punch/quick.json"
TAMP = program.USUAL
BROWSERS = ["chromium", "chromium-browser", "google-chrome"]
BROWSER = next((found for found in map(shutil.which, BROWSERS) if found), None)
SKIPPED = 77
PHONE, HEIGHT = 390, 2000
MOST_BYTES = 5_000_000  # of a report
INTERVAL = 1e-5  # s, between outputs of fields

# Takes the slider of a page to each of its times, then to the start and by the button to the end, and leaves in the
# body of the outer page what is shown each time.
MOVE = """<!DOCTYPE html><html><body><iframe src="PAGE" style="width:900px;height:900px"></iframe><script>
const frame = document.querySelector("iframe");
frame.onload = async () => {
  const page = frame.contentDocument, seen = [];
  const slider = page.querySelector("input[type=range]");
  const look = async () => {
    const image = page.querySelector(".quantity:not([hidden]) .drawing.broad img");
    if (!image.complete) await new Promise(done => image.addEventListener("load", done, {once: true}));
    seen.push({at: Number(slider.value), picture: image.src.split(",")[1], width: image.naturalWidth,
               said: page.querySelector("output").textContent});
  };
  const move = async to => {
    slider.value = to;
    slider.dispatchEvent(new Event("input"));
    await look();
  };
  for (let k = 0; k <= Number(slider.max); ++k) await move(k);
  await move(0);
  page.querySelector("button").click();
  while (page.querySelector("button").textContent === "Stop") await new Promise(done => setTimeout(done, 50));
  await look();
  document.body.textContent = JSON.stringify(seen);
};
</script></body></html>
"""


def made(*words):
    done = subprocess.run([TAMP, *words], capture_output=True, text=True, env=program.ENVIRONMENT)
    assert done.returncode == 0, done.stderr


class Opened:
    """A page as a browser has it: its elements after the scripts have run, and what the console said."""

    def __init__(self, page, part="", flags=()):
        with tempfile.TemporaryDirectory() as folder:
            done = look_at_page.chromium(BROWSER, folder, page.resolve().as_uri() + part, [*flags, "--dump-dom"])
        self.complaints, self.text = look_at_page.complaints(done), done.stdout

    def count(self, pattern):
        return len(re.findall(pattern, self.text))


def moved(page, folder):
    """What the picture and the words of a report are at each time of its slider, at the start again, and at the end to
    which its button has led."""
    outer = folder / "moved.html"
    outer.write_text(MOVE.replace("PAGE", page.resolve().as_uri()))
    opened = Opened(outer)
    seen = re.search(r"<body>(\[.*\])</body>", opened.text)
    return opened.complaints, json.loads(html.unescape(seen[1])) if seen else []


def shows(seen, pictures):
    """Whether the slider, and then the button, have led through these pictures to the last one."""
    shown = [one["picture"] for one in seen if one["width"] > 0]
    return shown == [*pictures, pictures[0], pictures[-1]]


def from_elsewhere(text):
    """What a page would load that is not in it."""
    links = [link for link in Tags(text).sources() if link and not link.startswith(("data:", "#"))]
    styles = re.findall(r"@import[^;]*|url\((?![\"']?(?:#|data:))[^)]*\)", text)
    scripts = re.findall(r"\b(?:fetch|import|importScripts|EventSource|WebSocket|Worker|XMLHttpRequest)\(", text)
    return links + styles + scripts


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.report, cls.graph = cls.folder / "run/report.html", cls.folder / "graph.html"
        made("run", SCENE, "--steps", "60", "--quiet", "--out", cls.folder / "run",
             "--set", f"/output/fields_interval={INTERVAL}")
        made("profile", cls.folder / "run", "--format", "html")
        made("graph", SCENE, "--run", cls.folder / "run", "--format", "html", "--out", cls.graph)

        cls.drive = cls.folder / "drive.html"
        made("drive", program.INPUTS / "materials/concrete-sand/table.json", "--test", "triaxial", "--plot", cls.drive)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def looks(self, page, part=""):
        for name, (width, flags) in look_at_page.LOOKS.items():
            opened = Opened(page, part, [*flags, f"--window-size={max(width, 500)},{HEIGHT}"])
            self.assertEqual(opened.complaints, [], name)
            yield opened

    def test_the_report_has_each_chart_twice_and_its_pictures_and_tasks(self):
        tasks = json.loads((self.folder / "run/profile.json").read_text())["tasks"]
        for opened in self.looks(self.report):
            n_charts = opened.count('<figure class="chart"') + opened.count('class="quantity"')
            self.assertGreaterEqual(n_charts, 11)
            self.assertEqual(opened.count('<svg [^>]*role="img"'), 2 * n_charts)
            self.assertGreaterEqual(opened.count(r'id="particles-\d-kind-\d"'), 5)
            self.assertGreater(opened.count(r'id="timeline-bar-\d+"'), 100)
            self.assertIn("</html>", opened.text)
            for task in tasks:
                self.assertIn(f"<td>{task['name']}</td>", opened.text)

    @unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not here")
    def test_the_slider_of_the_report_shows_the_last_output_in_the_quantity_that_is_chosen(self):
        for opened in self.looks(self.report):
            self.assertEqual(opened.count('class="quantity" data-quantity="p">'), 1)
            self.assertEqual(opened.count('class="quantity" data-quantity="[a-z_]+" hidden'), 2)
            shown = re.findall('<img alt="" style="[^"]*" src="data:image/png;base64,[^"]+"', opened.text)
            self.assertEqual(len(shown), 2)
            self.assertEqual(opened.count("<output>[^<]*contact force on punch"), 1)
            self.assertEqual(opened.count('<div class="controls">'), 1)

    @unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not here")
    def test_the_slider_of_the_report_leads_through_all_pictures_to_the_last_output(self):
        import h5py
        with h5py.File(self.folder / "run/fields.h5") as file:
            times = sorted(float(output.attrs["time"][()]) for output in file.values())
        text = self.report.read_text(encoding="utf-8")
        data = json.loads(re.search('id="movie-data">(.*?)</script>', text, re.DOTALL)[1])

        complaints, seen = moved(self.report, self.folder)

        self.assertEqual(complaints, [])
        self.assertGreater(len(times), 4)
        self.assertEqual([one["at"] for one in seen], [*range(len(times)), 0, len(times) - 1])
        self.assertTrue(shows(seen, data["pictures"]["p"]))
        self.assertEqual(len({one["picture"] for one in seen}), len(times))
        for one, time in zip(seen, [*times, times[0], times[-1]]):
            self.assertEqual(one["said"].split(";")[0], si_text(time, "s"))

    @unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not here")
    def test_a_slider_that_does_not_move_its_picture_is_found_out(self):
        text = self.report.read_text(encoding="utf-8")
        pictures = json.loads(re.search('id="movie-data">(.*?)</script>', text, re.DOTALL)[1])["pictures"]["p"]
        still = self.folder / "still.html"
        for was, becomes in [("data.pictures[chosen][k]", "data.pictures[chosen][0]"),
                             ("const k = Number(slider.value);", "const k = Math.min(slider.value, slider.max - 1);")]:
            self.assertIn(was, text)
            still.write_text(text.replace(was, becomes), encoding="utf-8")
            self.assertFalse(shows(moved(still, self.folder)[1], pictures), becomes)

    def test_the_report_is_one_small_file_that_loads_nothing(self):
        text = self.report.read_text(encoding="utf-8")

        self.assertLess(self.report.stat().st_size, MOST_BYTES)
        self.assertEqual(from_elsewhere(text), [])
        for added in ['<img src="picture.png">', '<script src="https://example.org/a.js"></script>',
                      "<style>@import 'a.css';</style>", '<p style="background: url(a.png)">',
                      "<script>fetch(1)</script>"]:
            self.assertEqual(len(from_elsewhere(text.replace("</body>", added + "</body>"))), 1, added)

    def test_the_page_of_a_drive_has_each_curve_twice(self):
        for opened in self.looks(self.drive):
            self.assertEqual(opened.count('<svg [^>]*role="img"'), 8)
            self.assertEqual(opened.count(r'id="[a-z-]+-line"'), 8)

    def test_the_report_and_its_tables_are_no_wider_than_a_phone(self):
        outer = self.folder / "phone.html"
        outer.write_text(look_at_page.framed(self.report, PHONE, HEIGHT))

        opened = Opened(outer, flags=[f"--window-size=500,{HEIGHT}"])

        self.assertEqual(opened.complaints, [])
        self.assertIn(", 0 tables cut off, 0 pixels too wide</title>", opened.text)

    def test_the_script_of_the_graph_shows_a_task_with_a_button_for_each_instance(self):
        made("graph", SCENE, "--format", "json", "--out", self.folder / "graph.json")
        tasks = json.loads((self.folder / "graph.json").read_text())["folded"]["tasks"]
        for opened in self.looks(self.graph, "#t0"):
            self.assertGreater(opened.count("<rect"), 20)
            self.assertEqual(opened.count('<button class="place'), tasks[0]["instances"])
            self.assertIn("<h3>Measured</h3>", opened.text)

    def test_a_page_whose_script_throws_is_found_out(self):
        for script in ["throw new Error('thrown')", "nothing.there()", "console.error('said')", "let let = 1"]:
            page = self.folder / "wrong.html"
            page.write_text(f"<!DOCTYPE html><title>wrong</title><script>{script}</script>")
            self.assertEqual(len(Opened(page).complaints), 1, script)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    program.add_option(parser)
    options, rest = parser.parse_known_args()
    TAMP = options.tamp.resolve()
    if BROWSER is None:
        print("skipped: there is no Chromium (Debian: chromium)")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1] + rest)
