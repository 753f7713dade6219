"""The parts of tools/python/unloading_from_tests.py: a laboratory's files, and curves of them."""
