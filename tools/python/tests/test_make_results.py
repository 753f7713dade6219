"""Tables that are made by a command: what a recipe takes from what is written, and what is refused.

    cd tools/python; python3 -m tests.test_make_results [--tamp build/release/tamp]"""

import argparse
import contextlib
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

from tamp import failure, program
from tamp.checks import kept_results
from tamp.research.make_results import command, recipe, runs
from tamp.research.make_results.table import rows_of_csv, rows_of_json, rows_of_markdown, table

TAMP = program.USUAL
SOUND = {"file": "points.csv", "columns": [{"name": "work [J]", "of": "work"}]}
POINTS = [
    {"method": "gimp, flip", "/grid/cell_size": "0.05", "work": "12.5", "core_s": "2.0", "steps": "100.0"},
    {"method": "gimp, flip", "/grid/cell_size": "0.025", "work": "13.25", "core_s": "9.0", "steps": "200.0"},
    {"method": "cpdi, flip", "/grid/cell_size": "0.05", "work": "", "core_s": "1.0", "steps": "100.0"},
]


def scratch(test):
    """A folder for one test."""
    place = tempfile.TemporaryDirectory()
    test.addCleanup(place.cleanup)
    return pathlib.Path(place.name)


class TheTable(unittest.TestCase):
    def refused(self, expected, wanted, rows=POINTS):
        with self.assertRaises(failure.Refusal) as ended:
            table(wanted, rows, "#/made_by")
        self.assertEqual(str(ended.exception), expected)

    def test_a_row_for_each_method_has_a_column_for_each_grid(self):
        def on(size):
            return {"name": f"on {size} m [kJ]", "of": "work", "where": {"/grid/cell_size": size}, "times": 1e-3,
                    "as": "{:.4f}"}

        names, rows = table({"by": ["method"], "columns": [
            {"name": "interpolator", "of": "method", "match": "(.*), flip", "words": {"gimp": "GIMP", "cpdi": "CPDI"}},
            on(0.05), on(0.025)]}, POINTS, "")

        self.assertEqual(names, ["interpolator", "on 0.05 m [kJ]", "on 0.025 m [kJ]"])
        self.assertEqual(rows, [["GIMP", "0.0125", "0.0132"], ["CPDI", "", ""]])

    def test_a_number_is_divided_by_another_and_what_is_missing_is_said_in_words(self):
        _, rows = table({"columns": [{"name": "s a step", "of": "core_s", "over": "steps", "plus": 1, "as": "{:.3f}"},
                                     {"name": "work", "of": "work", "or": "method", "as": "{:.1f}"}]}, POINTS, "")

        self.assertEqual(rows, [["1.020", "12.5"], ["1.045", "13.2"], ["1.010", "cpdi, flip"]])

    def test_rows_are_sorted_by_numbers_or_as_texts_come(self):
        columns = [{"name": "cells", "of": "/grid/cell_size"}, {"name": "method", "of": "method"}]

        _, rows = table({"columns": columns, "order": ["method", "cells"]}, POINTS, "")

        self.assertEqual(rows, [["0.025", "gimp, flip"], ["0.05", "gimp, flip"], ["0.05", "cpdi, flip"]])

    def test_rows_that_are_not_asked_for_are_left_out(self):
        _, rows = table({"where": {"method": ["gimp, flip"], "/grid/cell_size": 5e-2}, "columns": SOUND["columns"]},
                        POINTS, "")

        self.assertEqual(rows, [["12.5"]])

    def test_rows_become_one_by_a_key_of_the_recipe_s_own(self):
        keys = {"transfer": {"of": "method", "match": ".*, (.*)"}, "both": {"of": ["transfer", "transfer"]}}

        _, rows = table({"keys": keys, "by": ["transfer"], "columns": [
            {"name": "of all", "of": "both"}, {"name": "finest", "of": "work", "where": {"steps": 200}}]}, POINTS, "")

        self.assertEqual(rows, [["flip, flip", "13.25"]])

    def test_a_column_for_each_heading_and_a_row_for_each_heading(self):
        rows = [{"run": "a", "1 ms": "2 / 3", "2 ms": ""}, {"run": "b", "1 ms": "4 / 5", "2 ms": "6 / 7"}]

        wide = table({"columns": [{"name": "run", "of": "run"}, {"name": "at * ms", "of": "* ms"}]}, rows, "")
        _, long = table({"each": "* ms", "columns": [{"name": "run", "of": "run"}, {"name": "time [ms]", "of": "each"},
                                                     {"name": "nose", "of": "cell", "match": "(.*) / .*"}]}, rows, "")

        self.assertEqual(wide, (["run", "at 1 ms", "at 2 ms"], [["a", "2 / 3", ""], ["b", "4 / 5", "6 / 7"]]))
        self.assertEqual(long, [["a", "1", "2"], ["b", "1", "4"], ["b", "2", "6"]])

    def test_what_is_not_there_is_refused_by_name(self):
        self.refused('#/made_by/columns/0/of: no "depth"; expected one of method, /grid/cell_size, work, core_s, steps',
                     {"columns": [{"name": "depth", "of": "depth"}]})
        self.refused("#/made_by/where: no row; expected some in what the command has written",
                     {**SOUND, "where": {"method": "linear"}})

    def test_two_answers_for_a_cell_are_refused(self):
        self.refused("#/made_by/columns/0: 2 answers, 12.5, 13.25; expected one, by where or by",
                     {**SOUND, "where": {"method": "gimp, flip"}, "by": ["method"]})

    def test_a_word_or_a_number_that_was_not_foreseen_is_refused(self):
        self.refused('#/made_by/columns/0/words: "gimp, flip" in method; expected one of cpdi',
                     {"columns": [{"name": "method", "of": "method", "words": {"cpdi": "CPDI"}}]})
        self.refused(f'#/made_by/columns/0: "gimp, flip" in method of {POINTS[0]}; expected a number',
                     {"columns": [{"name": "method", "of": "method", "as": "{:.1f}"}]})


