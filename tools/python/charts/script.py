"""What the scripts that draw have in common."""

import argparse
import importlib.util
import pathlib
import sys

NO_MATPLOTLIB = 3  # an exit code that the program knows


def folder_of_arguments(description):
    """The folder to draw, if there is what to draw it with."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    folder = parser.parse_args().folder
    if importlib.util.find_spec("matplotlib") is None:
        print(f"{sys.executable} has no matplotlib; Debian's package is python3-matplotlib", file=sys.stderr)
        sys.exit(NO_MATPLOTLIB)
    return folder
