"""The search tree of the canonical labelling: which cell is taken apart, which vertex comes next, what is cut off.

A node is a refined partition after some vertices have been singled out, one a level. The first path is the one
searched first; every other node is reached from one of its nodes. Definitions and proofs are in
docs/theory/canonical-code.md.
"""

from typing import Final

import numpy as np

from gruebler._numeric.compiling import njit
from gruebler._numeric.labelling.automorphism import find_automorphism, join_orbits, leaf_is_better, orbit_root
from gruebler._numeric.labelling.label_workspace import (
    BEST_EARLY,
    BEST_IS_FIRST,
    BEST_LAB,
    BEST_TRACE,
    BORN,
    CELL,
    CELLS,
    COUNT,
    EARLY_TRACE,
    ELDEST,
    FACTOR,
    FACTORS,
    FIRST_EARLY,
    FIRST_LAB,
    FIRST_TRACE,
    FLAG,
    FOLLOWS,
    FORM_READY,
    GENERATORS,
    HITS,
    IMAGE,
    IMAGE_OF,
    INVERSE,
    LAB,
    LEAVES,
    LEVEL_OF,
    LISTED,
    LOCAL,
    MARK,
    MOVED,
    NODES,
    ORBIT,
    OVERFLOW,
    PARENT,
    PATH,
    ROWS_OF_GRAPH,
    SIZE,
    STANDING,
    START,
    TARGET,
    THOROUGH,
    TOUCHED,
    TRAIL,
    WORKSPACE,
    Int32,
    Int64,
    Workspace,
    signature,
)
from gruebler._numeric.labelling.partition import refine, single_out, undo

# A plain search that has refined PATIENCE * (n + PATIENCE) nodes gives way to a thorough one.
PATIENCE: Final = 16


@njit(cache=True)
def _joins(begin: int, indptr: Int32, neighbour: Int32, ws: Workspace) -> int:
    """Count the cells of two or more vertices that a cell is joined to in part."""
    rows = ws.rows
    size = np.int64(rows[SIZE, begin])
    met = 0
    for i in range(begin, begin + size):
        v = rows[LAB, i]
        for e in range(indptr[v], indptr[v + 1]):
            c = rows[CELL, neighbour[e]]
            if rows[SIZE, c] > 1 and c != begin:
                if rows[HITS, c] == 0:
                    rows[TOUCHED, met] = c
                    met += 1
                rows[HITS, c] += 1
    joins = 0
    for i in range(met):
        c = rows[TOUCHED, i]
        if rows[HITS, c] < size * rows[SIZE, c]:
            joins += 1
        rows[HITS, c] = 0
    return joins


@njit(signature(COUNT, COUNT, COUNT, WORKSPACE), cache=True)
def _list_candidates(level: int, n: int, ws: Workspace) -> int:
    """List the cells of two or more vertices that the latest step with such cells has split, or else all such.

    Cells split by the latest steps belong to the part of the graph that has been begun. To finish one part
    before the next is what lets guessed automorphisms come true early.
    """
    state, rows = ws.state, ws.rows
    count = 0
    for upper in range(level - 1, -1, -1):
        for t in range(rows[MARK, upper], state[TRAIL]):
            for side in range(2):
                c = rows[BORN, t] if side == 0 else rows[PARENT, t]
                if rows[SIZE, c] > 1 and rows[HITS, c] == 0:
                    rows[HITS, c] = 1
                    rows[LISTED, count] = c
                    count += 1
        if count > 0:
            for i in range(count):
                rows[HITS, rows[LISTED, i]] = 0
            return count
    begin = 0
    while begin < n:
        if rows[SIZE, begin] > 1:
            rows[LISTED, count] = begin
            count += 1
        begin += rows[SIZE, begin]
    return count


@njit(signature(COUNT, COUNT, COUNT, *ROWS_OF_GRAPH, WORKSPACE), cache=True)
def _target_cell(level: int, n: int, indptr: Int32, neighbour: Int32, ws: Workspace) -> int:
    """Return the cell to take apart: of the candidates one joined in part to most cells, a smallest of such.

    Vertices of such cells tell most about the rest. Edges are counted over whole cells, so that the choice is
    blind to the numbers of vertices even where the hashes of the refinement failed to separate a cell.
    """
    rows = ws.rows
    count = _list_candidates(level, n, ws)
    best = rows[LISTED, 0]
    widest = 0
    for i in range(count):
        widest = max(widest, rows[SIZE, rows[LISTED, i]])
    if widest == 2 or count == 1:
        return int(best)
    most = -1
    for i in range(count):
        c = rows[LISTED, i]
        joins = _joins(c, indptr, neighbour, ws)
        if joins > most or (joins == most and rows[SIZE, c] < rows[SIZE, best]):
            best = c
            most = joins
    return int(best)


