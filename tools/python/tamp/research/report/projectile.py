"""Figures 24 to 29: the projectile, where it goes, and the sand around it with three models."""

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from tamp import projectile_mesh, results
from tamp.charts import theme
from tamp.program import INPUTS
from tamp.research.report.drawing import (
    COLOURS, Field, chart, colour_bar, coloured, frame, growth, panels, squares, three_digits,
)

MICRO, MILLI, MEGA, PERCENT = 1e-6, 1e-3, 1e6, 0.01
SOLID = INPUTS / "uxo/projectile.json"
MIDDLE = 0.05  # of the box, along y
TIMES = (200e-6, 400e-6, 600e-6)
LAST = 850e-6
BOX = ((0, 0.15), (0, 0.165))
ABOVE = "Above each panel the largest value of any particle, and what 0.1 % of all sand are above."

SPEED = Field("speed", "speed", "m/s", 1, (0, 50))
PRESSURE = Field("p", "mean stress", "MPa", MEGA, (0.1, 100), True)
SHEAR = Field("q", "deviatoric stress q = √(3 J₂)", "MPa", MEGA, (0.1, 100), True)
PLASTIC = Field("plastic_volumetric", "plastic volumetric strain", "%", PERCENT, (-14, 14), colours="coolwarm")
FIGURES = ((PRESSURE, "27", TIMES), (SHEAR, "28", TIMES), (PLASTIC, "29", TIMES), (SPEED, "26", (LAST,)))


def mesh():
    """Corners of the triangles of the projectile's surface, in millimetres."""
    return (1000 * np.array(projectile_mesh.surface(*projectile_mesh.read_projectile(SOLID)))).astype("<f4")


def draw_geometry(album, run):
    figure = Figure(figsize=(6.4, 3.4), facecolor=theme.LIGHT["paper"])
    axis = figure.add_axes([-0.15, -0.45, 1.3, 1.9], projection="3d", proj_type="ortho")
    triangles = mesh()
    lower, upper = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    light = np.clip(normals @ [-0.4, -0.6, 0.7] / (np.linalg.norm(normals, axis=1) + 1e-30), 0, 1)
    shades = [theme.mixed(COLOURS["table"], "#ffffff", 0.15 + 0.6 * float(share)) for share in light]
    axis.add_collection3d(Poly3DCollection(triangles, facecolors=shades, edgecolors="none"))
    axis.set(xlim=(lower[0], upper[0]), ylim=(lower[1], upper[1]), zlim=(lower[2], upper[2]))
    axis.set_box_aspect(upper - lower)
    axis.view_init(elev=22, azim=-62)
    axis.set_axis_off()
    long, wide = (upper - lower)[:2]
    album.keep(figure, "24a", f"The projectile: {long:.0f} mm long, {wide:.1f} mm across its fins.")

    sand, body = (results.particles(run.folder, material, 0) for material in ("sand", "projectile"))
    figure, grid = panels(1, 1, (5.6, 5.6))
    axis, side = grid[0, 0], results.spacing(sand.position)
    frame(axis, *BOX)
    layer, part = in_slab(sand, side), in_slab(body, side)
    squares(axis, layer, side, color="#d8c79a")
    squares(axis, part, body_side(body), color=COLOURS["table"])
    axis.set_title("middle of the box, seen along y; 15 cm wide", size=9)
    album.keep(figure, "24b", "Projectile and sand at the start. The bucket's walls and floor stand still.")


def in_slab(particles, side):
    """(x, z) of what lies within one layer at each side of the middle."""
    return particles.position[slab(particles, side)][:, [0, 2]]


def slab(particles, side):
    return np.abs(particles.position[:, 1] - MIDDLE) < 1.05 * side


def body_side(body):
    """A solid is drawn by squares of the lattice that its particles were on."""
    volume = np.ptp(body.position, axis=0).max() / 41e-3 * 1938e-9
    return 1.3 * (volume / len(body.position)) ** (1 / 3)


def surface_of(run):
    """Height of the sand at the start: half a particle above the highest."""
    sand = results.particles(run.folder, "sand", 0)
    return sand.position[:, 2].max() + results.spacing(sand.position) / 2


def draw_ways(album, runs):
    figure, axis = chart("time [µs]", "height above the sand's surface [mm]")
    surface = surface_of(runs[0])
    for run in runs:
        history, colour = results.history(run.folder), COLOURS[run.model]
        axis.plot(history["time"] / MICRO, (history["projectile.nose_z"] - surface) / MILLI, color=colour, lw=2,
                  label=f"{run.name}, nose")
        axis.plot(history["time"] / MICRO, (history["projectile.tail_z"] - surface) / MILLI, color=colour, lw=0.9,
                  label=f"{run.name}, tail")
    axis.axhline(0, color="#8a6d2f", lw=0.8, ls=":")
    axis.legend(fontsize=8)
    album.keep(figure, "25a", f"Nose (thick) and tail (thin) of the projectile. {runs[0].about}.")

    figure, axis = chart("x [mm]", "z above the sand's surface [mm]", (6.4, 5.4))
    for run in runs:
        history, colour = results.history(run.folder), COLOURS[run.model]
        ends = [(history[f"projectile.{end}_x"] / MILLI, (history[f"projectile.{end}_z"] - surface) / MILLI)
                for end in ("nose", "tail")]
        for (x, z), width, end in zip(ends, (2, 0.9), ("nose", "tail")):
            axis.plot(x, z, color=colour, lw=width, label=f"{run.name}, {end}")
        last = [(x[-1], z[-1]) for x, z in ends]
        axis.plot(*zip(*last), color=colour, lw=0.8, ls="--")
    axis.axhline(0, color="#8a6d2f", lw=0.8, ls=":")
    axis.set_aspect("equal")
    axis.legend(fontsize=8)
    caption = "The way of nose (thick) and tail (thin) in the plane of impact; dashed the axis at the end."
    album.keep(figure, "25b", f"{caption} {runs[0].about}.")


def draw_fields(album, runs):
    for field, number, times in FIGURES:
        if len(times) == 1:
            figure, grid = panels(1, len(runs), (4.0, 4.4))
            places = [(axis, run, times[0]) for axis, run in zip(grid[0], runs)]
        else:
            figure, grid = panels(len(runs), len(times), (3.6, 3.7))
            places = [(axis, run, time) for row, run in zip(grid, runs) for axis, time in zip(row, times)]
        dots = None
        for axis, run, time in places:
            dots = draw_slab(axis, run, time, field)
        colour_bar(figure, dots, grid, field)
        caption = f"{field.title} in the middle of the box, seen along y. {runs[0].about}. {ABOVE}"
        album.keep(figure, number, caption)


def draw_slab(axis, run, time, field):
    sand, body = (results.particles(run.folder, material, time) for material in ("sand", "projectile"))
    start = results.particles(run.folder, "sand", 0)
    side = results.spacing(start.position)
    frame(axis, *BOX)
    chosen = slab(sand, side)
    dots = coloured(axis, in_slab(sand, side), field.values(sand)[chosen], growth(sand)[chosen], field, side)
    squares(axis, in_slab(body, side), body_side(body), color="#b03a20")
    values = field.values(sand)
    above = ", ".join(map(three_digits, (values.max(), results.exceeded(values)[0])))
    axis.set_title(f"{run.name}, {sand.time / MICRO:.0f} µs: {above}", size=8.5)
    return dots


def draw(album, runs):
    draw_geometry(album, runs[0])
    draw_ways(album, runs)
    draw_fields(album, runs)
