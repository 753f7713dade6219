"""The page of a comparison: the figures of the models in a table, and their plots over simulated time."""

import math
from typing import Callable, NamedTuple

from tamp import files
from tamp.charts import over_time, page
from tamp.charts.chart import Table
from tamp.charts.over_time import Line, Plot
from tamp.charts.formatting import (
    NO_NUMBER, counted, escaped, is_number, number_text, percent_text, plain, si_text,
)

NOTES = """<p>The models ran in turns, in {} rounds, each of which takes all of them through the same simulated time.
<em>Cost of a step</em> is the median of a model's steps. <em>Ratio to Table</em> compares the medians within one round;
its own median over the rounds, with the quartiles, is little disturbed by what else the machine did.</p>
<p><em>One evaluation</em> of the modulus is timed on one thread over the strains and pressures that the model's own
sand has at five moments of the run. <em>Memory, run alone</em> is the largest resident size of a process that makes the
first steps of this model only; <em>fields only</em> counts the arrays of particles and grid over the whole run.
<em>p</em> is the mean stress, compression positive, and q = √(3 J₂).</p>
"""
BY_GRID = ("What cells twice as large change is a measure of the grid's error: a model that changes less cannot be "
           "told from the first one on this grid.")


def read_comparison(folder):
    return plain(files.document(folder / "compare.json"))


def write(comparison, folder):
    (folder / "report.html").write_text(whole_page(comparison), encoding="utf-8")


def whole_page(comparison):
    charts = [over_time.chart(plot, f"plot-{k + 1}") for k, plot in enumerate(plots(comparison))]
    content = f'<h1>{escaped(comparison["title"])}</h1>\n<p class="faint">{lead(comparison)}</p>\n'
    content += table_of_models(comparison) + changes(comparison)
    content += '<div class="charts">\n' + "".join(map(page.figure, charts)) + "</div>\n"
    content += notes(comparison)
    return page.whole_page(f"{comparison['title']}: models compared", f"<main>\n{content}</main>\n", kind="compare")


def lead(comparison):
    return (f"Scene {escaped(comparison['scene'])}: {counted(comparison['particles'], 'particle')}, "
            f"{counted(comparison['threads'], 'thread')}, {counted(comparison['cores'], 'core')}. "
            f"All models have reached {common_time(comparison)}: up to there they can be compared.")


def common_time(comparison):
    return si_text(comparison["common_time_s"], "s")


# --- the table ---


class Row(NamedTuple):
    """A row of the table of models."""

    name: str
    cell: Callable  # of a model, as HTML


def rows(comparison):
    def of(key, unit, scale=1):
        return lambda model: si_text(model[key] * scale, unit) if is_number(model[key]) else NO_NUMBER

    def depth_at_end(body):
        return lambda model: si_text(last(model["series"][f"{body}.depth_m"]), "m")

    made = [
        Row("Cost of a step", of("wall_per_step_s", "s")),
        Row("Ratio to Table", ratio),
        Row("Mean step size", of("dt_mean_s", "s")),
        Row("Steps", lambda model: str(model["steps"])),
        Row("Simulated time", of("simulated_time_s", "s")),
        Row("Time in all steps", of("wall_s", "s")),
        Row("Modulus evaluations", of("modulus_evaluations", "")),
        Row("One evaluation", of("modulus_ns_per_eval", "s", 1e-9)),
        Row("Memory, run alone", mebibytes("peak_rss_bytes")),
        Row("Memory, fields only", mebibytes("ledger_peak_bytes")),
    ]
    if comparison["bodies"]:
        made.append(Row("Greatest depth", of("depth_max_m", "m")))
    at = f" at {common_time(comparison)}"
    if comparison["bodies"]:
        made.append(Row(f"Depth{at}", of("depth_at_common_time_m", "m")))
    made.append(Row(f"q{at}", of("q_at_common_time_Pa", "Pa")))
    for body in comparison["bodies"]:
        named = f" of {escaped(body)}" if len(comparison["bodies"]) > 1 else ""
        made.append(Row(f"Depth{named} at the end", depth_at_end(body)))
    return [*made, Row("Largest p", of("p_max_Pa", "Pa")), Row("Largest q", of("q_max_Pa", "Pa"))]


def last(values):
    return values[-1] if values else None


def ratio(model):
    if not is_number(model["ratio_to_table"]):
        return NO_NUMBER
    low, high = (number_text(model[f"ratio_to_table_{which}_quartile"]) for which in ("lower", "upper"))
    return f'{number_text(model["ratio_to_table"])} <span class="small">({low}–{high})</span>'


def mebibytes(key):
    return lambda model: f"{model[key] / 2**20:.1f} MiB" if is_number(model[key]) else NO_NUMBER


