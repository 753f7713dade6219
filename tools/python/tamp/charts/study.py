"""The content of a study.json, with its defaults filled in."""

import json
from typing import NamedTuple

from tamp import files
from tamp.charts.theme import styles_of_methods
from tamp.charts.formatting import is_number, number_text, percent_text, plain, si_text


class Quantity(NamedTuple):
    name: str
    unit: str
    relative: bool
    reference: dict
    orders: list

    @property
    def has_reference(self):
        return self.reference.get("kind", "none") != "none"

    @property
    def has_bound(self):
        """Whether the reference is near the answer, within what is known: else distances from it are no errors."""
        return self.reference.get("bound", True)

    @property
    def distance_name(self):
        """The name of distances from the reference."""
        return "error" if self.has_bound else "difference"

    @property
    def uncertainty(self):
        """The reference's own, in the unit of errors; None where there is no bound, 0 for an exact answer."""
        value = self.reference.get("uncertainty")
        return value if is_number(value) and value >= 0 and self.has_bound else None

    def value_text(self, value):
        return si_text(value, self.unit)

    def error_text(self, error, digits=3):
        return percent_text(error, digits) if self.relative else si_text(error, self.unit, digits)

    def distance_text(self, point, digits=3):
        """A point's distance from the reference, which says so where it is no error though others are."""
        text = self.error_text(abs(point.error(self)), digits)
        return f"{text} (difference)" if self.has_bound and not point.has_error(self) else text


class Point(NamedTuple):
    id: int
    method: str
    label: str
    settings: dict
    refine: float
    ended: str
    reason: str
    cost: dict
    values: dict
    errors: dict
    differences: list
    front: list
    command: str

    @property
    def failed(self):
        return self.ended != "done"

    @property
    def why(self):
        """How it ended, in words."""
        if not self.reason or self.reason.startswith(self.ended):
            return self.reason or self.ended
        return f"{self.ended}: {self.reason}"

    @property
    def name(self):
        return f"{self.method}, {self.label}" if self.label else self.method

    def value(self, quantity):
        return number_or_none(self.values.get(quantity.name))

    def error(self, quantity):
        """The distance from the reference, be it an error or a difference."""
        return number_or_none(self.errors.get(quantity.name))

    def has_error(self, quantity):
        return quantity.has_bound and self.error(quantity) is not None and quantity.name not in self.differences

    def cost_of(self, key):
        return number_or_none(self.cost.get(key))

    @property
    def step_cost(self):
        """User time of a step [s]."""
        time, steps = self.cost_of("core_s"), self.cost_of("steps")
        return time / steps if time is not None and steps else None


class Cost(NamedTuple):
    key: str
    name: str
    unit: str

    def text(self, value):
        return si_text(value, self.unit)


class Study:
    def __init__(self, document):
        document = plain(document)
        self.document = document
        self.title = document.get("title") or document.get("name", "A study")
        self.costs = [Cost(c["key"], c.get("name", c["key"]), c.get("unit", "")) for c in document.get("costs", [])]
        self.refine = document.get("refine")
        self.points = [point_of(p, k + 1) for k, p in enumerate(document.get("points", []))]
        listed = document.get("methods", [])
        names = [method["name"] for method in listed]
        unlisted = dict.fromkeys(p.method for p in self.points if p.method not in names)
        self.methods = [*listed, *({"name": name} for name in unlisted)]
        # Variations of an error budget are no method that one would choose: the budget's chart tells of them.
        self.lines = [method for method in self.methods if method.get("line", True)]
        named = {method["name"] for method in self.lines}
        self.charted = [p for p in self.points if p.method in named]
        self.styles = styles_of_methods(self.lines)
        self.quantities = [quantity_of(q) for q in document.get("quantities", [])]
        self.budgets = document.get("budgets") or []
        self.expected = document.get("gates") or []

    def failed(self):
        return [point for point in self.points if point.failed]

    def failed_in_charts(self):
        return [point for point in self.charted if point.failed]

    def refine_text(self, value):
        return si_text(value, self.refine.get("unit", "")) if self.refine else number_text(value)


def read_study(folder):
    return Study(files.document(folder / "study.json"))


def number_or_none(value):
    return value if is_number(value) else None


def quantity_of(q):
    orders = q.get("orders") or []
    return Quantity(q["name"], q.get("unit", ""), q.get("relative", True), q.get("reference") or {}, orders)


def point_of(p, place):
    return Point(
        p.get("id", place), p.get("method", ""), p.get("label", ""), p.get("settings") or {},
        number_or_none(p.get("refine")), p.get("ended", "done"), p.get("reason") or "", p.get("cost") or {},
        p.get("values") or {}, p.get("errors") or {}, p.get("differences") or [], p.get("front") or [],
        p.get("command") or "",
    )


def setting_text(value):
    if is_number(value):
        return number_text(value, 6)
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
