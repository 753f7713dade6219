"""Strong and weak scaling of the punch over ranks and threads of one machine.

Strong: the punch at 200 x 160 cells with 1 x 1, 1 x 2 and 2 x 1 ranks x threads. Weak: 1 x 1 with half of it (the punch
is symmetric) against the whole with two workers. Against two: two independent 1 x 1 runs side by side, which share the
memory and the machine's other users as the two workers of one run do. The runs take turns; the table has the ratios of
the medians over the rounds of the time per step, the share of message time that was hidden behind tasks, and that all
digests agree.
"""

import concurrent.futures
import pathlib
import statistics
import tempfile

from tamp import files, program
from tamp.markdown import print_head, print_row
from tamp.options import count

COMMON = {"/grid/cell_size": 0.005, "/output/fields_interval": 1, "/output/history_interval": 1}
WHOLE = {"/grid/patches": [4, 4]}
HALF = {"/grid/lower": [0.5, 0], "/grid/patches": [2, 4], "/bodies/punch/geometry/lower": [0.5, 0.5],
        "/bodies/sand/geometry/lower": [0.5, 0]}
RUNS = {"1 x 1": (1, 1, WHOLE), "1 x 2": (1, 2, WHOLE), "2 x 1": (2, 1, WHOLE), "half, 1 x 1": (1, 1, HALF)}


def measure(options, folder, name):
    """(seconds per step, digest, share of message time hidden)"""
    n_ranks, n_threads, settings = RUNS[name]
    program.run(options.tamp, program.INPUTS / "punch/table.json", folder, "--steps", options.steps, "--threads",
                n_threads, settings={**COMMON, **settings}, ranks=n_ranks)
    summary, profile = (files.document(folder / f"{name}.json") for name in ("summary", "profile"))
    hidden = 1 - profile["message_wait_s"] / profile["message_s"] if profile["messages"] else None
    return summary["wall_per_step_s"], summary["state_digest"], hidden


def measure_two(options, folder):
    """Seconds per step of two independent runs side by side."""
    with concurrent.futures.ThreadPoolExecutor() as pool:
        runs = [pool.submit(measure, options, folder / str(i), "1 x 1") for i in range(2)]
        return statistics.mean(run.result()[0] for run in runs)


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--rounds", type=count, default=5)
    parser.add_argument("--steps", type=count, default=300)


def main(options):
    found, two = {name: [] for name in RUNS}, []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for name in RUNS:
                found[name].append(measure(options, pathlib.Path(folder) / "run", name))
            two.append(measure_two(options, pathlib.Path(folder)))
    step = {name: statistics.median(time for time, _, _ in rounds) for name, rounds in found.items()}
    hidden = statistics.median(share for _, _, share in found["2 x 1"])
    digests = {digest for name in ("1 x 1", "1 x 2", "2 x 1") for _, digest, _ in found[name]}
    side_by_side = statistics.median(two)
    print_head(["ranks x threads", "ms per step", "strong efficiency", "weak efficiency", "against two side by side"])
    print_row(["1 x 1", f"{step['1 x 1'] * 1e3:.2f}", "1", f"1 (half: {step['half, 1 x 1'] * 1e3:.2f} ms)",
               f"1 (two: {side_by_side * 1e3:.2f} ms each)"])
    for name in ("1 x 2", "2 x 1"):
        print_row([name, f"{step[name] * 1e3:.2f}", f"{step['1 x 1'] / step[name] / 2:.3f}",
                   f"{step['half, 1 x 1'] / step[name]:.3f}", f"{side_by_side / step[name] / 2:.3f}"])
    print(f"\nmessage time hidden behind tasks: {hidden:.3f}; digests: {', '.join(sorted(digests))}")
    return 0 if len(digests) == 1 else 1
