"""Strings of binary links put on the bundles of a contracted graph, so that nothing in it is rigid.

A bundle is the set of parallel strings between two nodes; its *value* is the sorted tuple of their weights
(numbers of binary links). What counts for mobility is c = sum of 2 - min(weight, 2) over the strings of the
bundle, at most 2: an assignment of values is a chain of mobility F if and only if c(S) <= 3|S| - 4 for every
proper set S of nodes and the sums come out right. c is written in unary, two bits a bundle, so that c(S) is
one mask and one population count.

Theorems and proofs: docs/theory/enumeration.md, "Strings".
"""

from typing import Final, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from gruebler._numeric.bits import lowest, popcount
from gruebler._numeric.packed_graph import NODES, order_of, strings, survey

Int64 = NDArray[np.int64]

LANES: Final = 31  # bundles that fit a word of 64 bits, two bits each; nine loops need 24

# Columns of `Values.table`.
COST: Final = 0  # c
EXCESS: Final = 1  # binary links above two in a string, summed
LINKS: Final = 2  # binary links that the symmetry of equal parallel strings tells apart
TURNED_LINKS: Final = 3  # ... of them those that stay when every string is reversed
JOINTS: Final = 4  # joints, in the same way
TURNED_JOINTS: Final = 5
COLUMNS: Final = 6

# How an automorphism treats a bundle.
MOVED: Final = 0
FIXED: Final = 1
TURNED: Final = 2


class Values(NamedTuple):
    """The values a bundle can take, by its number of strings, in lexicographic order."""

    size: Int64  # (strings,): how many values
    table: Int64  # (strings, value, COLUMNS)
    weights: Int64  # (strings, value, string)


class Frame(NamedTuple):
    """One contracted graph made ready: bundles in the order of graph6 columns, critical node sets."""

    near: Int64
    degree: Int64
    ends: Int64  # (2, bundle)
    number: Int64  # strings of the bundle
    at: Int64  # (node, node): the bundle
    inside: Int64  # subset of nodes -> bundles within, a table of 2^nodes
    sets: Int64  # (2, set): the node set, and 3|S| - 4


class Walk(NamedTuple):
    """Memory of `walk`: variables are the orbits of bundles under one automorphism.

    Every critical set has two budgets, of c within it and of 2 - c outside it; a budget is one byte of a word.
    """

    variable: Int64  # bundle -> variable
    lead: Int64  # variable -> its first bundle
    length: Int64
    manner: Int64  # MOVED, FIXED or TURNED
    inner: Int64  # (bundle, word): 1 in the byte of every budget that its c draws on
    outer: Int64  # (bundle, word): 1 in the byte of every budget that its 2 - c draws on
    inner_sum: Int64  # the same for (variable, word)
    outer_sum: Int64
    budget: Int64  # (depth, word): what is left
    state: Int64  # rows by depth: sum, excess, links, joints, flags, value


MOST_SETS: Final = 2048  # critical sets there is room for; the largest number met is 330 (nine loops)


BUDGETS: Final = 2 * MOST_SETS // 8  # words that hold two bytes for every critical set
OVERDRAWN: Final = -0x7F7F7F7F7F7F7F80  # the sign bits of the eight bytes of a word


def make_frame() -> Frame:
    """Memory for one contracted graph."""
    return Frame(
        near=np.zeros(NODES, np.int64),
        degree=np.zeros(NODES, np.int64),
        ends=np.zeros((2, LANES), np.int64),
        number=np.zeros(LANES, np.int64),
        at=np.zeros((NODES, NODES), np.int64),
        inside=np.zeros(1 << NODES, np.int64),
        sets=np.zeros((2, MOST_SETS), np.int64),
    )


def make_walk() -> Walk:
    """Memory for `walk`."""
    return Walk(
        variable=np.zeros(LANES, np.int64),
        lead=np.zeros(LANES, np.int64),
        length=np.zeros(LANES, np.int64),
        manner=np.zeros(LANES, np.int64),
        inner=np.zeros((LANES, BUDGETS), np.int64),
        outer=np.zeros((LANES, BUDGETS), np.int64),
        inner_sum=np.zeros((LANES, BUDGETS), np.int64),
        outer_sum=np.zeros((LANES, BUDGETS), np.int64),
        budget=np.zeros((LANES + 1, BUDGETS), np.int64),
        state=np.zeros((6, LANES + 1), np.int64),
    )


