"""The number of string assignments that an automorphism of the contracted graph leaves as they are.

The bundles that the automorphism moves are searched, one value for each orbit of them. The others are cut into
blocks of at most seven. The assignments of one block whose c adds up to a given sum are at most 393, hence
seven words of bits; a critical set leaves of them those with c(X) <= t, X being its bundles in the block and t
what everything before has left over: one row of a table. So the last block is not searched at all: its
assignments are what remains of seven words after a few ANDs, and they are counted.

Theorems: docs/theory/enumeration.md, "Strings" and "Symmetry".
"""

from functools import cache
from itertools import product
from typing import Final, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from gruebler._numeric.bits import lowest, popcount
from gruebler._numeric.packed_graph import NODES
from gruebler._numeric.strings import (
    COST,
    EXCESS,
    JOINTS,
    LANES,
    LINKS,
    MANY,
    MOST_SETS,
    TURNED_JOINTS,
    TURNED_LINKS,
    Frame,
    Values,
)

Int64 = NDArray[np.int64]
Float64 = NDArray[np.float64]

BLOCK: Final = 7  # bundles in a block; with five or six the search before it grows more than this saves
SUMS: Final = 2 * BLOCK + 1
SUBSETS: Final = 1 << BLOCK
WORDS: Final = 7  # words that the assignments of one sum fill
STRIDE: Final = 8  # a row of a table is one cache line
LEVELS: Final = 5  # blocks; four hold 28 bundles
LOW: Final = 0x5555555555555555  # the lower bit of every lane

# How an automorphism treats a bundle.
MOVED: Final = 0
FIXED: Final = 1
TURNED: Final = 2

# Fields of a test: c(subset) <= limit - (what the masked lanes have used), trivial from `most` on.
MASK: Final = 0
SUBSET: Final = 1
LIMIT: Final = 2
MOST: Final = 3

# What `count_strings` adds up.
FOUND: Final = 0
LINK_CLASSES: Final = 1
JOINT_CLASSES: Final = 2
FLAG_CLASSES: Final = 3


class BlockTables(NamedTuple):
    """What is true of the c of seven bundles, the assignments of each sum numbered with c falling."""

    allowed: Int64  # ((sum * SUBSETS + X) * SUMS + t, word): bit set if c(X) <= t
    zeros: Int64  # (sum, z, word): bit set if z of the seven are 0
    pattern: Int64  # (sum, assignment): c in unary, two bits a bundle


class Counter(NamedTuple):
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
    tests: Int64  # (level, upper or lower, test, field)
    due: Int64  # (level, upper or lower): number of tests
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


def make_counter() -> Counter:
    """Memory for `count_strings`."""
    return Counter(
        order=np.zeros(LANES, np.int64),
        key=np.zeros(LANES, np.int64),
        place=np.zeros(NODES, np.int64),
        seen=np.zeros(LANES, np.int64),
        variable=np.zeros((4, LANES + 1), np.int64),
        search_tests=np.zeros((2, LANES, MOST_SETS, 4), np.int64),
        search_due=np.zeros((2, LANES), np.int64),
        search=np.zeros((8, LANES + 1), np.int64),
        begin=np.zeros(LEVELS + 1, np.int64),
        width=np.zeros(LEVELS, np.int64),
        start=np.zeros((LEVELS, SUMS, STRIDE), np.int64),
        tests=np.zeros((LEVELS, 2, MOST_SETS, 4), np.int64),
        due=np.zeros((LEVELS, 2), np.int64),
        left=np.zeros((LEVELS, STRIDE), np.int64),
        state=np.zeros((4, LEVELS + 1), np.int64),
        bulk=np.zeros(1, np.float64),
    )


