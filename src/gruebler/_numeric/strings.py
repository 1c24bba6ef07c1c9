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
    """Memory of `walk`: variables are the orbits of bundles under one automorphism."""

    variable: Int64  # bundle -> variable
    lead: Int64  # variable -> its first bundle
    length: Int64
    manner: Int64  # MOVED, FIXED or TURNED
    lanes: Int64  # the low bits of its bundles
    masks: Int64  # (variable, test)
    limits: Int64
    tests: Int64  # variable -> number of tests due when it gets its value
    state: Int64  # rows by depth: word, sum, excess, links, joints, flags, value


MOST_SETS: Final = 4096  # critical sets there is room for; the largest number met is 330 (nine loops)


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
        lanes=np.zeros(LANES, np.int64),
        masks=np.zeros((LANES, MOST_SETS), np.int64),
        limits=np.zeros((LANES, MOST_SETS), np.int64),
        tests=np.zeros(LANES, np.int64),
        state=np.zeros((7, LANES + 1), np.int64),
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
def _variables(bundles: int, image: Int64, frame: Frame, memory: Walk) -> int:
    """Gather the bundles into the orbits of one automorphism; returns the number of orbits."""
    variable, lead = memory.variable, memory.lead
    for b in range(bundles):
        variable[b] = -1
    found = 0
    for b in range(bundles):
        if variable[b] >= 0:
            continue
        lead[found] = b
        lanes = 0
        length = 0
        c = b
        while variable[c] < 0:
            variable[c] = found
            lanes |= 1 << (2 * c)
            length += 1
            c = frame.at[image[frame.ends[0, c]], image[frame.ends[1, c]]]
        memory.lanes[found] = lanes
        memory.length[found] = length
        if length > 1:
            memory.manner[found] = MOVED
        else:
            memory.manner[found] = FIXED if image[frame.ends[0, b]] == frame.ends[0, b] else TURNED
        found += 1
    return found


@njit(cache=True)
def _tests(bundles: int, sets: int, variables: int, frame: Frame, memory: Walk) -> None:
    """Give each critical set to the variable whose value completes it."""
    tests = memory.tests
    for v in range(variables):
        tests[v] = 0
    for i in range(sets):
        s = frame.sets[0, i]
        mask = 0
        due = 0
        for b in range(bundles):
            if (s >> frame.ends[0, b]) & (s >> frame.ends[1, b]) & 1:
                mask |= 3 << (2 * b)
                due = max(due, memory.variable[b])
        memory.masks[due, tests[due]] = mask
        memory.limits[due, tests[due]] = frame.sets[1, i]
        tests[due] += 1


@njit(cache=True)
def walk(
    bundles: int,
    sets: int,
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
        sets: number of critical sets in the frame.
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

    A set is tested as soon as its last bundle has a value. Cost: about 10 ns for each assignment tried.
    """
    variables = _variables(bundles, image, frame, memory)
    _tests(bundles, sets, variables, frame, memory)
    state = memory.state
    word, total, excess, links = state[0], state[1], state[2], state[3]
    joints, flags, value = state[4], state[5], state[6]
    spare = max(mobility - 1, 0)
    after = bundles  # bundles whose value is still open
    found = 0
    d = 0
    value[0] = -1
    for i in range(6):
        state[i, 0] = 0
    while d >= 0:
        if d == variables:
            if total[d] == target:
                totals[0] += links[d]
                totals[1] += joints[d]
                totals[2] += flags[d]
                if out.shape[0]:
                    for b in range(bundles):
                        out[found, b] = value[memory.variable[b]]
                found += 1
            d -= 1
            after += memory.length[d]
            continue
        strings_ = frame.number[memory.lead[d]]
        value[d] += 1
        if value[d] == values.size[strings_]:
            d -= 1
            if d >= 0:
                after += memory.length[d]
            continue
        row = values.table[strings_, value[d]]
        length = memory.length[d]
        sum_now = total[d] + length * (row[COST] - row[EXCESS])
        excess_now = excess[d] + length * row[EXCESS]
        if excess_now > spare or sum_now - (spare - excess_now) > target:
            continue
        if sum_now + 2 * (after - length) < target:
            continue
        lanes = memory.lanes[d]
        now = word[d]
        if row[COST] > 0:
            now |= lanes
        if row[COST] > 1:
            now |= lanes << 1
        sound = True
        for i in range(memory.tests[d]):
            if popcount(now & memory.masks[d, i]) > memory.limits[d, i]:
                sound = False
                break
        if not sound:
            continue
        word[d + 1] = now
        total[d + 1] = sum_now
        excess[d + 1] = excess_now
        links[d + 1] = links[d]
        joints[d + 1] = joints[d]
        flags[d + 1] = flags[d]
        if memory.manner[d] == FIXED:
            links[d + 1] += row[LINKS]
            joints[d + 1] += row[JOINTS]
            flags[d + 1] += 2 * row[JOINTS]
        elif memory.manner[d] == TURNED:
            links[d + 1] += row[TURNED_LINKS]
            joints[d + 1] += row[TURNED_JOINTS]
        after -= length
        d += 1
        if d < variables:
            value[d] = -1
    return found
