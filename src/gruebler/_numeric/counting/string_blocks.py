"""Where the bundles of a contracted graph stand when their values are counted, and which tests they face.

Bundles that the automorphism in question moves are searched, one value for each orbit of them. The others are
cut into blocks of at most seven. The assignments of one block whose c adds up to a given sum are at most 393,
hence seven words of bits; a critical set leaves of them those with c(X) <= t, X being its bundles in the block
and t what everything before has left over: one row of a table.

Theorems: docs/theory/enumeration.md, "Strings" and "Counting without listing".
"""

from functools import cache
from itertools import product
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import popcount
from gruebler._numeric.counting.packed_graph import NODES
from gruebler._numeric.counting.strings import LANES, MOST_SETS, PreparedGraph

Int64 = NDArray[np.int64]
Float64 = NDArray[np.float64]

BLOCK: Final = 7  # bundles in a block; with five or six the search before it grows more than this saves
SUMS: Final = 2 * BLOCK + 1
SUBSETS: Final = 1 << BLOCK
WORDS: Final = 7  # words that the assignments of one sum fill
STRIDE: Final = 8  # a row of a table is one cache line
LEVELS: Final = 5  # blocks; four hold 28 bundles

# How an automorphism treats a bundle.
MOVED: Final = 0
FIXED: Final = 1
TURNED: Final = 2

# Fields of a test: c(subset) <= limit - (what the masked lanes have used), trivial from `most` on. A lower test
# counts what is left over instead of what is used, and its limit rises with the sum of the block.
MASK: Final = 0
SUBSET: Final = 1
LIMIT: Final = 2
MOST: Final = 3
FIELDS: Final = 4


class BlockTables(NamedTuple):
    """What is true of the c of seven bundles, the assignments of each sum numbered with c falling."""

    allowed: Int64  # ((sum * SUBSETS + X) * SUMS + t, word): bit set if c(X) <= t
    zeros: Int64  # (sum, z, word): bit set if z of the seven are 0
    pattern: Int64  # (sum, assignment): c in unary, two bits a bundle


class BlockPlan(NamedTuple):
    """How many of the bundles are searched, and how many blocks the others fill."""

    bundles: int
    variables: int
    """orbits of searched bundles"""
    searched: int
    """lanes of searched bundles"""
    levels: int
    """blocks"""


class CounterMemory(NamedTuple):
    """Memory of `count_strings`. A lane is a place for a bundle: searched ones first, then those in blocks."""

    order: Int64  # lane -> bundle
    key: Int64
    place: Int64  # node -> place in the order of nodes
    seen: Int64  # bundle -> 1 once it has a lane
    variable: Int64  # rows by variable: first lane, number of lanes, strings, manner
    search_tests: Int64  # (upper or lower, variable, test, field)
    search_due: Int64  # (upper or lower, variable)
    search: Int64  # rows by depth: class, word, sum, excess, count, links, joints, flags
    begin: Int64  # level -> first lane
    width: Int64  # level -> number of lanes
    start: Int64  # (level, sum, word): the assignments that the block alone allows
    tests: Int64  # ((2 * level + lower) * MOST_SETS + test, field)
    due: Int64  # 2 * level + lower -> number of tests
    left: Int64  # (level, word): assignments not yet tried
    state: Int64  # rows by level: sum of this block, current word, lanes chosen before, their sum
    bulk: Float64  # what was found so far, as a number that cannot overflow


@cache
def block_tables() -> BlockTables:
    """The tables, 2 MB, made once in about 20 ms."""
    every = np.array(list(product((2, 1, 0), repeat=BLOCK)))
    subset = (np.arange(SUBSETS)[:, None] >> np.arange(BLOCK)) & 1
    allowed = np.zeros((SUMS, SUBSETS, SUMS, STRIDE), np.int64)
    zeros = np.zeros((SUMS, BLOCK + 1, STRIDE), np.int64)
    pattern = np.zeros((SUMS, 64 * WORDS), np.int64)
    for s in range(SUMS):
        c = every[every.sum(1) == s]
        bits = np.zeros((SUBSETS, SUMS, 64 * STRIDE), np.bool_)
        bits[:, :, : len(c)] = (subset @ c.T)[:, None, :] <= np.arange(SUMS)[None, :, None]
        allowed[s] = np.packbits(bits, axis=-1, bitorder="little").view("<i8")
        empty = np.zeros((BLOCK + 1, 64 * STRIDE), np.bool_)
        empty[:, : len(c)] = (c == 0).sum(1) == np.arange(BLOCK + 1)[:, None]
        zeros[s] = np.packbits(empty, axis=-1, bitorder="little").view("<i8")
        pattern[s, : len(c)] = (((1 << c) - 1) << (2 * np.arange(BLOCK))).sum(1)
    return BlockTables(allowed.reshape(-1, STRIDE), zeros, pattern)


