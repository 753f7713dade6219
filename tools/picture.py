"""Draws a scalar field of one material's particles at one time of a run, with ParaView's own Python:

    pvpython tools/picture.py runs/table --material sand --field p --time 1e-3 --out p.png

The output nearest to --time is drawn; its time and what 5 %, 1 % and 0.1 % of the particles pass are printed, and the
largest value. Needs Debian's paraview and
python3-paraview, and a display (or xvfb-run).
"""

import argparse
import os

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet


def blocks_of(data):
    """The data set of each named block."""
    names = [data.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) for i in range(data.GetNumberOfBlocks())]
    return {name: data.GetBlock(i) for i, name in enumerate(names)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="the run's folder")
    parser.add_argument("--material", default="sand")
    parser.add_argument("--field", default="p", help="a scalar of its particles")
    parser.add_argument("--time", type=float, default=1e-3, help="seconds")
    parser.add_argument("--range", type=float, nargs=2, help="of the colours; by default that of the data")
    parser.add_argument("--point-size", type=float, default=4)
    parser.add_argument("--out", default="picture.png")
    options = parser.parse_args()

    reader = simple.XDMFReader(FileNames=[os.path.join(options.run, "fields.xdmf")])
    reader.UpdatePipelineInformation()
    time = min(reader.TimestepValues, key=lambda t: abs(t - options.time))
    reader.UpdatePipeline(time)
    blocks = blocks_of(simple.servermanager.Fetch(reader))
    data = simple.TrivialProducer()
    data.GetClientSideObject().SetOutput(blocks[options.material])
    values = blocks[options.material].GetPointData().GetArray(options.field)
    low, high = options.range or values.GetRange()
    passed = numpy.percentile(vtk_to_numpy(values), [95, 99, 99.9, 100])
    print(f"{options.material}.{options.field} at {time:.6g} s: " + ", ".join(f"{value:.4g}" for value in passed))

    view = simple.CreateView("RenderView")
    view.ViewSize = [1200, 800]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    shown = simple.Show(data, view)
    shown.Representation = "Points"
    shown.PointSize = options.point_size
    simple.ColorBy(shown, ("POINTS", options.field))
    colours = simple.GetColorTransferFunction(options.field)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(low, high)
    bar = simple.GetScalarBar(colours, view)
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.Title = f"{options.material}.{options.field}"
    bar.ComponentTitle = ""
    shown.SetScalarBarVisibility(view, True)
    view.InteractionMode = "2D"
    simple.ResetCamera(view)
    simple.SaveScreenshot(options.out, view)


if __name__ == "__main__":
    main()
