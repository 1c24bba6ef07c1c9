"""Closing conditions of joints between bodies: residual, Jacobian, derivatives; Newton's method on them.

A body has the unknowns x, y and angle. A condition joins slot 2c (first element) and slot 2c + 1 (second) of the
scratch arrays; ``owners`` names the body of each slot, -1 for what is known; ``values[c]`` holds its five numbers.

- PIN: the points meet, two equations.
- SLIDE: the lines point the same way and lie on one another, two equations.
- RIDE: the second point lies value 2 to the left of the first line.
- REACH: the points lie value 2 apart.
- MESH: value 0 times the first direction plus value 1 times the second, both against the line from point to point, is
  value 2. Values 3 and 4 are these angles near by: they say how often directions have gone round.
- RACK: value 0 times the second direction against the first line, plus value 1 times the way of the second point along
  that line, is value 2. Value 3 is the angle near by.
- TRAIN: value 0 times the angle of the first body plus value 1 times that of the second, both against the angle of body
  number value 3, is value 2; all angles as they stand in the unknowns, 0 for what is known.
- TRAVEL: RACK with the angles as they stand in the unknowns.

Lengths of the equations are in the unit of the points, angles of a SLIDE are multiplied by `size`.
"""

from __future__ import annotations

from math import atan2, cos, floor, pi, sin

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.planar_jets import turned

__all__ = [
    "EQUATIONS",
    "MESH",
    "PIN",
    "RACK",
    "REACH",
    "RIDE",
    "SLIDE",
    "TRAIN",
    "TRAVEL",
    "closing",
    "closing_rates",
    "factor",
    "newton",
    "settle",
    "solve_factored",
    "wound",
]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]

PIN, SLIDE, RIDE, REACH, MESH, RACK, TRAIN, TRAVEL = range(8)
EQUATIONS = (2, 2, 1, 1, 1, 1, 1, 1)


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def wound(direction: complex, near: float) -> float:
    """The angle of a direction, with as many whole turns as bring it next to one near by."""
    angle = atan2(direction.imag, direction.real)
    return float(angle + 2 * pi * floor((near - angle) / (2 * pi) + 0.5))


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
        one, two, value = values[c, 0], values[c, 1], values[c, 2]
        if kind == SLIDE:
            turn = line.conjugate() * other
            residual[row] = turn.imag * size
            if a >= 0:
                jacobian[row, 3 * a + 2] -= turn.real * size
            if b >= 0:
                jacobian[row, 3 * b + 2] += turn.real * size
            row += 1
        # what turns with the bodies counts so much, what the gap moves along `measure` so much
        turn_a, turn_b, measure = 0.0, 0.0, 0j
        if kind in (SLIDE, RIDE):
            measure = 1j * line
            residual[row] = (measure.conjugate() * gap).real - value
            turn_a = (measure.conjugate() * gap).imag
        elif kind == REACH:
            measure = gap / value
            residual[row] = ((gap * gap.conjugate()).real / value - value) / 2
        elif kind == MESH:
            measure = -(one + two) * 1j * gap / (gap * gap.conjugate()).real
            first, second = wound(line * gap.conjugate(), values[c, 3]), wound(other * gap.conjugate(), values[c, 4])
            residual[row] = one * first + two * second - value
            turn_a, turn_b = one, two
        elif kind == TRAIN:
            turn_a, turn_b = one, two
            arm = int(values[c, 3])
            residual[row] = -value
            residual[row] += one * unknowns[3 * a + 2] if a >= 0 else 0.0
            residual[row] += two * unknowns[3 * b + 2] if b >= 0 else 0.0
            if arm >= 0:
                residual[row] -= (one + two) * unknowns[3 * arm + 2]
                jacobian[row, 3 * arm + 2] -= one + two
        else:
            measure = two * line
            if kind == RACK:
                angle = wound(line.conjugate() * other, values[c, 3])
            else:
                angle = (unknowns[3 * b + 2] if b >= 0 else 0.0) - (unknowns[3 * a + 2] if a >= 0 else 0.0)
            residual[row] = one * angle + (measure.conjugate() * gap).real - value
            turn_a, turn_b = (measure.conjugate() * gap).imag - one, one
        if a >= 0:
            jacobian[row, 3 * a] -= measure.real
            jacobian[row, 3 * a + 1] -= measure.imag
            jacobian[row, 3 * a + 2] += turn_a - (measure.conjugate() * 1j * arm_a).real
        if b >= 0:
            jacobian[row, 3 * b] += measure.real
            jacobian[row, 3 * b + 1] += measure.imag
            jacobian[row, 3 * b + 2] += turn_b + (measure.conjugate() * 1j * arm_b).real
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
    values: Reals,
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
    of this order and above are zero. ``gap`` is scratch, four complex numbers. Not for TRAIN and TRAVEL.
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
        if kind == SLIDE:
            target[row] = -difference * size
            row += 1
        one, two = values[c, 0], values[c, 1]
        if kind == REACH:
            target[row] = -_square_rate(order, gap) / (2 * values[c, 2])
        elif kind == MESH:
            spun = one * spins[2 * c, order - 1] + two * spins[2 * c + 1, order - 1]
            target[row] = (one + two) * _bearing_rate(order, gap) - spun
        else:
            seen = turned(order, line.conjugate(), -w, -a, -j, gap[0], gap[1], gap[2], gap[3])
            target[row] = -(one * difference + two * seen.real) if kind == RACK else -seen.imag
        row += 1


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _bearing_rate(order: int, gap: Complexes) -> float:
    """The derivative of that order of the angle of a vector."""
    first = gap[1] / gap[0]
    if order == 1:
        return float(first.imag)
    second = gap[2] / gap[0]
    if order == 2:
        return float((second - first * first).imag)
    return float((gap[3] / gap[0] - 3 * first * second + 2 * first * first * first).imag)


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _square_rate(order: int, gap: Complexes) -> float:
    """The derivative of that order of the squared length of a vector."""
    out = 2 * (gap[0].conjugate() * gap[order]).real
    if order == 2:
        out += 2 * (gap[1].conjugate() * gap[1]).real
    if order == 3:
        out += 6 * (gap[1].conjugate() * gap[2]).real
    return float(out)


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
