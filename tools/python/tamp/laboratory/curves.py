"""Curves of a hydrostatic load-unload test, from its rows of (strain, pressure)."""

TOLERANCE = 1e-3  # of the value, everywhere on a curve
SLOPE_TOLERANCE = 2e-4  # the unloading curves are differentiated (bulk modulus), so they keep more points


def turning_point(rows):
    return max(range(len(rows)), key=lambda i: rows[i][1])


def loading_branch(rows):
    return ascending(rows[: turning_point(rows) + 1])


def unloading_branch(rows):
    """From its end up to the largest pressure."""
    return ascending(reversed(rows[turning_point(rows) :]))


def unloading_curve(rows):
    """(plastic strain, [(elastic strain, pressure)]) of the unloading branch, cut at zero pressure or run on to it."""
    branch = unloading_branch(rows)
    first = next(i for i, (_, p) in enumerate(branch) if p > 0)
    (s0, p0), (s1, p1) = branch[max(first - 1, 0) :][:2]
    plastic = s0 - p0 * (s1 - s0) / (p1 - p0)
    return plastic, [(0.0, 0.0)] + [(s - plastic, p) for s, p in branch[first:]]


def ascending(points):
    """Points in order of strain; repeats, and points that would make the curve fall, are left out."""
    kept = []
    for x, y in points:
        if not kept or (x > kept[-1][0] and y > kept[-1][1]):
            kept.append((x, y))
    return kept


def pressure_at(points, strain):
    """Linear between points, and constant beyond their ends."""
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if strain <= x1:
            return y0 + (y1 - y0) * max(strain - x0, 0) / (x1 - x0)
    return points[-1][1]


def crossing(curve, next_curve):
    """The least pressure at which a curve of more plastic strain has no more total strain; None if there is none."""
    (plastic, points), (next_plastic, next_points) = curve, next_curve
    strains, next_strains = flipped(points), flipped(next_points)
    top = min(strains[-1][0], next_strains[-1][0])
    for pressure in sorted(p for p, _ in strains + next_strains if p <= top):
        elastic, next_elastic = pressure_at(strains, pressure), pressure_at(next_strains, pressure)
        if next_plastic + next_elastic <= plastic + elastic:
            return pressure
    return None


def flipped(points):
    return [(y, x) for x, y in points]


def thinned(points, tolerance=TOLERANCE):
    """The fewest points, taken greedily, whose chords hold every point left out within `tolerance` of its value."""

    def chord_holds(i, j):
        (x0, y0), (x1, y1) = points[i], points[j]
        slope = (y1 - y0) / (x1 - x0)
        return all(abs(y0 + slope * (x - x0) - y) <= tolerance * abs(y) for x, y in points[i + 1 : j])

    kept, i = [points[0]], 0
    while i < len(points) - 1:
        j = i + 1
        # A chord that fails may hold again with a later end, but never for long: look a little ahead.
        ahead = j
        while ahead < len(points) and ahead - j < 8:
            if chord_holds(i, ahead):
                j = ahead
            ahead += 1
        kept.append(points[j])
        i = j
    return kept
