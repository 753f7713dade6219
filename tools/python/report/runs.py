"""The runs that the figures are drawn from. What is finished is kept, so that the work can go on where it stopped."""

import pathlib
import shutil
import subprocess
from typing import NamedTuple

import inputs

ROOT = pathlib.Path(__file__).resolve().parents[3]
MODELS = ("table", "svr", "mlp")
NAMES = {"table": "Table", "svr": "SVR", "mlp": "MLP"}
PUNCH_END = 4e-3

# Which projectile is run: what is changed in the report's scene, and what a caption says of it. A rigid projectile
# allows steps of the sand's own size.
RIGID = {"/bodies/projectile/rigid": "true", "/materials/projectile/particles_per_axis": 6, "/time/rule": "viscous",
         "/time/multiplier": 1, "/time/end": 8.5e-4}  # fmt: skip
FINE = {"/grid/cell_size": 0.0025, "/materials/projectile/particles_per_axis": 5, "/transfer": "affine",
        "/contact/0/normal": "regression"}  # fmt: skip
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
        return NAMES[self.model]

    @property
    def is_finished(self):
        summary = self.folder / "summary.json"
        return summary.exists() and inputs.document(summary).get("status", "").startswith("completed")


def told(about, settings):
    """With what the command line has changed."""
    return about + "".join(f", {pointer} {value}" for pointer, value in settings.items())


def punch_runs(folder, settings):
    about = told("Punch at 200 m/s with the report's settings, cells of 1 cm", settings)
    settings = {"/time/end": PUNCH_END, **settings}
    return [Run(m, folder / f"punch-{m}", ROOT / f"inputs/punch/{m}.json", settings, about) for m in MODELS]


def projectile_runs(folder, kind, settings):
    own, about = PROJECTILES[kind]
    about = told(about, settings)
    settings = {**own, **settings}
    return [Run(m, folder / f"projectile-{kind}-{m}", ROOT / f"inputs/uxo/{m}.json", settings, about) for m in MODELS]


def command(tamp, run, threads):
    """The words of a command line. A run that was interrupted is begun again."""
    words = [str(tamp), "run", str(run.scene), "--out", str(run.folder), "--force", "--quiet", "--threads", str(threads)]
    for pointer, value in run.settings.items():
        words += ["--set", f"{pointer}={value}"]
    return words


def with_stiffer_network(runs, folder, amount):
    """The same runs, but MLP's with a network whose bulk modulus is higher by so many pascals everywhere."""
    network = stiffer_network(ROOT / "inputs/materials/concrete-sand/network.h5", folder / "stiffer_network.h5", amount)
    made = []
    for run in runs:
        if run.model == "mlp":
            about = f"{run.about}, MLP's bulk modulus higher by {amount / 1e9:g} GPa everywhere"
            settings = {**run.settings, "/materials/sand/modulus/mlp": network}
            run = run._replace(folder=run.folder.with_name(f"{run.folder.name}-stiffer"), settings=settings, about=about)
        made.append(run)
    about = made[-1].about
    return [run._replace(about=about) for run in made]


def stiffer_network(path, copy, amount):
    import h5py

    copy.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(path, copy)
    with h5py.File(copy, "r+") as file:
        scaling = file.attrs["scaling"]
        scaling[4] += amount  # the mean bulk modulus
        file.attrs["scaling"] = scaling
    return copy.resolve()


def finish(tamp, runs, threads):
    for run in runs:
        if run.is_finished:
            continue
        print(f"running {run.folder.name}", flush=True)
        run.folder.parent.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(command(tamp, run, threads), capture_output=True, text=True)
        if done.returncode != 0:
            raise inputs.Failure(run.folder, f"exit code {done.returncode}: {done.stderr.strip()}")
