"""The five dyads in closed form, with velocity, acceleration and jerk.

Each has two bodies and two unknowns at every order: the value by a square root (the assembly mode is its sign), the
derivatives by one system of two linear equations whose matrix is the same for all orders. Slots of the scratch arrays
hold the six joint elements: 0 and 5 the outer ones on what is known, 1 and 2 those of the first body (outer, inner),
3 and 4 those of the second (inner, outer); the latter four against their body. docs/theory/kinematics.md has the
derivations.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.lanes import square_root
from gruebler._numeric.motion.planar_jets import rotated_derivative
from gruebler._numeric.motion.program import PRP, RPP, RPR, RRP, RRR

__all__ = ["dyad_place", "dyad_rates", "dyad_square", "meeting"]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _cross(a: complex, b: complex) -> float:
    return a.real * b.imag - a.imag * b.real


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _dot(a: complex, b: complex) -> float:
    return a.real * b.real + a.imag * b.imag


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def dyad_square(kind: int, points: Complexes, lines: Complexes, size: float) -> float:
    """The square of the number whose sign is the assembly mode, without unit: negative if nothing can be assembled.

    For RRR and RRP it is sin^2 of the transmission angle, for RPR the way along the slide in units of `size`. PRP and
    RPP have one mode only: for them it is the sine of the angle between the lines, 0 where they are parallel.
    """
    if kind == RRR:
        way = points[5, 0] - points[0, 0]
        first, second = points[2, 0] - points[1, 0], points[3, 0] - points[4, 0]
        d, r, s = sqrt(_dot(way, way)), square_root(_dot(first, first)), square_root(_dot(second, second))
        square = (r + s - d) * (s + d - r) * (d + r - s) * (d + r + s) / (2 * r * s) ** 2  # Heron: no digits are lost
        noise = 4e-16 * (d + r + s) ** 2 / (r * s)
        return 0.0 if -noise < square < 0 else square
    if kind == RRP:
        first = points[2, 0] - points[1, 0]
        reach = points[5, 0] + lines[5] * lines[4].conjugate() * (points[3, 0] - points[4, 0]) - points[0, 0]
        across = _cross(lines[5], reach)
        return 1 - across * across / _dot(first, first)
    if kind == RPR:
        way = points[5, 0] - points[0, 0]
        off = _offset(points, lines)
        return (_dot(way, way) - off * off) / (size * size)
    sine: float = _cross(lines[0] if kind == PRP else lines[5] * lines[4].conjugate() * lines[3], lines[5])
    return sine


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _offset(points: Complexes, lines: Complexes) -> float:
    """RPR: how far the second outer joint lies left of the first, seen along the slide."""
    first = lines[2].conjugate() * (points[1, 0] - points[2, 0])
    second = lines[3].conjugate() * (points[4, 0] - points[3, 0])
    offset: float = second.imag - first.imag
    return offset


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def meeting(kind: int, points: Complexes, lines: Complexes, size: float) -> bool:
    """Whether the outer joints of RRR or RPR meet, so that their line has no direction.

    RPR has its slide in that line. Where other dyads are in a change point too, the joints are known to some 1e-8 of
    the size only, so nearer than 1e-7 their line is not asked; with the slide through both any direction closes.
    """
    way = points[5, 0] - points[0, 0]
    near = 1e-13
    if kind == RPR:
        off = _offset(points, lines)
        if off * off > 1e-26 * size * size:
            return False
        near = 1e-7
    met: bool = _dot(way, way) <= near * near * size * size
    return met


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def dyad_place(
    kind: int,
    root: float,
    points: Complexes,
    lines: Complexes,
    one: int,
    two: int,
    places: Complexes,
    turns: Complexes,
    size: float,
) -> None:
    """Place both bodies; `root` is the signed root of `dyad_square`."""
    if kind == RRR:
        way = points[5, 0] - points[0, 0]
        first, second = points[2, 0] - points[1, 0], points[3, 0] - points[4, 0]
        d, l1, l2 = _dot(way, way), _dot(first, first), _dot(second, second)
        if not meeting(kind, points, lines, size):
            arm = way * complex((d + l1 - l2) / (2 * d), root * sqrt(l1 * l2) / d)
            turns[one] = arm * complex(first.real / l1, -first.imag / l1)
        else:  # any direction closes: the one that the body has already
            arm = turns[one] * first
        turns[two] = (arm - way) * complex(second.real / l2, -second.imag / l2)
    elif kind == RRP:
        first = points[2, 0] - points[1, 0]
        l1 = _dot(first, first)
        turns[two] = lines[5] * lines[4].conjugate()
        reach = points[5, 0] + turns[two] * (points[3, 0] - points[4, 0]) - points[0, 0]
        way = root * sqrt(l1) - _dot(lines[5], reach)
        turns[one] = (reach + way * lines[5]) * complex(first.real / l1, -first.imag / l1)
        places[two, 0] = points[5, 0] + way * lines[5] - turns[two] * points[4, 0]
    elif kind == RPR:
        if meeting(kind, points, lines, size):  # any direction closes: the one that the body has already
            line = turns[one] * lines[2]
        else:
            way = points[5, 0] - points[0, 0]
            line = way * complex(root * size, -_offset(points, lines))
            length = sqrt(_dot(line, line))
            line = complex(line.real / length, line.imag / length)
        turns[one] = line * lines[2].conjugate()
        turns[two] = line * lines[3].conjugate()
    elif kind == PRP:
        turns[one] = lines[0] * lines[1].conjugate()
        turns[two] = lines[5] * lines[4].conjugate()
        start = points[0, 0] + turns[one] * (points[2, 0] - points[1, 0])
        end = points[5, 0] + turns[two] * (points[3, 0] - points[4, 0])
        sine = _cross(lines[0], lines[5])
        places[one, 0] = points[0, 0] + lines[0] * _cross(end - start, lines[5]) / sine - turns[one] * points[1, 0]
        places[two, 0] = points[5, 0] + lines[5] * _cross(end - start, lines[0]) / sine - turns[two] * points[4, 0]
    else:
        turns[two] = lines[5] * lines[4].conjugate()
        slide = turns[two] * lines[3]
        turns[one] = slide * lines[2].conjugate()
        places[one, 0] = points[0, 0] - turns[one] * points[1, 0]
        miss = points[5, 0] + turns[two] * (points[3, 0] - points[4, 0]) - places[one, 0] - turns[one] * points[2, 0]
        way = -_cross(slide, miss) / _cross(slide, lines[5])
        places[two, 0] = points[5, 0] + way * lines[5] - turns[two] * points[4, 0]
    if kind in (RRR, RRP, RPR):
        places[one, 0] = points[0, 0] - turns[one] * points[1, 0]
    if kind in (RRR, RPR):
        places[two, 0] = points[5, 0] - turns[two] * points[4, 0]


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _solved(left: complex, right: complex, target: complex) -> tuple[float, float]:
    """The real p, q with p * left + q * right = target."""
    sine = _cross(left, right)
    return _cross(target, right) / sine, _cross(left, target) / sine


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _arm(k: int, body: int, one: int, two: int, points: Complexes, turns: Complexes, rates: Reals) -> complex:
    """The k-th derivative of the vector from slot `one` to slot `two` of a body whose rates up to k are written."""
    return rotated_derivative(
        k,
        turns[body],
        rates[body, 0],
        rates[body, 1],
        rates[body, 2],
        points[two, 0] - points[one, 0],
        points[two, 1] - points[one, 1],
        points[two, 2] - points[one, 2],
        points[two, 3] - points[one, 3],
    )


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _reference(k: int, body: int, slot: int, points: Complexes, turns: Complexes, rates: Reals) -> complex:
    """The k-th derivative of a slot's point of a body, without the body's origin."""
    return rotated_derivative(
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


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _along(k: int, line: complex, spins: Reals, slot: int, w0: float, w1: float, w2: float, w3: float) -> complex:
    """The k-th derivative of a way w(t) along the line of a slot."""
    return rotated_derivative(
        k, line, spins[slot, 0], spins[slot, 1], spins[slot, 2], w0 + 0j, w1 + 0j, w2 + 0j, w3 + 0j
    )


@njit(cache=True, error_model="numpy", _nrt=False)
def dyad_rates(
    kind: int,
    order: int,
    points: Complexes,
    lines: Complexes,
    spins: Reals,
    one: int,
    two: int,
    places: Complexes,
    turns: Complexes,
    rates: Reals,
) -> None:
    """Write velocity, acceleration and jerk of both bodies up to the order; they are placed already.

    Unused orders of `points` and `spins` are zero.
    """
    for k in range(3):
        rates[one, k] = rates[two, k] = 0
    first = turns[one] * (points[2, 0] - points[1, 0])
    second = turns[two] * (points[3, 0] - points[4, 0])
    way0 = way1 = way2 = way = other0 = other1 = other2 = other = 0.0
    if kind == RRP:
        way0 = _dot(lines[5], places[one, 0] + turns[one] * points[2, 0] - points[5, 0] - second)
    elif kind == PRP:
        meet = places[one, 0] + turns[one] * points[2, 0]
        way0 = _dot(lines[0], meet - points[0, 0] - first)
        other0 = _dot(lines[5], meet - points[5, 0] - second)
    elif kind == RPR:
        slide = turns[one] * lines[2]
        way0 = _dot(slide, second + points[5, 0] - points[0, 0] - first)
    elif kind == RPP:
        slide = turns[one] * lines[2]
        way0 = _dot(lines[5], places[two, 0] + turns[two] * points[4, 0] - points[5, 0])
        other0 = _dot(slide, places[two, 0] + turns[two] * points[3, 0] - places[one, 0] - turns[one] * points[2, 0])
    for k in range(1, order + 1):
        if kind == RRR:
            target = points[5, k] + _arm(k, two, 4, 3, points, turns, rates)
            target -= points[0, k] + _arm(k, one, 1, 2, points, turns, rates)
            rates[one, k - 1], rates[two, k - 1] = _solved(1j * first, -1j * second, target)
        elif kind == RRP:
            rates[two, k - 1] = spins[5, k - 1] - spins[4, k - 1]
            target = points[5, k] + _arm(k, two, 4, 3, points, turns, rates)
            target += _along(k, lines[5], spins, 5, way0, way1, way2, 0.0)
            target -= points[0, k] + _arm(k, one, 1, 2, points, turns, rates)
            rates[one, k - 1], way = _solved(1j * first, -lines[5], target)
        elif kind == RPR:
            # the slide turns as one; what turns in a body of several links is taken off again
            spin1, spin2 = spins[2, k - 1], spins[3, k - 1]
            rates[one, k - 1], rates[two, k - 1] = -spin1, -spin2
            target = points[5, k] + _arm(k, two, 4, 3, points, turns, rates)
            target -= points[0, k] + _arm(k, one, 1, 2, points, turns, rates)
            w = rates[one, 0] + spins[2, 0] if k > 1 else 0.0
            a = rates[one, 1] + spins[2, 1] if k > 2 else 0.0
            target -= rotated_derivative(k, slide, w, a, 0.0, way0 + 0j, way1 + 0j, way2 + 0j, 0j)
            turn, way = _solved(1j * (first - second + way0 * slide), slide, target)
            rates[one, k - 1] += turn
            rates[two, k - 1] += turn
        elif kind == PRP:
            rates[one, k - 1] = spins[0, k - 1] - spins[1, k - 1]
            rates[two, k - 1] = spins[5, k - 1] - spins[4, k - 1]
            target = points[5, k] + _arm(k, two, 4, 3, points, turns, rates)
            target += _along(k, lines[5], spins, 5, other0, other1, other2, 0.0)
            target -= points[0, k] + _arm(k, one, 1, 2, points, turns, rates)
            target -= _along(k, lines[0], spins, 0, way0, way1, way2, 0.0)
            way, other = _solved(lines[0], -lines[5], target)
        else:
            rates[two, k - 1] = spins[5, k - 1] - spins[4, k - 1]
            rates[one, k - 1] = rates[two, k - 1] + spins[3, k - 1] - spins[2, k - 1]
            w = rates[one, 0] + spins[2, 0]
            a = rates[one, 1] + spins[2, 1] if k > 1 else 0.0
            j = rates[one, 2] + spins[2, 2] if k > 2 else 0.0
            target = points[0, k] + _arm(k, one, 1, 2, points, turns, rates)
            target += rotated_derivative(k, slide, w, a, j, other0 + 0j, other1 + 0j, other2 + 0j, 0j)
            target -= points[5, k] + _arm(k, two, 4, 3, points, turns, rates)
            target -= _along(k, lines[5], spins, 5, way0, way1, way2, 0.0)
            way, other = _solved(lines[5], -slide, target)
        if kind == PRP:
            moved = points[0, k] - _reference(k, one, 1, points, turns, rates)
            if k == 1:
                moved += _along(k, lines[0], spins, 0, way0, way, 0.0, 0.0)
            elif k == 2:
                moved += _along(k, lines[0], spins, 0, way0, way1, way, 0.0)
            else:
                moved += _along(k, lines[0], spins, 0, way0, way1, way2, way)
            places[one, k] = moved
        else:
            places[one, k] = points[0, k] - _reference(k, one, 1, points, turns, rates)
        moved = points[5, k] - _reference(k, two, 4, points, turns, rates)
        if kind in (RRP, RPP, PRP):
            along = other if kind == PRP else way
            w0, w1, w2 = (other0, other1, other2) if kind == PRP else (way0, way1, way2)
            if k == 1:
                moved += _along(k, lines[5], spins, 5, w0, along, 0.0, 0.0)
            elif k == 2:
                moved += _along(k, lines[5], spins, 5, w0, w1, along, 0.0)
            else:
                moved += _along(k, lines[5], spins, 5, w0, w1, w2, along)
        places[two, k] = moved
        if kind != RRR:
            if k == 1:
                way1 = way
            elif k == 2:
                way2 = way
            if kind in (PRP, RPP):
                if k == 1:
                    other1 = other
                elif k == 2:
                    other2 = other
