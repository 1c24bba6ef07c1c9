"""Closing conditions of joints between bodies: residual, Jacobian, derivatives; Newton's method on them.

A body has the unknowns x, y and angle. A condition joins slot 2c (first element) and slot 2c + 1 (second) of the
scratch arrays; ``owners`` names the body of each slot, -1 for what is known. PIN: the points meet, two equations.
SLIDE: the lines point the same way and lie on one another, two equations. TURN: the second line is turned against the
first by a given angle. PUSH: the second point lies a given way along the first line. RIDE: the second point lies on the
first line. Lengths of the equations are in the unit of the points, angles are multiplied by `size`.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.planar_jets import turned

__all__ = [
    "EQUATIONS",
    "PIN",
    "PUSH",
    "RIDE",
    "SLIDE",
    "TURN",
    "closing",
    "closing_rates",
    "factor",
    "newton",
    "settle",
    "solve_factored",
]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]

PIN, SLIDE, TURN, PUSH, RIDE = range(5)
EQUATIONS = (2, 2, 1, 1, 1)


@njit(cache=True, error_model="numpy", _nrt=False)
def closing(
    kinds: Ints,
    values: Reals,
    owners: Ints,
    points: Complexes,
    lines: Complexes,
    unknowns: Reals,
    size: float,
    residual: Reals,
    jacobian: Reals,
) -> float:
    """Write residual and Jacobian at the unknowns (x, y, angle of each body); returns the largest residual."""
    row = 0
    for c in range(len(kinds)):
        a, b = owners[2 * c], owners[2 * c + 1]
        here, there = points[2 * c, 0], points[2 * c + 1, 0]
        line, other = lines[2 * c], lines[2 * c + 1]
        arm_a = arm_b = 0j
        if a >= 0:
            turn = complex(cos(unknowns[3 * a + 2]), sin(unknowns[3 * a + 2]))
            arm_a, line = turn * here, turn * line
            here = arm_a + complex(unknowns[3 * a], unknowns[3 * a + 1])
        if b >= 0:
            turn = complex(cos(unknowns[3 * b + 2]), sin(unknowns[3 * b + 2]))
            arm_b, other = turn * there, turn * other
            there = arm_b + complex(unknowns[3 * b], unknowns[3 * b + 1])
        gap = there - here
        kind = kinds[c]
        for k in range(row, row + (2 if kind in (PIN, SLIDE) else 1)):
            for m in range(len(unknowns)):
                jacobian[k, m] = 0
        if kind == PIN:
            residual[row], residual[row + 1] = gap.real, gap.imag
            if a >= 0:
                jacobian[row, 3 * a] = jacobian[row + 1, 3 * a + 1] = -1
                jacobian[row, 3 * a + 2], jacobian[row + 1, 3 * a + 2] = arm_a.imag, -arm_a.real
            if b >= 0:
                jacobian[row, 3 * b] = jacobian[row + 1, 3 * b + 1] = 1
                jacobian[row, 3 * b + 2], jacobian[row + 1, 3 * b + 2] = -arm_b.imag, arm_b.real
            row += 2
            continue
        if kind in (SLIDE, TURN):
            turn = line.conjugate() * other
            if kind == TURN:
                turn *= complex(cos(values[c]), -sin(values[c]))
            residual[row] = turn.imag * size
            if a >= 0:
                jacobian[row, 3 * a + 2] -= turn.real * size
            if b >= 0:
                jacobian[row, 3 * b + 2] += turn.real * size
            row += 1
        if kind in (SLIDE, PUSH, RIDE):
            # along: the part of the gap on the line; across: the part normal to it
            measure = line if kind == PUSH else 1j * line
            seen = measure.conjugate() * gap
            residual[row] = seen.real - values[c] if kind == PUSH else seen.real
            if a >= 0:
                jacobian[row, 3 * a] -= measure.real
                jacobian[row, 3 * a + 1] -= measure.imag
                jacobian[row, 3 * a + 2] += seen.imag - (measure.conjugate() * 1j * arm_a).real
            if b >= 0:
                jacobian[row, 3 * b] += measure.real
                jacobian[row, 3 * b + 1] += measure.imag
                jacobian[row, 3 * b + 2] += (measure.conjugate() * 1j * arm_b).real
            row += 1
    largest = 0.0
    for k in range(row):
        if not abs(residual[k]) <= largest:  # so that NaN wins
            largest = abs(residual[k])
    return largest


@njit(cache=True, error_model="numpy", _nrt=False)
def closing_rates(
    order: int,
    kinds: Ints,
    value_rates: Reals,
    owners: Ints,
    points: Complexes,
    lines: Complexes,
    spins: Reals,
    turns: Complexes,
    rates: Reals,
    places: Complexes,
    size: float,
    gap: Complexes,
    target: Reals,
) -> None:
    """Write the right-hand side of ``jacobian @ unknown = target`` for the derivatives of that order.

    ``turns``, ``places`` (derivatives of origins) and ``rates`` are those of the bodies up to order - 1; their entries
    of this order and above are zero. ``gap`` is scratch, four complex numbers.
    ``value_rates[c, order - 1]`` is the derivative of a driven value.
    """
    row = 0
    for c in range(len(kinds)):
        w = a = j = 0.0
        difference = 0.0
        for k in range(4):
            gap[k] = 0j
        line = lines[2 * c]
        for side in range(2):
            slot, sign = 2 * c + side, 2 * side - 1
            body = owners[slot]
            if body < 0:
                for k in range(order + 1):
                    gap[k] += sign * points[slot, k]
                difference += sign * spins[slot, order - 1]
                if side == 0:
                    w, a, j = spins[slot, 0], spins[slot, 1], spins[slot, 2]
                continue
            for k in range(order + 1):
                gap[k] += sign * places[body, k]
                gap[k] += sign * turned(
                    k,
                    turns[body],
                    rates[body, 0],
                    rates[body, 1],
                    rates[body, 2],
                    points[slot, 0],
                    points[slot, 1],
                    points[slot, 2],
                    points[slot, 3],
                )
            difference += sign * spins[slot, order - 1]
            if side == 0:
                line = turns[body] * line
                w = spins[slot, 0] + rates[body, 0]
                a = spins[slot, 1] + rates[body, 1]
                j = spins[slot, 2] + rates[body, 2]
        kind = kinds[c]
        if kind == PIN:
            target[row], target[row + 1] = -gap[order].real, -gap[order].imag
            row += 2
            continue
        if kind in (SLIDE, TURN):
            wanted = value_rates[c, order - 1] if kind == TURN else 0.0
            target[row] = (wanted - difference) * size
            row += 1
        if kind in (SLIDE, PUSH, RIDE):
            seen = turned(order, line.conjugate(), -w, -a, -j, gap[0], gap[1], gap[2], gap[3])
            target[row] = value_rates[c, order - 1] - seen.real if kind == PUSH else -seen.imag
            row += 1


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
def newton(
    kinds: Ints,
    values: Reals,
    owners: Ints,
    points: Complexes,
    lines: Complexes,
    unknowns: Reals,
    size: float,
    residual: Reals,
    jacobian: Reals,
    pivots: Ints,
    most: int,
) -> tuple[int, float]:
    """Newton's method; the unknowns are changed in place. Returns how often it stepped (-1: no convergence) and det.

    It stops when a step is below 1e-9 of `size`: the next would be below rounding (at a singular position, where steps
    only halve, the residual is). The Jacobian is left factored as it was before the last step.
    """
    n = len(unknowns)
    for step in range(most):
        miss = closing(kinds, values, owners, points, lines, unknowns, size, residual, jacobian)
        if not miss < 1e300:
            return -1, 0.0
        determinant = factor(jacobian, n, pivots)
        if determinant == 0:
            return (step, 0.0) if miss < 1e-14 * size else (-1, 0.0)
        solve_factored(jacobian, n, pivots, residual)
        moved = 0.0
        for k in range(n):
            scaled = abs(residual[k]) * (size if k % 3 == 2 else 1.0)
            if not scaled <= moved:
                moved = scaled
        if not moved < 10 * size:
            return -1, 0.0
        for k in range(n):
            unknowns[k] -= residual[k]
        if moved < 1e-9 * size:
            return step + 1, determinant
    return -1, 0.0


@njit(cache=True, error_model="numpy", _nrt=False)
def settle(
    kinds: Ints,
    values: Reals,
    owners: Ints,
    points: Complexes,
    lines: Complexes,
    unknowns: Reals,
    size: float,
    residual: Reals,
    jacobian: Reals,
    normal: Reals,
    pivots: Ints,
) -> None:
    """Close a group near a singular position and leave what its Jacobian does not hold as it is.

    Damped Gauss-Newton steps: directions with a singular value below 1e-6 of the largest hardly change.
    """
    n = len(unknowns)
    for _ in range(4):
        closing(kinds, values, owners, points, lines, unknowns, size, residual, jacobian)
        trace = 0.0
        for i in range(n):
            if i % 3 == 2:
                for k in range(n):
                    jacobian[k, i] /= size
            for k in range(n):
                trace += jacobian[k, i] ** 2
        for i in range(n):
            for m in range(n):
                normal[i, m] = 1e-12 * trace if i == m else 0.0
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
