"""Generic mobility by combinatorics: pebble games, where a theorem proves that counting suffices.

- A plane (or sphere) with turning, rolling and roll-slide joints: let every revolute or rolling joint be a point,
  every link a rigid graph on its points, every roll-slide joint a bar between two points of its own. The
  generic mobility is 2V - 3 minus the rank of the (2,3)-sparsity matroid (Pollaczek-Geiringer 1927, Laman 1970;
  on the sphere by Whiteley's coning 1983). Multiple joints are points of more than two links.
- The same without multiple joints, links as bodies: (3,3)-sparsity, a revolute or rolling joint worth two bars,
  a roll-slide joint one (Tay 1984, 1989; Whiteley 1988).
- Space with revolute joints (five bars) and balls on planes (one bar): (6,6)-sparsity (the same authors).

Sliders, balls, cylinders and multiple joints in space are outside these theorems; `theorem` then states the reason.
Rolling is, at one instant, turning about the point of contact; "generic" takes that point at random.
docs/theory/mobility.md has the statements and the reductions.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from gruebler.base.errors import ChainError
from gruebler.base.text import Message, message
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.chain.spaces import Space


def _is_bars(pair: Pair, space: Space) -> bool:
    """Whether a theorem takes the pair for as many bars as it takes motions away."""
    if space is Space.SPATIAL:
        return pair.is_turning or pair.u(space) == 1
    return not pair.keeps_directions


@dataclass(frozen=True, slots=True)
class License:
    """Whether a theorem justifies the pebble game for a chain."""

    bodies: bool
    """Links as bodies: (3,3) or (6,6)."""
    points: bool
    """Joints as points: (2,3)."""
    reason: Message
    """The theorem, or the feature of the chain that no theorem used here covers."""

    def __bool__(self) -> bool:
        return self.bodies or self.points


def theorem(chain: Chain) -> License:
    """Which theorem, if any, covers the chain.

    >>> bool(theorem(Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)")))
    False
    """
    outside = sorted({j.pair for j in chain.joints if not _is_bars(j.pair, chain.space)}, key=lambda p: p.name)
    if outside:
        return License(
            False,
            False,
            message(
                "no theorem covers {pair} joints in {space} chains",
                pair=outside[0].title,
                space=chain.space.adjective,
            ),
        )
    if not chain.multiple_joints:
        points = chain.space is not Space.SPATIAL
        return License(True, points, message("Tay and Whiteley: bodies joined by hinges and bars"))
    if chain.space is Space.SPATIAL:
        return License(False, False, message("no theorem used here covers multiple joints in space"))
    return License(
        False, True, message("Pollaczek-Geiringer and Laman: joints as points, links as rigid graphs on them")
    )


def pebble_mobility(chain: Chain, *, points: bool | None = None) -> int:
    """The generic mobility by a pebble game.

    Args:
        chain: a chain that a theorem covers.
        points: take joints as points (True), links as bodies (False), or whichever is licensed (None).

    Raises `ChainError` where no theorem licenses the game. Cost O(n g).

    >>> pebble_mobility(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"))
    1
    """
    license_ = theorem(chain)
    use_points = points if points is not None else not license_.bodies
    if not (license_.points if use_points else license_.bodies):
        raise ChainError("the pebble game cannot answer: {reason}", reason=license_.reason)
    if use_points:
        vertices, edges = _point_graph(chain)
        return 2 * vertices - 3 - pebble_rank(vertices, edges, 2, 3)
    space, b = chain.space, chain.space.b
    edges = [(chain.index(j.links[0]), chain.index(j.links[1])) for j in chain.joints for _ in range(j.pair.u(space))]
    return b * (chain.n - 1) - pebble_rank(chain.n, edges, b, b)


def _point_graph(chain: Chain) -> tuple[int, list[tuple[int, int]]]:
    """The bar-and-joint graph with the same generic motions, every link a triangulated fan on its points."""
    points: dict[str, list[int]] = {link: [] for link in chain.links}
    edges = []
    vertices = 0
    for joint in chain.joints:
        if joint.pair.u(chain.space) == 2:
            for link in joint.links:
                points[link].append(vertices)
            vertices += 1
        else:
            for link in joint.links:
                points[link].append(vertices)
                vertices += 1
            edges.append((vertices - 2, vertices - 1))
    for link_points in points.values():
        while len(link_points) < 2:
            link_points.append(vertices)
            vertices += 1
        first, second, *others = link_points
        edges.append((first, second))
        for point in others:
            edges += [(first, point), (second, point)]
    return vertices, edges


def pebble_rank(vertices: int, edges: Iterable[tuple[int, int]], k: int, l: int) -> int:  # noqa: E741
    """The rank of these edges in the (k, l)-sparsity matroid: every set of v vertices spans at most k v - l edges.

    Needs 0 <= l < 2k and edges without loops; edges may repeat. Lee and Streinu 2008; O(vertices · edges).

    >>> pebble_rank(4, [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)], 2, 3)
    5
    """
    pebbles = [k] * vertices
    successors: list[list[int]] = [[] for _ in range(vertices)]

    def turn_path(came_from: dict[int, int], root: int, end: int) -> None:
        while end != root:
            back = came_from[end]
            successors[back].remove(end)
            successors[end].append(back)
            end = back

    def fetch(root: int, other: int) -> bool:
        """Bring one free pebble to root along the arcs, leaving those on other where they are."""
        came_from = {root: root, other: other}
        stack = [root]
        while stack:
            vertex = stack.pop()
            for neighbour in successors[vertex]:
                if neighbour in came_from:
                    continue
                came_from[neighbour] = vertex
                if pebbles[neighbour]:
                    pebbles[neighbour] -= 1
                    pebbles[root] += 1
                    turn_path(came_from, root, neighbour)
                    return True
                stack.append(neighbour)
        return False

    rank = 0
    for u, v in edges:
        while pebbles[u] + pebbles[v] <= l and (fetch(u, v) or fetch(v, u)):
            pass
        if pebbles[u] + pebbles[v] > l:
            start, end = (u, v) if pebbles[u] else (v, u)
            pebbles[start] -= 1
            successors[start].append(end)
            rank += 1
    return rank