class Rows(unittest.TestCase):
    def test_of_csv_have_no_apostrophes_against_formulas(self):
        file = scratch(self) / "points.csv"
        file.write_text("method,error\n\"'-gimp, flip\",0.1\n'a',\n")

        self.assertEqual(rows_of_csv(file), [{"method": "-gimp, flip", "error": "0.1"}, {"method": "'a'", "error": ""}])

    def test_of_json_have_what_is_beside_their_list(self):
        file = scratch(self) / "all.json"
        file.write_text('{"studies": [{"name": "bar", "gates": [{"holds": false, "at": {"a/b": 1e-3}, "why": null}]}]}')

        self.assertEqual(rows_of_json(file, "/studies/*/gates"),
                         [{"/name": "bar", "/holds": "false", "/at/a~1b": "0.001", "/why": ""}])
        for at in ("/studies/*/points", "/studies/*", "/name"):
            self.assertRaises(failure.Failure, rows_of_json, file, at)

    def test_of_markdown_know_heading_and_the_line_above(self):
        text = ("### bar: a bar\n\nway, error by x:\n\n| a | b |\n| --- | --: |\n| `x` | |\n\n"
                "### ring\n| a |\n|---|\n| 3 |\n")

        self.assertEqual(rows_of_markdown("", text, "bar: *"),
                         [{"heading": "bar: a bar", "above": "way, error by x:", "a": "x", "b": ""}])
        self.assertEqual([row["a"] for row in rows_of_markdown("", text, "*")], ["x", "3"])
        for broken in ("| a | a |\n", "| a |\n| b | c |\n"):
            self.assertRaises(failure.Failure, rows_of_markdown, "", broken, "*")


