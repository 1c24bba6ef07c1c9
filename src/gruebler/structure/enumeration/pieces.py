"""The work of an enumeration, divided into independent pieces.

A piece is plain data: some contracted graphs and the numbers of links and freedoms. `count_piece` and `list_piece` are
pure functions of a piece, so any worker can run a piece, and run it again; the pieces of a task and their order are
always the same.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import GrueblerError
from gruebler.structure.enumeration.assortment import Assortment, loop_count
from gruebler.structure.enumeration.contracted import MOST_LOOPS, packed_graphs

MOST_FREEDOMS = 24  # the kernels' products of binomial coefficients stay within 64 bits

Packed = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class WorkPiece:
    """A part of an enumeration: contracted graphs of one number of loops."""

    links: int
    mobility: int
    graphs: Packed
    """int64[k, nodes], packed and canonical."""
    work: int
    """The approximate number of string assignments to test; counting takes a nanosecond for each."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PieceTally:
    """The chains of one class and assortment in a piece, and the orbits on them (0 if not requested)."""

    kind: str
    assortment: Assortment
    chains: int
    inversions: int
    joint_orbits: int
    drives: int


def refuse_too_large(links: int, mobility: int) -> None:
    """Raise `GrueblerError` for more loops or freedoms than the kernels can process."""
    loops = loop_count(links, mobility)
    if loops is not None and (loops > MOST_LOOPS or mobility > MOST_FREEDOMS):
        raise GrueblerError(
            "{links} links with mobility {mobility} make {loops} loops; chains are enumerated up to "
            "{most_loops} loops and mobility {most_freedoms}",
            links=links,
            mobility=mobility,
            loops=loops,
            most_loops=MOST_LOOPS,
            most_freedoms=MOST_FREEDOMS,
        )


def pieces(
    links: int, mobility: int, *, assortment: Sequence[int] | None = None, size: int = 50_000_000
) -> Iterator[WorkPiece]:
    """The non-fractionated chains of n links and mobility F, at least two loops, in pieces of similar work.

    Args:
        links: number of links, n.
        mobility: F.
        assortment: (n_2, n_3, ...), to restrict the chains to this assortment.
        size: the work of a piece, as `WorkPiece.work`; a contracted graph is not divided.

    Chains of one loop have no contracted graph and no piece; impossible numbers give no piece either.

    Raises:
        GrueblerError: invalid numbers, or more loops or freedoms than the kernels can process.
    """
    loops = loop_count(links, mobility)
    if loops is None or loops < 2:
        return iter(())
    refuse_too_large(links, mobility)
    return _cut(links, mobility, None if assortment is None else tuple(assortment), size)


def _cut(links: int, mobility: int, assortment: Assortment | None, size: int) -> Iterator[WorkPiece]:
    loops = loop_count(links, mobility)
    assert loops is not None
    waiting: list[Packed] = []
    load = 0
    for block in packed_graphs(loops):
        rows = block[:, : 2 * loops - 2]
        if assortment is not None:
            rows = rows[_has_degrees(rows, assortment)]
        begin = 0
        total = load + np.cumsum(work_of_graphs(rows))
        while begin < len(rows):
            end = min(int(np.searchsorted(total, size)) + 1, len(rows))
            waiting.append(rows[begin:end])
            load, begin = int(total[end - 1]), end
            if load >= size:
                yield WorkPiece(links, mobility, np.concatenate(waiting), load)
                total -= load
                waiting, load = [], 0
    if waiting:
        yield WorkPiece(links, mobility, np.concatenate(waiting), load)


def strings_of_graphs(rows: Packed) -> NDArray[np.int64]:
    """int64[k, nodes, nodes]: the numbers of strings between nodes."""
    nodes = np.arange(rows.shape[1])
    fields = np.where(np.count_nonzero(rows, axis=1) > 16, 3, 4)[:, None, None]
    strings: NDArray[np.int64] = rows[:, :, None] >> (fields * nodes) & (1 << fields) - 1
    return strings


