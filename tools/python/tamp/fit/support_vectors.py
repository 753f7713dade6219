"""Support-vector regression of pressure in total and plastic volumetric strain, in the published layout (Vaango)."""

import json

import numpy as np

from tamp.failure import Refusal
from tamp.fit.curves import with_zero_plastic

COMPRESSION_STEP, TENSION_STEP = 0.0004, 0.005  # of elastic strain, between points
LEAST_STRAIN = -0.1  # of elastic strain and of total strain
LEAST_PRESSURE = -0.1  # of the largest pressure
STRAIN_UNIT, PRESSURE_UNIT = 0.01, 1e6  # percent, MPa


def points(curves):
    """([total, plastic] in %, pressure in MPa): every curve, and straight on from it into tension."""
    top = max(curve.pressure[-1] for curve in curves)
    strains, outputs = [], []
    for curve in with_zero_plastic(curves):
        elastic = np.linspace(0, curve.end, round(curve.end / COMPRESSION_STEP) + 1)
        modulus = curve.modulus_at(0)
        least = max(LEAST_STRAIN, LEAST_STRAIN - curve.plastic, LEAST_PRESSURE * top / modulus)
        tension = np.linspace(least, 0, round(-least / TENSION_STEP), endpoint=False)
        pressure = np.concatenate([modulus * tension, curve.pressure_at(elastic)])
        total = np.concatenate([tension, elastic]) + curve.plastic
        strains.append(np.column_stack([total, np.full_like(total, curve.plastic)]) / STRAIN_UNIT)
        outputs.append(pressure / PRESSURE_UNIT)
    return np.concatenate(strains), np.concatenate(outputs)


def fit(curves, c, epsilon):
    """The fit, as its file has it. `epsilon` is of the range of pressures."""
    from sklearn.svm import SVR  # which only fitting needs

    strains, output = points(curves)
    x_min, x_max, y_min, y_max = strains.min(axis=0), strains.max(axis=0), output.min(), output.max()
    x_scale, y_scale = 1 / (x_max - x_min), 1 / (y_max - y_min)
    scaled = (strains - x_min) * x_scale

    gamma = 1 / (2 * scaled.var())  # what scikit-learn calls gamma="scale"
    model = SVR(kernel="rbf", gamma=gamma, C=c, epsilon=epsilon, tol=1e-6)
    model.fit(scaled, (output - y_min) * y_scale)
    if not len(model.support_):
        raise Refusal("the support vectors", "none", "a smaller --epsilon")
    return {
        "X_var": ["Total volumetric strain (%)", "Plastic volumetric strain (%)"],
        "y_var": "Pressure (MPa)",
        "X_conversion_factor": [STRAIN_UNIT, STRAIN_UNIT],
        "y_conversion_factor": PRESSURE_UNIT,
        "X_scale": x_scale.tolist(),
        "X_min": x_min.tolist(),
        "X_max": x_max.tolist(),
        "y_scale": [float(y_scale)],
        "y_min": [float(y_min)],
        "y_max": [float(y_max)],
        "gamma": float(gamma),
        "support_vectors": model.support_vectors_.tolist(),
        "dual_coeffs": model.dual_coef_.tolist(),
        "intercept": model.intercept_.tolist(),
    }


def write(fitted, path):
    path.write_text(json.dumps(fitted, indent=1) + "\n")


class SupportVectors:
    """A fit read back from its file; pressure is counted from that at zero elastic strain."""

    name = "SVR"

    def __init__(self, path):
        self.fit = json.loads(path.read_text())
        self.vectors = np.array(self.fit["support_vectors"])
        self.coefficients = np.array(self.fit["dual_coeffs"][0])

    def fitted(self, elastic, plastic):
        """(pressure, bulk modulus) as fitted, whatever the range of the data."""
        strains = np.column_stack([elastic + plastic, np.full_like(elastic, plastic)])
        x = (strains / self.fit["X_conversion_factor"] - self.fit["X_min"]) * self.fit["X_scale"]
        away = self.vectors[None, :, :] - x[:, None, :]
        terms = self.coefficients * np.exp(-self.fit["gamma"] * (away**2).sum(axis=2))
        unit, scale = self.fit["y_conversion_factor"], self.fit["y_scale"][0]
        pressure = unit * ((terms.sum(axis=1) + self.fit["intercept"][0]) / scale + self.fit["y_min"][0])
        slope = (2 * self.fit["gamma"] * terms * away[:, :, 0]).sum(axis=1)
        return pressure, unit * slope / scale * self.fit["X_scale"][0] / self.fit["X_conversion_factor"][0]

    def at(self, elastic, plastic):
        """(pressure, bulk modulus)"""
        pressure, modulus = self.fitted(elastic, plastic)
        return pressure - self.offset(plastic), modulus

    def offset(self, plastic):
        """The fitted pressure at zero elastic strain."""
        return self.fitted(np.zeros(1), plastic)[0][0]
