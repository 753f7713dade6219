"""The sand over time, from fields.h5: pressure, density and plastic volumetric strain in a plane, in squares."""

import math
from typing import NamedTuple

import numpy as np

from tamp import files
from tamp.charts import run_history
from tamp.charts.raster import NOBODY, Raster

STILL, MOVING = 560, 360  # squares along the longer side, of a picture alone and of one of many
MOST_FRAMES, LEAST_FRAMES = 60, 12
MOST_PARTICLES = 2 * 10**7  # that are read for all frames
ROWS_AT_ONCE = 2**18
PART_OF_SPACING = 0.62  # neighbours overlap a little, also where they are drawn apart
PART_ON_RINGS = 0.75  # sectors of rings are no squares
DAMAGES = (ArithmeticError, AttributeError, KeyError, IndexError, OSError, RuntimeError, TypeError, ValueError)


class Quantity(NamedTuple):
    """`about` is its sign, where it has one."""

    field: str
    title: str
    short: str
    about: str
    unit: str


QUANTITIES = [Quantity("p", "Pressure p", "p", "compression positive", "Pa"),
              Quantity("density", "Density", "density", "", "kg/m³"),
              Quantity("plastic_volumetric", "Plastic volumetric strain", "plastic volumetric strain",
                       "compaction positive, dilation negative", "")]


class Plane(NamedTuple):
    """The plane that pictures show: two axes, {"name", "lower", "upper"} each, and in space a slab across the third."""

    axes: list
    slab: dict
    half_thickness: float

    def numbers(self):
        return ["xyz".index(axis["name"]) for axis in self.axes]


class Wanted(NamedTuple):
    """The data to read; `reach` of each material, and the `moment` of the greatest force, which may not be known."""

    path: object
    plane: Plane
    names: list
    rigid: list
    reach: dict
    moment: object
    has_plastic: bool

    def rigid_numbers(self):
        return [k for k, name in enumerate(self.names) if name in self.rigid]


class Frame(NamedTuple):
    """Squares, rows from below; `kind` is a number into the names of materials, or NOBODY."""

    time: float
    kind: np.ndarray
    value: dict


class Sand(NamedTuple):
    """`why` there are no pictures, or else what they show; `peak` is the frame of the greatest force."""

    why: str = ""
    wanted: Wanted = None
    shown: list = ()  # quantities
    lacking: list = ()  # those that the scene has not chosen
    still: Frame = None
    frames: list = ()
    peak: int = 0
    n_outputs: int = 0


# --- what to read ---


def wanted(run):
    """None where the page has no pictures."""
    prepared, scene, history = run["page"], run["scene"], run["history"]
    if scene is None or not prepared or not prepared["pictures"]:
        return None
    names = list(prepared["materials"])
    rigid = [name for name in names if any(body["rigid"] for body in scene["bodies"].values()
                                           if body["material"] == name)]
    soft = [name for name in names if name not in rigid]
    axes = run_history.axes_of_force(scene, run.get("summary"))
    moment = run_history.greatest(history, scene, soft, axes) if history else None
    has_plastic = history is not None and any(f"{name}.plastic_volumetric_max" in history.columns for name in soft)
    return Wanted(run["folder"] / "fields.h5", plane_of(prepared["pictures"][0], scene), names, rigid,
                  {name: reach_of(scene, name) for name in names}, moment, has_plastic)


def plane_of(picture, scene):
    half = 0.5 * scene["grid"]["cell_size"] * (1 + 1e-9) if picture["slab"] else math.inf
    return Plane(picture["axes"], picture["slab"], half)


def reach_of(scene, material):
    """From the middle of a particle to its edge."""
    usual = scene["particles_per_cell"][0]
    n = scene["materials"][material].get("particles_per_axis", usual)
    bodies = [body for body in scene["bodies"].values() if body["material"] == material]
    part = PART_ON_RINGS if any(body.get("particles") == "rings" for body in bodies) else PART_OF_SPACING
    return part * scene["grid"]["cell_size"] / (n if isinstance(n, (int, float)) else usual)


# --- reading ---


def read(asked):
    """None where nothing is asked for; what is wrong with the file is no failure, but the reason for no pictures."""
    if asked is None:
        return None
    try:
        import h5py
    except ModuleNotFoundError:
        return Sand("Python has no h5py to read fields.h5 with (Debian: python3-h5py)", asked)
    try:
        files.check_file(asked.path)
        with h5py.File(asked.path, "r") as file:
            return read_open(file, asked)
    except files.Refusal as refusal:
        return Sand(str(refusal).replace(str(asked.path), "fields.h5"), asked)
    except DAMAGES as error:
        about = "no HDF5 file that is whole" if isinstance(error, (OSError, RuntimeError)) else files.words_of(error)
        return Sand(f"fields.h5 is damaged: {about}", asked)


