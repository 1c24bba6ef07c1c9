"""Watt I six-bars that carry a body through positions: complex ones made at random, each with positions of its own.

The frame has the pivots A and B; crank A-C, coupler C-D-H and ternary rocker B-D-F are a four-bar, and the body has its
pins at H and, by a link, at F. docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Complexes, Reals

TILT = 9
"""The place in the first row of a task of the number by which c makes the last displacement's conjugate smaller."""
_NUMBERS = 14  # c, d, f, G, H, B - A, B, each with its conjugate


def random_guides(rng: np.random.Generator, count: int, poses: int, *, tilted: bool) -> tuple[Complexes, Complexes]:
    """Complex six-bars (count, unknowns) and the task of each, complex[count, 4, unknowns] as `_core.track` takes it.

    The rocker turns at will, coupler and body follow from quadratic equations; so many positions besides the first. A
    tilted task has a number by which the last displacement depends on c.
    """
    unknowns = unknowns_of_guides(poses)
    z = _random(rng, count, _NUMBERS)
    c, d, f, g, h, base, b = np.moveaxis(z.reshape(count, 1, _NUMBERS // 2, 2), 2, 0)
    turn = _random(rng, count, poses)
    rocker = np.stack([turn, 1 / turn], axis=2)
    signs = rng.choice([-1.0, 1.0], size=(2, count, poses))
    a, arm = b - base, h - b - d
    coupler = _closing(b + rocker * d - a, c * arm, b + d + c * arm - a, signs[0])
    pin = b + rocker * d + arm * coupler
    body = _closing(pin - b - rocker * f, g - h, g - b - f, signs[1])
    tasks = np.zeros((count, 4, unknowns), np.complex128)
    tasks[:, 0, :poses] = body[..., 0]
    tasks[:, 1:3, :poses] = np.moveaxis(pin - body * h, 2, 1)
    if unknowns < _NUMBERS:
        tasks[:, 3, : _NUMBERS - unknowns] = z[:, unknowns:]
    tasks[:, 3, 2 * poses : unknowns] = z[:, 2 * poses : unknowns]
    if tilted:
        tasks[:, 0, TILT] = _random(rng, count)
        tasks[:, 2, poses - 1] += tasks[:, 0, TILT] * z[:, 0]
    return z[:, :unknowns].copy(), tasks


def unknowns_of_guides(poses: int) -> int:
    """Ten with both pivots of the frame given, up to six positions; for more of them fourteen."""
    return 10 if poses <= 5 else _NUMBERS


def _random(rng: np.random.Generator, *shape: int) -> Complexes:
    return np.asarray(rng.normal(size=shape) + 1j * rng.normal(size=shape))


def _closing(w: Complexes, p: Complexes, length: Complexes, sign: Reals) -> Complexes:
    """The turn T by which w + p T is as long as another vector, one of two, and 1/T; each (..., 2) with conjugates."""
    a, c = p[..., 0] * w[..., 1], w[..., 0] * p[..., 1]
    b = w.prod(axis=-1) + p.prod(axis=-1) - length.prod(axis=-1)
    turn = (sign * np.sqrt(b * b - 4 * a * c) - b) / (2 * a)
    return np.stack([turn, 1 / turn], axis=-1)
