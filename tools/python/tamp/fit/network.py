"""A network for the bulk modulus in elastic and plastic volumetric strain, in Keras' HDF5 layout."""

import json
import shutil
import warnings

import h5py
import numpy as np

from tamp.failure import Failure, Refusal
from tamp.fit.curves import Surface

LAYERS = (64, 32, 32)
N_LINES_BETWEEN = 3  # lines of equal plastic strain between each two curves
N_WITHIN, N_BEYOND = 120, 30  # points of a line, up to where the curves end and from there on
N_FOR_PRESSURE = 2001


def points(curves):
    """([elastic, plastic], bulk modulus) on the curves, and on lines between them and beyond them as in the table."""
    surface = Surface(curves)
    most_elastic = surface.ends.max()
    strains, outputs = [], []
    for low, high in zip(surface.plastic[:-1], surface.plastic[1:]):
        lines = np.linspace(low, high, N_LINES_BETWEEN + 2)
        for plastic in lines if high == surface.plastic[-1] else lines[:-1]:
            end = surface.measured_end(plastic)
            beyond = np.linspace(end, most_elastic, N_BEYOND + 1)[1:] if end < most_elastic else []
            elastic = np.concatenate([np.linspace(0, end, N_WITHIN), beyond])
            strains.append(np.column_stack([elastic, np.full_like(elastic, plastic)]))
            outputs.append(surface.at(elastic, plastic)[1])
    return np.concatenate(strains), np.concatenate(outputs)


def fit(curves, epochs, batch, seed, layers=LAYERS):
    """(kernels and biases, scaling, range) of the file."""
    from sklearn.exceptions import ConvergenceWarning  # which only fitting needs
    from sklearn.neural_network import MLPRegressor

    strains, output = points(curves)
    x_mean, x_deviation, y_mean, y_deviation = strains.mean(axis=0), strains.std(axis=0), output.mean(), output.std()
    # Patience as long as the training: all epochs are run.
    model = MLPRegressor(
        layers, activation="relu", solver="adam", alpha=0, batch_size=batch, max_iter=epochs,
        n_iter_no_change=epochs, tol=0, random_state=seed,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)
        try:
            model.fit((strains - x_mean) / x_deviation, (output - y_mean) / y_deviation)
        except ValueError as error:
            raise Refusal("the network", error, "a training that converges (another --seed?)") from None

    scaling = [x_mean[0], x_deviation[0], x_mean[1], x_deviation[1], y_mean, y_deviation]
    bounds = [strains[:, 0].min(), strains[:, 0].max(), strains[:, 1].min(), strains[:, 1].max()]
    return list(zip(model.coefs_, model.intercepts_)), scaling, bounds


def layer_names(n_layers):
    return ["dense" if i == 0 else f"dense_{i}" for i in range(n_layers)]


def model_config(weights):
    layers = []
    for i, (name, (kernel, _)) in enumerate(zip(layer_names(len(weights)), weights)):
        config = {"name": name, "dtype": "float64", "units": kernel.shape[1], "use_bias": True}
        config["activation"] = "linear" if i + 1 == len(weights) else "relu"
        if i == 0:
            config["batch_input_shape"] = [None, kernel.shape[0]]
        layers.append({"class_name": "Dense", "config": config})
    return {"class_name": "Sequential", "config": {"name": "sequential", "layers": layers}}


def write(weights, scaling, bounds, path):
    try:
        write_file(weights, scaling, bounds, path)
    except (OSError, RuntimeError):  # HDF5's own words are long
        raise Failure(path, "cannot be written", "a place to write to") from None


def write_file(weights, scaling, bounds, path):
    with h5py.File(path, "w") as file:
        file.attrs["model_config"] = json.dumps(model_config(weights))
        file.attrs["scaling"] = np.array(scaling, dtype="<f8")
        file.attrs["range"] = np.array(bounds, dtype="<f8")
        group = file.create_group("model_weights")
        names = layer_names(len(weights))
        group.attrs["layer_names"] = np.array(names, dtype="S")
        for name, arrays in zip(names, weights):
            layer = group.create_group(name)
            datasets = [f"{name}/kernel:0", f"{name}/bias:0"]
            layer.attrs["weight_names"] = np.array(datasets, dtype="S")
            for dataset, array in zip(datasets, arrays):
                layer.create_dataset(dataset, data=array.astype("<f8"), track_times=False)


def changed_copy(path, copy, **attributes):
    """A copy of a file with another `scaling` or `range`."""
    shutil.copyfile(path, copy)
    with h5py.File(copy, "r+") as file:
        for name, numbers in attributes.items():
            file.attrs[name] = np.array(numbers, dtype="<f8")
    return copy


class Network:
    """A fit read back from its file; pressure is the integral of the modulus from zero elastic strain."""

    name = "MLP"

    def __init__(self, path):
        with h5py.File(path) as file:
            group = file["model_weights"]
            self.weights = []
            for name in group.attrs["layer_names"]:
                layer = group[name]
                self.weights.append([layer[dataset][()] for dataset in layer.attrs["weight_names"]])
            self.scaling = file.attrs["scaling"]

    def modulus(self, elastic, plastic):
        e_mean, e_deviation, p_mean, p_deviation, k_mean, k_deviation = self.scaling
        x = np.column_stack([(elastic - e_mean) / e_deviation, np.full_like(elastic, (plastic - p_mean) / p_deviation)])
        for kernel, bias in self.weights[:-1]:
            x = np.maximum(x @ kernel + bias, 0)
        kernel, bias = self.weights[-1]
        return k_mean + k_deviation * (x @ kernel + bias)[:, 0]

    def at(self, elastic, plastic):
        """(pressure, bulk modulus)"""
        fine = np.linspace(0, max(elastic.max(), 1e-9), N_FOR_PRESSURE)
        modulus = self.modulus(fine, plastic)
        pressure = np.concatenate([[0.0], np.cumsum(np.diff(fine) * (modulus[1:] + modulus[:-1]) / 2)])
        return np.interp(elastic, fine, pressure), self.modulus(elastic, plastic)
