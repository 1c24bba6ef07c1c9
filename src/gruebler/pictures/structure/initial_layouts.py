"""Initial layouts: an embedding, its outer face, their common symmetry, and a drawing without crossings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler.pictures.structure.embedding import Rotation, faces

Walk = tuple[int, ...]
_SPARSE = 400  # vertices: from here on most of the matrix is zeros


@dataclass(frozen=True, slots=True, kw_only=True)
class InitialLayout:
    """An embedding with a chosen outer face and the symmetries of both."""

    rotation: Rotation
    outer: Walk
    """The vertices along the outer face, clockwise in the picture."""
    inner: tuple[Walk, ...]
    images: tuple[tuple[int, ...], ...]
    """Each symmetry as the images of the vertices; the identity is the first."""
    turns: NDArray[np.float64]
    """float64[symmetries, 2, 2]: the matrix of each in the plane."""
    code: tuple[int, ...]
    """Equal for layouts that differ only in names or by reflection."""


def initial_layouts(rotations: Iterable[Rotation], colours: Sequence[int]) -> list[InitialLayout]:
    """Every initial layout once, those with symmetry first, then those with a long outer face."""
    layouts: dict[tuple[int, ...], InitialLayout] = {}
    for rotation in rotations:
        walks = [tuple(u for u, _ in walk) for walk in faces(rotation)]
        for k, outer in enumerate(walks):
            code, readings = _least_code(rotation, colours, outer)
            if code not in layouts:
                inner = tuple(walks[:k] + walks[k + 1 :])
                images, turns = _symmetries(readings, len(outer))
                layouts[code] = InitialLayout(
                    rotation=rotation, outer=outer, inner=inner, images=images, turns=turns, code=code
                )
    return sorted(layouts.values(), key=lambda start: (len(start.images) == 1, -len(start.outer), start.code))


@dataclass(frozen=True, slots=True)
class _MapReading:
    """One reading of a map: its start on the outer walk, its direction, and the order of the vertices."""

    begin: int
    sign: int
    order: tuple[int, ...]


def _least_code(rotation: Rotation, colours: Sequence[int], outer: Walk) -> tuple[tuple[int, ...], list[_MapReading]]:
    """The least code of the map over all readings of its outer walk, and the readings with this code."""
    near = [(len(rotation[v]), colours[v]) for v in outer]
    readings = [(near[k:] + near[:k], k, 1) for k in range(len(outer))]
    near = near[::-1]
    last = len(outer) - 1
    readings += [(near[last - k :] + near[: last - k], k, -1) for k in range(len(outer))]
    least = min(reading[0] for reading in readings)
    best: tuple[int, ...] | None = None
    best_readings: list[_MapReading] = []
    for signature, begin, sign in readings:
        if signature == least:
            code, order = _read(rotation, colours, outer, begin, sign)
            if best is None or code < best:
                best, best_readings = code, []
            if code == best:
                best_readings.append(_MapReading(begin, sign, order))
    assert best is not None  # some reading is the least
    return best, best_readings


def _read(
    rotation: Rotation, colours: Sequence[int], outer: Walk, begin: int, sign: int
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """The map as numbers, with the vertices in the order of a search from one dart of the outer walk."""
    first, second = outer[begin], outer[(begin + sign) % len(outer)]
    number = {first: 0, second: 1}
    order = [first, second]
    entry = {first: second, second: first}
    code = [len(outer)]
    for v in order:
        around = rotation[v][::sign]
        k = around.index(entry[v])
        code += (colours[v], len(around))
        for u in around[k:] + around[:k]:
            if u not in number:
                number[u] = len(order)
                order.append(u)
                entry[u] = v
            code.append(number[u])
    return tuple(code), tuple(order)


def _symmetries(readings: list[_MapReading], length: int) -> tuple[tuple[tuple[int, ...], ...], NDArray[np.float64]]:
    """The maps from the first reading to the others; corner i of the outer walk is at the angle -2 pi i/length."""
    base = readings[0]
    images, turns = [], []
    for reading in readings:
        image = [0] * len(base.order)
        for v, w in zip(base.order, reading.order, strict=True):
            image[v] = w
        images.append(tuple(image))
        angle = -2 * math.pi * (reading.begin - reading.sign * base.sign * base.begin) / length
        cos, sin = math.cos(angle), math.sin(angle)
        mirrored = reading.sign * base.sign
        turns.append([[cos, -mirrored * sin], [sin, mirrored * cos]])
    return tuple(images), np.array(turns)


def tutte(start: InitialLayout, hubs: range) -> NDArray[np.float64]:
    """A drawing of the vertices of the initial layout without crossings, with its symmetry: float64[vertices, 2].

    Every vertex is the barycentre of its neighbours (Tutte 1963). The graph is first made three-connected by an edge
    between successive neighbours of a hub, in every face a ring with one vertex for each corner and one in its
    middle, and around the outer face a ring that is fixed on a circle. Cost O(vertices^3), for large graphs about
    O(vertices^1.5).
    """
    n = len(start.rotation)
    edges = [(u, v) for u, around in enumerate(start.rotation) for v in around if u < v]
    for hub in hubs:
        around = start.rotation[hub]
        edges += [(around[k - 1], around[k]) for k in range(len(around))]
    total = n
    for walk in start.inner:
        edges += _spokes(walk, total, hubs)
        edges += [(total + k, total + (k + 1) % len(walk)) for k in range(len(walk))]
        edges += [(total + k, total + len(walk)) for k in range(len(walk))]
        total += len(walk) + 1
    outer = start.outer
    edges += _spokes(outer, total, hubs)
    angles = -2 * math.pi * np.arange(len(outer)) / len(outer)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return (_balanced if total < _SPARSE else _balanced_sparse)(np.array(edges).T, total, circle)[:n]


def _balanced(edges: NDArray[np.int64], total: int, circle: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places of the first vertices, each the barycentre of its neighbours, with the others fixed on the circle."""
    matrix = np.zeros((total + len(circle), total + len(circle)))
    np.add.at(matrix, tuple(edges), -1.0)
    np.add.at(matrix, tuple(edges[::-1]), -1.0)
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return np.asarray(np.linalg.solve(matrix[:total, :total], -matrix[:total, total:] @ circle), np.float64)


def _balanced_sparse(edges: NDArray[np.int64], total: int, circle: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same for large graphs; the places agree to rounding."""
    from scipy.sparse import coo_array, diags_array
    from scipy.sparse.linalg import splu

    ends = np.concatenate([edges, edges[::-1]], axis=1)
    ends = ends[:, ends[0] != ends[1]]
    size = total + len(circle)
    near = coo_array((np.ones(ends.shape[1]), tuple(ends)), shape=(size, size)).tocsr()
    laplacian = (diags_array(near.sum(axis=1)) - near).tocsc()
    return np.ascontiguousarray(splu(laplacian[:total, :total]).solve(near[:total, total:] @ circle))


def _spokes(walk: Walk, first: int, hubs: range) -> Iterator[tuple[int, int]]:
    """From the vertices of a face to its ring; a hub is hidden behind the edge between its neighbours."""
    for k, v in enumerate(walk):
        if v not in hubs:
            yield v, first + k
        else:
            yield walk[k - 1], first + k
            yield walk[(k + 1) % len(walk)], first + k
