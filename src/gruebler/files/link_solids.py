"""Links of a linkage in space as closed bodies of triangles: bars between joints, pins in sleeves, balls, wheels.

The sizes of the bodies are chosen here; places and axes are those of the joints in the reference pose. A body of a
link may run into another one of the same link, as a bar into its sleeve. docs/theory/formats.md has the rules.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import cos, isfinite, pi, sin

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.convex_hull import convex_hull
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.round_bodies import TurnedBody
from gruebler.structure.chain.spaces import Space

_SIDES, _SIDES_OF_WHEEL = 16, 48
_SLENDER = 45  # the size of a linkage over the radius of its bars
_THIN = 0.45  # pins and rods against bars
_LONG = 2.2  # of a sleeve to each side, in radii of a bar
_DISC = 0.8
_POST = 5.0  # radii of a bar from a bearing of the frame to its foot
_CONE = 0.75  # of the radius of the sphere, where a bevel wheel begins
_BALL = 1.7
_SAME = 1e-9


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
    first, last = start + profile[0, 0] * axis, start + profile[-1, 0] * axis
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


def round_solid(body: TurnedBody) -> Solid:
    """A round body with rounded edges and hollows on both sides, as a wheel with its tyre."""
    middle, axis = np.array(body.at), np.array(body.z) / np.linalg.norm(body.z)
    half, edge = body.length / 2 * axis, min(0.12 * body.radius, 0.3 * body.length)
    part = edge / body.length
    inner = 0.62 * body.radius
    profile = np.array(
        [
            [0.2, 0],
            [0.2, inner],
            [0, 1.06 * inner],
            [0, body.radius - edge],
            [0.3 * part, body.radius - 0.3 * edge],
            [part, body.radius],
            [1 - part, body.radius],
            [1 - 0.3 * part, body.radius - 0.3 * edge],
            [1, body.radius - edge],
            [1, 1.06 * inner],
            [0.8, inner],
            [0.8, 0],
        ]
    )
    return turned_solid(middle - half, middle + half, profile, 0.03, _SIDES_OF_WHEEL)


def ball_solid(middle: Reals, radius: float) -> Solid:
    """A ball."""
    angle = np.linspace(0, pi, _SIDES // 2 + 1)
    profile = np.stack([(1 - np.cos(angle)) / 2, radius * np.sin(angle)], axis=1)
    up = radius * np.array([0.0, 0.0, 1.0])
    return turned_solid(middle - up, middle + up, profile)


def box_solid(middle: Reals, axes: Reals, halves: tuple[float, float, float]) -> Solid:
    """A box along the columns of a rotation."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [each for a, b, c, d in faces for each in ((a, b, c), (a, c, d))]
    return Solid(middle + (signs * np.array(halves)) @ axes.T, np.array(triangles, np.intp))


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


def link_solids(
    linkage: SpatialLinkage, travels: Mapping[int, tuple[float, float]] | None = None
) -> dict[str, tuple[Solid, ...]]:
    """The bodies of every link in the reference pose.

    Args:
        linkage: in space or on the sphere, where the joints lie on a ball of the radius 1.
        travels: between which values sliding joints move, by number: their rods are so long.
    """
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    spherical = chain.space is Space.SPHERICAL
    radius = (1.0 if spherical else linkage.size) / _SLENDER
    solids: dict[str, list[Solid]] = {link: [] for link in chain.links}
    holds: dict[str, list[Reals]] = {link: [] for link in chain.links}
    bearings = _joint_places(linkage, radius)
    middle = np.mean(bearings, axis=0)
    at_frame = [at for at, joint in zip(bearings, chain.joints, strict=True) if frame in joint.links]
    ground = _upright(np.mean(at_frame, axis=0) - middle, 1.5 * _POST * radius) if at_frame else np.zeros(3)
    for number, joint in enumerate(chain.joints):
        at = bearings[number]
        ends = (travels or {}).get(number, (0.0, 0.0))
        outer = frame if frame in joint.links else joint.links[-1]
        for link in joint.links:
            hold = at
            if joint.pair.has_contours:
                wheel, hold = _wheel(linkage, number, joint.links.index(link), radius)
                solids[link].append(wheel)
            else:
                solids[link] += _symbol(linkage, number, at, radius, ends, outer=link == outer)
                if link == frame and not spherical:
                    solids[link] += _foot(linkage, number, at, radius, (ground, at - middle))
            holds[link].append(hold)
    for link, point in linkage.points.values():
        holds[link].append(np.array(point))
    for link, held in holds.items():
        if link == frame:
            continue
        plate = plate_solid(np.array(held), radius) if len(held) > 2 and not spherical else None
        if plate is not None:
            solids[link].append(plate)
            continue
        solids[link] += [
            cylinder_solid(a, b, radius, phase=0.05 * k)
            for k, (a, b) in enumerate(bars_between(np.array(held)), 1)
            if np.linalg.norm(b - a) > radius / 4
        ]
    for body in linkage.round_bodies.values():
        solids[body.link].append(round_solid(body))
    return {link: _distinct(each) for link, each in solids.items()}


