"""Automorphisms read off two nodes of the search tree, their orbits, and the comparison of leaves.

Everything in this file compares edges and colours themselves, never hashes of them: it is where the labelling
of `gruebler._numeric.labelling.canonical` gets its exactness from (docs/theory/canonical-code.md).
"""

import numpy as np

from gruebler._numeric.compiling import njit
from gruebler._numeric.labelling.label_workspace import (
    BEST_LAB,
    BEST_POS,
    BORN,
    COLOURED_GRAPH,
    COUNT,
    FAR,
    FLAG,
    FORM,
    FORM_READY,
    FORM_START,
    GENERATORS,
    IDENTITY,
    IMAGE,
    IMAGE_OF,
    INVERSE,
    LAB,
    LONG_ROW,
    MOVED,
    NEAR,
    NOTHING,
    ORBIT,
    OVERFLOW,
    PARENT,
    POS,
    ROW,
    SIZE,
    SPARE,
    START,
    SUPPORT,
    TABLE,
    TRAIL,
    WORKSPACE,
    Int32,
    Int64,
    Workspace,
    signature,
)
from gruebler._numeric.labelling.partition import sort_words


@njit(signature(COUNT, TABLE, COUNT, COUNT), cache=True)
def orbit_root(rows: Int32, row: int, v: int) -> int:
    """Return the least vertex of the orbit of v in a forest kept in one row, and shorten the way to it."""
    while rows[row, v] != v:
        rows[row, v] = rows[row, rows[row, v]]
        v = rows[row, v]
    return v


@njit(signature(FLAG, TABLE, COUNT, COUNT, COUNT), cache=True)
def join_orbits(rows: Int32, row: int, v: int, w: int) -> bool:
    """Unite the orbits of v and w under the smaller root; return whether they were two."""
    v = orbit_root(rows, row, v)
    w = orbit_root(rows, row, w)
    if v < w:
        rows[row, w] = v
    else:
        rows[row, v] = w
    return v != w


@njit(signature(NOTHING, COUNT, COUNT, WORKSPACE, LONG_ROW), cache=True)
def generator_image(g: int, vertices: int, ws: Workspace, image: Int64) -> None:
    """Write out where generator g of the labelled graph takes each vertex."""
    for v in range(vertices):
        image[v] = v
    for i in range(ws.rows[START, g], ws.rows[START, g + 1]):
        image[ws.pool[MOVED, i]] = ws.pool[IMAGE_OF, i]


@njit(signature(COUNT, COUNT, COUNT, COUNT, COUNT, ROW, ROW, ROW, WORKSPACE), cache=True)
def _write_row(
    v: int,
    names: int,
    above: int,
    side: int,
    indptr: Int32,
    neighbour: Int32,
    edge_colour: Int32,
    ws: Workspace,
) -> int:
    """Write the sorted pairs (name, colour) of the edges at v to names > `above`; return how many there are."""
    rows, ends = ws.rows, ws.ends
    count = 0
    for e in range(indptr[v], indptr[v + 1]):
        name = rows[names, neighbour[e]]
        if name > above:
            ends[side, count] = (np.uint64(name) << np.uint64(32)) | np.uint64(edge_colour[e])
            count += 1
    sort_words(ends, side, ws.pool, SPARE, 0, count)
    return count


@njit(signature(FLAG, COUNT, *COLOURED_GRAPH, WORKSPACE), cache=True)
def _respects(
    moved: int, vertex_colour: Int64, indptr: Int32, neighbour: Int32, edge_colour: Int32, ws: Workspace
) -> bool:
    """Tell whether the map under trial respects vertex colours and the edges around all vertices it moves."""
    rows, ends = ws.rows, ws.ends
    for i in range(moved):
        v = rows[SUPPORT, i]
        w = rows[IMAGE, v]
        if vertex_colour[v] != vertex_colour[w] or indptr[v + 1] - indptr[v] != indptr[w + 1] - indptr[w]:
            return False
    for i in range(moved):
        v = rows[SUPPORT, i]
        count = _write_row(v, IMAGE, -1, NEAR, indptr, neighbour, edge_colour, ws)
        _write_row(rows[IMAGE, v], IDENTITY, -1, FAR, indptr, neighbour, edge_colour, ws)
        for j in range(count):
            if ends[NEAR, j] != ends[FAR, j]:
                return False
    return True


