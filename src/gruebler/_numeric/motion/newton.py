"""Newton's method on closing conditions, and the linear equations that it needs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.motion.closure import Conditions, closing

Reals = NDArray[np.float64]
Ints = NDArray[np.int64]

_ARRIVED = 1e-9  # of the size: the step behind one so small is below rounding, since each squares the error
_CLOSED = 1e-14  # of the size: an equation that misses by less, some ten roundings, is satisfied
_ASTRAY = 10.0  # sizes: a step that long leads away from every position
_FINITE = 1e300  # a residual that is larger, or NaN, comes of an overflow
_DAMPING = 1e-12  # of the sum of squares of the Jacobian: holds directions with a singular value below its root, 1e-6
_DAMPED_STEPS = 4  # each squares the error, from that of an extrapolation (some 1e-2) down to rounding


class NewtonScratch(NamedTuple):
    """The linear equations of a step, for n unknowns."""

    residual: Reals
    """(n,)"""
    jacobian: Reals
    """(n, n)"""
    normal: Reals
    """(n, n) the matrix of the damped normal equations."""
    pivots: Ints
    """(n,) the row exchanges of `factor`."""


def new_newton_scratch(unknowns: int) -> NewtonScratch:
    n = unknowns
    return NewtonScratch(np.zeros(n), np.zeros((n, n)), np.zeros((n, n)), np.zeros(n, np.int64))


@njit(cache=True, error_model="numpy", _nrt=False)
def factor(matrix: Reals, n: int, pivots: Ints) -> float:
    """LU factors in place, with partial pivoting; returns the determinant."""
    determinant = 1.0
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[best, k]):
                best = i
        pivots[k] = best
        if best != k:
            determinant = -determinant
            for m in range(n):
                matrix[k, m], matrix[best, m] = matrix[best, m], matrix[k, m]
        pivot = matrix[k, k]
        determinant *= pivot
        if pivot == 0:
            return 0.0
        for i in range(k + 1, n):
            if matrix[i, k] != 0:
                share = matrix[i, k] / pivot
                matrix[i, k] = share
                for m in range(k + 1, n):
                    matrix[i, m] -= share * matrix[k, m]
    return determinant


@njit(cache=True, error_model="numpy", _nrt=False)
def solve_factored(matrix: Reals, n: int, pivots: Ints, target: Reals) -> None:
    """Solve in place with the factors of `factor`."""
    for k in range(n):
        best = pivots[k]
        if best != k:
            target[k], target[best] = target[best], target[k]
    for k in range(n):
        for i in range(k + 1, n):
            target[i] -= matrix[i, k] * target[k]
    for k in range(n - 1, -1, -1):
        for m in range(k + 1, n):
            target[k] -= matrix[k, m] * target[m]
        target[k] /= matrix[k, k]


@njit(cache=True, error_model="numpy", _nrt=False)
def newton(conditions: Conditions, unknowns: Reals, steps: int, scratch: NewtonScratch) -> tuple[int, float]:
    """Newton's method; the unknowns are changed in place. Returns how often it stepped (-1: no convergence) and det.

    It stops when a step is so small that the next would be below rounding (at a singular position, where steps only
    halve, the residual is). The Jacobian is left factored as it was before the last step.
    """
    residual, jacobian, pivots = scratch.residual, scratch.jacobian, scratch.pivots
    n, size = len(unknowns), conditions.size
    for step in range(steps):
        miss = closing(conditions, unknowns, residual, jacobian)
        if not miss < _FINITE:
            return -1, 0.0
        determinant = factor(jacobian, n, pivots)
        if determinant == 0:
            return (step, 0.0) if miss < _CLOSED * size else (-1, 0.0)
        solve_factored(jacobian, n, pivots, residual)
        moved = 0.0
        for k in range(n):
            scaled = abs(residual[k]) * (size if k % 3 == 2 else 1.0)
            if not scaled <= moved:
                moved = scaled
        if not moved < _ASTRAY * size:
            return -1, 0.0
        for k in range(n):
            unknowns[k] -= residual[k]
        if moved < _ARRIVED * size:
            return step + 1, determinant
    return -1, 0.0


@njit(cache=True, error_model="numpy", _nrt=False)
def close_near_singular(conditions: Conditions, unknowns: Reals, scratch: NewtonScratch) -> None:
    """Close a group near a singular position and leave what its Jacobian does not hold as it is.

    Damped Gauss-Newton steps: directions with a singular value below 1e-6 of the largest hardly change.
    """
    residual, jacobian, normal, pivots = scratch.residual, scratch.jacobian, scratch.normal, scratch.pivots
    n, size = len(unknowns), conditions.size
    for _ in range(_DAMPED_STEPS):
        closing(conditions, unknowns, residual, jacobian)
        trace = 0.0
        for i in range(n):
            if i % 3 == 2:
                for k in range(n):
                    jacobian[k, i] /= size
            for k in range(n):
                trace += jacobian[k, i] ** 2
        for i in range(n):
            for m in range(n):
                normal[i, m] = _DAMPING * trace if i == m else 0.0
                for k in range(n):
                    normal[i, m] += jacobian[k, i] * jacobian[k, m]
        for i in range(n):
            jacobian[0, i] = jacobian[0, i] * residual[0]
            for k in range(1, n):
                jacobian[0, i] += jacobian[k, i] * residual[k]
        factor(normal, n, pivots)
        solve_factored(normal, n, pivots, jacobian[0])
        for i in range(n):
            unknowns[i] -= jacobian[0, i] / (size if i % 3 == 2 else 1.0)
