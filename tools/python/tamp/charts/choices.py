"""The choices of a run's scene, in a table: those that the scene names, and those left at their defaults."""

import re

from tamp.charts.chart import Table
from tamp.charts.formatting import NO_NUMBER, number_text, si_text

NUMBERS = [("/grid/cell_size", "cell size", "m"), ("/grid/patches", "patches", ""),
           ("/particles_per_cell", "particles per cell", ""), ("/time/multiplier", "time multiplier", ""),
           ("/artificial_viscosity", "artificial viscosity", ""), ("/local_damping", "local damping", ""),
           ("/gravity", "gravity", "m/s²"), ("/centrifuge", "centrifuge", "")]
NORMALS = {"regression": "its normal is that of a plane which parts the particles of both at each node",
           "flatter": "its normal is that of the flatter surface at each node",
           "solid": "its normal is that of the solid of the rigid body"}
CELLS = "on its way into {}; with fewer than 6 the force on it is a tenth or more too large"


def table(*rows):
    return Table(["choice", "is", "from", "meaning"], sum(rows, []))


def source(pointers, left_out):
    if left_out is None:
        return NO_NUMBER
    by_default = [any(pointer == key or pointer.startswith(key + "/") for key in left_out) for pointer in pointers]
    return "default" if all(by_default) else "scene and default" if any(by_default) else "scene"


def word_rows(words, left_out):
    """A row for each word of a key, whichever faces, materials or bodies have it."""
    groups = {}
    for word in words:
        label, owner = place(word["key"])
        meaning = word["about"] + word["meaning"] if word["meaning"] else of_word(word["about"], word["word"])
        pointers, owners = groups.setdefault((label, word["word"], meaning), ([], []))
        pointers.append(word["key"])
        owners.append(owner)
    return [[label + (f" of {', '.join(owners)}" if any(owners) else ""), word.replace("_", " "),
             source(pointers, left_out), without_marks(meaning)]
            for (label, word, meaning), (pointers, owners) in groups.items()]


def place(pointer):
    """The choice, and whose it is: "elastic update" and "sand", "boundaries" and "x-", "time rule" and nothing."""
    first, *rest = pointer.strip("/").split("/")
    if first == "boundaries":
        return first, rest[0]
    if first in ("materials", "bodies"):
        return " ".join(rest[1:]).replace("_", " "), rest[0]
    return " ".join([first, *rest]).replace("_", " "), ""


def of_word(about, word):
    """What a text that explains all words of a key, each at the beginning of a part, says of one; or all of it."""
    parts = re.split(r"; (?=`\")", about)
    return next((part.partition("`, " if part.startswith(f'`"{word}"`, ') else "`: ")[2] for part in parts
                 if part.startswith(f'`"{word}"`')), about)


def without_marks(meaning):
    """Without Markdown's."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", meaning.replace("`", ""))


def contact_rows(scene, left_out):
    if not scene["contact"] and len(scene["materials"]) > 1:
        return [["contact", "without friction", source(["/contact"], left_out), "no pair of materials is listed"]]
    return [[f"contact of {' and '.join(pair['materials'])}",
             f"{pair['normal']}, friction {number_text(pair['friction'])}",
             source([f"/contact/{k}/normal"], left_out),
             NORMALS.get(pair["normal"], f"its normal is that of the surface of {pair['normal']}")]
            for k, pair in enumerate(scene["contact"])]


def number_rows(scene, left_out):
    rows = []
    for pointer, name, unit in NUMBERS:
        value = scene
        for part in pointer.strip("/").split("/"):
            value = value.get(part)
        if pointer != "/centrifuge" or value is not None:
            rows.append([name, value_text(value, unit), source([pointer], left_out), ""])
    return rows


def value_text(value, unit):
    if value is None:
        return "off"
    if isinstance(value, list):
        return (" × " if unit == "" else ", ").join(map(number_text, value)) + f" {unit}".rstrip()
    if isinstance(value, dict):
        return "; ".join(f"{key.replace('_', ' ')} {member_text(one)}" for key, one in value.items())
    return si_text(value, unit)


def member_text(value):
    return "(" + ", ".join(map(number_text, value)) + ")" if isinstance(value, list) else number_text(value)


def cell_rows(bodies):
    return [[f"cells across {name}", f"{number_text(body['cells_to_half_width'], 2)} to its half width", NO_NUMBER,
             CELLS.format(body["into"])]
            for name, body in bodies.items() if "cells_to_half_width" in body]
