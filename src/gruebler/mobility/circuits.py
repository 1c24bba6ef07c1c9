"""The overconstrained subchains: minimal sets of links that hold more constraints than they need.

A dependency among the constraints is a *self-stress*: forces between links, carried by the joints, that balance
on every link. The subchains that are overconstrained are the link sets that carry a stress, and the minimal
ones are the minimal supports of the stress space. The redundancy of a set of links is the dimension of the
stresses that load no other link; it equals the constraints of the induced subchain minus their rank.

Everything happens in the stress space, whose dimension r is the redundancy of the whole chain: leaving out a link is
intersecting with the kernel of its load map. For r = 1 the answer is read off; in general the search
branches on links and remembers supports it has seen. Their number can grow exponentially with r, so the
search has a budget; what it did not take apart is handed back whole with ``minimal=False``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.prime_field import P, left_null_space, product, reduced
from gruebler.mobility.rank import Generic

__all__ = ["Overconstrained", "overconstrained"]

_BUDGET = 200  # subspaces met in one connected part of the stress space
_LARGEST = 60  # the redundancy of a connected part up to which it is taken apart

Matrix = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Overconstrained:
    """A subchain with more constraints than it needs."""

    links: tuple[str, ...]
    joints: tuple[int, ...]
    """The numbers of the joints that carry the stress."""
    redundancy: int
    """By how much there are too many constraints."""
    minimal: bool
    """Whether no smaller set of links within is overconstrained."""
    mended_by_removing: tuple[int, ...]
    """The joints each of which, taken out alone, ends the overconstraint."""
    mended_by_freeing: tuple[int, ...]
    """The joints each of which, given one more freedom, ends it."""


def overconstrained(rank: Generic) -> tuple[Overconstrained, ...]:
    """The minimal overconstrained subchains, ordered by size and place; empty if nothing is redundant.

    Cost O(redundancy · constraints) where circuits do not overlap.

    >>> from gruebler.chain import Chain
    >>> from gruebler.mobility.rank import generic
    >>> braced = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-2) R(3-4) R(4-5) R(5-6) R(6-7) R(7-3)")
    >>> [(part.links, part.redundancy) for part in overconstrained(generic(braced))]
    [(('0', '1', '2', '3'), 1)]
    """
    found = []
    for basis in _connected_parts(rank):
        found += _Part(rank, basis).minimal_supports()
    return tuple(sorted(found, key=lambda part: (len(part.links), part.joints)))


def _connected_parts(rank: Generic) -> list[Matrix]:
    """Split the basis of the stresses, which is of the form [I | D], into parts that share no constraint.

    Within a multiple joint the loads on a link mix the constraints, so such a joint connects as a whole.
    """
    stresses = rank.stresses
    root = list(range(len(stresses)))

    def find(i: int) -> int:
        while root[i] != i:
            root[i] = i = root[root[i]]
        return i

    multiple = {number for number, joint in enumerate(rank.chain.joints) if joint.count > 1}
    loaded: dict[tuple[int, int], list[int]] = {}
    for row, (joint, *_) in enumerate(rank.placement.owners):
        place = (joint, 0) if joint in multiple else (-1, row)
        loaded.setdefault(place, []).extend(int(i) for i in np.flatnonzero(stresses[:, row]))
    for sharing in loaded.values():
        for other in sharing[1:]:
            root[find(other)] = find(sharing[0])
    parts: dict[int, list[int]] = {}
    for i in range(len(stresses)):
        parts.setdefault(find(i), []).append(i)
    return [stresses[members] for members in parts.values()]


class _Part:
    """One connected part of the stress space, with the loads that its stresses put on links and joints."""

    def __init__(self, rank: Generic, basis: Matrix) -> None:
        self.chain = rank.chain
        self.dimension = len(basis)
        on_links: dict[int, list[Matrix]] = {}
        on_joints: dict[int, list[Matrix]] = {}
        for joint, loads in _loads(rank, basis).items():
            for link, load in loads.items():
                if load.any():
                    on_links.setdefault(link, []).append(load)
                    on_joints.setdefault(joint, []).append(load)
        self.on_links = {link: np.hstack(loads) for link, loads in sorted(on_links.items())}
        self.on_joints = {joint: np.hstack(loads) for joint, loads in sorted(on_joints.items())}
        # Links that the same stresses leave unloaded are in or out together: one of each class is enough to ask.
        self.classes = {left_null_space(load).tobytes(): load for load in self.on_links.values()}

    def minimal_supports(self) -> list[Overconstrained]:
        whole = np.eye(self.dimension, dtype=np.int64)
        if self.dimension == 1:
            return [self._describe(whole, minimal=True)]
        if self.dimension > _LARGEST:
            return [self._describe(whole, minimal=False)]
        found: list[Overconstrained] = []
        seen = {whole.tobytes()}
        todo = [whole]
        while todo:
            space = todo.pop()
            smaller = self._without_one_class(space)
            if not smaller:
                found.append(self._describe(space, minimal=True))
            todo += [sub for key, sub in smaller.items() if key not in seen]
            seen.update(smaller)
            if len(seen) > _BUDGET:
                return [*found, self._describe(whole, minimal=False)]
        return found

    def _without_one_class(self, space: Matrix) -> dict[bytes, Matrix]:
        """The subspaces, each once, that leave one class of links unloaded, where anything is left."""
        out = {}
        if len(space) > 1:
            for load in self.classes.values():
                kernel = left_null_space(product(space, load))
                if 0 < len(kernel) < len(space):
                    smaller = reduced(product(kernel, space))
                    out[smaller.tobytes()] = smaller
        return out

    def _describe(self, space: Matrix, *, minimal: bool) -> Overconstrained:
        links = tuple(self.chain.links[link] for link, load in self.on_links.items() if product(space, load).any())
        joints, removing = [], []
        for joint, load in self.on_joints.items():
            loaded = product(space, load)
            if loaded.any():
                joints.append(joint)
                if len(left_null_space(loaded)) == 0:
                    removing.append(joint)
        freeing = tuple(joints) if len(space) == 1 else ()
        return Overconstrained(links, tuple(joints), len(space), minimal, tuple(removing), freeing)


def _loads(rank: Generic, basis: Matrix) -> dict[int, dict[int, Matrix]]:
    """For each joint and each of its links the load (dimension, u) in terms of the joint's functionals.

    The joint's first link takes up what the others put in, so that the load on every link is independent of
    the tree of constraints that stands for a multiple joint.
    """
    out: dict[int, dict[int, Matrix]] = {}
    width = {number: len(f) for number, f in enumerate(rank.placement.functionals)}
    for row, (joint, first, other, k) in enumerate(rank.placement.owners):
        column = basis[:, row]
        if not column.any():
            continue
        loads = out.setdefault(joint, {})
        for link, sign in ((first, -1), (other, 1)):
            load = loads.setdefault(link, np.zeros((len(basis), width[joint]), np.int64))
            load[:, k] = (load[:, k] + sign * column) % P
    return out
