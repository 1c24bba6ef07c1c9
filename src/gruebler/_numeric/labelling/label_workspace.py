"""The memory of the canonical labelling: which row of which array holds what.

A workspace is made once, by `make_workspace`, and then labels any number of graphs without allocating.
"""

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

Int32 = NDArray[np.int32]
Int64 = NDArray[np.int64]
UInt64 = NDArray[np.uint64]


class Workspace(NamedTuple):
    """All memory of one labelling, made by `make_workspace`, used for any number of graphs.

    Five arrays with named rows, and not one array for each name: numba counts references, with an atomic
    addition for every array that a call hands on or a row that is viewed, and for a graph of a dozen vertices
    that would cost more than the labelling. For the same reason the rows are indexed and not viewed.

    Attributes:
        state: int64, the counters below.
        rows: int32[ROWS, n + 1], by vertex, place, or level of the search tree.
        words: uint64[WORD_ROWS, n + 1], likewise.
        ends: uint64[END_ROWS, 2m + 1], by end of an edge.
        pool: int32[3, size], the automorphisms: vertices moved, their images; and what a sort carries along.
    """

    state: Int64
    rows: Int32
    words: UInt64
    ends: UInt64
    pool: Int32


# Rows of `Workspace.rows`: first the answer, good until the next graph is labelled,
LABELLING: Final = 0  # vertex -> canonical place
ORBIT: Final = 1  # vertex -> smallest vertex of its orbit
FACTOR: Final = 2  # i -> factor of the group order, i < state[FACTORS]
START: Final = 3  # i -> where generator i begins in the pool, i <= state[GENERATORS]
# the partition,
LAB: Final = 4  # place -> vertex
POS: Final = 5  # vertex -> place
CELL: Final = 6  # vertex -> first place of its cell
SIZE: Final = 7  # first place -> number of vertices of the cell
BORN: Final = 8  # trail of splits: first place of the cell that was made
PARENT: Final = 9  # trail of splits: first place of the cell it was cut from
# one splitting step,
HITS: Final = 10  # first place -> vertices of the cell met so far; 0 between steps
QUEUED: Final = 11  # first place -> 1 while the cell waits to split the others
QUEUE: Final = 12  # the waiting cells, a stack
TOUCHED: Final = 13  # the cells met by the splitting cell
LISTED: Final = 14  # its vertices; cells that might be taken apart
# automorphisms and leaves,
FIRST_LAB: Final = 15  # the first leaf: place -> vertex
BEST_LAB: Final = 16  # the best leaf so far: place -> vertex
BEST_POS: Final = 17  # vertex -> place
FORM_START: Final = 18  # place -> first entry of its row in the form of the best leaf
IDENTITY: Final = 19  # filled once, never written again
IMAGE: Final = 20  # a map of the vertices under trial, and its inverse; the identity between trials
INVERSE: Final = 21
SUPPORT: Final = 22  # the vertices it moves
# and the search; a level is the number of vertices singled out above a node.
PATH: Final = 23  # level -> vertex singled out there
LEVEL_OF: Final = 24  # vertex -> level at which it is singled out, n if it is not
TARGET: Final = 25  # level -> first place of the target cell
ELDEST: Final = 26  # level -> child of the node that was searched first
MARK: Final = 27  # level -> length of the trail of splits
FOLLOWS: Final = 28  # level -> 1 if the traces so far equal those of the first path
STANDING: Final = 29  # level -> traces so far less than (-1), equal to (0), above (1) those of the best path
LOCAL: Final = 30  # vertex -> smallest vertex of its orbit within a target cell
ROWS: Final = 31

# Rows of `Workspace.words`.
SUM: Final = 0  # vertex -> weight of its edges into the splitting cell
KEY: Final = 1  # keys of a sort
EARLY_TRACE: Final = 2  # level -> trace of the present node after EARLY splitting cells, and so of
FIRST_EARLY: Final = 3  # the first path
BEST_EARLY: Final = 4  # and the best path
FIRST_TRACE: Final = 5  # level -> trace of the node of the first path
BEST_TRACE: Final = 6  # and the best path
WORD_ROWS: Final = 7

