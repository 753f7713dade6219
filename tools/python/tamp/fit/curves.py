"""Measured unloading curves, and the surface that the table model spans between them. SI, compression positive."""

import dataclasses

import numpy as np
from scipy.interpolate import PchipInterpolator

from tamp import files
from tamp.failure import Refusal
from tamp.laboratory.checks import LEAST_ROWS, check_stiffness
from tamp.laboratory.curves import crossing

UNLOADING_COLUMNS = ["plastic_volumetric[-]", "elastic_volumetric[-]", "pressure[Pa]"]
HYDROSTAT_COLUMNS = ["total_volumetric[-]", "pressure[Pa]"]
N_PRESSURES = 4001  # where curves are inverted


@dataclasses.dataclass
class Curve:
    """An unloading curve: a monotone cubic through the measured rows."""

    plastic: float
    elastic: np.ndarray
    pressure: np.ndarray

    def __post_init__(self):
        self.pressure_at = PchipInterpolator(self.elastic, self.pressure)
        self.modulus_at = self.pressure_at.derivative()

    @property
    def end(self):
        return self.elastic[-1]

    def points(self):
        """(elastic strain, pressure) as measured."""
        return list(zip(self.elastic, self.pressure))


def read_hydrostat(path):
    """Rows of (total strain, pressure)."""
    rows = np.array(files.table(path, HYDROSTAT_COLUMNS))
    if np.any(np.diff(rows, axis=0) <= 0):
        raise Refusal(path, "strains or pressures that do not rise", "both to rise from row to row")
    return rows


def read_curves(path):
    """The curves of an unloading.csv, in order of plastic strain."""
    rows = np.array(files.table(path, UNLOADING_COLUMNS))
    curves = [read_curve(path, rows, plastic) for plastic in np.unique(rows[:, 0])]
    if len(curves) < 2:
        raise Refusal(path, "one curve", "two or more")
    for curve, next_curve in zip(curves, curves[1:]):
        pressure = crossing((curve.plastic, curve.points()), (next_curve.plastic, next_curve.points()))
        if pressure is not None:
            raise Refusal(path, f"the curves of plastic strain {curve.plastic:g} and {next_curve.plastic:g} "
                                f"meet or cross at {pressure:g} Pa", "curves apart")
    return curves


def read_curve(path, rows, plastic):
    place = f"{path}: curve of plastic strain {plastic:g}"
    _, elastic, pressure = rows[rows[:, 0] == plastic].T
    if len(elastic) < LEAST_ROWS:
        raise Refusal(place, f"{len(elastic)} rows", f"{LEAST_ROWS} or more")
    if plastic < 0 or elastic[0] != 0 or pressure[0] != 0 or np.any(np.diff([elastic, pressure]) <= 0):
        raise Refusal(place, "another course", "to rise from elastic strain 0, pressure 0")
    check_stiffness(place, elastic[-1], pressure[-1])
    return Curve(plastic, elastic, pressure)


def with_zero_plastic(curves):
    """Below the first curve's plastic strain its shape is kept, as in the report's tables."""
    if curves[0].plastic == 0:
        return curves
    return [Curve(0.0, curves[0].elastic, curves[0].pressure), *curves]


class Surface:
    """The table model's surface: total strain at equal pressure is interpolated in plastic strain by a monotone cubic.

    Beyond its measured end a curve goes on with its last modulus until the next one is stiffer at that pressure.
    """

    name = "table"

    def __init__(self, curves):
        curves = with_zero_plastic(curves)
        self.plastic = np.array([curve.plastic for curve in curves])
        self.ends = np.array([curve.end for curve in curves])
        top = max(curve.pressure[-1] for curve in curves)
        self.pressures = np.concatenate([[0.0], np.geomspace(1e-6 * top, top, N_PRESSURES - 1)])

        totals, beyond = [], np.inf
        for curve in reversed(curves):
            elastic = self._inverted(curve, beyond)
            beyond = np.gradient(elastic, self.pressures)
            totals.insert(0, curve.plastic + elastic)
        self.total_at = PchipInterpolator(self.plastic, totals, axis=0)

    def _inverted(self, curve, next_compliance):
        """Elastic strain at the pressures; `next_compliance` is d(elastic) / d(pressure) of the next curve."""
        fine = np.linspace(0, curve.end, 5 * N_PRESSURES)
        elastic = np.interp(self.pressures, curve.pressure_at(fine), fine)
        past = self.pressures > curve.pressure[-1]
        compliance = np.broadcast_to(np.minimum(1 / curve.modulus_at(curve.end), next_compliance), past.shape)
        steps = np.diff(self.pressures[past], prepend=curve.pressure[-1])
        elastic[past] = curve.end + np.cumsum(compliance[past] * steps)
        return elastic

    def line(self, plastic):
        """(elastic strain, pressure, bulk modulus) along a line of equal plastic strain."""
        elastic = self.total_at(plastic) - plastic
        return elastic, self.pressures, np.gradient(self.pressures, elastic)

    def at(self, elastic, plastic):
        """(pressure, bulk modulus)"""
        along, pressure, modulus = self.line(plastic)
        return np.interp(elastic, along, pressure), np.interp(elastic, along, modulus)

    def measured_end(self, plastic):
        """How far up in elastic strain the measurements reach, linear between the curves."""
        return np.interp(plastic, self.plastic, self.ends)
