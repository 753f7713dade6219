"""Columns of runs over each other, and of what was measured."""
