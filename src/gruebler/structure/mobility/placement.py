"""A chain at a random placement: the linear constraints of its joints on the twists of its links.

Everything is counted modulo the prime P of `gruebler.structure.mobility.prime_field`. Each joint gets a random frame
of its own (a rotation from a random quaternion, and a random origin), common to all its links. A pair with
freedoms D allows relative twists in the span of D; the functionals that vanish on D are its constraints, u
of them. In the joint's own axes they are the unit functionals of the directions that D leaves out; for a
screw of pitch h the functional "shift minus h times turn" comes in addition.

A functional (m, f) taken in a frame with rotation R and origin c reads (R m + c x R f, R f) in the base frame.
The rotation is used without its denominator, which multiplies a functional by a non-zero number only.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

import numpy as np
from numpy.typing import NDArray

from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.spaces import Freedom, Space
from gruebler.structure.mobility.prime_field import P, Row

_SPATIAL = Space.SPATIAL.directions
_ENTRY_DEGREE = 4  # of an entry as a polynomial in the random numbers: 2 (rotation) + 1 (origin) + 1 (pitch)


@dataclass(frozen=True, slots=True)
class Placement:
    """The constraint matrix of a chain at one random placement; the first link is fixed."""

    rows: list[Row]
    columns: int
    """b (n - 1): the twist of link i > 0 has the columns b (i - 1) to b i - 1."""
    owners: list[tuple[int, int, int, int]]
    """For each row (joint number, first link, other link, number of the functional)."""
    functionals: list[list[tuple[int, ...]]]
    """For each joint its u functionals, each b residues."""

    def error_bound(self, rank: int) -> float:
        """An upper bound of the probability that the rank here is below the generic rank (Schwartz, Zippel)."""
        return _ENTRY_DEGREE * (rank + 1) / P


@dataclass(frozen=True, slots=True)
class LockedFreedom:
    """A locked freedom: one motion direction of a joint, between two of its links."""

    joint: int
    direction: str
    between: tuple[str, str]


def random_placement(chain: Chain, seed: int, locks: Sequence[LockedFreedom] = ()) -> Placement:
    """Place the chain at random; the same seed gives the same placement.

    A joint of k links binds its first link to each of the k - 1 others. The rows of locked freedoms come last.
    Cost O(constraints).
    """
    b = chain.space.b
    frames = _Frames(chain, Random(seed))
    rows: list[Row] = []
    owners = []
    functionals = [frames.constraints(number, joint) for number, joint in enumerate(chain.joints)]
    for number, (joint, joint_functionals) in enumerate(zip(chain.joints, functionals, strict=True)):
        first, *others = (chain.index(link) for link in joint.links)
        for other in others:
            for k, functional in enumerate(joint_functionals):
                rows.append(_row(functional, first, other, b))
                owners.append((number, first, other, k))
    for lock in locks:
        first, other = (chain.index(link) for link in lock.between)
        functional = frames.unit(lock.joint, _without_pitch(Freedom(lock.direction)))
        rows.append(_row(functional, first, other, b))
        owners.append((lock.joint, first, other, len(functionals[lock.joint])))
    return Placement(rows, b * (chain.n - 1), owners, functionals)


def _row(functional: tuple[int, ...], first: int, other: int, b: int) -> Row:
    """The functional of the relative twist, other against first; the link 0 is fixed."""
    row = {}
    if first:
        row = {k: P - v for k, v in enumerate(functional, b * (first - 1)) if v}
    if other:
        row |= {k: v for k, v in enumerate(functional, b * (other - 1)) if v}
    return row


def _without_pitch(freedom: Freedom) -> Freedom:
    """The direction by which a freedom is measured: of a screw its turn."""
    return freedom.turn if freedom.turns else freedom


class _Frames:
    """A random frame for each joint: the rows of a rotation matrix, times a non-zero number, and an origin."""

    def __init__(self, chain: Chain, random: Random) -> None:
        self.space = chain.space
        numbers = [(*self._draw(random), self._pitch(joint, random)) for joint in chain.joints]
        self._pitches = [pitch for *_, pitch in numbers]
        w, x, y, z, *origin, _ = np.array(numbers, np.int64).T
        ww, xx, yy, zz = (v * v % P for v in (w, x, y, z))
        wx, wy, wz, xy, xz, yz = (a * b % P for a, b in ((w, x), (w, y), (w, z), (x, y), (x, z), (y, z)))
        rotation = (
            (ww + xx - yy - zz, 2 * (xy - wz), 2 * (xz + wy)),
            (2 * (xy + wz), ww - xx + yy - zz, 2 * (yz - wx)),
            (2 * (xz - wy), 2 * (yz + wx), ww - xx - yy + zz),
        )
        self._units = {}
        """For each direction the functional of every joint's own axes, read in the base frame."""
        for k, turn in enumerate(Space.SPHERICAL.directions):
            axis = [row[k] % P for row in rotation]
            moment = [(origin[i - 2] * axis[i - 1] - origin[i - 1] * axis[i - 2]) % P for i in range(3)]
            self._units[turn] = self._rows(axis, [np.zeros_like(w)] * 3)
            self._units[turn.travel] = self._rows(moment, axis)

    def _draw(self, random: Random) -> tuple[int, ...]:
        """A quaternion w, x, y, z and an origin, random as far as the space allows."""

        def number() -> int:
            return random.randrange(1, P)

        planar = self.space is Space.PLANAR
        w, z = number(), number()
        x, y = (0, 0) if planar else (number(), number())
        if self.space is Space.SPHERICAL:
            return w, x, y, z, 0, 0, 0
        return w, x, y, z, number(), number(), 0 if planar else number()

    def _pitch(self, joint: Joint, random: Random) -> int:
        return random.randrange(1, P) if joint.pair.has_pitch else 0

    def _rows(self, moment: list[NDArray[np.int64]], force: list[NDArray[np.int64]]) -> list[tuple[int, ...]]:
        whole = dict(zip(_SPATIAL, (*moment, *force), strict=True))
        return list(zip(*(whole[d].tolist() for d in self.space.directions), strict=True))

    def unit(self, number: int, direction: Freedom) -> tuple[int, ...]:
        """The functional of one direction of a joint's own axes, read in the base frame."""
        return self._units[direction][number]

    def constraints(self, number: int, joint: Joint) -> list[tuple[int, ...]]:
        """The functionals that vanish on the joint's freedoms."""
        freedoms = joint.pair.freedoms[self.space]
        free = {_without_pitch(freedom) for freedom in freedoms}
        coupled = {freedom.travel for freedom in freedoms if freedom.has_pitch}
        vanishing = []
        for direction in self.space.directions:
            if direction in free:
                continue
            functional = self.unit(number, direction)
            if direction in coupled:
                pitch = self._pitches[number]
                turn = self.unit(number, direction.turn)
                functional = tuple((a - pitch * b) % P for a, b in zip(functional, turn, strict=True))
            vanishing.append(functional)
        return vanishing
