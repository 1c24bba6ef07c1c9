"""Properties of many chains at once, on bare arrays: the graphs of `chain_memory`, described one after another."""

from typing import Final

from gruebler._numeric.compiling import njit
from gruebler._numeric.labelling.canonical import adjacency, label_graph
from gruebler._numeric.labelling.label_workspace import FACTOR, FACTORS
from gruebler.structure.atlas.certificate_kernels import certify
from gruebler.structure.atlas.chain_memory import DIAMETER, DYADIC, GROUP_ORDER, ChainMemory, Int32, Int64, UInt8
from gruebler.structure.atlas.circuit_kernels import measure_circuits
from gruebler.structure.atlas.code_kernels import sort_joints, write_code, write_graph6
from gruebler.structure.atlas.dyad_kernels import grows_by_dyads
from gruebler.structure.atlas.orbit_kernels import count_orbits

_FIRST_JOINT: Final = 2  # the colours of isomorphism.colouring: links 1, joints 2 + 2 * place of the pair
_LINK: Final = 1


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
        count_orbits(n, joints, total, desk, out)
        out[DIAMETER] = _diameter(n, desk.near)
        out[DYADIC] = grows_by_dyads(n, joints, loops, mobility, desk.members, desk.sets)
        if out[DYADIC] < 0 or not measure_circuits(n, total, desk, out):
            return k
        sort_joints(n, joints, desk)
        at = write_code(joints, letters, at, desk, text)
        ends[k] = at
        if hubs[k] == 0:
            write_graph6(n, joints, desk, graph6[k])
            if not certify(n, joints, desk, certificates[k]):
                return k
    return sizes.size
