"""The page of a study, and the files of its charts."""

import re

from tamp.charts import budget, convergence, page, picture, stability_map, step_cost, work_precision
from tamp.charts.chart import Table
from tamp.charts.page import HERE, escaped
from tamp.charts.study import setting_text
from tamp.charts.formatting import NO_NUMBER, counted, number_text

REFERENCES = {"exact": "an exact answer", "extrapolated": "the finest runs, extrapolated", "finest": "the finest run",
              "run": "one run, taken as it is", "none": "none"}


PANEL = """<aside id="chosen" aria-live="polite" aria-label="The chosen point">
<button type="button" class="close" aria-label="Close">✕</button>
<div class="content"><p class="faint">\
Choose a point of a chart, with the pointer or with Tab and the arrow keys: this is
where its settings, figures and command are shown.</p></div>
</aside>
"""


def write(study, folder):
    named = zip(study.quantities, prefixes(study))
    sections = [(quantity, make_charts(study, quantity, prefix)) for quantity, prefix in named]
    for _, charts in sections:
        for chart in charts:
            picture.write_files(chart.wide, folder / "charts", chart.name)
    (folder / "index.html").write_text(whole_page(study, sections), encoding="utf-8")


def make_charts(study, quantity, prefix):
    # A map has so many methods that lines of cost and error would be a tangle.
    makers = [stability_map] if study.document.get("map") else [work_precision, convergence, step_cost, budget]
    return [chart for maker in makers for chart in maker.charts(study, quantity, prefix)]


def prefixes(study):
    """File names of quantities, each of its own."""
    names = []
    for k, quantity in enumerate(study.quantities):
        name = re.sub(r"[^a-z0-9]+", "-", quantity.name.lower()).strip("-") or f"quantity-{k + 1}"
        names.append(name if name not in names else f"{name}-{k + 1}")
    return names


def whole_page(study, sections):
    names = {point.id: short_text(study, point) for point in study.points}
    content = "<main>\n" + head(study) + overview(study) + expectations(study)
    for (quantity, charts), prefix in zip(sections, prefixes(study)):
        content += f'<section id="{prefix}">\n<h2>{escaped(quantity.name)}</h2>\n'
        content += f"<p>{escaped(reference_text(quantity))}</p>\n"
        content += "".join(page.figure(chart, names) for chart in charts) + "</section>\n"
    content += failed_runs(study) + closing(study) + "</main>\n" + panel(study)
    script = (HERE / "page.js").read_text(encoding="utf-8")
    return page.whole_page(study.title, content, "study", script)


def head(study):
    about, takes = (escaped(study.document.get(key, "")) for key in ("about", "takes"))
    remade_by = command(study.document.get("command", ""))
    rows = [("measured on", machine_text(study)), ("threads", threads_text(study)), ("takes", takes),
            ("remade by", remade_by)]
    return f"<h1>{escaped(study.title)}</h1>\n" + (f"<p>{about}</p>\n" if about else "") + facts(rows)


def facts(rows):
    return "<dl>\n" + "".join(f"<dt>{name}</dt><dd>{text}</dd>\n" for name, text in rows if text) + "</dl>\n"


def command(text):
    return f'<code class="command">{escaped(text)}</code>' if text else ""


def machine_text(study):
    machine = study.document.get("machine") or {}
    cores = counted(machine["cores"], "core") if "cores" in machine else ""
    parts = [machine.get("processor"), machine.get("instruction_set"), cores]
    return escaped(", ".join(str(part) for part in parts if part))


def threads_text(study):
    threads, repeat = study.document.get("threads"), study.document.get("repeat")
    repeated = f", each run timed {counted(repeat, 'time')}, the median drawn" if repeat else ""
    return f"{threads}{repeated}" if threads else ""


def overview(study):
    """The head of the page: what each quantity is compared with, and links where there are many."""
    failed = study.failed()
    text = f"<p>{counted(len(study.points), 'run')} of {counted(len(study.methods), 'method')}"
    text += f", of which {len(failed)} gave no result (<a href=\"#failed\">why</a>).</p>\n" if failed else ".</p>\n"
    if len(study.quantities) < 2:
        return text
    named = zip(study.quantities, prefixes(study))
    links = "".join(f'<a href="#{prefix}">{escaped(quantity.name)}</a>\n' for quantity, prefix in named)
    return f'{text}<nav aria-label="Quantities">\n{links}</nav>\n'


def verdict(expectation):
    """Whether what was expected holds, and whether that is known."""
    if expectation["holds"]:
        return "holds, though known to be missed" if expectation.get("missed") else "holds"
    return "missed, as known" if expectation.get("missed") else "DOES NOT HOLD"


