"""Figures 9 to 23: how deep the punch goes, and the sand's fields with one model at the left and Table at the right."""

import numpy as np

from tamp import results
from tamp.program import MODELS
from tamp.research.report.drawing import (
    COLOURS, FAINT, Field, chart, colour_bar, coloured, frame, growth, panels, squares, three_digits,
)

MILLI, MEGA, PERCENT = 1e-3, 1e6, 0.01
MIDDLE = 0.5  # of the box, along x
SURFACE = 0.5  # of the sand at the start
TIMES = {"svr": (0.5e-3, 1e-3, 2e-3, 2.7e-3), "mlp": (0.5e-3, 1e-3, 2e-3, 2.6e-3)}

SPEED = Field("speed", "speed", "m/s", 1, (0, 150))
MODULUS = Field("K", "bulk modulus", "MPa", MEGA, (100, 1e4), True)
CAP = Field("cap", "cap pressure", "MPa", MEGA, (2, 400), True)
PRESSURE = Field("p", "mean stress", "MPa", MEGA, (0, 180))
SHEAR = Field("q", "deviatoric stress q = √(3 J₂)", "MPa", MEGA, (0, 150))
ELASTIC = Field("elastic_volumetric", "elastic volumetric strain", "%", PERCENT, (-6, 6), colours="coolwarm")
PLASTIC = Field("plastic_volumetric", "plastic volumetric strain", "%", PERCENT, (-30, 30), colours="coolwarm")
# Which figure of the report shows which field of which model beside Table.
FIGURES = {
    ("svr", SPEED): "10", ("svr", MODULUS): "11", ("svr", CAP): "12", ("svr", PRESSURE): "13", ("svr", SHEAR): "14",
    ("svr", ELASTIC): "15", ("svr", PLASTIC): "16", ("mlp", MODULUS): "17", ("mlp", SPEED): "18", ("mlp", CAP): "19",
    ("mlp", PRESSURE): "20", ("mlp", SHEAR): "21", ("mlp", ELASTIC): "22", ("mlp", PLASTIC): "23",
}
ABOVE = "Above each panel the largest value of any particle, and what 1 % of the sand are above."


def half(places, values, middle, left):
    """The particles at one side of the middle, which itself belongs to the right."""
    chosen = (places[:, 0] < middle) == left
    return places[chosen], values[chosen]


def halves(left, right, value_of, middle=MIDDLE):
    """(places, values) of one model at the left and another at the right."""
    sides = [half(particles.position[:, :2], value_of(particles), middle, is_left)
             for particles, is_left in ((left, True), (right, False))]
    return tuple(np.concatenate(parts) for parts in zip(*sides))


def draw_depths(album, runs):
    figure, axis = chart("time [ms]", "depth of the punch [cm]")
    for run in runs:
        history = results.history(run.folder)
        axis.plot(history["time"] / MILLI, 100 * history["punch.depth"], color=COLOURS[run.model], label=run.name)
    axis.invert_yaxis()
    axis.legend(loc="lower left")
    inset = axis.inset_axes([0.45, 0.55, 0.5, 0.36])
    table = results.history(runs[0].folder)
    for run in runs:
        history = results.history(run.folder)
        depth = np.interp(table["time"], history["time"], history["punch.depth"], right=np.nan)
        inset.plot(table["time"] / MILLI, 1000 * (depth - table["punch.depth"]), color=COLOURS[run.model])
    inset.set_title("deeper than Table by [mm]", size=8)
    inset.tick_params(labelsize=7)
    album.keep(figure, "09", f"Depth of the punch with three models of the sand's stiffness. {runs[0].about}.")


def draw_halves(album, runs):
    by_model = {run.model: run for run in runs}
    for (model, field), number in FIGURES.items():
        draw_half(album, by_model[model], by_model["table"], field, number)


def draw_half(album, run, table, field, number):
    start = results.particles(table.folder, "sand", 0)
    if field.key not in start or field.key not in results.particles(run.folder, "sand", 0):
        print(f"figure {number} left out: the runs have no field {field.key}")
        return
    figure, grid = panels(2, 2, (5.2, 4.0))
    side, dots = results.spacing(start.position), None
    for axis, time in zip(grid.ravel(), TIMES[run.model]):
        sides = [results.particles(one.folder, "sand", time) for one in (run, table)]
        frame(axis, (0, 1), (0, 0.75))
        steel = [results.particles(one.folder, "steel", time) for one in (run, table)]
        squares(axis, halves(*steel, growth)[0], 1.1 * side, color="#c9cdd4")
        axis.axhline(SURFACE, color=FAINT, lw=0.5, ls=":")
        places, values = halves(*sides, field.values)
        dots = coloured(axis, places, values, halves(*sides, growth)[1], field, side)
        axis.axvline(MIDDLE, color="white", lw=0.7)
        axis.set_title(panel_title(run, sides, field), size=8)
    colour_bar(figure, dots, grid, field)
    caption = f"{field.title}: {run.name} at the left, Table at the right. {table.about}; the punch is grey. {ABOVE}"
    album.keep(figure, number, caption)


def panel_title(run, sides, field):
    said = [f"{sides[0].time / MILLI:.2g} ms"]
    for name, particles in ((run.name, sides[0]), (MODELS["table"], sides[1])):
        values = field.values(particles)
        said.append(f"{name}: {three_digits(values.max())}, {three_digits(results.exceeded(values)[1])}")
    return "   ".join(said)


def draw(album, runs):
    draw_depths(album, runs)
    draw_halves(album, runs)
