"""The number of string assignments of a contracted graph for F = 1, seven bundles at a time.

The bundles are cut into blocks of at most seven. The assignments of one block whose c adds up to a given sum
are at most 393, hence seven words of bits; a critical set leaves of them those with c(X) <= t, X being its
bundles in the block and t what the blocks before have left over: one row of a table. So the last block is not
searched at all: its assignments are what remains of seven words after a few ANDs, and they are counted.

A bundle of several strings behaves like a single one, except that c = 2 is reached by two values
(docs/theory/enumeration.md, "Strings"); such bundles stand in the blocks before the last and count double.
"""

from functools import cache
from itertools import product
from typing import Final, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from gruebler._numeric.bits import lowest, popcount
from gruebler._numeric.packed_graph import NODES
from gruebler._numeric.strings import COST, JOINTS, LANES, LINKS, Frame, Values

Int64 = NDArray[np.int64]

BLOCK: Final = 7  # bundles in a block; five or six were slower, eight need 1107 bits
SUMS: Final = 2 * BLOCK + 1
SUBSETS: Final = 1 << BLOCK
WORDS: Final = 7  # words that the assignments of one sum fill
STRIDE: Final = 8  # a row of a table is one cache line
LEVELS: Final = 5
TESTS: Final = 4096


class BlockTables(NamedTuple):
    """What is true of the c of seven bundles, the assignments of each sum numbered with c falling."""

    allowed: Int64  # ((sum * SUBSETS + X) * SUMS + t, word): bit set if c(X) <= t
    pattern: Int64  # (sum, assignment): c in unary, two bits a bundle


class Blocks(NamedTuple):
    """Memory of `count_strings`."""

    order: Int64  # lane -> bundle
    key: Int64
    place: Int64  # node -> place in the order of nodes
    begin: Int64  # level -> first lane
    width: Int64  # level -> number of lanes
    start: Int64  # (level, sum, word): the assignments that every earlier choice allows
    tests: Int64  # (level, upper or lower, test, field)
    due: Int64  # (level, upper or lower): number of tests
    left: Int64  # (level, word): assignments not yet tried
    state: Int64  # rows by level: sum of this block, current word, lanes chosen before, their sum
    weight: Int64  # (strings, c): classes of binary links and joints lost to equal strings, times two


@cache
def block_tables() -> BlockTables:
    """The tables, 2 MB, made once in about 20 ms."""
    every = np.array(list(product((2, 1, 0), repeat=BLOCK)))
    subset = (np.arange(SUBSETS)[:, None] >> np.arange(BLOCK)) & 1
    allowed = np.zeros((SUMS, SUBSETS, SUMS, STRIDE), np.int64)
    pattern = np.zeros((SUMS, 64 * WORDS), np.int64)
    for s in range(SUMS):
        c = every[every.sum(1) == s]
        bits = np.zeros((SUBSETS, SUMS, 64 * STRIDE), np.bool_)
        bits[:, :, : len(c)] = (subset @ c.T)[:, None, :] <= np.arange(SUMS)[None, :, None]
        packed = np.packbits(bits, axis=-1, bitorder="little")
        allowed[s] = packed.view("<i8")
        pattern[s, : len(c)] = (((1 << c) - 1) << (2 * np.arange(BLOCK))).sum(1)
    return BlockTables(allowed.reshape(-1, STRIDE), pattern)


def make_blocks(values: Values) -> Blocks:
    """Memory for `count_strings`; the values are those of F = 1."""
    most = values.size.shape[0] - 1
    weight = np.zeros((most + 1, 3, 3), np.int64)
    for k in range(2, most + 1):
        for i in range(values.size[k]):
            c = values.table[k, i, COST]
            links = values.weights[k, i].sum()
            weight[k, c, 0] += 1
            weight[k, c, 1] += 2 * (links - values.table[k, i, LINKS])
            weight[k, c, 2] += 2 * (links + k - values.table[k, i, JOINTS])
        weight[k, :, 1:] //= weight[k, :, :1]
    return Blocks(
        order=np.zeros(LANES, np.int64),
        key=np.zeros(LANES, np.int64),
        place=np.zeros(NODES, np.int64),
        begin=np.zeros(LEVELS + 1, np.int64),
        width=np.zeros(LEVELS, np.int64),
        start=np.zeros((LEVELS, SUMS, STRIDE), np.int64),
        tests=np.zeros((LEVELS, 2, TESTS, 4), np.int64),
        due=np.zeros((LEVELS, 2), np.int64),
        left=np.zeros((LEVELS, STRIDE), np.int64),
        state=np.zeros((4, LEVELS + 1), np.int64),
        weight=weight,
    )


