"""Error against what is refined, with the order at which it falls."""

from math import exp, log

from tamp.charts import point_chart
from tamp.charts.lines import lines_of_methods
from tamp.charts.chart_spec import Across, ChartSpec
from tamp.charts.formatting import number_text

ABOUT_DIFFERENCES = """Towards the {} everything is finer. These are differences from a run of whose own error there is
no bound, so that no order is claimed."""
ABOUT = """Towards the {} everything is finer. An order is the slope of a line through the errors: half the {} divides
them by two to its power."""


def charts(study, quantity, prefix):
    if not study.refine or not quantity.has_reference or not any(p.refine for p in study.charted):
        return []
    name = study.refine.get("name", study.refine.get("pointer", ""))
    lines, guides = lines_with_orders(study, quantity)
    across = Across(name, lambda p: p.refine, study.refine_text, ticks_at_values=True)
    about = ABOUT if quantity.has_bound else ABOUT_DIFFERENCES
    about = about.format("right" if rises(study, quantity) else "left", name)
    if quantity.has_bound:
        about += "".join(f" {label}: {note}." for label, note in notes(study, quantity))
    return [point_chart.make(ChartSpec(study, quantity, across, lines, None, guides), f"{prefix}-convergence",
                             f"{point_chart.distance_of(quantity)} against {name}", about)]


def lines_with_orders(study, quantity):
    """Fitted lines as the study says; methods of which it says nothing, without an order."""
    by_id = {p.id: p for p in study.charted}
    lines, guides = [], []
    for fit in quantity.orders:
        points = [by_id[i] for i in fit.get("points", []) if i in by_id]
        if not points:
            continue
        order = fit.get("order") if all(p.failed or p.has_error(quantity) for p in points) else None
        lines.append((fit["method"], label_of(fit, order, points, quantity), points))
        if order is not None:
            guides += guide(fit["method"], order, points, quantity)
    fitted_methods = {fit["method"] for fit in quantity.orders}
    for method, groups in lines_of_methods(study):
        if method not in fitted_methods:
            lines += [(method, method, [p for p in points if p.refine]) for points in groups]
    return lines, guides


def label_of(fit, order, points, quantity):
    label = fit.get("label") or fit["method"]
    if order is not None:
        return f"{label}: order {number_text(order)}"
    if any(p.has_error(quantity) for p in points):
        return f"{label}: no order"
    return f"{label}: difference" if quantity.has_bound else label


def rises(study, quantity):
    """Whether larger values are finer, as of a number of particles: fits go from coarse to fine."""
    by_id = {p.id: p for p in study.charted}
    fits = [[by_id[i].refine for i in fit.get("points", []) if i in by_id] for fit in quantity.orders]
    return any(fit[0] < fit[-1] for fit in fits if len(fit) > 1 and None not in fit)


def guide(method, order, points, quantity):
    """Through the middle of the points, which is where a fit of least squares passes."""
    known = [(p.refine, abs(p.error(quantity))) for p in points if p.refine and p.error(quantity) and not p.failed]
    if len(known) < 2:
        return []
    middle_x, middle_y = (sum(log(pair[k]) for pair in known) / len(known) for k in (0, 1))
    xs = [min(x for x, _ in known), max(x for x, _ in known)]
    slope = order if known[0][0] > known[-1][0] else -order
    return [(method, xs, [exp(middle_y + slope * (log(x) - middle_x)) for x in xs])]


def notes(study, quantity):
    return [(fit.get("label") or fit["method"], fit["note"].rstrip(".")) for fit in quantity.orders
            if fit.get("note") and fit["method"] in {method["name"] for method in study.lines}]
