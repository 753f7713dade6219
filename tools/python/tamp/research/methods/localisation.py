"""Where sand widens and where it is compacted under the quick punch, on finer and finer cells, side by side.

Runs inputs/punch/quick.json for 1.8 ms with a box 1 m deep, from the floor of which no wave is back by then, on cells
of 2.5, 1.25 and 0.625 cm; 5 minutes on one core. Runs that are there already are only drawn. Prints the greatest
dilation of any particle, and draws the plastic volumetric strain of the sand near the punch. Needs Debian's
python3-h5py, python3-matplotlib and python3-pil.
"""

import pathlib

import matplotlib
from PIL import Image

from tamp import program, results

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

CELL_SIZES = [0.025, 0.0125, 0.00625]
END = 1.8e-3
FULL_SCALE = 0.3


def run(tamp, cell_size, folder):
    settings = {"/grid/lower": [0, -0.5], "/bodies/sand/geometry/lower": [0, -0.5], "/grid/cell_size": cell_size,
                "/time/end": END, "/output/fields_interval": END}
    program.run(tamp, program.INPUTS / "punch/quick.json", folder, settings=settings)


def add_arguments(parser):
    program.add_option(parser)
    parser.add_argument("--runs", type=pathlib.Path, default=program.ROOT / "runs/localisation")
    parser.add_argument("--out", type=pathlib.Path,
                        default=program.ROOT / "docs/findings/pictures/accuracy-localisation.png")


def main(options):
    figure, panels = pyplot.subplots(1, len(CELL_SIZES), figsize=(12, 4.6), sharey=True, constrained_layout=True)
    for panel, cell_size in zip(panels, CELL_SIZES):
        folder = options.runs / str(cell_size)
        if not results.is_finished(folder):
            run(options.tamp, cell_size, folder)
        sand = results.particles(folder, "sand", END)
        position, strain = sand.position, sand["plastic_volumetric"]
        print(f"cells of {100 * cell_size:g} cm: greatest dilation {-strain.min():.2f}, "
              f"{100 * (strain < -0.5).mean():.2f} % of the sand beyond 0.5")
        dots = panel.scatter(position[:, 0], position[:, 1], c=strain, s=(120 * cell_size) ** 2, linewidths=0,
                             cmap="coolwarm", vmin=-FULL_SCALE, vmax=FULL_SCALE)
        panel.set(title=f"cells of {100 * cell_size:g} cm", xlim=(0.12, 0.88), ylim=(-0.05, 0.56), aspect="equal",
                  xlabel="x [m]")
    panels[0].set_ylabel("y [m]")
    figure.colorbar(dots, ax=panels, label="plastic volumetric strain, compression positive", shrink=0.8)
    figure.savefig(options.out, dpi=90)
    Image.open(options.out).convert("RGB").quantize(64).save(options.out, optimize=True)
