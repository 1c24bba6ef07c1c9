"""Zeros of functions of one variable that come with derivatives: brackets from samples, then roots to rounding."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Zero", "bracketed", "zeros"]

Reals = NDArray[np.float64]
Jet = Callable[[Reals], Reals]
"""From (n,) places to (derivatives, n): the function, and as many of its derivatives as are known."""

_NONE = 1e-9  # of the usual size: a value below is taken for none
_FLAT = 1e-4  # a slope below this part of the usual one asks whether the zero is a multiple one
_JUMP = 1e-6  # of the usual size: where the sign changes but the function is larger, it jumps
_WINDOW = 0.1  # of a cell: how far from such a zero that of the last derivative may lie


class Zero(NamedTuple):
    """A zero of a function."""

    at: float
    multiplicity: int
    """1: it crosses zero; 2: it touches; 3: it crosses with a horizontal tangent."""
    rises: bool
    """Whether the function is larger behind it than before (for 2: whether it touches from below)."""


def bracketed(function: Callable[[Reals], Reals], low: Reals, high: Reals) -> Reals:
    """One zero in each bracket: Chandrupatla's method (inverse quadratic steps, else bisection), all at once.

    Args:
        function: from (k,) to (k,) values.
        low: (k,) ends of brackets.
        high: (k,) other ends, where the function has the other sign.

    Error: a few roundings of the place, if the function's own are no larger. Cost: some 8 calls.

    >>> bracketed(lambda x: x**2 - 2, np.array([0.0]), np.array([2.0])).round(12).tolist()
    [1.414213562373]
    """
    a, b = high.copy(), low.copy()
    fa, fb = function(a), function(b)
    c, fc = a.copy(), fa.copy()
    t = np.full(len(a), 0.5)
    tight = 4 * np.finfo(float).eps * np.maximum(1e-3 * np.abs(high - low), np.maximum(np.abs(low), np.abs(high)))
    for _ in range(100):
        x = a + t * (b - a)
        fx = function(x)
        same = np.sign(fx) == np.sign(fa)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        least = np.where(np.abs(fa) < np.abs(fb), a, b)
        width = np.abs(b - a)
        done = (fa == 0) | (fb == 0) | (width <= 2 * tight)
        if done.all():
            break
        with np.errstate(divide="ignore", invalid="ignore"):
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            quadratic = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi)
            step = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        edge = np.where(width > 0, tight / np.where(width > 0, width, 1), 0.5)
        t = np.where(quadratic & np.isfinite(step), step, 0.5)
        t = np.where(done, 0, np.clip(t, np.minimum(edge, 0.5), 1 - np.minimum(edge, 0.5)))
    out: Reals = np.where(fa == 0, a, np.where(fb == 0, b, least))
    return out


def zeros(jet: Jet, grid: Reals, least: float = 0.0) -> tuple[Zero, ...]:
    """All zeros between the first and the last place of a grid, in order.

    Between neighbours of the grid a crossing is seen by the sign; if the first derivative is known, so are two
    crossings or a touch, by the extremum between them. With the second derivative a triple zero is found to rounding
    as the zero of that derivative. A sign that changes by a jump is no zero, and a function that is larger than
    `least` over less than a tenth of the grid has none.

    >>> [(round(zero.at, 9), zero.multiplicity) for zero in zeros(lambda x: np.stack([x**3, 3 * x**2, 6 * x]),
    ...     np.linspace(-1, 1.1, 20))]
    [(0.0, 3)]
    """
    rows = jet(grid)
    usual = np.quantile(np.abs(rows), 0.9, axis=1)
    if not usual[0] > least:
        return ()
    low, high = [grid[:-1]], [grid[1:]]
    cross = (np.sign(rows[0][:-1]) * np.sign(rows[0][1:]) < 0) | (rows[0][:-1] == 0)
    chosen = [cross]
    touching: list[Zero] = []
    if len(rows) > 1:
        at, sides = _dips(jet, grid, rows)
        value = jet(at)[0] if len(at) else at
        none = np.abs(value) <= _NONE * usual[0]
        touching = [Zero(float(x), 2, bool(side < 0)) for x, side in zip(at[none], sides[none], strict=True)]
        through = ~none & (np.sign(value) != sides)
        cells = np.searchsorted(grid, at[through]) - 1
        low += [grid[cells], at[through]]
        high += [at[through], grid[cells + 1]]
        chosen += [np.ones(len(cells), bool)] * 2
    which = np.concatenate(chosen)
    crossing = _crossings(jet, np.concatenate(low)[which], np.concatenate(high)[which], usual[0])
    if len(rows) > 2:
        crossing = [_triple(jet, zero, grid, usual) for zero in crossing]
    return tuple(sorted(touching + crossing))


def _crossings(jet: Jet, left: Reals, right: Reals, usual: float) -> list[Zero]:
    """The zeros in brackets, or at their left ends."""
    if not len(left):
        return []
    start, end = jet(left)[0], jet(right)[0]
    exact, found = start == 0, left.copy()
    if not exact.all():
        found[~exact] = bracketed(lambda x: jet(x)[0], left[~exact], right[~exact])
    rises = np.where(exact, end > 0, start < end)
    near = np.abs(jet(found)[0]) <= _JUMP * usual
    return [Zero(float(x), 1, bool(up)) for x, up in zip(found[near], rises[near], strict=True)]


def _dips(jet: Jet, grid: Reals, rows: Reals) -> tuple[Reals, Reals]:
    """Where the function comes nearest to zero between two places of one sign; and that sign."""
    side = np.sign(rows[0][:-1])
    dip = (side == np.sign(rows[0][1:])) & (side * rows[1][:-1] < 0) & (side * rows[1][1:] > 0)
    if not dip.any():
        return np.empty(0), np.empty(0)
    return bracketed(lambda x: jet(x)[1], grid[:-1][dip], grid[1:][dip]), side[dip]


def _triple(jet: Jet, zero: Zero, grid: Reals, usual: Reals) -> Zero:
    """The zero itself, or the triple zero that it is."""
    if abs(jet(np.array([zero.at]))[1, 0]) > _FLAT * usual[1]:
        return zero
    cell = int(np.clip(np.searchsorted(grid, zero.at) - 1, 0, len(grid) - 2))
    window = _WINDOW * (grid[cell + 1] - grid[cell])
    ends = np.clip(np.array([zero.at - window, zero.at + window]), grid[0], grid[-1])
    last = jet(ends)[2]
    if not last[0] * last[1] < 0:
        return zero
    at = bracketed(lambda x: jet(x)[2], ends[:1], ends[1:])
    value, slope = jet(at)[:2, 0]
    if abs(value) <= _NONE * usual[0] and abs(slope) <= 1e3 * _NONE * usual[1]:
        return Zero(float(at[0]), 3, zero.rises)
    return zero
