"""Zeros of functions of one variable that come with derivatives: brackets from samples, then roots to rounding.

No sign of a rounding error counts: a sample below `_NONE` of the usual size of the function has no sign, and brackets
lie between samples that have one. Definitions and errors: docs/theory/events.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import groupby, pairwise
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value

Jet = Callable[[Reals], Reals]
"""From (n,) places to (derivatives, n): the function, and as many of its derivatives as are known."""

_NONE = 1e-9  # of the usual size: a value below is taken for none; rounding reaches some 1e-12
_FLAT = 1e-4  # a slope below this part of the usual one asks whether the zero is a multiple one
_JUMP = 1e-4  # of the usual size or of that beside it: a change of sign with larger values is a jump; next to change
# points 1e-6 is rounding
_WINDOW = 0.1  # of a cell: how far from such a zero that of the last derivative may lie
_EDGE = 0.01  # of a part between joints: so far from both at most, however short it is
_INSIDE = 9  # places within each part between joints, besides those of the grid
_BESIDE = 1e-9  # of the whole width: how far from a joint its two sides are looked at; joints are known to some 1e-15


class Zero(NamedTuple):
    """A zero of a function."""

    at: float
    multiplicity: int
    """1: it crosses zero; 2: it touches; 3: it crosses with a horizontal tangent."""
    rises: bool
    """Whether the function is larger behind it than before (for 2: whether it touches from below)."""


def bracketed_root(function: Callable[[Reals], Reals], low: Reals, high: Reals) -> Reals:
    """One zero in each bracket: Chandrupatla's method (inverse quadratic steps, else bisection), all at once.

    Args:
        function: from (k,) to (k,) values.
        low: (k,) ends of brackets.
        high: (k,) other ends, where the function has the other sign.

    Error: a few roundings of the place, if the function's own are no larger. Cost: some 8 calls.

    >>> bracketed_root(lambda x: x**2 - 2, np.array([0.0]), np.array([2.0])).round(12).tolist()
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
    root: Reals = np.where(fa == 0, a, np.where(fb == 0, b, least))
    return root


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class FunctionSamples:
    """Where a function is sampled, and where it is not smooth."""

    grid: Reals
    """Places in rising order; with a period the first comes once more at the end."""
    joints: tuple[float, ...] = ()
    """Places where the function or its derivatives may jump, in rising order."""
    period: float | None = None
    """After how much the function repeats; None if it does not."""
    noise: tuple[float, ...] = ()
    """For each row of the jet the part of its usual size below which it is taken for none; else `_NONE`."""
    ends: bool = False
    """Whether zeros at the first and the last place count; with a period there are no ends."""


class _SmoothPart(NamedTuple):
    """A stretch between joints with samples of a function: places and rows of its jet."""

    low: float
    high: float
    at: Reals
    rows: Reals

    @property
    def usual(self) -> float:
        """The usual size of the function."""
        return float(np.quantile(np.abs(self.rows[0]), 0.9))


def find_zeros(jet: Jet, samples: FunctionSamples | Reals, least: float = 0.0) -> tuple[Zero, ...]:
    """All zeros between the first and the last place of a grid, in order, each once in a period.

    Between neighbours of the grid a crossing is seen by the sign; if the first derivative is known, so are two
    crossings or a touch, by the extremum between them. With the second derivative a triple zero is found to rounding
    as the zero of that derivative. A sign that changes by a jump at a joint is a zero there, any other jump is none.
    A stretch between joints on which the function vanishes has no zeros, nor has a function that is not larger than
    `least` over nine tenths of every stretch.

    >>> [(round(zero.at, 9), zero.multiplicity) for zero in find_zeros(lambda x: np.stack([x**3, 3 * x**2, 6 * x]),
    ...     np.linspace(-1, 1.1, 20))]
    [(0.0, 3)]
    """
    samples = samples if isinstance(samples, FunctionSamples) else FunctionSamples(grid=samples)
    jet = _repeated(jet, samples)
    zeros: list[Zero] = []
    parts = _parts(jet, samples)
    gone = _vanishing(parts, samples, least)
    if all(gone):
        return ()
    usual = _usual([part for part, without in zip(parts, gone, strict=True) if not without])
    for stretch in _runs(parts, gone, False, samples.period):
        whole = len(stretch) == len(parts) and samples.period is not None
        zeros += _zeros_of(jet, stretch, samples, usual, samples.period if whole else None)
    return tuple(sorted(zeros))


