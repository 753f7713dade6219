"""A sand whose tests can be written down, and calls of the commands that read them."""

import pathlib
import resource
import subprocess
import sys
from typing import NamedTuple

from tamp.program import ROOT

LIMIT = 120  # seconds
MEMORY = 4 * 2**30  # bytes of a call, so that it cannot take all that others have
PEAKS = (16, 24)  # percent
N = 50  # rows of a branch
PLASTIC = 0.75  # of the strain at the peak
FIRST_SHARE = 0.4  # of the pressure: linear in elastic strain, the rest quadratic


def loading(strain):
    """Pressure [MPa] at a strain [%]."""
    return 0.15 * strain + 0.003 * strain**3


def unloading(strain, peak):
    x = (strain / peak - PLASTIC) / (1 - PLASTIC)
    return loading(peak) * (FIRST_SHARE * x + (1 - FIRST_SHARE) * x**2)


def test_rows(peak):
    """(strain [%], pressure [MPa]) of a test, the peak once."""
    up = [(peak * i / N, loading(peak * i / N)) for i in range(N + 1)]
    down = [peak * (1 - (1 - PLASTIC) * i / N) for i in range(1, N + 1)]
    return up + [(strain, unloading(strain, peak)) for strain in down]


def test_text(peak, row="{:.4f},{:.5f}", heading="strain [%],p [MPa]\n"):
    return heading + "".join(row.format(*numbers) + "\n" for numbers in test_rows(peak))


class Answer(NamedTuple):
    code: int  # None of one that took too long
    out: str
    err: str


def call(command, *words, folder=None, root=ROOT):
    words = [sys.executable, str(root / "tools/python/tamp"), command, *map(str, words)]

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, timeout=LIMIT, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return Answer(None, "", "took too long")
    return Answer(done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace"))


def write_tests(folder, texts):
    paths = [pathlib.Path(folder, f"t{k}.csv") for k in range(len(texts))]
    for path, text in zip(paths, texts):
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return paths


def read(path):
    """Rows of numbers of a CSV that a command has made."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return [[float(cell) for cell in line.split(",")] for line in lines[1:]]
