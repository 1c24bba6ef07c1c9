"""Chains with multiple joints grown from chains with simple ones, on bare arrays.

The tree of docs/theory/multiple-joints.md, "Each chain once": a merging is kept if the split that undoes it is like
the canonical split of the new chain, and equivalent mergings of a chain count once (B. D. McKay, Isomorph-free
exhaustive generation, J. Algorithms 26, 1998). Joints are sets of links, as bits.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import lowest, popcount
from gruebler._numeric.labelling.automorphism import generator_image, join_orbits, orbit_root
from gruebler._numeric.labelling.canonical import adjacency, label_graph
from gruebler._numeric.labelling.label_workspace import GENERATORS, LABELLING, Workspace, make_workspace

Int8 = NDArray[np.int8]
Int32 = NDArray[np.int32]
Int64 = NDArray[np.int64]

MOST_LINKS: Final = 20  # a table of a byte for every set of links, at each level

# Columns of a merging.
BIG: Final = 0  # the joint that grows, as a set of links
SMALL: Final = 1  # the simple joint that goes
KEPT: Final = 2  # the link that carries both
LEAVING: Final = 3  # the other link of the simple joint


class MergeMemory(NamedTuple):
    """The state of a search and its memory: a level for each merging on the way."""

    joints: Int64  # (level, joint): sets of links
    number: Int64  # level -> joints
    mergings: Int64  # (level, merging, 4)
    waiting: Int64  # level -> mergings that are left
    freedoms: Int8  # (level, set of links): d
    near: Int64
    degree: Int64
    around: Int64
    parent: Int32  # (1, element): of sets that are united
    image: Int64
    edges: Int32
    colour: Int32
    indptr: Int32
    neighbour: Int32
    row_colour: Int32
    vertex_colour: Int64
    workspace: Workspace
    state: Int64  # the chain of simple joints that is grown, the level (-1: the next chain)


def make_merge_memory(links: int, joints: int) -> MergeMemory:
    """Memory for chains of so many links that have so many simple joints."""
    levels, vertices, edges = joints, links + joints // 2 + 1, 2 * joints
    return MergeMemory(
        joints=np.zeros((levels, joints), np.int64),
        number=np.zeros(levels, np.int64),
        mergings=np.zeros((levels, joints * joints, 4), np.int64),
        waiting=np.zeros(levels, np.int64),
        freedoms=np.zeros((levels, 1 << links), np.int8),
        near=np.zeros(links, np.int64),
        degree=np.zeros(links, np.int64),
        around=np.zeros(links, np.int64),
        parent=np.zeros((1, max(joints * joints, links * links)), np.int32),
        image=np.zeros(vertices, np.int64),
        edges=np.zeros((edges, 2), np.int32),
        colour=np.zeros(edges, np.int32),
        indptr=np.zeros(vertices + 1, np.int32),
        neighbour=np.zeros(2 * edges, np.int32),
        row_colour=np.zeros(2 * edges, np.int32),
        vertex_colour=np.zeros(vertices, np.int64),
        workspace=make_workspace(vertices, edges),
        state=np.array([-1, -1], np.int64),
    )


@njit(cache=True)
def _label(n: int, number: int, joints: Int64, desk: MergeMemory) -> int:
    """Label a chain; multiple joints are vertices of another colour. Returns the number of vertices."""
    edges, total, size = desk.edges, n, 0
    for v in range(n):
        desk.vertex_colour[v] = 0
    for j in range(number):
        members = joints[j]
        if popcount(members) == 2:
            edges[size, 0] = lowest(members)
            edges[size, 1] = lowest(members & (members - 1))
            desk.colour[size] = 1
            size += 1
        else:
            while members:
                edges[size, 0] = lowest(members)
                edges[size, 1] = total
                desk.colour[size] = 0
                members &= members - 1
                size += 1
            desk.vertex_colour[total] = 1
            total += 1
    adjacency(total, edges[:size], desk.colour, desk.indptr, desk.neighbour, desk.row_colour)
    label_graph(total, desk.vertex_colour, desk.indptr, desk.neighbour, desk.row_colour, desk.workspace)
    return total


@njit(cache=True)
def _moved(members: int, image: Int64) -> int:
    moved = 0
    while members:
        moved |= 1 << image[lowest(members)]
        members &= members - 1
    return moved


@njit(cache=True)
def _fill_freedoms(n: int, number: int, joints: Int64, table: Int8) -> None:
    """d(S) for all sets of links: by the sets with one link less."""
    table[0] = -3
    for s in range(1, 1 << n):
        bit = s & -s
        rest = s ^ bit
        d = table[rest] + 3
        for j in range(number):
            if joints[j] & bit and joints[j] & rest:
                d -= 2
        table[s] = d


@njit(cache=True)
def _has_room(n: int, table: Int8, big: int, a: int, b: int) -> bool:
    """Whether d(S) >= 3 for every S that contains link b and a link of the joint, but not link a."""
    others = ((1 << n) - 1) & ~(1 << a) & ~(1 << b)
    s = others
    while True:
        if s & big and table[s | 1 << b] < 3:
            return False
        if s == 0:
            return True
        s = (s - 1) & others


@njit(cache=True)
def _survey(n: int, number: int, joints: Int64, desk: MergeMemory) -> None:
    """Degrees, and the sum of the squares of the degrees around each link."""
    for v in range(n):
        desk.degree[v] = 0
        desk.around[v] = 0
    for j in range(number):
        members = joints[j]
        while members:
            desk.degree[lowest(members)] += 1
            members &= members - 1
    for j in range(number):
        members = joints[j]
        square = 0
        while members:
            v = lowest(members)
            square += desk.degree[v] * desk.degree[v]
            members &= members - 1
        members = joints[j]
        while members:
            desk.around[lowest(members)] += square
            members &= members - 1


@njit(cache=True)
def _key(size: int, a: int, b: int, desk: MergeMemory) -> int:
    """The preference of a split: numbers of links and joints only."""
    first = (size << 6 | desk.degree[a]) << 14 | desk.around[a]
    return int((first << 6 | desk.degree[b]) << 14 | desk.around[b])


@njit(cache=True)
def _rivals(n: int, number: int, joints: Int64, a: int, b: int, size: int, desk: MergeMemory) -> int:
    """How many splits have the preference of the split (a, b) of a joint of this size; 0 if one has a higher."""
    own = _key(size, a, b, desk)
    equal = 0
    for j in range(number):
        here = popcount(joints[j])
        if here < 3 or here < size:
            continue
        for u in range(n):
            if not joints[j] >> u & 1:
                continue
            for v in range(n):
                if u == v or not joints[j] >> v & 1:
                    continue
                key = _key(here, u, v, desk)
                if key > own:
                    return 0
                if key == own:
                    equal += 1
    return equal


@njit(cache=True)
def _is_canonical(n: int, number: int, joints: Int64, a: int, b: int, size: int, desk: MergeMemory) -> bool:
    """Whether an automorphism takes the split (a, b) to the canonical one: of the preferred ones the first by rank.

    Two links share one joint at most, so a split is an ordered pair of links.
    """
    total = _label(n, number, joints, desk)
    ws = desk.workspace
    own = _key(size, a, b, desk)
    best, best_u, best_v = 1 << 40, -1, -1
    for j in range(number):
        if popcount(joints[j]) != size:
            continue
        for u in range(n):
            if not joints[j] >> u & 1:
                continue
            for v in range(n):
                if u == v or not joints[j] >> v & 1 or _key(size, u, v, desk) != own:
                    continue
                rank: int = ws.rows[LABELLING, u] * 1024 + ws.rows[LABELLING, v]
                if rank < best:
                    best, best_u, best_v = rank, u, v
    if best_u == a and best_v == b:
        return True
    count = ws.state[GENERATORS]
    if count == 0:
        return False
    for i in range(n * n):
        desk.parent[0, i] = i
    for g in range(count):
        generator_image(g, total, desk.workspace, desk.image)
        for u in range(n):
            for v in range(n):
                join_orbits(desk.parent, 0, u * n + v, desk.image[u] * n + desk.image[v])
    return orbit_root(desk.parent, 0, a * n + b) == orbit_root(desk.parent, 0, best_u * n + best_v)


@njit(cache=True)
def _list_mergings(n: int, level: int, most: int, largest: int, desk: MergeMemory) -> None:
    """The mergings of the chain of a level that lead to chains of the next one, each up to symmetry."""
    joints, number, mergings = desk.joints[level], desk.number[level], desk.mergings[level]
    below = desk.joints[level + 1]
    desk.waiting[level] = 0
    multiple = 0
    for v in range(n):
        desk.near[v] = 0
    for j in range(number):
        if popcount(joints[j]) > 2:
            multiple += 1
        for v in range(n):
            if joints[j] >> v & 1:
                desk.near[v] |= joints[j] & ~(1 << v)
    _survey(n, number, joints, desk)
    count = 0
    for k in range(number):
        big = joints[k]
        size = popcount(big)
        if size >= largest or (size == 2 and multiple >= most):
            continue
        for m in range(number):
            small = joints[m]
            common = big & small
            if k == m or popcount(small) > 2 or popcount(common) != 1:
                continue
            a, b = lowest(common), lowest(small & ~big)
            if desk.degree[a] < 3 or desk.near[b] & big & ~small:
                continue
            mergings[count, BIG], mergings[count, SMALL] = big, small
            mergings[count, KEPT], mergings[count, LEAVING] = a, b
            count += 1
    if count == 0:
        return
    total = _label(n, number, joints, desk)
    generators = desk.workspace.state[GENERATORS]
    for i in range(count):
        desk.parent[0, i] = i
    for g in range(generators):
        generator_image(g, total, desk.workspace, desk.image)
        for i in range(count):
            big, small = _moved(mergings[i, BIG], desk.image), _moved(mergings[i, SMALL], desk.image)
            for other in range(count):
                if mergings[other, BIG] == big and mergings[other, SMALL] == small:
                    join_orbits(desk.parent, 0, i, other)
                    break
    firsts = 0
    for i in range(count):
        if desk.parent[0, i] == i:
            for c in range(4):
                mergings[firsts, c] = mergings[i, c]
            firsts += 1
    table = desk.freedoms[level]
    kept = 0
    for i in range(firsts):
        big, small = mergings[i, BIG], mergings[i, SMALL]
        a, b = mergings[i, KEPT], mergings[i, LEAVING]
        merged = _merge(number, joints, big, small, below)
        _survey(n, merged, below, desk)
        size = popcount(big) + 1
        rivals = _rivals(n, merged, below, a, b, size, desk)
        if rivals == 0 or not _has_room(n, table, big, a, b):
            continue
        if rivals > 1 and not _is_canonical(n, merged, below, a, b, size, desk):
            continue
        for c in range(4):
            mergings[kept, c] = mergings[i, c]
        kept += 1
    desk.waiting[level] = kept


@njit(cache=True)
def _merge(number: int, joints: Int64, big: int, small: int, out: Int64) -> int:
    """The joints after a merging; returns their number."""
    count = 0
    for j in range(number):
        if joints[j] == small:
            continue
        out[count] = joints[j] | small if joints[j] == big else joints[j]
        count += 1
    return count


@njit(cache=True)
def _descend(n: int, level: int, desk: MergeMemory) -> None:
    """Do the next merging of a level: the chain of the next level and its table of freedoms."""
    desk.waiting[level] -= 1
    merging = desk.mergings[level, desk.waiting[level]]
    big, a, b = merging[BIG], merging[KEPT], merging[LEAVING]
    desk.number[level + 1] = _merge(desk.number[level], desk.joints[level], big, merging[SMALL], desk.joints[level + 1])
    above, below = desk.freedoms[level], desk.freedoms[level + 1]
    below[:] = above
    others = ((1 << n) - 1) & ~(1 << a) & ~(1 << b)
    s = others
    while s:
        if s & big:
            below[s | 1 << b] -= 2
        s = (s - 1) & others


@njit(cache=True, nogil=True)
def grow_chains(n: int, simple: Int64, fewest: int, most: int, largest: int, desk: MergeMemory, out: Int64) -> int:
    """Write out chains with multiple joints until they are done or the room is full.

    Args:
        n: number of links, at most MOST_LINKS.
        simple: int64[k, joints]: chains of simple joints, none isomorphic to another.
        fewest: chains with fewer multiple joints than this are left out.
        most: chains with more of them likewise.
        largest: joints of more links are not made.
        desk: from `make_growth_memory`; its state says where to go on.
        out: int64[m, 1 + joints], filled with the number of the chain of simple joints and the joints as sets of links,
            zeros behind.

    Returns:
        The number of chains written; fewer than m only if there are no more.

    Cost: some 30 us for a chain of 12 links, and 2^n bytes for each level.
    """
    state = desk.state
    joints = simple.shape[1]
    written = 0
    while written < out.shape[0]:
        level = state[1]
        if level < 0:
            state[0] += 1
            if state[0] >= simple.shape[0]:
                state[0] = simple.shape[0]
                return written
            for j in range(joints):
                desk.joints[0, j] = simple[state[0], j]
            desk.number[0] = joints
            _fill_freedoms(n, joints, desk.joints[0], desk.freedoms[0])
            level = 0
        elif desk.waiting[level]:
            _descend(n, level, desk)
            level += 1
        else:
            state[1] = level - 1
            continue
        state[1] = level
        _list_mergings(n, level, most, largest, desk)
        multiple = 0
        for j in range(desk.number[level]):
            multiple += popcount(desk.joints[level, j]) > 2
        if multiple >= fewest:
            out[written, 0] = state[0]
            for j in range(joints):
                out[written, 1 + j] = desk.joints[level, j] if j < desk.number[level] else 0
            written += 1
    return written