def _distinct(solids: Sequence[Solid]) -> tuple[Solid, ...]:
    """Without a wheel that meshes twice."""
    return tuple({(np.round(each.vertices, 9) + 0.0).tobytes(): each for each in solids}.values())


def _joint_places(linkage: SpatialLinkage, r: float) -> list[Reals]:
    """Where the joints are; bearings at one place are shifted along their axes, which changes no motion."""
    spherical = linkage.mechanism.chain.space is Space.SPHERICAL
    places: list[Reals] = []
    for number, joint in enumerate(linkage.mechanism.chain.joints):
        frame = linkage.frames[number]
        z = frame[:3, 2] * (_side(linkage, number) if spherical else 1.0)
        at = z if spherical else frame[:3, 3]
        if joint.pair.is_turning:
            tried = [at + step * 2 * (_LONG + 1) * r * z for step in (0, 1, -1, 2, -2, 3, -3)]
            at = next((t for t in tried if all(np.linalg.norm(t - other) > _LONG * r for other in places)), at)
        places.append(at)
    return places


def _side(linkage: SpatialLinkage, number: int) -> float:
    """On which side of the sphere a bearing lies: where its wheel is."""
    chain = linkage.mechanism.chain
    own = set(chain.joints[number].links) - {linkage.mechanism.frame}
    near = [
        float(linkage.frames[k, :3, 2] @ linkage.frames[number, :3, 2])
        for k, joint in enumerate(chain.joints)
        if joint.pair.has_contours and own & set(joint.links)
    ]
    return -1.0 if near and sum(near) < -_SAME else 1.0


def _symbol(
    linkage: SpatialLinkage, number: int, at: Reals, r: float, ends: tuple[float, float], *, outer: bool
) -> Iterator[Solid]:
    """The sleeve, block, ball or fork of one link of a joint."""
    pair = linkage.mechanism.chain.joints[number].pair
    axes = linkage.frames[number, :3, :3]
    free = pair.freedoms[linkage.mechanism.chain.space]
    slides = [f.axis for f in free if f.travels or f.has_pitch]
    turns = [f.axis for f in free if f.turns]
    if pair.is_ball:
        yield ball_solid(at, _BALL * r if outer else 1.2 * r)
    elif pair.is_cross:
        arm = axes[:, 1 if outer else 0]
        yield cylinder_solid(at - 2.4 * r * arm, at + 2.4 * r * arm, _THIN * r)
    elif len(slides) == 1 and len(free) <= 2:
        axis = axes[:, "xyz".index(slides[0])]
        if not outer:
            low, high = ends  # the sleeve goes from low to high along the rod
            if free[0].has_pitch:  # up to the bearings of the screw on its axis
                along = [float((other[:3, 3] - at) @ axis) for other in linkage.frames]
                lines = [float(np.linalg.norm(np.cross(other[:3, 3] - at, axis))) for other in linkage.frames]
                on_axis = [t for t, off in zip(along, lines, strict=True) if off < r]
                yield _thread(
                    at + (min([low, *on_axis]) - 4 * r) * axis, at + (max([high, *on_axis]) + 4 * r) * axis, r
                )
            else:
                yield cylinder_solid(at + (low - 4 * r) * axis, at + (high + 4 * r) * axis, _THIN * r)
        elif turns:
            yield cylinder_solid(at - _LONG * r * axis, at + _LONG * r * axis, 1.3 * r)
        else:
            first = "xyz".index(slides[0])
            yield box_solid(at, axes[:, [first, (first + 1) % 3, (first + 2) % 3]], (_LONG * r, 1.4 * r, 1.4 * r))
    elif turns and not slides and len(free) == 1:
        axis = axes[:, "xyz".index(turns[0])]
        half, thick = (_LONG, 1.3) if outer else (_LONG + 1.2, 0.7)
        yield cylinder_solid(at - half * r * axis, at + half * r * axis, thick * r)
    else:
        yield box_solid(at, axes, (3 * r, 0.3 * r, 3 * r)) if outer else ball_solid(at, r)


