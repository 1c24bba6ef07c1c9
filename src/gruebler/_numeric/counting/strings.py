"""Strings of binary links put on the bundles of a contracted graph, so that nothing in it is rigid.

A bundle is the set of parallel strings between two nodes; its *value* is the sorted tuple of their weights
(numbers of binary links). What counts for mobility is c = sum of 2 - min(weight, 2) over the strings of the
bundle, at most 2: an assignment of values is a chain of mobility F if and only if c(S) <= 3|S| - 4 for every
proper set S of nodes and the sums come out right. c is written in unary, two bits a bundle, so that c(S) is
one mask and one population count.

Theorems and proofs: docs/theory/enumeration.md, "Strings".
"""

from functools import cache
from math import comb
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import lowest, popcount
from gruebler._numeric.counting.packed_graph import NODES, bundle_strings, order_of, survey_graph

Int64 = NDArray[np.int64]

LANES: Final = 31  # bundles that fit a word of 64 bits, two bits each; nine loops need 24

# Columns of `Values.table` and of `Values.classes`.
COST: Final = 0  # c
EXCESS: Final = 1  # binary links above two in a string, summed
MANY: Final = 2  # values of this cost and excess
LINKS: Final = 3  # binary links that the symmetry of equal parallel strings tells apart
TURNED_LINKS: Final = 4  # ... of them those that stay when every string is reversed
JOINTS: Final = 5  # joints, in the same way
TURNED_JOINTS: Final = 6
COLUMNS: Final = 7


class Values(NamedTuple):
    """The values a bundle can take, by its number of strings, in lexicographic order."""

    size: Int64  # (strings,): how many values
    table: Int64  # (strings, value, COLUMNS)
    weights: Int64  # (strings, value, string)
    class_size: Int64  # (strings,): how many pairs of cost and excess
    classes: Int64  # (strings, class, COLUMNS): the values of one cost and excess, added up
    ways: Int64  # (z, x): how an excess of x falls on z single strings


class PreparedGraph(NamedTuple):
    """One contracted graph made ready: bundles in the order of graph6 columns, critical node sets."""

    near: Int64
    degree: Int64
    ends: Int64  # (2, bundle)
    number: Int64  # strings of the bundle
    at: Int64  # (node, node): the bundle
    inside: Int64  # subset of nodes -> bundles within, a table of 2^nodes
    sets: Int64  # (2, set): the node set, and 3|S| - 4


class WalkMemory(NamedTuple):
    """Memory of `next_strings`.

    Every critical set has two budgets, of c within it and of 2 - c outside it; a budget is one byte of a
    word, and a byte below 0 ends an attempt.
    """

    inner: Int64  # (bundle, word): 1 in the byte of every budget that its c draws on
    outer: Int64  # (bundle, word): 1 in the byte of every budget that its 2 - c draws on
    budget: Int64  # (depth, word): what is left
    state: Int64  # rows by depth: sum, excess, value


MOST_SETS: Final = 512  # critical sets there is room for; with eight loops there are at most 99


BUDGETS: Final = 2 * MOST_SETS // 8  # words that hold two bytes for every critical set
OVERDRAWN: Final = -0x7F7F7F7F7F7F7F80  # the sign bits of the eight bytes of a word


def make_prepared_graph() -> PreparedGraph:
    """Memory for one contracted graph."""
    return PreparedGraph(
        near=np.zeros(NODES, np.int64),
        degree=np.zeros(NODES, np.int64),
        ends=np.zeros((2, LANES), np.int64),
        number=np.zeros(LANES, np.int64),
        at=np.zeros((NODES, NODES), np.int64),
        inside=np.zeros(1 << NODES, np.int64),
        sets=np.zeros((2, MOST_SETS), np.int64),
    )


