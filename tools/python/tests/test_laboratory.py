"""From a laboratory's files to curves: right where they are read, and one line where they are refused.

    cd tools/python; python3 -m tests.test_laboratory [--tamp build/release/tamp]"""

import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

from tamp import program
from tamp.failure import PROGRAM
from tests import a_sand as sand

TAMP = program.USUAL
NOISY_SEED = 2
USUAL = [sand.test_text(peak) for peak in sand.PEAKS]


class Laboratory(unittest.TestCase):
    def setUp(self):
        keeper = tempfile.TemporaryDirectory()
        self.addCleanup(keeper.cleanup)
        self.folder = pathlib.Path(keeper.name)
        self.out = self.folder / "sand"

    def made_of(self, *texts, words=("--strain", "percent", "--pressure", "MPa"), tamp=None):
        paths = sand.write_tests(self.folder, texts)
        return sand.call("import", *words, "--tamp", tamp or TAMP, "--out", self.out, *paths)

    def expect_right(self, answer):
        """Peaks, plastic strains, and the bulk modulus at zero pressure as TAMP has it."""
        self.assertEqual(answer.code, 0, answer.err)
        peak = max(sand.PEAKS)
        self.assertEqual(sand.read(self.out / "hydrostat.csv")[-1], [peak / 100, 1e6 * round(sand.loading(peak), 5)])
        unloading = sand.read(self.out / "unloading.csv")
        for strain in sand.PEAKS:
            plastic = sand.PLASTIC * strain / 100
            self.assertAlmostEqual(min(abs(row[0] - plastic) for row in unloading), 0, delta=1e-6)
        words = [TAMP, "modulus", self.out / "unloading.csv", "--at", f"0,{sand.PLASTIC * peak / 100!r}"]
        shown = subprocess.run(words, capture_output=True, text=True).stdout.splitlines()[1].split(",")
        modulus = sand.FIRST_SHARE * 1e6 * sand.loading(peak) / ((1 - sand.PLASTIC) * peak / 100)
        self.assertAlmostEqual(float(shown[3]) / modulus, 1, delta=0.05)

    def expect_refused(self, answer, *words, code=2):
        self.assertEqual(answer.code, code, answer.err)
        self.assertEqual(len(answer.err.splitlines()), 1, answer.err)
        self.assertTrue(answer.err.startswith(f"{PROGRAM}: "), answer.err)
        for word in words:
            self.assertIn(word, answer.err)
        self.assertFalse((self.out / "unloading.csv").exists())


class WhatIsRead(Laboratory):
    def test_files_as_a_laboratory_writes_them(self):
        ways = {
            "as they are": USUAL,
            "spaces": [text.replace(",", " , ") for text in USUAL],
            "line ends of other machines": [text.replace("\n", "\r\n") for text in USUAL],
            "a byte order mark": ["\ufeff" + text for text in USUAL],
            "semicolons": [text.replace(",", ";") for text in USUAL],
            "empty columns": [text.replace("\n", ",,,\n") for text in USUAL],
            "no heading": [sand.test_text(peak, heading="") for peak in sand.PEAKS],
            "quotes": [sand.test_text(peak, '"{:.4f}","{:.5f}"') for peak in sand.PEAKS],
            "a column behind": [sand.test_text(peak, "{:.4f},{:.5f},ok", "strain,p,note\n") for peak in sand.PEAKS],
        }
        for name, texts in ways.items():
            with self.subTest(name):
                self.expect_right(self.made_of(*texts))

    def test_rows_that_are_no_numbers_are_counted(self):
        heading = "Sand 7\n\n# dried\nstrain [%],p [MPa]\n"

        answer = self.made_of(*(sand.test_text(peak, heading=heading) for peak in sand.PEAKS))

        self.expect_right(answer)
        counts = "t0.csv: 101 rows of numbers; passed over as headings: 2 (line 1, 4); blank or remarks: 2\n"
        self.assertIn(counts, answer.out)

    def test_latin_1_is_read_and_said(self):
        heading = "Dehnung [%],Druck [MPa] bei 20 °C\n"

        answer = self.made_of(*(sand.test_text(peak, heading=heading).encode("latin-1") for peak in sand.PEAKS))

        self.expect_right(answer)
        self.assertIn("t0.csv:1: warning: no UTF-8; read as Latin-1\n", answer.err)

    def test_rows_that_are_left_out_are_counted(self):
        peak, other = sand.PEAKS
        twice = sand.test_text(peak).replace(f"{peak:.4f},", f"{peak:.4f},{sand.loading(peak):.5f}\n{peak:.4f},")

        answer = self.made_of(twice, sand.test_text(other))

        self.expect_right(answer)
        self.assertIn("t0.csv: rows left out, where strain or pressure runs back or stands still: 1\n", answer.out)

    def test_without_tamp_it_says_that_nothing_was_checked(self):
        copy = self.folder / "copy"
        shutil.copytree(program.ROOT / "tools/python/tamp", copy / "tools/python/tamp")
        paths = sand.write_tests(self.folder, USUAL)
        words = ["--strain", "percent", "--pressure", "MPa", "--out", self.out, *paths]

        answer = sand.call("import", *words, root=copy)

        self.expect_right(answer)
        self.assertIn("warning: not built; what is made is not checked by TAMP", answer.err)


