#!/usr/bin/env python3
"""Make what inputs/studies/moduli.json compares: the sand's models fitted at several sizes, and where to ask them.

    python3 tools/studies/modulus_sizes.py [--sand inputs/materials/concrete-sand] [--out inputs/studies/moduli]

Written are svr-N.json, N the number of vectors, mlp-N-N-....h5, N the neurons of each layer, and states.csv: all rows of the measured
unloading curves but those of zero pressure, with the pressure measured there and the slope of the monotone cubic through
the curve's rows. The rows are in order of elastic strain, so that neighbours are of different curves. The same input
gives the same files, byte for byte. Debian's python3-sklearn and python3-h5py are used.
"""

import argparse
import json
import os
import pathlib
import sys

# Sums that threads share come out differently from run to run. Before numpy is imported.
for library in ["OMP", "OPENBLAS", "MKL"]:
    os.environ[f"{library}_NUM_THREADS"] = "1"

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/python"))

from fitting import network, support_vectors  # noqa: E402
from fitting.curves import read_curves  # noqa: E402

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
    rows = []
    for curve in curves:
        for elastic, pressure in zip(curve.elastic[1:], curve.pressure[1:]):
            rows.append((elastic, curve.plastic, pressure, float(curve.modulus_at(elastic))))
    header = "# Rows of the measured unloading curves; K is the slope of a monotone cubic through them.\n"
    header += "# Made by tools/studies/modulus_sizes.py.\n"
    header += "elastic_volumetric[-],plastic_volumetric[-],pressure[Pa],bulk_modulus[Pa]\n"
    lines = (",".join(f"{float(number):.10g}" for number in row) for row in sorted(rows))
    path.write_text(header + "\n".join(lines) + "\n")
    print(f"{len(rows)} states")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sand", type=pathlib.Path, default=ROOT / "inputs/materials/concrete-sand")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "inputs/studies/moduli")
    options = parser.parse_args()

    curves = read_curves(options.sand / "unloading.csv")
    options.out.mkdir(parents=True, exist_ok=True)
    write_states(curves, options.out / "states.csv")
    for c, epsilon in REGRESSIONS:
        write_regression(curves, c, epsilon, options.out)
    for layers in NETWORKS:
        write_network(curves, layers, options.out)


if __name__ == "__main__":
    main()
