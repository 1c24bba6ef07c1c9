"""Fewer points of a line."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gruebler.pictures.canvas.shapes import Point

FINE = 0.12
"""The tolerance of a drawn curve in pixels."""


def simplified(points: Sequence[Point], most: float) -> list[Point]:
    """Fewer points of a line, with the others within a distance of it (Douglas and Peucker 1973).

    >>> simplified([Point(0, 0), Point(1, 0.01), Point(2, 0)], 0.1)
    [Point(x=0, y=0), Point(x=2, y=0)]
    """
    xy = np.array(points, np.float64)
    selected = {0, len(xy) - 1}
    open_parts = [(0, len(xy) - 1)]
    while open_parts:
        a, b = open_parts.pop()
        if b - a < 2:
            continue
        along, inner = xy[b] - xy[a], xy[a + 1 : b] - xy[a]
        square = float(along @ along)
        part = np.clip(inner @ along / square, 0, 1) if square > 1e-12 else np.zeros(len(inner))
        far = np.hypot(*(inner - part[:, None] * along).T)
        k = int(far.argmax())
        if far[k] > most:
            middle = a + 1 + k
            selected.add(middle)
            open_parts += [(a, middle), (middle, b)]
    return [points[k] for k in sorted(selected)]
