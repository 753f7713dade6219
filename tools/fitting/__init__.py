"""The parts of tools/fit_moduli.py."""