def work_of_graphs(rows: Packed) -> NDArray[np.int64]:
    """For each graph the number of assignments of c = 0, 1, 2 to its bundles with the sum 3V - 4, and a fixed cost.

    That is the number of assignments if no set of nodes could be rigid, one to five times too many. For the
    graphs that take most of the time counting costs 0.5 to 1 ns for each (seven and eight loops, F = 1).
    """
    bundles = np.count_nonzero(strings_of_graphs(rows), axis=(1, 2)) // 2
    assignments: NDArray[np.int64] = _trinomials()[bundles, 3 * np.count_nonzero(rows, axis=1) - 4] + 5000
    return assignments


@cache
def _trinomials() -> NDArray[np.int64]:
    """The coefficient of x^s in (1 + x + x^2)^b, for b up to the 27 bundles of ten loops."""
    table = np.zeros((28, 55), np.int64)
    table[0, 0] = 1
    for b in range(1, len(table)):
        table[b] = table[b - 1]
        table[b, 1:] += table[b - 1, :-1]
        table[b, 2:] += table[b - 1, :-2]
    return table


def _has_degrees(rows: Packed, assortment: Assortment) -> NDArray[np.bool_]:
    """Whether each graph has these numbers of nodes of three, four, ... strings; its degrees are descending."""
    degrees = [i for i, k in enumerate(assortment, 2) if i > 2 for _ in range(k)][::-1]
    if len(degrees) > rows.shape[1]:
        return np.zeros(len(rows), np.bool_)
    row = np.array(degrees + [0] * (rows.shape[1] - len(degrees)), np.int64)
    matches: NDArray[np.bool_] = (strings_of_graphs(rows).sum(axis=2) == row).all(axis=1)
    return matches


def census(piece: WorkPiece, orbits: bool) -> NDArray[np.int64]:
    """The numbers of chains of each contracted graph: int64[k, 5], degrees, chains, inversions, orbits, drives."""
    from gruebler import _core

    loops = loop_count(piece.links, piece.mobility)
    assert loops is not None
    return _core.take_census(np.ascontiguousarray(piece.graphs), loops, piece.mobility, orbits)


def count_piece(piece: WorkPiece, orbits: bool = False) -> list[PieceTally]:
    """The numbers of chains of a piece by assortment, with orbits if requested.

    Raises:
        OverflowError: a number beyond 64 bits.
    """
    table = census(piece, orbits)
    counts = []
    for code in np.unique(table[:, 0]):
        higher = []
        remaining = int(code)  # five bits a degree, from 3 on: how many nodes have it
        while remaining:
            higher.append(remaining & 31)
            remaining >>= 5
        rows = table[table[:, 0] == code, 1:]
        chains, inversions, joint_orbits, drives = rows.sum(axis=0).tolist()
        counts.append(
            PieceTally(
                kind="none",
                assortment=(piece.links - sum(higher), *higher),
                chains=chains,
                inversions=inversions,
                joint_orbits=joint_orbits,
                drives=drives,
            )
        )
    return counts


def list_piece(piece: WorkPiece, form: str = "edges") -> NDArray[np.uint8]:
    """The chains of a piece in canonical order.

    Args:
        piece: the piece.
        form: ``edges`` for uint8[k, joints, 2], ``graph6`` for uint8[k, bytes of a line].
    """
    from gruebler import _core

    loops = loop_count(piece.links, piece.mobility)
    assert loops is not None
    write = _core.list_graph6 if form == "graph6" else _core.list_chains
    return write(np.ascontiguousarray(piece.graphs), loops, piece.mobility)


def graph6_lines(edges: NDArray[np.unsignedinteger[Any]], links: int) -> NDArray[np.uint8]:
    """Chains as lines of graph6, line ends included: uint8[k, bytes of a line] from [k, joints, 2]."""
    from gruebler import _core

    return _core.write_graph6(np.ascontiguousarray(edges, np.uint8), links)
