"""The command line, and how commands end."""

import argparse
import contextlib
import importlib
import io
import pathlib
import subprocess
import sys
import unittest

from tamp import failure, program
from tamp.__main__ import COMMANDS, FOR_USERS, summary
from tamp.checks import forecasts


class Commands(unittest.TestCase):
    def test_every_command_says_what_it_does_and_takes(self):
        for name, module in COMMANDS.items():
            with self.subTest(name):
                try:
                    command, parser = importlib.import_module(f"tamp.{module}"), argparse.ArgumentParser()
                except ModuleNotFoundError as error:
                    self.assertIsNotNone(failure.package_of(error))
                    continue
                command.add_arguments(parser)
                self.assertIn("--help", parser.format_help())
                self.assertTrue(callable(command.main))
                self.assertRegex(summary(module), r"^[A-Z].*\.$")

    def test_they_are_called_by_the_folder_and_as_a_module(self):
        for how, folder in ((["tools/python/tamp"], program.ROOT), (["-m", "tamp"], program.ROOT / "tools/python")):
            for words, names in ((["--help"], FOR_USERS), (["--help", "--all"], COMMANDS)):
                done = subprocess.run([sys.executable, *how, *words], cwd=folder, capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual([name for name in COMMANDS if f"  {name} " in done.stdout], list(names))

    def test_one_that_there_is_not_is_refused(self):
        done = subprocess.run([sys.executable, "-m", "tamp", "fitt"], cwd=program.ROOT / "tools/python",
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("invalid choice: 'fitt'", done.stderr)

    def test_a_scene_or_a_page_that_there_is_not_is_refused_before_anything_runs(self):
        for words in [["forecasts", "nope", "--tamp", "/no/program"], ["look-at-page", "nope", "/no/folder"]]:
            done = subprocess.run([sys.executable, "-m", "tamp", *words], cwd=program.ROOT / "tools/python",
                                  capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertEqual(done.stderr, f"{failure.PROGRAM}: nope: no such file\n")

    def test_a_scene_of_ones_own_is_named_by_its_path(self):
        self.assertEqual(forecasts.shown(program.INPUTS / "punch/quick.json"), pathlib.Path("punch/quick.json"))
        self.assertEqual(forecasts.shown(pathlib.Path("/own/ball.json")), pathlib.Path("/own/ball.json"))


class TheProgram(unittest.TestCase):
    def test_what_it_refuses_is_refused_and_all_else_is_a_failure(self):
        for code, raised in [(2, failure.Refusal.code), (3, failure.Failure.code), (4, failure.Failure.code)]:
            with self.assertRaises(failure.Refusal) as ended:
                program.call("sh", "-c", f"echo tamp: why >&2; exit {code}")
            self.assertEqual((ended.exception.code, str(ended.exception)), (raised, f"sh: exit code {code}: tamp: why"))


class Guard(unittest.TestCase):
    def test_a_standard_output_that_cannot_be_reconfigured_is_taken_as_it_is(self):
        """As ParaView's Python has it."""
        with contextlib.redirect_stdout(io.StringIO()) as out, self.assertRaises(SystemExit) as ended:
            failure.guard(lambda: print("drawn"))

        self.assertEqual((out.getvalue(), ended.exception.code), ("drawn\n", None))
