"""The map of a study: which combinations of two settings are stable, noisy or blown, a cell for each run."""

import re

from tamp.charts.axes import Entry, Sheet, text_width, wrapped
from tamp.charts.chart import Table, make_chart
from tamp.charts.formatting import NO_NUMBER, counted, number_text
from tamp.charts.picture import Place
from tamp.charts.theme import LIGHT, Style, hue

COLOURS = {"stable": hue(2), "noisy": hue(1), "blown": hue(3), "refused": LIGHT["faint"]}
ABOUT = """Each cell is a run. {} counts as noisy from {} on and as blown from {} on. A run that failed is blown, and
has the step at which it did, or a cross."""
ABOUT_REFUSED = " Grey combinations are refused: the program does not take them."
ABOUT_BOUND = " Right of the dashed line steps are longer than the bound of theory allows."
ROW, LABELS = 30, 34  # heights of a row of cells, and of what stands above the columns


def charts(study, quantity, prefix):
    document = study.document.get("map") or {}
    if document.get("quantity") != quantity.name:
        return []
    reasons = {point.id: point.reason for point in study.points}
    return [chart(document, sheet, reasons, quantity, f"{prefix}-map-{k + 1}")
            for k, sheet in enumerate(document["sheets"])]


def chart(document, cells, reasons, quantity, name):
    title = f"{cells['name']}: {cells['rows_name']} and {cells['columns_name']}"
    return make_chart(name, title, describe(cells), caption(document, cells, quantity),
                      table(cells, reasons, quantity), lambda layout: draw(cells, reasons, quantity, title, layout))


def value_text(value):
    """A list, such as of particles along each axis, is short."""
    if isinstance(value, list):
        return " × ".join(map(value_text, value))
    return number_text(value) if isinstance(value, (int, float)) else str(value).replace("_", " ")


def cell_text(cell, reasons, quantity):
    """The number that decides."""
    if cell["distance"] is not None:
        return quantity.error_text(cell["distance"], 2)
    if cell["verdict"] == "refused":
        return NO_NUMBER
    failed = re.match(r"step \d+", reasons.get(cell["point"], ""))
    return failed[0] if failed else "✕"


def draw(cells, reasons, quantity, title, layout):
    """The sheet, and the places of its cells."""
    rows, columns = cells["row_values"], cells["column_values"]
    font = layout.font - 1
    left = 14 + max(text_width(value_text(row), font) for row in rows)
    height = ROW * len(rows) + LABELS
    sheet = Sheet(layout, title, "", cells["columns_name"], legend(cells), height=height, left=left)
    axis = sheet.axis
    axis.set(xlim=(0, len(columns)), ylim=(0, height), xticks=[], yticks=[])
    for spine in axis.spines.values():
        spine.set_visible(False)
    width = axis.bbox.width / len(columns)
    for k, row in enumerate(rows):
        axis.annotate(value_text(row), (0, middle(k, height)), (-6, 0), textcoords="offset points", ha="right",
                      va="center", size=font, color=LIGHT["ink"])
    for k, column in enumerate(columns):
        write_column(axis, value_text(column), k, width, height, font)
    texts = [cell_text(cell, reasons, quantity) for cell in cells["cells"]]
    places = [draw_cell(sheet, cell, text, width, height) for cell, text in zip(cells["cells"], texts)]
    draw_bound(axis, cells, height)
    return sheet, places


def middle(row, height):
    return height - LABELS - ROW * (row + 0.5)


def write_column(axis, text, k, width, height, font):
    """In two lines where one is too short."""
    lines = wrapped(text, width - 2, font)[:2]
    for n, line in enumerate(reversed(lines)):
        axis.annotate(line, (k + 0.5, height - LABELS + 5 + 13 * n), ha="center", size=font, color=LIGHT["ink"])


def draw_cell(sheet, cell, text, width, height):
    axis, font = sheet.axis, sheet.layout.font - 1
    x, y = cell["column"], middle(cell["row"], height)
    axis.fill([x, x + 1, x + 1, x], [y - ROW / 2, y - ROW / 2, y + ROW / 2, y + ROW / 2],
              facecolor=COLOURS[cell["verdict"]], edgecolor=LIGHT["paper"], lw=2, gid=f"cell-{cell['point']}")
    while text_width(text, font) > width - 4 and font > 6.5:
        font -= 0.5
    axis.annotate(text, (x + 0.5, y), ha="center", va="center_baseline", size=font, color=LIGHT["paper"])
    return Place(cell["point"], *sheet.share(axis, x + 0.5, y))


def draw_bound(axis, cells, height):
    bound = cells["bound"]
    if bound is None:
        return
    x = sum(column <= bound for column in cells["column_values"])
    axis.plot([x, x], [0, height - LABELS], color=LIGHT["ink"], lw=1.6, ls=(0, (4, 2)), gid="bound", clip_on=False)


def legend(cells):
    known = {cell["verdict"] for cell in cells["cells"]}
    entries = [Entry(f"{verdict} ({count(cells, verdict)})", Style(colour), filled=True)
               for verdict, colour in COLOURS.items() if verdict in known]
    if cells["bound"] is not None:
        entries.append(Entry("bound of theory", Style(LIGHT["ink"], dashes=(0, (4, 2)))))
    return entries


def count(cells, verdict):
    return sum(cell["verdict"] == verdict for cell in cells["cells"])


def describe(cells):
    sentences = [f"{counted(len(cells['cells']), 'run')}: "
                 + ", ".join(f"{count(cells, verdict)} {verdict}" for verdict in COLOURS) + "."]
    for k, row in enumerate(cells["row_values"]):
        found = [f"{value_text(cells['column_values'][cell['column']])} {cell['verdict']}"
                 for cell in cells["cells"] if cell["row"] == k]
        sentences.append(f"{value_text(row)}: {', '.join(found)}.")
    return " ".join(sentences)


def caption(document, cells, quantity):
    what = f"{'An error' if quantity.has_bound else 'A difference'} of {quantity.name}"
    text = ABOUT.format(what, quantity.error_text(document["noisy"]), quantity.error_text(document["blown"]))
    text += ABOUT_REFUSED if count(cells, "refused") else ""
    return text + (ABOUT_BOUND if cells["bound"] is not None else "")


def table(cells, reasons, quantity):
    rows = [[value_text(cells["row_values"][cell["row"]]), value_text(cells["column_values"][cell["column"]]),
             cell["verdict"],
             NO_NUMBER if cell["distance"] is None else quantity.error_text(cell["distance"]),
             reasons.get(cell["point"], "")]
            for cell in cells["cells"]]
    return Table([cells["rows_name"], cells["columns_name"], "is", quantity.distance_name, "why"], rows)
