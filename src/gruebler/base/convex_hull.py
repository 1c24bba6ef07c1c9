"""The convex hull of places in the plane."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

_ON_EDGE = 1e-9  # of the extent: corners as near as this to an edge lie on it (an error of rounding)


def convex_hull(places: Iterable[complex], flat: float | None = None) -> list[complex]:
    """The corners of the convex hull, in the sense from x to y, the leftmost (of these the lowest) first.

    Places nearer to one another than ``flat`` are one, corners nearer to the line through their neighbours are left
    out: of places on a line the two ends remain. Without ``flat`` it is 1e-9 of the extent. Cost: O(n log n).

    >>> convex_hull([0, 4, 2, 4 + 3j, 2 + 1j])
    [0j, (4+0j), (4+3j)]
    """
    points = list(map(complex, places))
    least = _ON_EDGE * max((abs(z - points[0]) for z in points), default=0.0) if flat is None else flat
    grid = least or 1.0  # the order of places one above the other does not depend on rounding
    ordered = sorted(points, key=lambda z: (round(z.real / grid), round(z.imag / grid)))
    apart = ordered[:1] + [z for before, z in pairwise(ordered) if abs(z - before) > least]

    def half(line: list[complex]) -> list[complex]:
        chain: list[complex] = []
        for z in line:
            while len(chain) > 1 and _height(chain[-2], chain[-1], z) <= least:
                chain.pop()
            chain.append(z)
        return chain[:-1]

    return apart if len(apart) < 3 else half(apart) + half(apart[::-1])


def _height(start: complex, corner: complex, end: complex) -> float:
    """How far a corner lies to the right of the line from start to end."""
    chord = end - start
    return ((corner - start).conjugate() * chord).imag / abs(chord)
