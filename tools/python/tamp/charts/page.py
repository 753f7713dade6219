"""Pages that need nothing but themselves: one HTML file with its drawings, style and script inside."""

import pathlib
import re

from tamp.charts import picture, theme
from tamp.charts.formatting import escaped

HERE = pathlib.Path(__file__).resolve().parent
MOST_COLUMNS = 3  # that stand beside each other on a phone
MOST_NAMES = 12  # of columns that page.css asks for


def whole_page(title, content, kind, script=""):
    """`kind` is the class of its body."""
    style = theme.style_sheet() + (HERE / "page.css").read_text(encoding="utf-8")
    script = f"<script>\n{script}</script>\n" if script else ""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{escaped(title)}</title>
<style>
{style}</style>
</head>
<body class="{kind}">
{content}{script}</body>
</html>
"""


def as_html(table, kind=""):
    """`kind` is the table's class: "words" has sentences in its last column."""
    def row(cells):
        return "<tr>" + "".join(f"<td>{escaped(cell)}</td>" for cell in cells) + "</tr>\n"

    head = "".join(f'<th scope="col">{escaped(cell)}</th>' for cell in table.head)
    body = "".join(map(row, table.rows))
    kinds = [kind] * bool(kind) + ["broad-table"] * (len(table.head) > MOST_COLUMNS)
    named = f' class="{" ".join(kinds)}"' if kinds else ""
    content = f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>"
    return wide(f"<table{named}{names_of_columns(table.head)}>\n{content}\n</table>", "Figures")


def names_of_columns(head):
    """On a narrow page a row of a broad table stands below itself, each cell behind the name of its column."""
    if len(head) <= MOST_COLUMNS:
        return ""
    names = "; ".join(f"--column-{k}: {in_css(name)}" for k, name in enumerate(head[1:MOST_NAMES], start=2))
    return f' style="{escaped(names)}"'


def in_css(text):
    return '"' + re.sub(r"[^A-Za-z0-9 ]", lambda sign: f"\\{ord(sign[0]):x} ", str(text)) + ' "'


def wide(table, name):
    """In a box of its own, which scrolls where the page is too narrow."""
    return f'<div class="wide" tabindex="0" role="region" aria-label="{name}">{table}</div>\n'


def figure(chart, labels=None):
    """`labels`: what each point is called, of those that can be chosen."""
    drawings = drawing(chart.wide, "broad", labels or {}) + drawing(chart.narrow, "narrow", labels or {})
    return figure_of(chart.name, drawings, chart.caption, chart.table)


def figure_of(name, drawings, caption, table):
    caption = f"<figcaption>{escaped(caption)}</figcaption>\n" if caption else ""
    details = ""
    if table.rows:
        details = f"<details><summary>Data of this chart</summary>\n{as_html(table)}</details>\n"
    return f'<figure class="chart" id="chart-{name}">\n{drawings}{caption}{details}</figure>\n'


def beside(figures):
    """In as many columns as there is room for."""
    return '<div class="charts">\n' + "".join(figures) + "</div>\n"


def drawing(one, kind, labels):
    """With a button over each point, of which the first is reached by Tab and the others by arrow keys."""
    places = sorted((place for place in one.places if place.point in labels), key=lambda place: (place.x, place.y))
    buttons = "".join(button(place, labels[place.point], k == 0) for k, place in enumerate(places))
    group = f'<div role="group" aria-label="Points">\n{buttons}</div>\n' if buttons else ""
    return f'<div class="drawing {kind}">\n{picture.within_page(one)}{group}</div>\n'


def button(place, label, is_first):
    return (f'<button type="button" class="point" data-point="{place.point}" tabindex="{0 if is_first else -1}" '
            f'style="left:{100 * place.x:.2f}%;top:{100 * place.y:.2f}%" aria-label="{escaped(label)}"></button>\n')
