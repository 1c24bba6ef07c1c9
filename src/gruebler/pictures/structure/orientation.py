"""The orientation of a layout: axes of symmetry are vertical, a frame is low and level."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gruebler.pictures.structure.layout import Layout


def upright(layout: Layout, frame: int | None, held: int | None = None) -> NDArray[np.float64]:
    """The points of the layout turned, float64[points, 2], y upward.

    Candidates are the turns that make an axis of symmetry vertical or an edge of the outline level. The choice is the
    one with the lowest frame; without a frame the one with the flattest and widest box, axes of symmetry first. Of
    what looks the same by a symmetry of the layout it is then the one in which the body ``held`` is lowest.
    """
    angles = dict.fromkeys(_upright(layout), True)
    angles |= {angle: False for angle in _level(layout, frame) if angle not in angles}
    pictures = [(upright, layout.points @ _turn(angle).T) for angle, upright in angles.items()]
    pictures = pictures or [(False, layout.points)]
    chosen = min(pictures, key=lambda picture: _badness(layout, picture[1], frame, picture[0]))[1]
    if held is None:
        return chosen
    alike = [chosen[list(image)] for image in layout.images]
    return min(alike, key=lambda points: _badness(layout, points, held, True))


def _turn(angle: float) -> NDArray[np.float64]:
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[cos, -sin], [sin, cos]])


def _upright(layout: Layout) -> list[float]:
    """The turns that make an axis of reflection vertical."""
    angles = []
    for turn in layout.turns:
        if np.linalg.det(turn) < 0:
            axis = math.atan2(turn[1, 0], turn[0, 0]) / 2
            angles += [round(math.pi / 2 - axis, 9), round(-math.pi / 2 - axis, 9)]
    return angles


def _level(layout: Layout, frame: int | None) -> list[float]:
    """The turns that make an edge of the frame, or of any body, level."""
    outlines = layout.outlines if frame is None else (layout.outlines[frame],)
    angles = []
    for outline in outlines:
        for a, b in zip(outline, [*outline[1:], outline[0]], strict=True):
            x, y = layout.points[b] - layout.points[a]
            angles += [round(-math.atan2(y, x), 9), round(math.pi - math.atan2(y, x), 9)]
    return angles


def _badness(layout: Layout, points: NDArray[np.float64], frame: int | None, upright: bool) -> tuple[float, ...]:
    wide, high = np.ptp(points, axis=0)
    middle = (points.max(axis=0) + points.min(axis=0)) / 2
    weight = round(float((points.mean(axis=0) - middle)[1]), 6)
    skewness = round(float((points**3).sum(axis=0)[0]), 6)
    if frame is None:
        symmetric = len(layout.turns) > 1 and not upright
        return float(symmetric), round(float(wide * high + 0.2 * high * high), 6), weight, skewness
    body = points[list(layout.outlines[frame])]
    low = float(body[:, 1].mean() - points[:, 1].min()) / max(high, 1e-9)
    return round(low, 3), float(not upright), weight, skewness