def bundle_values(strings_: int, mobility: int, highest: int = 2) -> list[tuple[int, ...]]:
    """The values of a bundle: sorted weights with c <= highest and an excess that the mobility allows.

    With F = 0 no string has more than one link; with F >= 1 the excess is at most F - 1. Between two nodes
    that are not the whole graph, and for F >= 1 between any two, c is at most 2.

    >>> bundle_values(1, 1), bundle_values(2, 1)
    ([(0,), (1,), (2,)], [(0, 2), (1, 1), (1, 2), (2, 2)])
    >>> bundle_values(1, 0), bundle_values(1, 3)
    ([(0,), (1,)], [(0,), (1,), (2,), (3,), (4,)])
    """
    longest = mobility + 1
    found: list[tuple[int, ...]] = []

    def extend(head: tuple[int, ...], cost: int, excess: int) -> None:
        if cost > highest or excess > max(mobility - 1, 0):
            return
        if len(head) == strings_:
            found.append(head)
            return
        for w in range(head[-1] if head else 0, longest + 1):
            extend((*head, w), cost + 2 - min(w, 2), excess + max(w - 2, 0))

    extend((), 0, 0)
    return found


def make_values(most: int, mobility: int, highest: int = 2) -> Values:
    """The tables of values for bundles of 1 to `most` strings."""
    lists = [bundle_values(k, mobility, highest) if k else [] for k in range(most + 1)]
    widest = max(len(values) for values in lists)
    size = np.array([len(values) for values in lists], np.int64)
    table = np.zeros((most + 1, max(widest, 1), COLUMNS), np.int64)
    weights = np.zeros((most + 1, max(widest, 1), most), np.int64)
    for k, values in enumerate(lists):
        for i, value in enumerate(values):
            kinds = set(value)
            table[k, i, COST] = sum(2 - min(w, 2) for w in value)
            table[k, i, EXCESS] = sum(max(w - 2, 0) for w in value)
            table[k, i, LINKS] = sum(kinds)
            table[k, i, TURNED_LINKS] = sum(w % 2 for w in kinds)
            table[k, i, JOINTS] = sum(w + 1 for w in kinds)
            table[k, i, TURNED_JOINTS] = sum(1 - w % 2 for w in kinds)
            weights[k, i, :k] = value
    return Values(size, table, weights)


@njit(cache=True)
def survey_strings(rows: Int64, frame: Frame) -> tuple[int, int, int]:
    """Read a packed graph into the frame; returns the numbers of nodes, bundles and critical sets.

    A set S of nodes, |S| >= 3, is critical if its bundles, c = 2 each, could break c(S) <= 3|S| - 4, and every
    node of S has at least two neighbours in S; the other sets follow from these. Cost O(2^nodes).
    """
    n = order_of(rows)
    survey(n, rows, frame.near, frame.degree)
    near, inside, sets = frame.near, frame.inside, frame.sets
    bundles = 0
    for v in range(n):
        for u in range(v):
            if strings(rows, u, v):
                frame.ends[0, bundles] = u
                frame.ends[1, bundles] = v
                frame.number[bundles] = strings(rows, u, v)
                frame.at[u, v] = bundles
                frame.at[v, u] = bundles
                bundles += 1
    found = 0
    for s in range(1, (1 << n) - 1):
        rest = s & (s - 1)
        within = inside[rest] + popcount(near[lowest(s)] & rest)
        inside[s] = within
        size = popcount(s)
        if size > 2 and 2 * within > 3 * size - 4:
            bits = s
            while bits:
                around = near[lowest(bits)] & s
                if around & (around - 1) == 0:
                    break
                bits &= bits - 1
            if bits == 0:
                sets[0, found] = s
                sets[1, found] = 3 * size - 4
                found += 1
    return n, bundles, found


@njit(cache=True)
def set_budgets(bundles: int, sets: int, target: int, frame: Frame, memory: Walk) -> int:
    """Write down the budgets of the critical sets; returns the number of words they fill, -1 if none can hold.

    Since all c add up to the target at least, c(S) <= b leaves 2 - c outside S a budget of its own. It says
    nothing new once every bundle has its value, but it ends vain attempts early.
    """
    used = 0
    for i in range(sets):
        s, bound = frame.sets[0, i], frame.sets[1, i]
        outside = 0
        for b in range(bundles):
            if not (s >> frame.ends[0, b]) & (s >> frame.ends[1, b]) & 1:
                outside += 1
        for kind in range(2):
            limit = bound if kind == 0 else 2 * outside - (target - bound)
            if kind == 1 and limit >= 2 * outside:
                continue
            if limit < 0:
                return -1
            word, shift = used >> 3, (used & 7) << 3
            if shift == 0:
                memory.budget[0, word] = 0
                for b in range(bundles):
                    memory.inner[b, word] = 0
                    memory.outer[b, word] = 0
            memory.budget[0, word] |= limit << shift
            for b in range(bundles):
                within = (s >> frame.ends[0, b]) & (s >> frame.ends[1, b]) & 1
                if kind == 0 and within:
                    memory.inner[b, word] |= 1 << shift
                if kind == 1 and not within:
                    memory.outer[b, word] |= 1 << shift
            used += 1
    return (used + 7) >> 3