def expectations(study):
    """Expectations from before the runs, and whether they hold."""
    if not study.expected:
        return ""
    missed = sum(not expectation["holds"] for expectation in study.expected)
    known = sum(not expectation["holds"] and bool(expectation.get("missed")) for expectation in study.expected)
    text = f"{missed} of {len(study.expected)} do not hold" if missed else f"All {len(study.expected)} hold"
    text += f", {known} of them as is known" if known else ""
    rows = [[verdict(g), g["quantity"], g["label"], g["note"], g["expected"], g.get("missed") or g["why"]]
            for g in study.expected]
    table = page.as_html(Table(["", "quantity", "method", "found", "expected", "why"], rows))
    return f'<section id="expected">\n<h2>What was expected</h2>\n<p>{text}.</p>\n{table}</section>\n'


def reference_text(quantity):
    reference, note = quantity.reference, quantity.reference.get("note") or ""
    notes = f" {sentence(note)}" if note else ""
    if not quantity.has_reference:
        return "There is no reference, so that no error is claimed." + notes
    what = "Errors are against" if quantity.has_bound else "Differences, which are no errors, are from"
    text = f"{what} {REFERENCES.get(reference['kind'], reference['kind'])}"
    if reference.get("value") is not None:
        text += f", {quantity.value_text(reference['value'])}"
    if quantity.uncertainty:
        text += f", itself uncertain by {quantity.error_text(quantity.uncertainty)}"
    if reference.get("order") is not None and quantity.has_bound:
        text += f"; it converges with order {number_text(reference['order'])}"
    return f"{text}.{notes}"


def sentence(text):
    return text[:1].upper() + text[1:].rstrip(".") + "."


def failed_runs(study):
    failed = study.failed()
    if not failed:
        return ""
    rows = [[p.method, p.label, p.ended, p.reason, p.command] for p in failed]
    table = page.as_html(Table(["method", "settings", "ended", "reason", "command"], rows))
    return f'<section id="failed">\n<h2>Runs without a result</h2>\n{table}</section>\n'


def closing(study):
    program = study.document.get("program", "")
    return f"<section>\n<h2>The program</h2>\n<pre>{escaped(program)}</pre>\n</section>\n" if program else ""


# --- the panel of the chosen point ---


def short_text(study, point):
    parts = [point.name] + ([point.why] if point.failed else [])
    for quantity in study.quantities:
        if not point.failed and point.error(quantity) is not None:
            parts.append(f"{quantity.distance_name} of {quantity.name} {quantity.distance_text(point)}")
    for cost in study.costs[:1]:
        if point.cost_of(cost.key) is not None:
            parts.append(f"{cost.name} {cost.text(point.cost_of(cost.key))}")
    return ", ".join(parts)


def error_text(quantity, point):
    """Its error, or its difference from the reference, which is called that."""
    if point.error(quantity) is None:
        return NO_NUMBER
    text = quantity.distance_text(point)
    return text if quantity.has_bound else f"{text} (difference)"


def panel(study):
    templates = "".join(f'<template id="point-{p.id}">\n{point_text(study, p)}</template>\n' for p in study.points)
    return PANEL + templates


def point_text(study, point):
    settings = [(escaped(pointer), escaped(setting_text(value))) for pointer, value in point.settings.items()]
    html = f"<h2>{escaped(point.name)}</h2>\n<p>{escaped(sentence(point.why))}</p>\n"
    html += facts([*costs_of(study, point), *[(f"<code>{pointer}</code>", value) for pointer, value in settings]])
    rows = [[q.name, q.value_text(point.value(q)), error_text(q, point), "yes" if q.name in point.front else ""]
            for q in study.quantities]
    if not point.failed:
        known = [q for q in study.quantities if point.error(q) is not None]
        distance = "error" if all(point.has_error(q) for q in known) else "error or difference"
        html += page.as_html(Table(["", "value", distance, "front"], rows))
    return html + (f"<p>Remade by</p>\n{command(point.command)}\n" if point.command else "")


def costs_of(study, point):
    rows = []
    for cost in study.costs:
        value, low, high = (point.cost_of(cost.key + end) for end in ("", "_low", "_high"))
        if value is None:
            continue
        spread = f" ({cost.text(low)} to {cost.text(high)})" if low is not None and high is not None else ""
        rows.append((escaped(cost.name), escaped(cost.text(value) + spread)))
    steps = point.cost_of("steps")
    if steps is not None and all(cost.key != "steps" for cost in study.costs):
        rows.append(("steps", escaped(number_text(steps, 7))))
    return rows
