#!/usr/bin/python3
"""Where sand widens and where it is compacted under the quick punch, on finer and finer cells, side by side.

    tools/studies/localisation.py [--tamp build/release/tamp] [--runs runs/localisation]
                                  [--out docs/accuracy-localisation.png]

Runs inputs/punch/quick.json for 1.8 ms with a box 1 m deep, from the floor of which no wave is back by then, on cells of
2.5, 1.25 and 0.625 cm; 5 minutes on one core. Runs that are there already are only drawn. Prints the greatest dilation of any
particle, and draws the plastic volumetric strain of the sand near the punch. Needs Debian's python3-h5py,
python3-matplotlib and python3-pil."""

import argparse
import pathlib
import subprocess

import h5py
import matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
CELL_SIZES = [0.025, 0.0125, 0.00625]
END = 1.8e-3
FULL_SCALE = 0.3


def run(tamp, cell_size, folder):
    settings = {"/grid/lower": [0, -0.5], "/bodies/sand/geometry/lower": [0, -0.5], "/grid/cell_size": cell_size,
                "/time/end": END, "/output/fields_interval": END}
    arguments = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    subprocess.run([tamp, "run", ROOT / "inputs/punch/quick.json", "--quiet", "--out", folder, *arguments], check=True)


def last_state(folder):
    """Positions [m] and plastic volumetric strain, compression positive, of the sand at the end of a run."""
    with h5py.File(folder / "fields.h5") as file:
        sand = file[max(name for name in file if name.startswith("step_"))]["particles/sand"]
        return sand["position"][:], sand["plastic_volumetric"][:]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tamp", type=pathlib.Path, default=ROOT / "build/release/tamp")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/localisation")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/accuracy-localisation.png")
    options = parser.parse_args()
    figure, panels = pyplot.subplots(1, len(CELL_SIZES), figsize=(12, 4.6), sharey=True, constrained_layout=True)
    for panel, cell_size in zip(panels, CELL_SIZES):
        folder = options.runs / str(cell_size)
        if not (folder / "summary.json").exists():
            run(options.tamp, cell_size, folder)
        position, strain = last_state(folder)
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


if __name__ == "__main__":
    main()
