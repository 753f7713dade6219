"""The exact force on a rigid tool that is pressed into an elastic block, as tamp verify has it.

The block of inputs/verification/scenes/pressed_block.json lies on a smooth bed between smooth walls; strains are small.
Under a pressure on its top each of the block's modes, J0(xi r) about an axis and cos(xi x) in the plane, goes down by
itself: by 2 (1 - nu^2) / (E xi) (cosh 2 xi h - 1) / (sinh 2 xi h + 2 xi h) of the mode's pressure, as an elastic layer
does (Sneddon, Fourier Transforms, 1951), and the mean by that of uniaxial strain. Under a round tool pressure is found
on strips, none of which pulls; under a flat one as a series whose terms have the singular edge.
"""

import numpy as np
from scipy import special

from tamp.markdown import print_head, print_row

YOUNG, POISSON = 10e6, 0.3
WIDTH, HEIGHT = 0.08, 0.06
DEPTH, RADIUS, HALF_WIDTH = 5e-4, 0.2, 0.01
N_STRIPS, N_MODES, N_TERMS = 400, 16000, 8


class AboutAxis:
    """The block about an axis: strips are rings, and a force is that of the whole."""

    mean_of_first_term = HALF_WIDTH

    def __init__(self):
        self.xi = special.jn_zeros(1, N_MODES) / WIDTH
        self.weight = 2 / (WIDTH * special.j0(self.xi * WIDTH)) ** 2
        self.mean_weight, self.unit = 2 / WIDTH**2, 2 * np.pi

    def strips(self, edges):
        """How much of each mode, and of the mean, each strip holds."""
        modes = edges * special.j1(np.outer(self.xi, edges)) / self.xi[:, None]
        return np.diff(modes), np.diff(edges**2) / 2

    def term(self, m):
        return HALF_WIDTH * special.spherical_jn(2 * m, self.xi * HALF_WIDTH)


class InPlane:
    """Half of the block in the plane, for a unit of thickness."""

    mean_of_first_term = np.pi / 2

    def __init__(self):
        self.xi = np.arange(1, N_MODES + 1) * np.pi / WIDTH
        self.weight = np.full(N_MODES, 2 / WIDTH)
        self.mean_weight, self.unit = 1 / WIDTH, 1

    def strips(self, edges):
        return np.diff(np.sin(np.outer(self.xi, edges)) / self.xi[:, None]), np.diff(edges)

    def term(self, m):
        return np.pi / 2 * special.jv(2 * m, self.xi * HALF_WIDTH)


def compliance(block):
    """How far the top goes down under a mode of unit pressure, times the mode's weight; the same of the mean."""
    t = np.minimum(2 * block.xi * HEIGHT, 300)
    layer = 2 * (1 - POISSON**2) / (YOUNG * block.xi) * (np.cosh(t) - 1) / (np.sinh(t) + t)
    uniaxial = HEIGHT * (1 + POISSON) * (1 - 2 * POISSON) / (YOUNG * (1 - POISSON))
    return block.weight * layer, block.mean_weight * uniaxial


def force_on_round_tool(block):
    edges = np.linspace(0, 1.5 * np.sqrt(RADIUS * DEPTH), N_STRIPS + 1)
    modes, sizes = block.strips(edges)
    of_modes, of_mean = compliance(block)
    top = (modes.T * of_modes) @ modes / sizes[:, None] + of_mean * sizes
    middle = (edges[1:] + edges[:-1]) / 2
    down = DEPTH - RADIUS + np.sqrt(RADIUS**2 - middle**2)
    touched = down > 0
    while True:
        pressure = np.zeros(N_STRIPS)
        pressure[touched] = np.linalg.solve(top[np.ix_(touched, touched)], down[touched])
        if (pressure >= 0).all():
            return block.unit * pressure @ sizes
        touched &= pressure >= 0


def force_on_flat_tool(block):
    terms = np.array([block.term(m) for m in range(N_TERMS)])
    of_modes, of_mean = compliance(block)
    top = (terms * of_modes) @ terms.T
    top[0, 0] += of_mean * block.mean_of_first_term**2
    down = np.zeros(N_TERMS)
    down[0] = DEPTH * block.mean_of_first_term
    return block.unit * np.linalg.solve(top, down)[0] * block.mean_of_first_term


def add_arguments(_):
    pass


def main(_):
    print_head(["tool", "force"])
    for name, block, unit in (("ball, whole", AboutAxis(), "N"), ("cylinder, half", InPlane(), "N/m")):
        print_row([name, f"{force_on_round_tool(block):.5g} {unit}"])
    for name, block, unit in (("round punch, whole", AboutAxis(), "N"),
                              ("plane punch, half", InPlane(), "N/m")):
        print_row([name, f"{force_on_flat_tool(block):.5g} {unit}"])
