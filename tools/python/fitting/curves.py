"""Measured unloading curves, and the surface that the table model spans between them. SI, compression positive."""

import dataclasses
import sys

import numpy as np
from scipy.interpolate import PchipInterpolator

N_PRESSURES = 4001  # where curves are inverted


@dataclasses.dataclass
class Curve:
    """One unloading curve: a monotone cubic through the measured rows."""

    plastic: float
    elastic: np.ndarray
    pressure: np.ndarray

    def __post_init__(self):
        self.pressure_at = PchipInterpolator(self.elastic, self.pressure)
        self.modulus_at = self.pressure_at.derivative()

    @property
    def end(self):
        return self.elastic[-1]


def read_table(path):
    try:
        lines = [line for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
        return np.array([[float(value) for value in line.split(",")] for line in lines[1:]])
    except (OSError, ValueError) as error:
        sys.exit(f"{path}: {error}; expected a heading and rows of numbers")


def read_curves(path):
    """The curves of an unloading.csv, in order of plastic strain."""
    rows = read_table(path)
    curves = []
    for plastic in np.unique(rows[:, 0]):
        _, elastic, pressure = rows[rows[:, 0] == plastic].T
        if elastic[0] != 0 or pressure[0] != 0 or np.any(np.diff(elastic) <= 0) or np.any(np.diff(pressure) <= 0):
            sys.exit(f"{path}: curve of plastic strain {plastic:g}; expected to rise from elastic strain 0, pressure 0")
        curves.append(Curve(plastic, elastic, pressure))
    if len(curves) < 2:
        sys.exit(f"{path}: {len(curves)} curves; expected two or more")
    return curves


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
