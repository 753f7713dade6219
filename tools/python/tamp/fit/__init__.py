"""Fits of the sand's elastic moduli."""

import os

# Sums that threads share come out differently from run to run. Before numpy is imported.
for library in ["OMP", "OPENBLAS", "MKL"]:
    os.environ[f"{library}_NUM_THREADS"] = "1"
