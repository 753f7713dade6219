"""Error against cost: the fewer seconds for the same error, and the less error for the same seconds, the better."""

from tamp.charts import point_chart
from tamp.charts.lines import lines_of_methods
from tamp.charts.chart_spec import Across, ChartSpec

ABOUT = """Further left is cheaper, further down is better. A line joins the runs of a method. Filled points are on the
Pareto front; for the pale ones another run is at least as cheap and as good."""
ABOUT_DIFFERENCES = """Further left is cheaper. These are differences from a run of whose own error there is no bound:
no point is better for being nearer to it. A line joins the runs of a method."""
ABOUT_VALUES = "There is no reference for this, so that no error is claimed: these are the values."


def charts(study, quantity, prefix):
    made = []
    for k, cost in enumerate(study.costs):
        across = Across(cost.name, lambda p, key=cost.key: p.cost_of(key), cost.text)
        front = None
        if quantity.has_bound:
            front = marked_front(study, quantity) if k == 0 else front_of(study, quantity, across)
        lines = [(method, method, points) for method, groups in lines_of_methods(study) for points in groups]
        spec = ChartSpec(study, quantity, across, lines, front)
        if k > 0 and not any(across.of(p) for p in study.charted):
            continue
        what = point_chart.distance_of(quantity) if quantity.has_reference else quantity.name
        about = ABOUT_VALUES if not quantity.has_reference else ABOUT if quantity.has_bound else ABOUT_DIFFERENCES
        made.append(point_chart.make(spec, f"{prefix}-{'work-precision' if k == 0 else cost.key.replace('_', '-')}",
                                     f"{what} against {cost.name}", about))
    return made


def marked_front(study, quantity):
    """The front of error and first cost, as the study found it."""
    return [p for p in study.charted if quantity.name in p.front]


def front_of(study, quantity, across):
    """The points that no other one beats in error and cost, or in one of them at the same of the other."""
    known = [p for p in study.charted
             if p.method != "reference" and not p.failed and p.has_error(quantity) and across.of(p) is not None]
    figures = {p.id: (across.of(p), abs(p.error(quantity))) for p in known}
    return [p for p in known if not any(beats(figures[q.id], figures[p.id]) for q in known)]


def beats(one, other):
    return all(a <= b for a, b in zip(one, other)) and one != other
