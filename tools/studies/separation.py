#!/usr/bin/env python3
"""What it does to a run that its sand comes apart.

    tools/studies/separation.py [--program PROGRAM] [--scene SCENE] [--sand NAME] [--turns 5] [--set POINTER=VALUE ...]

Runs the scene with `comes_apart` false and true in turns, in the rate and in the state form. Prints for each the greatest
depth, how far depth is from that of sand that stays whole (the greatest difference at any time, over the greatest depth),
steps and their mean size, which updates of the sand were of particles that are apart and which ended outside of the
modulus' range, the least plastic volumetric strain, the error of energy, and the median of the user times.
"""

import statistics

import stress_tolerance

FORMS, ANSWERS = ("rate", "state"), ("false", "true")


def row(form, answer, whole, result, seconds, sand):
    summary = result.summary
    monitors, steps = summary["monitors"], summary["steps"]
    n_updates = steps * summary["particles"][sand]
    cells = [form, "comes apart" if answer == "true" else "as published", f"{max(result.depth):.5f} m",
             f"{stress_tolerance.depth_difference(whole, result):.1e}", f"{steps:,}",
             f"{summary['simulated_time_s'] / steps * 1e6:.2f} us", f"{monitors['updates_apart'] / n_updates:.1%}",
             f"{monitors['modulus_extrapolations'] / n_updates:.1%}",
             f"{min(result.history['plastic_volumetric_min[-]']):.2f}", f"{summary['energy_error']:.2%}",
             f"{statistics.median(seconds):.2f} s"]
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = stress_tolerance.arguments_of_runs(__doc__)
    parser.add_argument("--turns", type=int, default=5)
    arguments = parser.parse_args()

    columns = ["form", "sand", "greatest depth", "depth(t) differs by", "steps", "mean step", "apart", "out of range",
               "least plastic strain", "energy error", "user time"]
    print("| " + " | ".join(columns) + " |\n|" + " --- |" * len(columns))
    for form in FORMS:
        turns = [{answer: stress_tolerance.run(arguments, elastic_update=form, comes_apart=answer) for answer in ANSWERS}
                 for _ in range(arguments.turns)]
        for answer in ANSWERS:
            row(form, answer, turns[0]["false"], turns[0][answer], [turn[answer].seconds for turn in turns],
                arguments.sand)


if __name__ == "__main__":
    main()
