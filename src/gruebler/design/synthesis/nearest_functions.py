"""Linkages that follow many pairs as nearly as they can: by least squares of the output, from every start.

docs/theory/synthesis-functions.md, "Nearest linkages".
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Integers, Reals
from gruebler.design.synthesis.coordination import Coordination, CoordinationKind
from gruebler.design.synthesis.freudenstein import EQUATIONS, LEAST_NUMBER, errors_and_slopes, linkage_of_numbers
from gruebler.design.synthesis.start_families import FARTHEST

_STARTS = 72
"""So many starts of the input and of the output are tried, where they are free."""
_WEIGHINGS = 3
_STEPS, _CANDIDATES, _LONG = 40, 96, 1000
"""From every valley of the grid so many steps are taken, then so many of the best are followed to their ends."""
_NO_GAIN = 1e-10
_SAME = 1e-3  # relative: least squares end flat, so that two searches for one linkage end near each other
_LEAST_SLOPE = 1e-2
"""Below this the equation says little of the output, near a dead centre: its rows are not weighed higher."""


class _Valleys(NamedTuple):
    """Linkages by (rows, 5) their numbers, and (rows,) the branch of each."""

    numbers: Reals
    sides: Integers


def nearest_linkages(
    kind: CoordinationKind,
    phi: Reals,
    output: Reals,
    *,
    start_input: bool = False,
    start_output: bool = False,
    number: int = 8,
) -> list[Coordination]:
    """Local optima of least squares for pairs of any number, the nearest first; their starts are those of the first.

    Args:
        kind: four-bars or slider-cranks.
        phi: (pairs,) crank angles in radians.
        output: (pairs,) angles in radians or travels.
        start_input: the crank angles are counted from the line of the frame; else only their differences count.
        start_output: the same of the outputs.
        number: at most so many.

    A valley narrower than the grid of 72 starts of each side can be missed. Cost: 0.3 s.

    >>> from gruebler.design.synthesis.coordination import KINDS
    >>> turned = np.linspace(0, 1, 12)
    >>> best = nearest_linkages(KINDS[0], turned, turned**2)[0]
    >>> best.kind, len(best.lengths)
    ('four-bar', 4)
    """
    unit = float(np.ptp(output)) or 1.0 if kind.output == "travel" else 1.0
    phi, wanted = np.asarray(phi, np.float64), np.asarray(output, np.float64) / unit
    first = phi[0], wanted[0]
    places = (np.arange(_STARTS) + 0.5) / _STARTS
    inputs = np.array([phi[0]]) if start_input else np.pi * places  # half a turn on: the start of a negative crank
    begins = np.pi * places if kind.output == "angle" else np.sinh(FARTHEST * (2 * places - 1))
    if start_output:
        begins = wanted[:1]
    turned, moved = phi - first[0], wanted - first[1]
    valleys = _valleys(kind, inputs, begins, turned, moved)
    free = np.array([0, 1, 2] + [3] * (not start_input) + [4] * (not start_output))
    numbers, misfit = _least_squares(kind, valleys, free, turned, moved, steps=_STEPS)
    best = np.argsort(misfit)[:_CANDIDATES]
    valleys = _Valleys(numbers[best], valleys.sides[best])
    numbers, misfit = _least_squares(kind, valleys, free, turned, moved, steps=_LONG)
    linkages: list[Coordination] = []
    for k in np.argsort(misfit):
        linkage = linkage_of_numbers(kind, numbers[k], int(valleys.sides[k]), unit)
        if linkage is None or not np.isfinite(misfit[k]) or any(linkage.is_near(other, _SAME) for other in linkages):
            continue
        linkages.append(linkage)
        if len(linkages) == number:
            break
    return linkages


def _valleys(kind: CoordinationKind, inputs: Reals, begins: Reals, turned: Reals, moved: Reals) -> _Valleys:
    """Where among its neighbours on the grid of starts the linkage of the linear condition misses least."""
    equation = EQUATIONS[kind.name]
    starts = np.stack(np.meshgrid(inputs, begins, indexing="ij"), axis=-1)
    phi, wanted = starts[..., :1] + turned, starts[..., 1:] + moved
    columns = kind.columns(phi, wanted)
    weights = np.ones_like(phi)
    for _ in range(_WEIGHINGS):
        weighed = np.swapaxes(columns[..., :-1] * weights[..., None], -1, -2)
        matrix = weighed @ columns[..., :-1]
        matrix += 1e-13 * np.trace(matrix, axis1=-2, axis2=-1)[..., None, None] * np.eye(3)
        factors = np.linalg.solve(matrix, weighed @ columns[..., -1:])[..., 0]
        apart = np.asarray(np.moveaxis(factors, -1, 0)[..., None], np.float64)
        _, by_output = equation.derivatives(apart, phi, wanted)
        weights = 1 / np.maximum(by_output**2, _LEAST_SLOPE**2)
    numbers, sides = [], []
    for side in (1, -1):
        with np.errstate(all="ignore"):
            errors = equation.outputs(apart, phi, wanted, side) - wanted
        misfit = np.nan_to_num((errors**2).sum(axis=-1), nan=np.inf)
        around = np.pad(misfit, 1, mode="wrap" if kind.output == "angle" else "edge")
        high, wide = misfit.shape
        shifts = [(i, j) for i in range(3) for j in range(3)]
        least = np.min([around[i : i + high, j : j + wide] for i, j in shifts], axis=0)
        at = np.nonzero(np.isfinite(misfit) & (misfit <= least))
        numbers.append(np.hstack([factors[at], starts[at]]))
        sides += [side] * len(at[0])
    return _Valleys(np.vstack(numbers), np.array(sides, np.int64))


def _least_squares(
    kind: CoordinationKind, valleys: _Valleys, free: Integers, turned: Reals, moved: Reals, *, steps: int
) -> tuple[Reals, Reals]:
    """Levenberg and Marquardt's steps for all at once: the numbers, and (rows,) the sums of squares."""

    def at(numbers: Reals, sides: Integers) -> tuple[Reals, Reals, Reals]:
        phi, wanted = numbers[:, 3:4] + turned, numbers[:, 4:] + moved
        errors, slopes = errors_and_slopes(kind, sides[:, None], numbers, phi, wanted)
        usable = np.isfinite(errors).all(axis=1) & np.isfinite(slopes).all(axis=(1, 2))
        return errors, slopes[..., free], np.where(usable, (errors**2).sum(axis=1), np.inf)

    numbers = valleys.numbers.copy()
    errors, slopes, sums = at(numbers, valleys.sides)
    damping = np.full(len(sums), 1e-3)
    going = np.flatnonzero(np.isfinite(sums))
    for _ in range(steps):
        scale = np.maximum(np.abs(numbers[going][:, free]), LEAST_NUMBER)
        rows = slopes[going] * scale[:, None]
        square = np.swapaxes(rows, 1, 2) @ rows
        own = np.diagonal(square, axis1=1, axis2=2)
        own = damping[going, None] * np.maximum(own, 1e-12 * own.max(axis=1, keepdims=True)) + 1e-300
        right = np.swapaxes(rows, 1, 2) @ errors[going][..., None]
        trial = numbers[going]
        trial[:, free] -= scale * np.linalg.solve(square + own[:, None] * np.eye(len(free)), right)[..., 0]
        trial_errors, trial_slopes, trial_sums = at(trial, valleys.sides[going])
        better = trial_sums < sums[going]
        gaining = sums[going] - trial_sums > _NO_GAIN * sums[going]
        kept = going[better]
        numbers[kept], errors[kept], slopes[kept] = trial[better], trial_errors[better], trial_slopes[better]
        sums[kept] = trial_sums[better]
        damping[going] = np.clip(np.where(better, damping[going] / 8, damping[going] * 4), 1e-15, None)
        going = going[np.where(better, gaining, damping[going] < 1)]
        if not len(going):
            break
    return numbers, sums
