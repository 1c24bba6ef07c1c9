"""Orientations of constraints, and their strong components.

Every constraint is an edge between two vertices of which exactly one takes it; a vertex takes at most its capacity. A
vertex depends on the other ends of the edges that it takes. docs/theory/assur.md, "Solving order".
"""

from __future__ import annotations

from collections.abc import Sequence

Edge = tuple[int, int]


def orientation(capacities: Sequence[int], edges: Sequence[Edge]) -> list[int] | None:
    """For each edge the end that takes it, no vertex above its capacity; None if there is no such choice.

    By augmenting paths; O(edges · (vertices + edges)) at worst.

    >>> orientation([0, 1, 1], [(0, 1), (1, 2)])
    [1, 2]
    >>> orientation([0, 1], [(0, 1), (0, 1)]) is None
    True
    """
    free = list(capacities)
    assigned: list[list[int]] = [[] for _ in capacities]
    taker = [-1] * len(edges)
    for number, ends in enumerate(edges):
        reached_by = dict.fromkeys(ends, number)
        queue = list(reached_by)
        for vertex in queue:
            if free[vertex]:
                free[vertex] -= 1
                _hand_over(vertex, number, reached_by, taker, assigned)
                break
            for edge in assigned[vertex]:
                a, b = edges[edge]
                other = a if b == vertex else b
                if other not in reached_by:
                    reached_by[other] = edge
                    queue.append(other)
        else:
            return None
    return taker


def _hand_over(
    vertex: int, target: int, reached_by: dict[int, int], taker: list[int], assigned: list[list[int]]
) -> None:
    """Reassign each edge on the path to this vertex to its other end."""
    while True:
        edge = reached_by[vertex]
        before, taker[edge] = taker[edge], vertex
        assigned[vertex].append(edge)
        if edge == target:
            return
        assigned[before].remove(edge)
        vertex = before


def dependencies(vertices: int, edges: Sequence[Edge], taker: Sequence[int]) -> list[list[int]]:
    """For each vertex the other ends of the edges that it takes."""
    needs: list[list[int]] = [[] for _ in range(vertices)]
    for (a, b), end in zip(edges, taker, strict=True):
        needs[end].append(a if end == b else b)
    return needs


def components(needs: Sequence[Sequence[int]]) -> list[list[int]]:
    """The strong components, each after those that it depends on (Tarjan 1972); O(vertices + edges).

    >>> components([[], [0, 2], [1]])
    [[0], [1, 2]]
    """
    order: dict[int, int] = {}
    low: dict[int, int] = {}
    pending: list[int] = []
    waiting: set[int] = set()
    strong_components: list[list[int]] = []
    for root in range(len(needs)):
        if root in order:
            continue
        work = [(root, 0)]
        while work:
            vertex, step = work.pop()
            if step == 0:
                order[vertex] = low[vertex] = len(order)
                pending.append(vertex)
                waiting.add(vertex)
            if step < len(needs[vertex]):
                neighbour = needs[vertex][step]
                work.append((vertex, step + 1))
                if neighbour not in order:
                    work.append((neighbour, 0))
                elif neighbour in waiting:
                    low[vertex] = min(low[vertex], order[neighbour])
                continue
            if work:
                above = work[-1][0]
                low[above] = min(low[above], low[vertex])
            if low[vertex] == order[vertex]:
                cut = pending.index(vertex)
                waiting.difference_update(pending[cut:])
                strong_components.append(sorted(pending[cut:]))
                del pending[cut:]
    return strong_components
