"""A chart of points in words and in a table."""

from tamp.charts.chart import Table
from tamp.charts.chart_spec import drawable, shown_uncertainty
from tamp.charts.formatting import NO_NUMBER, counted


def describe(spec):
    """The chart in words and numbers, for readers who cannot see it."""
    drawn, across = drawable(spec), spec.across
    n_methods = len({p.method for p in drawn.points})
    sentences = [f"{counted(len(drawn.points), 'point')} of {counted(n_methods, 'method')}."]
    with_error = [p for p in drawn.points if p.has_error(spec.quantity)]
    if with_error and spec.quantity.has_reference:
        best = min(with_error, key=lambda p: (abs(spec.up(p)), across.of(p)))
        least = spec.up_text(abs(spec.up(best)))
        sentences.append(f"The least error, {least}, has {best.name} at {across.text(across.of(best))}.")
    sentences += [f"{p.name} differs from the reference by {spec.up_text(abs(spec.up(p)))}."
                  for p in drawn.points if spec.quantity.has_reference and p not in with_error]
    for p in sorted((p for p in spec.front or [] if p in drawn.points), key=across.of):
        sentences.append(f"On the Pareto front: {p.name}, {across.text(across.of(p))}, {spec.up_text(spec.up(p))}.")
    if spec.quantity.has_reference and spec.quantity.uncertainty:
        n_within = sum(abs(spec.up(p)) <= spec.quantity.uncertainty for p in with_error)
        sentences.append(f"The reference itself is uncertain by {spec.up_text(spec.quantity.uncertainty)}; "
                         f"{counted(n_within, 'point lies', 'points lie')} within that.")
    if drawn.zeros:
        sentences.append(f"{counted(len(drawn.zeros), spec.quantity.distance_name)} of 0 at the lower edge.")
    return " ".join(sentences + [f"No result: {p.name}, {p.why}." for p in spec.failed()])


def caption(spec, about):
    drawn, quantity = drawable(spec), spec.quantity
    sentences = [about]
    if quantity.has_reference and quantity.uncertainty and not shown_uncertainty(quantity, drawn.limits):
        uncertainty = quantity.error_text(quantity.uncertainty)
        sentences.append(f"The reference's own uncertainty, {uncertainty}, lies below the chart.")
    if drawn.zeros:
        sentences.append(f"{'An error' if quantity.has_bound else 'A difference'} of 0 stands at the lower edge.")
    if quantity.has_bound and any(not p.has_error(quantity) for p in drawn.points if quantity.has_reference):
        sentences.append("What another model than the reference's comes to differs from it: that is no error.")
    if spec.failed():
        sentences.append("Crosses above the axes are runs without a result, with the reason.")
    if not all(map(spec.has_place, spec.failed())):
        sentences.append("Where nothing is known of them along the axis they stand at its left end.")
    n_left_out = len(spec.left_out(drawn))
    if n_left_out:
        sentences.append(f"{counted(n_left_out, 'run has', 'runs have')} no place here, as a figure is missing.")
    return " ".join(sentences)


def table(spec):
    quantity, name = spec.quantity, spec.quantity.name
    what = f"{quantity.distance_name} of {name}" if quantity.has_reference else name
    head = ["method", "settings", spec.across.name, what]
    rows = []
    for p in spec.study.charted:
        x, y = spec.across.of(p), spec.up(p)
        result = (p.why if p.failed else NO_NUMBER if y is None else
                  quantity.distance_text(p) if quantity.has_reference else spec.up_text(y))
        row = [p.method, p.label, NO_NUMBER if x is None else spec.across.text(x), result]
        rows.append(row + (["yes" if p in spec.front else ""] if spec.front is not None else []))
    return Table(head + (["Pareto front"] if spec.front is not None else []), rows)