# Rows of `Workspace.ends`.
WEIGHT: Final = 0  # end of an edge -> hash of the colour
NEAR: Final = 1  # two sorted adjacency lists
FAR: Final = 2
FORM: Final = 3  # the edges of the best leaf
END_ROWS: Final = 4

# Rows of `Workspace.pool`.
MOVED: Final = 0
IMAGE_OF: Final = 1
SPARE: Final = 2

# Entries of `Workspace.state`.
CELLS: Final = 0  # number of cells
TRAIL: Final = 1  # length of the trail of splits
WAITING: Final = 2  # number of waiting cells
GENERATORS: Final = 3  # number of automorphisms kept
FACTORS: Final = 4  # number of factors of the group order
NODES: Final = 5  # nodes of the search tree that were refined
LEAVES: Final = 6  # leaves of the search tree that were reached
BEST_IS_FIRST: Final = 7  # 1 while no leaf was better than the first
FORM_READY: Final = 8  # 1 if the form of the best leaf is written down
THOROUGH: Final = 9  # 1 if children are compared before one is searched first
OVERFLOW: Final = 10  # 1 if a generator found no room
STATE_SIZE: Final = 11


def make_workspace(n: int, m: int, support: int | None = None) -> Workspace:
    """Return the memory for labelling graphs of at most n vertices and m edges.

    Args:
        n: most vertices.
        m: most edges, parallel ones counted each.
        support: room for the generators, as the sum of the numbers of vertices they move. n(n - 1) is always
            enough and is the default up to 65 vertices; above, the default is 64n.

    >>> make_workspace(10, 13).rows.dtype
    dtype('int32')
    """
    if support is None:
        support = n * min(max(n - 1, 0), 64)
    rows = np.empty((ROWS, n + 1), np.int32)
    rows[IDENTITY] = np.arange(n + 1)
    return Workspace(
        state=np.zeros(STATE_SIZE, np.int64),
        rows=rows,
        words=np.empty((WORD_ROWS, n + 1), np.uint64),
        ends=np.empty((END_ROWS, 2 * m + 1), np.uint64),
        pool=np.empty((3, max(support, m + 1)), np.int32),
    )


# Types for signatures. A kernel that is called from several places states its signature: left alone, numba
# compiles it anew for every constant and every width of integer that some call hands it, which made the first
# labelling of all take twice as long to compile.
NOTHING: Final = "void"
COUNT: Final = "int64"
FLAG: Final = "boolean"
WORD: Final = "uint64"
ROW: Final = "int32[::1]"
LONG_ROW: Final = "int64[::1]"
TABLE: Final = "int32[:, ::1]"
WORD_TABLE: Final = "uint64[:, ::1]"
WORKSPACE: Final = "workspace"
ROWS_OF_GRAPH: Final = (ROW, ROW)  # indptr, neighbour
COLOURED_GRAPH: Final = (LONG_ROW, ROW, ROW, ROW)  # vertex colours, indptr, neighbour, edge colours


def signature(result: str, *arguments: str) -> Callable[[], Any]:
    """A signature for `compiling.njit`, of the names of types above."""

    def make() -> Any:
        from numba import typeof, types

        known = {
            NOTHING: types.void,
            COUNT: types.int64,
            FLAG: types.boolean,
            WORD: types.uint64,
            ROW: types.int32[::1],
            LONG_ROW: types.int64[::1],
            TABLE: types.int32[:, ::1],
            WORD_TABLE: types.uint64[:, ::1],
            WORKSPACE: typeof(make_workspace(1, 1)),  # type: ignore[no-untyped-call, unused-ignore]
        }
        return known[result](*(known[name] for name in arguments))

    return make
