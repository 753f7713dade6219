"""Tables as they stand in docs/."""


def print_table(header, rows):
    print("| " + " | ".join(header) + " |")
    print("| --- " * len(header) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()
