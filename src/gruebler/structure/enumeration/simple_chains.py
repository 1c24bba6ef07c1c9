"""Chains with simple joints in blocks.

The order is always the same: contracted graphs as `contracted.packed_graphs` yields them, the chains of each in
lexicographic order of the weights of its bundles. Each chain appears once; its links are the nodes of the
contracted graph, then the binary links string by string.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from functools import partial

import numpy as np
from numpy.typing import NDArray

from gruebler.structure.chain import Chain
from gruebler.structure.enumeration.assortment import loop_count
from gruebler.structure.enumeration.contracted import ContractedGraph, pack
from gruebler.structure.enumeration.pieces import WorkPiece, graph6_lines, list_piece, pieces
from gruebler.structure.enumeration.worker_pool import run_work

LAZY = 100_000  # work of a piece when chains are requested one by one: a few thousand chains
_BULK = 200_000  # ... and in bulk: some ten thousand chains, a megabyte or two


def chains_of(graph: ContractedGraph, mobility: int = 1) -> Iterator[Chain]:
    """The chains of mobility F that have this contracted graph, each once; n = 2 loops + 1 + F.

    >>> square = ContractedGraph(((0, 1, 2), (1, 2, 1), (2, 3, 2), (3, 0, 1)))
    >>> len(list(chains_of(square)))
    3
    """
    links = 2 * graph.loops + 1 + mobility
    edges = list_piece(WorkPiece(links, mobility, pack([graph]), _BULK))
    return (chain_of_edges(links, joints) for joints in edges.tolist())


def edge_blocks(
    links: int,
    mobility: int = 1,
    *,
    assortment: Sequence[int] | None = None,
    executor: Executor | None = None,
) -> Iterator[NDArray[np.uint8]]:
    """The chains that are not fractionated, in bulk: arrays uint8[k, joints, 2] of links that share a joint.

    Args:
        links: number of links, n.
        mobility: F >= 0; with F = 0 the chains are the Baranov trusses.
        assortment: only chains with these numbers of binary, ternary, ... links.
        executor: runs the pieces of the work; by default this process.

    Cost about 250 ns for each chain on one core.

    >>> [block.shape for block in edge_blocks(8)]
    [(16, 10, 2)]
    """
    return _blocks(links, mobility, assortment, executor, "edges", _BULK)


def graph6_blocks(
    links: int,
    mobility: int = 1,
    *,
    assortment: Sequence[int] | None = None,
    executor: Executor | None = None,
) -> Iterator[NDArray[np.uint8]]:
    r"""The same chains in bulk as graph6: arrays uint8[k, bytes of a line], line ends included.

    A block can be written directly to a file (`block.tofile(file)`). Cost about 350 ns for each chain on one
    core: 16 links, 19.8 million lines of 22 bytes, take 7 s.

    >>> b"".join(block.tobytes() for block in graph6_blocks(6))
    b'Er`G\nE]`G\n'
    """
    return _blocks(links, mobility, assortment, executor, "graph6", _BULK)


def _blocks(
    links: int, mobility: int, assortment: Sequence[int] | None, executor: Executor | None, form: str, size: int
) -> Iterator[NDArray[np.uint8]]:
    work = pieces(links, mobility, assortment=assortment, size=size)
    if loop_count(links, mobility) == 1 and (assortment is None or tuple(assortment) == (links,)):
        return iter([_ring(links, form)])
    return (block for block in run_work(partial(list_piece, form=form), work, executor) if len(block))


def _ring(links: int, form: str) -> NDArray[np.uint8]:
    """The chain of one loop, in a block of its own."""
    link = np.arange(links)
    edges = np.stack([link, (link + 1) % links], axis=1).astype(np.uint8)[None]
    return edges if form == "edges" else graph6_lines(edges, links)


def chain_of_edges(links: int, edges: list[list[int]]) -> Chain:
    """The chain of simple revolute joints with links 0, 1, 2, ..."""
    return Chain([("revolute", edge) for edge in edges], links=range(links))
