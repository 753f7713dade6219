"""Tables as they stand in docs/."""


def line(cells):
    return "| " + " | ".join(map(str, cells)) + " |"


def head(names):
    return line(names) + "\n" + "| --- " * len(names) + "|"


def print_head(names):
    print(head(names), flush=True)


def print_row(cells):
    print(line(cells), flush=True)


def print_table(names, rows):
    print("\n".join([head(names), *map(line, rows)]) + "\n")
