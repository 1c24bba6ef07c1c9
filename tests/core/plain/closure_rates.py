"""Derivatives of closing conditions: what is known of them beside the Jacobian times the unknown rates."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.mechanics.kinematics.kernel_records import FACE, MESH, PIN, POLAR, RACK, REACH, SLIDE, Conditions
from tests.core.plain.closure import evaluate_law, unwound_angle
from tests.core.plain.planar_jets import BodyJets, rotated_derivative

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]


class RateScratch(NamedTuple):
    """What `closing_rates` works in, for one condition after another."""

    gap: Complexes
    """(4,) the jet of the vector from the first point to the second."""
    spins: Reals
    """(2, 3) the rates of both directions, the bodies' own rates included."""


def closing_rates(order: int, conditions: Conditions, bodies: BodyJets, scratch: RateScratch, target: Reals) -> None:
    """Write the right-hand side of ``jacobian @ unknown = target`` for the derivatives of that order.

    The jets of the bodies are known up to order - 1; their entries of this order and above are zero. Not for TRAIN and
    TRAVEL.
    """
    kinds, values, pieces, owners = conditions.kinds, conditions.values, conditions.pieces, conditions.owners
    points, lines, spins = conditions.points, conditions.lines, conditions.spins
    turns, rates, places, size = bodies.turns, bodies.rates, bodies.places, conditions.size
    gap, spins_of_sides = scratch.gap, scratch.spins
    row = 0
    for c in range(len(kinds)):
        for k in range(4):
            gap[k] = 0j
        line_a, line_b = lines[2 * c], lines[2 * c + 1]
        for side in range(2):
            slot, sign = 2 * c + side, 2 * side - 1
            body = owners[slot]
            for k in range(3):
                spins_of_sides[side, k] = spins[slot, k]
            if body < 0:
                for k in range(order + 1):
                    gap[k] += sign * points[slot, k]
                continue
            for k in range(order + 1):
                gap[k] += sign * places[body, k]
                gap[k] += sign * rotated_derivative(
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
            for k in range(3):
                spins_of_sides[side, k] += rates[body, k]
            if side == 0:
                line_a = turns[body] * line_a
            else:
                line_b = turns[body] * line_b
        w, a, j = spins_of_sides[0, 0], spins_of_sides[0, 1], spins_of_sides[0, 2]
        difference = spins_of_sides[1, order - 1] - spins_of_sides[0, order - 1]
        kind = kinds[c]
        if kind == PIN:
            target[row], target[row + 1] = -gap[order].real, -gap[order].imag
            row += 2
            continue
        if kind == SLIDE:
            target[row] = -difference * size
            row += 1
        factor_a, factor_b = values[c, 0], values[c, 1]
        first, second = 1.0, 0.0  # the angle on which a law depends: its rates are those of a logarithm less a spin
        if kind == REACH:
            target[row] = -_square_rate(order, gap) / (2 * values[c, 2])
            row += 1
            continue
        if kind in (MESH, POLAR):
            first, second = _log_rate(1, gap).imag, _log_rate(2, gap).imag if order > 2 else 0.0
            first, second = first - w, second - a
        elif kind == FACE:
            first, second = w - spins_of_sides[1, 0], a - spins_of_sides[1, 1]
        bent, slope = 0.0, 1.0
        if values[c, 6] > 0 or kind == MESH:
            angle = 0.0
            if kind == MESH:
                angle, first, second = unwound_angle(line_a * gap[0].conjugate(), values[c, 3]), -first, -second
            elif kind == POLAR:
                angle = unwound_angle(line_a.conjugate() * gap[0], 0.0)
            else:
                angle = unwound_angle(-values[c, 1] * 1j * line_a * line_b.conjugate(), 0.0)
            _, slope, curve, third = evaluate_law(pieces, values[c], angle)
            if order == 2:
                bent = curve * first * first
            elif order == 3:
                bent = third * first * first * first + 3 * curve * first * second
        if kind == MESH:
            turning = _log_rate(order, gap).imag
            target[row] = -factor_a * (slope * (spins_of_sides[0, order - 1] - turning) + bent) - factor_b * (
                spins_of_sides[1, order - 1] - turning
            )
        elif kind == POLAR:
            log_rate = _log_rate(order, gap)
            target[row] = factor_a * (slope * (log_rate.imag - spins_of_sides[0, order - 1]) + bent - log_rate.real)
        else:
            seen = rotated_derivative(order, line_a.conjugate(), -w, -a, -j, gap[0], gap[1], gap[2], gap[3])
            if kind == RACK:
                target[row] = -(factor_a * difference + factor_b * seen.real)
            elif kind == FACE:
                target[row] = bent - slope * difference - factor_b * seen.imag
            else:
                target[row] = -seen.imag
        row += 1


def _log_rate(order: int, gap: Complexes) -> complex:
    """The derivative of that order of the logarithm of a vector: of its length, and i times its direction."""
    first = _quotient(gap[1], gap[0])
    if order == 1:
        return first
    second = _quotient(gap[2], gap[0])
    if order == 2:
        return complex(second - first * first)
    return complex(_quotient(gap[3], gap[0]) - 3 * first * second + 2 * first * first * first)


def _quotient(a: complex, b: complex) -> complex:
    """Of two vectors of the size of the linkage; NumPy, Python and the compiler divide with other roundings."""
    square = b.real * b.real + b.imag * b.imag
    return complex((a.real * b.real + a.imag * b.imag) / square, (a.imag * b.real - a.real * b.imag) / square)


def _square_rate(order: int, gap: Complexes) -> float:
    """The derivative of that order of the squared length of a vector."""
    rate = 2 * (gap[0].conjugate() * gap[order]).real
    if order == 2:
        rate += 2 * (gap[1].conjugate() * gap[1]).real
    if order == 3:
        rate += 6 * (gap[1].conjugate() * gap[2]).real
    return float(rate)
