"""Error against the cost of a step: whether a better answer comes from dearer steps or from more of them."""

from tamp.charts import point_chart
from tamp.charts.lines import lines_of_methods
from tamp.charts.chart_spec import Across, ChartSpec
from tamp.charts.formatting import si_text

ABOUT = """User time over steps. Where points stand one above the other, what differs comes from more steps, not from
dearer ones."""


def charts(study, quantity, prefix):
    if not quantity.has_reference or not any(p.step_cost for p in study.charted):
        return []
    across = Across("user time of a step", lambda p: p.step_cost, lambda value: si_text(value, "s"))
    lines = [(method, method, points) for method, groups in lines_of_methods(study) for points in groups]
    return [point_chart.make(ChartSpec(study, quantity, across, lines, None), f"{prefix}-step-cost",
                             f"{point_chart.distance_of(quantity)} against the cost of a step", ABOUT)]