@njit(signature(COUNT, COUNT, COUNT, COUNT, COUNT, WORKSPACE), cache=True)
def _next_root(level: int, last: int, eldest: int, forest: int, ws: Workspace) -> int:
    """Return the least vertex > `last` of the target cell that is the root of its orbit, or -1.

    The orbit of `eldest`, the child that was searched first, counts as done; it is -1 if there is none.
    """
    rows = ws.rows
    done = orbit_root(rows, forest, eldest) if eldest >= 0 else -1
    target = rows[TARGET, level]
    best = -1
    for i in range(target, target + rows[SIZE, target]):
        v = rows[LAB, i]
        if v > last and rows[forest, v] == v and v != done and (best < 0 or v < best):
            best = v
    return int(best)


@njit(signature(COUNT, COUNT, COUNT, COUNT, WORKSPACE), cache=True)
def _next_child(level: int, last: int, eldest: int, ws: Workspace) -> int:
    """Return the next vertex > `last` to single out at a node off the first path, or -1.

    Of vertices that known automorphisms fixing the path to this node map to one another, only the least counts.
    """
    state, rows, pool = ws.state, ws.rows, ws.pool
    target = rows[TARGET, level]
    for i in range(target, target + rows[SIZE, target]):
        rows[LOCAL, rows[LAB, i]] = rows[LAB, i]
    for g in range(state[GENERATORS]):
        fixes = True
        meets = False
        for i in range(rows[START, g], rows[START, g + 1]):
            v = pool[MOVED, i]
            if rows[LEVEL_OF, v] < level:
                fixes = False
                break
            if rows[CELL, v] == target:
                meets = True
        if fixes and meets:
            for i in range(rows[START, g], rows[START, g + 1]):
                v = pool[MOVED, i]
                if rows[CELL, v] == target:
                    join_orbits(rows, LOCAL, v, pool[IMAGE_OF, i])
    return _next_root(level, last, eldest, LOCAL, ws)


@njit(signature(COUNT, COUNT, FLAG, COUNT, *ROWS_OF_GRAPH, WORKSPACE), cache=True)
def _eldest_child(level: int, compare: bool, n: int, indptr: Int32, neighbour: Int32, ws: Workspace) -> int:
    """Return the vertex to single out first at a node.

    It is the least one or, if children are to be compared, one of the least trace: when that comes first, each
    child of a greater trace falls to one comparison. To be used only where no best path has come yet.
    """
    state, words = ws.state, ws.words
    mark = state[TRAIL]
    best = -1
    least = ~np.uint64(0)
    child = -1
    while True:
        child = _next_child(level, child, -1, ws)
        if child < 0 or not compare:
            return child if best < 0 else best
        if best < 0:
            words[BEST_EARLY, level] = least
        single_out(child, ws)
        trace = refine(n, indptr, neighbour, level, False, True, ws)
        undo(mark, ws)
        early = words[EARLY_TRACE, level]
        if best < 0 or early < words[BEST_EARLY, level] or (early == words[BEST_EARLY, level] and trace < least):
            best = child
            least = trace
            words[BEST_EARLY, level] = early


