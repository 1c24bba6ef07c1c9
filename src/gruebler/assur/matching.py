"""Orientations of constraints, and the strong components that they leave.

Every constraint is an edge between two vertices of which exactly one takes it; a vertex takes at most its capacity. A
vertex depends on the other ends of the edges that it takes. docs/theory/assur.md, "Solving order".
"""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["components", "dependencies", "orientation"]

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
    held: list[list[int]] = [[] for _ in capacities]
    taker = [-1] * len(edges)
    for number, ends in enumerate(edges):
        reached_by = dict.fromkeys(ends, number)
        queue = list(reached_by)
        for vertex in queue:
            if free[vertex]:
                free[vertex] -= 1
                _hand_over(vertex, number, reached_by, taker, held)
                break
            for edge in held[vertex]:
                a, b = edges[edge]
                other = a if b == vertex else b
                if other not in reached_by:
                    reached_by[other] = edge
                    queue.append(other)
        else:
            return None
    return taker


def _hand_over(vertex: int, new: int, reached_by: dict[int, int], taker: list[int], held: list[list[int]]) -> None:
    """Let each edge on the path that led to this vertex go to its other end."""
    while True:
        edge = reached_by[vertex]
        before, taker[edge] = taker[edge], vertex
        held[vertex].append(edge)
        if edge == new:
            return
        held[before].remove(edge)
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
    out: list[list[int]] = []
    for root in range(len(needs)):
        if root in order:
            continue
        work = [(root, 0)]
        while work:
            here, step = work.pop()
            if step == 0:
                order[here] = low[here] = len(order)
                pending.append(here)
                waiting.add(here)
            if step < len(needs[here]):
                there = needs[here][step]
                work.append((here, step + 1))
                if there not in order:
                    work.append((there, 0))
                elif there in waiting:
                    low[here] = min(low[here], order[there])
                continue
            if work:
                above = work[-1][0]
                low[above] = min(low[above], low[here])
            if low[here] == order[here]:
                cut = pending.index(here)
                waiting.difference_update(pending[cut:])
                out.append(sorted(pending[cut:]))
                del pending[cut:]
    return out
