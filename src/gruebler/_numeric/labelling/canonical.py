"""Canonical labelling of coloured multigraphs, with their automorphism groups.

Individualisation and refinement after McKay: the leaves of a search tree are the numberings that refinement
yields when it is told one vertex after another; the canonical one is the leaf with the least (traces, form).
Definitions and proofs: docs/theory/canonical-code.md. Sources: B. D. McKay, Practical graph isomorphism,
Congr. Numer. 30 (1981) 45-87; B. D. McKay and A. Piperno, Practical graph isomorphism II, J. Symb. Comput. 60
(2014) 94-112; for automorphisms guessed before a leaf is reached P. T. Darga, K. A. Sakallah and I. L. Markov,
Faster symmetry discovery using sparsity of symmetries, Proc. DAC (2008) 149-154.

The parts: `partition` (refinement), `automorphism` (exact comparisons), `search_tree` (the search), and here
what the rooms above and other kernels call.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import for_work, njit
from gruebler._numeric.labelling.label_workspace import (
    BEST_LAB,
    CELLS,
    COLOURED_GRAPH,
    COUNT,
    FACTOR,
    FACTORS,
    FLAG,
    GENERATORS,
    IMAGE_OF,
    LABELLING,
    MOVED,
    ORBIT,
    OVERFLOW,
    POS,
    START,
    STATE_SIZE,
    THOROUGH,
    TRAIL,
    WORKSPACE,
    Int32,
    Int64,
    Workspace,
    make_workspace,
    signature,
)
from gruebler._numeric.labelling.partition import first_partition, refine, undo
from gruebler._numeric.labelling.search_tree import search_leaves
from gruebler._numeric.work_estimates import labelling


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


@njit(signature(FLAG, COUNT, *COLOURED_GRAPH, WORKSPACE), cache=True)
def label_graph(
    n: int, vertex_colour: Int64, indptr: Int32, neighbour: Int32, edge_colour: Int32, ws: Workspace
) -> bool:
    """Label one graph canonically and leave the answer in the workspace; for use in other kernels.

    The answer: `ws.rows[LABELLING, :n]`, `ws.rows[ORBIT, :n]`; the group order is the product of
    `ws.rows[FACTOR, :ws.state[FACTORS]]` (a product that may not fit any machine integer); generator i of
    `ws.state[GENERATORS]` maps `ws.pool[MOVED, a:b]` to `ws.pool[IMAGE_OF, a:b]` with a, b =
    `ws.rows[START, i]`, `ws.rows[START, i + 1]`, and fixes all else.

    Args:
        n: number of vertices.
        vertex_colour: int64[n], 0 <= colour < 2**31; places ascend with the colours.
        indptr: int32[n + 1], bounds of the rows of neighbours.
        neighbour: int32, the other ends; every edge stands in two rows; parallel edges, no loops.
        edge_colour: int32, >= 0, parallel to `neighbour`.
        ws: made by `make_workspace` for at least this n and this number of edges.

    Returns:
        True if all generators found room. If False, labelling, orbits and order are right all the same; only
        the list of generators is too short.

    Cost: one refinement, O(m log n), for a graph that it takes apart; exponential in n in the worst case.
    """
    state, rows = ws.state, ws.rows
    for i in range(STATE_SIZE):
        state[i] = 0
    first_partition(n, vertex_colour, indptr, neighbour, edge_colour, ws)
    if state[CELLS] < n:
        refine(n, indptr, neighbour, 0, False, False, ws)
    if state[CELLS] == n:
        for v in range(n):
            rows[LABELLING, v] = rows[POS, v]
            rows[ORBIT, v] = v
        return True
    mark = state[TRAIL]
    while not search_leaves(n, vertex_colour, indptr, neighbour, edge_colour, ws):
        undo(mark, ws)
        state[THOROUGH] = 1
    for i in range(n):
        rows[LABELLING, rows[BEST_LAB, i]] = i
    for v in range(n):
        rows[ORBIT, v] = rows[ORBIT, rows[ORBIT, v]]  # roots are least: smaller vertices are done already
    return bool(state[OVERFLOW] == 0)


@njit(cache=True)
def adjacency(n: int, edges: Int32, colour: Int32, indptr: Int32, neighbour: Int32, edge_colour: Int32) -> None:
    """Write the rows of the neighbours of each vertex, from edges int32[m, 2] and their colours int32[m]."""
    m = edges.shape[0]
    for v in range(n + 1):
        indptr[v] = 0
    for i in range(m):
        indptr[edges[i, 0]] += 1
        indptr[edges[i, 1]] += 1
    total = 0
    for v in range(n):
        total += indptr[v]
        indptr[v] = total
    indptr[n] = total
    for i in range(m):
        for side in range(2):
            v = edges[i, side]
            indptr[v] -= 1
            neighbour[indptr[v]] = edges[i, 1 - side]
            edge_colour[indptr[v]] = colour[i]


@njit(cache=True, nogil=True)
def _label_all(n: int, edges: Int32, bounds: Int64, widest: int, ws: Workspace, labellings: Int32) -> None:
    vertex_colour = np.zeros(n, np.int64)
    colour = np.zeros(widest, np.int32)
    indptr = np.empty(n + 1, np.int32)
    neighbour = np.empty(2 * widest, np.int32)
    edge_colour = np.empty(2 * widest, np.int32)
    for i in range(bounds.size - 1):
        adjacency(n, edges[bounds[i] : bounds[i + 1]], colour, indptr, neighbour, edge_colour)
        label_graph(n, vertex_colour, indptr, neighbour, edge_colour, ws)
        for v in range(n):
            labellings[i, v] = ws.rows[LABELLING, v]


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

    Cost: see `label_graph`. Theory: docs/theory/canonical-code.md.

    >>> square = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
    >>> canonical_form(4, None, square).order
    8
    >>> canonical_form(4, None, square, np.array([0, 0, 0, 1])).orbits.tolist()
    [0, 1, 1, 0]
    """
    ends, vertices, colours = _checked(n, vertex_colour, edges, edge_colour)
    m = len(ends)
    indptr = np.empty(n + 1, np.int32)
    neighbour = np.empty(2 * m, np.int32)
    row_colour = np.empty(2 * m, np.int32)
    work = labelling(n, m)
    for_work(adjacency, work / 20)(n, ends, colours, indptr, neighbour, row_colour)
    ws = make_workspace(n, m)
    label = for_work(label_graph, work)
    while not label(n, vertices, indptr, neighbour, row_colour, ws):
        ws = make_workspace(n, m, 4 * ws.pool.shape[1])
    count = int(ws.state[GENERATORS])
    generators = np.tile(np.arange(n, dtype=np.int32), (count, 1))
    for i in range(count):
        part = slice(ws.rows[START, i], ws.rows[START, i + 1])
        generators[i, ws.pool[MOVED, part]] = ws.pool[IMAGE_OF, part]
    return CanonicalResult(
        labelling=ws.rows[LABELLING, :n].copy(),
        generators=generators,
        orbits=ws.rows[ORBIT, :n].copy(),
        order=math.prod(ws.rows[FACTOR, : ws.state[FACTORS]].tolist()),
    )