@njit(cache=True)
def _arrange(n: int, bundles: int, frame: Frame, memory: Blocks) -> tuple[int, int]:
    """Order the bundles into lanes and cut them into blocks; returns the numbers of true bundles and levels.

    Bundles of several strings first, then by nodes, each node having as many neighbours as possible among
    those before it and else few neighbours, so that critical sets are complete early.
    """
    place, order, key = memory.place, memory.order, memory.key
    placed = 0
    for i in range(n):
        best = -1
        chosen = 0
        for v in range(n):
            if not (placed >> v) & 1:
                rank = 64 * popcount(frame.near[v] & placed) + 32 - popcount(frame.near[v])
                if rank > best:
                    best = rank
                    chosen = v
        place[chosen] = i
        placed |= 1 << chosen
    several = 0
    for b in range(bundles):
        a, z = place[frame.ends[0, b]], place[frame.ends[1, b]]
        rank = max(a, z) * 32 + min(a, z)
        if frame.number[b] > 1:
            several += 1
        else:
            rank += 1024
        j = b
        while j > 0 and key[j - 1] > rank:
            key[j] = key[j - 1]
            order[j] = order[j - 1]
            j -= 1
        key[j] = rank
        order[j] = b
    last = min(BLOCK, bundles - several)
    before = (bundles - last + BLOCK - 1) // BLOCK
    lane = 0
    for level in range(before):
        memory.begin[level] = lane
        memory.width[level] = bundles - last - BLOCK * (before - 1) if level == 0 else BLOCK
        lane += memory.width[level]
    memory.begin[before] = lane
    memory.width[before] = last
    return several, before + 1


@njit(cache=True)
def _restrict(level: int, subset: int, limit: int, per_sum: int, allowed: Int64, memory: Blocks) -> None:
    """Keep at this level the assignments with c(subset) <= limit + per_sum * (sum of the block)."""
    for s in range(SUMS):
        t = limit + per_sum * s
        if t < SUMS - 1:
            row = (s * SUBSETS + subset) * SUMS + max(t, 0)
            for j in range(WORDS):
                memory.start[level, s, j] &= allowed[row, j] if t >= 0 else 0


@njit(cache=True)
def _demand(level: int, lower: int, mask: int, subset: int, limit: int, most: int, memory: Blocks) -> None:
    """Note a test: c(subset) <= limit, less what the lanes of the mask have used up before."""
    test = memory.tests[level, lower, memory.due[level, lower]]
    test[0] = mask
    test[1] = subset * SUMS
    test[2] = limit
    test[3] = most
    memory.due[level, lower] += 1


@njit(cache=True)
def _place_tests(
    n: int, bundles: int, sets: int, levels: int, frame: Frame, allowed: Int64, memory: Blocks
) -> None:
    """Turn every critical set into tests of blocks.

    Since all c add up to T = 3n - 4, c(S) <= b says the same as c(rest) >= T - b. Whichever of S and the rest
    is complete first decides; until then both must still be possible.
    """
    total = 3 * n - 4
    for level in range(levels):
        memory.due[level, 0] = 0
        memory.due[level, 1] = 0
        absent = (SUBSETS - 1) & ~((1 << memory.width[level]) - 1)
        for s in range(SUMS):
            for j in range(WORDS):
                memory.start[level, s, j] = allowed[(s * SUBSETS + absent) * SUMS, j]
    for i in range(sets):
        s, bound = frame.sets[0, i], frame.sets[1, i]
        mask = 0
        for lane in range(bundles):
            b = memory.order[lane]
            if (s >> frame.ends[0, b]) & (s >> frame.ends[1, b]) & 1:
                mask |= 3 << (2 * lane)
        rest = ((1 << (2 * bundles)) - 1) & ~mask
        open_mask = popcount(mask) // 2
        open_rest = popcount(rest) // 2
        before = 0
        for level in range(levels):
            begin, width = memory.begin[level], memory.width[level]
            subset = 0
            for j in range(width):
                subset |= ((mask >> (2 * (begin + j))) & 1) << j
            size = popcount(subset)
            open_mask -= size
            open_rest -= width - size
            used = popcount(mask & before) // 2 + size
            if size and 2 * used > bound and (open_rest or open_mask == 0):
                if mask & before:
                    _demand(level, 0, mask & before, subset, bound, 2 * size, memory)
                else:
                    _restrict(level, subset, bound, 0, allowed, memory)
            needed = total - bound - 2 * open_rest
            if width > size and needed > 0 and open_mask:
                if rest & before:
                    slack = popcount(rest & before) - needed
                    _demand(level, 1, rest & before, subset, slack, 2 * size, memory)
                else:
                    _restrict(level, subset, -needed, 1, allowed, memory)
            if open_mask == 0 or open_rest == 0:
                break
            before |= ((1 << (2 * width)) - 1) << (2 * begin)


