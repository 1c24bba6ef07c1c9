"""The Assur groups of many trusses at once, on bare arrays: canonical form and class."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import popcount
from gruebler._numeric.labelling.canonical import adjacency, label_graph
from gruebler._numeric.labelling.label_workspace import LABELLING, Workspace

Int32 = NDArray[np.int32]
Int64 = NDArray[np.int64]
UInt8 = NDArray[np.uint8]

CLASS: Final = 0
ORDER: Final = 1
HEAD: Final = 2  # columns before the joints

_LINK: Final = 1  # colours of isomorphism.colouring
_TURNING: Final = 1


@njit(cache=True)
def longest_contour(links: int, joints: int, first: Int64, second: Int64) -> int:
    """The longest loop of a minimum cycle basis of a graph, in joints; 0 without a loop.

    See `assur.forms._longest_contour` for the theorem (Horton 1987); joints are bits here.
    """
    path = np.zeros(links, np.int64)
    queue = np.zeros(links, np.int64)
    candidates = np.zeros(links * joints, np.int64)
    count, parts, visited = 0, 0, 0
    for start in range(links):
        reached = 1 << start
        path[start] = 0
        queue[0] = start
        size, k = 1, 0
        while k < size:
            v = queue[k]
            k += 1
            for j in range(joints):
                other = -1
                if first[j] == v:
                    other = second[j]
                elif second[j] == v:
                    other = first[j]
                if other >= 0 and not reached >> other & 1:
                    reached |= 1 << other
                    path[other] = path[v] ^ 1 << j
                    queue[size] = other
                    size += 1
        if not visited >> start & 1:
            parts += 1
            visited |= reached
        for j in range(joints):
            if reached >> first[j] & 1:
                loop = path[first[j]] ^ path[second[j]] ^ 1 << j
                if loop:
                    candidates[count] = loop
                    count += 1
    dimension = joints - links + parts
    basis = np.zeros(joints + 1, np.int64)  # by highest bit
    rank, longest = 0, 0
    for length in range(2, links + 1):
        if rank == dimension:
            break
        for c in range(count):
            loop = candidates[c]
            if popcount(loop) != length:
                continue
            for b in range(joints - 1, -1, -1):
                if loop >> b & 1:
                    if basis[b] == 0:
                        basis[b] = loop
                        rank += 1
                        longest = length
                        break
                    loop ^= basis[b]
    return longest


@njit(cache=True, nogil=True)
def describe_groups(n: int, trusses: UInt8, ws: Workspace, out: Int64, owners: Int64) -> int:
    """The Assur groups of trusses, each once, in canonical form.

    Args:
        n: number of links of a truss.
        trusses: uint8[k, joints, 2].
        ws: a workspace of the labelling for 2n vertices.
        out: int64[n k, HEAD + 2 joints], filled: class, order, then two numbers for each joint: 0 and the link that
            carries an outer joint, links ascending; then the two links of each inner joint, in order; links from 1.
        owners: int64[n k], filled: the truss of each group.

    Returns:
        The number of groups. Links of a truss that an automorphism exchanges give the same group; the least stands.

    Cost: about 5 us for each link of a truss.
    """
    joints = trusses.shape[1]
    edges = np.zeros((joints, 2), np.int32)
    colour = np.full(joints, _TURNING, np.int32)
    indptr = np.zeros(2 * n + 1, np.int32)
    neighbour = np.zeros(2 * joints, np.int32)
    row_colour = np.zeros(2 * joints, np.int32)
    vertex_colour = np.full(2 * n, _LINK, np.int64)
    number = np.zeros(2 * n, np.int64)
    at = np.zeros(2 * n, np.int64)
    key = np.zeros(joints, np.int64)
    first = np.zeros(joints, np.int64)
    second = np.zeros(joints, np.int64)
    inner_degree = np.zeros(2 * n, np.int64)
    count = 0
    for k in range(trusses.shape[0]):
        begin = count
        for removed in range(n):
            order = 0
            for j in range(joints):
                for side in range(2):
                    link = trusses[k, j, side]
                    if link == removed:
                        edges[j, side] = n - 1 + order
                        order += 1
                    else:
                        edges[j, side] = link - 1 if link > removed else link
            total = n - 1 + order
            adjacency(total, edges, colour, indptr, neighbour, row_colour)
            label_graph(total, vertex_colour, indptr, neighbour, row_colour, ws)
            for v in range(total):
                at[ws.rows[LABELLING, v]] = v
            links = 0
            for i in range(total):
                if at[i] < n - 1:
                    links += 1
                    number[at[i]] = links
                else:
                    number[at[i]] = 0
            inner = 0
            for v in range(n):
                inner_degree[v] = 0
            for j in range(joints):
                a = min(number[edges[j, 0]], number[edges[j, 1]])
                b = max(number[edges[j, 0]], number[edges[j, 1]])
                if a:
                    first[inner] = a - 1
                    second[inner] = b - 1
                    inner += 1
                    inner_degree[a] += 1
                    inner_degree[b] += 1
                here = a << 8 | b
                i = j
                while i > 0 and key[i - 1] > here:
                    key[i] = key[i - 1]
                    i -= 1
                key[i] = here
            row = out[count]
            for j in range(joints):
                row[HEAD + 2 * j] = key[j] >> 8
                row[HEAD + 2 * j + 1] = key[j] & 255
            row[ORDER] = order
            new = True
            for other in range(begin, count):
                same = True
                for j in range(HEAD, HEAD + 2 * joints):
                    if out[other, j] != row[j]:
                        same = False
                        break
                if same:
                    new = False
                    break
            if not new:
                continue
            number_of_class = max(2, longest_contour(links, inner, first, second))
            for v in range(n):
                number_of_class = max(number_of_class, inner_degree[v])
            row[CLASS] = number_of_class
            owners[count] = k
            count += 1
    return count
