"""Pages that need nothing but themselves: one HTML file with its drawings, style and script inside."""

import pathlib

from tamp.charts import picture, theme
from tamp.charts.formatting import escaped

HERE = pathlib.Path(__file__).resolve().parent


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
    named = f' class="{kind}"' if kind else ""
    return wide(f"<table{named}>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>", "Figures")


def wide(table, name):
    """In a box of its own, which scrolls where the page is too narrow."""
    return f'<div class="wide" tabindex="0" role="region" aria-label="{name}">{table}</div>\n'


def figure(chart, labels=None):
    """`labels`: what each point is called, of those that can be chosen."""
    drawings = drawing(chart.wide, "broad", labels or {}) + drawing(chart.narrow, "narrow", labels or {})
    caption = f"<figcaption>{escaped(chart.caption)}</figcaption>\n" if chart.caption else ""
    details = ""
    if chart.table.rows:
        details = f"<details><summary>The figures of this chart</summary>\n{as_html(chart.table)}</details>\n"
    return (f'<figure class="chart" id="chart-{chart.name}">\n{drawings}{caption}'
            f"{details}</figure>\n")


def drawing(one, kind, labels):
    """With a button over each point, of which the first is reached by Tab and the others by arrow keys."""
    places = sorted((place for place in one.places if place.point in labels), key=lambda place: (place.x, place.y))
    buttons = "".join(button(place, labels[place.point], k == 0) for k, place in enumerate(places))
    group = f'<div role="group" aria-label="Points">\n{buttons}</div>\n' if buttons else ""
    return f'<div class="drawing {kind}">\n{picture.within_page(one)}{group}</div>\n'


def button(place, label, is_first):
    return (f'<button type="button" class="point" data-point="{place.point}" tabindex="{0 if is_first else -1}" '
            f'style="left:{100 * place.x:.2f}%;top:{100 * place.y:.2f}%" aria-label="{escaped(label)}"></button>\n')