def table_of_models(comparison):
    def line(tag, name, cells):
        across = "".join(f"<{tag}>{cell}</{tag.split()[0]}>" for cell in cells)
        return f'<tr><th scope="row">{name}</th>{across}</tr>\n'

    models = comparison["models"]
    head = line('th scope="col"', "", [escaped(model["model"]) for model in models])
    body = "".join(line("td", row.name, map(row.cell, models)) for row in rows(comparison))
    return page.wide(f'<table class="models">\n<thead>{head}</thead>\n<tbody>\n{body}</tbody>\n</table>', "The models")


# --- what the models change, and what the grid does ---


def changes(comparison):
    """Changes between the models at the last time that all have reached."""
    first, *others = comparison["models"]
    coarser = comparison.get("coarser")
    if not others:
        return ""
    keys = [("depth", "depth_at_common_time_m")] if comparison["bodies"] else []
    keys.append(("q", "q_at_common_time_Pa"))
    rows = [[model["model"], *(change_text(change(model, first, key), change(coarser, first, key)) for _, key in keys)]
            for model in others]
    if coarser:
        rows.append(["cells twice as large", *(change_text(change(coarser, first, key)) for _, key in keys)])
    head = [f"difference from {first['model']} at {common_time(comparison)}", *(name for name, _ in keys)]
    said = BY_GRID if coarser else "What the grid changes is not known, as cells twice as large were not run."
    return f"<h2>What the models change</h2>\n{page.as_html(Table(head, rows))}<p>{said}</p>\n"


def change(model, first, key):
    """None where it is not known."""
    known = model is not None and is_number(model[key]) and is_number(first[key]) and first[key] != 0
    return model[key] / first[key] - 1 if known else None


def change_text(by_model, by_grid=None):
    if by_model is None:
        return NO_NUMBER
    text = ("+" if by_model > 0 else "") + percent_text(by_model, 2)
    if by_grid is None:
        return text
    return f"{text} ({'less' if abs(by_model) <= abs(by_grid) else 'more'} than by the grid)"


# --- the plots ---


def plots(comparison):
    wall = over_samples(comparison, "Wall time", "wall time", "s", "wall_s")
    made = [wall, step_cost(comparison), step_size(comparison)]
    for body in comparison["bodies"]:
        made.append(over_samples(comparison, f"Depth of {body}", "depth", "m", f"{body}.depth_m"))
    for sand in comparison["sands"]:
        made.append(over_samples(comparison, f"Largest mean stress in {sand}", "p", "Pa", f"{sand}.p_max_Pa"))
        made.append(over_samples(comparison, f"Largest deviatoric stress in {sand}", "q", "Pa", f"{sand}.q_max_Pa"))
    return made


def line_of(model, x, y):
    """Without what is no number, such as the depth of a body that has left the domain."""
    known = [(a, b) for a, b in zip(x, y) if is_number(a) and is_number(b)]
    return Line(model["model"], [a for a, _ in known], [b for _, b in known], model["status"] == "unstable")


def over_samples(comparison, title, name, unit, key):
    return Plot(title, name, unit, [line_of(m, m["series"]["time_s"], m["series"][key]) for m in comparison["models"]])


def step_size(comparison):
    """Without the first sample, before which no step was made, and the last one's, which had only to reach the end."""
    plot = over_samples(comparison, "Step size", "step size", "s", "dt_s")
    lines = []
    for line in plot.lines:
        end = -1 if len(line.x) > 2 and not line.breaks_off else None
        lines.append(line._replace(x=line.x[1:end], y=line.y[1:end]))
    return plot._replace(lines=lines)


def step_cost(comparison):
    lines = []
    for model in comparison["models"]:
        rounds = model["rounds"]
        made = [k for k, steps in enumerate(rounds["steps"]) if steps > 0]
        lines.append(line_of(model, [rounds["time_s"][k] for k in made], [rounds["wall_per_step_s"][k] for k in made]))
    costs = [model["wall_per_step_s"] for model in comparison["models"] if model["steps"]]
    positive = all(y > 0 for line in lines for y in line.y)
    far_apart = max(costs, default=0) > 4 * min(costs, default=math.inf)
    return Plot("Cost of a step", "wall time of a step", "s", lines, positive and far_apart)


# --- the words ---


def notes(comparison):
    unstable = [m for m in comparison["models"] if m["status"] == "unstable"]
    said = "".join(f"<p><strong>{escaped(m['model'])} became unstable</strong> at {escaped(m['reason'])}. "
                   "Its lines end in a cross.</p>\n" for m in unstable)
    n_rounds = len(comparison["models"][0]["rounds"]["time_s"])
    return f'<div class="notes">\n{said}{NOTES.format(n_rounds)}<pre>{escaped(comparison["program"])}</pre>\n</div>\n'