def sample_function(jet: Jet, samples: FunctionSamples) -> list[Reals]:
    """The rows of a function on each stretch between joints; (derivatives, places) each."""
    return [part.rows for part in _parts(_repeated(jet, samples), samples)]


def vanishing(jet: Jet, samples: FunctionSamples, least: float = 0.0) -> tuple[tuple[float, float], ...]:
    """The stretches from joint to joint on which a function vanishes, if it does not vanish everywhere.

    A function that is analytic between its joints vanishes between two of them if it does so on a part of that
    stretch, however short; so its samples decide.
    """
    parts = _parts(_repeated(jet, samples), samples)
    gone = _vanishing(parts, samples, least)
    return () if all(gone) else tuple((run[0].low, run[-1].high) for run in _runs(parts, gone, True, samples.period))


def _repeated(jet: Jet, samples: FunctionSamples) -> Jet:
    """The same function, asked within one period only."""
    start, period = samples.grid[0], samples.period
    return jet if period is None else lambda x: jet(start + (x - start) % period)


def _parts(jet: Jet, samples: FunctionSamples) -> list[_SmoothPart]:
    """The stretches between joints, with samples at both ends of each; with a period beginning at the first joint."""
    grid, joints, period = samples.grid, np.array(samples.joints), samples.period
    if not len(joints):
        return [_SmoothPart(float(grid[0]), float(grid[-1]), grid, jet(grid))]
    if period is not None:
        bounds = np.append(joints, joints[0] + period)
        grid = np.sort(joints[0] + (grid[:-1] - joints[0]) % period)
    else:
        bounds = np.concatenate([grid[:1], joints[(joints > grid[0]) & (joints < grid[-1])], grid[-1:]])
    beside = _BESIDE * (bounds[-1] - bounds[0])
    inner = (1 - np.cos(np.pi * (np.arange(_INSIDE) + 0.5) / _INSIDE)) / 2
    places = []
    for low, high in pairwise(bounds):
        edge = min(beside, _EDGE * (high - low))
        low, high = low + edge, high - edge  # noqa: PLW2901
        own = grid[(grid > low) & (grid < high)]
        places.append(np.unique(np.concatenate([[low], low + (high - low) * inner, own, [high]])))
    rows = np.split(jet(np.concatenate(places)), np.cumsum([len(at) for at in places])[:-1], axis=1)
    return [
        _SmoothPart(float(low), float(high), at, part)
        for low, high, at, part in zip(bounds[:-1], bounds[1:], places, rows, strict=True)
    ]


def _usual(parts: list[_SmoothPart]) -> Reals:
    """What a function and each derivative exceed on a tenth of these parts.

    Samples count by the width they stand for: towards a limit, where derivatives grow without bound, they are dense.
    """
    width = np.concatenate([np.gradient(part.at) for part in parts])
    rows = np.abs(np.concatenate([part.rows for part in parts], axis=1))
    order = np.argsort(rows, axis=1, kind="stable")
    below = np.cumsum(width[order], axis=1)
    at = np.argmax(below >= 0.9 * below[:, -1:], axis=1)
    return np.asarray(np.take_along_axis(rows, np.take_along_axis(order, at[:, None], axis=1), axis=1)[:, 0])


def _noise(samples: FunctionSamples, row: int) -> float:
    return samples.noise[row] if row < len(samples.noise) else _NONE


def _vanishing(parts: list[_SmoothPart], samples: FunctionSamples, least: float) -> list[bool]:
    size = max(part.usual for part in parts)
    return [not part.usual > max(least, _noise(samples, 0) * size) for part in parts]


def _runs(parts: list[_SmoothPart], marks: list[bool], mark: bool, period: float | None) -> Iterator[list[_SmoothPart]]:
    """The runs of parts with a mark; with a period one that goes over its end is not cut there."""
    if period is not None and len(set(marks)) > 1:
        first = next(k for k in range(len(parts)) if marks[k - 1] != marks[k])
        later = [
            part._replace(low=part.low + period, high=part.high + period, at=part.at + period) for part in parts[:first]
        ]
        parts, marks = parts[first:] + later, marks[first:] + marks[:first]
    for key, run in groupby(zip(parts, marks, strict=True), key=lambda pair: pair[1]):
        if key == mark:
            yield [part for part, _ in run]


