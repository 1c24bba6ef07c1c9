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


def random_guides(
    rng: np.random.Generator, count: int, poses: int, *, tilted: bool, one_angle: bool = False
) -> tuple[Complexes, Complexes]:
    """Complex six-bars (count, unknowns) and the task of each, complex[count, 4, unknowns] as `_core.track` takes it.

    The rocker turns at will, coupler and body follow from quadratic equations; so many positions besides the first. Of
    one angle each six-bar has six positions. A tilted task has a number by which the last displacement depends on c.
    """
    unknowns = unknowns_of_guides(poses)
    z = _random(rng, count, _NUMBERS)
    c, d, f, g, h, base, b = np.moveaxis(z.reshape(count, 1, _NUMBERS // 2, 2), 2, 0)
    a, arm = b - base, h - b - d
    if one_angle:
        rocker, coupler = _keeping_angle((base, d, c * arm), (g - h, d - f, arm))
        body = np.ones_like(rocker)
    else:
        turn = _random(rng, count, poses)
        rocker = np.stack([turn, 1 / turn], axis=2)
        signs = rng.choice([-1.0, 1.0], size=(2, count, poses))
        coupler = _closing(b + rocker * d - a, c * arm, b + d + c * arm - a, signs[0])
        body = _closing(rocker * (d - f) + arm * coupler, g - h, g - b - f, signs[1])
    pin = b + rocker * d + arm * coupler
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


def _keeping_angle(*loops: tuple[Complexes, Complexes, Complexes]) -> tuple[Complexes, Complexes]:
    """The five other pairs of turns U, V at which two vectors k + d U + e V have the lengths of U = V = 1.

    Each length is quadratic in V; without V a polynomial of degree six is left, of which U = 1 is one root. Vectors
    (..., 1, 2) with conjugates; both turns (..., 5, 2) with their inverses.
    """

    def quadratic(k: Complexes, d: Complexes, e: Complexes, u: Complexes) -> tuple[Complexes, Complexes, Complexes]:
        (k, kc), (d, dc), (e, ec) = (np.moveaxis(each, -1, 0) for each in (k, d, e))
        return (
            e * kc + e * dc / u,
            k * dc / u + kc * d * u - (k * dc + kc * d + (k + d) * ec + (kc + dc) * e),
            ec * (k + d * u),
        )

    def minors(u: Complexes) -> tuple[Complexes, Complexes, Complexes]:
        (a, b, c), (p, q, r) = (quadratic(*loop, u) for loop in loops)
        return b * r - c * q, c * p - a * r, a * q - b * p

    on_circle = np.exp(2j * np.pi * np.arange(7) / 7)
    x, y, w = minors(on_circle)
    powers = np.fft.fft((y * y - x * w) * on_circle**3, axis=-1) / 7  # from the constant to the sixth
    u = np.array([np.roots(row[::-1]) for row in powers.reshape(-1, 7)]).reshape(*powers.shape[:-1], 6)
    first = np.abs(u - 1).argmin(axis=-1)
    u = u[np.arange(6) != first[..., None]].reshape(*u.shape[:-1], 5)
    _, y, w = minors(u)
    return np.stack([u, 1 / u], axis=-1), np.stack([y / w, w / y], axis=-1)