class TheRecipe(unittest.TestCase):
    def faults(self, made_by, command="tamp study inputs/studies/bar.json", others=()):
        return recipe.faults({"command": command, "made_by": made_by}, others)

    def test_a_sound_one_has_no_faults(self):
        self.assertEqual(self.faults(SOUND), [])
        self.assertEqual(self.faults({"like": "a.csv", "at": "/x"}, others=[{"file": "a.csv", "made_by": SOUND}]), [])
        self.assertEqual(self.faults({**SOUND, "file": "printed"}, "/usr/bin/python3 tools/python/tamp companion"), [])

    def test_what_is_wrong_has_its_pointer(self):
        columns = [{"name": "x", "of": "y", "as": "{:q}"}, {"of": "* m"}, {"name": "*", "of": "y"}, 3]
        for made_by, places in [
            ({"columns": []}, ["/made_by: no \"file\"", "/made_by/columns: []"]),
            ({**SOUND, "file": "../x.csv", "kind": 1}, ["/made_by/kind: unknown", "/made_by/file: '../x.csv'"]),
            ({**SOUND, "columns": columns}, ["/made_by/columns/0/as: '{:q}'", '/made_by/columns/1: no "name"',
                                             "/made_by/columns/2/name: '*'", "/made_by/columns/3: 3"]),
            ({**SOUND, "keys": {"a": {"of": "b", "match": "("}}}, ["/made_by/keys/a/match: '('"]),
            ({**SOUND, "where": {"a": []}, "order": ["depth"]}, ["/made_by/order/0: 'depth'"]),
            ({"like": "other.csv"}, ["/made_by/like: 'other.csv'"]), (["bar"], ["/made_by: ['bar']"]),
        ]:
            found = self.faults(made_by)
            self.assertEqual([fault.partition("; expected ")[0] for fault in found], places)

    def test_a_command_that_cannot_be_run_as_it_stands_is_found(self):
        for words in ["tamp verify; and others", "tamp_tasks_tests -s", "tamp study 'x", "not stated", "tamp plot x"]:
            found = self.faults(SOUND, words)
            self.assertTrue(found[0].startswith(f"/command: {words!r}; expected tamp and one of bench, compare"), found)
        for words in ["tamp study x.json --short", "tamp verify bar --steps 3", "tamp run x.json --out /tmp/x"]:
            word = words.split()[3]
            self.assertEqual(self.faults(SOUND, words), [f"/command: {word}; expected the whole command, without what "
                                                         "the making adds"])


