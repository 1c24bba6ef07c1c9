"""Ordered partitions of the vertices of a coloured multigraph, and their refinement.

A partition is kept as a permutation of the vertices in which every cell is a run of places; a cell is named
by its first place, which never changes while the cell lives. Splitting a cell leaves its first part where it
is and names the others by new first places, so that a split is undone by giving the names back.

Nothing here may look at the number of a vertex when it decides: colours, places and sizes only. That blindness
is what makes the labelling of `gruebler._numeric.labelling.canonical` canonical (docs/theory/canonical-code.md).
"""

from typing import Final

import numpy as np

from gruebler._numeric.compiling import njit
from gruebler._numeric.labelling.label_workspace import (
    BEST_EARLY,
    BORN,
    CELL,
    CELLS,
    COUNT,
    EARLY_TRACE,
    FIRST_EARLY,
    FLAG,
    HITS,
    KEY,
    LAB,
    LISTED,
    NOTHING,
    PARENT,
    POS,
    QUEUE,
    QUEUED,
    ROWS_OF_GRAPH,
    SIZE,
    SUM,
    TABLE,
    TOUCHED,
    TRAIL,
    WAITING,
    WEIGHT,
    WORD,
    WORD_TABLE,
    WORKSPACE,
    Int32,
    Int64,
    UInt64,
    Workspace,
    signature,
)

GOLDEN: Final = np.uint64(0x9E3779B97F4A7C15)
MIX: Final = np.uint64(0xBF58476D1CE4E5B9)
MIX_AGAIN: Final = np.uint64(0x94D049BB133111EB)
ONE: Final = np.uint64(1)
SHIFT: Final = np.uint64(31)

# Rounds of colour refinement done for all vertices at once before cells exist. Two, after the degrees, separate
# most of what can be separated in graphs of a few dozen vertices; more cost more than they save.
ROUNDS: Final = 2
# Up to this length insertion is quicker than heap sort.
SHORT: Final = 24
# After so many splitting cells a refinement asks, once, whether it can still matter.
EARLY: Final = 8


@njit(cache=True)
def mix(x: np.uint64) -> np.uint64:
    """Return a fixed scramble of a 64-bit word (the finaliser of splitmix64)."""
    x = x + GOLDEN
    x = (x ^ (x >> np.uint64(30))) * MIX
    x = (x ^ (x >> np.uint64(27))) * MIX_AGAIN
    return x ^ (x >> SHIFT)


@njit(signature(NOTHING, WORD_TABLE, COUNT, TABLE, COUNT, COUNT, COUNT, COUNT), cache=True)
def _sift(keys: UInt64, row: int, items: Int32, item_row: int, low: int, root: int, count: int) -> None:
    k = keys[row, low + root]
    t = items[item_row, low + root]
    while True:
        child = 2 * root + 1
        if child >= count:
            break
        if child + 1 < count and keys[row, low + child] < keys[row, low + child + 1]:
            child += 1
        if keys[row, low + child] <= k:
            break
        keys[row, low + root] = keys[row, low + child]
        items[item_row, low + root] = items[item_row, low + child]
        root = child
    keys[row, low + root] = k
    items[item_row, low + root] = t


