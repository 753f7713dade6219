"""The files of a run as arrays: history.csv, machine.csv and fields.h5. Units are SI, compression is positive."""

import os
from typing import NamedTuple

import numpy as np

from tamp import files

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
SHARES = (0.001, 0.01, 0.05)


def columns(path):
    """The columns of a CSV by their names without units; numbers that are missing are nan."""
    names, rows = files.written_table(path)
    numbers = np.array(rows).reshape(len(rows), len(names))
    return {name.split("[")[0]: numbers[:, k] for k, name in enumerate(names)}


def rows_of(known):
    """Each row of some columns, by the same names."""
    return [dict(zip(known, row)) for row in zip(*(column.tolist() for column in known.values()))]


def history(folder):
    return columns(folder / "history.csv")


def machine(folder):
    """None where the program that ran it wrote no such file."""
    path = folder / "machine.csv"
    return columns(path) if path.exists() else None


def summary(folder):
    return files.document(folder / "summary.json")


def is_finished(folder):
    return (folder / "summary.json").exists() and summary(folder).get("status", "").startswith("completed")


def at(known, name, time):
    """A column's value at a time, linear between rows."""
    return float(np.interp(time, known["time"], known[name]))


class Particles(NamedTuple):
    """The particles of one material at one time."""

    time: float
    fields: dict

    def __getitem__(self, name):
        if name == "speed":
            return np.linalg.norm(self.fields["velocity"], axis=1)
        return self.fields[name]

    def __contains__(self, name):
        return name == "speed" or name in self.fields

    @property
    def position(self):
        return self.fields["position"]


def particles(folder, material, time):
    """At the output nearest to a time, in the order of their numbers, so that two runs can be compared one by one."""
    import h5py

    files.check_file(folder / "fields.h5")
    with h5py.File(folder / "fields.h5", "r") as file:
        steps = [name for name in file if name.startswith("step_")]
        times = {name: float(np.ravel(file[name].attrs["time"])[0]) for name in steps}
        name = min(times, key=lambda step: abs(times[step] - time))
        group = file[name]["particles"][material]
        fields = {field: values[()] for field, values in group.items()}
    order = np.argsort(fields["id"], kind="stable")
    return Particles(times[name], {field: values[order] for field, values in fields.items()})


def exceeded(values, shares=SHARES):
    """The levels that some shares of all values are above."""
    return tuple(float(value) for value in np.quantile(values, [1 - share for share in shares]))


def spacing(position):
    """How far apart particles are that lie on a lattice at the start: the least distance along their last axis."""
    for axis in (2, 1, 0):
        places = np.unique(np.round(position[:, axis], 9))
        if len(places) > 1:
            return float(np.diff(places).min())
    raise ValueError("a single particle has no spacing")
