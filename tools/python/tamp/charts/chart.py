"""A chart of a page: its drawings for wide and narrow pages, words about it, and its figures in a table."""

from typing import NamedTuple

from tamp.charts import picture
from tamp.charts.axes import NARROW, WIDE


class Table(NamedTuple):
    head: list
    rows: list


class Chart(NamedTuple):
    name: str  # of its files, and its own on its page
    title: str
    description: str  # the chart in words and numbers, for readers who cannot see it
    caption: str
    wide: picture.Picture
    narrow: picture.Picture
    table: Table


def make_chart(name, title, description, caption, table, draw, layouts=(WIDE, NARROW)):
    """`draw` makes the sheet for a layout and the places of its points."""
    drawings = []
    for layout in layouts:
        sheet, places = draw(layout)
        own_name = f"{name}-narrow" if layout is NARROW else name
        drawings.append(picture.as_picture(sheet.figure, own_name, title, description, places, png=layout is WIDE,
                                           tips=sheet.tips))
    return Chart(name, title, description, caption, *drawings, table)
