#!/usr/bin/env python3
"""Velocity, pressure and plastic volumetric strain of the sand around the projectile at four times, on one page.

    tools/studies/projectile_pictures.py runs/table --out docs/projectile.png

Draws the middle 5 mm of the box with tools/python/picture.py, so it needs a display (or Xvfb -noreset) and Debian's
python3-paraview and python3-matplotlib."""

import argparse
import pathlib
import subprocess
import tempfile

import matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot
from PIL import Image

import ranks

TIMES = [2e-4, 4e-4, 6e-4, 8.5e-4]
FIELDS = {"velocity": ["--range", "0", "50"],
          "p": ["--range", "1e5", "1e8", "--log"],
          "plastic_volumetric": ["--range", "-0.1", "0.1"]}
TITLES = {"velocity": "speed, 0 to 50 m/s", "p": "mean stress, 0.1 to 100 MPa, logarithmic",
          "plastic_volumetric": "plastic volumetric strain, -10 to 10 %, compression positive"}


def draw(run, field, time, file):
    subprocess.run(["pvpython", ranks.ROOT / "tools/python/picture.py", run, "--field", field, *FIELDS[field], "--slab", "0.0475",
                    "0.0525", "--beside", "projectile", "--time", str(time), "--point-size", "7", "--out", file],
                   check=True)


def upper_part(image):
    """What is within the box, from above the projectile down to the middle of the sand, without the colour bar."""
    height, width = image.shape[:2]
    return image[int(0.08 * height):int(0.62 * height), int(0.22 * width):int(0.79 * width)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    options = parser.parse_args()
    figure, panels = pyplot.subplots(len(TIMES), len(FIELDS), figsize=(12, 9), constrained_layout=True)
    with tempfile.TemporaryDirectory() as folder:
        for row, time in zip(panels, TIMES):
            for panel, field in zip(row, FIELDS):
                file = pathlib.Path(folder) / "picture.png"
                draw(options.run, field, time, file)
                panel.imshow(upper_part(pyplot.imread(file)))
                panel.set_xticks([])
                panel.set_yticks([])
            row[0].set_ylabel(f"{1e6 * time:.0f} microseconds")
    for panel, field in zip(panels[0], FIELDS):
        panel.set_title(TITLES[field], fontsize=9)
    figure.savefig(options.out, dpi=110)
    Image.open(options.out).convert("RGB").quantize(64).save(options.out, optimize=True)


if __name__ == "__main__":
    main()
