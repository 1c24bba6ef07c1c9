"""Embeddings of a graph in the plane: the order of the neighbours around every vertex, counterclockwise.

Inserting the ears of one decomposition into faces, one after another, gives every embedding of a connected planar graph
exactly once (docs/theory/drawing.md); chains of usual size have few embeddings.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

Graph = Sequence[Sequence[int]]
"""The neighbours of every vertex; no edge twice."""
Rotation = list[list[int]]


def is_planar(graph: Graph) -> bool:
    """Whether the graph has an embedding; cost O(vertices)."""
    import networkx as nx

    return bool(nx.check_planarity(nx.Graph((u, v) for u in range(len(graph)) for v in graph[u]))[0])


def an_embedding(graph: Graph) -> Rotation:
    """One embedding of a planar graph; cost O(vertices)."""
    import networkx as nx

    planar, embedding = nx.check_planarity(nx.Graph((u, v) for u in range(len(graph)) for v in graph[u]))
    assert planar  # checked by the caller
    return [list(embedding.neighbors_cw_order(v))[::-1] for v in range(len(graph))]


def ears(graph: Graph) -> list[list[int]]:
    """Paths that compose the graph from vertex 0; each starts on the earlier ones and ends there or at a free vertex.

    >>> ears([[1, 2], [0, 2], [0, 1, 3], [2]])
    [[0, 1, 2, 0], [2, 3]]
    """
    placed = {0}
    used: set[tuple[int, int]] = set()
    paths = []
    while (path := _next_ear(graph, placed, used)) is not None:
        paths.append(path)
        placed.update(path)
        for u, v in pairwise(path):
            used |= {(u, v), (v, u)}
    return paths


def _next_ear(graph: Graph, placed: set[int], used: set[tuple[int, int]]) -> list[int] | None:
    """A shortest path between two placed vertices, else a shortest closed one, else one edge with a free end."""
    best: tuple[int, int, list[int]] | None = None
    for v in sorted(placed):
        for w in graph[v]:
            if (v, w) in used:
                continue
            path = _way_back(graph, placed, v, w)
            kind = 2 if path[-1] not in placed else int(path[-1] == v)
            if best is None or (kind, len(path)) < best[:2]:
                best = kind, len(path), path
    return None if best is None else best[2]


def _way_back(graph: Graph, placed: set[int], v: int, w: int) -> list[int]:
    """The shortest path v, w, ... through new vertices to a placed one, other than v if there is one."""
    if w in placed:
        return [v, w]
    origin = {w: v}
    queue = [w]
    closed: list[int] | None = None
    for u in queue:
        for t in graph[u]:
            if t == origin[u]:
                continue
            if t in placed:
                path = _trace(origin, v, u, t)
                if t != v:
                    return path
                closed = closed or path
            elif t not in origin:
                origin[t] = u
                queue.append(t)
    return closed or [v, w]


def _trace(origin: dict[int, int], v: int, u: int, t: int) -> list[int]:
    path = [t, u]
    while path[-1] != v:
        path.append(origin[path[-1]])
    return path[::-1]


def embeddings(graph: Graph, budget: int = 4000) -> Iterator[Rotation]:
    """All embeddings, each once up to reflection; the search ends when ``budget`` ears have been placed.

    >>> len(list(embeddings([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])))
    2
    """
    parts = ears(graph)
    remaining = [budget]

    def grow(rotation: Rotation, number: int) -> Iterator[Rotation]:
        if number == len(parts):
            yield rotation
            return
        for larger in _placements(rotation, parts[number]):
            remaining[0] -= 1
            if remaining[0] < 0:
                return
            yield from grow(larger, number + 1)

    yield from grow([[] for _ in graph], 0)


def _placements(rotation: Rotation, path: list[int]) -> Iterator[Rotation]:
    """All rotations with the path added."""
    first, last = path[0], path[-1]
    hangs = not rotation[last] and last != first
    if not rotation[first]:
        yield _with(rotation, path, 0, 0)
    elif hangs:
        for k in range(len(rotation[first])):
            yield _with(rotation, path, k, 0)
    elif first == last:
        for k in range(len(rotation[first])):
            yield _with(rotation, path, k, k)
            yield _with(rotation, path[::-1], k, k)
    else:
        for face in faces(rotation):
            corners = [(v, rotation[v].index(u)) for u, v in face]
            for v, k in corners:
                if v == first:
                    yield from (_with(rotation, path, k, j) for w, j in corners if w == last)


def _with(rotation: Rotation, path: list[int], k: int, j: int) -> Rotation:
    """The rotation with the path before the k-th neighbour of its first vertex and the j-th one of its last."""
    extended = [list(around) for around in rotation]
    for u, v, w in zip(path, path[1:], path[2:], strict=False):
        extended[v] = [u, w]
    if path[0] == path[-1]:
        extended[path[0]][k:k] = [path[1], path[-2]]
    else:
        extended[path[0]].insert(k, path[1])
        extended[path[-1]].insert(j, path[-2])
    return extended


def faces(rotation: Rotation) -> list[list[tuple[int, int]]]:
    """The faces as closed walks of darts (u, v), each face on their left."""
    follow = {}
    for v, around in enumerate(rotation):
        for k, u in enumerate(around):
            follow[u, v] = (v, around[k - 1])
    walks = []
    while follow:
        dart, after = next(iter(follow.items()))
        walk = []
        while dart in follow:
            walk.append(dart)
            dart = follow.pop(dart)
        walks.append(walk)
        del after
    return walks