@njit(cache=True)
def count_strings(
    n: int,
    bundles: int,
    sets: int,
    orbits: bool,
    frame: Frame,
    allowed: Int64,
    pattern: Int64,
    memory: Blocks,
    lost: Int64,
) -> int:
    """The number of assignments with mobility 1, parallel strings sorted, symmetry otherwise ignored.

    Args:
        n: number of nodes, at least 3.
        bundles: number of bundles in the frame.
        sets: number of critical sets in the frame.
        orbits: whether to fill `lost`.
        frame: from `strings.survey_strings`.
        allowed: `block_tables().allowed`.
        pattern: `block_tables().pattern`.
        memory: from `make_blocks`.
        lost: int64[2]; to it are added the binary links and the joints that equal parallel strings have
            beyond their classes, summed over all assignments.

    Cost: about 4 us for each contracted graph and 3 ns for each assignment.
    """
    several, levels = _arrange(n, bundles, frame, memory)
    _place_tests(n, bundles, sets, levels, frame, allowed, memory)
    target = 3 * n - 4
    doubled = 0
    for lane in range(several):
        doubled |= 2 << (2 * lane)
    tests, due, left, start, weight = memory.tests, memory.due, memory.left, memory.start, memory.weight
    begin, size = memory.begin, memory.width
    block_sum, current, chosen, total = memory.state[0], memory.state[1], memory.state[2], memory.state[3]
    last = levels - 1
    level = 0
    chosen[0] = 0
    total[0] = 0
    block_sum[0] = -1
    current[0] = WORDS
    found = 0
    while level >= 0:
        word = chosen[level]
        width = size[level]
        if level < last:
            j = current[level]
            if j < WORDS:
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
            s = max(block_sum[level] + 1, target - total[level] - 2 * (bundles - begin[level + 1]))
            block_sum[level] = s
        else:
            s = target - total[level]
        if s < 0 or s > 2 * width or s > target - total[level]:
            level -= 1
            continue
        m0, m1, m2 = start[level, s, 0], start[level, s, 1], start[level, s, 2]
        m3, m4, m5, m6 = start[level, s, 3], start[level, s, 4], start[level, s, 5], start[level, s, 6]
        base = s * (SUBSETS * SUMS)
        possible = True
        for i in range(due[level, 0]):
            t = tests[level, 0, i, 2] - popcount(word & tests[level, 0, i, 0])
            if t < 0:
                possible = False
                break
            if t < s and t < tests[level, 0, i, 3]:
                row = base + tests[level, 0, i, 1] + t
                m0 &= allowed[row, 0]
                m1 &= allowed[row, 1]
                m2 &= allowed[row, 2]
                m3 &= allowed[row, 3]
                m4 &= allowed[row, 4]
                m5 &= allowed[row, 5]
                m6 &= allowed[row, 6]
        if level == last:
            if possible:
                count = popcount(m0) + popcount(m1) + popcount(m2) + popcount(m3)
                count += popcount(m4) + popcount(m5) + popcount(m6)
                count <<= popcount(word & doubled)
                found += count
                if orbits and several:
                    links, joints = 0, 0
                    for lane in range(several):
                        c = popcount((word >> (2 * lane)) & 3)
                        k = frame.number[memory.order[lane]]
                        links += weight[k, c, 1]
                        joints += weight[k, c, 2]
                    lost[0] += count * links // 2
                    lost[1] += count * joints // 2
            level -= 1
            continue
        if possible:
            for i in range(due[level, 1]):
                t = s + tests[level, 1, i, 2] - popcount(~word & tests[level, 1, i, 0])
                if t < 0:
                    possible = False
                    break
                if t < s and t < tests[level, 1, i, 3]:
                    row = base + tests[level, 1, i, 1] + t
                    m0 &= allowed[row, 0]
                    m1 &= allowed[row, 1]
                    m2 &= allowed[row, 2]
                    m3 &= allowed[row, 3]
                    m4 &= allowed[row, 4]
                    m5 &= allowed[row, 5]
                    m6 &= allowed[row, 6]
        if possible:
            left[level, 0], left[level, 1], left[level, 2], left[level, 3] = m0, m1, m2, m3
            left[level, 4], left[level, 5], left[level, 6] = m4, m5, m6
            current[level] = 0
    return found