def _thread(start: Reals, end: Reals, r: float) -> Solid:
    """A rod with grooves, as a thread is drawn from the side."""
    count = max(2, round(float(np.linalg.norm(end - start)) / (0.7 * r)))
    along = np.linspace(0, 1, 2 * count + 1)
    radii = np.where(np.arange(2 * count + 1) % 2, 1.25, 0.95) * r
    profile = np.concatenate([[[0, 0]], np.stack([along, radii], axis=1), [[1, 0]]])
    return turned_solid(start, end, profile)


def _upright(heading: Reals, least: float) -> Reals:
    """The heading along the axis along which it is longest; nothing if that is less than so much.

    >>> _upright(np.array([1.0, 0.0, -5.0]), 2.0).tolist()
    [0.0, 0.0, -5.0]
    """
    upright = np.zeros(3)
    most = int(np.argmax(np.round(abs(heading), 9)))
    if abs(heading[most]) > least:
        upright[most] = heading[most]
    return upright


def _foot(linkage: SpatialLinkage, number: int, at: Reals, r: float, headings: tuple[Reals, Reals]) -> Iterator[Solid]:
    """What a bearing of the frame stands on: a post across the bearing's axis, and a plate.

    The post goes where the frame lies as a whole, else away from the linkage.
    """
    pair = linkage.mechanism.chain.joints[number].pair
    axis = linkage.frames[number, :3, 0 if pair.guides and not any(f.turns for f in pair.motion) else 2]
    free = pair.is_ball or pair.is_cross
    tried = [*headings, -r * np.eye(3)[2], r * linkage.frames[number, :3, 0], r * linkage.frames[number, :3, 2]]
    across = [heading if free else heading - (heading @ axis) * axis for heading in tried]
    away = next(each for each in across if np.linalg.norm(each) > r / 2)
    away = away / np.linalg.norm(away)
    u = np.cross(away, np.eye(3)[int(np.argmin(np.round(abs(away), 6)))])
    u /= np.linalg.norm(u)
    foot = at + _POST * r * away
    yield cylinder_solid(at, foot, 0.8 * r, phase=0.02)
    yield box_solid(foot, np.stack([away, u, np.cross(away, u)], axis=1), (0.35 * r, 3.2 * r, 3.2 * r))


def _wheel(linkage: SpatialLinkage, number: int, index: int, r: float) -> tuple[Solid, Reals]:
    """The disc or cone of one body of a contact, and its middle."""
    place, frame = linkage.places[number], linkage.frames[number]
    assert place.radii is not None  # checked with the linkage
    radius, sign = place.radii[index], (-1.0, 1.0)[index]
    y, z = frame[:3, 1], frame[:3, 2]
    if linkage.mechanism.chain.space is Space.SPHERICAL:
        end = cos(radius) * (cos(radius) * z + sign * sin(radius) * y)
        return cylinder_solid(_CONE * end, end, _CONE * sin(radius), sin(radius), sides=_SIDES_OF_WHEEL), end
    at = frame[:3, 3]
    if not isfinite(radius):
        return box_solid(at + sign * _DISC * r * y, frame[:3, :3], (6 * r, _DISC * r, 2 * r)), at
    middle = at + sign * radius * y
    half = _DISC * r * z
    return cylinder_solid(middle - half, middle + half, max(abs(radius), r), sides=_SIDES_OF_WHEEL), middle


def bars_between(places: Reals) -> Iterator[tuple[Reals, Reals]]:
    """From the place in the middle of a link to all others: the one with the least sum of distances."""
    if len(places) > 1:
        distances = np.linalg.norm(places[:, None] - places[None], axis=2)
        middle = int(np.argmin(np.round(distances.sum(axis=1), 9)))
        yield from ((places[middle], place) for k, place in enumerate(places) if k != middle)
