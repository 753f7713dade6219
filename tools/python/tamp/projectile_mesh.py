"""Writes the surface of a projectile's JSON as binary STL in millimetres.

Made for the shape of inputs/uxo/projectile.json: a body of revolution along x whose last piece, the boom, is a
cylinder, and a ring of rectangular fins that end with it. The surface is one: the boom is left out within the fins, and
the fins within the boom.
"""

import math
import struct

from tamp import files
from tamp.failure import Refusal

ARC_IN_FIN, ARC_BETWEEN_FINS = 6, 8
RINGS = 36
MOST_FINS = 1000
LONGEST = 1e6  # metres


def end_slope(h0, h1, chord0, chord1):
    slope = ((2 * h0 + h1) * chord0 - h0 * chord1) / (h0 + h1)
    if slope * chord0 <= 0:
        return 0.0
    if chord0 * chord1 <= 0 and abs(slope) > 3 * abs(chord0):
        return 3 * chord0
    return slope


def slopes(x, y):
    """Slopes of the monotone cubic of components/curves/monotone_cubic.cpp."""
    h = [b - a for a, b in zip(x, x[1:])]
    chord = [(b - a) / w for a, b, w in zip(y, y[1:], h)]
    inner = []
    for i in range(1, len(h)):
        before, after = 2 * h[i] + h[i - 1], h[i] + 2 * h[i - 1]
        rising = chord[i - 1] * chord[i] > 0
        inner.append((before + after) / (before / chord[i - 1] + after / chord[i]) if rising else 0.0)
    return [end_slope(h[0], h[1], chord[0], chord[1]), *inner, end_slope(h[-1], h[-2], chord[-1], chord[-2])]


def stations(body):
    """Places along the axis and radii, from the tip to the end of the last curved piece."""
    along = [row[0] for row in body["profile"]]
    squared = [row[1] ** 2 for row in body["profile"]]
    slope = slopes(along, squared)
    slope[0] = 2 * body["tip_radius"]
    places = []
    for i in range(len(along) - 2):
        h = along[i + 1] - along[i]
        for k in range(RINGS):
            # Closer near the tip, where the radius grows as the square root.
            t = (k / RINGS) ** 2 if i == 0 else k / RINGS
            value = ((1 + 2 * t) * squared[i] + t * h * slope[i]) * (1 - t) ** 2
            value += ((3 - 2 * t) * squared[i + 1] - (1 - t) * h * slope[i + 1]) * t ** 2
            places.append((along[i] + t * h, math.sqrt(value)))
    return places + [tuple(body["profile"][-2])]


def surface(body, ring):
    """Triangles of points, counterclockwise seen from outside."""
    fin, count = ring["of"], ring["count"]
    front, tail = (choose(x for x, _ in fin["corners"]) for choose in (min, max))
    tip, half = max(y for _, y in fin["corners"]), fin["upper"]
    boom = body["profile"][-1][1]
    root = math.asin(half / boom)

    def turned(y, z, fin_number):
        angle = 2 * math.pi * fin_number / count
        return y * math.cos(angle) - z * math.sin(angle), y * math.sin(angle) + z * math.cos(angle)

    def arc(start, end, pieces):
        return [(math.cos(a), math.sin(a)) for a in (start + (end - start) * k / pieces for k in range(pieces))]

    in_fin, circle, outline = [], [], []
    for i in range(count):
        middle = 2 * math.pi * i / count
        below = arc(middle - root, middle + root, ARC_IN_FIN)
        beside = arc(middle + root, middle + 2 * math.pi / count - root, ARC_BETWEEN_FINS)
        circle += below + beside
        on_boom = [(boom * c, boom * s) for c, s in [*below, *beside]]
        in_fin.append((on_boom[:ARC_IN_FIN + 1], turned(tip, half, i), turned(tip, -half, i)))
        outline += [on_boom[0], turned(tip, -half, i), turned(tip, half, i), *on_boom[ARC_IN_FIN:]]

    rings = [[(x, r * c, r * s) for c, s in circle] for x, r in [*stations(body), (front, boom)]]
    triangles = []

    def strip(first, second):
        for a, b, c, d in zip(first, first[1:] + first[:1], second, second[1:] + second[:1]):
            triangles.extend([(a, b, c), (b, d, c)])

    nose = rings[0][0]
    triangles += [(nose, b, a) for a, b in zip(rings[1], rings[1][1:] + rings[1][:1])]
    for first, second in zip(rings[1:], rings[2:]):
        strip(first, second)
    for on_boom, upper, lower in in_fin:
        rim = [(front, *p) for p in on_boom]
        triangles += [((front, *lower), a, b) for a, b in zip(rim, rim[1:])]
        triangles.append(((front, *upper), (front, *lower), rim[-1]))
    end = [(tail, *p) for p in outline]
    strip([(front, *p) for p in outline], end)
    triangles += [((tail, 0.0, 0.0), a, b) for a, b in zip(end, end[1:] + end[:1])]
    return triangles


def is_meshable(body, ring):
    """Whether `surface` makes one closed surface of it: a cylinder at the end, with fins that are apart."""
    along, radii = zip(*body["profile"])
    across, reach = zip(*ring["of"]["corners"])
    half, boom, count = ring["of"]["upper"], radii[-1], ring["count"]
    lengths = [*along, *radii, *across, *reach, half, body["tip_radius"]]
    if not all(isinstance(length, (int, float)) and abs(length) < LONGEST for length in lengths):
        return False
    is_body = len(along) > 2 and all(a < b for a, b in zip(along, along[1:])) and min(radii) >= 0
    ends_in_boom = is_body and radii[-2] == boom and body["tip_radius"] > 0 and along[-2] <= min(across) < max(across)
    fins_stand_out = isinstance(count, int) and 1 <= count <= MOST_FINS and 0 < half < boom < max(reach)
    return ends_in_boom and fins_stand_out and math.asin(half / boom) * count < math.pi


def read_projectile(path):
    """(body of revolution, ring of fins) of a solid's JSON."""
    try:
        body, ring = files.document(path)["of"]
        is_sound = is_meshable(body, ring)
    except (KeyError, TypeError, ValueError, IndexError):
        is_sound = False
    if not is_sound:
        raise Refusal(path, "another shape", "a revolution that ends in a cylinder, and a ring of fins on it")
    return body, ring


def write_stl(path, triangles):
    with open(path, "wb") as stl:
        stl.write(b"TAMP projectile, mm".ljust(80))
        stl.write(struct.pack("<I", len(triangles)))
        for triangle in triangles:
            stl.write(struct.pack("<3f", 0, 0, 0))
            for point in triangle:
                stl.write(struct.pack("<3f", *(1000 * x for x in point)))
            stl.write(struct.pack("<H", 0))


def add_arguments(parser):
    parser.add_argument("solid", metavar="PROJECTILE.json")
    parser.add_argument("stl", metavar="FILE.stl", help="the file to write")


def main(options):
    files.keep_inputs([options.solid], [options.stl])
    write_stl(options.stl, surface(*read_projectile(options.solid)))
