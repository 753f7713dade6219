"""From figures to SVG and PNG: files of their own, and drawings within a page, with a text for who cannot see them."""

import io
import re
import xml.etree.ElementTree as ElementTree
from typing import NamedTuple

import matplotlib

from tamp.charts import theme

SVG, XLINK = "http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"
ElementTree.register_namespace("", SVG)
ElementTree.register_namespace("xlink", XLINK)


class Place(NamedTuple):
    """Where a point stands, in shares of the picture's width and height, from its upper left corner."""

    point: int
    x: float
    y: float


class Picture(NamedTuple):
    svg: str
    png: bytes
    width: float
    height: float
    places: list


def as_picture(figure, name, title, description, places=(), png=False, tips=None):
    """`name` is the picture's alone on its page; `tips` are texts under the mouse, by gids."""
    matplotlib.rcParams["svg.hashsalt"] = name
    width, height = (72 * size for size in figure.get_size_inches())
    text, pixels = io.StringIO(), io.BytesIO()
    figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    if png:
        figure.savefig(pixels, format="png", dpi=144, metadata={"Software": None})
    svg = with_texts(text.getvalue(), name, title, description, tips or {})
    return Picture(svg, pixels.getvalue(), width, height, list(places))


def with_texts(svg, name, title, description, tips):
    root = ElementTree.fromstring(svg.encode())
    for metadata in root.findall(f"{{{SVG}}}metadata"):
        root.remove(metadata)
    for element in list(root.iter()):
        if element.get("id") in tips:
            ElementTree.SubElement(element, f"{{{SVG}}}title").text = tips[element.get("id")]
        with_own_ids(element, name)
        if "d" in element.attrib:  # a hundredth of a point is enough
            element.set("d", re.sub(r"(\.\d\d)\d+", r"\1", element.get("d")))
        if "font:" in element.get("style", ""):
            element.set("style", re.sub(r"'DejaVu Sans'[^;]*", theme.FONT_OF_FILES, element.get("style")))
    root.set("role", "img")
    root.set("aria-labelledby", f"{name}-title")
    root.set("aria-describedby", f"{name}-description")
    for place, (tag, kind, text) in enumerate([("title", "title", title), ("desc", "description", description)]):
        element = ElementTree.Element(f"{{{SVG}}}{tag}", {"id": f"{name}-{kind}"})
        element.text = text
        element.tail = "\n"
        root.insert(place, element)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def with_own_ids(element, name):
    """Ids that no other picture of a page has."""
    for key, value in element.attrib.items():
        if key == "id":
            element.set(key, f"{name}-{value}")
        elif key in ("href", f"{{{XLINK}}}href") and value.startswith("#"):
            element.set(key, f"#{name}-{value[1:]}")
        elif "url(#" in value:
            element.set(key, value.replace("url(#", f"url(#{name}-"))


def within_page(picture):
    """Without sizes of its own; in the colours of the page."""
    head, rest = picture.svg.split(">", 1)
    return theme.for_page(re.sub(r' (width|height)="[^"]*"', "", head) + ">" + rest)


def file_text(picture):
    """No wider than a window that shows it by itself."""
    fitting = picture.svg.replace("<svg ", '<svg style="max-width: 100%; height: auto" ', 1)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + fitting


def write_files(picture, folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.svg").write_text(file_text(picture), encoding="utf-8")
    (folder / f"{name}.png").write_bytes(picture.png)
