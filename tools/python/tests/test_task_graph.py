"""The drawing and the page of a task graph, as the program makes them, are whole and say what its JSON says.

    cd tools/python; python3 -m tests.test_task_graph [--tamp build/release/tamp]"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from tamp import program
from tests.page_tags import Tags

SCENE = pathlib.Path(__file__).resolve().parents[3] / "inputs/punch/quick.json"
TAMP = program.USUAL
SVG = "{http://www.w3.org/2000/svg}"


def graph(*words):
    answer = subprocess.run([TAMP, "graph", SCENE, "--ranks", "2", *words], capture_output=True, text=True)
    assert answer.returncode == 0, answer.stderr
    return answer.stdout


class Drawing(unittest.TestCase):
    def test_is_xml_with_each_task_and_edge(self):
        folded = json.loads(graph("--format", "json"))["folded"]
        drawing = ElementTree.fromstring(graph("--format", "svg"))
        groups = drawing.findall(f"{SVG}g")
        tasks = {int(g.get("data-task")): g for g in groups if g.get("data-task")}
        edges = {int(g.get("data-edge")): g for g in groups if g.get("data-edge")}
        self.assertEqual(len(tasks), len(folded["tasks"]))
        self.assertEqual(len(edges), len(folded["edges"]))
        for number, task in enumerate(folded["tasks"]):
            self.assertEqual(tasks[number].find(f"{SVG}text").text, task["name"])
        for number, edge in enumerate(folded["edges"]):
            for label in edge["labels"]:
                self.assertIn(label["label"], edges[number].find(f"{SVG}title").text)

    def test_boxes_do_not_overlap(self):
        drawing = ElementTree.fromstring(graph("--format", "svg"))
        boxes = [[float(box.get(key)) for key in ("x", "y", "width", "height")] for box in drawing.iter(f"{SVG}rect")]
        for k, (x, y, width, height) in enumerate(boxes):
            for left, top, other_width, other_height in boxes[:k]:
                apart_x = x >= left + other_width or left >= x + width
                apart_y = y >= top + other_height or top >= y + height
                self.assertTrue(apart_x or apart_y, boxes[k])


class Page(unittest.TestCase):
    def test_is_whole_and_loads_nothing(self):
        tags = Tags(graph("--format", "html"))
        self.assertEqual((tags.wrong, tags.open), ([], []))
        self.assertEqual(tags.sources(), ["data:,"])

    def test_holds_the_instances_and_edges_of_the_dump(self):
        dump = json.loads(graph("--format", "json"))
        found = re.findall('<script type="application/json" id="(.*?)">(.*?)</script>', graph("--format", "html"), re.S)
        data = {name: json.loads(text) for name, text in found}
        self.assertEqual(data["folded"], dump["folded"])
        at = data["instances"]
        names = [data["folded"]["tasks"][task]["name"] for task in at["task"]]
        self.assertEqual(names, [task["name"] for task in dump["tasks"]])
        self.assertEqual(at["patch"], [task["patch"] for task in dump["tasks"]])
        self.assertEqual(at["rank"], [task["rank"] for task in dump["tasks"]])
        edges = []
        for to, back, reason in zip(at["edge_to"], at["edge_back"], at["edge_reason"]):
            label, halo, n_bytes, message = at["reasons"][reason]
            edges.append({"from": to - back, "to": to, "label": at["labels"][label], "halo": halo, "bytes": n_bytes,
                          "message": bool(message)})
        self.assertEqual(edges, dump["edges"])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    program.add_option(parser)
    options, rest = parser.parse_known_args()
    TAMP = options.tamp.resolve()
    unittest.main(argv=[sys.argv[0], *rest])
