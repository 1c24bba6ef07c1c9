"""The overconstrained subchains: minimal sets of links with more constraints than they need.

A dependency among the constraints is a *self-stress*: forces between links, carried by the joints, that balance
on every link. The subchains that are overconstrained are the link sets that carry a stress, and the minimal
ones are the minimal supports of the stress space. The redundancy of a set of links is the dimension of the
stresses that load no other link; it equals the constraints of the induced subchain minus their rank.

The computation takes place in the stress space, whose dimension r is the redundancy of the entire chain: leaving out a
link is intersecting with the kernel of its load map. For r = 1 the support of the stress is the answer; in general the
search branches on links and keeps a set of the supports already visited. Their number can grow exponentially with r, so
the search has a budget; a part that it did not decompose is returned undivided with ``minimal=False``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.structure.mobility.prime_field import (
    P,
    Support,
    echelon,
    left_null_space,
    modular_product,
    null_space_by_column,
    reduced_echelon,
)
from gruebler.structure.mobility.rank import Generic

_BUDGET = 200  # subspaces visited in one connected part of the stress space
_LARGEST = 60  # the redundancy of a connected part up to which it is decomposed

Matrix = NDArray[np.int64]
Column = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Overconstrained:
    """A subchain with more constraints than it needs."""

    links: tuple[str, ...]
    joints: tuple[int, ...]
    """The numbers of the joints that carry the stress."""
    redundancy: int
    """The number of surplus constraints."""
    minimal: bool
    """Whether no smaller set of links within is overconstrained."""
    resolved_by_removing: tuple[int, ...]
    """The joints whose removal, of any single one, ends the overconstraint."""
    resolved_by_freeing: tuple[int, ...]
    """The joints of which any single one, with one more freedom, ends it."""


def overconstrained(rank: Generic) -> tuple[Overconstrained, ...]:
    """The minimal overconstrained subchains, ordered by size and place; empty if nothing is redundant.

    Cost O(redundancy · constraints) where circuits do not overlap.

    >>> from gruebler.structure.chain import Chain
    >>> from gruebler.structure.mobility.rank import generic
    >>> braced = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-2) R(3-4) R(4-5) R(5-6) R(6-7) R(7-3)")
    >>> [(part.links, part.redundancy) for part in overconstrained(generic(braced))]
    [(('0', '1', '2', '3'), 1)]
    """
    if rank.redundancy == 0:
        return ()
    subchains = []
    basis = null_space_by_column(rank.stress_form)
    for part in _connected_parts(rank, basis):
        if basis is None or not 1 < part.dimension <= _LARGEST:
            subchains.append(_as_a_whole(rank, part, basis))
        else:
            subchains += _StressedPart(rank, part, basis).minimal_supports()
    return tuple(sorted(subchains, key=lambda part: (len(part.links), part.joints)))


class _Rows(NamedTuple):
    """The constraints that a connected part of the stress space loads."""

    rows: list[int]
    members: list[int]
    """The basis vectors that lie in it."""

    @property
    def dimension(self) -> int:
        return len(self.members)


def _connected_parts(rank: Generic, basis: dict[int, Support] | None) -> list[_Rows]:
    """Split the basis of the stresses, which is of the form [I | D], into parts that share no constraint.

    Within a multiple joint the loads on a link mix the constraints, so such a joint connects as a whole. Where the
    basis is too large to store, a constraint is joined with those that its equation contains; then parts may remain
    undivided.
    """
    sharing, free = _sharing(rank, basis)
    joints, owners = rank.chain.joints, rank.placement.owners
    sets = DisjointSets(range(len(owners)))
    first_of_joint: dict[int, int] = {}
    for row, others in sharing.items():
        for other in others:
            sets.unite(row, other)
        joint = owners[row][0]
        if joints[joint].count > 1:
            sets.unite(first_of_joint.setdefault(joint, row), row)
    parts: dict[int, _Rows] = {}
    for k, row in enumerate(free):
        parts.setdefault(sets.find(row), _Rows([], [])).members.append(k)
    for row in sorted(sharing):
        parts[sets.find(row)].rows.append(row)
    return list(parts.values())


def _sharing(rank: Generic, basis: dict[int, Support] | None) -> tuple[dict[int, list[int]], list[int]]:
    """For each loaded constraint those that share a stress with it, and the free constraint of each basis vector."""
    form = rank.stress_form
    pivots = {pivot for pivot, _, _ in form.pivots}
    free = [row for row in range(form.columns) if row not in pivots]
    if basis is not None:
        return {row: [free[k] for k in members.tolist()] for row, (members, _) in basis.items()}, free
    loaded: NDArray[np.bool_] = np.any(rank.some_stresses, axis=1)
    sharing: dict[int, list[int]] = {row: [] for row in free}
    for pivot, columns, _ in form.pivots:
        if loaded[pivot]:
            sharing[pivot] = columns[loaded[columns]].tolist()
    return sharing, free


def _as_a_whole(rank: Generic, part: _Rows, basis: dict[int, Support] | None) -> Overconstrained:
    """A part as one subchain; minimal if its stress is the only one. Random stresses show which joints are loaded."""
    single = part.dimension == 1
    on_links: set[int] = set()
    on_joints: list[int] = []
    for joint, loads in _loads(rank, {row: rank.some_stresses[row] for row in part.rows}).items():
        loaded = [link for link, load in loads.items() if load.any()]
        on_links.update(loaded)
        if loaded:
            on_joints.append(joint)
    links = tuple(rank.chain.links[link] for link in sorted(on_links))
    joints = tuple(sorted(on_joints))
    removing = joints if single else () if basis is None else _in_every_stress(rank, part, basis)
    return Overconstrained(
        links=links,
        joints=joints,
        redundancy=part.dimension,
        minimal=single,
        resolved_by_removing=removing,
        resolved_by_freeing=joints if single else (),
    )


def _in_every_stress(rank: Generic, part: _Rows, basis: dict[int, Support]) -> tuple[int, ...]:
    """The joints that every stress of the part loads: those whose constraints hold as many independent entries."""
    rows: dict[int, list[int]] = {}
    for row in part.rows:
        rows.setdefault(rank.placement.owners[row][0], []).append(row)
    loaded_joints = []
    for joint, joint_rows in sorted(rows.items()):
        if len(joint_rows) >= part.dimension:
            entries = [dict(zip(basis[row][0].tolist(), basis[row][1].tolist(), strict=True)) for row in joint_rows]
            if echelon(entries, rank.redundancy).rank == part.dimension:
                loaded_joints.append(joint)
    return tuple(loaded_joints)


class _StressedPart:
    """One connected part of the stress space, with the loads that its stresses put on links and joints.

    Links whose loads vanish for the same stresses belong to the same subchains, and so do joints: one of each class is
    tested.
    """

    def __init__(self, rank: Generic, part: _Rows, basis: dict[int, Support]) -> None:
        self.chain = rank.chain
        self.dimension = part.dimension
        place = {member: k for k, member in enumerate(part.members)}
        columns = {}
        for row in part.rows:
            members, values = basis[row]
            columns[row] = np.zeros(self.dimension, np.int64)
            columns[row][[place[k] for k in members.tolist()]] = values
        on_links: dict[int, list[Matrix]] = {}
        on_joints: dict[int, list[Matrix]] = {}
        for joint, loads in _loads(rank, columns).items():
            for link, load in loads.items():
                if load.any():
                    on_links.setdefault(link, []).append(load)
                    on_joints.setdefault(joint, []).append(load)
        self.links, self.classes = _by_kernel(on_links)
        self.joints, self.joint_classes = _by_kernel(on_joints)

    def minimal_supports(self) -> list[Overconstrained]:
        whole_space = np.eye(self.dimension, dtype=np.int64)
        overconstraineds: list[Overconstrained] = []
        visited = {whole_space.tobytes()}
        todo = [whole_space]
        while todo:
            space = todo.pop()
            smaller = self._without_one_class(space)
            if not smaller:
                overconstraineds.append(self._describe(space, minimal=True))
            todo += [sub for key, sub in smaller.items() if key not in visited]
            visited.update(smaller)
            if len(visited) > _BUDGET:
                return [*overconstraineds, self._describe(whole_space, minimal=False)]
        return overconstraineds

    def _without_one_class(self, space: Matrix) -> dict[bytes, Matrix]:
        """The non-zero subspaces, each once, that leave one class of links unloaded."""
        subspaces = {}
        if len(space) > 1:
            for kernel in map(left_null_space, [modular_product(space, load) for load in self.classes.values()]):
                if 0 < len(kernel) < len(space):
                    smaller = reduced_echelon(modular_product(kernel, space))
                    subspaces[smaller.tobytes()] = smaller
        return subspaces

    def _describe(self, space: Matrix, *, minimal: bool) -> Overconstrained:
        loaded = {key for key, load in self.classes.items() if modular_product(space, load).any()}
        links = tuple(self.chain.links[link] for link, key in self.links.items() if key in loaded)
        on_joints = {key: modular_product(space, load) for key, load in self.joint_classes.items()}
        on_joints = {key: load for key, load in on_joints.items() if load.any()}
        ends = {key for key, load in on_joints.items() if len(left_null_space(load)) == 0}
        joints = tuple(joint for joint, key in self.joints.items() if key in on_joints)
        removing = tuple(joint for joint in joints if self.joints[joint] in ends)
        return Overconstrained(
            links=links,
            joints=joints,
            redundancy=len(space),
            minimal=minimal,
            resolved_by_removing=removing,
            resolved_by_freeing=joints if len(space) == 1 else (),
        )


def _by_kernel(loads: dict[int, list[Matrix]]) -> tuple[dict[int, bytes], dict[bytes, Matrix]]:
    """For each number, in order, the key of the stresses that do not load it; for each key one load that has it."""
    whole = {number: np.hstack(some) for number, some in sorted(loads.items())}
    kernels = [left_null_space(load) for load in whole.values()]
    keys = {number: kernel.tobytes() for number, kernel in zip(whole, kernels, strict=True)}
    return keys, {keys[number]: load for number, load in whole.items()}


def _loads(rank: Generic, columns: dict[int, Column]) -> dict[int, dict[int, Matrix]]:
    """For each joint and each of its links the load (stresses, u) in terms of the joint's functionals.

    The joint's first link carries the sum of the loads of the others, so that the load on every link is independent of
    the tree of constraints that represents a multiple joint. ``columns`` has the entries of the stresses in each
    constraint.
    """
    joint_loads: dict[int, dict[int, Matrix]] = {}
    width = [len(functionals) for functionals in rank.placement.functionals]
    for row, column in columns.items():
        joint, first, other, k = rank.placement.owners[row]
        loads = joint_loads.setdefault(joint, {})
        for link, sign in ((first, -1), (other, 1)):
            load = loads.get(link)
            if load is None:
                load = loads[link] = np.zeros((len(column), width[joint]), np.int64)
            load[:, k] = (load[:, k] + sign * column) % P
    return joint_loads
