"""Watt I six-bars that shift a body through positions of one angle, and keep its angle on the whole way.

A four-bar on the given pivots leads a coupler point; one of its cognates, put onto the rocker's pivot, leads another
point of the body alike. docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Complexes, Reals

_STARTS = 12_000
_STEPS, _LONGEST = 40, 0.3  # of Newton's method; of a step, in sizes
_MET, _SAME = 1e-11, 0.02  # sizes
_RATIO = 30.0  # the longest length by the shortest: beyond it nothing is built
_DIFFERENCE = 1e-7


def shifting_six_bars(a: complex, b: complex, shifts: Complexes, number: int) -> Complexes:
    """Pins A, C, D, B, H, G, F of six-bars that shift a body, in the first position; (six-bars, 7).

    Args:
        a: the pivot of the crank.
        b: that of the ternary rocker.
        shifts: (positions,) from the first position, which is the first; of the order of 1, as the pivots.
        number: how many at most, those with the most even lengths first, none like a better one.

    >>> shifts = np.array([0, 0.3 + 0.4j, 0.8 + 0.5j, 1.2 + 0.3j, 1.3, 0.9 - 0.3j])
    >>> pins = shifting_six_bars(0j, 1.5 + 0j, shifts, 4)
    >>> cranks = np.abs(_cranks(pins[:, [1, 2, 4]], 1.5 + 0j, shifts))
    >>> pins.shape, bool(np.ptp(cranks, axis=1).max() < 1e-9)
    ((4, 7), True)
    """
    rng = np.random.default_rng(5)  # fixed: the same task has the same answer
    middle = (a + b) / 2
    pins = middle + rng.normal(size=(_STARTS, 3)) + 1j * rng.normal(size=(_STARTS, 3))
    with np.errstate(all="ignore"):
        for _ in range(_STEPS):
            pins = pins[np.isfinite(pins).all(axis=1)]
            errors = _misses(pins, a, b, shifts)
            slopes = np.stack(
                [
                    (_misses(pins + _DIFFERENCE * unit * np.eye(3)[k], a, b, shifts) - errors) / _DIFFERENCE
                    for k in range(3)
                    for unit in (1, 1j)
                ],
                axis=2,
            )
            good = np.isfinite(slopes).all(axis=(1, 2))
            pins, errors, slopes = pins[good], errors[good], slopes[good]
            square = slopes @ slopes.transpose(0, 2, 1) + 1e-12 * np.eye(errors.shape[1])
            step = -(slopes.transpose(0, 2, 1) @ np.linalg.solve(square, errors[:, :, None]))[:, :, 0]
            length = np.linalg.norm(step, axis=1, keepdims=True)
            step *= np.minimum(1, _LONGEST / (length + 1e-300))
            pins = pins + step[:, ::2] + 1j * step[:, 1::2]
        met = np.abs(_misses(pins, a, b, shifts)).max(axis=1) < _MET
    return _apart(_with_cognate(pins[met], a, b), number)


def _cranks(pins: Complexes, b: complex, shifts: Complexes) -> Complexes:
    """(four-bars, positions) where the crank's pin C lies; the rocker stays on its side of H."""
    c, d, h = pins.T[:, :, None]
    end = h + shifts
    gap = end - b
    radius, arm = np.abs(d - b), np.abs(h - d)
    along = (radius**2 - arm**2 + np.abs(gap) ** 2) / (2 * np.abs(gap))
    side = np.sign(np.imag(np.conj(h - b) * (d - b)))
    pin = b + gap / np.abs(gap) * (along + 1j * side * np.sqrt(radius**2 - along**2))
    return np.asarray(pin + (c - d) / (h - d) * (end - pin))


def _misses(pins: Complexes, a: complex, b: complex, shifts: Complexes) -> Reals:
    """(four-bars, positions - 1) by how much the crank would have to be longer than at first."""
    return np.asarray(np.abs(_cranks(pins, b, shifts[1:]) - a) - np.abs(pins[:, :1] - a))


def _with_cognate(pins: Complexes, a: complex, b: complex) -> Complexes:
    """All seven pins: the link F-G turns as the crank, since H = K + m d U + (1 - m)(C - A), K = A + m (B - A)."""
    c, d, h = pins.T
    m = (h - c) / (d - c)
    f, g = b + m * (d - b), h + (1 - m) * (b - a)
    return np.stack([np.full_like(c, a), c, d, np.full_like(c, b), h, g, f], axis=1)


def _apart(pins: Complexes, number: int) -> Complexes:
    """The first ones by the ratio of their lengths, no two alike."""
    a, c, d, b, h, g, f = pins.T
    sides = [(a, b), (a, c), (c, d), (d, h), (c, h), (b, d), (b, f), (d, f), (f, g), (g, h)]
    lengths = np.abs([p - q for p, q in sides])
    ratio = lengths.max(axis=0) / (lengths.min(axis=0) + 1e-300)
    kept: list[int] = []
    for n in np.argsort(ratio, kind="stable"):
        if not ratio[n] <= _RATIO or len(kept) == number:
            break
        if not kept or np.abs(pins[kept] - pins[n]).max(axis=1).min() > _SAME:
            kept.append(int(n))
    return pins[kept]
