"""Particles in a plane as the squares of a picture: each square is the nearest particle's of those that reach it."""

import numpy as np

NOBODY = -1
MOST_AT_ONCE = 2**20  # pairs of a particle and a square


class Raster:
    """Squares over a box, `most` along its longer side; rows from below. A square has the kind of its particle, and
    its values by names, nan where that has none."""

    def __init__(self, lower, upper, most, names):
        self.lower, width = np.array(lower, float), np.subtract(upper, lower).astype(float)
        if not (np.all(width > 0) and np.all(np.isfinite(width))):
            raise ValueError("a box without an inside")
        self.n = np.maximum(np.round(most * width / width.max()).astype(int), 1)
        self.size = width / self.n
        n_all = int(self.n.prod())
        self.distance = np.full(n_all, np.inf, np.float32)
        self.kind = np.full(n_all, NOBODY, np.int8)
        self.value = {name: np.full(n_all, np.nan, np.float32) for name in names}

    def add(self, places, reach, off, kind, values):
        """A particle is a square that reaches so far from its middle, half a square of the picture at least; `off` is
        how far it is from the plane."""
        r = np.maximum(reach / self.size, 0.5)
        n_each = (2 * r).astype(int) + 1
        step = max(MOST_AT_ONCE // int(n_each.prod()), 1)
        for first in range(0, len(places), step):
            part = slice(first, first + step)
            self.add_some(places[part], r, n_each, off[part], kind, {k: v[part] for k, v in values.items()})

    def add_some(self, places, r, n_each, off, kind, values):
        at = (places - self.lower) / self.size
        inside = np.all((at > -r) & (at < self.n + r), axis=1)
        if not inside.any():
            return
        numbers, at, off = np.flatnonzero(inside), at[inside], off[inside] / self.size.max()
        squares, aside = zip(*(reached(at[:, k], r[k], n_each[k], self.n[k]) for k in range(2)))
        square = (squares[1][:, :, None] * self.n[0] + squares[0][:, None, :]).ravel()
        distance = (aside[1][:, :, None] + aside[0][:, None, :] + (off**2).astype(np.float32)[:, None, None]).ravel()
        nearer = np.flatnonzero(distance < self.distance[square])  # not what is inf
        nearer = nearer[np.argsort(-distance[nearer])]  # the last one stays
        square, who = square[nearer], numbers[nearer // int(n_each.prod())]
        self.distance[square] = distance[nearer]
        self.kind[square] = kind
        for name, all_values in self.value.items():
            own = values.get(name)
            all_values[square] = np.nan if own is None else own[who]

    def rows(self, values):
        return values.reshape(self.n[1], self.n[0])


def reached(at, r, n_each, n):
    """Squares that particles reach along an axis, and how far away these are, squared: inf for a square that is none
    of theirs."""
    square = np.ceil(at - r - 0.5)[:, None] + np.arange(n_each)
    aside = np.abs(square + 0.5 - at[:, None])
    is_own = (aside <= r) & (square >= 0) & (square < n)
    return np.where(is_own, square, 0).astype(np.int32), np.where(is_own, aside**2, np.inf).astype(np.float32)