def make_counter_memory() -> CounterMemory:
    """Memory for `count_strings`."""
    return CounterMemory(
        order=np.zeros(LANES, np.int64),
        key=np.zeros(LANES, np.int64),
        place=np.zeros(NODES, np.int64),
        seen=np.zeros(LANES, np.int64),
        variable=np.zeros((4, LANES + 1), np.int64),
        search_tests=np.zeros((2, LANES, MOST_SETS, FIELDS), np.int64),
        search_due=np.zeros((2, LANES), np.int64),
        search=np.zeros((8, LANES + 1), np.int64),
        begin=np.zeros(LEVELS + 1, np.int64),
        width=np.zeros(LEVELS, np.int64),
        start=np.zeros((LEVELS, SUMS, STRIDE), np.int64),
        tests=np.zeros((2 * LEVELS * MOST_SETS, FIELDS), np.int64),
        due=np.zeros(2 * LEVELS, np.int64),
        left=np.zeros((LEVELS, STRIDE), np.int64),
        state=np.zeros((4, LEVELS + 1), np.int64),
        bulk=np.zeros(1, np.float64),
    )


@njit(cache=True)
def order_nodes(n: int, near: Int64, place: Int64) -> None:
    """Each node has as many neighbours as possible among those before it and else few neighbours.

    So critical sets are complete early.
    """
    placed = 0
    for i in range(n):
        best = -1
        chosen = 0
        for v in range(n):
            if not (placed >> v) & 1:
                rank = 64 * popcount(near[v] & placed) + 32 - popcount(near[v])
                if rank > best:
                    best = rank
                    chosen = v
        place[chosen] = i
        placed |= 1 << chosen


@njit(cache=True)
def arrange_blocks(bundles: int, mobility: int, image: Int64, frame: PreparedGraph, memory: CounterMemory) -> BlockPlan:
    """Give lanes to the bundles.

    Searched: orbits of two and more bundles, bundles turned around, and bundles of several strings unless
    F = 1, where such a bundle differs from a single string only in counting twice for c = 2; these stand in
    the blocks before the last.
    """
    order, key, seen, variable = memory.order, memory.key, memory.seen, memory.variable
    ends, number, place = frame.ends, frame.number, memory.place
    for b in range(bundles):
        seen[b] = 0
    lanes = 0
    variables = 0
    for b in range(bundles):
        u, v = ends[0, b], ends[1, b]
        fixed = image[u] == u and image[v] == v
        if seen[b] or (fixed and (number[b] == 1 or mobility == 1)):
            continue
        variable[0, variables] = lanes
        variable[2, variables] = number[b]
        c = b
        while not seen[c]:
            seen[c] = 1
            order[lanes] = c
            lanes += 1
            c = frame.at[image[ends[0, c]], image[ends[1, c]]]
        length = lanes - variable[0, variables]
        variable[1, variables] = length
        variable[3, variables] = MOVED if length > 1 else FIXED if fixed else TURNED
        variables += 1
    searched = lanes
    several = 0
    for b in range(bundles):
        if seen[b]:
            continue
        a, z = place[ends[0, b]], place[ends[1, b]]
        rank = max(a, z) * 32 + min(a, z)
        if number[b] > 1:
            several += 1
        else:
            rank += 1024
        j = lanes
        while j > searched and key[j - 1] > rank:
            key[j] = key[j - 1]
            order[j] = order[j - 1]
            j -= 1
        key[j] = rank
        order[j] = b
        lanes += 1
    last = min(BLOCK, lanes - searched - several)
    rest = lanes - searched - last
    before = (rest + BLOCK - 1) // BLOCK
    lane = searched
    for level in range(before):
        memory.begin[level] = lane
        memory.width[level] = rest - BLOCK * (before - 1) if level == 0 else BLOCK
        lane += memory.width[level]
    memory.begin[before] = lane
    memory.width[before] = last
    return BlockPlan(bundles, variables, searched, before + 1)


@njit(cache=True)
def _lanes_of(mask: int, begin: int, width: int) -> int:
    """The lanes of a block that are in a mask, one bit each."""
    subset = 0
    for j in range(width):
        subset |= ((mask >> (2 * (begin + j))) & 1) << j
    return subset


