"""The parts of tools/python/fit_moduli.py."""
