"""Checks of the program: the same bits, ends that are right, forecasts, restarts, scaling."""
