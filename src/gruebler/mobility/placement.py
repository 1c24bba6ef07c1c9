"""A chain put at a random place: the linear constraints its joints lay on the twists of its links.

Everything is counted modulo the prime P of `gruebler._numeric.prime_field`. Each joint gets a random frame
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
from typing import NamedTuple

from gruebler._numeric.prime_field import P, Row
from gruebler.chain import Chain, Joint
from gruebler.pairs import Space

__all__ = ["Lock", "Placement", "place"]

_SPATIAL = Space.SPATIAL.directions
_ENTRY_DEGREE = 4  # of an entry as a polynomial in the random numbers: 2 (rotation) + 1 (origin) + 1 (pitch)

Vector = tuple[int, int, int]
Frame = tuple[tuple[Vector, Vector, Vector], Vector]


@dataclass(frozen=True, slots=True)
class Placement:
    """The constraint matrix of a chain at one random placement; the first link stands still."""

    rows: list[Row]
    columns: int
    """b (n - 1): the twist of link i > 0 has the columns b (i - 1) to b i - 1."""
    owners: list[tuple[int, int, int, int]]
    """For each row (joint number, first link, other link, number of the functional)."""
    functionals: list[list[tuple[int, ...]]]
    """For each joint its u functionals, each b residues."""

    def error_bound(self, rank: int) -> float:
        """How likely at most it is that this placement shows less than the generic rank (Schwartz, Zippel)."""
        return _ENTRY_DEGREE * (rank + 1) / P


class Lock(NamedTuple):
    """A freedom taken away: one motion direction of a joint, between two of its links."""

    joint: int
    direction: str
    between: tuple[str, str]


def place(chain: Chain, seed: int, locks: Sequence[Lock] = ()) -> Placement:
    """Place the chain at random; the same seed gives the same placement.

    A joint of k links binds its first link to each of the k - 1 others. The rows of locked freedoms come last.
    Cost O(constraints).
    """
    random = Random(seed)
    b = chain.space.b
    rows: list[Row] = []
    owners = []
    functionals = []
    frames: list[Frame] = []
    for number, joint in enumerate(chain.joints):
        frame = _frame(chain.space, random)
        frames.append(frame)
        mine = _constraints(joint, chain.space, frame, random)
        functionals.append(mine)
        first, *others = (chain.index(link) for link in joint.links)
        for other in others:
            for k, functional in enumerate(mine):
                rows.append(_row(functional, first, other, b))
                owners.append((number, first, other, k))
    for lock in locks:
        first, other = (chain.index(link) for link in lock.between)
        functional = _placed(_unit(lock.direction.replace("H", "R")), chain.space, frames[lock.joint])
        rows.append(_row(functional, first, other, b))
        owners.append((lock.joint, first, other, len(functionals[lock.joint])))
    return Placement(rows, b * (chain.n - 1), owners, functionals)


def _row(functional: tuple[int, ...], first: int, other: int, b: int) -> Row:
    """The functional of the relative twist, other against first; the link 0 stands still."""
    row = {}
    for link, sign in ((first, -1), (other, 1)):
        if link:
            row.update({b * (link - 1) + i: sign * v % P for i, v in enumerate(functional) if v})
    return row


def _constraints(joint: Joint, space: Space, frame: Frame, random: Random) -> list[tuple[int, ...]]:
    """The functionals that vanish on the joint's freedoms."""
    freedoms = joint.pair.freedoms[space]
    out = []
    for direction in space.directions:
        if direction in freedoms or (direction == "Rz" and "Hz" in freedoms):
            continue
        moment, force = _unit(direction)
        if direction == "Tz" and "Hz" in freedoms:
            moment = (0, 0, -random.randrange(1, P))
        out.append(_placed((moment, force), space, frame))
    return out


def _unit(direction: str) -> tuple[Vector, Vector]:
    a, b, c, x, y, z = (int(direction == d) for d in _SPATIAL)
    return (a, b, c), (x, y, z)


def _placed(functional: tuple[Vector, Vector], space: Space, frame: Frame) -> tuple[int, ...]:
    """A functional of the joint's own axes read in the base frame."""
    rotation, origin = frame
    force = _turn(rotation, functional[1])
    moment = [m + a for m, a in zip(_turn(rotation, functional[0]), _cross(origin, force), strict=True)]
    whole = dict(zip(_SPATIAL, (*moment, *force), strict=True))
    return tuple(whole[d] % P for d in space.directions)


def _frame(space: Space, random: Random) -> Frame:
    """The rows of a rotation matrix, times a non-zero number, and an origin: random as far as the space allows."""

    def number() -> int:
        return random.randrange(1, P)

    planar = space is Space.PLANAR
    w, z = number(), number()
    x, y = (0, 0) if planar else (number(), number())
    rotation = (
        ((w * w + x * x - y * y - z * z) % P, 2 * (x * y - w * z) % P, 2 * (x * z + w * y) % P),
        (2 * (x * y + w * z) % P, (w * w - x * x + y * y - z * z) % P, 2 * (y * z - w * x) % P),
        (2 * (x * z - w * y) % P, 2 * (y * z + w * x) % P, (w * w - x * x - y * y + z * z) % P),
    )
    if space is Space.SPHERICAL:
        return rotation, (0, 0, 0)
    return rotation, (number(), number(), 0 if planar else number())


def _turn(rotation: tuple[Vector, Vector, Vector], v: Vector) -> Vector:
    a, b, c = (sum(r * x for r, x in zip(row, v, strict=True)) % P for row in rotation)
    return a, b, c


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        (a[1] * b[2] - a[2] * b[1]) % P,
        (a[2] * b[0] - a[0] * b[2]) % P,
        (a[0] * b[1] - a[1] * b[0]) % P,
    )