@njit(signature(NOTHING, COUNT, WORKSPACE), cache=True)
def _keep(moved: int, ws: Workspace) -> None:
    """Unite the orbits of the automorphism under trial and, if that made fewer of them, store it."""
    state, rows, pool = ws.state, ws.rows, ws.pool
    useful = False
    for i in range(moved):
        v = rows[SUPPORT, i]
        if join_orbits(rows, ORBIT, v, rows[IMAGE, v]):
            useful = True
    if not useful:
        return
    count = state[GENERATORS]
    begin = rows[START, count]
    if begin + moved > pool.shape[1]:
        state[OVERFLOW] = 1
        return
    for i in range(moved):
        v = rows[SUPPORT, i]
        pool[MOVED, begin + i] = v
        pool[IMAGE_OF, begin + i] = rows[IMAGE, v]
    rows[START, count + 1] = begin + moved
    state[GENERATORS] = count + 1


@njit(cache=True)
def find_automorphism(
    leaf: int,
    mark: int,
    vertex_colour: Int64,
    indptr: Int32,
    neighbour: Int32,
    edge_colour: Int32,
    ws: Workspace,
) -> bool:
    """Try to read an automorphism off a known leaf and the present node; keep it if it is one.

    Vertices that became single since `mark` are paired with those of the leaf (a row of `Workspace.rows`) at the
    same places, chains of pairs are closed to cycles, and all else stays fixed. At a leaf this is the only map
    that respects the places; above, it is a guess, right whenever the cells that are left have nothing to do
    with the difference of the two nodes.

    Cost: O(d log d) for the d edges around the vertices moved.
    """
    state, rows = ws.state, ws.rows
    moved = 0
    for t in range(mark, state[TRAIL]):
        for side in range(2):
            place = rows[BORN, t] if side == 0 else rows[PARENT, t]
            if rows[SIZE, place] == 1:
                v = rows[leaf, place]
                w = rows[LAB, place]
                if v != w and rows[IMAGE, v] == v:
                    rows[IMAGE, v] = w
                    rows[INVERSE, w] = v
                    rows[SUPPORT, moved] = v
                    moved += 1
    for i in range(moved):
        v = rows[SUPPORT, i]
        if rows[INVERSE, v] == v:  # a chain begins here: its end goes to its beginning
            w = rows[IMAGE, v]
            while rows[IMAGE, w] != w:
                w = rows[IMAGE, w]
            rows[IMAGE, w] = v
            rows[INVERSE, v] = w
            rows[SUPPORT, moved] = w
            moved += 1
    respected = moved > 0 and _respects(moved, vertex_colour, indptr, neighbour, edge_colour, ws)
    if respected:
        _keep(moved, ws)
    for i in range(moved):
        v = rows[SUPPORT, i]
        rows[IMAGE, v] = v
        rows[INVERSE, v] = v
    return respected


@njit(cache=True)
def _write_form(n: int, indptr: Int32, neighbour: Int32, edge_colour: Int32, ws: Workspace) -> None:
    """Write the form of the best leaf: for each place the sorted pairs (later place, colour) of its edges."""
    rows, ends = ws.rows, ws.ends
    for i in range(n):
        rows[BEST_POS, rows[BEST_LAB, i]] = i
    rows[FORM_START, 0] = 0
    for i in range(n):
        begin = rows[FORM_START, i]
        count = _write_row(rows[BEST_LAB, i], BEST_POS, i, NEAR, indptr, neighbour, edge_colour, ws)
        for j in range(count):
            ends[FORM, begin + j] = ends[NEAR, j]
        rows[FORM_START, i + 1] = begin + count


@njit(cache=True)
def leaf_is_better(n: int, indptr: Int32, neighbour: Int32, edge_colour: Int32, ws: Workspace) -> bool:
    """Tell whether the form of the present leaf comes before the form of the best one."""
    state, rows, ends = ws.state, ws.rows, ws.ends
    if state[FORM_READY] == 0:
        _write_form(n, indptr, neighbour, edge_colour, ws)
        state[FORM_READY] = 1
    for i in range(n):
        begin = rows[FORM_START, i]
        length = rows[FORM_START, i + 1] - begin
        count = _write_row(rows[LAB, i], POS, i, NEAR, indptr, neighbour, edge_colour, ws)
        if count != length:
            return bool(count < length)
        for j in range(count):
            if ends[NEAR, j] != ends[FORM, begin + j]:
                return bool(ends[NEAR, j] < ends[FORM, begin + j])
    return False