def read_open(file, asked):
    outputs = sorted((name for name in file if name.startswith("step_")), key=lambda name: (len(name), name))
    if not outputs:
        return Sand("fields.h5 holds no outputs", asked)
    times = np.array([float(np.ravel(file[name].attrs["time"])[0]) for name in outputs])
    if not np.all(np.isfinite(times)):
        raise files.Damage("an output without a time")
    peak = nearest(times, asked.moment)
    particles = file[outputs[peak]]["particles"]
    soft = [name for name in asked.names if name in particles and name not in asked.rigid]
    shown = [one for one in QUANTITIES if any(one.field in particles[name] for name in soft)]
    lacking = [one for one in QUANTITIES if one not in shown and is_missed(one, soft, asked)]
    if not shown:
        return Sand(wanted=asked, lacking=lacking)
    chosen = chosen_outputs(len(outputs), peak, sum(n_particles(particles[name]) for name in particles))
    frames = [frame(file[outputs[k]], times[k], asked, shown, MOVING) for k in chosen]
    still = frame(file[outputs[peak]], times[peak], asked, shown, STILL)
    return Sand("", asked, shown, lacking, still, frames, chosen.index(peak), len(outputs))


def nearest(times, moment):
    """The output nearest to a moment, but not that of the start, when nothing has been pushed yet; the last one where
    no moment is known."""
    if moment is None or len(times) < 2:
        return len(times) - 1
    return 1 + int(np.argmin(np.abs(times[1:] - moment.time)))


def is_missed(quantity, soft, asked):
    return bool(soft) and (quantity.field != "plastic_volumetric" or asked.has_plastic)


def chosen_outputs(n_outputs, peak, n_each):
    """The first, the last, the one of the greatest force, and others evenly between: the fewer, the more particles."""
    n_most = min(max(MOST_PARTICLES // max(n_each, 1), LEAST_FRAMES), MOST_FRAMES, n_outputs)
    even = {round(k * (n_outputs - 1) / max(n_most - 1, 1)) for k in range(n_most)}
    if peak not in even and len(even) > 2:
        even.remove(min(even - {0, n_outputs - 1}, key=lambda k: abs(k - peak)))
    return sorted(even | {peak})


def n_particles(group):
    """Number of particles of a material, all of whose values must be there."""
    shape = group["position"].shape
    if len(shape) != 2 or shape[1] != 3:
        raise files.Damage("positions that are no vectors")
    return shape[0]


def frame(output, time, asked, shown, most):
    axes = asked.plane.axes
    raster = Raster([axis["lower"] for axis in axes], [axis["upper"] for axis in axes], most,
                    [one.field for one in shown])
    for kind, name in enumerate(asked.names):
        if name in output["particles"]:
            fields = [] if name in asked.rigid else shown
            add_material(raster, output["particles"][name], kind, asked.reach[name], asked.plane, fields)
    return Frame(float(time), raster.rows(raster.kind),
                 {name: raster.rows(values) for name, values in raster.value.items()})


def add_material(raster, group, kind, reach, plane, shown):
    """A part of the particles at a time, so that memory stays small."""
    n, place = n_particles(group), group["position"]
    values = {one.field: group[one.field] for one in shown if one.field in group}
    for dataset in [place, *values.values()]:
        if dataset.shape[0] != n or dataset.id.get_storage_size() < n * dataset.dtype.itemsize:
            raise files.Damage("fewer values than particles")
    for first in range(0, n, ROWS_AT_ONCE):
        part = slice(first, first + ROWS_AT_ONCE)
        x = place[part]
        off = np.zeros(len(x)) if plane.slab is None else np.abs(x[:, across(plane)] - plane.slab["at"])
        near = off <= plane.half_thickness
        raster.add(x[near][:, plane.numbers()], reach, off[near], kind,
                   {name: dataset[part][near] for name, dataset in values.items()})


def across(plane):
    return "xyz".index(plane.slab["axis"])


def of_sand(frame, field):
    """The values that a frame shows."""
    values = frame.value[field][frame.kind != NOBODY]
    return values[np.isfinite(values)]
