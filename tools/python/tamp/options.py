"""Options that several commands have."""

import argparse

from tamp.files import number


def checked_number(kind, is_sound, expected):
    """A type for argparse."""

    def convert(text):
        value = number(text)
        if value is None or kind(value) != value or not is_sound(value):
            raise ValueError
        return kind(value)

    convert.__name__ = expected
    return convert


finite = checked_number(float, lambda _: True, "number")
positive = checked_number(float, lambda value: value > 0, "number above 0")
count = checked_number(int, lambda value: 1 <= value < 2**31, "number of 1 or more")


def setting(text):
    """(pointer, value)"""
    pointer, _, value = text.partition("=")
    if not value:
        raise argparse.ArgumentTypeError(f"{text}; expected POINTER=VALUE")
    return pointer, value


def add_settings(parser):
    parser.add_argument("--set", type=setting, action="append", default=[], metavar="POINTER=VALUE",
                        help="changes a value of what is run; may be repeated")
