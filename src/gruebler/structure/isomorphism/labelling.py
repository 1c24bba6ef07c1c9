"""Canonical labelling of coloured multigraphs, with their automorphism groups: the core's, for arrays of any integers.

Definitions and proofs: docs/theory/canonical-code.md; the search: core/src/labelling.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Int32 = NDArray[np.int32]


class CanonicalResult(NamedTuple):
    """What `canonical_form` finds.

    Attributes:
        labelling: int32[n], the canonical place of each vertex.
        generators: int32[k, n], k < n automorphisms that generate the group, one in each row.
        orbits: int32[n], the least vertex of the orbit of each vertex.
        order: the number of automorphisms.
    """

    labelling: Int32
    generators: Int32
    orbits: Int32
    order: int


def canonical_form(
    n: int,
    vertex_colour: NDArray[np.integer] | None,
    edges: NDArray[np.integer],
    edge_colour: NDArray[np.integer] | None = None,
) -> CanonicalResult:
    """Return the canonical labelling and the automorphism group of a coloured multigraph.

    Two graphs have equal forms (`relabelled`) exactly if a bijection of the vertices respects vertex colours and
    edge colours, parallel edges counted. Places ascend with the vertex colours.

    Args:
        n: number of vertices.
        vertex_colour: int[n], 0 <= colour < 2**31, or None for one colour.
        edges: int[m, 2], ends of each edge; parallel edges allowed, no loops.
        edge_colour: int[m], 0 <= colour < 2**31, or None for one colour.

    Raises:
        ValueError: an array of the wrong shape, an end or a colour out of range, a loop.

    Cost: one refinement, O(m log n), for a graph that it takes apart; exponential in n in the worst case. Theory:
    docs/theory/canonical-code.md.

    >>> square = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
    >>> canonical_form(4, None, square).order
    8
    >>> canonical_form(4, None, square, np.array([0, 0, 0, 1])).orbits.tolist()
    [0, 1, 1, 0]
    """
    from gruebler import _core

    ends, vertices, colours = _checked(n, vertex_colour, edges, edge_colour)
    labelling, generators, orbits, factors = _core.canonical_form(n, vertices, ends, colours)
    return CanonicalResult(labelling, generators, orbits, math.prod(factors.tolist()))


def _checked(
    n: int,
    vertex_colour: NDArray[np.integer] | None,
    edges: NDArray[np.integer],
    edge_colour: NDArray[np.integer] | None,
) -> tuple[Int32, NDArray[np.int64], Int32]:
    """Return edges, vertex colours and edge colours as the core wants them, or raise ValueError."""
    ends = np.asarray(edges)
    if ends.size == 0:
        ends = np.empty((0, 2), np.int32)
    vertices = np.zeros(n, np.int64) if vertex_colour is None else np.asarray(vertex_colour)
    colours = np.zeros(len(ends), np.int32) if edge_colour is None else np.asarray(edge_colour)
    if ends.ndim != 2 or ends.shape[1] != 2:
        raise ValueError(f"edges must have the shape (m, 2), got {ends.shape}")
    for name, values, length, bound in (
        ("edges", ends, len(ends), n),
        ("vertex_colour", vertices, n, 2**31),
        ("edge_colour", colours, len(ends), 2**31),
    ):
        if len(values) != length or (values is not ends and values.ndim != 1):
            raise ValueError(f"{name} must have the shape ({length},), got {values.shape}")
        if values.size and values.dtype.kind not in "iu":
            raise ValueError(f"{name} must be an array of integers, got {values.dtype}")
        if values.size and not (values.min() >= 0 and values.max() < bound):
            raise ValueError(f"{name} must lie in 0..{bound - 1}, got {values.min()}..{values.max()}")
    loops = np.flatnonzero(ends[:, 0] == ends[:, 1])
    if loops.size:
        raise ValueError(f"an edge must join two vertices; edge {loops[0]} is a loop at {ends[loops[0], 0]}")
    return (
        np.require(ends, np.int32, ["C"]),
        np.require(vertices, np.int64, ["C"]),
        np.require(colours, np.int32, ["C"]),
    )


def relabelled(
    labelling: Int32,
    vertex_colour: NDArray[np.integer],
    edges: NDArray[np.integer],
    edge_colour: NDArray[np.integer],
) -> tuple[tuple[int, ...], tuple[tuple[int, int, int], ...]]:
    """Return the form of a graph under a labelling: vertex colours by place, sorted edges (place, place, colour).

    >>> relabelled(np.array([1, 0, 2]), np.array([5, 6, 7]), np.array([[0, 1], [2, 1]]), np.array([3, 4]))
    ((6, 5, 7), ((0, 1, 3), (0, 2, 4)))
    """
    colours = np.empty(len(labelling), np.int64)
    colours[labelling] = vertex_colour
    places = np.sort(labelling[np.asarray(edges).reshape(-1, 2)], axis=1)
    rows = zip(places[:, 0].tolist(), places[:, 1].tolist(), np.asarray(edge_colour).tolist(), strict=True)
    return tuple(colours.tolist()), tuple(sorted(rows))
