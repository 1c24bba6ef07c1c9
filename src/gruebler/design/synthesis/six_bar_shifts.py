"""Watt I six-bars that shift a body through positions of one angle, and keep its angle on the whole way.

A four-bar on the given pivots leads a coupler point; one of its cognates, put onto the rocker's pivot, leads another
point of the body alike. docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Complexes, Reals

_STARTS = 12_000
_MORE = 4  # times as many if no pivot is given: most end where pins of a link coincide
_STEPS, _LONGEST = 40, 0.3  # of Newton's method; of a step, in sizes
_MET, _SAME = 1e-11, 0.02  # sizes
_RATIO = 30.0  # the longest length by the shortest: beyond it nothing is built
_DIFFERENCE = 1e-7


def shifting_six_bars(a: complex | None, b: complex | None, shifts: Complexes, number: int) -> Complexes:
    """Pins A, C, D, B, H, G, F of six-bars that shift a body, in the first position; (six-bars, 7).

    Args:
        a: the pivot of the crank, if it is given.
        b: that of the ternary rocker, if it is given; else H is at the origin, as only displacements count.
        shifts: (positions,) from the first position, which is the first; of the order of 1, as the pivots.
        number: how many at most, those with the most even lengths first, none like a better one.

    >>> shifts = np.array([0, 0.3 + 0.4j, 0.8 + 0.5j, 1.2 + 0.3j, 1.3, 0.9 - 0.3j])
    >>> pins = shifting_six_bars(0j, 1.5 + 0j, shifts, 4)
    >>> pins.shape, bool(np.abs(_misses(pins[:, :5], shifts)).max() < 1e-9)
    ((4, 7), True)
    """
    rng = np.random.default_rng(5)  # fixed: the same task has the same answer
    given = np.array([np.nan if z is None else z for z in (a, None, None, b, 0 if b is None else None)], np.complex128)
    free = np.flatnonzero(np.isnan(given))
    starts = _STARTS * (_MORE if b is None else 1)
    pins = np.tile(np.where(np.isnan(given), np.nanmean(given), given), (starts, 1))
    pins[:, free] += rng.normal(size=(starts, len(free))) + 1j * rng.normal(size=(starts, len(free)))
    with np.errstate(all="ignore"):
        for _ in range(_STEPS):
            pins = pins[np.isfinite(pins).all(axis=1)]
            errors = _misses(pins, shifts)
            slopes = np.stack(
                [
                    (_misses(pins + _DIFFERENCE * unit * np.eye(5)[k], shifts) - errors) / _DIFFERENCE
                    for k in free
                    for unit in (1, 1j)
                ],
                axis=2,
            )
            good = np.isfinite(slopes).all(axis=(1, 2))
            pins, errors, slopes = pins[good], errors[good], slopes[good]
            square = slopes @ slopes.transpose(0, 2, 1)
            square += 1e-12 * (1 + np.trace(square, axis1=1, axis2=2)[:, None, None]) * np.eye(errors.shape[1])
            step = -(slopes.transpose(0, 2, 1) @ np.linalg.solve(square, errors[:, :, None]))[:, :, 0]
            length = np.linalg.norm(step, axis=1, keepdims=True)
            step *= np.minimum(1, _LONGEST / (length + 1e-300))
            pins[:, free] += step[:, ::2] + 1j * step[:, 1::2]
        met = np.abs(_misses(pins, shifts)).max(axis=1) < _MET
        return _apart(_with_cognate(pins[met]), number)


def _misses(pins: Complexes, shifts: Complexes) -> Reals:
    """(four-bars A, C, D, B, H; positions - 1) by how much the crank would have to be longer than at first.

    The rocker stays on its side of H.
    """
    a, c, d, b, h = pins.T[:, :, None]
    end = h + shifts[1:]
    gap = end - b
    radius, arm = np.abs(d - b), np.abs(h - d)
    along = (radius**2 - arm**2 + np.abs(gap) ** 2) / (2 * np.abs(gap))
    side = np.sign(np.imag(np.conj(h - b) * (d - b)))
    pin = b + gap / np.abs(gap) * (along + 1j * side * np.sqrt(radius**2 - along**2))
    return np.asarray(np.abs(pin + (c - d) / (h - d) * (end - pin) - a) - np.abs(c - a))


def _with_cognate(pins: Complexes) -> Complexes:
    """All seven pins: the link F-G turns as the crank, since H = K + m d U + (1 - m)(C - A), K = A + m (B - A)."""
    a, c, d, b, h = pins.T
    m = (h - c) / (d - c)
    f, g = b + m * (d - b), h + (1 - m) * (b - a)
    return np.stack([a, c, d, b, h, g, f], axis=1)


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
