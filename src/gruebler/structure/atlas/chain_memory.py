"""The memory in which the kernels describe one chain after another, and the columns of numbers that they fill.

A chain is a graph here: the links are the vertices 0 to n - 1, the multiple joints the vertices from n on, a joint of
two links is an edge, and a multiple joint has an edge to each of its links. Definitions: docs/theory/atlas.md.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.labelling.label_workspace import Workspace, make_workspace

Int32 = NDArray[np.int32]
Int64 = NDArray[np.int64]
UInt8 = NDArray[np.uint8]

MOST_LINKS: Final = 40  # sets of links are bits of a word
MOST_MEMBERS: Final = 9  # links of a joint: its ranks are the digits of a word
DIGIT: Final = 6  # bits of a digit
_CYCLES: Final = 4096  # a chain of L loops has fewer than 2^L circuits among its links of three joints and more
_SETS: Final = 4096  # what is left after taking dyads away, in all orders

# Columns of numbers.
GROUP_ORDER: Final = 0
INVERSIONS: Final = 1
JOINT_ORBITS: Final = 2
DRIVES: Final = 3
GIRTH: Final = 4
CIRCUMFERENCE: Final = 5
DIAMETER: Final = 6
DYADIC: Final = 7
COLUMNS: Final = 8


class ChainMemory(NamedTuple):
    """Everything `chain_kernels.describe_chains` needs besides the chains."""

    workspace: Workspace
    vertex_colour: Int64
    edge_colour: Int32
    indptr: Int32
    neighbour: Int32
    row_colour: Int32
    members: Int64  # joint -> its links, as bits
    kinds: Int64  # joint -> place of its pair
    near: Int64  # vertex -> its neighbours, as bits; for links: the links that share a joint with it
    keys: Int64  # joint -> its ranks, as digits
    order: Int64  # place in canonical order -> joint
    rank: Int64  # link -> canonical number
    parent: Int32  # (1, element): of sets that are united
    image: Int64
    node: Int64  # vertex -> number among those of three edges or more, else -1
    table: Int64  # (5, nodes, nodes): strings, shortest, second shortest, longest, second longest
    before: Int64  # (nodes, nodes): strings of the chain before
    cycles: Int64  # circuits of the chain before, as bits of bundles
    place: Int64  # (nodes, nodes) -> bundle
    path: Int64
    sets: Int64  # (2, many): what is left after so many dyads
    ends: Int64  # (2, joints): the links of the joints in canonical order
    forest: Int64  # element -> its forest, -1
    forest_near: Int64  # (forest, link): its neighbours, as bits
    element: Int64  # (forest, link, link)
    label: Int64  # element -> the element before
    queue: Int64
    state: Int64


def make_chain_memory(vertices: int, edges: int) -> ChainMemory:
    """Memory for chains of at most so many vertices and edges."""
    size = vertices + 1
    return ChainMemory(
        workspace=make_workspace(vertices, edges),
        vertex_colour=np.zeros(size, np.int64),
        edge_colour=np.zeros(edges + 1, np.int32),
        indptr=np.zeros(size + 1, np.int32),
        neighbour=np.zeros(2 * edges + 1, np.int32),
        row_colour=np.zeros(2 * edges + 1, np.int32),
        members=np.zeros(edges + 1, np.int64),
        kinds=np.zeros(edges + 1, np.int64),
        near=np.zeros(size, np.int64),
        keys=np.zeros(edges + 1, np.int64),
        order=np.zeros(edges + 1, np.int64),
        rank=np.zeros(size, np.int64),
        parent=np.zeros((1, size * size), np.int32),
        image=np.zeros(size, np.int64),
        node=np.zeros(size, np.int64),
        table=np.zeros((5, size, size), np.int64),
        before=np.zeros((size, size), np.int64),
        cycles=np.zeros(_CYCLES, np.int64),
        place=np.zeros((size, size), np.int64),
        path=np.zeros((4, size + 1), np.int64),
        sets=np.zeros((2, _SETS), np.int64),
        ends=np.zeros((2, edges + 1), np.int64),
        forest=np.zeros(2 * edges + 2, np.int64),
        forest_near=np.zeros((3, size), np.int64),
        element=np.zeros((3, size, size), np.int64),
        label=np.zeros(2 * edges + 2, np.int64),
        queue=np.zeros(2 * edges + 2, np.int64),
        state=np.zeros(4, np.int64),
    )
