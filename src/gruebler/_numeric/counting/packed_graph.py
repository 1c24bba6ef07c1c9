"""Loopless multigraphs of at most 16 vertices in 16 words: one row a vertex, four bits a neighbour.

Bits 4u..4u+3 of row v hold the number of edges between u and v (at most 15), so that a graph is copied,
changed and compared in a few instructions. The labelling below is not the one of
`gruebler._numeric.labelling.canonical`: the enumeration needs every automorphism written out, not a set of generators,
and most of these tiny graphs fall apart at the first refinement, so that a search without any pruning, straight on the
packed rows, takes 0.8 us a graph where the general one takes 1.4 us (seven loops). It visits a leaf for every
automorphism at least, which is why the room for them is bounded by GROUP.

Definitions: docs/theory/enumeration.md, "Contracted graphs".
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import for_work, njit
from gruebler._numeric.counting.bits import lowest
from gruebler._numeric.work_estimates import packed_labelling

Int64 = NDArray[np.int64]

NODES: Final = 16  # vertices a packed graph can have
PAIRS: Final = NODES * (NODES - 1) // 2
GROUP: Final = 4096  # automorphisms there is room for; K(4,4), the most symmetric graph with nine loops, has 1152
FRACTION: Final = 0x3FFFFFFFFFFFFFF  # the low 58 bits of a sorting key; the colour stands above them


def _mixers() -> Int64:
    """One fixed random word for every (colour, number of edges): the outputs of splitmix64 from state 0."""
    mask = (1 << 64) - 1
    words = []
    for i in range(1, 257):
        z = (i * 0x9E3779B97F4A7C15) & mask
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        words.append(z ^ (z >> 31))
    return np.array(words, np.uint64).view(np.int64)


MIX: Final = _mixers()


class LabelMemory(NamedTuple):
    """Memory of one labelling; `best` and `leaves` hold its answer."""

    colours: Int64  # (level, vertex): first place of the cell of the vertex
    orders: Int64  # (level, place): the vertex there
    key: Int64
    stack: Int64  # rows: a trial row of words, then start, next member, size and number of cells by level
    best: Int64  # the canonical rows
    leaves: Int64  # (automorphism, place): the vertex that a best leaf puts there


def make_label_memory() -> LabelMemory:
    """Memory for `label_packed`."""
    return LabelMemory(
        colours=np.zeros((NODES + 1, NODES), np.int64),
        orders=np.zeros((NODES + 1, NODES), np.int64),
        key=np.zeros(NODES, np.int64),
        stack=np.zeros((5, NODES + 1), np.int64),
        best=np.zeros(NODES, np.int64),
        leaves=np.zeros((GROUP, NODES), np.int64),
    )


@njit(cache=True)
def bundle_strings(rows: Int64, u: int, v: int) -> int:
    """The number of edges between u and v."""
    return int((rows[u] >> (v << 2)) & 15)


@njit(cache=True)
def survey_graph(n: int, rows: Int64, near: Int64, degree: Int64) -> None:
    """For every vertex the set of its neighbours, as bits, and its degree."""
    for v in range(n):
        row = rows[v]
        bits = 0
        total = 0
        for u in range(n):
            number = (row >> (u << 2)) & 15
            if number:
                bits |= 1 << u
                total += number
        near[v] = bits
        degree[v] = total


@njit(cache=True)
def order_of(rows: Int64) -> int:
    """The number of vertices: no vertex of a contracted graph has an empty row."""
    n = 0
    while n < rows.shape[0] and rows[n]:
        n += 1
    return n


@njit(cache=True)
def _refine(n: int, near: Int64, rows: Int64, colour: Int64, order: Int64, key: Int64, cells: int) -> int:
    """Split cells by the colours around each vertex until nothing splits; returns the number of cells.

    Two neighbourhoods with the same 58-bit sum would stay together; that costs a branch, not the result,
    since the sum depends on colours and numbers of edges only.
    """
    while cells < n:
        for v in range(n):
            total = 0
            bits = near[v]
            row = rows[v]
            while bits:
                u = lowest(bits)
                bits &= bits - 1
                total += MIX[(colour[u] << 4) | ((row >> (u << 2)) & 15)]
            key[v] = (colour[v] << 58) | ((total >> 6) & FRACTION)
        for i in range(1, n):
            v = order[i]
            j = i
            while j > 0 and key[order[j - 1]] > key[v]:
                order[j] = order[j - 1]
                j -= 1
            order[j] = v
        found = 1
        start = 0
        last = key[order[0]]
        for i in range(n):
            v = order[i]
            if key[v] != last:
                last = key[v]
                start = i
                found += 1
            colour[v] = start
        if found == cells:
            break
        cells = found
    return cells


@njit(cache=True)
def _first_cells(n: int, rows: Int64, labels: LabelMemory) -> int:
    """Cells of equal degree, the largest degree first; returns their number."""
    key, order, colour = labels.key, labels.orders[0], labels.colours[0]
    for v in range(n):
        degree = 0
        for u in range(n):
            degree += (rows[v] >> (u << 2)) & 15
        key[v] = -degree
        j = v
        while j > 0 and key[order[j - 1]] > key[v]:
            order[j] = order[j - 1]
            j -= 1
        order[j] = v
    cells = 1
    start = 0
    for i in range(n):
        if i > 0 and key[order[i]] != key[order[i - 1]]:
            start = i
            cells += 1
        colour[order[i]] = start
    return cells


@njit(cache=True)
def _compare_leaf(
    n: int, near: Int64, rows: Int64, order: Int64, colour: Int64, labels: LabelMemory, first: bool
) -> int:
    """1, 0, -1 if this leaf writes the graph with greater, the same, smaller rows than the best so far.

    The rows are compared as unsigned words; those of a greater leaf replace the best ones.
    """
    trial, best = labels.stack[0], labels.best
    sign = 1 if first else 0
    for i in range(n):
        v = order[i]
        bits = near[v]
        word = 0
        while bits:
            u = lowest(bits)
            bits &= bits - 1
            word |= ((rows[v] >> (u << 2)) & 15) << (colour[u] << 2)
        trial[i] = word
        if sign == 0 and word != best[i]:
            if np.uint64(word) < np.uint64(best[i]):
                return -1
            sign = 1
    if sign > 0:
        for i in range(n):
            best[i] = trial[i]
    return sign


@njit(cache=True)
def label_packed(n: int, near: Int64, rows: Int64, labels: LabelMemory) -> int:
    """Find the canonical rows and all automorphisms of a graph; returns the number of automorphisms.

    Args:
        n: number of vertices, 2 to 16.
        near: int64[n], neighbours as bits, as `survey_graph` gives them.
        rows: int64[n], the packed graph.
        labels: from `make_label_memory`. Afterwards `labels.best` holds the canonical rows, degrees falling, and the
            automorphisms send `labels.leaves[0, i]` to `labels.leaves[k, i]`, the identity being k = 0.

    Raises:
        ValueError: more than GROUP automorphisms.

    Individualisation and refinement (McKay 1981), every leaf visited: at least as many as automorphisms.
    """
    start, member, size, cells = labels.stack[1], labels.stack[2], labels.stack[3], labels.stack[4]
    found = 0
    level = 0
    cells[0] = _refine(n, near, rows, labels.colours[0], labels.orders[0], labels.key, _first_cells(n, rows, labels))
    fresh = True
    while level >= 0:
        order, colour = labels.orders[level], labels.colours[level]
        if fresh and cells[level] == n:
            sign = _compare_leaf(n, near, rows, order, colour, labels, found == 0)
            if sign > 0:
                found = 0
            if sign >= 0:
                if found == labels.leaves.shape[0]:
                    raise ValueError("a contracted graph has more automorphisms than there is room for")
                for i in range(n):
                    labels.leaves[found, i] = order[i]
                found += 1
            level -= 1
            fresh = False
            continue
        if fresh:  # the first of the smallest cells with more than one vertex
            start[level] = -1
            i = 0
            while i < n:
                j = i + 1
                while j < n and colour[order[j]] == i:
                    j += 1
                if j - i > 1 and (start[level] < 0 or j - i < size[level]):
                    start[level] = i
                    size[level] = j - i
                i = j
            member[level] = 0
            fresh = False
        if member[level] == size[level]:
            level -= 1
            continue
        s = start[level]
        t = s + member[level]
        member[level] += 1
        deeper, shade = labels.orders[level + 1], labels.colours[level + 1]
        for i in range(n):
            deeper[i] = order[i]
            shade[i] = colour[i]
        deeper[t] = order[s]
        deeper[s] = order[t]
        for i in range(s + 1, s + size[level]):
            shade[deeper[i]] = s + 1
        cells[level + 1] = _refine(n, near, rows, shade, deeper, labels.key, cells[level] + 1)
        level += 1
        fresh = True
    return found


def canonical_rows(rows: Int64) -> Int64:
    """int64[16]: the canonical rows of one packed graph."""
    labels, near, degree = make_label_memory(), np.zeros(NODES, np.int64), np.zeros(NODES, np.int64)
    n = order_of(rows)
    for_work(survey_graph, packed_labelling() / 10)(n, rows, near, degree)
    for_work(label_packed, packed_labelling())(n, near, rows, labels)
    labels.best[n:] = 0
    return labels.best


def find_automorphisms(rows: Int64) -> Int64:
    """int64[k, n]: the automorphisms of one packed graph, as images of its vertices."""
    labels, near, degree = make_label_memory(), np.zeros(NODES, np.int64), np.zeros(NODES, np.int64)
    n = order_of(rows)
    for_work(survey_graph, packed_labelling() / 10)(n, rows, near, degree)
    found = for_work(label_packed, packed_labelling())(n, near, rows, labels)
    images = np.zeros((found, n), np.int64)
    images[:, labels.leaves[0, :n]] = labels.leaves[:found, :n]
    return images
