"""How far targets move when the lengths of linkages of two dyads are wrong: in closed form, for many pairs at once.

docs/theory/synthesis.md, "Sensitivity to wrong lengths", has the definitions; here the closing condition of each kind
is solved by hand. Rates are those for lengths that grow by the whole of themselves.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.dyads import BLOCK, CRANK, DyadKind
from gruebler.design.synthesis.sensitivity import LENGTH_ERROR


class PairPlaces(NamedTuple):
    """Where the joints of pairs lie at the targets; shapes (n, m, targets), an axis may have the length 1."""

    pin: Complexes
    pivot: Complexes
    """Of the crank."""
    far_pin: Complexes
    far_pivot: Complexes
    """Of a slide a point of its line."""
    slide: Complexes
    """Direction of the line of a slide."""


class _Rates(NamedTuple):
    """Of each length: how fast it moves the crank's pin and turns the coupler."""

    pins: list[Complexes]
    turns: list[Reals]
    stretched: int
    """Which one is the coupler's length, -1 where it has none."""
    freed: int
    """Which one is the rocker's length, likewise."""


def _rates(kind: DyadKind, at: PairPlaces) -> _Rates:
    """The crank keeps its angle: each length moves the pin, and the closing condition turns the coupler."""
    crank, frame = at.pin - at.pivot, at.far_pivot - at.pivot
    still = np.zeros_like(crank)
    if kind == CRANK:
        coupler, rocker = at.far_pin - at.pin, at.far_pin - at.far_pivot
        lever = np.imag(np.conj(rocker) * coupler)
        along = [np.real(np.conj(rocker) * arm) for arm in (crank, coupler)]
        turns = [*along, -(np.abs(rocker) ** 2), -np.real(np.conj(rocker) * frame)]
        return _Rates([crank, still, still, still], [turn / lever for turn in turns], 1, 2)
    if kind == BLOCK:
        seen = np.conj(at.slide) * (at.far_pivot - at.pin)
        across = [np.imag(np.conj(at.slide) * arm) for arm in (-crank, frame)]
        return _Rates([crank, still, still], [turn / seen.real for turn in (*across, -seen.imag)], -1, -1)
    coupler = at.far_pin - at.pin
    lever = np.real(np.conj(at.slide) * coupler)
    across = [-np.imag(np.conj(at.slide) * arm) for arm in (crank, coupler)]
    offset = np.imag(np.conj(at.slide) * frame)
    return _Rates([crank, still, still], [turn / lever for turn in (*across, offset)], 1, -1)


def body_shifts(kind: DyadKind, at: PairPlaces, body: Complexes, size: float) -> Reals:
    """(n, m) how far the most sensitive position moves at most, by the size of the task; of pairs that guide a body.

    Args:
        kind: of the dyad that is not driven.
        at: the joints.
        body: (targets,) the point of the body.
        size: of the task, by which the turn of the body counts.

    As `Design.relative_sensitivity`.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        turned = sum(map(np.abs, _rates(kind, at).turns))
        return np.asarray(LENGTH_ERROR * np.hypot(_moved(kind, at, body) / size, turned).max(axis=-1))


def point_shifts(kind: DyadKind, at: PairPlaces, point: Complexes, size: float) -> Reals:
    """(n, m) the same of pairs that guide a point, whose coupler may turn."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(LENGTH_ERROR * _moved(kind, at, point).max(axis=-1) / size)


def _moved(kind: DyadKind, at: PairPlaces, point: Complexes) -> Reals:
    """How far a point of the coupler moves at most, for lengths that are wrong by themselves."""
    rates, arm = _rates(kind, at), point - at.pin
    moves = [pin + 1j * turn * arm for pin, turn in zip(rates.pins, rates.turns, strict=True)]
    return farthest_of_all_signs([*moves, arm, 1j * arm])


def output_shifts(kind: DyadKind, at: PairPlaces, size: float) -> Reals:
    """(n, m) the same of pairs that coordinate angles, or an angle and a travel along the slide."""
    with np.errstate(divide="ignore", invalid="ignore"):
        rates = _rates(kind, at)
        coupler = at.far_pin - at.pin
        rocker, frame = at.far_pin - at.far_pivot, at.far_pivot - at.pivot
        outputs = []
        for k, (pin, turn) in enumerate(zip(rates.pins, rates.turns, strict=True)):
            moved = pin + 1j * turn * coupler + (coupler if k == rates.stretched else 0)
            if kind == CRANK:
                moved = moved - (frame if k == len(rates.pins) - 1 else 0)
                outputs.append(np.imag(np.conj(rocker) * moved) / np.abs(rocker) ** 2)
            else:
                outputs.append(np.real(np.conj(at.slide) * moved))
        worst = sum(map(np.abs, outputs))
        return np.asarray(LENGTH_ERROR * np.max(worst, axis=-1) / size)


def farthest_of_all_signs(moves: Sequence[Complexes]) -> Reals:
    """As `farthest_sum`, of a few moves in arrays of their own: tries all signs, one changes each time.

    Args:
        moves: one or more, of shapes that fit each other.

    Cost: doubles with every move. For the six of a pair four times faster than by directions, and a search asks for
    millions of them.

    >>> farthest_of_all_signs([np.array([3]), np.array([4j, 1]), np.array([-1])]).round(3).tolist()
    [5.657, 5.0]
    """
    shape = np.broadcast_shapes(*(move.shape for move in moves))
    across, along = (np.zeros(shape) + sum(part) for part in zip(*((m.real, m.imag) for m in moves), strict=True))
    doubled = [(2 * move.real, 2 * move.imag) for move in moves]
    farthest = across * across + along * along
    for step in range(1, 2 ** (len(moves) - 1)):
        changed = (step & -step).bit_length() - 1  # a Gray code: which one, and whether back
        change = np.add if step >> changed & 2 else np.subtract
        for total, part in zip((across, along), doubled[changed], strict=True):
            change(total, part, out=total)
        np.maximum(farthest, across * across + along * along, out=farthest)
    return np.asarray(np.sqrt(farthest))
