"""Draws the counterparts of the report's figures 3 to 31 from our own runs, and prints its numbers beside ours.

Runs the punch with Table, SVR and MLP to 4 ms on the report's cells, and the projectile with the same three; what is
finished already is kept, so that it can be stopped and called again. 15 minutes on one core with the rigid projectile;
fine takes an hour, report three. Writes figure-03a.png to figure-31b.png, captions.md, numbers.md and numbers.csv. Runs
with --set want a folder of their own. --stiffer-network 3.45e9 adds so many pascals to the bulk modulus of MLP's
network, as the report's own seems to have had it. Needs Debian's python3-matplotlib, python3-scipy and python3-h5py.
"""

import importlib
import pathlib

from tamp import files, program
from tamp.options import add_settings, count, finite
from tamp.research.report import cost, projectile, projectile_numbers, punch, punch_numbers, sand
from tamp.research.report.drawing import Album
from tamp.research.report.numbers import write
from tamp.research.report.scenes import PROJECTILES, finish, projectile_runs, punch_runs, with_stiffer_network

PARTS = ("sand", "punch", "projectile", "cost")


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--runs", type=pathlib.Path, default=program.ROOT / "runs/report", help="where runs are kept")
    parser.add_argument("--out", type=pathlib.Path, help="folder of the pictures; by default figures beside the runs")
    parser.add_argument("--only", nargs="+", choices=PARTS, default=PARTS)
    parser.add_argument("--projectile", choices=PROJECTILES, default="rigid", help="which projectile (%(default)s)")
    parser.add_argument("--stiffer-network", type=finite, metavar="PASCALS", help="added to MLP's bulk modulus")
    parser.add_argument("--threads", type=count, default=2, help="of a run (%(default)s)")
    add_settings(parser)


def main(options):
    for package in ("h5py", "scipy"):  # rather than after the runs
        importlib.import_module(package)
    settings = dict(options.set)
    files.check_file(options.tamp)
    name = "figures-stiffer" if options.stiffer_network else "figures"
    album, numbers = Album(options.out or options.runs / name), []
    punches = punch_runs(options.runs, settings)
    projectiles = projectile_runs(options.runs, options.projectile, settings)
    if options.stiffer_network:
        punches, projectiles = (with_stiffer_network(runs, options.runs.resolve(), options.stiffer_network)
                                for runs in (punches, projectiles))

    if "sand" in options.only:
        sand.draw(album, options.tamp)
        numbers += sand.numbers(options.tamp)
    if "punch" in options.only:
        finish(options.tamp, punches, options.threads)
        punch.draw(album, punches)
        numbers += punch_numbers.numbers(punches)
    if "projectile" in options.only or "cost" in options.only:
        finish(options.tamp, projectiles, options.threads)
    if "projectile" in options.only:
        projectile.draw(album, projectiles)
        numbers += projectile_numbers.numbers(projectiles)
    if "cost" in options.only:
        cost.draw(album, projectiles)
        numbers += cost.numbers(projectiles)
        if all(run.is_finished for run in punches):
            numbers += cost.numbers(punches, "9", "punch")

    album.write_captions()
    write(numbers, album.folder)
    print(f"pictures and numbers are in {album.folder}")
