"""The smallest and the largest circuit of a chain, from the circuits of its nodes and the strings between them."""

from gruebler._numeric.compiling import njit
from gruebler.structure.atlas.chain_memory import CIRCUMFERENCE, GIRTH, ChainMemory, Int64


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
def measure_circuits(n: int, total: int, desk: ChainMemory, out: Int64) -> bool:
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
