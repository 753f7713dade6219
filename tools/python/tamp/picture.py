"""Draws a scalar field of one material's particles at one time of a run, with ParaView's own Python.

    pvpython tools/python/tamp picture runs/table --material sand --field p --time 1e-3 --out p.png
    pvpython tools/python/tamp picture runs/table --field velocity --slab 0.0475 0.0525 --beside projectile --out v.png

In space --slab draws the particles between two places along y, seen along it. A vector is drawn by its length. The
output nearest to --time is drawn; its time and what 5 %, 1 % and 0.1 % of the particles drawn pass are printed, and the
largest value. Needs Debian's paraview and python3-paraview, and a display (or xvfb-run).
"""

import os
import pathlib

from tamp import files
from tamp.failure import Failure, Refusal
from tamp.options import finite

try:
    import numpy
    from paraview import simple
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCompositeDataSet, vtkPolyData
except ImportError:
    simple = None  # said once the command line is read


def blocks_of(data):
    """The data set of each named block."""
    names = [data.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) for i in range(data.GetNumberOfBlocks())]
    return {name: data.GetBlock(i) for i, name in enumerate(names)}


def check_known(names, name, what, path):
    if name not in names:
        raise Refusal(path, f"no {what} {name}", " or ".join(names) or f"a {what}")


def with_lengths(block, field):
    """The name of a scalar array of the block: the field, or the length of its vectors."""
    values = vtk_to_numpy(block.GetPointData().GetArray(field))
    if values.ndim == 1:
        return field
    lengths = numpy_to_vtk(numpy.linalg.norm(values, axis=1), deep=True)
    lengths.SetName(f"|{field}|")
    block.GetPointData().AddArray(lengths)
    return lengths.GetName()


def cut(block, slab):
    """The particles of a block within a slab normal to y."""
    if slab is None:
        return block
    y = vtk_to_numpy(block.GetPoints().GetData())[:, 1]
    inside = numpy.flatnonzero((y >= slab[0]) & (y <= slab[1]))
    chosen = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(vtk_to_numpy(block.GetPoints().GetData())[inside], deep=True))
    chosen.SetPoints(points)
    for k in range(block.GetPointData().GetNumberOfArrays()):
        array = block.GetPointData().GetArray(k)
        part = numpy_to_vtk(vtk_to_numpy(array)[inside], deep=True)
        part.SetName(array.GetName())
        chosen.GetPointData().AddArray(part)
    cells = numpy.column_stack([numpy.ones(len(inside), dtype=numpy.int64), numpy.arange(len(inside))])
    vertices = vtkCellArray()
    vertices.SetCells(len(inside), numpy_to_vtkIdTypeArray(cells.ravel(), deep=True))
    chosen.SetVerts(vertices)
    return chosen


def shown_points(view, block, size):
    data = simple.TrivialProducer()
    data.GetClientSideObject().SetOutput(block)
    shown = simple.Show(data, view)
    shown.Representation = "Points"
    shown.PointSize = size
    return shown


def add_arguments(parser):
    parser.add_argument("run", type=pathlib.Path, metavar="RUN", help="the run's folder")
    parser.add_argument("--material", default="sand")
    parser.add_argument("--field", default="p", help="a scalar of its particles")
    parser.add_argument("--time", type=finite, default=1e-3, help="seconds")
    parser.add_argument("--range", type=finite, nargs=2, help="of the colours; by default that of the data")
    parser.add_argument("--log", action="store_true", help="a logarithmic scale of colours; needs --range above 0")
    parser.add_argument("--slab", type=finite, nargs=2, metavar=("FROM", "TO"), help="places along y, metres")
    parser.add_argument("--beside", nargs="*", default=[], metavar="MATERIAL", help="others to show, in one colour")
    parser.add_argument("--point-size", type=finite, default=4)
    parser.add_argument("--out", type=pathlib.Path, default="picture.png", metavar="PICTURE.png")


def check(options):
    if options.range and not options.range[0] < options.range[1]:
        raise Refusal("--range", options.range, "an ascending pair")
    if options.log and not (options.range and options.range[0] > 0):
        raise Refusal("--log", "no range above 0", "--range")
    if options.out.suffix not in (".png", ".jpg"):
        raise Refusal("--out", options.out, "a name that ends in .png or .jpg")


def read_blocks(path, time):
    """(time of the nearest output, its blocks)"""
    files.check_file(path)
    files.check_file(path.with_suffix(".h5"))
    reader = simple.XDMFReader(FileNames=[str(path)])
    reader.UpdatePipelineInformation()
    times = [reader.TimestepValues] if isinstance(reader.TimestepValues, float) else list(reader.TimestepValues or [])
    if not times:
        raise Failure(path, "no outputs", "what a run of TAMP has written")
    nearest = min(times, key=lambda t: abs(t - time))
    reader.UpdatePipeline(nearest)
    return nearest, blocks_of(simple.servermanager.Fetch(reader))


def main(options):
    check(options)
    if simple is None:
        raise Failure("this Python", "has no paraview", "pvpython, of Debian's paraview and python3-paraview")
    path = options.run / "fields.xdmf"
    files.keep_inputs([path, path.with_suffix(".h5")], [options.out])
    time, blocks = read_blocks(path, options.time)
    for name in [options.material, *options.beside]:
        check_known(blocks, name, "material", path)
    block = blocks[options.material]
    fields = [block.GetPointData().GetArrayName(k) for k in range(block.GetPointData().GetNumberOfArrays())]
    check_known(fields, options.field, "field", path)
    block = cut(block, options.slab)
    if block.GetNumberOfPoints() == 0:
        raise Refusal(path, f"no particle of {options.material} there", "another --slab or --time")
    field = with_lengths(block, options.field)
    values = block.GetPointData().GetArray(field)
    low, high = options.range or values.GetRange()
    passed = numpy.percentile(vtk_to_numpy(values), [95, 99, 99.9, 100])
    print(f"{options.material}.{field} at {time:.6g} s: " + ", ".join(f"{value:.4g}" for value in passed))

    view = simple.CreateView("RenderView")
    view.ViewSize = [1200, 800]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    shown = shown_points(view, block, options.point_size)
    simple.ColorBy(shown, ("POINTS", field))
    colours = simple.GetColorTransferFunction(field)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(low, high)
    if options.log:
        colours.MapControlPointsToLogSpace()
        colours.UseLogScale = 1
    for name in options.beside:
        other = shown_points(view, cut(blocks[name], options.slab), options.point_size)
        simple.ColorBy(other, ("POINTS", ""))
        other.DiffuseColor = other.AmbientColor = [0.75, 0.2, 0.1]
    bar = simple.GetScalarBar(colours, view)
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.Title = f"{options.material}.{field}"
    bar.ComponentTitle = ""
    shown.SetScalarBarVisibility(view, True)
    view.InteractionMode = "2D"
    if options.slab:
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -1, 0], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    if not os.access(options.out.parent, os.W_OK) or not simple.SaveScreenshot(str(options.out), view):
        raise Failure(options.out, "cannot be written", "a place to write to")
