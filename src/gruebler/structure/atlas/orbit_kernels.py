"""The orbits of links, joints and drives of a chain under the automorphisms found."""

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import popcount
from gruebler._numeric.labelling.automorphism import generator_image, join_orbits
from gruebler._numeric.labelling.label_workspace import GENERATORS, ORBIT
from gruebler.structure.atlas.chain_memory import DRIVES, INVERSIONS, JOINT_ORBITS, ChainMemory, Int64


@njit(cache=True)
def count_orbits(n: int, joints: int, total: int, desk: ChainMemory, out: Int64) -> None:
    """Orbits of links, joints and (frame, joint at it, link that the joint drives) under the generators.

    The last are the ordered pairs of links that share a joint, since two links share one joint at most.
    """
    ws, parent, members, image = desk.workspace, desk.parent, desk.members, desk.image
    out[INVERSIONS] = 0
    for v in range(n):
        if ws.rows[ORBIT, v] == v:
            out[INVERSIONS] += 1
    out[JOINT_ORBITS] = joints
    out[DRIVES] = 0
    for j in range(joints):
        k = popcount(members[j])
        out[DRIVES] += k * (k - 1)
    if ws.state[GENERATORS] == 0:
        return
    for i in range(joints):
        parent[0, i] = i
    for g in range(ws.state[GENERATORS]):
        generator_image(g, total, ws, image)
        for j in range(joints):
            moved = 0
            for v in range(n):
                if members[j] >> v & 1:
                    moved |= 1 << image[v]
            if moved == members[j]:
                continue
            for i in range(joints):
                if members[i] == moved:
                    if join_orbits(parent, 0, i, j):
                        out[JOINT_ORBITS] -= 1
                    break
    for i in range(n * n):
        parent[0, i] = i
    for g in range(ws.state[GENERATORS]):
        generator_image(g, total, ws, image)
        for u in range(n):
            for v in range(n):
                if desk.near[u] >> v & 1 and join_orbits(parent, 0, u * n + v, image[u] * n + image[v]):
                    out[DRIVES] -= 1