@unittest.skipUnless(shutil.which("git"), "no git")
class AFolder(unittest.TestCase):
    """A folder of results with one table, which a program of our own makes."""

    def setUp(self):
        self.place = scratch(self)
        # A history of one commit, as a copy of the sources may have none.
        history = {"GIT_DIR": str(self.place / "git"), "GIT_WORK_TREE": str(self.place)}
        patch = unittest.mock.patch.dict(os.environ, history)
        patch.start()
        self.addCleanup(patch.stop)
        subprocess.run(["git", "init", "--quiet"], check=True)
        subprocess.run(["git", "-c", "user.name=nobody", "-c", "user.email=nobody@localhost", "commit", "--quiet",
                        "--allow-empty", "--message", "Nothing"], check=True)
        self.results = self.place / "results"
        self.results.mkdir()
        self.entry = {"file": "work.csv", "title": "Work", "command": "tamp drive sand.json path.csv",
                      "program": "0123456789ab", "date": "2026-11-25", "processor": "not stated",
                      "instructions": "AVX2", "inputs": {"inputs/gone.json": "0" * 64},
                      "made_by": {"file": "drive.csv", "columns": [{"name": "work [kJ]", "of": "work[J]", "times": 1e-3,
                                                                    "as": "{:.1f}"}]}}
        (self.results / "work.csv").write_text("work [kJ]\n1.0\n")

    def make(self, drive, commit="HEAD", kept=None):
        """Lets a script of the shell stand for the program. `drive` is what it does where $last is to be written."""
        profile = {"machine": {"commit": commit, "processor": "A", "cores": 2, "instruction_set": "AVX-512"}}
        tamp = self.place / "tamp"
        tamp.write_text(f"""#!/bin/sh
for last; do :; done
case $1 in
  new) ;;
  run) while [ $1 != --out ]; do shift; done; mkdir $2; echo '{json.dumps(profile)}' > $2/profile.json ;;
  *) {drive} ;;
esac
""")
        tamp.chmod(0o755)
        (self.results / "index.json").write_text(json.dumps([self.entry], indent=2) + "\n")
        options = types.SimpleNamespace(names=["*"], kept=kept, out=self.place / "out", results=self.results, tamp=tamp)
        with contextlib.redirect_stdout(io.StringIO()) as out:
            command.main(options)
        return out.getvalue()

    def refused(self, expected, *words, **how):
        """That the making is refused, and leaves all as it was."""
        (self.results / "index.json").write_text(json.dumps([self.entry], indent=2) + "\n")
        before = {path.name: path.read_text() for path in self.results.iterdir()}
        with self.assertRaises(failure.Refusal) as ended:
            self.make(*words, **how)
        self.assertIn(expected, str(ended.exception))
        self.assertEqual({path.name: path.read_text() for path in self.results.iterdir()}, before)

    def test_a_table_and_its_entry_are_written(self):
        said = self.make("printf 'work[J],x\\n2500,1\\n' > $last")

        entry = json.loads((self.results / "index.json").read_text())[0]
        self.assertEqual((self.results / "work.csv").read_text(), "work [kJ]\n2.5\n")
        self.assertIn("work.csv: 1 rows; 1 cells differ", said)
        self.assertEqual([entry[key] for key in ("processor", "instructions")], ["A, 2 cores", "AVX-512"])
        self.assertRegex(entry["program"], "^[0-9a-f]{12}$")
        self.assertEqual((list(entry), entry["title"], entry["inputs"]), (list(self.entry), "Work", {}))
        self.assertEqual(kept_results.faults(self.results), [])

    def test_a_new_entry_gets_all_that_it_lacks(self):
        self.entry = {key: self.entry[key] for key in ("file", "title", "command", "made_by")}
        (self.results / "work.csv").unlink()

        self.make("printf 'work[J]\\n2500\\n' > $last")

        self.assertEqual(kept_results.faults(self.results), [])

    def test_a_program_that_fails_leaves_all_as_it_was(self):
        self.refused("exit code 4: no room", "printf 'work[J]\\n25' > $last; echo no room >&2; exit 4")
        self.refused("exit code -9", "kill -9 $$")

    def test_output_that_is_another_leaves_all_as_it_was(self):
        self.refused("drive.csv: no such file", ":")
        self.refused('index.json#/0/made_by/columns/0/of: no "work[J]"; expected one of study, depth[m]',
                     "printf 'depth[m]\\n1\\n' > $last")

    def test_a_program_that_the_index_cannot_name_is_refused(self):
        work = "printf 'work[J]\\n2500\\n' > $last"
        self.refused("built of sources that differ from commit 0123456789", work, commit="0123456789+")
        self.refused("which git does not know here", work, commit="0" * 40)
        self.refused("built without git", work, commit="")

    def test_a_recipe_with_a_fault_or_none_is_refused(self):
        self.entry["made_by"]["columns"][0]["times"] = "1e-3"
        self.refused("index.json#/0/made_by/columns/0/times: '1e-3'; expected a number", ":")
        del self.entry["made_by"]
        self.refused("index.json: * was collected by hand; expected a table with made_by", ":")

    def test_a_folder_without_the_study_is_refused(self):
        self.entry |= {"command": "tamp study inputs/studies/bar.json", "made_by": SOUND}
        self.refused("no study.json of bar", ":", kept=self.place)


