"""Rows of what a command has written, and the table that a recipe makes of them. All cells are texts."""

import csv
import io
import json
import math
import re

from tamp import files
from tamp.failure import Failure, Refusal

THOUSANDS = re.compile(r"-?\d{1,3}(,\d{3})+(\.\d+)?")
AGAINST_FORMULAS = re.compile(r"'(?=[=+\-@\t\r])")  # in points.csv


def text_of(value):
    """A value of JSON as CSVs have it."""
    if value is None or isinstance(value, str):
        return value or ""
    return json.dumps(value)


def number_of(text):
    return files.number(text.replace(",", "") if THOUSANDS.fullmatch(text) else text)


# Rows, by what holds them


def rows_of_csv(path):
    try:
        rows = list(csv.DictReader(io.StringIO(files.text(path), newline=""), strict=True, restval=""))
    except csv.Error as error:
        raise Failure(path, error, "a CSV") from None
    return [{name: AGAINST_FORMULAS.sub("", cell, count=1) if cell[:1] == "'" else cell for name, cell in row.items()
             if name is not None} for row in rows]


def flat(value, pointer=""):
    """What is in an object, by pointers."""
    if not isinstance(value, (dict, list)):
        return {pointer: text_of(value)}
    items = value.items() if isinstance(value, dict) else enumerate(value)
    return {place: text for key, one in items
            for place, text in flat(one, f"{pointer}/{str(key).replace('~', '~0').replace('/', '~1')}").items()}


def rows_of_json(path, at):
    """The elements of a list. Each has what is beside the lists on the way to it, too."""
    def walk(value, keys, beside):
        if isinstance(value, dict):
            beside = {**beside, **flat({key: one for key, one in value.items() if not isinstance(one, (dict, list))})}
        if keys and keys[0] == "*" and isinstance(value, list):
            return [row for one in value for row in walk(one, keys[1:], beside)]
        if keys and isinstance(value, dict) and keys[0] in value:
            return walk(value[keys[0]], keys[1:], beside)
        if keys or not isinstance(value, list):
            raise Failure(path, f"nothing at {at}" if keys else f"no list at {at}", "a list there")
        return [{**beside, **flat(one)} for one in value]

    keys = [key.replace("~1", "/").replace("~0", "~") for key in at.split("/")[1:]]
    return walk(files.document(path), keys, {})


def rows_of_markdown(place, text, at):
    """The rows of the tables below a heading, in whose text * stands for any."""
    is_asked_for = re.compile(re.escape(at).replace(r"\*", ".*"))
    rows, heading, above, names = [], "", "", None
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.startswith("|"):
            names = None
            heading = line.lstrip("# ") if line.startswith("#") else heading
            above = line.strip() or above
            continue
        cells = [cell.strip().replace("`", "") for cell in line.strip().removeprefix("|").removesuffix("|").split("|")]
        if not is_asked_for.fullmatch(heading) or all(re.fullmatch(":?-+:?", cell) for cell in cells):
            continue
        if names is None:
            names = cells
            if len(set(names)) < len(names):
                raise Failure(f"{place}:{number}", "two columns of one name", "names of their own")
        elif len(cells) != len(names):
            raise Failure(f"{place}:{number}", f"{len(cells)} cells", f"{len(names)}")
        else:
            rows.append({"heading": heading, "above": above, **dict(zip(names, cells))})
    return rows


def rows_of_file(path, at):
    if path.suffix == ".md":
        return rows_of_markdown(path, files.text(path), at or "*")
    return rows_of_csv(path) if path.suffix == ".csv" else rows_of_json(path, at or "")


# The table


def is_same(cell, wanted):
    """A number is the same however it is written."""
    found = files.number(cell)
    if isinstance(wanted, (int, float)) and not isinstance(wanted, bool) and found is not None:
        return found == wanted
    return cell == text_of(wanted)


def meets(row, where):
    return all(any(is_same(row.get(key, ""), one) for one in (wanted if isinstance(wanted, list) else [wanted]))
               for key, wanted in where.items())


def number_in(place, row, key, text):
    number = number_of(text)
    if number is None:
        raise Refusal(place, f'"{text}" in {key} of {row}', "a number")
    return number


def keys_in(of):
    return of if isinstance(of, list) else [of]


