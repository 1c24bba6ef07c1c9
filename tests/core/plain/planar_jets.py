"""Derivatives of planar motions, written with complex numbers: a point is x + iy, a turn is a factor of modulus 1.

A *jet* is a quantity with its first three time derivatives.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]


class BodyJets(NamedTuple):
    """Where bodies are and how they move."""

    places: Complexes
    """(bodies, 4) the jet of the origin."""
    turns: Complexes
    """(bodies,) the turn, a factor of modulus 1."""
    rates: Reals
    """(bodies, 3) angular velocity, acceleration, jerk."""


class ElementJets(NamedTuple):
    """The same for elements of joints, a slot for each."""

    points: Complexes
    """(slots, 4) the jet of the point; (slots, 1) where nothing is derived."""
    lines: Complexes
    """(slots,) the direction, a factor of modulus 1."""
    spins: Reals
    """(slots, 3) the rates of the direction's angle; none where nothing is derived."""


def rotated_derivative(
    order: int, turn: complex, w: float, a: float, j: float, b0: complex, b1: complex, b2: complex, b3: complex
) -> complex:
    """The derivative of that order of ``turn(t) * b(t)``; ``w``, ``a``, ``j`` are the rates of the angle."""
    if order == 0:
        return turn * b0
    if order == 1:
        return turn * (b1 + 1j * w * b0)
    if order == 2:
        return turn * (b2 + 2j * w * b1 + (1j * a - w * w) * b0)
    return turn * (b3 + 3j * w * b2 + 3 * (1j * a - w * w) * b1 + (1j * (j - w * w * w) - 3 * w * a) * b0)


def set_element_jet(
    order: int, link: int, point: complex, line: complex, links: BodyJets, slot: int, elements: ElementJets
) -> None:
    """Put the jet of a link's point, the direction of its line and the rates of that direction into a slot."""
    places, turns, rates = links.places, links.turns, links.rates
    points, lines, spins = elements.points, elements.lines, elements.spins
    turn = turns[link]
    arm = turn * point
    points[slot, 0] = places[link, 0] + arm
    lines[slot] = turn * line
    if order >= 1:
        w = rates[link, 0]
        points[slot, 1] = places[link, 1] + 1j * w * arm
        spins[slot, 0] = w
        if order >= 2:
            a = rates[link, 1]
            points[slot, 2] = places[link, 2] + (1j * a - w * w) * arm
            spins[slot, 1] = a
            if order >= 3:
                j = rates[link, 2]
                points[slot, 3] = places[link, 3] + (1j * (j - w * w * w) - 3 * w * a) * arm
                spins[slot, 2] = j


def carry(order: int, link: int, body: int, links: BodyJets) -> None:
    """Motion of a link known against a body, the body's motion known: the link's motion against what the body's is."""
    places, turns, rates = links.places, links.turns, links.rates
    w = a = j = 0.0
    b0, b1, b2, b3 = places[link, 0], 0j, 0j, 0j
    if order >= 1:
        w, b1 = rates[body, 0], places[link, 1]
    if order >= 2:
        a, b2 = rates[body, 1], places[link, 2]
    if order >= 3:
        j, b3 = rates[body, 2], places[link, 3]
    for k in range(order + 1):
        places[link, k] = places[body, k] + rotated_derivative(k, turns[body], w, a, j, b0, b1, b2, b3)
    for k in range(order):
        rates[link, k] += rates[body, k]
    turns[link] *= turns[body]
