"""How a command writes a table of results/: the key made_by of its entry in results/index.json.

What runs is the entry's command as it stands, or several with "; " between them. made_by says which rows of what they
write become the table, or with "like", a file, that all that is not said here is as in that table's made_by:

file      in what the command writes, a CSV, JSON or Markdown file: of `tamp bench` bench.json, of `tamp drive`
          drive.csv. "printed" is the Markdown that it prints
at        in JSON the pointer to a list, on whose way * is each element; in Markdown the heading above, in which *
          stands for any text
each      headings, * standing for any text, such as "* ms": for each that fits the row comes once, with that text as
          "each" and what is below as "cell", but for empty ones
where     {key: value or list of values}: which rows count
keys      {key: what a column has but its name}: keys that these rows get besides; "of" may be a list of keys, whose
          texts have ", " between them
by        keys. Rows in which these are the same become one row of the table; without, each row is one
order     names of columns by which rows are sorted: numbers, or else as they come first; without, as they come
columns   of the table, objects of

  name    in the table
  of      a row's key: a heading of the CSV or Markdown, the pointer within the list's element; in Markdown "above" is
          the line above the table and "heading" the heading, and of several studies "study" is the name of the row's.
          * in both name and of makes a column of each heading that fits
  where   which of the rows that become one. None: the cell is empty; several: they have to say the same
  match   a regular expression: its group is what is taken, nothing where it does not fit
  or      a key whose text stands as it is where nothing has been taken
  over    a key by whose number it is divided; then times and plus, numbers; then as, such as "{:.1f} %"
  words   {what was found: what the table says}, of which one has to fit, but for empty cells
"""

import re
import shlex

FOLDERS = {"study", "verify", "stability", "run", "compare"}  # commands that write a folder
FILES = {"drive": ("--out", "drive.csv"), "bench": ("--json", "bench.json")}  # and those that write a file
PYTHON = ["python3", "tools/python/tamp"]
PRINTED = "printed"
OWN_WORDS = {"--out", "--json", "--force", "--restart", "--quiet", "--tamp"}  # the making adds them
REHEARSALS = {"--short", "--steps"}
STUDIES = {"study", "verify", "stability"}


def is_text(value):
    return isinstance(value, str) and value.strip() != ""


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_file(value):
    return is_text(value) and (value == PRINTED or re.fullmatch(r"([\w-]+/)?[\w-]+\.(csv|json|md)", value) is not None)


def is_pattern(value):
    try:
        return is_text(value) and re.compile(value).groups == 1
    except re.error:
        return False


def is_format(value):
    try:
        return is_text(value) and value.count("{") == 1 and value.format(1.5) != value
    except (IndexError, KeyError, ValueError, AttributeError):
        return False


def is_choice(value):
    if not isinstance(value, dict) or not value:
        return False
    wanted = [one for value in value.values() for one in (value if isinstance(value, list) else [value])]
    return all(isinstance(one, (str, int, float, bool)) for one in wanted)


def is_words(value):
    return isinstance(value, dict) and len(value) > 0 and all(isinstance(text, str) for text in value.values())


def is_list_of_texts(value):
    return isinstance(value, list) and len(value) > 0 and all(map(is_text, value))


TEXT, CHOICE = (is_text, "a text"), (is_choice, "an object of keys, each with a value or a list of them")
TEXTS = (is_list_of_texts, "a list of texts")
RECIPE = {
    "file": (is_file, f"NAME.csv, NAME.json or NAME.md, or {PRINTED}"), "at": TEXT,
    "each": (lambda value: is_text(value) and value.count("*") == 1, "a text with one *"), "where": CHOICE,
    "keys": (lambda value: isinstance(value, dict), "an object"), "by": TEXTS, "order": TEXTS,
    "columns": (lambda value: isinstance(value, list) and value, "a list"),
}
COLUMN = {
    "name": TEXT, "of": (lambda value: isinstance(value, str), "a key"), "where": CHOICE,
    "match": (is_pattern, "a regular expression with one group"), "or": TEXT, "over": TEXT,
    "times": (is_number, "a number"), "plus": (is_number, "a number"),
    "as": (is_format, 'a format of one number, such as "{:.2f} %"'), "words": (is_words, "an object of texts"),
}
KEY = {name: expected for name, expected in COLUMN.items() if name not in ("name", "where")}
KEY["of"] = (lambda value: isinstance(value, str) or is_list_of_texts(value), "a key or a list of them")


