"""Properties of many chains at once, on bare arrays.

A chain is a graph here: the links are the vertices 0 to n - 1, the multiple joints the vertices from n on, a joint of
two links is an edge, and a multiple joint has an edge to each of its links. Definitions: docs/theory/atlas.md.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import popcount
from gruebler._numeric.labelling.canonical import adjacency, label_graph
from gruebler._numeric.labelling.label_workspace import (
    FACTOR,
    FACTORS,
    GENERATORS,
    IMAGE_OF,
    LABELLING,
    MOVED,
    START,
    Workspace,
    make_workspace,
)

Int32 = NDArray[np.int32]
Int64 = NDArray[np.int64]
UInt8 = NDArray[np.uint8]

MOST_LINKS: Final = 40  # sets of links are bits of a word
MOST_MEMBERS: Final = 9  # links of a joint: its ranks are the digits of a word
_CYCLES: Final = 4096  # a chain of L loops has fewer than 2^L circuits among its links of three joints and more
_SETS: Final = 4096  # what is left after taking dyads away, in all orders
_DIGIT: Final = 6

# Columns of numbers.
GROUP_ORDER: Final = 0
INVERSIONS: Final = 1
JOINT_ORBITS: Final = 2
DRIVES: Final = 3
GIRTH: Final = 4
CIRCUMFERENCE: Final = 5
DIAMETER: Final = 6
DYADIC: Final = 7
COLUMNS: Final = 8

_FIRST_JOINT: Final = 2  # the colours of isomorphism.colouring: links 1, joints 2 + 2 * place of the pair
_LINK: Final = 1


class ChainMemory(NamedTuple):
    """Everything `describe_chains` needs besides the chains."""

    workspace: Workspace
    vertex_colour: Int64
    edge_colour: Int32
    indptr: Int32
    neighbour: Int32
    row_colour: Int32
    members: Int64  # joint -> its links, as bits
    kinds: Int64  # joint -> place of its pair
    near: Int64  # vertex -> its neighbours, as bits; for links: the links that share a joint with it
    keys: Int64  # joint -> its ranks, as digits
    order: Int64  # place in canonical order -> joint
    rank: Int64  # link -> canonical number
    parent: Int64  # of sets that are united
    image: Int64
    node: Int64  # vertex -> number among those of three edges or more, else -1
    table: Int64  # (5, nodes, nodes): strings, shortest, second shortest, longest, second longest
    before: Int64  # (nodes, nodes): strings of the chain before
    cycles: Int64  # circuits of the chain before, as bits of bundles
    place: Int64  # (nodes, nodes) -> bundle
    path: Int64
    sets: Int64  # (2, many): what is left after so many dyads
    ends: Int64  # (2, joints): the links of the joints in canonical order
    forest: Int64  # element -> its forest, -1
    forest_near: Int64  # (forest, link): its neighbours, as bits
    element: Int64  # (forest, link, link)
    label: Int64  # element -> the element before
    queue: Int64
    state: Int64


def make_chain_memory(vertices: int, edges: int) -> ChainMemory:
    """Memory for chains of at most so many vertices and edges."""
    size = vertices + 1
    return ChainMemory(
        workspace=make_workspace(vertices, edges),
        vertex_colour=np.zeros(size, np.int64),
        edge_colour=np.zeros(edges + 1, np.int32),
        indptr=np.zeros(size + 1, np.int32),
        neighbour=np.zeros(2 * edges + 1, np.int32),
        row_colour=np.zeros(2 * edges + 1, np.int32),
        members=np.zeros(edges + 1, np.int64),
        kinds=np.zeros(edges + 1, np.int64),
        near=np.zeros(size, np.int64),
        keys=np.zeros(edges + 1, np.int64),
        order=np.zeros(edges + 1, np.int64),
        rank=np.zeros(size, np.int64),
        parent=np.zeros(size * size, np.int64),
        image=np.zeros(size, np.int64),
        node=np.zeros(size, np.int64),
        table=np.zeros((5, size, size), np.int64),
        before=np.zeros((size, size), np.int64),
        cycles=np.zeros(_CYCLES, np.int64),
        place=np.zeros((size, size), np.int64),
        path=np.zeros((4, size + 1), np.int64),
        sets=np.zeros((2, _SETS), np.int64),
        ends=np.zeros((2, edges + 1), np.int64),
        forest=np.zeros(2 * edges + 2, np.int64),
        forest_near=np.zeros((3, size), np.int64),
        element=np.zeros((3, size, size), np.int64),
        label=np.zeros(2 * edges + 2, np.int64),
        queue=np.zeros(2 * edges + 2, np.int64),
        state=np.zeros(4, np.int64),
    )


@njit(cache=True)
def _root(parent: Int64, i: int) -> int:
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@njit(cache=True)
def _orbits(n: int, joints: int, total: int, desk: ChainMemory, out: Int64) -> None:
    """Orbits of links, joints and (frame, joint at it, link that the joint drives) under the generators.

    The last are the ordered pairs of links that share a joint, since two links share one joint at most.
    """
    ws, parent, members, image = desk.workspace, desk.parent, desk.members, desk.image
    count = ws.state[GENERATORS]
    drives = 0
    for j in range(joints):
        k = popcount(members[j])
        drives += k * (k - 1)
    if count == 0:
        out[INVERSIONS] = n
        out[JOINT_ORBITS] = joints
        out[DRIVES] = drives
        return
    for what in range(3):
        size = n
        orbits = n
        if what == 1:
            size = joints
            orbits = joints
        elif what == 2:
            size = n * n
            orbits = drives
        for i in range(size):
            parent[i] = i
        for g in range(count):
            for v in range(total):
                image[v] = v
            for i in range(ws.rows[START, g], ws.rows[START, g + 1]):
                image[ws.pool[MOVED, i]] = ws.pool[IMAGE_OF, i]
            if what == 1:
                for j in range(joints):
                    moved = 0
                    for v in range(n):
                        if members[j] >> v & 1:
                            moved |= 1 << image[v]
                    if moved == members[j]:
                        continue
                    for i in range(joints):
                        if members[i] == moved:
                            a, b = _root(parent, i), _root(parent, j)
                            if a != b:
                                parent[a] = b
                                orbits -= 1
                            break
                continue
            for u in range(n):
                if what == 0:
                    a, b = _root(parent, u), _root(parent, image[u])
                    if a != b:
                        parent[a] = b
                        orbits -= 1
                    continue
                for v in range(n):
                    if desk.near[u] >> v & 1:
                        a, b = _root(parent, u * n + v), _root(parent, image[u] * n + image[v])
                        if a != b:
                            parent[a] = b
                            orbits -= 1
        out[INVERSIONS + what] = orbits


@njit(cache=True)
def _diameter(n: int, near: Int64) -> int:
    """The most joints on a shortest path between two links."""
    most = 0
    for start in range(n):
        reached = 1 << start
        front = reached
        steps = -1
        while front:
            steps += 1
            fresh = 0
            for v in range(n):
                if front >> v & 1:
                    fresh |= near[v]
            front = fresh & ~reached
            reached |= front
        most = max(most, steps)
    return most


@njit(cache=True)
def _strings(n: int, total: int, desk: ChainMemory) -> int:
    """Fill the table of strings between nodes; returns the number of nodes, and leaves circuits of one string.

    Nodes are the vertices of three edges or more; a string has the links between two nodes.
    """
    table, node, indptr, neighbour, state = desk.table, desk.node, desk.indptr, desk.neighbour, desk.state
    nodes = 0
    for v in range(total):
        node[v] = -1
        if indptr[v + 1] - indptr[v] >= 3:
            node[v] = nodes
            nodes += 1
    for u in range(nodes):
        for v in range(nodes):
            table[0, u, v] = 0
            table[1, u, v] = 1 << 20
            table[2, u, v] = 1 << 20
            table[3, u, v] = -(1 << 20)
            table[4, u, v] = -(1 << 20)
    state[0] = 1 << 20
    state[1] = 0
    for v in range(total):
        if node[v] < 0:
            continue
        for i in range(indptr[v], indptr[v + 1]):
            last, here, length = v, neighbour[i], 0
            while node[here] < 0:
                length += 1
                step = neighbour[indptr[here]]
                if step == last:
                    step = neighbour[indptr[here] + 1]
                last, here = here, step
            a, b = node[v], node[here]
            if a == b:
                length += 1 if v < n else 0
                state[0] = min(state[0], length)
                state[1] = max(state[1], length)
                continue
            table[0, a, b] += 1
            if length < table[1, a, b]:
                table[2, a, b] = table[1, a, b]
                table[1, a, b] = length
            elif length < table[2, a, b]:
                table[2, a, b] = length
            if length > table[3, a, b]:
                table[4, a, b] = table[3, a, b]
                table[3, a, b] = length
            elif length > table[4, a, b]:
                table[4, a, b] = length
    return nodes


@njit(cache=True)
def _list_cycles(nodes: int, desk: ChainMemory) -> int:
    """The circuits of three nodes and more, as sets of bundles; returns their number, or -1 if they are too many."""
    table, place, cycles, path = desk.table, desk.place, desk.cycles, desk.path
    found = 0
    for start in range(nodes):
        # path: node, next one to try, bundles so far, nodes so far
        depth = 0
        path[0, 0], path[1, 0], path[2, 0], path[3, 0] = start, start + 1, 0, 1 << start
        while depth >= 0:
            u, v = path[0, depth], path[1, depth]
            if v >= nodes:
                depth -= 1
                continue
            path[1, depth] = v + 1
            if table[0, u, v] == 0 or path[3, depth] >> v & 1:
                continue
            bundles = path[2, depth] | 1 << place[u, v]
            depth += 1
            path[0, depth], path[1, depth], path[2, depth] = v, start + 1, bundles
            path[3, depth] = path[3, depth - 1] | 1 << v
            if depth >= 2 and path[0, 1] < v and table[0, v, start]:
                if found == cycles.size:
                    return -1
                cycles[found] = bundles | 1 << place[v, start]
                found += 1
    return found


@njit(cache=True)
def _circuits(n: int, total: int, desk: ChainMemory, out: Int64) -> bool:
    """The numbers of links of the smallest and largest circuit; False if there are too many circuits."""
    table, place, before, state, path, node = desk.table, desk.place, desk.before, desk.state, desk.path, desk.node
    nodes = _strings(n, total, desk)
    if nodes == 0:
        out[GIRTH] = n
        out[CIRCUMFERENCE] = n
        return True
    least, most = state[0], state[1]
    known = state[2] == nodes
    for u in range(nodes):
        for v in range(nodes):
            if (table[0, u, v] > 0) != (before[u, v] > 0):
                known = False
                before[u, v] = table[0, u, v]
    if not known:
        bundles = 0
        for u in range(nodes):
            for v in range(u):
                if table[0, u, v]:
                    place[u, v] = bundles
                    place[v, u] = bundles
                    bundles += 1
        if bundles > 62:
            return False
        state[2] = nodes
        state[3] = _list_cycles(nodes, desk)
    if state[3] < 0:
        state[2] = 0
        return False
    weight = path[0]  # node -> links that it is
    for v in range(total):
        if node[v] >= 0:
            weight[node[v]] = 1 if v < n else 0
    # a circuit is summed up over its bundles: each with both its ends, halved in the end
    short, long = desk.queue, desk.keys
    for u in range(nodes):
        for v in range(u):
            if table[0, u, v]:
                b = place[u, v]
                short[b] = 2 * table[1, u, v] + weight[u] + weight[v]
                long[b] = 2 * table[3, u, v] + weight[u] + weight[v]
                if table[0, u, v] > 1:
                    least = min(least, table[1, u, v] + table[2, u, v] + weight[u] + weight[v])
                    most = max(most, table[3, u, v] + table[4, u, v] + weight[u] + weight[v])
    for c in range(state[3]):
        rest = desk.cycles[c]
        b = 0
        low, high = 0, 0
        while rest:
            if rest & 1:
                low += short[b]
                high += long[b]
            rest >>= 1
            b += 1
        least = min(least, low // 2)
        most = max(most, high // 2)
    out[GIRTH] = least
    out[CIRCUMFERENCE] = most
    return True


@njit(cache=True)
def _closed(joints: int, alive: int, members: Int64) -> bool:
    """Whether these links are connected and each carries two joints at least, joints of one link left out."""
    once, twice, start = 0, 0, 0
    for j in range(joints):
        here = members[j] & alive
        if here & (here - 1):
            twice |= once & here
            once |= here
            start = here
    if twice != alive:
        return False
    reached = start
    growing = True
    while growing:
        growing = False
        for j in range(joints):
            here = members[j] & alive
            if here & reached and here & ~reached:
                reached |= here
                growing = True
    return reached == alive


@njit(cache=True)
def _dyadic(n: int, joints: int, loops: int, mobility: int, members: Int64, sets: Int64) -> int:
    """Whether dyads can be taken away, one after another, until a single loop is left; -1 if that is too much.

    All orders are tried; where F = 1 they lead to the same end, so that one order is enough.
    """
    sets[0, 0] = (1 << n) - 1
    count = 1
    for level in range(loops - 1):
        now, then = level & 1, 1 - (level & 1)
        fresh = 0
        for s in range(count):
            alive = sets[now, s]
            for j in range(joints):
                here = members[j] & alive
                if popcount(here) != 2:
                    continue
                both = 0  # joints of the two links besides this one
                ends = 0
                for i in range(joints):
                    other = members[i] & alive
                    if i != j and other & here and other & (other - 1):
                        both += 1
                        ends |= other & here
                        if other & here == here:
                            both = 3
                if both != 2 or ends != here:
                    continue
                left = alive & ~here
                if not _closed(joints, left, members):
                    continue
                seen = False
                for i in range(fresh):
                    if sets[then, i] == left:
                        seen = True
                        break
                if seen:
                    continue
                if fresh == sets.shape[1]:
                    return -1
                sets[then, fresh] = left
                fresh += 1
                if mobility <= 1:
                    break
            if mobility <= 1 and fresh:
                break
        count = fresh
        if count == 0:
            return 0
    return 1


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
def _certify(n: int, joints: int, desk: ChainMemory, out: UInt8) -> bool:
    """Three classes of joints, any two of which make a forest: digits in canonical order; False if there are none.

    Two copies of each joint are put into three forests, one after another, with exchanges (J. Edmonds, Minimum
    partition of a matroid into independent subsets, 1965). A joint belongs to the class of the forest that it misses.
    Element e is a copy of joint e // 2 in canonical order.
    """
    forest, label, queue = desk.forest, desk.label, desk.queue
    first, second = desk.ends[0], desk.ends[1]
    for k in range(joints):
        key = desk.keys[desk.order[k]] >> (_DIGIT * (MOST_MEMBERS - 2))
        first[k] = (key >> _DIGIT) - 1
        second[k] = (key & ((1 << _DIGIT) - 1)) - 1
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


@njit(cache=True)
def _sort_joints(n: int, joints: int, desk: ChainMemory) -> None:
    """Ranks of the links, digits of the joints, and the canonical order of the joints."""
    for v in range(n):
        desk.rank[v] = desk.workspace.rows[LABELLING, v]
    for j in range(joints):
        ranks = 0
        for v in range(n):
            if desk.members[j] >> v & 1:
                ranks |= 1 << desk.rank[v]
        key = 0
        free = MOST_MEMBERS
        r = 0
        while ranks:
            if ranks & 1:
                free -= 1
                key |= (r + 1) << (_DIGIT * free)
            ranks >>= 1
            r += 1
        desk.keys[j] = key
        i = j
        while i > 0 and desk.keys[desk.order[i - 1]] > key:
            desk.order[i] = desk.order[i - 1]
            i -= 1
        desk.order[i] = j


@njit(cache=True)
def _write_code(joints: int, letters: UInt8, at: int, desk: ChainMemory, text: UInt8) -> int:
    """The canonical code, such as gr1:R(0-1)R(0-2)...; returns where the next one begins."""
    for letter in (103, 114, 49, 58):
        text[at] = letter
        at += 1
    for k in range(joints):
        j = desk.order[k]
        text[at] = letters[desk.kinds[j]]
        text[at + 1] = 40
        at += 2
        for i in range(MOST_MEMBERS):
            digit = desk.keys[j] >> (_DIGIT * (MOST_MEMBERS - 1 - i)) & ((1 << _DIGIT) - 1)
            if digit == 0:
                break
            if i:
                text[at] = 45
                at += 1
            if digit > 10:
                text[at] = 48 + (digit - 1) // 10
                at += 1
            text[at] = 48 + (digit - 1) % 10
            at += 1
        text[at] = 41
        at += 1
    return at


@njit(cache=True)
def _write_graph6(n: int, joints: int, desk: ChainMemory, line: UInt8) -> None:
    """The graph6 form with the links in canonical order, without a line end."""
    line[0] = 63 + n
    for i in range(1, line.size):
        line[i] = 63
    for j in range(joints):
        key = desk.keys[j] >> (_DIGIT * (MOST_MEMBERS - 2))
        u, v = (key >> _DIGIT) - 1, (key & ((1 << _DIGIT) - 1)) - 1
        place = v * (v - 1) // 2 + u
        line[1 + place // 6] += 32 >> (place % 6)


@njit(cache=True, nogil=True)
def describe_chains(
    n: int,
    mobility: int,
    loops: int,
    hubs: Int64,
    sizes: Int64,
    edges: Int32,
    pairs: Int32,
    letters: UInt8,
    desk: ChainMemory,
    numbers: Int64,
    ends: Int64,
    text: UInt8,
    graph6: UInt8,
    certificates: UInt8,
) -> int:
    """Fill in the properties of chains.

    Args:
        n: number of links, at most MOST_LINKS.
        mobility: F.
        loops: number of independent loops.
        hubs: int64[k], the number of multiple joints.
        sizes: int64[k], the number of edges.
        edges: int32[k, e, 2].
        pairs: int32[k, e], the place of the pair in the table of pairs; of a multiple joint at each of its edges.
        letters: uint8[pairs], the symbol of each pair.
        desk: from `make_chain_memory`.
        numbers: int64[k, COLUMNS], filled.
        ends: int64[k], filled: where the code of a chain ends in `text`.
        text: uint8, filled with the codes; room for 10 + 4 MOST_MEMBERS bytes for each joint.
        graph6: uint8[k, bytes], filled where all joints are simple.
        certificates: uint8[k, joints], filled where all joints are simple.

    Returns:
        The number of chains described: fewer than k if one has too many circuits.

    Cost: some 20 us for a chain of 14 links, most of it the certificate.
    """
    at = 0
    desk.state[2] = 0
    for k in range(sizes.size):
        size, total = sizes[k], n + hubs[k]
        joints = 0
        for v in range(total):
            desk.vertex_colour[v] = _LINK
            desk.near[v] = 0
        for j in range(size):
            v = edges[k, j, 1]
            kind = 2 * pairs[k, j]
            if v < n:
                u = edges[k, j, 0]
                desk.members[joints] = 1 << u | 1 << v
                desk.kinds[joints] = pairs[k, j]
                desk.edge_colour[j] = 1 + kind
                joints += 1
            else:
                desk.vertex_colour[v] = _FIRST_JOINT + kind
                desk.near[v] |= 1 << edges[k, j, 0]
                desk.edge_colour[j] = 0
        for v in range(n, total):
            desk.members[joints] = desk.near[v]
            desk.kinds[joints] = (desk.vertex_colour[v] - _FIRST_JOINT) // 2
            joints += 1
        for j in range(joints):
            for v in range(n):
                if desk.members[j] >> v & 1:
                    desk.near[v] |= desk.members[j] & ~(1 << v)
        adjacency(total, edges[k, :size], desk.edge_colour, desk.indptr, desk.neighbour, desk.row_colour)
        label_graph(total, desk.vertex_colour, desk.indptr, desk.neighbour, desk.row_colour, desk.workspace)
        order = 1
        for i in range(desk.workspace.state[FACTORS]):
            order *= desk.workspace.rows[FACTOR, i]
        out = numbers[k]
        out[GROUP_ORDER] = order
        _orbits(n, joints, total, desk, out)
        out[DIAMETER] = _diameter(n, desk.near)
        out[DYADIC] = _dyadic(n, joints, loops, mobility, desk.members, desk.sets)
        if out[DYADIC] < 0 or not _circuits(n, total, desk, out):
            return k
        _sort_joints(n, joints, desk)
        at = _write_code(joints, letters, at, desk, text)
        ends[k] = at
        if hubs[k] == 0:
            _write_graph6(n, joints, desk, graph6[k])
            if not _certify(n, joints, desk, certificates[k]):
                return k
    return sizes.size