def _zeros_of(
    jet: Jet, stretch: list[_SmoothPart], samples: FunctionSamples, usual: Reals, period: float | None
) -> list[Zero]:
    """The zeros within parts that follow one another; with a period they are followed by themselves."""
    at, rows = np.concatenate([part.at for part in stretch]), np.concatenate([part.rows for part in stretch], axis=1)
    joints = np.array([part.low for part in stretch[1:]])
    if period is not None:
        if not samples.joints:  # then the first place comes once more at the end
            at, rows = at[:-1], rows[:, :-1]
        else:
            joints = np.concatenate([joints, [stretch[0].low + period], joints + period])
        first = int(np.argmax(np.abs(rows[0])))  # far from every zero
        at = np.concatenate([at[first:], at[: first + 1] + period])
        rows = np.concatenate([rows[:, first:], rows[:, : first + 1]], axis=1)
    signed = np.abs(rows[0]) > _noise(samples, 0) * usual[0]
    ends = [k for k in (0, -1) if samples.ends and period is None and not signed[k]]
    at_ends = [Zero(float(at[k]), 1, bool(rows[0][signed][k] > 0) == (k == 0)) for k in ends]
    at, rows = at[signed], rows[:, signed]
    side = np.sign(rows[0])
    cross = side[:-1] * side[1:] < 0
    low, high = [at[:-1][cross]], [at[1:][cross]]
    touching: list[Zero] = []
    if len(rows) > 1:
        dips, sides = _dips(jet, at, rows)
        value = jet(dips)[0] if len(dips) else dips
        none = np.abs(value) <= _noise(samples, 0) * usual[0]
        touching = [Zero(float(x), 2, bool(side < 0)) for x, side in zip(dips[none], sides[none], strict=True)]
        through = ~none & (np.sign(value) != sides)
        cells = np.searchsorted(at, dips[through]) - 1
        low += [at[cells], dips[through]]
        high += [dips[through], at[cells + 1]]
    left, right = np.concatenate(low), np.concatenate(high)
    count = np.searchsorted(joints, right) - np.searchsorted(joints, left)
    smooth = count == 0
    crossing = _crossings(jet, left[smooth], right[smooth], usual[0])
    if len(rows) > 2:
        crossing = [_triple(jet, zero, at, usual) for zero in crossing]
    return (
        at_ends
        + touching
        + crossing
        + [
            _at_joint(jet, joints[(joints > a) & (joints < b)], a, b, samples, usual)
            for a, b in zip(left[~smooth], right[~smooth], strict=True)
        ]
    )


def _at_joint(jet: Jet, joints: Reals, low: float, high: float, samples: FunctionSamples, usual: Reals) -> Zero:
    """The zero at a joint, the middle one of several between which the function vanishes."""
    at = float(joints[0] + joints[-1]) / 2
    edge = min(_BESIDE * float(samples.grid[-1] - samples.grid[0]), (high - low) / 4)
    sides = jet(np.array([joints[0] - edge, joints[-1] + edge]))
    flat = np.abs(sides[0]).max() <= _noise(samples, 0) * usual[0]
    if len(sides) > 1:
        flat = flat and np.abs(sides[1]).max() <= _FLAT * usual[1]
    return Zero(at, 3 if flat and len(sides) > 1 else 1, bool(jet(np.array([high]))[0, 0] > 0))


def _crossings(jet: Jet, left: Reals, right: Reals, usual: float) -> list[Zero]:
    """The zeros in brackets, but no jumps."""
    if not len(left):
        return []
    before, behind = jet(left)[0], jet(right)[0]
    roots, rises = bracketed_root(lambda x: jet(x)[0], left, right), before < 0
    size = np.maximum(usual, np.maximum(np.abs(before), np.abs(behind)))  # a steep function is large near by
    near = np.abs(jet(roots)[0]) <= _JUMP * size
    return [Zero(float(x), 1, bool(up)) for x, up in zip(roots[near], rises[near], strict=True)]


def _dips(jet: Jet, grid: Reals, rows: Reals) -> tuple[Reals, Reals]:
    """Where the function comes nearest to zero between two places of one sign; and that sign."""
    side = np.sign(rows[0][:-1])
    dip = (side == np.sign(rows[0][1:])) & (side * rows[1][:-1] < 0) & (side * rows[1][1:] >= 0)
    if not dip.any():
        return np.empty(0), np.empty(0)
    return bracketed_root(lambda x: jet(x)[1], grid[:-1][dip], grid[1:][dip]), side[dip]


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
    at = bracketed_root(lambda x: jet(x)[2], ends[:1], ends[1:])
    value, slope = jet(at)[:2, 0]
    if abs(value) <= _NONE * usual[0] and abs(slope) <= 1e3 * _NONE * usual[1]:
        return Zero(float(at[0]), 3, zero.rises)
    return zero
