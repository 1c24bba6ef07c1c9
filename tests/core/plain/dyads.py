"""The five dyads in closed form, with velocity, acceleration and jerk.

Each has two bodies and two unknowns at every order: the value by a square root (the assembly mode is its sign), the
derivatives by one system of two linear equations whose matrix is the same for all orders. Six slots hold the joint
elements: 0 and 5 the outer ones on what is known, 1 and 2 those of the first body (outer, inner),
3 and 4 those of the second (inner, outer); the latter four against their body. docs/theory/kinematics.md has the
derivations.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from gruebler.mechanics.kinematics.kernel_records import PRP, RPP, RPR, RRP, RRR
from tests.core.plain.planar_jets import BodyJets, ElementJets, rotated_derivative

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]

_HERON_NOISE = 4e-16  # two roundings of each of the four factors of Heron's formula
_SAME_POINT = 1e-13  # of the size: points nearer than some hundred roundings are one
_SAME_POINT_NEAR_CHANGE = 1e-7  # the same where other dyads are in a change point too: known to some 1e-8 only


def _cross(a: complex, b: complex) -> float:
    return a.real * b.imag - a.imag * b.real


def _dot(a: complex, b: complex) -> float:
    return a.real * b.real + a.imag * b.imag


def dyad_square(kind: int, elements: ElementJets, size: float, driven: bool) -> float:
    """The square of the number whose sign is the assembly mode, without unit: negative if nothing can be assembled.

    For RRR and RRP it is sin^2 of the transmission angle, for RPR the way along the slide in units of `size`. PRP and
    RPP have one mode only: for them it is the sine of the angle between the lines, 0 where they are parallel.
    `driven` says that a drive changes the length of the arm of an RRP: then it is the way along the slide in units of
    `size`, which is zero, and changes its sign, where an arm on the slide's line comes through the length 0.
    """
    points, lines = elements.points, elements.lines
    if kind == RRR:
        gap = points[5, 0] - points[0, 0]
        first, second = points[2, 0] - points[1, 0], points[3, 0] - points[4, 0]
        d, r, s = sqrt(_dot(gap, gap)), sqrt(_dot(first, first)), sqrt(_dot(second, second))
        square = (r + s - d) * (s + d - r) * (d + r - s) * (d + r + s) / (2 * r * s) ** 2  # Heron: no digits are lost
        noise = _HERON_NOISE * (d + r + s) ** 2 / (r * s)
        return 0.0 if -noise < square < 0 else square
    if kind == RRP:
        first = points[2, 0] - points[1, 0]
        reach = points[5, 0] + lines[5] * lines[4].conjugate() * (points[3, 0] - points[4, 0]) - points[0, 0]
        across = _cross(lines[5], reach)
        if driven:
            return (_dot(first, first) - across * across) / (size * size)
        return 1 - across * across / _dot(first, first)
    if kind == RPR:
        gap = points[5, 0] - points[0, 0]
        off = _offset(elements)
        return (_dot(gap, gap) - off * off) / (size * size)
    sine: float = _cross(lines[0] if kind == PRP else lines[5] * lines[4].conjugate() * lines[3], lines[5])
    return sine


def _offset(elements: ElementJets) -> float:
    """RPR: how far the second outer joint lies left of the first, seen along the slide."""
    points, lines = elements.points, elements.lines
    first = lines[2].conjugate() * (points[1, 0] - points[2, 0])
    second = lines[3].conjugate() * (points[4, 0] - points[3, 0])
    offset: float = second.imag - first.imag
    return offset


def meeting(kind: int, elements: ElementJets, size: float) -> bool:
    """Whether the outer joints of RRR or RPR meet, or both of the arm of an RRP, so that their line has no direction.

    RPR has its slide in that line; with the slide through both joints any direction closes, so their line is not asked
    even where they are only nearly one. The same holds of an arm without length whose outer joint is on the slide.
    """
    points, lines = elements.points, elements.lines
    gap = points[5, 0] - points[0, 0]
    near = _SAME_POINT
    if kind != RRR:
        if kind == RRP:
            off = _cross(lines[5], gap + lines[5] * lines[4].conjugate() * (points[3, 0] - points[4, 0]))
            gap = points[2, 0] - points[1, 0]
        else:
            off = _offset(elements)
        if off * off > _SAME_POINT * _SAME_POINT * size * size:
            return False
        near = _SAME_POINT_NEAR_CHANGE
    met: bool = _dot(gap, gap) <= near * near * size * size
    return met


def dyad_place(
    kind: int, root: float, elements: ElementJets, body_a: int, body_b: int, links: BodyJets, size: float, driven: bool
) -> None:
    """Place both bodies; `root` is the signed root of `dyad_square`."""
    points, lines, places, turns = elements.points, elements.lines, links.places, links.turns
    if kind == RRR:
        gap = points[5, 0] - points[0, 0]
        first, second = points[2, 0] - points[1, 0], points[3, 0] - points[4, 0]
        d, l1, l2 = _dot(gap, gap), _dot(first, first), _dot(second, second)
        if not meeting(kind, elements, size):
            arm = gap * complex((d + l1 - l2) / (2 * d), root * sqrt(l1 * l2) / d)
            turns[body_a] = arm * complex(first.real / l1, -first.imag / l1)
        else:  # any direction closes: the one that the body has already
            arm = turns[body_a] * first
        turns[body_b] = (arm - gap) * complex(second.real / l2, -second.imag / l2)
    elif kind == RRP:
        first = points[2, 0] - points[1, 0]
        l1 = _dot(first, first)
        turns[body_b] = lines[5] * lines[4].conjugate()
        reach = points[5, 0] + turns[body_b] * (points[3, 0] - points[4, 0]) - points[0, 0]
        travel = root * (size if driven else sqrt(l1)) - _dot(lines[5], reach)
        if not (driven and meeting(kind, elements, size)):  # else any direction closes: the one that the body has
            turns[body_a] = (reach + travel * lines[5]) * complex(first.real / l1, -first.imag / l1)
        places[body_b, 0] = points[5, 0] + travel * lines[5] - turns[body_b] * points[4, 0]
    elif kind == RPR:
        if meeting(kind, elements, size):  # any direction closes: the one that the body has already
            line = turns[body_a] * lines[2]
        else:
            gap = points[5, 0] - points[0, 0]
            line = gap * complex(root * size, -_offset(elements))
            length = sqrt(_dot(line, line))
            line = complex(line.real / length, line.imag / length)
        turns[body_a] = line * lines[2].conjugate()
        turns[body_b] = line * lines[3].conjugate()
    elif kind == PRP:
        turns[body_a] = lines[0] * lines[1].conjugate()
        turns[body_b] = lines[5] * lines[4].conjugate()
        start = points[0, 0] + turns[body_a] * (points[2, 0] - points[1, 0])
        end = points[5, 0] + turns[body_b] * (points[3, 0] - points[4, 0])
        sine = _cross(lines[0], lines[5])
        places[body_a, 0] = (
            points[0, 0] + lines[0] * _cross(end - start, lines[5]) / sine - turns[body_a] * points[1, 0]
        )
        places[body_b, 0] = (
            points[5, 0] + lines[5] * _cross(end - start, lines[0]) / sine - turns[body_b] * points[4, 0]
        )
    else:
        turns[body_b] = lines[5] * lines[4].conjugate()
        slide = turns[body_b] * lines[3]
        turns[body_a] = slide * lines[2].conjugate()
        places[body_a, 0] = points[0, 0] - turns[body_a] * points[1, 0]
        miss = (
            points[5, 0]
            + turns[body_b] * (points[3, 0] - points[4, 0])
            - places[body_a, 0]
            - turns[body_a] * points[2, 0]
        )
        travel = -_cross(slide, miss) / _cross(slide, lines[5])
        places[body_b, 0] = points[5, 0] + travel * lines[5] - turns[body_b] * points[4, 0]
    if kind in (RRR, RRP, RPR):
        places[body_a, 0] = points[0, 0] - turns[body_a] * points[1, 0]
    if kind in (RRR, RPR):
        places[body_b, 0] = points[5, 0] - turns[body_b] * points[4, 0]


def _solved(left: complex, right: complex, target: complex) -> tuple[float, float]:
    """The real p, q with p * left + q * right = target."""
    sine = _cross(left, right)
    return _cross(target, right) / sine, _cross(left, target) / sine


def _arm(k: int, body: int, start: int, end: int, points: Complexes, turns: Complexes, rates: Reals) -> complex:
    """The k-th derivative of the vector from slot `one` to slot `two` of a body whose rates up to k are written."""
    return rotated_derivative(
        k,
        turns[body],
        rates[body, 0],
        rates[body, 1],
        rates[body, 2],
        points[end, 0] - points[start, 0],
        points[end, 1] - points[start, 1],
        points[end, 2] - points[start, 2],
        points[end, 3] - points[start, 3],
    )


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


def _along(k: int, line: complex, spins: Reals, slot: int, w0: float, w1: float, w2: float, w3: float) -> complex:
    """The k-th derivative of a way w(t) along the line of a slot."""
    return rotated_derivative(
        k, line, spins[slot, 0], spins[slot, 1], spins[slot, 2], w0 + 0j, w1 + 0j, w2 + 0j, w3 + 0j
    )


def dyad_rates(kind: int, order: int, elements: ElementJets, body_a: int, body_b: int, links: BodyJets) -> None:
    """Write velocity, acceleration and jerk of both bodies up to the order; they are placed already.

    Unused orders of the elements are zero.
    """
    points, lines, spins = elements.points, elements.lines, elements.spins
    places, turns, rates = links.places, links.turns, links.rates
    for k in range(3):
        rates[body_a, k] = rates[body_b, k] = 0
    first = turns[body_a] * (points[2, 0] - points[1, 0])
    second = turns[body_b] * (points[3, 0] - points[4, 0])
    slide0 = slide1 = slide2 = slide_rate = second0 = second1 = second2 = second_rate = 0.0
    if kind == RRP:
        slide0 = _dot(lines[5], places[body_a, 0] + turns[body_a] * points[2, 0] - points[5, 0] - second)
    elif kind == PRP:
        meet = places[body_a, 0] + turns[body_a] * points[2, 0]
        slide0 = _dot(lines[0], meet - points[0, 0] - first)
        second0 = _dot(lines[5], meet - points[5, 0] - second)
    elif kind == RPR:
        line = turns[body_a] * lines[2]
        slide0 = _dot(line, second + points[5, 0] - points[0, 0] - first)
    elif kind == RPP:
        line = turns[body_a] * lines[2]
        slide0 = _dot(lines[5], places[body_b, 0] + turns[body_b] * points[4, 0] - points[5, 0])
        second0 = _dot(
            line, places[body_b, 0] + turns[body_b] * points[3, 0] - places[body_a, 0] - turns[body_a] * points[2, 0]
        )
    for k in range(1, order + 1):
        if kind == RRR:
            target = points[5, k] + _arm(k, body_b, 4, 3, points, turns, rates)
            target -= points[0, k] + _arm(k, body_a, 1, 2, points, turns, rates)
            rates[body_a, k - 1], rates[body_b, k - 1] = _solved(1j * first, -1j * second, target)
        elif kind == RRP:
            rates[body_b, k - 1] = spins[5, k - 1] - spins[4, k - 1]
            target = points[5, k] + _arm(k, body_b, 4, 3, points, turns, rates)
            target += _along(k, lines[5], spins, 5, slide0, slide1, slide2, 0.0)
            target -= points[0, k] + _arm(k, body_a, 1, 2, points, turns, rates)
            rates[body_a, k - 1], slide_rate = _solved(1j * first, -lines[5], target)
        elif kind == RPR:
            # the slide turns as one; what turns in a body of several links is taken off again
            spin1, spin2 = spins[2, k - 1], spins[3, k - 1]
            rates[body_a, k - 1], rates[body_b, k - 1] = -spin1, -spin2
            target = points[5, k] + _arm(k, body_b, 4, 3, points, turns, rates)
            target -= points[0, k] + _arm(k, body_a, 1, 2, points, turns, rates)
            w = rates[body_a, 0] + spins[2, 0] if k > 1 else 0.0
            a = rates[body_a, 1] + spins[2, 1] if k > 2 else 0.0
            target -= rotated_derivative(k, line, w, a, 0.0, slide0 + 0j, slide1 + 0j, slide2 + 0j, 0j)
            turn, slide_rate = _solved(1j * (first - second + slide0 * line), line, target)
            rates[body_a, k - 1] += turn
            rates[body_b, k - 1] += turn
        elif kind == PRP:
            rates[body_a, k - 1] = spins[0, k - 1] - spins[1, k - 1]
            rates[body_b, k - 1] = spins[5, k - 1] - spins[4, k - 1]
            target = points[5, k] + _arm(k, body_b, 4, 3, points, turns, rates)
            target += _along(k, lines[5], spins, 5, second0, second1, second2, 0.0)
            target -= points[0, k] + _arm(k, body_a, 1, 2, points, turns, rates)
            target -= _along(k, lines[0], spins, 0, slide0, slide1, slide2, 0.0)
            slide_rate, second_rate = _solved(lines[0], -lines[5], target)
        else:
            rates[body_b, k - 1] = spins[5, k - 1] - spins[4, k - 1]
            rates[body_a, k - 1] = rates[body_b, k - 1] + spins[3, k - 1] - spins[2, k - 1]
            w = rates[body_a, 0] + spins[2, 0]
            a = rates[body_a, 1] + spins[2, 1] if k > 1 else 0.0
            j = rates[body_a, 2] + spins[2, 2] if k > 2 else 0.0
            target = points[0, k] + _arm(k, body_a, 1, 2, points, turns, rates)
            target += rotated_derivative(k, line, w, a, j, second0 + 0j, second1 + 0j, second2 + 0j, 0j)
            target -= points[5, k] + _arm(k, body_b, 4, 3, points, turns, rates)
            target -= _along(k, lines[5], spins, 5, slide0, slide1, slide2, 0.0)
            slide_rate, second_rate = _solved(lines[5], -line, target)
        if kind == PRP:
            moved = points[0, k] - _reference(k, body_a, 1, points, turns, rates)
            if k == 1:
                moved += _along(k, lines[0], spins, 0, slide0, slide_rate, 0.0, 0.0)
            elif k == 2:
                moved += _along(k, lines[0], spins, 0, slide0, slide1, slide_rate, 0.0)
            else:
                moved += _along(k, lines[0], spins, 0, slide0, slide1, slide2, slide_rate)
            places[body_a, k] = moved
        else:
            places[body_a, k] = points[0, k] - _reference(k, body_a, 1, points, turns, rates)
        moved = points[5, k] - _reference(k, body_b, 4, points, turns, rates)
        if kind in (RRP, RPP, PRP):
            along = second_rate if kind == PRP else slide_rate
            w0, w1, w2 = (second0, second1, second2) if kind == PRP else (slide0, slide1, slide2)
            if k == 1:
                moved += _along(k, lines[5], spins, 5, w0, along, 0.0, 0.0)
            elif k == 2:
                moved += _along(k, lines[5], spins, 5, w0, w1, along, 0.0)
            else:
                moved += _along(k, lines[5], spins, 5, w0, w1, w2, along)
        places[body_b, k] = moved
        if kind != RRR:
            if k == 1:
                slide1 = slide_rate
            elif k == 2:
                slide2 = slide_rate
            if kind in (PRP, RPP):
                if k == 1:
                    second1 = second_rate
                elif k == 2:
                    second2 = second_rate
