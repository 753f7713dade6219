#!/usr/bin/env python3
"""Fit the models of the sand's elastic moduli to its measured unloading curves.

    python3 tools/python/fit_moduli.py FOLDER --page PAGE.html

FOLDER holds unloading.csv, which is the table model itself, and hydrostat.csv; docs/fitting.md says how they are made.
Written are support_vectors.json (SVR) and network.h5 (MLP), and if wanted a page of plots. The errors are printed. The
same input gives the same files, byte for byte. Debian's python3-sklearn, python3-h5py and python3-matplotlib are used.
"""

import argparse
import os
import pathlib

# Sums that threads share come out differently from run to run. Before numpy is imported.
for library in ["OMP", "OPENBLAS", "MKL"]:
    os.environ[f"{library}_NUM_THREADS"] = "1"

from fitting import errors, network, page, support_vectors  # noqa: E402
from fitting.curves import read_curves, read_table  # noqa: E402


def layers(text):
    """Neurons of each layer, as 64,32,32."""
    return tuple(int(number) for number in text.split(","))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--out", type=pathlib.Path, metavar="FOLDER", help="for the files made; by default the same")
    parser.add_argument("--page", type=pathlib.Path, metavar="PAGE.html", help="plots of the fits")
    parser.add_argument("--c", type=float, default=10, help="SVR: weight of errors (%(default)s)")
    parser.add_argument("--epsilon", type=float, default=0.001, help="SVR: free error, of the range of p (%(default)s)")
    parser.add_argument("--layers", type=layers, default=network.LAYERS, help="MLP: neurons of each (64,32,32)")
    parser.add_argument("--epochs", type=int, default=800, help="MLP (%(default)s)")
    parser.add_argument("--batch", type=int, default=32, help="MLP (%(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="MLP (%(default)s)")
    return parser.parse_args()


def main():
    options = arguments()
    curves = read_curves(options.folder / "unloading.csv")
    hydrostat = read_table(options.folder / "hydrostat.csv")
    out = options.out or options.folder
    out.mkdir(parents=True, exist_ok=True)

    support_vectors.write(support_vectors.fit(curves, options.c, options.epsilon), out / "support_vectors.json")
    network.write(*network.fit(curves, options.epochs, options.batch, options.seed, options.layers), out / "network.h5")

    # What is shown is what the files say.
    models = [support_vectors.SupportVectors(out / "support_vectors.json"), network.Network(out / "network.h5")]
    print(f"support_vectors.json: {len(models[0].vectors)} vectors\n")
    tables = errors.tables(curves, hydrostat, models)
    print("\n\n".join(errors.as_text(table) for table in tables))
    if options.page:
        page.write(options.page, curves, hydrostat, models, tables)


if __name__ == "__main__":
    main()
