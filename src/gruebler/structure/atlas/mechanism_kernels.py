"""Frames, drives and Assur groups of many chains with F = 1 at once, on bare arrays.

Only simple turning joints, and drives at the frame: no links of such a group are rigid among themselves, so the groups
are the differences of the tight sets, which are the strong components of an orientation (docs/theory/assur.md).
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import lowest, popcount
from gruebler._numeric.labelling.automorphism import generator_image, join_orbits, orbit_root
from gruebler._numeric.labelling.canonical import adjacency, label_graph
from gruebler._numeric.labelling.label_workspace import GENERATORS, LABELLING, Workspace, make_workspace
from gruebler.structure.assur.group_kernels import longest_contour

Int16 = NDArray[np.int16]
Int32 = NDArray[np.int32]
Int64 = NDArray[np.int64]
UInt8 = NDArray[np.uint8]

# Columns of a mechanism.
CHAIN: Final = 0
FRAME: Final = 1
FRAME_JOINTS: Final = 2
ORBIT: Final = 3
# Columns of a driven mechanism, with CHAIN and FRAME.
DRIVEN: Final = 2  # the link that the drive moves against the frame
GROUPS: Final = 3  # how many; behind, their numbers in the table of groups
# Columns of the table of groups; behind, the joints in canonical order, two ranks each.
LINKS: Final = 0
CLASS: Final = 1
ORDER: Final = 2
JOINTS: Final = 3
HEAD: Final = 4

_LINK: Final = 1  # colours of isomorphism.colouring
_TURNING: Final = 1


class MechanismMemory(NamedTuple):
    """Everything that `list_mechanisms` needs besides the chains."""

    ends: Int64  # (2, joint): its links
    near: Int64  # link -> its neighbours, as bits
    parent: Int32  # (1, element): of sets that are united
    degree: Int64
    size: Int64
    image: Int64
    taken: Int64  # (2, joint): which end takes each of the two constraints
    load: Int64
    needs: Int64  # link -> links on which it depends, as bits
    edges: Int32
    colour: Int32
    indptr: Int32
    neighbour: Int32
    row_colour: Int32
    vertex_colour: Int64
    keys: Int64
    scratch: Int64  # (4, vertices)
    slots: Int32  # hash -> number of a group + 1
    groups: Int16  # (group, column)
    state: Int64  # number of groups
    workspace: Workspace


def make_mechanism_memory(links: int, joints: int, groups: int) -> MechanismMemory:
    """Memory for chains of so many links and joints, and a table of at most so many groups."""
    vertices = 2 * joints + 2
    return MechanismMemory(
        ends=np.zeros((2, joints), np.int64),
        near=np.zeros(links, np.int64),
        parent=np.zeros((1, links * links), np.int32),
        degree=np.zeros(links, np.int64),
        size=np.zeros(links * links, np.int64),
        image=np.zeros(links, np.int64),
        taken=np.zeros((2, joints), np.int64),
        load=np.zeros(links, np.int64),
        needs=np.zeros(links, np.int64),
        edges=np.zeros((joints, 2), np.int32),
        colour=np.full(joints, _TURNING, np.int32),
        indptr=np.zeros(vertices + 1, np.int32),
        neighbour=np.zeros(2 * joints, np.int32),
        row_colour=np.zeros(2 * joints, np.int32),
        vertex_colour=np.full(vertices, _LINK, np.int64),
        keys=np.zeros(joints, np.int64),
        scratch=np.zeros((4, vertices), np.int64),
        slots=np.zeros(4 * groups, np.int32),
        groups=np.zeros((groups, HEAD + 2 * joints), np.int16),
        state=np.zeros(1, np.int64),
        workspace=make_workspace(vertices, joints),
    )


@njit(cache=True)
def _read(text: UInt8, begin: int, end: int, desk: MechanismMemory) -> int:
    """The joints of a code such as gr1:R(0-1)R(0-2); returns their number."""
    count = 0
    at = begin + 4
    while at < end:
        at += 2  # R(
        for side in range(2):
            value = 0
            while text[at] >= 48 and text[at] < 58:
                value = 10 * value + text[at] - 48
                at += 1
            desk.ends[side, count] = value
            at += 1  # - or )
        count += 1
    return count


@njit(cache=True)
def _take(n: int, joints: int, base: int, desk: MechanismMemory) -> None:
    """Distribute the constraints: three to each body but the base, each constraint to a body of its joint."""
    taken, load = desk.taken, desk.load
    before, queue = desk.scratch[0], desk.scratch[1]
    for v in range(n):
        load[v] = 0
    for j in range(joints):
        for copy in range(2):
            taken[copy, j] = -1
    for j in range(joints):
        a, b = desk.keys[j] >> 8, desk.keys[j] & 255
        if a == b:
            continue
        for copy in range(2):
            # a path from one of the ends to a body with room, over constraints that can change their body
            for v in range(n):
                before[v] = -2
            count, k, goal = 0, 0, -1
            for end in (a, b):
                if end != base:
                    before[end] = -1
                    queue[count] = end
                    count += 1
            while k < count and goal < 0:
                v = queue[k]
                k += 1
                if load[v] < 3:
                    goal = v
                    break
                for other in range(joints):
                    p, q = desk.keys[other] >> 8, desk.keys[other] & 255
                    if p == q:
                        continue
                    for c in range(2):
                        if taken[c, other] == v:
                            w = p + q - v
                            if w != base and before[w] == -2:
                                before[w] = 2 * other + c
                                queue[count] = w
                                count += 1
            load[goal] += 1
            while before[goal] >= 0:
                other, c = before[goal] // 2, before[goal] % 2
                from_body = taken[c, other]
                taken[c, other] = goal
                goal = from_body
            taken[copy, j] = goal


@njit(cache=True)
def _group(n: int, joints: int, block: int, desk: MechanismMemory) -> int:
    """The number of a group of bodies in the table; -1 if the table is full."""
    number, at = desk.scratch[0], desk.scratch[1]
    links = 0
    for v in range(n):
        number[v] = -1
        if block >> v & 1:
            number[v] = links
            links += 1
    first, second, inner_degree = desk.scratch[2], desk.scratch[3], desk.degree
    for v in range(links):
        inner_degree[v] = 0
    order, inner, size = 0, 0, 0
    for j in range(joints):
        a, b = desk.keys[j] >> 8, desk.keys[j] & 255
        u, v = number[a], number[b]
        if a == b or (u < 0 and v < 0):
            continue
        if u >= 0 and v >= 0:
            first[inner] = u
            second[inner] = v
            inner += 1
            inner_degree[u] += 1
            inner_degree[v] += 1
        else:
            if not block >> desk.taken[0, j] & 1:
                continue  # a joint of a later group with a link of this one
            v = max(u, v)
            u = links + order
            order += 1
        desk.edges[size, 0] = u
        desk.edges[size, 1] = v
        size += 1
    total = links + order
    adjacency(total, desk.edges[:size], desk.colour, desk.indptr, desk.neighbour, desk.row_colour)
    label_graph(total, desk.vertex_colour, desk.indptr, desk.neighbour, desk.row_colour, desk.workspace)
    for v in range(total):
        at[v] = desk.workspace.rows[LABELLING, v]
    row = desk.groups[desk.state[0]]
    # sorted joints, and a hash of them
    for j in range(size):
        low = min(at[desk.edges[j, 0]], at[desk.edges[j, 1]])
        high = max(at[desk.edges[j, 0]], at[desk.edges[j, 1]])
        i = j
        while i > 0 and row[HEAD + 2 * i - 2] * 256 + row[HEAD + 2 * i - 1] > low * 256 + high:
            row[HEAD + 2 * i] = row[HEAD + 2 * i - 2]
            row[HEAD + 2 * i + 1] = row[HEAD + 2 * i - 1]
            i -= 1
        row[HEAD + 2 * i] = low
        row[HEAD + 2 * i + 1] = high
    code = np.int64(size)
    for i in range(HEAD, HEAD + 2 * size):
        code = (code * 1000003 ^ row[i]) & 0x3FFFFFFFFFFF
    slot = code % desk.slots.size
    while desk.slots[slot]:
        known = desk.slots[slot] - 1
        if desk.groups[known, JOINTS] == size:
            same = True
            for i in range(HEAD, HEAD + 2 * size):
                if desk.groups[known, i] != row[i]:
                    same = False
                    break
            if same:
                return int(known)
        slot = (slot + 1) % desk.slots.size
    if desk.state[0] == desk.groups.shape[0] - 1:
        return -1
    row[LINKS] = links
    row[ORDER] = order
    row[JOINTS] = size
    row[CLASS] = max(2, longest_contour(links, inner, first, second))
    for v in range(links):
        row[CLASS] = max(row[CLASS], inner_degree[v])
    desk.slots[slot] = desk.state[0] + 1
    desk.state[0] += 1
    return int(desk.state[0] - 1)


@njit(cache=True)
def _solve(n: int, joints: int, frame: int, driven: int, desk: MechanismMemory, out: Int32) -> bool:
    """The Assur groups in solving order, into a row; False if the table of groups is full."""
    needs = desk.needs
    base = frame
    for j in range(joints):  # the driven link is one body with the frame
        a = frame if desk.ends[0, j] == driven else desk.ends[0, j]
        b = frame if desk.ends[1, j] == driven else desk.ends[1, j]
        desk.keys[j] = a << 8 | b
    _take(n, joints, base, desk)
    for v in range(n):
        needs[v] = 1 << v
    for j in range(joints):
        a, b = desk.keys[j] >> 8, desk.keys[j] & 255
        if a == b:
            continue
        for c in range(2):
            v = desk.taken[c, j]
            needs[v] |= 1 << (a + b - v)
    for k in range(n):
        for v in range(n):
            if needs[v] >> k & 1:
                needs[v] |= needs[k]
    bodies = ((1 << n) - 1) & ~(1 << frame) & ~(1 << driven)
    done = 1 << frame
    count = 0
    rest = bodies
    while rest:
        # of the groups that can be solved now, the one with the first body
        waiting = rest
        block = 0
        while waiting:
            v = lowest(waiting)
            block = 0
            others = needs[v] & rest
            while others:
                w = lowest(others)
                if needs[w] >> v & 1:
                    block |= 1 << w
                others &= others - 1
            if needs[v] & ~(done | block) == 0:
                break
            waiting &= ~block
        number = _group(n, joints, block, desk)
        if number < 0:
            return False
        out[GROUPS + 1 + count] = number
        count += 1
        done |= block
        rest &= ~block
    out[GROUPS] = count
    return True


@njit(cache=True, nogil=True)
def list_mechanisms(
    n: int,
    joints: int,
    text: UInt8,
    ends: Int64,
    desk: MechanismMemory,
    mechanisms: Int32,
    driven: Int32,
    counts: Int64,
) -> bool:
    """The mechanisms and the driven mechanisms of chains with F = 1.

    Args:
        n: number of links.
        joints: number of joints.
        text: uint8, the codes of the chains one after another; simple turning joints only.
        ends: int64[k], where each of them ends.
        desk: from `make_mechanism_memory`; its table of groups is filled.
        mechanisms: int32[rows, 4], filled: an orbit of links in each row.
        driven: int32[rows, GROUPS + 1 + groups], filled: an orbit of (frame, driven link) in each row; no rows: none.
        counts: int64[2], filled with the numbers of rows.

    Returns:
        False if the table of groups is full.

    Cost: some 5 us for each driven mechanism.
    """
    counts[0] = 0
    counts[1] = 0
    ws = desk.workspace
    begin = 0
    for k in range(ends.size):
        _read(text, begin, ends[k], desk)
        begin = ends[k]
        for v in range(n):
            desk.near[v] = 0
        for j in range(joints):
            u, v = desk.ends[0, j], desk.ends[1, j]
            desk.near[u] |= 1 << v
            desk.near[v] |= 1 << u
            desk.edges[j, 0] = u
            desk.edges[j, 1] = v
        adjacency(n, desk.edges, desk.colour, desk.indptr, desk.neighbour, desk.row_colour)
        label_graph(n, desk.vertex_colour, desk.indptr, desk.neighbour, desk.row_colour, ws)
        generators = ws.state[GENERATORS]
        for flags in range(2):
            size = n * n if flags else n
            for i in range(size):
                desk.parent[0, i] = i
                desk.size[i] = 0
            for g in range(generators):
                generator_image(g, n, ws, desk.image)
                for i in range(size):
                    if flags:
                        join_orbits(desk.parent, 0, i, desk.image[i // n] * n + desk.image[i % n])
                    else:
                        join_orbits(desk.parent, 0, i, desk.image[i])
            if flags and driven.shape[0] == 0:
                break
            for i in range(size):
                desk.size[i] = 0
            for i in range(size):
                desk.size[orbit_root(desk.parent, 0, i)] += 1
            if not flags:
                for v in range(n):
                    if desk.size[v]:
                        row = mechanisms[counts[0]]
                        row[CHAIN] = k
                        row[FRAME] = v
                        row[FRAME_JOINTS] = popcount(desk.near[v])
                        row[ORBIT] = desk.size[v]
                        counts[0] += 1
                continue
            first = counts[1]
            for i in range(size):
                if desk.size[i] and desk.near[i // n] >> (i % n) & 1:
                    row = driven[counts[1]]
                    row[CHAIN] = k
                    row[FRAME] = i // n
                    row[DRIVEN] = i % n
                    counts[1] += 1
            for r in range(first, counts[1]):
                if not _solve(n, joints, driven[r, FRAME], driven[r, DRIVEN], desk, driven[r]):
                    return False
    return True