@njit(cache=True)
def _order_nodes(n: int, near: Int64, place: Int64) -> None:
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
def _arrange(bundles: int, mobility: int, image: Int64, frame: Frame, memory: Counter) -> tuple[int, int, int]:
    """Give lanes to the bundles; returns the numbers of variables, searched lanes and levels.

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
    return variables, searched, before + 1


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
    i = due[level, lower]
    tests[level, lower, i, MASK] = mask
    tests[level, lower, i, SUBSET] = subset * SUMS
    tests[level, lower, i, LIMIT] = limit
    tests[level, lower, i, MOST] = most
    due[level, lower] += 1


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
def _clear_tests(mobility: int, variables: int, levels: int, tables: BlockTables, memory: Counter) -> None:
    """No tests yet; only the lanes that a block lacks are 0, and with F = 0 no other ones."""
    for v in range(variables):
        memory.search_due[0, v] = 0
        memory.search_due[1, v] = 0
    for level in range(levels):
        memory.due[level, 0] = 0
        memory.due[level, 1] = 0
        missing = BLOCK - memory.width[level]
        absent = (SUBSETS - 1) & ~((1 << memory.width[level]) - 1)
        for s in range(SUMS):
            for j in range(WORDS):
                memory.start[level, s, j] = tables.allowed[(s * SUBSETS + absent) * SUMS, j]
                if mobility == 0:
                    memory.start[level, s, j] &= tables.zeros[s, missing, j]


@njit(cache=True)
def _place_tests(
    bundles: int,
    sets: int,
    variables: int,
    searched: int,
    levels: int,
    target: int,
    mobility: int,
    frame: Frame,
    tables: BlockTables,
    memory: Counter,
) -> None:
    """Turn every critical set into tests of the search and of blocks.

    All c add up to T, T >= target, and to the target itself if F <= 1. So c(S) <= b demands that
    c(rest) >= target - b. If F <= 1 the two are the same, and whichever of S and the rest is complete first
    decides; until then both must still be possible.
    """
    _clear_tests(mobility, variables, levels, tables, memory)
    exact = mobility <= 1
    search_lanes = (1 << (2 * searched)) - 1
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
                    variables, lower, part, limit, memory.variable, memory.search_tests, memory.search_due
                )
        for level in range(levels):
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


@njit(cache=True)
def _add_orbits(
    many: int,
    x: int,
    s: int,
    depth: int,
    searched: int,
    last: int,
    word: int,
    frame: Frame,
    values: Values,
    memory: Counter,
    totals: Int64,
) -> None:
    """Add the classes of links, joints and flags of `many` assignments of the last block.

    They share the excess x of single strings, the sum s of the block, and what stands before, the word. All
    bundles in blocks are fixed: single strings have 2 lanes - sum + x binary links together and one joint
    more for each; bundles of several strings (F = 1, only before the last block) stand for all values of
    their class.
    """
    search = memory.search
    count, links, joints, flags = search[4, depth], search[5, depth], search[6, depth], search[7, depth]
    several_links, several_joints, weight, lane = 0, 0, 1, searched
    while lane < memory.begin[last] and frame.number[memory.order[lane]] > 1:
        k = frame.number[memory.order[lane]]
        i = 0
        while values.classes[k, i, COST] != popcount((word >> (2 * lane)) & 3):
            i += 1
        own = values.classes[k, i, MANY]
        several_links = several_links * own + weight * values.classes[k, i, LINKS]
        several_joints = several_joints * own + weight * values.classes[k, i, JOINTS]
        weight *= own
        lane += 1
    single = memory.begin[last] + memory.width[last] - lane
    c = s + popcount(word & ~((1 << (2 * lane)) - 1))
    here_links = several_links + weight * (2 * single - c + x)
    here_joints = several_joints + weight * (3 * single - c + x)
    totals[LINK_CLASSES] += many * (links * weight + count * here_links)
    totals[JOINT_CLASSES] += many * (joints * weight + count * here_joints)
    totals[FLAG_CLASSES] += many * (flags * weight + 2 * count * here_joints)


@njit(cache=True)
def _count_blocks(
    depth: int,
    bundles: int,
    searched: int,
    levels: int,
    target: int,
    spare: int,
    orbits: bool,
    frame: Frame,
    values: Values,
    tables: BlockTables,
    memory: Counter,
    totals: Int64,
) -> None:
    """Go through the blocks for one result of the search.

    `spare` is the excess that single strings may still have: x of it falls on the z strings with c = 0 in
    C(z + x - 1, x) ways.
    """
    allowed, pattern, zeros, ways = tables.allowed, tables.pattern, tables.zeros, values.ways
    tests, due, left, start = memory.tests, memory.due, memory.left, memory.start
    begin, size = memory.begin, memory.width
    block_sum, current, chosen, total = memory.state[0], memory.state[1], memory.state[2], memory.state[3]
    several = 0
    lane = searched
    last = levels - 1
    while lane < begin[last] and frame.number[memory.order[lane]] > 1:
        several |= 2 << (2 * lane)
        lane += 1
    singles = ((1 << (2 * begin[last])) - 1) & ~((1 << (2 * lane)) - 1) & LOW
    level = 0
    chosen[0] = memory.search[1, depth]
    total[0] = memory.search[2, depth]
    block_sum[0] = -1
    current[0] = WORDS
    while level >= 0:
        word = chosen[level]
        width = size[level]
        if level < last and current[level] < WORDS:
            j = current[level]
            bits = left[level, j]
            if bits == 0:
                current[level] = j + 1
                continue
            left[level, j] = bits & (bits - 1)
            s = block_sum[level]
            chosen[level + 1] = word | (pattern[s, (j << 6) | lowest(bits)] << (2 * begin[level]))
            total[level + 1] = total[level] + s
            level += 1
            block_sum[level] = -1
            current[level] = WORDS
            continue
        lowest_sum = target - total[level]
        highest_sum = min(2 * width, lowest_sum + spare)
        if level < last:
            lowest_sum -= 2 * (bundles - begin[level + 1])
        s = max(block_sum[level] + 1, lowest_sum)
        if s > highest_sum:
            level -= 1
            continue
        block_sum[level] = s
        m0, m1, m2 = start[level, s, 0], start[level, s, 1], start[level, s, 2]
        m3, m4, m5, m6 = start[level, s, 3], start[level, s, 4], start[level, s, 5], start[level, s, 6]
        base = s * (SUBSETS * SUMS)
        possible = True
        for i in range(due[level, 0]):
            t = tests[level, 0, i, LIMIT] - popcount(word & tests[level, 0, i, MASK])
            if t < 0:
                possible = False
                break
            if t < s and t < tests[level, 0, i, MOST]:
                row = base + tests[level, 0, i, SUBSET] + t
                m0 &= allowed[row, 0]
                m1 &= allowed[row, 1]
                m2 &= allowed[row, 2]
                m3 &= allowed[row, 3]
                m4 &= allowed[row, 4]
                m5 &= allowed[row, 5]
                m6 &= allowed[row, 6]
        if not possible:
            continue
        for i in range(due[level, 1]):
            t = s + tests[level, 1, i, LIMIT] - popcount(~word & tests[level, 1, i, MASK])
            if t < 0:
                possible = False
                break
            if t < s and t < tests[level, 1, i, MOST]:
                row = base + tests[level, 1, i, SUBSET] + t
                m0 &= allowed[row, 0]
                m1 &= allowed[row, 1]
                m2 &= allowed[row, 2]
                m3 &= allowed[row, 3]
                m4 &= allowed[row, 4]
                m5 &= allowed[row, 5]
                m6 &= allowed[row, 6]
        if not possible:
            continue
        if level < last:
            left[level, 0], left[level, 1], left[level, 2], left[level, 3] = m0, m1, m2, m3
            left[level, 4], left[level, 5], left[level, 6] = m4, m5, m6
            current[level] = 0
            continue
        x = s - (target - total[level])
        if x == 0:
            many = popcount(m0) + popcount(m1) + popcount(m2) + popcount(m3)
            many += popcount(m4) + popcount(m5) + popcount(m6)
        else:
            many = 0
            empty = popcount(~word & singles) - (BLOCK - width)
            for z in range(BLOCK + 1):
                if empty + z > 0:
                    here = popcount(m0 & zeros[s, z, 0]) + popcount(m1 & zeros[s, z, 1])
                    here += popcount(m2 & zeros[s, z, 2]) + popcount(m3 & zeros[s, z, 3])
                    here += popcount(m4 & zeros[s, z, 4]) + popcount(m5 & zeros[s, z, 5])
                    here += popcount(m6 & zeros[s, z, 6])
                    many += here * ways[empty + z, x]
        if many:
            found = (many * memory.search[4, depth]) << popcount(word & several)
            totals[FOUND] += found
            memory.bulk[0] += found
            if orbits:
                _add_orbits(many, x, s, depth, searched, last, word, frame, values, memory, totals)


@njit(cache=True)
def count_strings(
    n: int,
    bundles: int,
    sets: int,
    image: Int64,
    mobility: int,
    orbits: bool,
    frame: Frame,
    values: Values,
    tables: BlockTables,
    memory: Counter,
    totals: Int64,
) -> None:
    """Count the assignments that an automorphism of the contracted graph leaves as they are.

    Args:
        n: number of nodes.
        bundles: number of bundles in the frame.
        sets: number of critical sets in the frame.
        image: node -> its image under the automorphism.
        mobility: F.
        orbits: whether to fill more than the first of the totals.
        frame: from `strings.survey_strings`.
        values: from `strings.make_values`, for this mobility (and with c <= 3 if n = 2 and F = 0).
        tables: `block_tables()`.
        memory: from `make_counter`.
        totals: int64[4]; to it are added their number and, summed over them, the classes of binary links, of
            joints and of (link, joint at it) that the automorphism leaves where they are, equal parallel
            strings being one class.

    Cost: about 4 us for each contracted graph and 3 ns for each assignment if F = 1.
    """
    target = 3 * n - 3 - mobility
    spare = max(mobility - 1, 0)
    _order_nodes(n, frame.near, memory.place)
    variables, searched, levels = _arrange(bundles, mobility, image, frame, memory)
    _place_tests(bundles, sets, variables, searched, levels, target, mobility, frame, tables, memory)
    variable, search, due, tests = memory.variable, memory.search, memory.search_due, memory.search_tests
    classes, size = values.classes, values.class_size
    search[0, 0] = -1
    for i in range(1, 8):
        search[i, 0] = 1 if i == 4 else 0
    d = 0
    while d >= 0:
        if d == variables:
            _count_blocks(
                variables, bundles, searched, levels, target, spare - search[3, d], orbits, frame, values, tables,
                memory, totals,
            )  # fmt: skip
            d -= 1
            continue
        k, length = variable[2, d], variable[1, d]
        search[0, d] += 1
        i = search[0, d]
        if i == size[k]:
            d -= 1
            continue
        cost, more = classes[k, i, COST], classes[k, i, EXCESS]
        sum_now = search[2, d] + length * (cost - more)
        excess_now = search[3, d] + length * more
        after = bundles - variable[0, d] - length
        if excess_now > spare or sum_now - (spare - excess_now) > target or sum_now + 2 * after < target:
            continue
        word = search[1, d]
        for lane in range(variable[0, d], variable[0, d] + length):
            word |= ((1 << min(cost, 2)) - 1) << (2 * lane)
        possible = True
        for j in range(due[0, d]):
            if popcount(word & tests[0, d, j, MASK]) > tests[0, d, j, LIMIT]:
                possible = False
                break
        if not possible:
            continue
        for j in range(due[1, d]):
            if popcount(~word & tests[1, d, j, MASK]) > tests[1, d, j, LIMIT]:
                possible = False
                break
        if not possible:
            continue
        many, count, manner = classes[k, i, MANY], search[4, d], variable[3, d]
        search[1, d + 1] = word
        search[2, d + 1] = sum_now
        search[3, d + 1] = excess_now
        search[4, d + 1] = count * many
        search[5, d + 1] = search[5, d] * many
        search[6, d + 1] = search[6, d] * many
        search[7, d + 1] = search[7, d] * many
        if manner == FIXED:
            search[5, d + 1] += count * classes[k, i, LINKS]
            search[6, d + 1] += count * classes[k, i, JOINTS]
            search[7, d + 1] += 2 * count * classes[k, i, JOINTS]
        elif manner == TURNED:
            search[5, d + 1] += count * classes[k, i, TURNED_LINKS]
            search[6, d + 1] += count * classes[k, i, TURNED_JOINTS]
        d += 1
        search[0, d] = -1
