"""How a command ends where it cannot go on: one line, FILE:LINE: what was found; what was expected."""

import os
import re
import signal
import sys

PROGRAM = "python3 tools/python/tamp"
NO_PACKAGE = 3  # an exit code that TAMP's program knows
PACKAGES = {"h5py": "python3-h5py", "matplotlib": "python3-matplotlib", "numpy": "python3-numpy", "PIL": "python3-pil",
            "scipy": "python3-scipy", "sklearn": "python3-sklearn", "jsonschema": "python3-jsonschema"}
CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f]")


class Refusal(Exception):
    """An input that is wrong."""

    code = 2

    def __init__(self, place, found=None, expected=None):
        super().__init__(f"{place}" + (f": {found}" if found else "") + (f"; expected {expected}" if expected else ""))


class Failure(Refusal):
    """A file that cannot be read or written, or a program that fails."""

    code = 4


def guard(main):
    """Calls `main` and ends with the exit code that it gives. Where it cannot go on, one line says why."""
    for interruption in [signal.SIGINT, signal.SIGPIPE]:
        signal.signal(interruption, signal.SIG_DFL)
    if hasattr(sys.stdout, "reconfigure"):  # not so ParaView's
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        code = main()
        print(end="", flush=True)
        sys.exit(code)
    except Refusal as refusal:
        end(refusal, refusal.code)
    except ModuleNotFoundError as error:
        if package_of(error) is None:
            raise
        expected = f"Debian's package {package_of(error)}{elsewhere()}"
        end(f"{sys.executable}: has no {error.name}; expected {expected}", NO_PACKAGE)
    except MemoryError:
        end("more memory than there is; expected a smaller input or a smaller model", Failure.code)
    except OSError as error:  # what is read is looked at in files.py
        place = error.filename2 or error.filename or "standard output"
        end(f"{place}: {error.strerror or error}; expected a place to write to", Failure.code)


def package_of(error):
    """Debian's package of a module that is missing; None of one of our own."""
    return PACKAGES.get(error.name.split(".")[0])


def elsewhere():
    """Debian's packages are for Debian's Python, which need not be the first one of the path."""
    of_debian = "/usr/bin/python3"
    is_another = os.path.exists(of_debian) and os.path.realpath(sys.executable) != os.path.realpath(of_debian)
    return f", and {of_debian}, which finds it" if is_another else ""


def end(text, code):
    say(text)
    # Else the interpreter would try to write it again at its end.
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    sys.exit(code)


def say(text):
    """A line on stderr. What would steer a terminal is written out."""
    shown = CONTROL.sub(lambda character: f"\\x{ord(character[0]):02x}", str(text))
    print(f"{PROGRAM}: {shown}", file=sys.stderr)
