"""The sand over time: a picture of each output of fields, moved through by a slider, all within the page."""

import json

import numpy as np

from tamp.charts import laid_over, page, sand_charts, shades
from tamp.charts.axes import NARROW, WIDE
from tamp.charts.chart import Table
from tamp.charts.formatting import counted, escaped, si_text
from tamp.charts.sand import MOVING, of_sand

MOST_BYTES = 3_000_000  # of all pictures, as the page holds them
ROOM_FOR_AXES = 200_000
N_ROWS = 12  # of the table


def section(sand, room=MOST_BYTES):
    """In so many bytes at most. Nothing where there is but one output."""
    if sand is None or len(sand.frames) < 2:
        return ""
    scales = {one.field: shades.scale_of(one, sand_charts.main_values(sand, sand.frames, one.field))
              for one in sand.shown}
    shown = {field: list(sand_charts.shown_of(sand, sand.frames, field, scale)) for field, scale in scales.items()}
    pictures, share = laid_over.fitted(shown, scales, min(room - ROOM_FOR_AXES, MOST_BYTES))
    data = {"pictures": pictures, "times": [said(sand, frame) for frame in sand.frames]}
    return (f'<h2>The sand over time</h2>\n<figure class="movie" id="movie" data-first="{sand.peak}">\n'
            f"{controls(sand)}{drawings(sand, scales)}"
            f"<figcaption>{escaped(caption(sand, scales, share))}</figcaption>\n{figures(sand)}</figure>\n"
            f'<script type="application/json" id="movie-data">{as_json(data)}</script>\n')


def as_json(data):
    """No text of it ends the script that holds it."""
    return json.dumps(data).replace("<", "\\u003c")


# --- what it consists of ---


def controls(sand):
    """Hidden until the script runs."""
    n, first = len(sand.frames), sand.peak
    choices = "".join(f'<label><input type="radio" name="movie-quantity" value="{one.field}"{" checked" * (k == 0)}> '
                      f"{escaped(one.short)}</label>\n" for k, one in enumerate(sand.shown))
    return (f'<div class="controls" hidden>\n<fieldset><legend>Quantity</legend>\n{choices}</fieldset>\n'
            '<div class="way"><button type="button">Play</button>\n'
            f'<input type="range" min="0" max="{n - 1}" step="1" value="{first}" aria-label="Time of the picture">\n'
            "</div>\n<output></output>\n</div>\n<noscript><p>The slider over time needs scripts, which are turned off "
            "here.</p></noscript>\n")


def drawings(sand, scales):
    """Axes and bar of each quantity, over which the picture is laid."""
    return "".join(f'<div class="quantity" data-quantity="{one.field}"{" hidden" * (k > 0)}>\n'
                   f'{drawing(sand, one, scales[one.field], WIDE, "broad")}'
                   f'{drawing(sand, one, scales[one.field], NARROW, "narrow")}</div>\n'
                   for k, one in enumerate(sand.shown))


def drawing(sand, quantity, scale, layout, kind):
    name = f"movie-{quantity.field.replace('_', '-')}-{kind}"
    sheet = sand_charts.sheet_of(layout, sand, quantity, quantity.title, scale)
    return laid_over.drawing(sheet, name, quantity.title, describe(sand, quantity), kind)


# --- the words ---


def said(sand, frame):
    """The time of a picture, and how large then what tells the greatest force."""
    text, moment = si_text(frame.time, "s"), sand.wanted.moment
    return f"{text}; {moment.name} {si_text(moment.at(frame.time), moment.unit)}" if moment else text


def caption(sand, scales, share):
    n = len(sand.frames)
    text = "One scale for all times" + ("; values beyond it take its end colour." if any_beyond(sand, scales) else ".")
    if n < sand.n_outputs:
        text += f" Thinned: {n} of {counted(sand.n_outputs, 'output')} of fields are here."
    if share < 1:
        text += f" Thinned: {round(share * MOVING)} squares along the longer side, so that the page stays small."
    return text


def any_beyond(sand, scales):
    values = ((of_sand(frame, field), scale) for frame in sand.frames for field, scale in scales.items())
    return any(sand_charts.beyond(found, scale) for found, scale in values)


def describe(sand, quantity):
    first, last = (si_text(sand.frames[k].time, "s") for k in (0, -1))
    return f"{counted(len(sand.frames), 'picture')} from {first} to {last}; the figures are in the table below."


def figures(sand):
    rows = []
    for k in np.unique(np.linspace(0, len(sand.frames) - 1, N_ROWS).round().astype(int)):
        frame = sand.frames[k]
        rows.append([si_text(frame.time, "s"),
                     *(sand_charts.range_text(of_sand(frame, one.field), one.unit) for one in sand.shown)])
    table = page.as_html(Table(["time", *(one.short for one in sand.shown)], rows))
    return f"<details><summary>Data of these pictures</summary>\n{table}</details>\n"
