"""The command line, and how commands end."""

import argparse
import contextlib
import importlib
import io
import subprocess
import sys
import unittest

from tamp import failure, program
from tamp.__main__ import COMMANDS, summary


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
            done = subprocess.run([sys.executable, *how, "--help"], cwd=folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(all(f"  {name} " in done.stdout for name in COMMANDS))

    def test_one_that_there_is_not_is_refused(self):
        done = subprocess.run([sys.executable, "-m", "tamp", "fitt"], cwd=program.ROOT / "tools/python",
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("invalid choice: 'fitt'", done.stderr)


class Guard(unittest.TestCase):
    def test_a_standard_output_that_cannot_be_reconfigured_is_taken_as_it_is(self):
        """As ParaView's Python has it."""
        with contextlib.redirect_stdout(io.StringIO()) as out, self.assertRaises(SystemExit) as ended:
            failure.guard(lambda: print("drawn"))

        self.assertEqual((out.getvalue(), ended.exception.code), ("drawn\n", None))
