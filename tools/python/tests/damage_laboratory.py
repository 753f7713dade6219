"""Damages a laboratory's files at random, calls the commands in unusual ways, and looks at how they take it.

    cd tools/python; python3 -m tests.damage_laboratory [--files 200] [--calls 200] [--seed 1]

Right is: an exit code of the list (0, 2, 4), no traceback, one line that says why wherever it is not 0, and after 0 a
sand within 5 % of the one that the files were made of. It prints how many ended how; the exit code is 1 if any was
wrong. Where a Python package is missing, its name is the right answer.
"""

import argparse
import collections
import pathlib
import random
import re
import shutil
import sys
import tempfile

from tamp import program
from tamp.failure import NO_PACKAGE, PROGRAM
from tests import a_sand as sand

OFF = 0.05  # of the peak: most that damage within the noise of tests may come to
NUMBERS = ["nan", "inf", "-1", "0", "1e400", "1,5", "1.5.2", "", "x", "0x10", "1e3", "9" * 400, "\u0663", "-", "--"]
NUMBER = r"[0-9]+\.[0-9]+"
ROWS = ["pause", ",", "1", "1,2,3", "# note", "", '"open', "strain,p", "\x1b[31m,2"]
SIGNS = [(",", ";"), (",", "\t"), (",", " "), (".", ","), ("\n", "\r\n"), ("\n", "\r"), (".", "")]
SCENERY = {"history.csv": "time[s],depth[m]\n0,0\n1,2\n"}


def damaged_text(text, chance):
    """A number changed, rows lost, doubled, exchanged, put in or cut off, or a sign exchanged everywhere."""
    lines = text.split("\n")
    if len(lines) < 3:
        return text
    at = chance.randrange(1, len(lines) - 1)
    way = chance.randrange(10)
    if way == 0:
        cells = lines[at].split(",")
        cells[chance.randrange(len(cells))] = chance.choice(NUMBERS)
        lines[at] = ",".join(cells)
    elif way == 1:
        cells = lines[at].split(",")
        k = chance.randrange(len(cells))
        value = float(cells[k]) if re.fullmatch(NUMBER, cells[k]) else 0
        cells[k] = f"{value * chance.choice([-1, 0.1, 0.5, 0.9, 1.1, 2, 10, 1000]):.5f}"
        lines[at] = ",".join(cells)
    elif way == 2:
        del lines[at : at + chance.choice([1, 5, 30])]
    elif way == 3:
        lines[at:at] = lines[at : at + chance.choice([1, 5, 30])]
    elif way == 4:
        other = chance.randrange(1, len(lines) - 1)
        lines[at], lines[other] = lines[other], lines[at]
    elif way == 5:
        lines.insert(at, chance.choice(ROWS))
    elif way == 6:
        del lines[at:]
    elif way == 7:
        return "\n".join(lines).replace(*chance.choice(SIGNS))
    elif way == 8:
        return "\n".join(",".join(reversed(line.split(","))) for line in lines)
    else:
        lines[at] = lines[at][: chance.randrange(len(lines[at]) + 1)]
    return "\n".join(lines)


def damaged_bytes(text, chance):
    content = bytearray(text.encode(chance.choice(["utf-8", "utf-8-sig", "latin-1", "utf-16"]), errors="replace"))
    for _ in range(chance.choice([0, 0, 1, 1, 5]) if content else 0):
        content[chance.randrange(len(content))] = chance.randrange(256)
    return bytes(content)


def is_wrong_sand(folder):
    """Whether a curve is off, compared with what the files were made of."""
    peak = max(sand.PEAKS)
    largest = sand.loading(peak)
    for strain, pressure in sand.read(folder / "hydrostat.csv"):
        if abs(pressure / 1e6 - sand.loading(100 * strain)) > OFF * largest:
            return True
    curves = collections.defaultdict(list)
    for plastic, elastic, pressure in sand.read(folder / "unloading.csv"):
        curves[plastic].append((100 * (plastic + elastic), pressure / 1e6))
    if len(curves) != len(sand.PEAKS):
        return True
    return any(abs(pressure - sand.unloading(strain, peak)) > OFF * sand.loading(peak)
               for peak, (_, points) in zip(sand.PEAKS, sorted(curves.items())) for strain, pressure in points)


def judged(answer):
    """The fault of an answer; empty if it has none."""
    if "Traceback" in answer.err or "Traceback" in answer.out:
        return "traceback"
    if answer.code == NO_PACKAGE:
        return "" if "Debian's package python3-" in answer.err else "no package named"
    if answer.code not in (0, 2, 4):
        return f"exit code {answer.code}"
    lines = answer.err.rstrip("\n").split("\n")
    if answer.code != 0 and not lines[-1].startswith(PROGRAM):
        return "no line that says why"
    return "a character that steers terminals" if "\x1b" in answer.err + answer.out else ""


def try_files(n, chance, tamp, folder):
    for k in range(n):
        texts = [sand.test_text(peak) for peak in sand.PEAKS]
        which = chance.randrange(len(texts))
        for _ in range(chance.choice([1, 1, 2])):
            texts[which] = damaged_text(texts[which], chance)
        if chance.random() < 0.3:
            texts[which] = damaged_bytes(texts[which], chance)
        out = folder / f"sand{k}"
        paths = sand.write_tests(folder, texts)
        words = ["--strain", "percent", "--pressure", "MPa", "--tamp", tamp, "--out", out, *paths]
        answer = sand.call("import", *words)
        wrong = judged(answer)
        if not wrong and answer.code == 0 and is_wrong_sand(out):
            wrong = "wrong sand"
        yield f"file {k}", answer, wrong