@njit(cache=True)
def _restrict(level: int, subset: int, limit: int, per_sum: int, allowed: Int64, start: Int64) -> None:
    """Keep at this level the assignments with c(subset) <= limit + per_sum * (sum of the block)."""
    for s in range(SUMS):
        t = limit + per_sum * s
        if t < SUMS - 1:
            row = (s * SUBSETS + subset) * SUMS + max(t, 0)
            for j in range(WORDS):
                start[level, s, j] &= allowed[row, j] if t >= 0 else 0


@njit(cache=True)
def _demand(level: int, lower: int, mask: int, subset: int, limit: int, most: int, tests: Int64, due: Int64) -> None:
    """Note a test of a block."""
    kind = 2 * level + lower
    i = kind * MOST_SETS + due[kind]
    tests[i, MASK] = mask
    tests[i, SUBSET] = subset * SUMS
    tests[i, LIMIT] = limit
    tests[i, MOST] = most
    due[kind] += 1


@njit(cache=True)
def _demand_of_search(
    variables: int, lower: int, mask: int, limit: int, variable: Int64, tests: Int64, due: Int64
) -> None:
    """Note a test of the search, due at the last variable that has a lane of the mask."""
    last = variables - 1
    while (mask >> (2 * variable[0, last])) == 0:
        last -= 1
    i = due[lower, last]
    tests[lower, last, i, MASK] = mask
    tests[lower, last, i, LIMIT] = limit
    due[lower, last] += 1


@njit(cache=True)
def _clear_tests(mobility: int, plan: BlockPlan, tables: BlockTables, memory: CounterMemory) -> None:
    """No tests yet; only the lanes that a block lacks are 0, and with F = 0 no other ones."""
    for v in range(plan.variables):
        memory.search_due[0, v] = 0
        memory.search_due[1, v] = 0
    for level in range(plan.levels):
        memory.due[2 * level] = 0
        memory.due[2 * level + 1] = 0
        missing = BLOCK - memory.width[level]
        absent = (SUBSETS - 1) & ~((1 << memory.width[level]) - 1)
        for s in range(SUMS):
            for j in range(WORDS):
                memory.start[level, s, j] = tables.allowed[(s * SUBSETS + absent) * SUMS, j]
                if mobility == 0:
                    memory.start[level, s, j] &= tables.zeros[s, missing, j]


@njit(cache=True)
def place_tests(
    plan: BlockPlan,
    sets: int,
    target: int,
    mobility: int,
    frame: PreparedGraph,
    tables: BlockTables,
    memory: CounterMemory,
) -> None:
    """Turn every critical set into tests of the search and of blocks.

    All c add up to T, T >= target, and to the target itself if F <= 1. So c(S) <= b demands that
    c(rest) >= target - b. If F <= 1 the two are the same, and whichever of S and the rest is complete first
    decides; until then both must still be possible.
    """
    _clear_tests(mobility, plan, tables, memory)
    bundles, exact = plan.bundles, mobility <= 1
    search_lanes = (1 << (2 * plan.searched)) - 1
    for i in range(sets):
        s, bound = frame.sets[0, i], frame.sets[1, i]
        mask = 0
        for lane in range(bundles):
            b = memory.order[lane]
            if (s >> frame.ends[0, b]) & (s >> frame.ends[1, b]) & 1:
                mask |= 3 << (2 * lane)
        rest = ((1 << (2 * bundles)) - 1) & ~mask
        before = search_lanes
        open_mask = popcount(mask & ~before) // 2
        open_rest = popcount(rest & ~before) // 2
        for lower in range(2):
            part = (rest if lower else mask) & before
            limit = popcount(part) - (target - bound - 2 * open_rest) if lower else bound
            if part and popcount(part) > limit:
                _demand_of_search(
                    plan.variables, lower, part, limit, memory.variable, memory.search_tests, memory.search_due
                )
        for level in range(plan.levels):
            if open_mask == 0 or (exact and open_rest == 0):
                break
            begin, width = memory.begin[level], memory.width[level]
            subset = _lanes_of(mask, begin, width)
            size = popcount(subset)
            open_mask -= size
            open_rest -= width - size
            for lower in range(2):
                part = (rest if lower else mask) & before
                if lower:
                    limit = popcount(part) - (target - bound - 2 * open_rest)
                    useful = width > size and open_mask > 0 and limit < popcount(part)
                else:
                    limit = bound
                    useful = size > 0 and popcount(part) + 2 * size > bound
                    useful = useful and (open_rest > 0 or open_mask == 0 or not exact)
                if useful and part:
                    _demand(level, lower, part, subset, limit, 2 * size, memory.tests, memory.due)
                elif useful:
                    _restrict(level, subset, limit, lower, tables.allowed, memory.start)
            before |= ((1 << (2 * width)) - 1) << (2 * begin)
