"""The certificate of a chain without overconstrained part: classes of joints, any two of which make a forest."""

from gruebler._numeric.compiling import njit
from gruebler.structure.atlas.chain_memory import DIGIT, MOST_MEMBERS, ChainMemory, UInt8


@njit(cache=True)
def _path_in_forest(n: int, which: int, start: int, goal: int, desk: ChainMemory) -> int:
    """The path between two links in a forest: elements in `desk.path[3]`; returns their number, -1 for none."""
    near, by = desk.forest_near[which], desk.path[0]
    reached = 1 << start
    front = reached
    while front and not reached >> goal & 1:
        fresh = 0
        for u in range(n):
            if front >> u & 1:
                here = near[u] & ~reached
                reached |= here
                fresh |= here
                v = 0
                while here:
                    if here & 1:
                        by[v] = u
                    here >>= 1
                    v += 1
        front = fresh
    if not reached >> goal & 1:
        return -1
    length = 0
    v = goal
    while v != start:
        desk.path[3, length] = desk.element[which, v, by[v]]
        length += 1
        v = by[v]
    return length


@njit(cache=True)
def _move(e: int, into: int, desk: ChainMemory) -> None:
    """Put an element into another forest."""
    u, v, old = desk.ends[0, e // 2], desk.ends[1, e // 2], desk.forest[e]
    if old >= 0 and desk.element[old, u, v] == e:  # else its place is taken by another already
        desk.forest_near[old, u] &= ~(1 << v)
        desk.forest_near[old, v] &= ~(1 << u)
    desk.forest[e] = into
    desk.forest_near[into, u] |= 1 << v
    desk.forest_near[into, v] |= 1 << u
    desk.element[into, u, v] = e
    desk.element[into, v, u] = e


@njit(cache=True)
def certify(n: int, joints: int, desk: ChainMemory, out: UInt8) -> bool:
    """Three classes of joints, any two of which make a forest: digits in canonical order; False if there are none.

    Two copies of each joint are put into three forests, one after another, with exchanges (J. Edmonds, Minimum
    partition of a matroid into independent subsets, 1965). A joint belongs to the class of the forest that it misses.
    Element e is a copy of joint e // 2 in canonical order.
    """
    forest, label, queue = desk.forest, desk.label, desk.queue
    first, second = desk.ends[0], desk.ends[1]
    for k in range(joints):
        key = desk.keys[desk.order[k]] >> (DIGIT * (MOST_MEMBERS - 2))
        first[k] = (key >> DIGIT) - 1
        second[k] = (key & ((1 << DIGIT) - 1)) - 1
    elements = 2 * joints
    for e in range(elements):
        forest[e] = -1
    for which in range(3):
        for v in range(n):
            desk.forest_near[which, v] = 0
    for new in range(elements):
        for e in range(elements):
            label[e] = -2
        label[new] = -1
        queue[0] = new
        count = 1
        k = 0
        done = False
        while k < count and not done:
            e = queue[k]
            k += 1
            for which in range(3):
                if forest[e] == which:
                    continue
                length = _path_in_forest(n, which, first[e // 2], second[e // 2], desk)
                if length < 0:
                    here, into = e, which
                    while here >= 0:
                        old = forest[here]
                        _move(here, into, desk)
                        into = old
                        here = label[here]
                    done = True
                    break
                for i in range(length):
                    other = desk.path[3, i]
                    if label[other] == -2:
                        label[other] = e
                        queue[count] = other
                        count += 1
        if not done:
            return False
    for k in range(joints):
        out[k] = 48 + 3 - forest[2 * k] - forest[2 * k + 1]
    return True
