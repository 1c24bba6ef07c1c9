"""The work of a request, divided into pieces: plain data, in a fixed order.

A piece contains contracted graphs (chains that are not fractionated), sizes of the last block (fractionated ones) or
some chains with simple joints (multiple joints grow from them). `PieceCounter` and `PieceLister` are pure functions of
a piece and can be sent to any worker.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from gruebler.structure.chain import Chain
from gruebler.structure.enumeration.assortment import Assortment, loop_count
from gruebler.structure.enumeration.counting import ChainCount
from gruebler.structure.enumeration.fractionated import (
    BlockAddition,
    block_additions,
    composed,
    edges_of,
)
from gruebler.structure.enumeration.fractionation_class import fractionation
from gruebler.structure.enumeration.multiple import grown_joints, with_multiple_joints
from gruebler.structure.enumeration.pieces import (
    PieceTally,
    WorkPiece,
    count_piece,
    graph6_lines,
    list_piece,
    pieces,
)
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.simple_chains import LAZY, chain_of_edges
from gruebler.structure.isomorphism import orbits as orbits_of
from gruebler.structure.isomorphism import symmetry

_GROWN_AT_ONCE = 256  # chains with simple joints in a piece; at 12 links some ten thousand chains grow from them

Edges = tuple[tuple[int, int], ...]
Joints = list[list[int]]
"""The links of each joint."""


@dataclass(frozen=True, slots=True)
class RingPiece:
    """The chain of one loop, which has no contracted graph."""

    links: int


@dataclass(frozen=True, slots=True)
class MultipleJointPiece:
    """Chains with simple joints from which those with multiple joints grow."""

    links: int
    simple: tuple[Edges, ...]


Work = WorkPiece | RingPiece | BlockAddition | MultipleJointPiece


@dataclass(frozen=True, slots=True)
class PieceListing:
    """The chains of one class in a piece, written out."""

    kind: str
    chains: int
    text: bytes
    """A line for each chain, line ends included: graph6, the text of a chain, or a JSON document."""


def work_units(request: Request, *, size: int = 50_000_000) -> Iterator[Work]:
    """The pieces of work, lazily.

    Args:
        request: the request.
        size: work of a piece of contracted graphs, see `pieces.WorkPiece`.
    """
    if not request.only_simple:
        simple = chains_of_request(Request(request.links, mobility=request.mobility, fractionated="all"))
        while some := tuple(edges_of(chain) for chain in islice(simple, _GROWN_AT_ONCE)):
            yield MultipleJointPiece(request.links, some)
        return
    for kind in request.classes:
        if kind != "none":
            yield from block_additions(request.links, request.mobility, kind)
        elif loop_count(request.links, request.mobility) == 1:
            if request.assortment in (None, (request.links,)):
                yield RingPiece(request.links)
        else:
            yield from pieces(request.links, request.mobility, assortment=request.assortment, size=size)


def chains_of_request(request: Request) -> Iterator[Chain]:
    """The requested chains, lazily, in the order of the pieces of work."""
    return (chain for work in work_units(request, size=LAZY) for _, chain in chains_of_piece(request, work))


def _not_fractionated(links: int, mobility: int) -> Iterator[Chain]:
    return chains_of_request(Request(links, mobility=mobility))


def chains_of_piece(request: Request, work: Work) -> Iterator[tuple[str, Chain]]:
    """The chains of a piece with their classes."""
    if isinstance(work, WorkPiece):
        yield from (("none", chain_of_edges(work.links, edges)) for edges in list_piece(work).tolist())
    elif isinstance(work, RingPiece):
        yield "none", Chain.from_edges([(i, (i + 1) % work.links) for i in range(work.links)])
    elif isinstance(work, BlockAddition):
        kind = "joint" if work.bridges else "link"
        for compound in composed(_not_fractionated, work):
            if request.assortment in (None, compound.chain.assortment):
                yield kind, compound.chain
    elif isinstance(work, MultipleJointPiece):
        fewest, most = request.joints_range
        simple = (Chain([("revolute", edge) for edge in edges], links=range(work.links)) for edges in work.simple)
        for chain in with_multiple_joints(simple, fewest=fewest, most=most):
            if request.assortment in (None, chain.assortment) and (kind := fractionation(chain)) in request.classes:
                yield kind, chain


@dataclass(frozen=True, slots=True)
class PieceCounter:
    """Counts a piece in a worker."""

    request: Request
    orbits: bool
    listed: bool = False
    """Whether every chain is built, also where its number alone is found faster."""

    def __call__(self, work: Work) -> list[PieceTally]:
        """The numbers of a piece, by class and assortment."""
        if isinstance(work, WorkPiece) and not self.listed:
            return count_piece(work, self.orbits)
        few = self.request.mobility < 2 and not (self.orbits or self.listed)
        if isinstance(work, MultipleJointPiece) and few:
            return _grown_tallies(self.request, work)
        sums: dict[tuple[str, Assortment], list[int]] = {}
        for kind, chain in chains_of_piece(self.request, work):
            row = sums.setdefault((kind, chain.assortment), [0, 0, 0, 0])
            for k, number in enumerate((1, *(_orbits(chain) if self.orbits else ()))):
                row[k] += number
        return [
            PieceTally(
                kind=kind,
                assortment=assortment,
                chains=chains,
                inversions=inversions,
                joint_orbits=joint_orbits,
                drives=drives,
            )
            for (kind, assortment), (chains, inversions, joint_orbits, drives) in sorted(sums.items())
        ]


def _grown_tallies(request: Request, work: MultipleJointPiece) -> list[PieceTally]:
    """The numbers of chains with multiple joints by assortment; with F < 2 none is fractionated."""
    if "none" not in request.classes:
        return []
    sums: dict[Assortment, int] = {}
    for block in _grown(request, work):
        degrees = np.stack([(block[:, 1:] >> link & 1).sum(axis=1) for link in range(work.links)], axis=1)
        numbers = np.stack([(degrees == k).sum(axis=1) for k in range(2, int(degrees.max(initial=2)) + 1)], axis=1)
        unique, counts = np.unique(numbers, axis=0, return_counts=True)
        for row, count in zip(unique, counts.tolist(), strict=True):
            assortment = tuple(np.trim_zeros(row, "b").tolist())
            if request.assortment in (None, assortment):
                sums[assortment] = sums.get(assortment, 0) + count
    return [
        PieceTally(kind="none", assortment=assortment, chains=count, inversions=0, joint_orbits=0, drives=0)
        for assortment, count in sorted(sums.items())
    ]


def _grown(request: Request, work: MultipleJointPiece) -> Iterator[NDArray[np.int64]]:
    fewest, most = request.joints_range
    simple = [[1 << a | 1 << b for a, b in edges] for edges in work.simple]
    return grown_joints(work.links, simple, fewest=fewest, most=most)


def _joints_of(row: list[int]) -> list[list[int]]:
    """The links of the joints of a row of `grown_joints`."""
    return [[link for link in range(mask.bit_length()) if mask >> link & 1] for mask in row[1:] if mask]


def _orbits(chain: Chain) -> tuple[int, int, int]:
    """Orbits of links, of joints, and of (frame, joint at it, link that the joint drives)."""
    symmetries = symmetry(chain)
    drives = [
        (i, number, j)
        for number, joint in enumerate(chain.joints)
        for i in map(chain.index, joint.links)
        for j in map(chain.index, joint.links)
        if i != j
    ]
    images = [{(i, k, j): (g.links[i], g.joints[k], g.links[j]) for i, k, j in drives} for g in symmetries.generators]
    return len(symmetries.link_orbits), len(symmetries.joint_orbits), len(orbits_of(drives, images))


def add_tallies(request: Request, orbits: bool, tallies_of_pieces: Iterable[Iterable[PieceTally]]) -> ChainCount:
    """The sum of the numbers of all pieces."""
    by_assortment: dict[Assortment, int] = {}
    by_kind = dict.fromkeys(request.classes if request.fractionated != "all" else ("none", "link", "joint"), 0)
    sums = [0, 0, 0, 0]
    for tallies in tallies_of_pieces:
        for tally in tallies:
            if tally.chains:
                by_assortment[tally.assortment] = by_assortment.get(tally.assortment, 0) + tally.chains
            by_kind[tally.kind] += tally.chains
            counts = tally.chains, tally.inversions, tally.joint_orbits, tally.drives
            sums = [old + new for old, new in zip(sums, counts, strict=True)]
    chains, inversions, joint_orbits, drives = sums
    return ChainCount(
        links=request.links,
        mobility=request.mobility,
        chains=chains,
        by_assortment=dict(sorted(by_assortment.items())),
        inversions=inversions if orbits else None,
        drives=drives if orbits else None,
        joint_orbits=joint_orbits if orbits else None,
        by_fractionation=by_kind,
    )


@dataclass(frozen=True, slots=True)
class PieceLister:
    """Writes out a piece in a worker, in a format: graph6, text or json."""

    request: Request
    format: str

    def __call__(self, work: Work) -> list[PieceListing]:
        """The chains of a piece by class, written out."""
        if isinstance(work, WorkPiece) and self.format == "graph6":
            block = list_piece(work, "graph6")
            return [PieceListing("none", len(block), block.tobytes())]
        by_kind: dict[str, list[Joints]] = {}
        for kind, joints in self._joints(work):
            by_kind.setdefault(kind, []).append(joints)
        return [
            PieceListing(kind, len(chains), self._written(kind, chains)) for kind, chains in sorted(by_kind.items())
        ]

    def _joints(self, work: Work) -> Iterator[tuple[str, Joints]]:
        if isinstance(work, WorkPiece):
            yield from (("none", edges) for edges in list_piece(work).tolist())
        elif isinstance(work, MultipleJointPiece) and self.request.mobility < 2 and self.request.assortment is None:
            if "none" in self.request.classes:
                yield from (("none", _joints_of(row)) for block in _grown(self.request, work) for row in block.tolist())
        else:
            for kind, chain in chains_of_piece(self.request, work):
                yield kind, [[chain.index(link) for link in joint.links] for joint in chain.joints]

    def _written(self, kind: str, chains: list[Joints]) -> bytes:
        links = self.request.links
        if self.format == "graph6":
            return graph6_lines(np.array(chains, np.min_scalar_type(links)), links).tobytes()
        if self.format == "text":
            texts = (" ".join(f"R({'-'.join(map(str, links))})" for links in joints) for joints in chains)
        else:
            label = {"fractionation": kind} if self.request.fractionated == "all" else {}
            names = [str(i) for i in range(links)]
            head = {**label, "space": "planar", "links": names}
            documents = ([{"pair": "revolute", "links": [names[i] for i in each]} for each in c] for c in chains)
            texts = (json.dumps({**head, "joints": joints}) for joints in documents)
        return "".join(f"{text}\n" for text in texts).encode()