def cell_of(column, row, place):
    """What a column of the table takes from a row."""
    text = ", ".join(row.get(key, "") for key in keys_in(column["of"]))
    if "match" in column:
        found = re.fullmatch(column["match"], text)
        text = (found[1] or "") if found else ""
    if not text and "or" in column:
        return row.get(column["or"], "")
    if text and {"over", "times", "plus", "as"} & column.keys():
        number = number_in(place, row, column["of"], text)
        if "over" in column:
            number /= number_in(place, row, column["over"], row.get(column["over"], "")) or math.nan
        number = number * column.get("times", 1) + column.get("plus", 0)
        text = column.get("as", "{!r}").format(number)
    if text and "words" in column:
        if text not in column["words"]:
            raise Refusal(f"{place}/words", f'"{text}" in {column["of"]}', f"one of {', '.join(column['words'])}")
        text = column["words"][text]
    return text


def cell_of_group(column, group, place):
    found = dict.fromkeys(cell_of(column, row, place) for row in group if meets(row, column.get("where", {})))
    if len(found) > 1:
        raise Refusal(place, f"{len(found)} answers, {', '.join(found)}", "one, by where or by")
    return next(iter(found), "")


def fits(pattern, keys):
    """The matches of those keys that a pattern with a * fits, whose group is what that stands for."""
    expression = re.compile(re.escape(pattern).replace(r"\*", "(.*)"))
    return [found for found in map(expression.fullmatch, keys) if found] if "*" in pattern else []


def by_each(rows, pattern):
    return [{**row, "each": found[1], "cell": row[found[0]]} for row in rows for found in fits(pattern, row)
            if row[found[0]]]


def each_column(columns, keys):
    """(place, column) with a column of its own for each key that * stands for."""
    for k, column in enumerate(columns):
        fitting = fits(column["of"], keys)
        for one in fitting:
            yield k, {**column, "of": one[0], "name": column["name"].replace("*", one[1])}
        if not fitting:
            yield k, column


def groups_of(rows, by):
    """Rows that become one, in the order in which the first of each comes."""
    groups = {}
    for number, row in enumerate(rows):
        groups.setdefault(tuple(row.get(key, "") for key in by) if by else number, []).append(row)
    return list(groups.values())


def sorted_by(order, names, made):
    """Rows by some of their columns: as numbers where all cells are, else as texts in the order in which they come."""
    for name in reversed(order):
        k = names.index(name)
        places = {text: at for at, text in enumerate(dict.fromkeys(row[k] for row in made))}
        numbers = {text: number_of(text) for text in places}
        rank = places if None in numbers.values() else numbers
        made = sorted(made, key=lambda row, k=k, rank=rank: rank[row[k]])
    return made


def expect_keys(recipe, columns, keys, place):
    """That what the recipe speaks of is in the rows."""
    parts = [(f"columns/{k}", column) for k, column in columns]
    parts += [(f"keys/{name}", key) for name, key in recipe.get("keys", {}).items()]
    asked = [(f"{where}/{word}", key) for where, part in parts for word in ("of", "or", "over") if word in part
             for key in keys_in(part[word])]
    asked += [(f"{where}/where", key) for where, part in [*parts, ("", recipe)] for key in part.get("where", {})]
    asked += [("by", key) for key in recipe.get("by", [])]
    for where, key in asked:
        if key not in keys:
            raise Refusal(f"{place}/{where.lstrip('/')}", f'no "{key}"', f"one of {', '.join(keys)}")


def table(recipe, rows, place):
    """(names, rows) of a table. `place` says whose recipe it is."""
    rows = by_each(rows, recipe["each"]) if "each" in recipe else rows
    keys = list(dict.fromkeys([*(key for row in rows for key in row), *recipe.get("keys", {})]))
    columns = list(each_column(recipe["columns"], keys))
    expect_keys(recipe, columns, keys, place)
    rows = [dict(row) for row in rows if meets(row, recipe.get("where", {}))]
    if not rows:
        raise Refusal(f"{place}/where", "no row", "some in what the command has written")
    for name, key in recipe.get("keys", {}).items():
        for row in rows:
            row[name] = cell_of(key, row, f"{place}/keys/{name}")
    made = [[cell_of_group(column, group, f"{place}/columns/{k}") for k, column in columns]
            for group in groups_of(rows, recipe.get("by"))]
    names = [column["name"] for _, column in columns]
    return names, sorted_by(recipe.get("order", []), names, made)
