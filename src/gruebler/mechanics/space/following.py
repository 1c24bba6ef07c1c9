"""A tree of joints followed along its drives: every step closed by Newton's method, every change of rank noticed.

A step counts if the correction stays below a fifth of it and the rank is that of the reference pose; otherwise it is
halved. So the path does not go over to another assembly mode unless one comes nearer than the smallest step.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import joined
from gruebler.mechanics.screws.closing import Closing
from gruebler.mechanics.screws.idle import idle_parts
from gruebler.mechanics.screws.instant_mobility import instant_mobility
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.closure import ClosingConditions
from gruebler.mechanics.space.tree import ClosureTree, closure_tree
from gruebler.structure.mobility import mobility_report

CLOSED = 1e-12
"""Sizes and radians: joints that are open by less are closed."""
RANK = 1e-7
"""Of the largest singular value: below it a row repeats others, or an unknown does not matter."""
_SETTLED = 1e-14  # a residual that one step more would only change by rounding
_STEP = 0.1  # radians and sizes: the largest step of a drive
_LEAST = 1e-6  # of the largest step: a step that is halved so often has met something
_TURNS = 8  # of Newton's method in a step
_APART = 0.2  # of the step: a larger correction may lead to another assembly mode
_FAR = 0.5  # radians: turns of balls are counted anew from there, far from a Cardan angle of 90 degrees
_ALIKE = 1e-3  # the share of a drive in what its own motion opens, from which on it meets a limit


class Place(NamedTuple):
    """A closed position: unknowns, and from where the turns of balls are counted."""

    q: Reals
    still: Reals


@dataclass(frozen=True, eq=False, kw_only=True)
class Setting:
    """What is solved for in a linkage: its closing conditions, drives, idle unknowns that are held, and its rank."""

    closure: ClosingConditions
    passive: NDArray[np.intp]
    drives: NDArray[np.intp]
    held: NDArray[np.intp]
    """Unknowns of idle freedoms; they keep the value 0."""
    rank: int


class Inverse(NamedTuple):
    """The singular value decomposition of the derivatives by the passive unknowns."""

    left: Reals
    values: Reals
    right: Reals

    @classmethod
    def of(cls, matrix: Reals) -> Inverse:
        """Of a matrix without rows too."""
        return cls(*np.linalg.svd(matrix, full_matrices=False))

    @property
    def rank(self) -> int:
        """How many singular values count."""
        return int(np.sum(self.values > RANK * self.values.max(initial=0.0)))

    def matrix(self, rank: int) -> Reals:
        """The inverse of this rank, (unknowns, rows)."""
        return np.asarray((self.right[:rank].T / self.values[:rank]) @ self.left[:, :rank].T)


def setting(linkage: SpatialLinkage) -> Setting:
    """What is solved for; `LinkageError` if the drives do not fix the motion.

    Idle freedoms are fixed by a rule: rods between balls are not in the tree at all; of any other idle freedom the
    unknown with the largest share in it keeps its value.
    """
    tree = closure_tree(linkage)
    closure = ClosingConditions(tree)
    _, by_unknown, _ = closure.linearised(np.zeros(closure.unknowns), closure.still)
    drives = np.array(sorted(set(tree.drives)), np.intp)
    passive = np.setdiff1d(np.arange(closure.unknowns), drives)
    rank = Inverse.of(by_unknown[:, passive]).rank
    whole = Inverse.of(by_unknown).rank
    free = len(passive) - rank
    held: list[int] = []
    if free:
        idle = _idle(tree)
        if free > idle:
            raise _not_fixed(tree, by_unknown, passive, free - idle, bool(len(drives)))
        held = most_idle(by_unknown[:, passive], passive, free)
        passive = np.setdiff1d(passive, held)
    if whole > rank:
        raise LinkageError(
            "the drives {drives} cannot take every value: in the reference pose the joints hold them, {count} too many",
            drives=joined(_titles(tree)),
            count=whole - rank,
        )
    if tree.folds and held:
        starts = {start for start in tree.folds if {start - 1, start, start + 1} & {*held}}
        closure.folds = tuple(start for start in tree.folds if start not in starts)
    return Setting(closure=closure, passive=passive, drives=drives, held=np.array(held, np.intp), rank=rank)


def _titles(tree: ClosureTree) -> list[object]:
    mechanism = tree.linkage.mechanism
    return [mechanism.chain.joint_title(drive.joint) for drive in mechanism.drives]


def _idle(tree: ClosureTree) -> int:
    """The idle freedoms besides the spins of the rods that are not in the tree."""
    linkage = tree.linkage
    closing = Closing.of(linkage)
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    instant = instant_mobility(closing, closing.reference, 1e-8)
    rods = {chain.links[rod.link] for rod in tree.rods}
    parts = idle_parts(instant, mobility_report(chain, frame=frame).idle_freedoms)
    return sum(part.freedoms for part in parts if not rods & {*part.links})


def most_idle(matrix: Reals, passive: NDArray[np.intp], count: int) -> list[int]:
    """The unknowns with the largest shares in what the matrix does not see, one after the other."""
    left = np.linalg.svd(matrix)[2][-count:]
    held: list[int] = []
    for _ in range(count):
        shares = np.linalg.norm(left, axis=0).round(9)
        k = int(np.argmax(shares))
        held.append(int(passive[k]))
        left = left - np.outer(left[:, k], left[:, k] @ left) / (left[:, k] @ left[:, k])
    return sorted(held)


def _not_fixed(
    tree: ClosureTree, by_unknown: Reals, passive: NDArray[np.intp], free: int, driven: bool
) -> LinkageError:
    chain = tree.linkage.mechanism.chain
    motions = np.linalg.svd(by_unknown[:, passive])[2][-free:]
    moving = {int(k) for k in passive[np.abs(motions).max(axis=0) > RANK]}
    joints = dict.fromkeys(joint for (joint, _), k in tree.unknown.items() if k in moving)
    names = [chain.joint_title(joint) for joint in joints]
    return LinkageError(
        "the drives do not fix the motion in the reference pose, F = {count} is left: {joints} still move; drive more "
        "joints, or take another reference pose if this one is singular"
        if driven
        else "the linkage has no drive, F = {count} is left: {joints} move; drive one of its joints",
        count=free,
        joints=joined(names) or tree.linkage.mechanism.frame,
    )


def closed(set_up: Setting, place: Place) -> tuple[Place | None, Inverse]:
    """The closed position next to one, drives and idle unknowns held; None if Newton's method does not close it.

    A stationary point of the residual is not a closed position: only the residual itself counts.
    """
    closure, q = set_up.closure, place.q.copy()
    last = np.inf
    for _ in range(_TURNS):
        value, by_unknown, _ = closure.linearised(q, place.still)
        inverse = Inverse.of(by_unknown[:, set_up.passive])
        gap = float(abs(value).max(initial=0.0))
        if gap < _SETTLED or (gap < CLOSED and gap > last / 4):
            return Place(q, place.still), inverse
        if not np.isfinite(gap):
            break
        last = gap
        q[set_up.passive] -= inverse.matrix(min(inverse.rank, set_up.rank)) @ value
    return (Place(q, place.still) if gap < CLOSED else None), inverse


class Met(NamedTuple):
    """Where a path ended before its end: the place on it in rows, the last closed position, whether it is a limit."""

    row: float
    place: Place
    is_limit: bool


@dataclass(frozen=True, eq=False, kw_only=True)
class Followed:
    """The closed positions of the rows that were reached, the inverse matrices there, and what was met."""

    places: list[Place]
    inverses: list[Reals]
    smallest: Reals
    """(rows,) the smallest singular value that counts, of the largest one."""
    met: Met | None
    passed: list[int]
    """Rows before which a change of mode was passed: the determinant of the derivatives has changed its sign."""


def follow(set_up: Setting, path: Reals) -> Followed:
    """Positions at rows of drive values (rows, drives), in radians and sizes, from the reference pose on."""
    place: Place | None = Place(np.zeros(set_up.closure.unknowns), set_up.closure.still)
    places: list[Place] = []
    inverses: list[Reals] = []
    smallest: list[float] = []
    passed: list[int] = []
    for row, target in enumerate(path):
        assert place is not None
        begin = place.q[set_up.drives]
        place, at, passes = _towards(set_up, place, target)
        if passes:
            passed.append(row)
        if at < 1:
            met = _met(set_up, place, target - begin, row - 1 + at)
            return Followed(places=places, inverses=inverses, smallest=np.array(smallest), met=met, passed=passed)
        settled, inverse = closed(set_up, place)
        places.append(settled or place)
        inverses.append(inverse.matrix(set_up.rank))
        smallest.append(inverse.values[set_up.rank - 1] / inverse.values[0] if set_up.rank else 1.0)
    return Followed(places=places, inverses=inverses, smallest=np.array(smallest), met=None, passed=passed)


def _towards(set_up: Setting, place: Place, target: Reals) -> tuple[Place, float, bool]:
    """The position at drive values, or as far as it goes; what part of the way; whether it passed a singular one."""
    closure, drives, passive = set_up.closure, set_up.drives, set_up.passive
    begin = place.q[drives]
    change = target - begin
    length = float(abs(change).max(initial=0.0))
    at, passed = 0.0, False
    step = 1.0 if length <= _STEP else _STEP / length
    largest = step
    while at < 1:
        _, by_unknown, _ = closure.linearised(place.q, place.still)
        inverse = Inverse.of(by_unknown[:, passive]).matrix(set_up.rank)
        slope = np.zeros(closure.unknowns)
        slope[drives] = change
        slope[passive] = -inverse @ (by_unknown[:, drives] @ change)
        while True:
            step = min(step, 1 - at)
            guess = place.q + step * slope
            guess[drives] = target if at + step >= 1 else begin + (at + step) * change
            new, reached = closed(set_up, Place(guess, place.still))
            moved = step * abs(slope).max()
            if new is not None and reached.rank == set_up.rank and abs(new.q - guess).max() <= _APART * moved + CLOSED:
                break
            step /= 2
            if step < _LEAST * largest:
                return place, at, passed
        at = 1.0 if at + step >= 1 else at + step
        there = closure.linearised(new.q, new.still)[1][:, passive]
        passed ^= bool(len(passive)) and np.linalg.det(inverse @ there) < 0
        place = _counted_anew(set_up, new)
        step = min(2 * step, largest)
    return place, 1.0, passed


def _counted_anew(set_up: Setting, place: Place) -> Place:
    closure = set_up.closure
    if any(abs(place.q[start - 1 : start + 2]).max() > _FAR for start in closure.folds):
        return Place(*closure.folded(place.q, place.still))
    return place


def _met(set_up: Setting, place: Place, change: Reals, row: float) -> Met:
    """Whether the drives cannot go on, or two assembly modes meet: whether their motion opens what nothing closes."""
    _, by_unknown, _ = set_up.closure.linearised(place.q, place.still)
    inverse = Inverse.of(by_unknown[:, set_up.passive])
    opened = by_unknown[:, set_up.drives] @ change
    share = abs(inverse.left[:, set_up.rank - 1] @ opened) if set_up.rank else 0.0
    return Met(row, place, bool(share > _ALIKE * np.linalg.norm(opened)))