def unusual_calls(folder, tamp):
    """(command, words) that are wrong in some way, or nearly."""
    tests = sand.write_tests(folder, [sand.test_text(peak) for peak in sand.PEAKS])
    made = folder / "made"
    units = ["--strain", "percent", "--pressure", "MPa", "--tamp", tamp]
    sand.call("import", *units, "--out", made, *tests)
    for name, text in SCENERY.items():
        (folder / name).write_text(text)
    empty, binary, no_json = folder / "empty", folder / "binary", folder / "no.json"
    empty.write_bytes(b"")
    binary.write_bytes(bytes(range(256)) * 40)
    no_json.write_text('{"of": [{"profile": [[0, 0], [1, NaN]]}, {"count": 1e400}]}')
    deep = folder / "deep.json"
    deep.write_text("[" * 100000)
    missing, device = folder / "missing", "/dev/zero"

    for strange in [missing, folder, device, empty, binary, "", "x" * 300, "a\x1b[31mb", "-", "\u20ac"]:
        yield "import", [*units, "--out", folder / "o", tests[0], strange]
        yield "import", [*units, "--out", folder / "o", strange]
        yield "fit", [strange, "--out", folder / "o"]
        yield "concrete-sand", [strange, folder / "o"]
        yield "history", [strange]
        yield "projectile-mesh", [strange, folder / "x.stl"]
        yield "picture", [strange, "--out", folder / "x.png"]
        yield "draw", [strange]
    yield "import", [*units, "--out", tests[0], *tests]
    for out in ["/dev/full", "/dev/null/x", "/proc/x", "", folder / ("y" * 300)]:
        yield "import", [*units, "--out", out, *tests]
        yield "projectile-mesh", [program.INPUTS / "uxo/projectile.json", out]
    for words in [[], ["--help"], ["--strain"], ["--strain", "per mille"], [*units], [*units, "--out", folder / "o"],
                  [*units, "--out", made, made / "hydrostat.csv", tests[0]],
                  [*units, "--tamp", missing, *tests, "--out", made],
                  [*units, "--tamp", "/bin/false", *tests, "--out", folder / "o"],
                  [*units, "--tamp", empty, *tests, "--out", folder / "o"]]:
        yield "import", words
    for words in [["--c", "nan"], ["--c", "0"], ["--epsilon", "-1"], ["--epsilon", "0.99"], ["--layers", "0"],
                  ["--layers", ""], ["--layers", "2,x"], ["--layers", "999999999,999999999"], ["--epochs", "0"],
                  ["--epochs", "1.5"], ["--batch", "0"], ["--seed", "-1"], ["--seed", "99999999999"],
                  ["--out", "/dev/null/x"], ["--page", made / "unloading.csv"], ["--page", folder],
                  ["--page", made / "network.h5"], ["--layers", "2", "--seed", "0"]]:
        yield "fit", [made, "--tamp", tamp, "--epochs", "1", *words]
    for words in [["--times", "x"], ["--times", "nan"], ["--times"], ["--columns", "none"], ["--columns"],
                  ["--times", "-1", "1e300"]]:
        yield "history", [folder, *words]
    for path in [no_json, deep, program.INPUTS / "punch/quick.json", program.INPUTS / "uxo/projectile.json"]:
        yield "projectile-mesh", [path, path]
        yield "projectile-mesh", [path, folder / "x.stl"]
    for words in [["--range", "2", "1"], ["--log"], ["--out", "x.txt"], ["--slab", "1"], ["--time", "inf"]]:
        yield "picture", [folder, *words]


def try_calls(n, chance, tamp, folder):
    calls = list(unusual_calls(folder, tamp))
    for command, words in chance.sample(calls, min(n, len(calls))):
        answer = sand.call(command, *words, folder=folder)
        yield f"{command} {' '.join(map(str, words))}", answer, judged(answer)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    program.add_option(parser)
    parser.add_argument("--files", type=int, default=200)
    parser.add_argument("--calls", type=int, default=200, help="of those that it knows")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--show", action="store_true", help="every answer")
    options = parser.parse_args()

    folder = pathlib.Path(tempfile.mkdtemp())
    counts, n_wrong = collections.Counter(), 0
    tamp = options.tamp.resolve()
    chance = random.Random(options.seed)
    for kind, cases in [("files", try_files(options.files, chance, tamp, folder)),
                        ("calls", try_calls(options.calls, chance, tamp, folder))]:
        for name, answer, wrong in cases:
            counts[kind, wrong or f"exit code {answer.code}"] += 1
            n_wrong += bool(wrong)
            if wrong or options.show:
                print(f"{name}: {wrong or answer.code}: {answer.err.strip()[-600:]!r}")
    for (kind, how), count in sorted(counts.items()):
        print(f"{kind}: {how}: {count}")
    shutil.rmtree(folder)
    sys.exit(n_wrong > 0)


if __name__ == "__main__":
    main()