@njit(cache=True)
def _explore(
    n: int,
    base: int,
    child: int,
    vertex_colour: Int64,
    indptr: Int32,
    neighbour: Int32,
    edge_colour: Int32,
    ws: Workspace,
) -> bool:
    """Search below one child of the node at level `base` of the first path, and come back to that node.

    Three things cut the search: traces that equal neither those of the first path nor come up to the best ones,
    an automorphism that maps this part of the tree to one searched before, and known automorphisms that map
    children of a node to one another. Return False, with the work unfinished, if the search proves too long
    for a plain one.
    """
    state, rows, words = ws.state, ws.rows, ws.words
    rows[FOLLOWS, base] = 1
    rows[STANDING, base] = 0
    parting = base  # the level at which the present path leaves the best one
    level = base
    while True:
        parting = min(parting, level)
        rows[PATH, level] = child
        rows[LEVEL_OF, child] = level
        single_out(child, ws)
        stand = rows[STANDING, level]
        trace = refine(n, indptr, neighbour, level, rows[FOLLOWS, level] == 1, stand >= 0, ws)
        state[NODES] += 1
        if state[NODES] > PATIENCE * (n + PATIENCE) and state[THOROUGH] == 0:
            return False
        follow = rows[FOLLOWS, level] == 1 and trace == words[FIRST_TRACE, level]
        early = words[EARLY_TRACE, level]
        if stand == 0:
            if early != words[BEST_EARLY, level]:
                stand = -1 if early < words[BEST_EARLY, level] else 1
            elif trace != words[BEST_TRACE, level]:
                stand = -1 if trace < words[BEST_TRACE, level] else 1
        if stand < 0:
            words[BEST_EARLY, level] = early
            words[BEST_TRACE, level] = trace
        back = level
        if follow or stand <= 0:
            matched = False
            for leaf in (FIRST_LAB, BEST_LAB):
                common = base if leaf == FIRST_LAB else parting
                alike = follow if leaf == FIRST_LAB else stand == 0 and state[BEST_IS_FIRST] == 0
                if alike and find_automorphism(
                    leaf, rows[MARK, common], vertex_colour, indptr, neighbour, edge_colour, ws
                ):
                    matched = True
                    start = rows[PATH, base]
                    known = (
                        orbit_root(rows, ORBIT, start) != start or orbit_root(rows, ORBIT, rows[ELDEST, base]) == start
                    )
                    back = base if known else common
                    break
            if not matched and state[CELLS] < n:
                level += 1
                rows[FOLLOWS, level] = follow
                rows[STANDING, level] = stand
                rows[MARK, level] = state[TRAIL]
                rows[TARGET, level] = _target_cell(level, n, indptr, neighbour, ws)
                child = _eldest_child(level, stand < 0 and state[THOROUGH] == 1, n, indptr, neighbour, ws)
                rows[ELDEST, level] = child
                continue
            if not matched:
                state[LEAVES] += 1
                if stand < 0 or (stand == 0 and leaf_is_better(n, indptr, neighbour, edge_colour, ws)):
                    for i in range(n):
                        rows[BEST_LAB, i] = rows[LAB, i]
                    state[BEST_IS_FIRST] = 0
                    state[FORM_READY] = 0
                    parting = level + 1
                    for i in range(base, level + 1):
                        rows[STANDING, i] = 0
        for i in range(back, level + 1):
            rows[LEVEL_OF, rows[PATH, i]] = n
        level = back
        undo(rows[MARK, level], ws)
        while level > base:
            child = _next_child(level, rows[PATH, level], rows[ELDEST, level], ws)
            if child >= 0:
                break
            level -= 1
            rows[LEVEL_OF, rows[PATH, level]] = n
            undo(rows[MARK, level], ws)
        if level == base:
            return True


@njit(cache=True)
def search_leaves(
    n: int, vertex_colour: Int64, indptr: Int32, neighbour: Int32, edge_colour: Int32, ws: Workspace
) -> bool:
    """Search the whole tree below a refined root; return False if it proves too long for a plain search.

    Every automorphism found while a node of the first path is at work fixes the vertices singled out above it;
    when its children are done, the orbit of its first child under all automorphisms found so far is the orbit
    under the stabiliser of those vertices, and its length is a factor of the group order.
    """
    state, rows, words = ws.state, ws.rows, ws.words
    for i in (GENERATORS, FACTORS, FORM_READY, OVERFLOW):
        state[i] = 0
    rows[START, 0] = 0
    for v in range(n):
        rows[ORBIT, v] = v
        rows[LEVEL_OF, v] = n
        rows[IMAGE, v] = v
        rows[INVERSE, v] = v
    depth = 0
    while state[CELLS] < n:
        rows[MARK, depth] = state[TRAIL]
        rows[TARGET, depth] = _target_cell(depth, n, indptr, neighbour, ws)
        v = _eldest_child(depth, state[THOROUGH] == 1, n, indptr, neighbour, ws)
        rows[ELDEST, depth] = v
        rows[LEVEL_OF, v] = depth
        single_out(v, ws)
        words[FIRST_TRACE, depth] = refine(n, indptr, neighbour, depth, False, False, ws)
        words[FIRST_EARLY, depth] = words[EARLY_TRACE, depth]
        words[BEST_TRACE, depth] = words[FIRST_TRACE, depth]
        words[BEST_EARLY, depth] = words[EARLY_TRACE, depth]
        depth += 1
    for i in range(n):
        rows[FIRST_LAB, i] = rows[LAB, i]
        rows[BEST_LAB, i] = rows[LAB, i]
    state[BEST_IS_FIRST] = 1
    state[NODES] = depth
    state[LEAVES] = 1
    for level in range(depth - 1, -1, -1):
        v = rows[ELDEST, level]
        rows[LEVEL_OF, v] = n
        undo(rows[MARK, level], ws)
        child = _next_root(level, -1, v, ORBIT, ws)
        while child >= 0:
            if not _explore(n, level, child, vertex_colour, indptr, neighbour, edge_colour, ws):
                return False
            child = _next_root(level, child, v, ORBIT, ws)
        least = orbit_root(rows, ORBIT, v)
        target = rows[TARGET, level]
        length = 0
        for i in range(target, target + rows[SIZE, target]):
            if orbit_root(rows, ORBIT, rows[LAB, i]) == least:
                length += 1
        rows[FACTOR, state[FACTORS]] = length
        state[FACTORS] += 1
    return True
