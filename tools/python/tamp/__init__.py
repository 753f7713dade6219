"""TAMP's Python tools; `python3 tools/python/tamp --help` lists the commands."""
