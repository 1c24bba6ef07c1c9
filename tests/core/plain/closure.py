"""Closing conditions of joints between bodies: residual and Jacobian.

A body has the unknowns x, y and angle. Condition c joins the elements in slots 2c (the first) and 2c + 1 (the second);
it has eight numbers, `Conditions.values`.

- PIN: the points meet, two equations.
- SLIDE: the lines point the same way and lie on one another, two equations.
- RIDE: the second point lies value 2 to the left of the first line.
- REACH: the points lie value 2 apart.
- MESH: value 0 times the first direction plus value 1 times the second, both against the line from point to point, is
  value 2. Values 3 and 4 are these angles near by: they say how often directions have gone round. With a
  `evaluate_law` the first angle is replaced by its function.
- RACK: value 0 times the second direction against the first line, plus value 1 times the way of the second point along
  that line, is value 2. Value 3 is the angle near by.
- POLAR: the second point lies on a curve about the first: seen from the first direction, the logarithm of its distance
  is the `evaluate_law` of its angle. Value 0 is a length.
- FACE: the first line touches a curve about the second point: its distance from the point is the `evaluate_law` of the
  angle of the outward normal against the second direction; value 1 is 1 if the point lies to the left of the line,
  else -1.
- TRAIN: value 0 times the angle of the first body plus value 1 times that of the second, both against the angle of body
  number value 3, is value 2; all angles as they stand in the unknowns, 0 for what is known. With a `evaluate_law` the
  first angle plus value 4 is replaced by its function.
- TRAVEL: RACK with the angles as they stand in the unknowns.

Lengths of the equations are in the unit of the points, angles of a SLIDE are multiplied by `Conditions.size`.
"""

from __future__ import annotations

from math import atan2, cos, floor, inf, log, pi, sin

import numpy as np
from numpy.typing import NDArray

from gruebler.mechanics.kinematics.kernel_records import (
    FACE,
    MESH,
    PIN,
    POLAR,
    RACK,
    REACH,
    RIDE,
    SLIDE,
    TRAIN,
    Conditions,
)

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]


def unwound_angle(direction: complex, near: float) -> float:
    """The angle of a direction, with as many whole turns as bring it next to one near by."""
    angle = atan2(direction.imag, direction.real)
    return float(angle + 2 * pi * floor((near - angle) / (2 * pi) + 0.5))


def _divided(z: complex, by: float) -> complex:
    """NumPy multiplies by 1 / by where Python and the compiler divide: so the parts are divided here."""
    return complex(z.real / by, z.imag / by)


def evaluate_law(pieces: Reals, values: Reals, angle: float) -> tuple[float, float, float, float]:
    """A function of an angle and its three derivatives; without pieces the angle itself.

    ``values`` of the condition: 5 the first of its pieces, 6 how many, 7 what it grows by in a turn. A piece has its
    middle, half its width, and the coefficients of a polynomial on [-1, 1].
    """
    first, count = int(values[5]), int(values[6])
    if count == 0:
        return angle, 1.0, 0.0, 0.0
    turns = floor((angle - pieces[first, 0] + pieces[first, 1]) / (2 * pi))
    place = angle - 2 * pi * turns
    low, high = first, first + count - 1
    while low < high:
        middle = (low + high + 1) // 2
        if place >= pieces[middle, 0] - pieces[middle, 1]:
            low = middle
        else:
            high = middle - 1
    half = pieces[low, 1]
    u = (place - pieces[low, 0]) / half
    f0 = f1 = f2 = f3 = 0.0
    for k in range(pieces.shape[1] - 1, 1, -1):
        f3 = f3 * u + 3 * f2
        f2 = f2 * u + 2 * f1
        f1 = f1 * u + f0
        f0 = f0 * u + pieces[low, k]
    return f0 + turns * values[7], f1 / half, f2 / (half * half), f3 / (half * half * half)


