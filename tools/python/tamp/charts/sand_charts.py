"""Pictures of the sand at the time of the greatest force, and in words."""

import numpy as np

from tamp.charts import laid_over, page, shades
from tamp.charts.axes import NARROW, Entry
from tamp.charts.chart import Table
from tamp.charts.formatting import NO_NUMBER, escaped, si_text
from tamp.charts.over_time import HALF
from tamp.charts.particles import plane_sheet
from tamp.charts.sand import of_sand
from tamp.charts.theme import Style

MOST_BYTES = 600_000  # of all pictures for wide pages; half as many for phones
NEARLY = 0.9  # of the greatest force; of less the page says how much it is
PART_OF_PHONE = 0.6  # so many squares along a side of its pictures


def section(sand):
    """With a line why where there are none."""
    if sand is None:
        return ""
    text = f"<h2>{heading(sand)}</h2>\n"
    if sand.why:
        return text + f"<p>There are no pictures of the sand: {escaped(sand.why)}.</p>\n"
    if sand.shown:
        text += f"<p>{escaped(lead(sand))}</p>\n" + page.beside(figures(sand))
    return text + lacking(sand)


def heading(sand):
    moment = sand.wanted.moment if sand.wanted else None
    return "The sand at the end" if not moment else f"The sand at the greatest {moment.kind}"


def figures(sand):
    """A figure of each quantity that fields.h5 holds."""
    scales = {one.field: shades.scale_of(one, main_values(sand, [sand.still], one.field)) for one in sand.shown}
    shown = {field: list(shown_of(sand, [sand.still], field, scale)) for field, scale in scales.items()}
    wide, share = laid_over.fitted(shown, scales, MOST_BYTES)
    narrow, _ = laid_over.fitted(shown, scales, MOST_BYTES / 2, share * PART_OF_PHONE)
    return [figure(sand, one, scales[one.field], wide[one.field][0], narrow[one.field][0]) for one in sand.shown]


def shown_of(sand, frames, field, scale):
    return (shades.indices(frame, field, scale, sand.wanted.rigid_numbers()) for frame in frames)


def figure(sand, quantity, scale, wide, narrow):
    values = of_sand(sand.still, quantity.field)
    title, about = f"{quantity.title} at {si_text(sand.still.time, 's')}", describe(sand, quantity, values)
    name = f"sand-{quantity.field.replace('_', '-')}"
    drawings = ""
    for layout, source, kind in [(HALF, wide, "broad"), (NARROW, narrow, "narrow")]:
        sheet = sheet_of(layout, sand, quantity, title, scale)
        if not len(values):
            sheet.say_empty("no sand here")
        drawings += laid_over.drawing(sheet, f"{name}-{kind}", title, about, kind, source)
    return page.figure_of(name, drawings, beyond(values, scale), table(sand, quantity))


def sheet_of(layout, sand, quantity, title, scale):
    """A plane and the bar of its colours, without what is in it."""
    heading = f"{title}; {quantity.about}" if quantity.about else title
    legend = [Entry(text, Style(shades.BODY_COLOUR), filled=True) for text in grey_here(sand, quantity)]
    sheet = plane_sheet(layout, heading, sand.wanted.plane.axes, legend, shades.FOOT)
    left = sheet.axis.get_position().x0 * layout.width
    shades.draw_bar(sheet, scale, left)
    return sheet


def grey_here(sand, quantity):
    """Materials that are drawn, but not in the colours of the bar."""
    for k, name in enumerate(sand.wanted.names):
        values = sand.still.value[quantity.field][sand.still.kind == k]
        if len(values) and not np.any(np.isfinite(values)):
            yield f"{name}, rigid" if name in sand.wanted.rigid else f"{name}, without it"


def main_values(sand, frames, field):
    """Values of the commonest material: one much stiffer or heavier beside it would leave it a single colour."""
    found = [values_of(sand, frame, field) for frame in frames]
    numbers = {k for one in found for k in one}
    parts = {k: np.concatenate([one[k] for one in found if k in one]) for k in numbers}
    return max(parts.values(), key=len, default=np.array([]))


def values_of(sand, frame, field):
    """By the numbers of materials that are not rigid; without what is no number."""
    made = {}
    for k, name in enumerate(sand.wanted.names):
        values = frame.value[field][frame.kind == k] if name not in sand.wanted.rigid else np.array([])
        values = values[np.isfinite(values)]
        if len(values):
            made[k] = values
    return made


# --- the words ---


def describe(sand, quantity, values):
    first, second = (axis["name"] for axis in sand.wanted.plane.axes)
    if not len(values):
        return f"{first} across and {second} upwards: no sand here."
    low, middle, high = (si_text(float(v), quantity.unit) for v in np.quantile(values, [0, 0.5, 1]))
    return (f"{first} across and {second} upwards: from {low} to {high}, median {middle}.")


def beyond(values, scale):
    """Values beyond the ends of the scale, in words."""
    if not len(values):
        return ""
    low, high = float(values.min()), float(values.max())
    said = [f"down to {scale.text(low)}"] * (low < scale.low) + [f"up to {scale.text(high)}"] * (high > scale.high)
    if not said:
        return ""
    return (f"Values beyond the colour bar ({' and '.join(said)}) take its end colour; they are often those of single "
            "particles, such as ones thrown up, or of another material.")


def table(sand, quantity):
    rows = []
    for k, values in values_of(sand, sand.still, quantity.field).items():
        at = np.quantile(values, [0, 0.05, 0.5, 0.95, 1])
        rows.append([sand.wanted.names[k], *(si_text(float(v), quantity.unit) for v in at)])
    return Table(["material", "least", "5th percentile", "median", "95th percentile", "greatest"], rows)


def lead(sand):
    """Which moment is shown, and of what."""
    time, moment = si_text(sand.still.time, "s"), sand.wanted.moment
    if moment:
        text = f"At {time}, the output of fields nearest to {moment.text}"
        text += " (a mean over the history interval)" if moment.kind == "force" else ""
        then, is_less = moment.at(sand.still.time), moment.at(sand.still.time) < NEARLY * moment.at(moment.time)
        text += f"; it is {si_text(then, moment.unit)} then." if is_less else "."
    else:
        text = f"At {time}, the last output of fields: the history has no force and no pressure that is above 0."
    slab = sand.wanted.plane.slab
    if slab:
        text += (f" Drawn are the particles within half a cell of {slab['axis']} = {si_text(slab['at'], 'm')}, the "
                 "plane through the middle.")
    return text + " Each square shows the particle nearest to it."


def lacking(sand):
    """A sentence for each quantity that the scene has not chosen."""
    return "".join(f"<p>No picture of {escaped(one.short)}: fields.h5 does not hold it. "
                   f'<code>"{one.field}"</code> in the scene\'s <code>output/fields</code> adds it.</p>\n'
                   for one in sand.lacking)


def range_text(values, unit):
    if not len(values):
        return NO_NUMBER
    return f"{si_text(float(values.min()), unit)} to {si_text(float(values.max()), unit)}"