@njit(cache=True)
def _variables(bundles: int, words: int, image: Int64, frame: Frame, memory: Walk) -> int:
    """Gather the bundles into the orbits of one automorphism; returns the number of orbits."""
    variable, lead = memory.variable, memory.lead
    for b in range(bundles):
        variable[b] = -1
    found = 0
    for b in range(bundles):
        if variable[b] >= 0:
            continue
        lead[found] = b
        for j in range(words):
            memory.inner_sum[found, j] = 0
            memory.outer_sum[found, j] = 0
        length = 0
        c = b
        while variable[c] < 0:
            variable[c] = found
            for j in range(words):
                memory.inner_sum[found, j] += memory.inner[c, j]
                memory.outer_sum[found, j] += memory.outer[c, j]
            length += 1
            c = frame.at[image[frame.ends[0, c]], image[frame.ends[1, c]]]
        memory.length[found] = length
        if length > 1:
            memory.manner[found] = MOVED
        else:
            memory.manner[found] = FIXED if image[frame.ends[0, b]] == frame.ends[0, b] else TURNED
        found += 1
    return found


@njit(cache=True)
def walk(
    bundles: int,
    words: int,
    image: Int64,
    target: int,
    mobility: int,
    frame: Frame,
    values: Values,
    memory: Walk,
    totals: Int64,
    out: Int64,
) -> int:
    """Go through the assignments that an automorphism of the contracted graph leaves as they are.

    Args:
        bundles: number of bundles in the frame.
        words: what `set_budgets` returned.
        image: node -> its image under the automorphism.
        target: 3V - 3 - F, which the sum of c - excess must reach.
        mobility: F.
        frame: from `survey_strings`.
        values: from `make_values`.
        memory: from `make_walk`.
        totals: int64[3]; to it are added, summed over the assignments, the classes of binary links, of joints
            and of (link, joint at it) that the automorphism leaves where they are, equal parallel strings
            being one class.
        out: int64[k, bundles]; the numbers of the values are written here, in lexicographic order, if k > 0.

    Returns:
        The number of these assignments; `out` must have room for them.

    Cost: about 10 ns for each value tried.
    """
    if words < 0:
        return 0
    variables = _variables(bundles, words, image, frame, memory)
    state = memory.state
    total, excess, links, joints, flags, value = state[0], state[1], state[2], state[3], state[4], state[5]
    table, size, number = values.table, values.size, frame.number
    inner, outer, budget, variable = memory.inner_sum, memory.outer_sum, memory.budget, memory.variable
    lead, length, manner = memory.lead, memory.length, memory.manner
    spare = max(mobility - 1, 0)
    after = bundles  # bundles whose value is still open
    found = 0
    d = 0
    value[0] = -1
    for i in range(5):
        state[i, 0] = 0
    while d >= 0:
        if d == variables:
            if total[d] == target:
                totals[0] += links[d]
                totals[1] += joints[d]
                totals[2] += flags[d]
                if out.shape[0]:
                    for b in range(bundles):
                        out[found, b] = value[variable[b]]
                found += 1
            d -= 1
            after += length[d]
            continue
        strings_ = number[lead[d]]
        value[d] += 1
        if value[d] == size[strings_]:
            d -= 1
            if d >= 0:
                after += length[d]
            continue
        i = value[d]
        cost, more = table[strings_, i, COST], table[strings_, i, EXCESS]
        times = length[d]
        sum_now = total[d] + times * (cost - more)
        excess_now = excess[d] + times * more
        if excess_now > spare or sum_now - (spare - excess_now) > target:
            continue
        if sum_now + 2 * (after - times) < target:
            continue
        overdrawn = 0
        for j in range(words):
            left = budget[d, j] - cost * inner[d, j] - (2 - cost) * outer[d, j]
            budget[d + 1, j] = left
            overdrawn |= left
        if overdrawn & OVERDRAWN:
            continue
        total[d + 1] = sum_now
        excess[d + 1] = excess_now
        links[d + 1] = links[d]
        joints[d + 1] = joints[d]
        flags[d + 1] = flags[d]
        if manner[d] == FIXED:
            links[d + 1] += table[strings_, i, LINKS]
            joints[d + 1] += table[strings_, i, JOINTS]
            flags[d + 1] += 2 * table[strings_, i, JOINTS]
        elif manner[d] == TURNED:
            links[d + 1] += table[strings_, i, TURNED_LINKS]
            joints[d + 1] += table[strings_, i, TURNED_JOINTS]
        after -= times
        d += 1
        if d < variables:
            value[d] = -1
    return found
