#!/usr/bin/env python3
"""The runtime, installed and moved, builds and runs the program of docs/tutorials/first_task_graph.md:

    tests/install/test_install.py BUILD [--cmake CMAKE] [--mpiexec MPIEXEC] [--compiler CXX]
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ANYWHERE = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}

options = argparse.Namespace()


def run(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


class InstalledRuntime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        first, cls.prefix = cls.folder / "first", cls.folder / "moved"
        run(options.cmake, "--install", options.build, "--component", "runtime", "--prefix", first)
        first.rename(cls.prefix)
        heat = shutil.copytree(ROOT / "docs/tutorials/first_task_graph", cls.folder / "tutorial")
        build = cls.folder / "build"
        run(options.cmake, "-S", ROOT / "tests/install", "-B", build, "-G", "Ninja", f"-DHEAT={heat}",
            f"-DINSTALLED={cls.prefix}", f"-DCMAKE_PREFIX_PATH={cls.prefix}",
            f"-DCMAKE_CXX_COMPILER={options.compiler}")
        run(options.cmake, "--build", build)
        cls.program = build / "heat/heat"

    def package(self):
        """The text of the package's CMake files."""
        files = list(self.prefix.glob("**/cmake/tamp_runtime/*.cmake"))
        self.assertGreaterEqual(len(files), 4)
        return "".join(file.read_text() for file in files)

    def test_heat_has_the_errors_of_its_page_on_one_rank_and_on_two(self):
        alone = run(self.program, self.folder / "alone")
        together = run(options.mpiexec, "-n", 2, self.program, self.folder / "together", env=os.environ | ANYWHERE)

        self.assertEqual(together, alone)
        coarse, fine, order, greatest, restarted = map(float, re.findall(r"\d+\.\d{3,}(?:e-\d+)?", alone))
        self.assertAlmostEqual(coarse, 1.17e-3, delta=5e-6)
        self.assertAlmostEqual(fine, 2.97e-4, delta=5e-7)
        self.assertAlmostEqual(order, 1.98, delta=5e-3)
        self.assertEqual(restarted, greatest)

    def test_it_asks_for_no_more_than_it_needs_and_for_no_flags(self):
        for word in ("CGAL", "CLI11", "Eigen", "SLEEF", "xxHash", "tamp_options", "-march", "-mcpu", "-ffp", "-fno",
                     "-W", "-fsanitize"):
            self.assertNotIn(word, self.package())

    def test_it_does_not_know_where_it_was_built(self):
        for path in (ROOT, options.build, self.folder / "first"):
            self.assertNotIn(str(path), self.package())

    def test_only_the_runtime_is_installed(self):
        self.assertEqual({path.name.removesuffix("64") for path in self.prefix.iterdir()}, {"include", "lib"})
        self.assertEqual([path.name for path in (self.prefix / "include").iterdir()], ["tamp"])
        self.assertFalse((self.prefix / "include/tamp/runtime/execute/scheduler").exists())

    def test_a_project_without_c_is_told_so(self):
        lists = self.folder / "without_c/CMakeLists.txt"
        lists.parent.mkdir()
        lists.write_text("cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
                         "find_package(tamp_runtime REQUIRED)\n")

        with self.assertRaisesRegex(AssertionError, "LANGUAGES C CXX"):
            run(options.cmake, "-S", lists.parent, "-B", lists.parent / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--cmake", default="cmake")
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--compiler", default="c++")
    parser.parse_args(namespace=options)
    unittest.main(argv=sys.argv[:1])