def _checked(
    n: int,
    vertex_colour: NDArray[np.integer] | None,
    edges: NDArray[np.integer],
    edge_colour: NDArray[np.integer] | None,
) -> tuple[Int32, Int64, Int32]:
    """Return edges, vertex colours and edge colours as the kernel wants them, or raise ValueError."""
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
        if values.size and not (0 <= values.min() and values.max() < bound):
            raise ValueError(f"{name} must lie in 0..{bound - 1}, got {values.min()}..{values.max()}")
    loops = np.flatnonzero(ends[:, 0] == ends[:, 1])
    if loops.size:
        raise ValueError(f"an edge must join two vertices; edge {loops[0]} is a loop at {ends[loops[0], 0]}")
    return (
        np.require(ends, np.int32, ["C", "W"]),
        np.require(vertices, np.int64, ["C", "W"]),
        np.require(colours, np.int32, ["C", "W"]),
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


def canonical_bulk(n: int, edges: NDArray[np.integer], bounds: Int64 | None = None) -> Int32:
    """Return the canonical labellings of many graphs of n vertices, of one vertex and one edge colour.

    Args:
        n: number of vertices of every graph.
        edges: int32[graphs, m, 2]; or int32[total, 2], the edges of all graphs one after another.
        bounds: int64[graphs + 1], needed for the second form: graph i has `edges[bounds[i]:bounds[i + 1]]`.

    Returns:
        int32[graphs, n]: row i holds the canonical place of each vertex of graph i.

    Raises:
        ValueError: a wrong shape, an end out of range, a loop, bounds that do not ascend from 0 to the total.

    Cost: about a microsecond for a chain of 10 to 16 links.

    >>> paths = np.array([[[0, 1], [1, 2]], [[0, 1], [0, 2]]])  # the middle is vertex 1, then vertex 0
    >>> place = canonical_bulk(3, paths)
    >>> bool(place[0, 1] == place[1, 0])
    True
    """
    packed = np.asarray(edges)
    if bounds is None:
        if packed.ndim != 3 or packed.shape[2] != 2:
            raise ValueError(f"edges without bounds must have the shape (graphs, m, 2), got {packed.shape}")
        limits = np.arange(packed.shape[0] + 1, dtype=np.int64) * packed.shape[1]
        packed = packed.reshape(-1, 2)
    else:
        limits = np.require(bounds, np.int64, ["C", "W"])
    ends, _, _ = _checked(n, None, packed, None)
    if limits.size == 0 or limits[0] != 0 or limits[-1] != len(ends) or (np.diff(limits) < 0).any():
        raise ValueError(f"bounds must ascend from 0 to the number of edges {len(ends)}")
    widest = int(np.diff(limits).max(initial=0))
    labellings = np.empty((limits.size - 1, n), np.int32)
    label = for_work(_label_all, len(labellings) * labelling(n, widest))
    label(n, ends, limits, widest, make_workspace(n, widest), labellings)
    return labellings
