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
COMMANDS = {
    "import": "laboratory.import_tests", "concrete-sand": "laboratory.concrete_sand", "fit": "fit.command",
    "history": "history", "picture": "picture", "projectile-mesh": "projectile_mesh",
    "draw": "charts.draw", "failure": "charts.failure", "look-at-page": "charts.look_at_page",
    "report": "report.command",
    "cavity": "material.cavity", "companion": "material.companion", "hugoniot": "material.hugoniot",
    "material-paths": "material.material_paths", "modulus-sizes": "material.modulus_sizes",
    "return-path": "material.return_path", "smooth-sand": "material.smooth_sand",
    "localisation": "methods.localisation", "pressure-alternation": "methods.pressure_alternation",
    "projectile": "methods.projectile", "separation": "methods.separation", "stable-step": "methods.stable_step",
    "stress-tolerance": "methods.stress_tolerance",
    "digests": "checks.digests", "failing-calls": "checks.failing_calls", "failures": "checks.failures",
    "forecasts": "checks.forecasts",
    "kill-and-restart": "checks.kill_and_restart", "many-patches": "checks.many_patches",
    "mutations": "checks.mutations", "same-bits": "checks.same_bits", "savings": "checks.savings",
    "scaling": "checks.scaling", "schema": "checks.schema",
}


def summary(module):
    file = pathlib.Path(__file__).parent.joinpath(*module.split(".")).with_suffix(".py")
    return ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))).splitlines()[0]


def parser_of(program, text, epilog=None):
    how = argparse.RawDescriptionHelpFormatter
    return argparse.ArgumentParser(prog=program, description=text, epilog=epilog, formatter_class=how)


def overview(words):
    """What commands there are; ends with it, or with what is wrong about the words."""
    listed = "commands:\n" + "\n".join(f"  {name:21} {summary(module)}" for name, module in COMMANDS.items())
    parser = parser_of(failure.PROGRAM, __doc__, listed)
    parser.add_argument("command", choices=COMMANDS, metavar="COMMAND ...", help="one of those below")
    parser.parse_args(words)


def main():
    name, words = "".join(sys.argv[1:2]), sys.argv[2:]
    if name not in COMMANDS:
        overview(sys.argv[1:2])
    command = importlib.import_module(f"tamp.{COMMANDS[name]}")
    parser = parser_of(f"{failure.PROGRAM} {name}", command.__doc__)
    command.add_arguments(parser)
    return command.main(parser.parse_args(words))


if __name__ == "__main__":
    failure.guard(main)
