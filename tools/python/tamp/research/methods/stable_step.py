"""Holds the bound on the time step of the viscous rule against eigenvalues, and prints what comes out as Markdown.

Elastic bodies of GIMP particles lie at random places in a grid. With the nodes' mass M (lumped), stiffness K and
viscous damping G (lagged by a step), and R = M^-1 sum m_p S_ip S_jp, the share of the nodes' velocities that particles
hand back, leapfrog is stable as long as no eigenvalue of (2 - R) M^-1 (K dt^2 / 4 + G dt / 2) is above 1: at the limit
all fields change sign from step to step. The table shows its largest eigenvalue at the step of the rule
(components/loads/time_step.hpp), the least and the greatest over all samples: above 1 the rule is not safe, far below
1 it is wasteful. Units: cell, density and uniaxial modulus are 1. Only the standard library is used.
"""

import itertools
import math
import random

from tamp.markdown import print_head, print_row
from tamp.options import count

SHARED_STIFFNESS = 4.5
LINEAR_VISCOSITY = 0.2
POISSON_RATIOS = [0.0, 0.2, 0.45]


# Particles


def lattice(dimension, n, n_along, offset):
    return [[10 + o + (i + 0.5) / n for i, o in zip(place, offset)]
            for place in itertools.product(range(n_along), repeat=dimension)]


def bodies(dimension, n, rng):
    """(kind, particles): one sample of each kind"""
    offset = [rng.random() for _ in range(dimension)]
    n_along = 3 * n if dimension == 2 else (5 * n + 1) // 2
    block = lattice(dimension, n, n_along, offset)
    middle = [10 + o + n_along / n / 2 + rng.uniform(-0.5, 0.5) / n for o in offset]
    radius = rng.uniform(0.5, 1.2)
    part = rng.random()
    yield "block", block
    yield "ball", [x for x in block if math.dist(x, middle) < radius]
    yield "thinned", [x for x in block if rng.random() < part]
    yield "alone", block[:1]


def along_axis(x, half):
    """First node, weights and slopes of its three nodes"""
    first = math.floor(x - half)
    t = x - first
    e, within = max(t - 1, -half), max(1 - half - t, 0)
    w0, w2 = (half - e) ** 2 / (4 * half) + within, (half + e) ** 2 / (4 * half)
    s0, s2 = -(half - e) / (2 * half), (half + e) / (2 * half)
    return first, [w0, 1 - w0 - w2, w2], [s0, -s0 - s2, s2]


def stencil(x, half):
    """[(node, weight, gradient)] where the weight is not 0"""
    axes = [along_axis(coordinate, half) for coordinate in x]
    found = []
    for place in itertools.product(range(3), repeat=len(x)):
        weights = [axis[1][i] for axis, i in zip(axes, place)]
        weight = math.prod(weights)
        if weight < 1e-12:
            continue
        gradient = [axes[k][2][i] * math.prod(weights[:k] + weights[k + 1:]) for k, i in enumerate(place)]
        found.append((tuple(axis[0] + i for axis, i in zip(axes, place)), weight, gradient))
    return found


# The step


class Body:
    def __init__(self, particles, n):
        self.dimension = len(particles[0])
        self.n = n
        self.volume = n ** -self.dimension
        self.stencils = [stencil(x, 0.5 / n) for x in particles]
        self.mass = {}
        for particle in self.stencils:
            for node, weight, _ in particle:
                self.mass[node] = self.mass.get(node, 0) + self.volume * weight

    def own_stiffness(self):
        n_alike = max(1, self.n / 2) ** (self.dimension - 1)
        return max(n_alike * sum(self.volume * sum(g * g for g in gradient) / self.mass[node]
                                 for node, _, gradient in particle) for particle in self.stencils)

    def forces(self, u, dt, lame, shear, viscosity):
        """(K dt^2 / 4 + G dt / 2) u"""
        axes = range(self.dimension)
        forces = {node: [0.0] * self.dimension for node in self.mass}
        for particle in self.stencils:
            h = [[sum(u[node][i] * g[j] for node, _, g in particle) for j in axes] for i in axes]
            dilation = sum(h[i][i] for i in axes) * (lame * dt * dt / 4 + viscosity * dt / 2)
            stress = [[self.volume * (shear * dt * dt / 4 * (h[i][j] + h[j][i]) + (dilation if i == j else 0))
                       for j in axes] for i in axes]
            for node, _, g in particle:
                force = forces[node]
                for i in axes:
                    force[i] += sum(stress[i][j] * g[j] for j in axes)
        return forces

    def forgotten(self, a):
        """(2 - R) a"""
        axes = range(self.dimension)
        back = {node: [0.0] * self.dimension for node in self.mass}
        for particle in self.stencils:
            seen = [self.volume * sum(weight * a[node][i] for node, weight, _ in particle) for i in axes]
            for node, weight, _ in particle:
                for i in axes:
                    back[node][i] += weight * seen[i]
        return {node: [2 * a[node][i] - back[node][i] / self.mass[node] for i in axes] for node in a}

    def largest_eigenvalue(self, rng, *step):
        u = {node: [rng.uniform(-1, 1) for _ in range(self.dimension)] for node in self.mass}
        value = 0.0
        for _ in range(300):
            forces = self.forces(u, *step)
            u = self.forgotten({node: [f / self.mass[node] for f in forces[node]] for node in forces})
            previous, value = value, math.sqrt(sum(x * x * self.mass[node] for node in u for x in u[node]))
            u = {node: [x / value for x in u[node]] for node in u}
            if abs(value - previous) < 1e-4 * value:
                break
        return value


def at_the_bound(body, poisson, linear, rng):
    """The largest eigenvalue at the step of the rule"""
    shear, lame = (1 - 2 * poisson) / (2 * (1 - poisson)), poisson / (1 - poisson)
    bulk = lame + 2 * shear / 3
    own = body.own_stiffness()
    a = SHARED_STIFFNESS + own * (lame + 2 * shear / body.dimension)
    b = (SHARED_STIFFNESS + own) * linear * math.sqrt(bulk)
    dt = 2 / (b + math.sqrt(b * b + 2 * a))
    return body.largest_eigenvalue(rng, dt, lame, shear, linear * math.sqrt(bulk))


def add_arguments(parser):
    parser.add_argument("--samples", type=count, default=6)
    parser.add_argument("--seed", type=int, default=1)


def main(options):
    rng = random.Random(options.seed)
    print_head(["dimension", "particles an axis", "body", "without viscosity", "with"])
    for dimension, n in [(2, 1), (2, 2), (2, 3), (2, 4), (3, 1), (3, 2), (3, 3)]:
        found = {}
        for _ in range(options.samples):
            for kind, particles in bodies(dimension, n, rng):
                if not particles:
                    continue
                body = Body(particles, n)
                for linear in (0, LINEAR_VISCOSITY):
                    values = [at_the_bound(body, poisson, linear, rng) for poisson in POISSON_RATIOS]
                    found.setdefault((kind, linear), []).extend(values)
        for kind in ("block", "ball", "thinned", "alone"):
            ranges = [f"{min(v):.2f} to {max(v):.2f}" for v in (found[kind, 0], found[kind, LINEAR_VISCOSITY])]
            print_row([dimension, n, kind, *ranges])
