"""The outline of a toothed wheel: involute flanks, addendum one module, dedendum a quarter more; no fillets."""

from __future__ import annotations

import math

import numpy as np

from gruebler.base.arrays import Complexes

PRESSURE = math.radians(20)
_PLAY = 0.03  # of half a tooth at the pitch circle: flanks do not touch in the picture


def toothed_outline(teeth: int, module: float = 1.0, *, internal: bool = False, phase: float = 0.0) -> Complexes:
    """The outline about 0, counter-clockwise, the middle of a tooth at the angle ``phase``.

    For an internal wheel the outline of its hole: "teeth" are then its spaces, and ``phase`` is the middle of a space.
    A tooth whose flanks intersect below its tip ends in a point.

    >>> wheel = toothed_outline(24)
    >>> round(float(abs(wheel).max()), 9), round(float(abs(wheel).min()), 9)
    (13.0, 10.75)
    """
    r = teeth * module / 2
    above, below = (1.25, 1.0) if internal else (1.0, 1.25)
    tip, root, base = r + above * module, max(r - below * module, 0.2 * r), r * math.cos(PRESSURE)
    low = max(root, base)
    radii = np.array([*([root] if low > root else []), low, *np.linspace(max(r - module / 2, low), tip, 4)])
    radii = radii[np.concatenate([[True], np.diff(radii) > 0])]
    turn = np.arccos(np.minimum(base / radii, 1.0))
    thick = math.pi / (2 * teeth) * (1 + _PLAY if internal else 1 - _PLAY)
    half = np.maximum(thick + math.tan(PRESSURE) - PRESSURE - (np.tan(turn) - turn), 0.0)
    tooth = np.concatenate([radii * np.exp(-1j * half), (radii * np.exp(1j * half))[::-1]])
    turns = np.exp(1j * (phase + math.tau / teeth * np.arange(teeth)))
    outline: Complexes = (turns[:, None] * tooth).ravel()
    return outline
