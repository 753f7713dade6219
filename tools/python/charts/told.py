"""A chart of points in words and in a table."""

from charts.chart import Table
from charts.plan import drawable, shown_uncertainty
from charts.words import NO_NUMBER, counted


def describe(plan):
    """What is to be seen, in numbers, for who cannot see it."""
    drawn, across = drawable(plan), plan.across
    n_methods = len({p.method for p in drawn.points})
    said = [f"{counted(len(drawn.points), 'point')} of {counted(n_methods, 'method')}."]
    if drawn.points and plan.quantity.has_reference:
        best = min(drawn.points, key=lambda p: (abs(plan.up(p)), across.of(p)))
        least = plan.up_text(abs(plan.up(best)))
        said.append(f"The least error, {least}, has {best.name} at {across.text(across.of(best))}.")
    for p in sorted((p for p in plan.front or [] if p in drawn.points), key=across.of):
        said.append(f"On the Pareto front: {p.name}, {across.text(across.of(p))}, {plan.up_text(plan.up(p))}.")
    if plan.quantity.has_reference and plan.quantity.uncertainty:
        n_within = sum(abs(plan.up(p)) <= plan.quantity.uncertainty for p in drawn.points)
        said.append(f"The reference itself is uncertain by {plan.up_text(plan.quantity.uncertainty)}; "
                    f"{counted(n_within, 'point lies', 'points lie')} within that.")  # fmt: skip
    if drawn.zeros:
        said.append(f"{counted(len(drawn.zeros), 'error')} of 0 at the lower edge.")
    return " ".join(said + [f"No result: {p.name}, {p.why}." for p in plan.failed()])


def caption(plan, about):
    drawn, quantity = drawable(plan), plan.quantity
    said = [about]
    if quantity.has_reference and quantity.uncertainty and not shown_uncertainty(quantity, drawn.limits):
        uncertainty = quantity.error_text(quantity.uncertainty)
        said.append(f"The reference's own uncertainty, {uncertainty}, lies below the chart.")
    if drawn.zeros:
        said.append("An error of 0 stands at the lower edge.")
    if plan.failed():
        said.append("Crosses above the axes are runs without a result, with the reason.")
    if not all(map(plan.has_place, plan.failed())):
        said.append("Where nothing is known of them along the axis they stand at its left end.")
    n_left_out = len(plan.left_out(drawn))
    if n_left_out:
        said.append(f"{counted(n_left_out, 'run has', 'runs have')} no place here, as a figure is missing.")
    return " ".join(said)


def table(plan):
    name = plan.quantity.name
    head = ["method", "settings", plan.across.name, f"error of {name}" if plan.quantity.has_reference else name]
    rows = []
    for p in plan.study.charted:
        x, y = plan.across.of(p), plan.up(p)
        result = p.why if p.failed else NO_NUMBER if y is None else plan.up_text(y)
        row = [p.method, p.label, NO_NUMBER if x is None else plan.across.text(x), result]
        rows.append(row + (["yes" if p in plan.front else ""] if plan.front is not None else []))
    return Table(head + (["Pareto front"] if plan.front is not None else []), rows)