class TheIndex(unittest.TestCase):
    def test_faults_of_recipes_are_faults_of_the_results(self):
        folder = scratch(self)
        (folder / "work.csv").write_text("work\n1\n")
        entry = {"file": "work.csv", "title": "Work", "command": "tamp study a.json", "program": "0123456789ab",
                 "date": "2026-11-25", "processor": "A", "instructions": "AVX2", "inputs": {}}
        for made_by, what in [
            (SOUND, "index.json#/0/made_by/columns: other names than work; expected those"),
            ({**SOUND, "by": "work"}, "index.json#/0/made_by/by: 'work'; expected a list of texts"),
            ({**SOUND, "columns": [{"name": "work", "of": "work"}]}, None),
        ]:
            (folder / "index.json").write_text(json.dumps([{**entry, "made_by": made_by}]))
            self.assertEqual(kept_results.faults(folder), [("work.csv", what)] if what else [])


@unittest.skipUnless(TAMP.exists() or "--tamp" in sys.argv, f"no {TAMP}")
class TheProgram(unittest.TestCase):
    """An entry of the failure catalogue, run by the program."""

    def make(self, *, kept=None):
        options = types.SimpleNamespace(names=["spin.csv"], kept=kept, out=self.place.with_name("out"),
                                        results=self.place, tamp=TAMP)
        # Also where it is built of sources that have changed.
        commit = unittest.mock.patch.object(command, "commit_of", return_value="0123456789ab")
        with commit, contextlib.redirect_stdout(io.StringIO()) as out:
            command.main(options)
        return out.getvalue()

    def test_makes_a_table_and_finds_the_same_again_in_its_folder(self):
        self.place = scratch(self) / "results"
        self.place.mkdir()
        (self.place / "index.json").write_text(json.dumps([{
            "file": "spin.csv", "title": "A spin", "command": "tamp stability lost_spin", "made_by": {
                "file": "stability.json", "at": "/entries", "columns": [
                    {"name": "entry", "of": "/name"}, {"name": "fails", "of": "/fails/method"},
                    {"name": "error", "of": "/fails/error", "as": "{:.2g}"}]}}]))

        self.make()

        self.assertEqual((self.place / "spin.csv").read_text(), "entry,fails,error\nlost_spin,flip,0.42\n")
        self.assertEqual(kept_results.faults(self.place), [])
        entry = json.loads((self.place / "index.json").read_text())[0]
        self.assertEqual(list(entry["inputs"]),
                         ["inputs/stability/lost_spin.json", "inputs/stability/scenes/spin.json"])
        self.assertEqual(kept_results.changed_inputs(entry, program.ROOT), [])
        folder = self.place.with_name("out") / "stability-lost_spin"
        points = {path: path.stat().st_mtime_ns for path in folder.glob("lost_spin/points/*/result.json")}

        said = self.make(kept=folder)

        self.assertIn("1 rows; 0 cells differ", said)
        self.assertEqual({path: path.stat().st_mtime_ns for path in points}, points)
        self.refuses_what_is_not_the_same(folder)

    def refuses_what_is_not_the_same(self, folder):
        report, summary = folder / "lost_spin/study.json", next(folder.glob("lost_spin/points/*/summary.json"))
        for file, before, now, expected in [
            (summary, runs.hash_of(program.INPUTS / "stability/scenes/spin.json"), "0" * 16, "changed since"),
            (report, "lost_spin.json", "lost_spin.json --steps 3", "run with --steps; expected the whole study"),
            (report, "stability/lost_spin.json", "studies/lost_spin.json", "expected a run of"),
            (report, '"name"', '"names"', 'no "name"'),
            (report.with_name(".tamp-study"), '"version"', '"versions"', "results of another program or processor"),
        ]:
            text = file.read_text()
            file.write_text(text.replace(before, now))
            with self.assertRaises(failure.Refusal) as ended:
                self.make(kept=folder)
            self.assertIn(expected, str(ended.exception))
            file.write_text(text)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    program.add_option(parser)
    options, rest = parser.parse_known_args()
    TAMP = options.tamp.resolve()
    unittest.main(argv=[sys.argv[0], *rest])
