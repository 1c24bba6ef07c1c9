"""The places of the points of a picture: many initial layouts are relaxed, the best result is chosen."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import compared_by_value
from gruebler.pictures.structure.bodies import LayoutBodies
from gruebler.pictures.structure.embedding import Rotation, an_embedding, embeddings
from gruebler.pictures.structure.initial_layouts import InitialLayout, initial_layouts, tutte
from gruebler.pictures.structure.planarisation import PlanarisedGraph, planarised_graph

_STARTS = 1500  # divided by the number of vertices: relaxed layouts; a chain of ten links has at most about forty
_EMBEDDINGS = 600  # divided by the number of vertices: embeddings considered
_CROSSED = 12  # choices of crossings that are tried
_HUB, _CROSSING = -3, -4  # colours of vertices that are not points
_FINALISTS = 4  # relaxed again, with more weight on the smallest distances
_SYMMETRY = 1.35  # a symmetric layout is preferred to others with up to this factor of clearance


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Layout:
    """The places of the points: the bodies do not overlap, except the pairs in ``crossings``."""

    points: NDArray[np.float64]
    """float64[points, 2], y upward, free ends and elbows included; the longer side of the layout is 1."""
    outlines: tuple[tuple[int, ...], ...]
    """The points of each body in drawing order."""
    crossings: tuple[tuple[int, int], ...]
    """Pairs of bodies that cross."""
    covered: int
    """The number of points inside a polygon to which they do not belong."""
    clearance: float
    """The smallest distance of a point from a bar or an edge that it does not end."""
    turns: NDArray[np.float64]
    """float64[symmetries, 2, 2]: the turns and reflections that map the layout onto itself."""
    images: tuple[tuple[int, ...], ...]
    """The images of the points under each."""
    faces: tuple[tuple[int, ...], ...]
    """The points around each inner face; none if bodies cross."""

    @property
    def rank(self) -> tuple[int, int, float]:
        """Smaller is better."""
        return len(self.crossings), self.covered, -self.clearance * (_SYMMETRY if len(self.images) > 1 else 1.0)


@dataclass(frozen=True, slots=True)
class _Task:
    """The input of the kernels: segments, their bodies, and the points that must keep a distance from them."""

    segments: NDArray[np.int64]
    owners: tuple[int, ...]
    pull: NDArray[np.float64]
    watched: NDArray[np.int64]


def lay_out(bodies: LayoutBodies) -> Layout:
    """The layout of bodies: no crossing if that is possible, even clearance, symmetry where an embedding has it.

    The same for the same numbering. Cost: some 10 ms for 13 points, a second for 60.

    >>> lay_out(LayoutBodies.of([0, 0, 0], [[0, 1], [1, 2], [2, 0]])).crossings
    ()
    """
    if bodies.size < 3:
        return _line(bodies)
    graph = _graph(bodies)
    _runs: list[_Run] = []
    most = _STARTS // len(graph)
    for crossed in planarised_graph(graph, bodies.bars)[:_CROSSED]:
        colours = [*bodies.point_colours, *(_HUB for _ in bodies.polygons)]
        colours += [_CROSSING] * (len(crossed.graph) - len(colours))
        begins = initial_layouts(_rotations(crossed), colours)
        _runs += [_Run(bodies, crossed, start) for start in begins]
    first = sorted(((run.relaxed(), run) for run in _runs[: max(8, most)]), key=lambda pair: pair[0].rank)
    return min((run.polished(layout) for layout, run in first[:_FINALISTS]), key=lambda layout: layout.rank)


def _graph(bodies: LayoutBodies) -> list[list[int]]:
    """The points, joined by bars, then a hub for each polygon, joined to its points."""
    graph: list[list[int]] = [[] for _ in range(bodies.size)]
    for p, q in bodies.bars:
        graph[p].append(q)
        graph[q].append(p)
    for hub, body in enumerate(bodies.polygons, bodies.size):
        graph.append(list(body))
        for p in body:
            graph[p].append(hub)
    return graph


def _rotations(crossed: PlanarisedGraph) -> Iterable[Rotation]:
    most = max(4, _EMBEDDINGS // len(crossed.graph))
    rotations = list(islice(filter(crossed.is_crossing, embeddings(crossed.graph)), most))
    return rotations or [an_embedding(crossed.graph)]


@dataclass(frozen=True, slots=True)
class _Run:
    """The relaxation of one initial layout."""

    bodies: LayoutBodies
    crossed: PlanarisedGraph
    start: InitialLayout

    def relaxed(self) -> Layout:
        """A first layout, without crossings if the start has none."""
        hubs = range(self.bodies.size, self.bodies.size + len(self.bodies.polygons))
        x = tutte(self.start, hubs)
        if self.crossed.strands:
            x = self._relax(x, self._task(bent=True), 2, 200)
        return self._layout(x, 2, 120)

    def polished(self, layout: Layout) -> Layout:
        """The layout with larger smallest distances."""
        x = np.zeros((len(self.start.rotation), 2))
        x[: self.bodies.size] = layout.points * 5.0
        return min(layout, self._layout(x, 6, 300), key=lambda candidate: candidate.rank)

    def _layout(self, x: NDArray[np.float64], power: int, rounds: int) -> Layout:
        task = self._task(bent=False)
        x = self._relax(x, task, power, rounds)
        points = x[: self.bodies.size]
        points = points / np.ptp(points, axis=0).max()
        drawn = task.segments[task.pull > 0]
        crossings = {(task.owners[i], task.owners[j]) for i, j in _core.crossing_segments(points, drawn)}
        outlines = self._outlines()
        return Layout(
            points=points,
            outlines=outlines,
            crossings=tuple(sorted({(min(pair), max(pair)) for pair in crossings})),
            covered=_covered(points, outlines),
            clearance=_core.closest(points, task.segments, task.watched),
            turns=self.start.turns,
            images=tuple(image[: self.bodies.size] for image in self.start.images),
            faces=()
            if crossings or self.crossed.strands
            else tuple(self._without_hubs(walk) for walk in self.start.inner),
        )

    def _relax(self, x: NDArray[np.float64], task: _Task, power: int, rounds: int) -> NDArray[np.float64]:
        images = np.array(self.start.images, np.int64)
        relaxed, _ = _core.relax(x, task.segments, task.pull, task.watched, images, self.start.turns, power, rounds)
        return relaxed

    def _without_hubs(self, walk: tuple[int, ...]) -> tuple[int, ...]:
        return tuple(p for p in walk if p < self.bodies.size)

    def _outlines(self) -> tuple[tuple[int, ...], ...]:
        hubs = iter(range(self.bodies.size, self.bodies.size + len(self.bodies.polygons)))
        return tuple(
            path if len(body) < 3 else self._around(next(hubs))
            for body, path in zip(self.bodies.bodies, self.bodies.paths, strict=True)
        )

    def _around(self, hub: int) -> tuple[int, ...]:
        """The points of a polygon in cyclic order, crossings skipped."""
        ends = {s[1]: s[-1] for s in self.crossed.strands if s[0] == hub}
        ends |= {s[-2]: s[0] for s in self.crossed.strands if s[-1] == hub}
        return tuple(ends.get(p, p) for p in self.start.rotation[hub])

    def _task(self, *, bent: bool) -> _Task:
        """Bars as straight lines, or bent where they cross others."""
        segments: list[tuple[int, int]] = []
        owners: list[int] = []
        pull: list[float] = []
        chords = []
        strands = {frozenset((s[0], s[-1])): s for s in self.crossed.strands} if bent else {}
        for number, outline in enumerate(self._outlines()):
            closed = len(self.bodies.bodies[number]) > 2
            corners = [*outline, outline[0]] if closed else list(outline)
            for pair in pairwise(corners):
                path = pair if closed else strands.get(frozenset(pair), pair)
                segments += pairwise(path)
                pull += [1.0 if len(path) == 2 else 4.0] * (len(path) - 1)
            owners += [number] * (len(segments) - len(owners))
            if closed and len(outline) > 3:
                chords += [(outline[k - 2], outline[k], outline[k - 1]) for k in range(len(outline))]
        points = [*range(self.bodies.size), *(range(self.crossed.first, len(self.crossed.graph)) if bent else ())]
        watched = [(s, p) for s, ends in enumerate(segments) for p in points if p not in ends]
        for a, b, corner in chords:
            watched.append((len(segments), corner))
            segments.append((a, b))
            pull.append(0.0)
        pairs = np.array(watched, np.int64).reshape(-1, 2)
        return _Task(np.array(segments, np.int64), tuple(owners), np.array(pull), pairs)


def _covered(points: NDArray[np.float64], outlines: tuple[tuple[int, ...], ...]) -> int:
    """The number of points inside a polygon to which they do not belong."""
    number = 0
    for outline in outlines:
        if len(set(outline)) < 3:
            continue
        corners = points[list(outline)]
        after = points[[*outline[1:], outline[0]]]
        above = (corners[:, 1] > points[:, 1, None]) != (after[:, 1] > points[:, 1, None])
        with np.errstate(divide="ignore", invalid="ignore"):
            cut = corners[:, 0] + (points[:, 1, None] - corners[:, 1]) / (after[:, 1] - corners[:, 1]) * (
                after[:, 0] - corners[:, 0]
            )
        inside = ((above & (points[:, 0, None] < cut)).sum(axis=1) % 2).astype(bool)
        inside[list(outline)] = False
        number += int(inside.sum())
    return number


def _line(bodies: LayoutBodies) -> Layout:
    points = np.array([[k / max(1, bodies.size - 1), 0.0] for k in range(bodies.size)])
    alone = (tuple(range(bodies.size)),)
    return Layout(
        points=points,
        outlines=bodies.paths,
        crossings=(),
        covered=0,
        clearance=1.0,
        turns=np.eye(2)[None],
        images=alone,
        faces=(),
    )
