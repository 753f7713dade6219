"""results/, its index, and what the check of both says of broken ones."""

import contextlib
import hashlib
import io
import json
import pathlib
import tempfile
import types
import unittest

from tamp import failure
from tamp.checks import kept_results

SOUND = {"file": "a/bar.csv", "title": "A bar", "command": "tamp verify bar", "program": "0123456789ab",
         "date": "2026-11-25", "processor": "not stated", "instructions": "AVX2", "inputs": {}}


class TheResults(unittest.TestCase):
    def test_each_table_is_in_the_index_and_is_sound(self):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            code = kept_results.main(types.SimpleNamespace(folder=kept_results.FOLDER))

        self.assertEqual(code, 0, out.getvalue())
        print(out.getvalue(), end="")  # the results whose inputs have changed since


class ABrokenFolder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)

    def faults(self, entries, tables):
        for name, text in tables.items():
            path = self.folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        (self.folder / "index.json").write_text(json.dumps(entries))
        return kept_results.faults(self.folder)

    def test_a_sound_one_has_no_faults(self):
        self.assertEqual(self.faults([SOUND], {"a/bar.csv": 'method,"error, of all"\ngimp,1e-3\n'}), [])

    def test_a_table_that_is_not_in_the_index_is_found(self):
        found = self.faults([SOUND], {"a/bar.csv": "x\n1\n", "a/ring.csv": "x\n1\n"})
        self.assertEqual(found, [("a/ring.csv", "not in index.json")])

    def test_an_entry_without_its_table_is_found(self):
        self.assertEqual(self.faults([SOUND], {}), [("a/bar.csv", "no such file")])

    def test_an_entry_that_lacks_what_it_needs_is_found(self):
        without = {key: value for key, value in SOUND.items() if key != "command"}
        found = self.faults([{**without, "program": "yesterday", "inputs": {"inputs/bar.json": "12"}}],
                            {"a/bar.csv": "x\n1\n"})
        self.assertEqual([what for _, what in found],
                         ['no "command"', "\"program\" is 'yesterday'", "inputs/bar.json: no SHA-256"])

    def test_an_index_that_is_no_list_or_no_json_is_refused(self):
        self.assertEqual(self.faults({}, {}), [("index.json", "no list of results")])
        self.assertEqual(self.faults(["bar"], {})[0], ("index.json, entry 0", "no object"))
        (self.folder / "index.json").write_text("[")
        self.assertRaises(failure.Refusal, kept_results.faults, self.folder)

    def test_a_table_that_is_not_rectangular_is_found(self):
        found = self.faults([SOUND], {"a/bar.csv": "x,y,\n1,2,3\n1,2\n"})
        self.assertEqual(found, [("a/bar.csv", "row 3: 2 cells instead of 3"), ("a/bar.csv", "column 3 has no name")])

    def test_prose_is_found(self):
        self.assertEqual(self.faults([SOUND], {"a/bar.csv": "x\n1\n", "README.md": "Results"}),
                         [("README.md", "not in index.json"), ("README.md", "neither CSV nor JSON")])

    def test_inputs_that_have_changed_or_gone_are_listed(self):
        (self.folder / "same.json").write_text("{}")
        (self.folder / "other.json").write_text("{ }")
        known = hashlib.sha256(b"{}").hexdigest()
        entry = {**SOUND, "inputs": {name: known for name in ["same.json", "other.json", "gone.json"]}}

        self.assertEqual(kept_results.changed_inputs(entry, self.folder), ["other.json", "gone.json"])


if __name__ == "__main__":
    unittest.main()
