"""The effect on a run of sand that separates.

Runs the scene with `separation` false and true in turns, in the rate and in the state form. Prints for each the
greatest depth, how far depth is from that of sand that stays whole (the greatest difference at any time, over the
greatest depth), steps and their mean size, which updates of the sand were of particles that are apart and which ended
outside of the modulus' range, the least plastic volumetric strain, the error of energy, and the median of the user
times.
"""

import statistics

from tamp.markdown import print_head, print_row
from tamp.research.methods.stress_tolerance import add_options_of_runs, depth_difference, run
from tamp.options import count

FORMS, ANSWERS = ("rate", "state"), ("false", "true")
COLUMNS = ["form", "sand", "greatest depth", "depth(t) differs by", "steps", "mean step", "apart", "out of range",
           "least plastic strain", "energy error", "user time"]


def cells(form, answer, whole, result, seconds, sand):
    summary = result.summary
    monitors, steps = summary["monitors"], summary["steps"]
    n_updates = steps * summary["particles"][sand]
    return [form, "separates" if answer == "true" else "as published", f"{max(result.depth):.5f} m",
            f"{depth_difference(whole, result):.1e}", f"{steps:,}",
            f"{summary['simulated_time_s'] / steps * 1e6:.2f} us", f"{monitors['updates_apart'] / n_updates:.1%}",
            f"{monitors['modulus_extrapolations'] / n_updates:.1%}",
            f"{min(result.history['plastic_volumetric_min']):.2f}", f"{summary['energy_error']:.2%}",
            f"{statistics.median(seconds):.2f} s"]


def add_arguments(parser):
    add_options_of_runs(parser)
    parser.add_argument("--turns", type=count, default=5)


def main(options):
    print_head(COLUMNS)
    for form in FORMS:
        turns = [{answer: run(options, elastic_update=form, separation=answer) for answer in ANSWERS}
                 for _ in range(options.turns)]
        for answer in ANSWERS:
            seconds = [turn[answer].seconds for turn in turns]
            print_row(cells(form, answer, turns[0]["false"], turns[0][answer], seconds, options.sand))
