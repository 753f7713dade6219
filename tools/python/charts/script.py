"""What the scripts that draw have in common."""

import argparse
import contextlib
import importlib.util
import pathlib
import sys

import inputs

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


@contextlib.contextmanager
def written_by_tamp(path):
    """What is done with a file of TAMP's own, which may be damaged."""
    try:
        yield
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise inputs.Failure(path, f"damaged: {error!r}", "what TAMP has written") from None
