"""How far the fitted models are from the measured curves, and whether they are sound between them."""

from typing import NamedTuple

import numpy as np

from tamp.fit.curves import Surface

N_ALONG = 201  # evenly spaced along a curve
N_LINES = 65  # of equal plastic strain, over all of it
COUPLING_STEP = 1e-5


class Table(NamedTuple):
    title: str
    head: list
    rows: list


def tables(curves, hydrostat, models):
    return [*(fit_table(curves, model) for model in models), soundness_table(curves, hydrostat, models)]


def fit_table(curves, model):
    """Errors of pressure, and of bulk modulus relative to the curve's."""
    rows = []
    for curve in curves:
        elastic = np.linspace(0, curve.end, N_ALONG)
        pressure, modulus = model.at(elastic, curve.plastic)
        off = (pressure - curve.pressure_at(elastic)) / 1e6
        measured = curve.modulus_at(elastic)
        relative = 100 * (modulus / measured - 1)
        rows.append([
            f"{curve.plastic:.4f}", f"{curve.pressure[-1] / 1e6:.1f}", f"{rms(off):.2f}", f"{largest(off):.2f}",
            f"{measured[0] / 1e9:.3f}", f"{modulus[0] / 1e9:.3f}", f"{rms(relative):.1f}", f"{largest(relative):.1f}",
        ])
    header = ["plastic strain", "peak p [MPa]", "rms of p [MPa]", "max of p [MPa]"]
    header += ["K(0) measured [GPa]", "K(0) fitted [GPa]", "rms of K [%]", "max of K [%]"]
    return Table(f"{model.name} less measured", header, rows)


def soundness_table(curves, hydrostat, models):
    """The least K, and the least 1 - coupling / K: above 0, plastic compaction at fixed total strain relieves p."""
    surface = Surface(curves)
    plastic_lines = np.linspace(0, surface.plastic[-1], N_LINES)
    rows = []
    for model in [surface, *models]:
        reached, box, relief = [], [], []
        for plastic in plastic_lines:
            elastic = np.linspace(0, loaded_to(surface, hydrostat, plastic), N_ALONG)
            pressure, modulus = model.at(elastic, plastic)
            stepped, _ = model.at(elastic, plastic + COUPLING_STEP)
            reached.append(modulus.min())
            relief.append((1 - (stepped - pressure) / COUPLING_STEP / modulus).min())
            box.append(model.at(np.linspace(0, surface.ends.max(), N_ALONG), plastic)[1].min())
        where = f"{plastic_lines[np.argmin(reached)]:.3f}"
        rows.append([model.name, f"{min(reached) / 1e9:.3f}", where, f"{min(box) / 1e9:.3f}", f"{min(relief):.2f}"])
    header = ["model", "least K in hydrostatic loading and unloading [GPa]", "at plastic strain"]
    header += [f"least K, elastic strain 0 to {surface.ends.max():.3f} [GPa]", "least 1 - coupling / K"]
    return Table("Between the curves", header, rows)


def loaded_to(surface, hydrostat, plastic):
    """The elastic strain at which loading from this plastic strain meets the hydrostat; the largest if it does not."""
    elastic, pressure, _ = surface.line(plastic)
    # The tables are held within 0.1 %; at zero strain the line and the hydrostat both start from zero pressure.
    meets = np.flatnonzero(pressure[1:] > 1.001 * np.interp(elastic[1:] + plastic, *hydrostat.T))
    return min(elastic[1:][meets[0]] if meets.size else elastic[-1], surface.ends.max())


def rms(values):
    return np.sqrt(np.mean(values**2))


def largest(values):
    return np.abs(values).max()
