"""Closed bodies of triangles: turned bodies, balls, boxes, plates, bars along a curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.convex_hull import convex_hull

_SIDES = 16
SIDES_OF_WHEEL = 72


@dataclass(frozen=True, eq=False, slots=True)
class Solid:
    """A closed surface of triangles, counterclockwise as seen from outside."""

    vertices: Reals
    """(vertices, 3), in the linkage's unit."""
    triangles: NDArray[np.intp]
    """(triangles, 3)."""

    @property
    def volume(self) -> float:
        """What it encloses: the sum of the tetrahedra from the origin to each triangle.

        >>> round(box_solid(np.zeros(3), np.eye(3), (1.0, 2.0, 3.0)).volume, 9)
        48.0
        """
        a, b, c = (self.vertices[self.triangles[:, k]] for k in range(3))
        return float((a * np.cross(b, c)).sum() / 6)


def turned_solid(start: Reals, end: Reals, profile: Reals, phase: float = 0.0, sides: int = _SIDES) -> Solid:
    """A turned body: (along, radius) from start (0) to end (1), beginning and ending on the axis.

    Bars that begin at one place differ by their phase: bodies that share an edge are not closed to a reader.

    >>> tip = turned_solid(np.zeros(3), np.array([0.0, 0, 3]), np.array([[0, 0], [0, 1], [1, 0.0]]))
    >>> round(tip.volume, 2)  # of a pyramid with 16 sides
    3.06
    """
    axis = end - start
    unit = axis / np.linalg.norm(axis)
    u = np.cross(unit, np.eye(3)[int(np.argmin(np.round(abs(unit), 6)))])
    u /= np.linalg.norm(u)
    v = np.cross(unit, u)
    turn = 2 * pi * np.arange(sides) / sides + phase
    ring = np.cos(turn)[:, None] * u + np.sin(turn)[:, None] * v
    rings = [start + along * axis + radius * ring for along, radius in profile[1:-1]]
    return _tube(start + profile[0, 0] * axis, rings, start + profile[-1, 0] * axis)


def threaded_solid(start: Reals, end: Reals, inner: float, outer: float, lead: float) -> Solid:
    """A rod with one groove that winds round it, right-handed where the lead is positive."""
    axis = end - start
    long = float(np.linalg.norm(axis))
    unit = axis / long
    u = np.cross(unit, np.eye(3)[int(np.argmin(np.round(abs(unit), 6)))])
    u /= np.linalg.norm(u)
    turn = 2 * pi * np.arange(_SIDES) / _SIDES
    ring = np.cos(turn)[:, None] * u + np.sin(turn)[:, None] * np.cross(unit, u)
    rings = []
    for along in np.linspace(0, long, 1 + max(2, round(_SIDES * long / abs(lead)))):
        radius = (outer + inner + (outer - inner) * np.cos(2 * pi * along / lead - turn)) / 2
        rings.append(start + along * unit + radius[:, None] * ring)
    return _tube(start, rings, end)


def _tube(first: Reals, rings: Sequence[Reals], last: Reals) -> Solid:
    """From a place through rings, each counterclockwise about the way on, to another place."""
    sides = len(rings[0])
    k = np.arange(sides)
    after = (k + 1) % sides
    faces = [np.stack([0 * k, 1 + after, 1 + k], axis=1)]
    for n in range(len(rings) - 1):
        low = 1 + n * sides
        faces += [
            np.stack([low + k, low + after, low + sides + k], axis=1),
            np.stack([low + after, low + sides + after, low + sides + k], axis=1),
        ]
    low, top = 1 + (len(rings) - 1) * sides, 1 + len(rings) * sides
    faces.append(np.stack([low + k, low + after, 0 * k + top], axis=1))
    return Solid(np.concatenate([[first], *rings, [last]]), np.concatenate(faces))


def cylinder_solid(
    start: Reals, end: Reals, radius: float, last: float | None = None, phase: float = 0.0, sides: int = _SIDES
) -> Solid:
    """A cylinder, or a cone's piece with another radius at its end."""
    profile = np.array([[0, 0], [0, radius], [1, radius if last is None else last], [1, 0]])
    return turned_solid(start, end, profile, phase, sides)


