"""Figures 30 and 31: time, memory, steps and time per step of the three runs of the projectile."""

import numpy as np

from tamp import results
from tamp.research.report.drawing import COLOURS, chart
from tamp.research.report.numbers import of

MICRO, MEGA = 1e-6, 1e6


def per_step(machine):
    """Processor time of a step between rows: other work on the machine changes it less than the clock's time."""
    steps = np.diff(machine["step"])
    kept = steps > 0
    middle = (machine["time"][1:] + machine["time"][:-1]) / 2
    return middle[kept], np.diff(machine["processor"])[kept] / steps[kept]


def lines(album, runs, name, y_label, caption, line_of):
    figure, axis = chart("simulated time [µs]", y_label)
    for run in runs:
        x, y = line_of(run)
        axis.plot(x / MICRO, y, color=COLOURS[run.model], lw=1.3, label=run.name)
    axis.set_ylim(bottom=0)
    axis.legend(fontsize=8)
    album.keep(figure, name, f"{caption} {runs[0].about}.")


def draw(album, runs):
    if all(results.machine(run.folder) is not None for run in runs):
        lines(album, runs, "30a", "processor time [s]", "Processor time over simulated time.",
              lambda run: (results.machine(run.folder)["time"], results.machine(run.folder)["processor"]))
        lines(album, runs, "30b", "memory [MB]", "Memory over simulated time (resident set).",
              lambda run: (results.machine(run.folder)["time"], results.machine(run.folder)["rss"] / MEGA))
        lines(album, runs, "31b", "processor time of a step [ms]", "Processor time per step.",
              lambda run: (lambda x, y: (x, smoothed(y) / 1e-3))(*per_step(results.machine(run.folder))))
    else:
        print("figures 30 and 31b left out: the runs have no machine.csv")
    lines(album, runs, "31a", "step [µs]", "Size of the steps.",
          lambda run: (results.history(run.folder)["time"][1:], results.history(run.folder)["dt"][1:] / MICRO))


def smoothed(values, n=9):
    """Median of neighbours: a row spans few steps, and the machine's clock ticks."""
    padded = np.pad(values, n // 2, mode="edge")
    return np.median(np.lib.stride_tricks.sliding_window_view(padded, n), axis=1)


def numbers(runs, figure="30, 31", what="projectile"):
    """A step's cost is compared by processor time, with Table's run on the same machine."""
    found, first = [], {}
    for run in runs:
        number = of(run)
        for name, (unit, value) in measured(run).items():
            first.setdefault(name, value)
            said = "about 100" if "memory" in name and what == "projectile" else ""
            found.append(number(figure, f"{what}: {name}", unit, value, said))
            if run.model != "table" and "memory" not in name:
                said = "almost 10" if (run.model, name) == ("svr", "processor time") else ""
                found.append(number(figure, f"{what}: {name} over Table's", "", value / first[name], said))
    return found


def measured(run):
    """(unit, value) by name."""
    columns, n_steps = results.machine(run.folder), results.history(run.folder)["step"][-1]
    if columns is None:
        return {"steps": ("", n_steps)}
    processor, memory = columns["processor"][-1], columns["rss"] / MEGA
    return {"steps": ("", n_steps), "processor time": ("s", processor),
            "processor time per step": ("ms", 1e3 * processor / columns["step"][-1]),
            "largest memory": ("MB", memory.max()), "memory at the end": ("MB", memory[-1])}