class WhatIsRefused(Laboratory):
    def refused(self, change, *words, **how):
        self.expect_refused(self.made_of(change(USUAL[0]), USUAL[1], **how), *words)

    def test_separators_of_thousands(self):
        def row(strain, pressure):
            return f'{strain:.4f},"{1000 * pressure:,.2f}"\n'

        texts = ["".join(["strain,p [kPa]\n", *(row(*numbers) for numbers in sand.test_rows(peak))])
                 for peak in sand.PEAKS]
        line = next(k for k, text in enumerate(texts[0].split("\n"), start=1) if text.count(",") == 2)

        answer = self.made_of(*texts, words=("--strain", "percent", "--pressure", "kPa"))

        self.expect_refused(answer, f't0.csv:{line}: "1,', "nothing between thousands")

    def test_decimal_commas(self):
        with_names = [text.replace(".", ",") for text in USUAL]
        self.expect_refused(self.made_of(*with_names), "t0.csv:2: 4 values (decimal commas?); expected 2")
        without_names = [text.split("\n", 1)[1].replace(".", ",") for text in USUAL]
        self.expect_refused(self.made_of(*without_names), "t0.csv:1: ")
        with_semicolons = [text.replace(",", ";").replace(".", ",") for text in USUAL]
        self.expect_refused(self.made_of(*with_semicolons), "t0.csv:2: ", "a point for decimals")

    def test_texts_and_gaps_among_numbers(self):
        def with_row(row):
            return lambda text: text.replace("\n3.2000,", f"\n{row}\n3.2000,")

        for row, found in {"nan,nan": '"nan"', "3.1,inf": '"inf"', "pause": "1 values", "3.1,0.5,7": "3 values",
                           "3.1,": "1 values", "3.1,-": '"-"', "strain [%],p [MPa]": '"strain [%]"'}.items():
            with self.subTest(row):
                self.refused(with_row(row), f"t0.csv:12: {found}; expected ")

    def test_swapped_columns(self):
        swapped = [sand.test_text(peak, "{1:.5f},{0:.4f}", "p [MPa],strain [%]\n") for peak in sand.PEAKS]
        self.expect_refused(self.made_of(*swapped), 't0.csv:1: columns "p [MPa]", "strain [%]"')
        unnamed = [text.split("\n", 1)[1] for text in swapped]
        self.expect_refused(self.made_of(*unnamed), "t0.csv: unloading to ")

    def test_units_that_are_not_those_of_the_file(self):
        self.expect_refused(self.made_of(*USUAL, words=("--strain", "percent", "--pressure", "kPa")),
                            't0.csv:1: "p [MPa]" with --pressure kPa')
        unnamed = [text.split("\n", 1)[1] for text in USUAL]
        self.expect_refused(self.made_of(*unnamed, words=("--strain", "fraction", "--pressure", "MPa")), "less than 1")
        fractions = [sand.test_text(peak, "{:.6f},{:.5f}", "") for peak in sand.PEAKS]
        fractions = ["".join(f"{float(s) / 100:.6f},{p}\n" for s, p in (line.split(",") for line in text.split()))
                     for text in fractions]
        self.expect_refused(self.made_of(*fractions), "with a bulk modulus of", "as of sand")

    def test_two_cycles_in_a_file(self):
        first, second = (text.split("\n", 1)[1] for text in USUAL)
        both = USUAL[0] + second
        start = USUAL[0].count("\n")
        self.expect_refused(self.made_of(both, USUAL[1]), f"t0.csv:{start}: a second cycle", "one loading and one")
        reversed_order = USUAL[1] + first
        self.expect_refused(self.made_of(reversed_order, USUAL[0]), "t0.csv:", "a second cycle")

    def test_a_test_that_is_none(self):
        self.refused(lambda text: "\n".join(text.split("\n")[:40]), "t0.csv: 1 rows of unloading; expected 3 or more")
        self.refused(lambda text: "\n".join(text.split("\n")[:70]), "t0.csv: unloading to ")
        self.refused(lambda text: text.replace("\n", "\n-").replace(",", ",-").rstrip("-"),
                     "compression to be positive")
        self.refused(lambda text: "", "t0.csv: no row; expected strain in column 1")
        self.refused(lambda text: "a picture\n", 't0.csv: no row of numbers, but "a picture"')

    def test_rows_missing_round_the_peak(self):
        lines = USUAL[1].split("\n")
        self.expect_refused(self.made_of(USUAL[0], "\n".join(lines[:48] + lines[78:])), "t1.csv:49: a pressure of ",
                            "are rows missing?")

    def test_one_test_alone_and_the_same_twice(self):
        self.expect_refused(self.made_of(USUAL[1]), "t0.csv: one test; expected two or more")
        self.expect_refused(self.made_of(USUAL[1], USUAL[1]), "t0.csv", "t1.csv", "meet or cross at 0 Pa")

    def test_tests_of_two_sands(self):
        soft = sand.test_text(16).split("\n", 1)[1].split()
        soft = "".join(f"{s},{float(p) / 5:.5f}\n" for s, p in (line.split(",") for line in soft))
        self.expect_refused(self.made_of(soft, USUAL[1]), "t0.csv: ", "as in the loading of ", "t1.csv")

    def test_straight_unloading(self):
        """Three points of a line are kept, as TAMP wants them."""
        texts = []
        for peak in sand.PEAKS:
            up = sand.test_rows(peak)[: sand.N + 1]
            down = [(peak * (1 - 0.25 * i / 9), sand.loading(peak) * (1 - i / 9)) for i in range(1, 10)]
            texts.append("".join(f"{strain:.4f},{pressure:.5f}\n" for strain, pressure in up + down))

        self.assertEqual(self.made_of(*texts).code, 0)
        self.assertEqual(len(sand.read(self.out / "unloading.csv")), 6)

    def test_curves_that_cross(self):
        """The first one is unloaded from less strain, but stays stiff for so short that it comes to lie beyond."""
        texts = []
        for peak, power in [(16, 3), (16.5, 1)]:
            up = sand.test_rows(peak)[: sand.N + 1]
            down = [(peak * (1 - 0.25 * i / 50), sand.loading(peak) * (1 - i / 50) ** power) for i in range(1, 51)]
            texts.append("".join(f"{strain:.4f},{pressure:.5f}\n" for strain, pressure in up + down))

        answer = self.made_of(*texts)

        self.expect_refused(answer, "t0.csv and ", "t1.csv: the unloading curves of plastic strain 0.12",
                            "0.12375 meet or cross at 14690 Pa; expected curves apart")

    def test_noise_that_tamp_refuses(self):
        """The files are left aside, and those that stood there are kept."""
        self.assertEqual(self.made_of(*USUAL).code, 0)
        before = (self.out / "unloading.csv").read_text()
        chance = random.Random(NOISY_SEED)
        noisy = ["".join(f"{strain * (1 + chance.gauss(0, 2e-3)):.4f},{pressure:.5f}\n" for strain, pressure in
                         sand.test_rows(peak)) for peak in sand.PEAKS]

        answer = self.made_of(*noisy)

        self.assertEqual(answer.code, 2)
        self.assertIn("unloading.refused.csv:", answer.err)
        self.assertRegex(answer.err, "near the curves of plastic strain 0.* and 0.* at pressure [0-9]+.*, plastic ")
        self.assertEqual((self.out / "unloading.csv").read_text(), before)
        self.assertTrue((self.out / "unloading.refused.csv").exists())

    def test_a_program_that_is_none(self):
        fake = self.folder / "tamp"
        fake.write_text("")

        answer = self.made_of(*USUAL, tamp=fake)

        self.expect_refused(answer, "tamp: no program; expected TAMP")

    def test_files_that_are_none(self):
        tests = sand.write_tests(self.folder, USUAL)
        words = ["--strain", "percent", "--pressure", "MPa", "--tamp", TAMP]
        missing = self.folder / "none.csv"
        for path, found in {self.folder: "a folder", missing: "no such file", "/dev/zero": "a device"}.items():
            with self.subTest(str(path)):
                answer = sand.call("import", *words, "--out", self.out, tests[0], path)
                self.expect_refused(answer, found)
        for out in [tests[0], "/dev/null/sand", "/proc/sand"]:
            with self.subTest(str(out)):
                answer = sand.call("import", *words, "--out", out, *tests)
                self.expect_refused(answer, str(out), code=4)

    def test_what_is_read_is_not_written_over(self):
        self.out.mkdir()
        paths = [self.out / "hydrostat.csv", self.out / "a.csv"]
        for path, text in zip(paths, USUAL):
            path.write_text(text)

        words = ["--strain", "percent", "--pressure", "MPa", "--out", self.out]
        answer = sand.call("import", *words, *paths)

        self.expect_refused(answer, "hydrostat.csv: an input; expected another file to write to")
        self.assertEqual(paths[0].read_text(), USUAL[0])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    program.add_option(parser)
    options, rest = parser.parse_known_args()
    TAMP = options.tamp.resolve()
    unittest.main(argv=[sys.argv[0], *rest])
