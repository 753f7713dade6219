"""The runs that the figures are drawn from. What is finished is kept, so that the work can go on where it stopped."""

import pathlib
from typing import NamedTuple

from tamp import program, results
from tamp.program import INPUTS, MODELS, SAND

PUNCH_END = 4e-3

# Which projectile is run: what is changed in the report's scene, and what a caption says of it. A rigid projectile
# allows steps of the sand's own size.
RIGID = {"/bodies/projectile/rigid": "true", "/materials/projectile/particles_per_axis": 6, "/time/rule": "viscous",
         "/time/multiplier": 1, "/time/end": 8.5e-4}
FINE = {"/grid/cell_size": 0.0025, "/materials/projectile/particles_per_axis": 5, "/transfer": "tflip",
        "/contact/0/normal": "regression"}
PROJECTILES = {
    "rigid": (RIGID, "The report's projectile as a rigid one, cells of 5 mm"),
    "fine": ({**RIGID, **FINE}, "The report's projectile as a rigid one, cells of 2.5 mm, contact by regression"),
    "report": ({}, "Deformable projectile and settings of the report, cells of 5 mm"),
}


class Run(NamedTuple):
    model: str
    folder: pathlib.Path
    scene: pathlib.Path
    settings: dict
    about: str

    @property
    def name(self):
        return MODELS[self.model]

    @property
    def is_finished(self):
        return results.is_finished(self.folder)


def with_settings(about, settings):
    """A caption, with what the command line has changed."""
    return about + "".join(f", {pointer} {value}" for pointer, value in settings.items())


def punch_runs(folder, settings):
    about = with_settings("Punch at 200 m/s with the report's settings, cells of 1 cm", settings)
    settings = {"/time/end": PUNCH_END, **settings}
    return [Run(m, folder / f"punch-{m}", INPUTS / f"punch/{m}.json", settings, about) for m in MODELS]


def projectile_runs(folder, kind, settings):
    own, about = PROJECTILES[kind]
    about = with_settings(about, settings)
    settings = {**own, **settings}
    return [Run(m, folder / f"projectile-{kind}-{m}", INPUTS / f"uxo/{m}.json", settings, about) for m in MODELS]


def with_stiffer_network(runs, folder, amount):
    """These runs, MLP's with a network whose bulk modulus is higher by so many pascals everywhere."""
    from tamp.fit import network  # which needs h5py

    folder.mkdir(parents=True, exist_ok=True)
    own = SAND / "network.h5"
    scaling = network.Network(own).scaling + [0, 0, 0, 0, amount, 0]  # the mean bulk modulus
    stiffer = network.changed_copy(own, folder / "stiffer_network.h5", scaling=scaling)
    made = []
    for run in runs:
        if run.model == "mlp":
            about = f"{run.about}, MLP's bulk modulus higher by {amount / 1e9:g} GPa everywhere"
            settings = {**run.settings, "/materials/sand/modulus/mlp": stiffer.resolve()}
            own_folder = run.folder.with_name(f"{run.folder.name}-stiffer")
            run = run._replace(folder=own_folder, settings=settings, about=about)
        made.append(run)
    about = made[-1].about
    return [run._replace(about=about) for run in made]


def finish(tamp, runs, threads):
    for run in runs:
        if run.is_finished:
            continue
        print(f"running {run.folder.name}", flush=True)
        run.folder.parent.mkdir(parents=True, exist_ok=True)
        program.run(tamp, run.scene, run.folder, "--threads", threads, settings=run.settings)
