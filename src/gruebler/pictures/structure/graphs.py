"""Other pictures of a chain: its link graph, its contracted graph, and its independent loops."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from gruebler.pictures.canvas.figure import Figure, figure_of
from gruebler.pictures.canvas.free_space import complexes, from_segment, is_inside
from gruebler.pictures.canvas.labels import labels_or_numbers, legend, short_names
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, TextShape
from gruebler.pictures.canvas.symbols import arrow_head
from gruebler.pictures.structure.bodies import LayoutBodies
from gruebler.pictures.structure.layout import lay_out
from gruebler.pictures.structure.messages import describe, title
from gruebler.pictures.structure.orientation import upright
from gruebler.pictures.structure.picture import chain_of, letters, mean_scale, paint, place_joints
from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space
from gruebler.structure.isomorphism import canonical_order
from gruebler.structure.mechanism import Mechanism

_NODE = 11.0
_BIG = 6.0
_SMALL = 3.2
_LOOP = 15.0  # radius of the largest arrow in a loop
_GRID = 24  # places in a row of the search for the largest free space


@dataclass(frozen=True, slots=True)
class _Placed:
    points: tuple[Point, ...]
    paths: tuple[tuple[Point, ...], ...]


def _placed(colours: Sequence[int], bodies: Sequence[Sequence[int]]) -> _Placed:
    layout = lay_out(LayoutBodies.of(colours, bodies))
    scale = mean_scale(layout)
    points = [Point(scale * x, -scale * y) for x, y in upright(layout, None).tolist()]
    paths = [tuple(points[p] for p in outline) for outline in layout.outlines]
    curved = [path if len(body) > 2 else _smooth(path) for body, path in zip(bodies, paths, strict=True)]
    return _Placed(tuple(points[: len(colours)]), tuple(curved))


def _smooth(path: tuple[Point, ...]) -> tuple[Point, ...]:
    """A path through elbows as a curve (of Bezier's, through one elbow or towards two)."""
    if len(path) < 3:
        return path
    a, b = path[0], path[-1]
    if len(path) == 3:
        control = path[1].plus(path[1].minus(a), 0.5).plus(path[1].minus(b), 0.5)
        controls = (a.plus(control.minus(a), 2 / 3), b.plus(control.minus(b), 2 / 3))
    else:
        controls = (a.plus(path[1].minus(a), 4 / 3), b.plus(path[-2].minus(b), 4 / 3))
    return tuple(_bezier((a, *controls, b), k / 48) for k in range(49))


def _bezier(points: Sequence[Point], t: float) -> Point:
    controls = list(points)
    while len(controls) > 1:
        controls = [p.plus(q.minus(p), t) for p, q in pairwise(controls)]
    return controls[0]


def draw_graph(structure: Chain | Mechanism, *, lang: str = "en", name: str = "") -> Figure:
    """The link graph: a node for each link, an edge for each joint, an area for a multiple joint.

    A frame has a double circle; joints that do not turn have their symbol beside them.

    >>> draw_graph(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")).title
    'four-bar chain'
    """
    chain = chain_of(structure)
    order = canonical_order(chain)
    rank = {chain.links[i]: k for k, i in enumerate(order.links)}
    joints = [chain.joints[k] for k in order.joints]
    drawn = _placed([0] * chain.n, [[rank[link] for link in joint.links] for joint in joints])
    shapes: list[Shape] = []
    for joint, path in zip(joints, drawn.paths, strict=True):
        closed = len(joint.links) > 2
        shapes.append(Polylines((path,), "area" if closed else "edge", closed))
        if not joint.pair.is_turning or chain.space is not Space.PLANAR:
            a, b = path[len(path) // 2 - 1], path[len(path) // 2]
            middle = a.plus(b.minus(a), 0.5).plus(b.minus(a).unit.across, 9.0)
            shapes.append(TextShape(middle, letters(joint.pair, lang), "note"))
    names = short_names(chain.links)
    for link in chain.links:
        at = drawn.points[rank[link]]
        if isinstance(structure, Mechanism) and link == structure.frame:
            shapes.append(CircleShape(at, _NODE + 3.5, "node"))
        shapes += [CircleShape(at, _NODE, "node"), TextShape(at, names[link], "letter")]
    listed = {link: number for link, number in names.items() if link != number}
    shapes += legend(listed, drawn.points) if listed else ()
    return figure_of(shapes, title(structure, lang, name), describe(structure, lang))


def draw_contracted(structure: Chain | Mechanism, *, lang: str = "en", name: str = "") -> Figure:
    """The contracted graph: links with three joints or more, and the strings of binary links between them, as dots.

    Filled nodes are links, open ones multiple joints; a free end is a node too. A closed loop without any such node is
    drawn from its first link.
    """
    chain = chain_of(structure)
    nodes, strings = _strings(chain)
    drawn = _placed([int(v >= chain.n) for v in nodes], [(a, b) for a, b, _ in strings])
    shapes: list[Shape] = [Polylines((path,), "edge") for path in drawn.paths]
    for (_, _, binary), path in zip(strings, drawn.paths, strict=True):
        shapes += [CircleShape(_along(path, (k + 1) / (binary + 1)), _SMALL, "dot") for k in range(binary)]
    shapes += [
        CircleShape(at, _BIG, "node" if v >= chain.n else "block") for v, at in zip(nodes, drawn.points, strict=True)
    ]
    return figure_of(shapes, title(structure, lang, name), describe(structure, lang))


def _strings(chain: Chain) -> tuple[list[int], list[tuple[int, int, int]]]:
    """Nodes (links, then joints, in canonical order) and strings: two places among them, number of binary links."""
    order = canonical_order(chain)
    rank = {chain.links[i]: k for k, i in enumerate(order.links)}
    near: list[list[int]] = [[] for _ in range(chain.n + len(chain.joints))]
    for number, k in enumerate(order.joints, chain.n):
        for link in sorted(rank[link] for link in chain.joints[k].links):
            near[link].append(number)
            near[number].append(link)
    nodes = [v for v, around in enumerate(near) if len(around) != 2] or [0]
    strings, visited = [], set()
    for v in nodes:
        for first in near[v]:
            if (v, first) in visited:
                continue
            path = [v, first]
            while path[-1] not in nodes:
                onward = [w for w in near[path[-1]] if w != path[-2]]
                path.append(onward[0] if onward else path[-2])
            visited |= {(v, first), (path[-1], path[-2])}
            strings.append((nodes.index(v), nodes.index(path[-1]), sum(u < chain.n for u in path[1:-1])))
    return nodes, strings


def _along(path: Sequence[Point], part: float) -> Point:
    """The point after this part of the length of a path."""
    steps = [b.minus(a).length for a, b in pairwise(path)]
    remaining = part * sum(steps)
    for a, b, step in zip(path, path[1:], steps, strict=False):
        if remaining <= step:
            return a.plus(b.minus(a).unit, remaining)
        remaining -= step
    return path[-1]


def draw_loops(structure: Chain | Mechanism, *, lang: str = "en", name: str = "") -> Figure:
    """The structure picture with the independent loops: a numbered arrow in each inner face.

    Where links cross or share two joints, faces are no loops; a list below the picture then names a shortest basis.
    """
    placed = place_joints(structure)
    shapes = paint(placed, lang)
    if len(placed.faces) != placed.chain.loops or any(len(set(face)) < 3 for face in placed.faces):
        walks = [", ".join(loop) for loop in _shortest_loops(placed.chain)]
        shapes = labels_or_numbers(placed.outlines, {link: d > 2 for link, d in placed.chain.degrees.items()}, shapes)
        shapes += legend({walk: f"{k}:" for k, walk in enumerate(walks, 1)}, _corners(shapes))
        return figure_of(shapes, title(structure, lang, name), describe(structure, lang))
    corners = [[placed.joints[k] for k in face] for face in placed.faces]
    for number, loop in enumerate(sorted(corners, key=lambda loop: _middle(loop)[::-1]), 1):
        at, room = _roomiest(loop)
        arc = ArcShape(
            at,
            radius=max(7.0, min(_LOOP, room - 11.0)),
            begin=math.radians(-60),
            extent=math.radians(300),
            style="drive",
        )
        shapes += [arc, arrow_head(arc), TextShape(at, str(number), "mark")]
    return figure_of(shapes, title(structure, lang, name), describe(structure, lang))


def _corners(shapes: Sequence[Shape]) -> list[Point]:
    """Points that bound all shapes except long lines and texts."""
    return [point for s in shapes if isinstance(s, Polylines) for part in s.parts for point in part] + [
        s.at for s in shapes if isinstance(s, TextShape)
    ]


def _middle(points: Sequence[Point]) -> Point:
    return Point(*(round(sum(axis) / len(points), 3) for axis in zip(*points, strict=True)))


def _shortest_loops(chain: Chain) -> list[tuple[str, ...]]:
    """The links around each loop of a shortest basis, from the first one on."""
    import networkx as nx

    graph = nx.Graph()
    for number, joint in enumerate(chain.joints):
        graph.add_edges_from(((True, number), (False, chain.index(link))) for link in joint.links)
    cycles = [[k for is_joint, k in cycle if not is_joint] for cycle in nx.minimum_cycle_basis(graph)]
    return [tuple(chain.links[k] for k in cycle) for cycle in sorted(map(_from_least, cycles))]


def _from_least(cycle: list[int]) -> list[int]:
    k = cycle.index(min(cycle))
    rotated = cycle[k:] + cycle[:k]
    return min(rotated, [rotated[0], *rotated[:0:-1]])


def _roomiest(loop: Sequence[Point]) -> tuple[Point, float]:
    """The point of a grid inside a polygon that is farthest from its rim, and its distance."""
    left, right = min(p.x for p in loop), max(p.x for p in loop)
    top, bottom = min(p.y for p in loop), max(p.y for p in loop)
    parts = (np.arange(_GRID) + 0.5) / _GRID
    x, y = np.meshgrid(left + (right - left) * parts, top + (bottom - top) * parts, indexing="ij")
    rim, grid = complexes(loop), (x + 1j * y).ravel()
    inside = grid[is_inside(grid, rim)] if len(loop) > 2 else grid[:0]
    if not len(inside):
        inside = complexes([_middle(loop)])
    room = np.min(from_segment(inside[:, None], rim[None, :], np.roll(rim, -1)[None, :]), axis=1).round(3)
    most = float(room.max())
    best = [Point(float(z.real), float(z.imag)) for z in inside[room >= most - 1.0]]
    at = _middle(best)
    return (at, most) if is_inside(complexes([at]), rim)[0] else (max(best), most)
