"""TAMP's Python tools. Each command has a --help of its own.

Messages are one line, FILE:LINE: what was found; what was expected. Exit codes: 0 done; 1 what was checked does not
hold; 2 a command line or an input that is wrong or missing; 3 a Python package that is missing; 4 files that cannot be
read or written, damaged files of TAMP's own, and memory.
"""

import argparse
import ast
import importlib
import pathlib
import sys

if not __package__:  # called by the folder's name, which Python then takes for the place of all modules
    sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])

from tamp import failure  # noqa: E402

# Modules by command. What a command does is the first line of its module.
FOR_USERS = {
    "import": "laboratory.import_tests", "fit": "fit.command", "draw": "charts.draw",
    "drive-page": "charts.drive_page", "plot": "plot.command", "history": "history", "picture": "picture",
    "projectile-mesh": "projectile_mesh",
}
RESEARCH = {
    "cavity": "material.cavity", "companion": "material.companion", "concrete-sand": "concrete_sand",
    "failure": "failure_chart", "hugoniot": "material.hugoniot", "localisation": "methods.localisation",
    "make-results": "make_results.command", "material-paths": "material.material_paths",
    "modulus-sizes": "material.modulus_sizes", "pressed-block": "methods.pressed_block",
    "pressure-alternation": "methods.pressure_alternation", "projectile": "methods.projectile",
    "report": "report.command", "return-path": "material.return_path", "separation": "methods.separation",
    "smooth-sand": "material.smooth_sand", "stable-step": "methods.stable_step",
    "stress-tolerance": "methods.stress_tolerance",
}
CHECKS = {name: name.replace("-", "_") for name in [
    "digests", "failing-calls", "failures", "forecasts", "kill-and-restart", "look-at-page", "many-patches",
    "mutations", "same-bits", "savings", "scaling", "schema"]}
CHECKS["results"] = "kept_results"
COMMANDS = {**FOR_USERS, **{name: f"research.{module}" for name, module in RESEARCH.items()},
            **{name: f"checks.{module}" for name, module in CHECKS.items()}}


def summary(module):
    file = pathlib.Path(__file__).parent.joinpath(*module.split(".")).with_suffix(".py")
    return ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))).splitlines()[0]


def parser_of(program, text, epilog=None):
    how = argparse.RawDescriptionHelpFormatter
    return argparse.ArgumentParser(prog=program, description=text, epilog=epilog, formatter_class=how)


def listed(title, names):
    return f"{title}:\n" + "\n".join(f"  {name:21} {summary(COMMANDS[name])}" for name in names) + "\n"


def overview(words):
    """Print the commands; exits with them, or with the fault of the words."""
    text = listed("commands", FOR_USERS)
    if "--all" in words:
        text += "\n" + listed("commands that remake figures, tables and shipped data", RESEARCH)
        text += "\n" + listed("checks of the program", CHECKS)
    else:
        text += "\n--help --all lists those too that remake figures and shipped data, and check the program."
    parser = parser_of(failure.PROGRAM, __doc__, text)
    parser.add_argument("--all", action="store_true", help="with --help: all commands")
    parser.add_argument("command", choices=COMMANDS, metavar="COMMAND ...", help="one of those below")
    parser.parse_args(words)


def main():
    name, words = "".join(sys.argv[1:2]), sys.argv[2:]
    if name not in COMMANDS:
        overview(sys.argv[1:2] + (["--all"] if "--all" in words else []))
    command = importlib.import_module(f"tamp.{COMMANDS[name]}")
    parser = parser_of(f"{failure.PROGRAM} {name}", command.__doc__)
    command.add_arguments(parser)
    return command.main(parser.parse_args(words))


def guarded():
    failure.guard(main)


if __name__ == "__main__":
    guarded()
