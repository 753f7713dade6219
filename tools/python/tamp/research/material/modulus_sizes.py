"""Makes what inputs/studies/moduli.json compares: the sand's models fitted at several sizes, and where to ask them.

Written are svr-N.json, N the number of vectors, mlp-N-N-....h5, N the neurons of each layer, and states.csv: all rows
of the measured unloading curves but those of zero pressure, with the pressure measured there and the slope of the
monotone cubic through the curve's rows. The rows are in order of elastic strain, so that neighbours are of different
curves. The same input gives the same files, byte for byte. Debian's python3-sklearn and python3-h5py are used.
"""

import json
import pathlib

from tamp import files
from tamp.fit import network, support_vectors
from tamp.fit.curves import read_curves
from tamp.program import INPUTS, SAND

# C and epsilon. The published 10, 0.001 is what the sand's folder has.
REGRESSIONS = [(10, 0.02), (10, 0.01), (10, 0.005), (10, 0.002), (10, 0.0005), (10, 0.0001)]
# Neurons of each layer. The published 64, 32, 32 is what the sand's folder has.
NETWORKS = [(8, 8), (16, 16), (32, 32), (32, 32, 32), (128, 64, 64)]
EPOCHS, BATCH, SEED = 800, 32, 1


def write_regression(curves, c, epsilon, out):
    fitted = support_vectors.fit(curves, c, epsilon)
    n = len(fitted["support_vectors"])
    (out / f"svr-{n}.json").write_text(json.dumps(fitted, separators=(",", ":")) + "\n")
    print(f"C = {c}, epsilon = {epsilon}: {n} vectors", flush=True)


def write_network(curves, layers, out):
    network.write(*network.fit(curves, EPOCHS, BATCH, SEED, layers), out / f"mlp-{'-'.join(map(str, layers))}.h5")
    print(f"layers of {layers}", flush=True)


def write_states(curves, path):
    rows = [(elastic, curve.plastic, pressure, float(curve.modulus_at(elastic)))
            for curve in curves for elastic, pressure in zip(curve.elastic[1:], curve.pressure[1:])]
    remarks = ["Rows of the measured unloading curves; K is the slope of a monotone cubic through them.",
               "Made by tools/python/tamp modulus-sizes."]
    columns = "elastic_volumetric[-],plastic_volumetric[-],pressure[Pa],bulk_modulus[Pa]"
    files.write_table(path, remarks, columns, sorted(rows))
    print(f"{len(rows)} states")


def add_arguments(parser):
    parser.add_argument("--sand", type=pathlib.Path, default=SAND)
    parser.add_argument("--out", type=pathlib.Path, default=INPUTS / "studies/moduli")


def main(options):
    curves = read_curves(options.sand / "unloading.csv")
    write_states(curves, options.out / "states.csv")
    for c, epsilon in REGRESSIONS:
        write_regression(curves, c, epsilon, options.out)
    for layers in NETWORKS:
        write_network(curves, layers, options.out)
