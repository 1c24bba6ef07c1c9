"""What is solved for in a linkage in space, and what a path meets where it ends."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
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
from gruebler.mechanics.space.closure import ClosingConditions, Place
from gruebler.mechanics.space.tree import ClosureTree, closure_tree
from gruebler.structure.mobility import mobility_report

RANK = 1e-7
"""Of the largest singular value: below it a row repeats others, or an unknown does not matter."""
_ROUNDING = 1e-11  # sizes and radians: a singular value below it is 0, also where it is the only one
_ALIKE = 1e-3  # the share of a drive in what its own motion opens, from which on it meets a limit


@dataclass(frozen=True, eq=False, kw_only=True)
class Setting:
    """What is solved for in a linkage: its closing conditions, drives, idle unknowns that are held, and its rank."""

    closure: ClosingConditions
    passive: NDArray[np.intp]
    drives: NDArray[np.intp]
    rank: int
    held: tuple[int, ...] = ()
    """Unknowns that keep their value: idle freedoms besides the spins of rods are fixed by them."""

    @property
    def held_joints(self) -> tuple[str, ...]:
        """The joints of the unknowns that are held."""
        tree = self.closure.tree
        names = tree.linkage.mechanism.chain.joint_names()
        return tuple(dict.fromkeys(names[joint] for (joint, _), k in tree.unknown.items() if k in self.held))


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
        return int(np.sum(self.values > max(RANK * self.values.max(initial=0.0), _ROUNDING)))


@lru_cache(maxsize=64)
def setting(linkage: SpatialLinkage) -> Setting:
    """What is solved for; `LinkageError` if the drives do not fix the motion.

    Idle freedoms are fixed by a rule: rods between balls are not in the tree at all; of any other idle freedom the
    unknown with the largest share in it keeps its value.
    """
    tree = closure_tree(linkage)
    closure = ClosingConditions(tree)
    by_unknown = closure.linearised(closure.reference)[1]
    drives = np.array(sorted(set(tree.drives)), np.intp)
    passive = np.setdiff1d(np.arange(tree.unknowns), drives)
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
    if held:
        closure = ClosingConditions(tree, held)
    return Setting(closure=closure, passive=passive, drives=drives, rank=rank, held=tuple(held))


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
        "the drives do not fix the motion in the reference pose, F = {count} is left, in {joints}; drive more joints, "
        "or take another reference pose if this one is singular"
        if driven
        else "the linkage has no drive, F = {count} is left, in {joints}; drive one of its joints",
        count=free,
        joints=joined(names) or tree.linkage.mechanism.frame,
    )


def is_limit(set_up: Setting, place: Place, change: Reals) -> bool:
    """Whether drives that change so cannot go on, or two assembly modes meet: whether nothing closes what they open."""
    by_unknown = set_up.closure.linearised(place)[1]
    inverse = Inverse.of(by_unknown[:, set_up.passive])
    opened = by_unknown[:, set_up.drives] @ change
    share = abs(inverse.left[:, set_up.rank - 1] @ opened) if set_up.rank else 0.0
    return bool(share > _ALIKE * np.linalg.norm(opened))