def bevel_solid(axis: Reals, tooth: Reals, cone: float, teeth: int, face: float) -> Solid:
    """A bevel gear on the sphere of the radius 1: teeth about its pitch cone, one of them towards ``tooth``.

    Its axis goes from the middle of the sphere, its teeth from the part ``face`` of the radius to the sphere.

    >>> gear = bevel_solid(np.eye(3)[2], np.eye(3)[0], pi / 4, 20, 0.7)
    >>> bool(gear.volume / (pi / 6 * np.cos(pi / 4) * (1 - 0.7**3)) < 1.1)  # of the piece of the pitch cone
    True
    """
    module = 2 * np.sin(cone) / teeth
    across = np.cross(axis, tooth)
    quarters = np.arange(4 * teeth)
    turn = 2 * pi / teeth * (quarters // 4 + np.array([-0.3, -0.14, 0.14, 0.3])[quarters % 4])
    angle = cone + module * np.array([-1.1, 1.0, 1.0, -1.1])[quarters % 4]
    outward = np.cos(turn)[:, None] * tooth + np.sin(turn)[:, None] * across
    ring = np.cos(angle)[:, None] * axis + np.sin(angle)[:, None] * outward
    end = np.cos(cone) * axis
    # flat within the teeth; a second ring beside its rim keeps the light of the teeth off the flat
    disc, flat = (end + (np.sin(cone) - part * module) * outward for part in (2.5, 2.6))
    return _tube(face * end, [face * flat, face * disc, face * ring, ring, disc, flat], end)


def bent_solid(places: Reals, radius: float, phase: float = 0.0) -> Solid:
    """A round bar along places of an arc of a circle.

    >>> arc = np.pi / 2 * np.linspace(0, 1, 25)  # a quarter of a torus: pi^2 / 2 times 0.1^2, here with 16 sides
    >>> round(bent_solid(np.stack([np.cos(arc), np.sin(arc), 0 * arc], axis=1), 0.1).volume, 3)
    0.048
    """
    ways = np.diff(places, axis=0)
    ways = ways / np.linalg.norm(ways, axis=1)[:, None]
    along = np.concatenate([ways[:1], ways[:-1] + ways[1:], ways[-1:]])
    along /= np.linalg.norm(along, axis=1)[:, None]
    normal = np.cross(ways[0], ways[len(ways) // 2])
    normal /= np.linalg.norm(normal)
    turn = 2 * pi * np.arange(_SIDES) / _SIDES + phase
    rings = [
        place + radius * (np.cos(turn)[:, None] * normal + np.sin(turn)[:, None] * np.cross(tangent, normal))
        for place, tangent in zip(places, along, strict=True)
    ]
    return _tube(places[0], rings, places[-1])


def ball_solid(middle: Reals, radius: float) -> Solid:
    """A ball."""
    angle = np.linspace(0, pi, _SIDES // 2 + 1)
    profile = np.stack([(1 - np.cos(angle)) / 2, radius * np.sin(angle)], axis=1)
    up = radius * np.array([0.0, 0.0, 1.0])
    return turned_solid(middle - up, middle + up, profile)


def box_solid(middle: Reals, axes: Reals, halves: Sequence[float] | Reals) -> Solid:
    """A box along the columns of a rotation."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [each for a, b, c, d in faces for each in ((a, b, c), (a, c, d))]
    return Solid(middle + (signs * np.array(halves)) @ axes.T, np.array(triangles, np.intp))


def hull_solid(places: Reals, radius: float) -> Solid:
    """The convex body about balls at places.

    >>> corners = np.array([[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9.0]])
    >>> 9**3 / 6 < hull_solid(corners, 1.0).volume < 11**3
    True
    """
    from scipy.spatial import ConvexHull

    hull = ConvexHull(np.concatenate([ball_solid(place, radius).vertices for place in places]))
    corners, triangles = np.unique(hull.simplices, return_inverse=True)
    vertices, triangles = hull.points[corners], triangles.reshape(-1, 3)
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    inward = (np.cross(b - a, c - a) * hull.equations[:, :3]).sum(axis=1) < 0
    triangles[inward] = triangles[inward, ::-1]
    return Solid(vertices, triangles)


def plate_solid(places: Reals, radius: float) -> Solid | None:
    """A plate under places of a plane, as far beyond them and as thick as the radius; None if they lie in no plane.

    Places on one line have no plate either.

    >>> square = np.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0.0]])
    >>> round(plate_solid(square, 1.0).volume, 3)  # 4 × 4, 1 at each side, an octagon's eighths at the corners
    34.828
    """
    middle = places.mean(axis=0)
    _, spread, axes = np.linalg.svd(places - middle)
    if len(places) <= 2 or spread[1] < 2 * radius or spread[2] > radius / 4:
        return None
    rim = radius * np.exp(1j * pi * np.arange(8) / 4)
    flat = ((places - middle) @ axes[:2].T) @ np.array([1, 1j])
    hull = np.array(convex_hull(np.add.outer(flat, rim).ravel().tolist()))
    count = len(hull)
    low, high = (
        middle + hull.real[:, None] * axes[0] + hull.imag[:, None] * axes[1] + h * axes[2] for h in (0, radius)
    )
    k = np.arange(count)
    after = (k + 1) % count
    fan = np.stack([0 * k[1:-1], k[1:-1], after[1:-1]], axis=1)
    sides = [np.stack([k, after, count + after], axis=1), np.stack([k, count + after, count + k], axis=1)]
    triangles = np.concatenate([fan[:, ::-1], count + fan, *sides])
    solid = Solid(np.concatenate([low, high]) - radius / 2 * axes[2], triangles)
    return solid if solid.volume > 0 else Solid(solid.vertices, triangles[:, ::-1])
