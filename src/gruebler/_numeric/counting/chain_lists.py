"""Chains written out: one representative of every orbit of string assignments, as edges or as graph6.

The representative is the assignment that is lexicographically least among its images under the automorphisms
of the contracted graph; assignments come in lexicographic order, so no memory of earlier ones is needed
(orderly generation; R. C. Read, Every one a winner, Ann. Discrete Math. 2 (1978) 107-120).
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.packed_graph import GROUP, NODES, LabelMemory, label_packed, make_label_memory
from gruebler._numeric.counting.strings import (
    LANES,
    PreparedGraph,
    Values,
    WalkMemory,
    make_prepared_graph,
    make_values,
    make_walk_memory,
    next_strings,
    set_budgets,
    survey_strings,
)

Int64 = NDArray[np.int64]
UInt8 = NDArray[np.uint8]

# Entries of `ListMemory.state`, which lets a listing go on where the last block was full.
GRAPH: Final = 0  # the graph to go on with
OPENED: Final = 1  # 1 if it is already in the frame
ORDER: Final = 2  # its nodes, bundles, words of budgets, automorphisms
BUNDLES: Final = 3
WORDS: Final = 4
SYMMETRIES: Final = 5


class ListMemory(NamedTuple):
    """Everything `list_chains` needs besides the graphs."""

    frame: PreparedGraph
    values: Values
    pair_values: Values  # for two nodes alone, where F = 0 allows c = 3
    walk: WalkMemory
    labels: LabelMemory
    image: Int64  # node -> its image
    images: Int64  # (automorphism, bundle): its image
    state: Int64


def make_list_memory(loops: int, mobility: int) -> ListMemory:
    """Memory and tables for contracted graphs of so many loops and chains of this mobility."""
    return ListMemory(
        frame=make_prepared_graph(),
        values=make_values(loops + 1, mobility),
        pair_values=make_values(loops + 1, mobility, 3 if mobility == 0 else 2),
        walk=make_walk_memory(),
        labels=make_label_memory(),
        image=np.zeros(NODES, np.int64),
        images=np.zeros((GROUP, LANES), np.int64),
        state=np.zeros(6, np.int64),
    )


@njit(cache=True)
def _open(rows: Int64, mobility: int, desk: ListMemory) -> None:
    """Lay a contracted graph on the desk, before its first assignment."""
    frame, labels, image, state = desk.frame, desk.labels, desk.image, desk.state
    n, bundles, sets = survey_strings(rows, frame)
    group = label_packed(n, frame.near, rows, labels)
    for g in range(group):
        for i in range(n):
            image[labels.leaves[0, i]] = labels.leaves[g, i]
        for b in range(bundles):
            desk.images[g, b] = frame.at[image[frame.ends[0, b]], image[frame.ends[1, b]]]
    state[OPENED] = 1
    state[ORDER] = n
    state[BUNDLES] = bundles
    state[WORDS] = set_budgets(bundles, sets, 3 * n - 3 - mobility, frame, desk.walk)
    state[SYMMETRIES] = group
    for i in range(3):
        desk.walk.state[i, 0] = 0
    desk.walk.state[2, 0] = -1


@njit(cache=True)
def _is_first(bundles: int, group: int, images: Int64, value: Int64) -> bool:
    """Whether no automorphism makes the assignment lexicographically smaller."""
    for g in range(1, group):
        for b in range(bundles):
            difference = value[images[g, b]] - value[b]
            if difference > 0:
                break
            if difference < 0:
                return False
    return True


@njit(cache=True)
def _write(n: int, bundles: int, frame: PreparedGraph, weights: Int64, value: Int64, out: UInt8) -> None:
    """The edges of one chain: string by string, binary links numbered from n on as they come."""
    fresh = n
    joint = 0
    for b in range(bundles):
        k = frame.number[b]
        for i in range(k):
            here = frame.ends[0, b]
            for _ in range(weights[k, value[b], i]):
                out[joint, 0] = here
                out[joint, 1] = fresh
                joint += 1
                here = fresh
                fresh += 1
            out[joint, 0] = here
            out[joint, 1] = frame.ends[1, b]
            joint += 1


@njit(cache=True, nogil=True)
def list_chains(graphs: Int64, mobility: int, desk: ListMemory, out: UInt8) -> int:
    """Write out the chains of contracted graphs until they are done or the room is full.

    Args:
        graphs: int64[k, nodes], packed canonical graphs of one number of loops.
        mobility: F.
        desk: from `make_list_memory`; its state, 0 at the beginning, says where to go on.
        out: uint8[m, joints, 2], filled with edges; the links of a chain are the nodes of its contracted graph
            and then the binary links, string by string in the order of bundles.

    Returns:
        The number of chains written; fewer than m only if there are no more.

    Cost: about 200 ns for each chain.
    """
    state, walk, frame = desk.state, desk.walk, desk.frame
    value = walk.state[2]
    written = 0
    while state[GRAPH] < graphs.shape[0] and written < out.shape[0]:
        depth = 0
        if state[OPENED]:
            depth = state[BUNDLES]
        else:
            _open(graphs[state[GRAPH]], mobility, desk)
        n, bundles, words, group = state[ORDER], state[BUNDLES], state[WORDS], state[SYMMETRIES]
        values = desk.pair_values if n == 2 else desk.values
        more = words >= 0
        while more and written < out.shape[0]:
            more = next_strings(depth, bundles, words, 3 * n - 3 - mobility, mobility, frame.number, values, walk)
            depth = bundles
            if more and _is_first(bundles, group, desk.images, value):
                _write(n, bundles, frame, values.weights, value, out[written])
                written += 1
        if not more:
            state[GRAPH] += 1
            state[OPENED] = 0
    return written


def line_length(links: int) -> int:
    """The number of bytes of a graph6 line, its end included.

    >>> line_length(4), line_length(16)
    (3, 22)
    """
    return (1 if links <= 62 else 4) + (links * (links - 1) // 2 + 5) // 6 + 1


@njit(cache=True, nogil=True)
def begin_graph6(links: int, line: UInt8) -> int:
    """Write the number of vertices and no edge; where the edges begin."""
    line[:] = 63
    if links <= 62:
        line[0] = 63 + links
        return 1
    line[0] = 126
    line[2] = 63 + (links >> 6)
    line[3] = 63 + (links & 63)
    return 4


@njit(cache=True, nogil=True)
def add_graph6_edge(u: int, v: int, head: int, line: UInt8) -> None:
    """Add an edge to a line whose edges begin at `head`."""
    low, high = np.int64(min(u, v)), np.int64(max(u, v))
    place = high * (high - 1) // 2 + low
    line[head + place // 6] += 32 >> (place % 6)


@njit(cache=True, nogil=True)
def write_graph6(edges: UInt8, links: int, out: UInt8) -> None:
    """Turn the edges of chains into graph6 lines.

    Args:
        edges: uint8[m, joints, 2].
        links: number of vertices, at most 255.
        out: uint8[m, line_length(links)].

    Format: B. D. McKay, Description of graph6, sparse6 and digraph6 encodings.
    """
    end = out.shape[1] - 1
    for k in range(edges.shape[0]):
        head = begin_graph6(links, out[k, :end])
        out[k, end] = 10
        for j in range(edges.shape[1]):
            add_graph6_edge(edges[k, j, 0], edges[k, j, 1], head, out[k])