def faults_of_object(value, known, needed, place):
    """What is wrong with an object of a recipe, one `POINTER: found; expected` each."""
    if not isinstance(value, dict):
        return [f"{place}: {value!r}; expected an object"]
    found = [f'{place}: no "{key}"; expected {known[key][1]}' for key in needed if key not in value]
    found += [f"{place}/{key}: unknown; expected one of {', '.join(known)}" for key in value if key not in known]
    return found + [f"{place}/{key}: {value[key]!r}; expected {expected}" for key, (is_sound, expected) in known.items()
                    if key in value and not is_sound(value[key])]


def faults_of_parts(recipe, place):
    """What is wrong with keys and columns, and with the names that rows are sorted by."""
    found = [fault for key, value in recipe.get("keys", {}).items()
             for fault in faults_of_object(value, KEY, ["of"], f"{place}/keys/{key}")]
    for k, column in enumerate(recipe["columns"]):
        wrong = faults_of_object(column, COLUMN, ["name", "of"], f"{place}/columns/{k}")
        if not wrong and ("*" in column["name"]) != ("*" in column["of"]):
            wrong = [f'{place}/columns/{k}/name: {column["name"]!r}; expected a * in both name and of, or in none']
        found += wrong
    names = [] if found else [column["name"] for column in recipe["columns"]]
    return found + [f"{place}/order/{k}: {name!r}; expected one of {', '.join(names)}"
                    for k, name in enumerate(recipe.get("order", [])) if names and name not in names]


def commands(entry):
    """The commands of an entry, each in words."""
    return [shlex.split(command) for command in entry["command"].split("; ")]


def is_python(words):
    return [words[0].rpartition("/")[2], *words[1:2]] == PYTHON


def faults_of_commands(entry, recipe, place):
    """What keeps an entry's command from being run as it stands."""
    text, found = entry.get("command"), []
    try:
        all_words = commands(entry)
    except (AttributeError, KeyError, ValueError):
        all_words = [[]]
    for words in all_words:
        calls = len(words) > 2 and is_python(words) or words[:1] == ["tamp"] and words[1:2] and (
            words[1] in FOLDERS or words[1] in FILES)
        if not calls:
            kinds = ", ".join(sorted(FOLDERS | FILES.keys()))
            return [f'{place}: {text!r}; expected tamp and one of {kinds}, or {" ".join(PYTHON)} COMMAND']
        wrong = OWN_WORDS | (REHEARSALS if words[1] in STUDIES else set())
        found += [f"{place}: {word}; expected the whole command, without what the making adds" for word in words
                  if word in wrong]
        file = recipe.get("file") if isinstance(recipe, dict) else None
        if is_python(words) != (file == PRINTED) and is_file(file):
            found.append(f"{place}: {text!r} with the file {file}; expected {PRINTED} of Python's commands alone")
    return found


def recipe_of(entry, entries):
    """What an entry's made_by comes to, with what it takes from another; None where there is no such other."""
    recipe = entry["made_by"]
    if not isinstance(recipe, dict) or "like" not in recipe:
        return recipe
    others = (one.get("made_by") for one in entries if isinstance(one, dict) and one.get("file") == recipe["like"])
    other = next((one for one in others if isinstance(one, dict) and "like" not in one), None)
    return None if other is None else {**other, **{key: value for key, value in recipe.items() if key != "like"}}


def faults(entry, entries):
    """What is wrong with the made_by of an entry, and with a command that goes with it."""
    place, recipe = "/made_by", recipe_of(entry, entries)
    if recipe is None:
        found = [f"{place}/like: {entry['made_by']['like']!r}; expected a table whose made_by has columns"]
    else:
        found = faults_of_object(recipe, RECIPE, ["file", "columns"], place)
    if not found:
        found = faults_of_parts(recipe, place)
    return found + faults_of_commands(entry, recipe, "/command")


def fits_heading(recipe, names):
    """Whether a table has the columns that its recipe makes."""
    pattern = ""
    for column in recipe["columns"]:
        name = re.escape(column["name"])
        pattern += f"(?:{name}\n)" if "*" not in column["name"] else "(?:" + name.replace(r"\*", "[^\n]*") + "\n)+"
    return re.fullmatch(pattern, "".join(f"{name}\n" for name in names)) is not None