@njit(signature(NOTHING, WORD_TABLE, COUNT, TABLE, COUNT, COUNT, COUNT), cache=True)
def sort_words(keys: UInt64, row: int, items: Int32, item_row: int, low: int, high: int) -> None:
    """Sort `keys[row, low:high]` in place, ascending, and carry `items[item_row, low:high]` along.

    Cost: O(k log k) for k keys; nothing is allocated.
    """
    if high - low <= SHORT:
        for i in range(low + 1, high):
            k = keys[row, i]
            t = items[item_row, i]
            j = i - 1
            while j >= low and keys[row, j] > k:
                keys[row, j + 1] = keys[row, j]
                items[item_row, j + 1] = items[item_row, j]
                j -= 1
            keys[row, j + 1] = k
            items[item_row, j + 1] = t
        return
    count = high - low
    for first in range(count // 2 - 1, -1, -1):
        _sift(keys, row, items, item_row, low, first, count)
    for last in range(count - 1, 0, -1):
        k = keys[row, low]
        keys[row, low] = keys[row, low + last]
        keys[row, low + last] = k
        t = items[item_row, low]
        items[item_row, low] = items[item_row, low + last]
        items[item_row, low + last] = t
        _sift(keys, row, items, item_row, low, 0, last)


@njit(cache=True)
def _hash_surroundings(
    n: int, vertex_colour: Int64, indptr: Int32, neighbour: Int32, edge_colour: Int32, ws: Workspace
) -> None:
    """Write the weights of all ends of edges, and for every vertex a key: its colour, then a hash of what is near."""
    words, ends = ws.words, ws.ends
    last = np.int64(-1)
    word = GOLDEN
    for e in range(indptr[n]):
        colour = np.int64(edge_colour[e])
        if colour != last:
            last = colour
            word = mix(np.uint64(colour)) | ONE
        ends[WEIGHT, e] = word
    top = np.int64(0)
    for v in range(n):
        top = max(top, vertex_colour[v])
        degree = np.uint64(indptr[v + 1] - indptr[v])
        words[KEY, v] = mix(np.uint64(vertex_colour[v]) * MIX + degree)
    for _ in range(ROUNDS):
        for v in range(n):
            words[SUM, v] = words[KEY, v]
        for v in range(n):
            total = words[SUM, v] * GOLDEN
            for e in range(indptr[v], indptr[v + 1]):
                total += ends[WEIGHT, e] * words[SUM, neighbour[e]]
            words[KEY, v] = mix(total)
    if top > 0:
        bits = ONE
        while top >> np.int64(bits) > 0:
            bits += ONE
        for v in range(n):
            colour_bits = np.uint64(vertex_colour[v]) << (np.uint64(64) - bits)
            words[KEY, v] = colour_bits | (words[KEY, v] >> bits)


@njit(cache=True)
def first_partition(
    n: int, vertex_colour: Int64, indptr: Int32, neighbour: Int32, edge_colour: Int32, ws: Workspace
) -> None:
    """Write the first partition: by vertex colour, ascending, then by a hash of the surroundings.

    All cells but one largest are left waiting: what that one would split is known from the sums over all
    neighbours that the hash has used.
    """
    state, rows, words = ws.state, ws.rows, ws.words
    _hash_surroundings(n, vertex_colour, indptr, neighbour, edge_colour, ws)
    for v in range(n):
        rows[SIZE, v] = 0
        rows[QUEUED, v] = 0
        rows[HITS, v] = 0
    if n <= SHORT:  # the first place of a cell is the number of smaller keys: no branch to be guessed wrong
        for v in range(n):
            k = words[KEY, v]
            smaller = 0
            for u in range(n):
                smaller += words[KEY, u] < k
            rows[CELL, v] = smaller
    else:
        for v in range(n):
            rows[LAB, v] = v
        sort_words(words, KEY, rows, LAB, 0, n)
        begin = 0
        for i in range(n):
            if i > 0 and words[KEY, i] != words[KEY, i - 1]:
                begin = i
            rows[CELL, rows[LAB, i]] = begin
    for v in range(n):
        begin = rows[CELL, v]
        place = begin + rows[SIZE, begin]
        rows[SIZE, begin] += 1
        rows[LAB, place] = v
        rows[POS, v] = place
    cells = 0
    largest = 0
    begin = 0
    while begin < n:
        cells += 1
        if rows[SIZE, begin] > rows[SIZE, largest]:
            largest = begin
        begin += rows[SIZE, begin]
    state[CELLS] = cells
    state[TRAIL] = 0
    state[WAITING] = 0
    if cells == n:
        return
    waiting = 0
    begin = 0
    while begin < n:
        if begin != largest:
            rows[QUEUE, waiting] = begin
            rows[QUEUED, begin] = 1
            waiting += 1
        begin += rows[SIZE, begin]
    state[WAITING] = waiting


@njit(cache=True)
def single_out(v: int, ws: Workspace) -> None:
    """Cut vertex v from its cell, as a cell of its own at the last place, and let it wait."""
    state, rows = ws.state, ws.rows
    c = rows[CELL, v]
    last = c + rows[SIZE, c] - 1
    place = rows[POS, v]
    u = rows[LAB, last]
    rows[LAB, place] = u
    rows[POS, u] = place
    rows[LAB, last] = v
    rows[POS, v] = last
    rows[SIZE, c] -= 1
    rows[SIZE, last] = 1
    rows[CELL, v] = last
    rows[HITS, last] = 0
    rows[BORN, state[TRAIL]] = last
    rows[PARENT, state[TRAIL]] = c
    state[TRAIL] += 1
    state[CELLS] += 1
    rows[QUEUE, state[WAITING]] = last
    rows[QUEUED, last] = 1
    state[WAITING] += 1


@njit(signature(NOTHING, COUNT, WORKSPACE), cache=True)
def undo(mark: int, ws: Workspace) -> None:
    """Take back all splits after the first `mark` of the trail."""
    state, rows = ws.state, ws.rows
    for t in range(state[TRAIL] - 1, mark - 1, -1):
        b = rows[BORN, t]
        c = rows[PARENT, t]
        for i in range(b, b + rows[SIZE, b]):
            rows[CELL, rows[LAB, i]] = c
        rows[SIZE, c] += rows[SIZE, b]
    state[CELLS] -= state[TRAIL] - mark
    state[TRAIL] = mark


@njit(signature(WORD, COUNT, *ROWS_OF_GRAPH, COUNT, FLAG, FLAG, WORKSPACE), cache=True)
def refine(
    n: int, indptr: Int32, neighbour: Int32, level: int, like_first: bool, bounded: bool, ws: Workspace
) -> np.uint64:
    """Split cells by the weights of their edges into waiting cells until none waits; return the trace.

    The trace is a hash of all that happened, the same for every numbering of the vertices; its last bit tells
    whether every cell is a single vertex. A cell that is split lets all its parts wait if it waited itself, and
    all but one largest if not (Hopcroft's rule).

    `ws.words[EARLY_TRACE, level]` gets the trace after the first few splitting cells. There a `bounded`
    refinement is given up, with trace 0, if that early trace exceeds the one of the best path, unless
    `like_first` is set and it is the one of the first path.

    Cost: O(edges * log n) for a whole path from the root to a leaf.
    """
    state, rows, words, ends = ws.state, ws.rows, ws.words, ws.ends
    cells = state[CELLS]
    trail = state[TRAIL]
    waiting = state[WAITING]
    trace = np.uint64(cells) * GOLDEN
    words[EARLY_TRACE, level] = np.uint64(0)
    popped = 0
    given_up = False
    while waiting > 0 and cells < n:
        popped += 1
        if popped == EARLY:
            words[EARLY_TRACE, level] = trace
            hopeless = not (like_first and trace == words[FIRST_EARLY, level])
            if bounded and hopeless and trace > words[BEST_EARLY, level]:
                given_up = True
                break
        waiting -= 1
        splitter = rows[QUEUE, waiting]
        rows[QUEUED, splitter] = 0
        count = rows[SIZE, splitter]
        for i in range(count):
            rows[LISTED, i] = rows[LAB, splitter + i]
        single = np.uint64(splitter) + ONE
        met = 0
        for i in range(count):
            v = rows[LISTED, i]
            for e in range(indptr[v], indptr[v + 1]):
                w = neighbour[e]
                c = rows[CELL, w]
                size = rows[SIZE, c]
                if size == 1:
                    z = np.uint64(c) * MIX
                    single += (z ^ (z >> SHIFT)) * ends[WEIGHT, e]
                    continue
                h = rows[HITS, c]
                if h == 0:
                    rows[TOUCHED, met] = c
                    met += 1
                p = rows[POS, w]
                q = c + size - 1 - h
                if p <= q:  # w is met for the first time: it joins the met vertices at the end of the cell
                    u = rows[LAB, q]
                    rows[LAB, p] = u
                    rows[POS, u] = p
                    rows[LAB, q] = w
                    rows[POS, w] = q
                    rows[HITS, c] = h + 1
                    words[SUM, w] = ends[WEIGHT, e]
                else:
                    words[SUM, w] += ends[WEIGHT, e]
        trace = (trace ^ single) * MIX_AGAIN
        trace ^= trace >> SHIFT
        if met > 1:  # cells are dealt with in the order of their places, not in the order they were met
            for i in range(met):
                words[KEY, i] = np.uint64(rows[TOUCHED, i])
            sort_words(words, KEY, rows, TOUCHED, 0, met)
        for i in range(met):
            c = rows[TOUCHED, i]
            h = rows[HITS, c]
            rows[HITS, c] = 0
            end = c + rows[SIZE, c]
            low = end - h
            least = words[SUM, rows[LAB, low]]
            even = True
            for j in range(low + 1, end):
                if words[SUM, rows[LAB, j]] != least:
                    even = False
                    break
            if not even:
                for j in range(low, end):
                    words[KEY, j] = words[SUM, rows[LAB, j]]
                sort_words(words, KEY, rows, LAB, low, end)
                for j in range(low, end):
                    rows[POS, rows[LAB, j]] = j
                least = words[KEY, low]
            trace = (trace ^ (np.uint64(c) + (np.uint64(h) << np.uint64(32)))) * GOLDEN
            trace = (trace ^ least) * MIX
            trace ^= trace >> SHIFT
            if even and low == c:
                continue
            trail_before = trail
            begin = c
            if low > c:
                rows[SIZE, c] = low - c
            for j in range(low, end):
                if (j == low and low > c) or (j > low and not even and words[KEY, j] != words[KEY, j - 1]):
                    if j > low:
                        rows[SIZE, begin] = j - begin
                        trace = (trace ^ words[KEY, j]) * MIX_AGAIN + np.uint64(j)
                        trace ^= trace >> SHIFT
                    begin = j
                    rows[HITS, j] = 0
                    rows[QUEUED, j] = 0
                    rows[BORN, trail] = j
                    rows[PARENT, trail] = c
                    trail += 1
                    cells += 1
                rows[CELL, rows[LAB, j]] = begin
            rows[SIZE, begin] = end - begin
            skip = -1
            if rows[QUEUED, c] == 0:
                skip = c
                for t in range(trail_before, trail):
                    if rows[SIZE, rows[BORN, t]] > rows[SIZE, skip]:
                        skip = rows[BORN, t]
                if skip != c:
                    rows[QUEUE, waiting] = c
                    rows[QUEUED, c] = 1
                    waiting += 1
            for t in range(trail_before, trail):
                b = rows[BORN, t]
                if b != skip:
                    rows[QUEUE, waiting] = b
                    rows[QUEUED, b] = 1
                    waiting += 1
    for i in range(waiting):
        rows[QUEUED, rows[QUEUE, i]] = 0
    state[CELLS] = cells
    state[TRAIL] = trail
    state[WAITING] = 0
    if given_up:
        return np.uint64(0)
    trace = mix(trace ^ np.uint64(cells)) & ~ONE
    return trace | ONE if cells == n else trace
