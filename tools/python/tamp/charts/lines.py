"""Which points of a method a line joins."""

import json


def lines_of_methods(study):
    """A line joins points that differ by what is refined alone. Where nothing is, or where such lines have a point
    each, all points of the method are joined by their cost."""
    lines = []
    for method in study.lines:
        points = [p for p in study.charted if p.method == method["name"]]
        groups = refined_alone(study, points)
        if not any(len(group) > 1 for group in groups):
            groups = [sorted(points, key=first_cost(study))]
        lines.append((method["name"], groups))
    return lines


def refined_alone(study, points):
    if not study.refine or any(p.refine is None for p in points):
        return []
    groups = {}
    for p in points:
        others = {key: value for key, value in p.settings.items() if key != study.refine.get("pointer")}
        groups.setdefault(json.dumps(others, sort_keys=True), []).append(p)
    return [sorted(group, key=lambda p: -p.refine) for group in groups.values()]


def first_cost(study):
    key = study.costs[0].key if study.costs else "core_s"
    return lambda p: p.cost_of(key) or 0