def make_walk_memory() -> WalkMemory:
    """Memory for `next_strings`."""
    return WalkMemory(
        inner=np.zeros((LANES, BUDGETS), np.int64),
        outer=np.zeros((LANES, BUDGETS), np.int64),
        budget=np.zeros((LANES + 1, BUDGETS), np.int64),
        state=np.zeros((3, LANES + 1), np.int64),
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


@cache
def make_values(most: int, mobility: int, highest: int = 2) -> Values:
    """The tables of values for bundles of 1 to `most` strings; shared, not to be written to."""
    lists = [bundle_values(k, mobility, highest) if k else [] for k in range(most + 1)]
    widest = max(1, *(len(values) for values in lists))
    size = np.array([len(values) for values in lists], np.int64)
    table = np.zeros((most + 1, widest, COLUMNS), np.int64)
    weights = np.zeros((most + 1, widest, most), np.int64)
    class_size = np.zeros(most + 1, np.int64)
    classes = np.zeros((most + 1, widest, COLUMNS), np.int64)
    for k, values in enumerate(lists):
        places: dict[tuple[int, int], int] = {}
        for i, value in enumerate(values):
            kinds = set(value)
            cost, excess = sum(2 - min(w, 2) for w in value), sum(max(w - 2, 0) for w in value)
            sums = [
                1,
                sum(kinds),
                sum(w % 2 for w in kinds),
                sum(w + 1 for w in kinds),
                sum(1 - w % 2 for w in kinds),
            ]
            table[k, i] = [cost, excess, *sums]
            weights[k, i, :k] = value
            place = places.setdefault((cost, excess), len(places))
            classes[k, place, :MANY] = cost, excess
            classes[k, place, MANY:] += sums
        class_size[k] = len(places)
    ways = np.array(
        [[comb(z + x - 1, x) if z else int(x == 0) for x in range(max(mobility, 1))] for z in range(LANES + 1)],
        np.int64,
    )
    return Values(size, table, weights, class_size, classes, ways)


@njit(cache=True)
def survey_strings(rows: Int64, frame: PreparedGraph) -> tuple[int, int, int]:
    """Read a packed graph into the frame; returns the numbers of nodes, bundles and critical sets.

    A set S of nodes, |S| >= 3, is critical if its bundles, c = 2 each, could break c(S) <= 3|S| - 4, and every
    node of S has at least two neighbours in S; the other sets follow from these. Cost O(2^nodes).
    """
    n = order_of(rows)
    survey_graph(n, rows, frame.near, frame.degree)
    near, inside, sets = frame.near, frame.inside, frame.sets
    bundles = 0
    for v in range(n):
        for u in range(v):
            if bundle_strings(rows, u, v):
                frame.ends[0, bundles] = u
                frame.ends[1, bundles] = v
                frame.number[bundles] = bundle_strings(rows, u, v)
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
                if found == sets.shape[1]:
                    raise ValueError("a contracted graph has more critical sets than there is room for")
                sets[0, found] = s
                sets[1, found] = 3 * size - 4
                found += 1
    return n, bundles, found


@njit(cache=True)
def set_budgets(bundles: int, sets: int, target: int, frame: PreparedGraph, memory: WalkMemory) -> int:
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
def next_strings(
    depth: int,
    bundles: int,
    words: int,
    target: int,
    mobility: int,
    number: Int64,
    values: Values,
    walk: WalkMemory,
) -> bool:
    """Go on to the next assignment of values to bundles, symmetry ignored, in lexicographic order.

    Args:
        depth: `bundles` to go on from the last assignment, 0 to begin, the rows of `walk.state` then being 0, 0, -1.
        bundles: number of bundles in the frame.
        words: what `set_budgets` returned, at least 0.
        target: 3V - 3 - F, which the sum of c - excess must reach.
        mobility: F.
        number: strings of the bundles.
        values: from `make_values`.
        walk: from `make_walk_memory`; row 2 of its state holds the numbers of the values.

    Returns:
        Whether there is one. Cost: about 100 ns.
    """
    table, size, inner, outer, budget = values.table, values.size, walk.inner, walk.outer, walk.budget
    total, excess, value = walk.state[0], walk.state[1], walk.state[2]
    spare = max(mobility - 1, 0)
    d = depth
    if d == bundles:
        d -= 1
    while d >= 0:
        k = number[d]
        value[d] += 1
        i = value[d]
        if i == size[k]:
            d -= 1
            continue
        cost, more = table[k, i, COST], table[k, i, EXCESS]
        sum_now = total[d] + cost - more
        excess_now = excess[d] + more
        if excess_now > spare or sum_now - (spare - excess_now) > target:
            continue
        if sum_now + 2 * (bundles - d - 1) < target:
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
        d += 1
        if d < bundles:
            value[d] = -1
        elif sum_now == target:
            return True
        else:
            d -= 1
    return False