def closing(conditions: Conditions, unknowns: Reals, residual: Reals, jacobian: Reals) -> float:
    """Write residual and Jacobian at the unknowns (x, y, angle of each body); returns the largest residual."""
    kinds, values, pieces, owners = conditions.kinds, conditions.values, conditions.pieces, conditions.owners
    points, lines, size = conditions.points, conditions.lines, conditions.size
    row = 0
    for c in range(len(kinds)):
        a, b = owners[2 * c], owners[2 * c + 1]
        point_a, point_b = points[2 * c, 0], points[2 * c + 1, 0]
        line_a, line_b = lines[2 * c], lines[2 * c + 1]
        arm_a = arm_b = 0j
        if a >= 0:
            turn = complex(cos(unknowns[3 * a + 2]), sin(unknowns[3 * a + 2]))
            arm_a, line_a = turn * point_a, turn * line_a
            point_a = arm_a + complex(unknowns[3 * a], unknowns[3 * a + 1])
        if b >= 0:
            turn = complex(cos(unknowns[3 * b + 2]), sin(unknowns[3 * b + 2]))
            arm_b, line_b = turn * point_b, turn * line_b
            point_b = arm_b + complex(unknowns[3 * b], unknowns[3 * b + 1])
        gap = point_b - point_a
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
        factor_a, factor_b, value = values[c, 0], values[c, 1], values[c, 2]
        if kind == SLIDE:
            turn = line_a.conjugate() * line_b
            residual[row] = turn.imag * size
            if a >= 0:
                jacobian[row, 3 * a + 2] -= turn.real * size
            if b >= 0:
                jacobian[row, 3 * b + 2] += turn.real * size
            row += 1
        # what turns with the bodies counts so much, what the gap moves along `measure` so much
        turn_a, turn_b, measure = 0.0, 0.0, 0j
        if kind in (SLIDE, RIDE):
            measure = 1j * line_a
            residual[row] = (measure.conjugate() * gap).real - value
            turn_a = (measure.conjugate() * gap).imag
        elif kind == REACH:
            measure = _divided(gap, value)
            residual[row] = ((gap * gap.conjugate()).real / value - value) / 2
        elif kind == MESH:
            first, second = (
                unwound_angle(line_a * gap.conjugate(), values[c, 3]),
                unwound_angle(line_b * gap.conjugate(), values[c, 4]),
            )
            first, slope, _, _ = evaluate_law(pieces, values[c], first)
            residual[row] = factor_a * first + factor_b * second - value
            turn_a, turn_b = factor_a * slope, factor_b
            measure = _divided(-(turn_a + factor_b) * 1j * gap, (gap * gap.conjugate()).real)
        elif kind == POLAR:
            seen = line_a.conjugate() * gap
            radius, slope, _, _ = evaluate_law(pieces, values[c], unwound_angle(seen, 0.0))
            square = (seen * seen.conjugate()).real
            residual[row] = factor_a * ((log(square) / 2 if square > 0 else -inf) - radius)
            measure = _divided(factor_a * (1 - 1j * slope) * gap, (gap * gap.conjugate()).real)
            turn_a = factor_a * slope
        elif kind == FACE:
            measure = factor_b * 1j * line_a
            height, slope, _, _ = evaluate_law(pieces, values[c], unwound_angle(-measure * line_b.conjugate(), 0.0))
            residual[row] = (measure.conjugate() * gap).real - height
            turn_a, turn_b = (measure.conjugate() * gap).imag - slope, slope
        elif kind == TRAIN:
            arm = int(values[c, 3])
            line_of_centres = unknowns[3 * arm + 2] if arm >= 0 else 0.0
            first = (unknowns[3 * a + 2] if a >= 0 else 0.0) - line_of_centres
            second = (unknowns[3 * b + 2] if b >= 0 else 0.0) - line_of_centres
            first, slope, _, _ = evaluate_law(pieces, values[c], first + values[c, 4])
            residual[row] = factor_a * first + factor_b * second - value
            turn_a, turn_b = factor_a * slope, factor_b
            if arm >= 0:
                jacobian[row, 3 * arm + 2] -= turn_a + factor_b
        else:
            measure = factor_b * line_a
            if kind == RACK:
                angle = unwound_angle(line_a.conjugate() * line_b, values[c, 3])
            else:
                angle = (unknowns[3 * b + 2] if b >= 0 else 0.0) - (unknowns[3 * a + 2] if a >= 0 else 0.0)
            residual[row] = factor_a * angle + (measure.conjugate() * gap).real - value
            turn_a, turn_b = (measure.conjugate() * gap).imag - factor_a, factor_a
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
