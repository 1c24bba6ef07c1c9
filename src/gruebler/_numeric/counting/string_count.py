"""The number of string assignments that an automorphism of the contracted graph leaves as they are.

The bundles in blocks but the last are gone through as words of bits, a whole block at a time; the last block is
not searched at all: its assignments are what remains of seven words after a few ANDs, and they are counted.

Theorems: docs/theory/enumeration.md, "Counting without listing" and "Symmetry".
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import lowest, popcount
from gruebler._numeric.counting.string_blocks import (
    BLOCK,
    FIXED,
    LIMIT,
    MASK,
    MOST,
    SUBSET,
    SUBSETS,
    SUMS,
    TURNED,
    WORDS,
    BlockPlan,
    BlockTables,
    CounterMemory,
    arrange_blocks,
    order_nodes,
    place_tests,
)
from gruebler._numeric.counting.strings import (
    COST,
    EXCESS,
    JOINTS,
    LINKS,
    MANY,
    MOST_SETS,
    TURNED_JOINTS,
    TURNED_LINKS,
    PreparedGraph,
    Values,
)

Int64 = NDArray[np.int64]

LOW: Final = 0x5555555555555555  # the lower bit of every lane

# What `count_strings` adds up.
FOUND: Final = 0
LINK_CLASSES: Final = 1
JOINT_CLASSES: Final = 2
FLAG_CLASSES: Final = 3


@njit(cache=True)
def _add_orbits(
    many: int,
    x: int,
    s: int,
    depth: int,
    searched: int,
    last: int,
    word: int,
    frame: PreparedGraph,
    values: Values,
    memory: CounterMemory,
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
    plan: BlockPlan,
    target: int,
    spare: int,
    orbits: bool,
    frame: PreparedGraph,
    values: Values,
    tables: BlockTables,
    memory: CounterMemory,
    totals: Int64,
) -> None:
    """Go through the blocks for one result of the search.

    `spare` is the excess that single strings may still have: x of it falls on the z strings with c = 0 in
    C(z + x - 1, x) ways.
    """
    bundles, searched = plan.bundles, plan.searched
    allowed, pattern, zeros, ways = tables.allowed, tables.pattern, tables.zeros, values.ways
    tests, due, left, start = memory.tests, memory.due, memory.left, memory.start
    begin, size = memory.begin, memory.width
    block_sum, current, chosen, total = memory.state[0], memory.state[1], memory.state[2], memory.state[3]
    several = 0
    lane = searched
    last = plan.levels - 1
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
        first = 2 * level * MOST_SETS
        for i in range(first, first + due[2 * level]):
            t = tests[i, LIMIT] - popcount(word & tests[i, MASK])
            if t < 0:
                possible = False
                break
            if t < s and t < tests[i, MOST]:
                row = base + tests[i, SUBSET] + t
                m0 &= allowed[row, 0]
                m1 &= allowed[row, 1]
                m2 &= allowed[row, 2]
                m3 &= allowed[row, 3]
                m4 &= allowed[row, 4]
                m5 &= allowed[row, 5]
                m6 &= allowed[row, 6]
        if not possible:
            continue
        first += MOST_SETS
        for i in range(first, first + due[2 * level + 1]):
            t = s + tests[i, LIMIT] - popcount(~word & tests[i, MASK])
            if t < 0:
                possible = False
                break
            if t < s and t < tests[i, MOST]:
                row = base + tests[i, SUBSET] + t
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
            count = (many * memory.search[4, depth]) << popcount(word & several)
            totals[FOUND] += count
            memory.bulk[0] += count
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
    frame: PreparedGraph,
    values: Values,
    tables: BlockTables,
    memory: CounterMemory,
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
        tables: `string_blocks.block_tables()`.
        memory: from `string_blocks.make_counter`.
        totals: int64[4]; to it are added their number and, summed over them, the classes of binary links, of
            joints and of (link, joint at it) that the automorphism leaves where they are, equal parallel
            strings being one class.

    Cost: about 4 us for each contracted graph and 3 ns for each assignment if F = 1.
    """
    target = 3 * n - 3 - mobility
    spare = max(mobility - 1, 0)
    order_nodes(n, frame.near, memory.place)
    plan = arrange_blocks(bundles, mobility, image, frame, memory)
    place_tests(plan, sets, target, mobility, frame, tables, memory)
    variables = plan.variables
    variable, search, due, tests = memory.variable, memory.search, memory.search_due, memory.search_tests
    classes, size = values.classes, values.class_size
    search[0, 0] = -1
    for i in range(1, 8):
        search[i, 0] = 1 if i == 4 else 0
    d = 0
    while d >= 0:
        if d == variables:
            _count_blocks(variables, plan, target, spare - search[3, d], orbits, frame, values, tables, memory, totals)
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
