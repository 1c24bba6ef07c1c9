"""Where the fitting of curves begins if both fixed pivots are given: crank and coupler point are gone through.

docs/theory/synthesis-curves.md has the equations.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from gruebler.base.arrays import Complexes, Reals

_MOST = 60  # points of the target that are looked at
_SUMS = np.concatenate([[0.0], np.geomspace(1e-3, 4.0, 40)])  # by which a + p is more than the greatest distance, in it
_SHARES = 1 - np.linspace(0.0, 1.0, 20) ** 2  # of |a - p| in the least distance
_APART = 0.05  # of the logarithms of lengths: starts that differ less are one


def given_pivots_starts(
    z: Complexes, own: complex, far: complex, number: int, *, closed: bool
) -> tuple[Reals, Reals, Reals, Reals]:
    """Four-bars with given fixed pivots whose coupler points come near a curve, none like a better one.

    Args:
        z: (points,) of the curve, in order.
        own: the pivot of the crank.
        far: the pivot of the rocker.
        number: how many are returned at most.
        closed: whether the curve returns to its begin.

    Returns (starts,) how far the rocker's length varies, in the root of the mean square; (unknowns, starts) numbers
    of the four-bars; (starts,) branches; (starts, points) crank angles. The best are the first. Cost: 0.1 s.

    >>> z = np.array([1 + 2j, 1.4 + 2.3j, 2 + 2.4j, 2.6 + 2.2j, 2.9 + 1.8j, 3 + 1.2j])
    >>> miss, rows, side, phi = given_pivots_starts(z, 0j, 3 - 1j, 40, closed=False)
    >>> bool(miss[0] < 0.01), rows[:4, 0], phi.shape == (len(miss), 6)
    (True, array([ 0.,  0.,  3., -1.]), True)
    """
    some = np.unique(np.linspace(0, len(z), min(len(z), _MOST), endpoint=False).astype(int))
    distance = np.abs(z - own)
    sums, gaps = distance.max() * (1 + _SUMS), distance.min() * _SHARES
    half_sum, half_gap = (part.ravel() / 2 for part in np.meshgrid(sums, np.concatenate([gaps, -gaps])))
    a, p = half_sum + half_gap, half_sum - half_gap
    a, p = (part[(a > 0) & (p > 0)] for part in (a, p))
    starts = []
    for bend in _bends(distance, closed=closed):
        phi = _crank_angles(z, own, a, p, bend)
        pin = own + a[:, None] * np.exp(1j * phi)
        theta = (z - pin) / p[:, None]
        # The rocker: |pin + m theta - far|^2 = c^2 is linear in m and |m|^2 - c^2.
        g = 2 * theta[:, some] * np.conj(pin[:, some] - far)
        f = np.abs(pin[:, some] - far) ** 2
        g0, f0 = g - g.mean(axis=1, keepdims=True), f - f.mean(axis=1, keepdims=True)
        xx, yy, xy = (g0.real**2).sum(axis=1), (g0.imag**2).sum(axis=1), -(g0.real * g0.imag).sum(axis=1)
        right, up = -(g0.real * f0).sum(axis=1), (g0.imag * f0).sum(axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            m = (yy * right - xy * up + 1j * (xx * up - xy * right)) / (xx * yy - xy * xy)
            rest = f0 + np.real(m[:, None] * g0)
            c = np.sqrt(np.abs(m) ** 2 + np.mean(f + np.real(m[:, None] * g), axis=1))
            miss = np.sqrt(np.mean(rest**2, axis=1)) / (2 * c)
            b = np.abs(m)
            w = p * np.conj(m) / b
            turned = np.imag(np.conj(far - pin) * theta * m[:, None])
        held = [np.full(len(a), value) for value in (own.real, own.imag, far.real, far.imag)]
        rows = np.array([*held, a, b, c, w.real, w.imag])
        side = np.where((turned > 0).mean(axis=1) > 0.5, 1.0, -1.0)
        good = np.isfinite(miss) & np.isfinite(rows).all(axis=0) & (np.abs(rows) < 100).all(axis=0)
        starts.append((miss[good], rows[:, good].T, side[good], phi[good]))
    miss, rows, side, phi = (np.concatenate(parts) for parts in zip(*starts, strict=True))
    shape = np.log(np.stack([*rows[:, 4:7].T, np.hypot(*rows[:, 7:].T)], axis=1))
    kept: list[int] = []
    for n in np.argsort(miss, kind="stable"):
        alike = (np.abs(shape[kept] - shape[n]) < _APART).all(axis=1) & (side[kept] == side[n])
        if not alike.any():
            kept.append(int(n))
        if len(kept) == number:
            break
    return miss[kept], rows[kept].T, side[kept], phi[kept]


def _bends(distance: Reals, *, closed: bool) -> list[Reals]:
    """The sides to which crank and coupler point may bend at each point.

    They change only where both are in line: at the greatest and at the least distance from the pivot.
    """
    at = np.arange(len(distance))
    ends = [(len(at), int(k), int(k) + 1) for k in (distance.argmax(), distance.argmin())]
    bends = {}
    for cuts in product(*ends):
        if closed and (cuts[0] == len(at)) != (cuts[1] == len(at)):
            continue
        bend = np.where(sum((at >= cut).astype(int) for cut in cuts) % 2, -1.0, 1.0)
        for signed in (bend, -bend):
            bends[signed.tobytes()] = signed
    return list(bends.values())


def _crank_angles(z: Complexes, own: complex, a: Reals, p: Reals, bend: Reals) -> Reals:
    """(cranks, points) where the crank is if its pin is p from each point."""
    distance = np.maximum(np.abs(z - own), 1e-12)
    cosine = (a[:, None] ** 2 + distance**2 - p[:, None] ** 2) / (2 * a[:, None] * distance)
    return np.asarray(np.angle(z - own) + bend * np.arccos(np.clip(cosine, -1, 1)))
