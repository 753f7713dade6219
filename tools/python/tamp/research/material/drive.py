"""A point of a material along a path of deformation, by `tamp drive`."""

import pathlib
import tempfile

from tamp import files, program, results

HEAD = "time,F11,F12,F13,F21,F22,F23,F31,F32,F33"
TIGHT = {"/tolerance": 1e-8, "/max_substeps": 100000}
ROWS_A_LEG = 10


def diagonal(xx, yy, zz):
    return (xx, 0, 0, 0, yy, 0, 0, 0, zz)


def legs(corners):
    """Straight from corner to corner, in rows near enough that results can be compared at them."""
    rows = [corners[0]]
    for start, end in zip(corners, corners[1:]):
        for i in range(1, ROWS_A_LEG + 1):
            s = i / ROWS_A_LEG
            rows.append(tuple((1 - s) * a + s * b for a, b in zip(start, end)))
    return rows


def write_path(path, rows, digits=17, remarks=()):
    """A file of rows (time, F row by row)."""
    files.write_table(path, remarks, HEAD, [(time, *deformation) for time, deformation in rows], digits)


def drive(tamp, material, path, increment, settings=()):
    """The columns that come out. `path` is a file, or rows (time, F row by row)."""
    with tempfile.TemporaryDirectory() as folder:
        made, out = pathlib.Path(folder, "path.csv"), pathlib.Path(folder, "out.csv")
        if isinstance(path, list):
            write_path(made, path)
            path = made
        program.call(tamp, "drive", material, path, "--increment", repr(increment), "--out", out,
                     *program.changes(settings))
        return results.columns(out)
