"""Links of a linkage in space as closed bodies of triangles: bars between joints, pins in sleeves, forks, balls.

The sizes of the bodies are chosen here; places and axes are those of the joints in the reference pose. A body of a
link may run into another one of the same link, as a bar into its sleeve. docs/theory/formats.md has the rules.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import acos, cos, isfinite, pi, sin

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.files.solids import (
    SIDES_OF_WHEEL,
    Solid,
    ball_solid,
    bent_solid,
    bevel_solid,
    box_solid,
    cylinder_solid,
    hull_solid,
    plate_solid,
    threaded_solid,
    turned_solid,
)
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.crosses import UniversalCross, crosses_of, put_apart
from gruebler.mechanics.screws.round_bodies import TurnedBody
from gruebler.structure.chain.spaces import Space

_SLENDER = 45  # the size of a linkage over the radius of its bars
_THIN = 0.45  # pins and rods against bars
_BARREL, _ROD = 1.25, 0.6  # of a cylinder and its piston rod, in radii of a bar
_LONG = 2.2  # of a sleeve to each side, in radii of a bar
_DISC = 0.8
_POST = 5.0  # radii of a bar from a bearing of the frame to its foot
_CONE = 0.75  # of the radius of the sphere, where a bevel wheel begins
_TEETH = 24  # of the first bevel wheel
_BALL = 1.7
_FORK, _SMALL_FORK = 5.0, 3.6  # radii of a bar from the middle of a cross to its forks, small without a body of its own
_STOUT = 2.0  # a universal joint on the sphere against other linkages
_FINEST = 1.0  # lead of a thread that is seen, in radii of a bar
_PIECES = 24  # of a half circle
_PAIR = 2  # feet between which a bar may lie
_ALIKE = 0.5  # of a cosine: ways to the ground that are as near to one line lead to one ground, or to two face to face
_SAME = 1e-9


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
    return turned_solid(middle - half, middle + half, profile, 0.03, SIDES_OF_WHEEL)


def link_solids(
    linkage: SpatialLinkage,
    travels: Mapping[int, tuple[float, float]] | None = None,
    planes: Mapping[int, Reals] | None = None,
) -> dict[str, tuple[Solid, ...]]:
    """The bodies of every link in the reference pose.

    Args:
        linkage: in space or on the sphere, where the joints lie on a ball of the radius 1.
        travels: between which values sliding joints move, by number: their rods are so long.
        planes: least and most along the axes of joints that slide on a plane, (2, 3): it is so large.
    """
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    spherical = chain.space is Space.SPHERICAL
    crosses = crosses_of(linkage)
    radius = (_STOUT if crosses and spherical else 1.0 if spherical else linkage.size) / _SLENDER
    solids: dict[str, list[Solid]] = {link: [] for link in chain.links}
    holds: dict[str, list[Reals]] = {link: [] for link in chain.links}
    ways: list[Reals] = []  # to the ground
    bearings = _joint_places(linkage, radius, crosses)
    middle = np.mean(bearings, axis=0)
    wheeled = spherical and any(joint.pair.has_contours for joint in chain.joints)
    at_frame = [at for at, joint in zip(bearings, chain.joints, strict=True) if frame in joint.links]
    ground = _upright(np.mean(at_frame, axis=0) - middle, 1.5 * _POST * radius) if at_frame else np.zeros(3)
    gears = _bevel_gears(linkage) if spherical else {}
    struts = _struts(linkage, radius, travels or {})
    for number, joint in enumerate(chain.joints):
        at = bearings[number]
        ends = (travels or {}).get(number, (0.0, 0.0))
        outer = frame if frame in joint.links else joint.links[-1]
        for link in joint.links if number not in struts else ():
            hold = at
            cross = next((each for each in crosses if each.holds(number, link)), None)
            away = (
                None
                if link != frame or joint.pair.has_contours or (wheeled and not _is_outermost(at, at_frame))
                else at / np.linalg.norm(at)  # beyond all that goes round the axis
                if wheeled
                else _away(linkage, number, radius, () if spherical else (ground, at - middle))
            )
            if joint.pair.has_contours:
                index = joint.links.index(link)
                wheel, hold = _wheel(linkage, number, index, radius, gears.get((number, index)))
                solids[link] += wheel
            elif cross is not None and link != cross.body:
                heading = _mean(linkage, link, number, bearings) - cross.at if away is None else away
                fork, hold = _fork(cross, link, heading, radius)
                solids[link] += fork
            elif cross is None:
                plane = (planes or {}).get(number, np.zeros((2, 3)))
                solids[link] += _symbol(linkage, number, at, radius, ends, plane, outer=link == outer)
            holds[link].append(hold)
            if away is not None:
                solids[link] += _foot(hold, at + (_reach(cross, radius) * away if cross else 0.0), away, radius)
                ways.append(away)
    for cross in crosses:
        solids[cross.body or list(cross.arms)[-1]] += _spider(cross, radius)
    for number, strut in struts.items():
        barrel, piston = chain.joints[number].links
        if not strut.fits:  # it slides on a rod
            ends = (travels or {}).get(number, (0.0, 0.0))
            solids[barrel] += _symbol(linkage, number, bearings[number], radius, ends, np.zeros((2, 3)), outer=False)
        solids[barrel] += _barrel(strut, holds[barrel][0], radius)
        solids[piston].append(cylinder_solid(strut.rod, strut.end, _ROD * radius))
    for link, held in holds.items():
        if link != frame and all(link != cross.body for cross in crosses):
            solids[link] += _between(linkage, link, held, radius)
    solids[frame][:0] = _between_feet(holds[frame], ways, radius)
    for body in linkage.round_bodies.values():
        solids[body.link].append(round_solid(body))
    return {link: _distinct(each) for link, each in solids.items()}


@dataclass(frozen=True, eq=False, slots=True)
class _Strut:
    """A cylinder and its piston rod."""

    rod: Reals
    """Where the rod begins, in the barrel."""
    gland: Reals
    """Where it comes out of the barrel."""
    end: Reals
    fits: bool
    """Whether all of its travel lies within the barrel."""


def _struts(linkage: SpatialLinkage, r: float, travels: Mapping[int, tuple[float, float]]) -> dict[int, _Strut]:
    """Sliding joints of a cylinder, their first link, and a piston rod, with one more joint on each of its sides."""
    chain = linkage.mechanism.chain
    struts = {}
    for number, joint in enumerate(chain.joints):
        free = joint.pair.freedoms[chain.space]
        slides = [f.axis for f in free if f.travels and not f.has_pitch]
        ends = [
            [frame[:3, 3] for k, frame in enumerate(linkage.frames) if k != number and link in chain.joints[k].links]
            for link in joint.links
        ]
        if len(slides) != 1 or len(free) > 2 or linkage.mechanism.frame in joint.links or [*map(len, ends)] != [1, 1]:
            continue
        at = linkage.frames[number, :3, 3]
        axis = linkage.frames[number, :3, "xyz".index(slides[0])]
        (bottom, end), low_high = (float((each - at) @ axis) for (each,) in ends), travels.get(number, (0.0, 0.0))
        side = 1.0 if end > bottom else -1.0
        low, high = sorted(side * each for each in low_high)
        gland = side * end + low - 3 * r
        rod = gland - high - r
        on_axis = all(np.linalg.norm(np.cross(each - at, axis)) < r for (each,) in ends)
        if on_axis and bottom * end < 0:
            fits = rod + low > side * bottom + 2 * r
            rod, gland = (rod, gland) if fits else (-3 * r, 0.0)
            struts[number] = _Strut(at + side * rod * axis, at + side * gland * axis, at + end * axis, fits)
    return struts


def _barrel(strut: _Strut, hold: Reals, r: float) -> list[Solid]:
    """A cylinder from where it is held to its gland, and the ring there."""
    axis = (strut.end - strut.gland) / np.linalg.norm(strut.end - strut.gland)
    bottom = strut.gland + (hold - strut.gland) @ axis * axis
    inner, outside = strut.gland - 1.5 * r * axis, strut.gland + 0.2 * r * axis
    return [
        cylinder_solid(bottom, strut.gland, _BARREL * r),
        cylinder_solid(inner, outside, 1.2 * _BARREL * r),
    ]


def _between_feet(held: Sequence[Reals], ways: Sequence[Reals], r: float) -> list[Solid]:
    """A bar that joins two bearings of the frame which stand on no common ground: neither on a plane nor face to face.

    >>> sideways, down = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    >>> places = [np.zeros(3), np.array([0.0, 9.0, 0.0])]
    >>> [len(_between_feet(places, ways, 1.0)) for ways in ((sideways, down), (down, down), (sideways, -sideways))]
    [1, 0, 0]
    """
    return _bars(held, [], r, False) if len(ways) == _PAIR and abs(ways[0] @ ways[1]) < _ALIKE else []


def _between(linkage: SpatialLinkage, link: str, held: Sequence[Reals], r: float) -> list[Solid]:
    """What joins the joints and points of a link, but for those on a rim, to which its body leads."""
    rims = [body for body in linkage.round_bodies.values() if body.link == link]
    points = [np.array(at) for of, at in linkage.points.values() if of == link]
    joints, named = ([at for at in each if not any(_on_rim(at, rim) for rim in rims)] for each in (held, points))
    return _bars(joints, named, r, linkage.mechanism.chain.space is Space.SPHERICAL)


def _bars(joints: Sequence[Reals], points: Sequence[Reals], r: float, spherical: bool) -> list[Solid]:
    """What joins the joints and points of a link: a plate, a body from which bars go to points, or bars.

    On a sphere they are arcs about its middle.
    """
    held = np.array([*joints, *points])
    if len(held) > 2 and not spherical:
        plate = plate_solid(held, r)
        if plate is not None:
            return [plate]
        if len(joints) > 2:
            places = np.array(joints)
            body = plate_solid(places, r) or (hull_solid(places, r) if len(joints) > 3 else None)
            if body is not None:
                middle = places.mean(axis=0)
                return [body, *(cylinder_solid(middle, at, r, phase=0.05 * k) for k, at in enumerate(points, 1))]
    bars = []
    for k, (a, b) in enumerate(bars_between(held), 1):
        if np.linalg.norm(b - a) <= r / 4:
            continue
        arc = _arc(a, b) if spherical else None
        bars.append(cylinder_solid(a, b, r, phase=0.05 * k) if arc is None else bent_solid(arc, r, phase=0.05 * k))
    return bars


def _on_rim(at: Reals, body: TurnedBody) -> bool:
    """Whether a place lies on the outside of a round body, as the contact of a tyre: the body itself leads to it."""
    away = at - np.array(body.at)
    axis = np.array(body.z) / np.linalg.norm(body.z)
    along = float(away @ axis)
    return abs(along) <= body.length / 2 and 0.9 < float(np.linalg.norm(away - along * axis)) / body.radius < 1.1


def _distinct(solids: Sequence[Solid]) -> tuple[Solid, ...]:
    """Without a wheel that meshes twice."""
    return tuple({(np.round(each.vertices, 9) + 0.0).tobytes(): each for each in solids}.values())


def _joint_places(linkage: SpatialLinkage, r: float, crosses: Sequence[UniversalCross]) -> list[Reals]:
    """Where the joints are; bearings at one place are shifted along their axes, which changes no motion.

    They keep clear of forks, and the shafts of a cross lie on both sides of it.
    """
    spherical = linkage.mechanism.chain.space is Space.SPHERICAL
    places: list[Reals] = []
    for number, joint in enumerate(linkage.mechanism.chain.joints):
        frame = linkage.frames[number]
        z = frame[:3, 2] * (_side(linkage, number) if spherical else 1.0)
        at = z if spherical else frame[:3, 3]
        if joint.pair.is_turning:
            tried = [at + step * 2 * (_LONG + 1) * r * z for step in (0, 1, -1, 2, -2, 3, -3)]
            free = [t for t in tried if all(np.linalg.norm(t - other) > _LONG * r for other in places)]
            clear = [t for t in free if all(np.linalg.norm(t - c.at) > _reach(c, r) + 2 * _LONG * r for c in crosses)]
            at = [*clear, *free, at][0]
        places.append(at)
    for cross in crosses:
        put_apart(linkage, cross, places, cross.at)
    return places


def _mean(linkage: SpatialLinkage, link: str, number: int, bearings: Sequence[Reals]) -> Reals:
    """The middle of the other joints of a link."""
    joints = linkage.mechanism.chain.joints
    others = [at for k, at in enumerate(bearings) if link in joints[k].links and k != number]
    return np.asarray(np.mean(others or [bearings[number]], axis=0))


def _reach(cross: UniversalCross, r: float) -> float:
    """From the middle of a cross to the forks that hold it."""
    return (_FORK if cross.body else _SMALL_FORK) * r


def _fork(cross: UniversalCross, link: str, heading: Reals, r: float) -> tuple[list[Solid], Reals]:
    """Half a ring with two eyes about the arm of a cross, and where the link goes on from it."""
    arm = cross.arms[link][1]
    heading = heading - (heading @ arm) * arm
    size = float(np.linalg.norm(heading))
    other = next(axis for of, (_, axis) in cross.arms.items() if of != link)
    heading = heading / size if size > r / 4 else other
    turn = pi * np.linspace(0, 1, _PIECES + 1)[:, None]
    reach = _reach(cross, r)
    ring = cross.at + reach * (np.cos(turn) * arm + np.sin(turn) * heading)
    eyes = [cylinder_solid(end - 1.2 * r * arm, end + 1.2 * r * arm, 1.7 * r, phase=0.1) for end in (ring[0], ring[-1])]
    return [bent_solid(ring, 1.1 * r, phase=0.07), *eyes], cross.at + reach * heading


def _spider(cross: UniversalCross, r: float) -> list[Solid]:
    """The two arms of a cross and the hub in which they meet."""
    far = _reach(cross, r) + 1.6 * r
    arms = [
        cylinder_solid(cross.at - far * arm, cross.at + far * arm, 0.9 * r, phase=0.03 * k)
        for k, (_, arm) in enumerate(cross.arms.values(), 1)
    ]
    return [*arms, ball_solid(cross.at, 1.9 * r)]


def _arc(start: Reals, end: Reals) -> Reals | None:
    """Places from one to another whose directions from the origin go along a great circle, if it is a single one."""
    a, b = float(np.linalg.norm(start)), float(np.linalg.norm(end))
    angle = acos(max(-1.0, min(1.0, float(start @ end) / (a * b))))
    if not 1e-3 < angle < pi - 1e-3:
        return None
    part = np.linspace(0, 1, _PIECES + 1)[:, None]
    directions = (np.sin((1 - part) * angle) * start / a + np.sin(part * angle) * end / b) / sin(angle)
    return np.asarray((a + part * (b - a)) * directions)


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
    linkage: SpatialLinkage, number: int, at: Reals, r: float, ends: tuple[float, float], plane: Reals, *, outer: bool
) -> Iterator[Solid]:
    """The sleeve, block, ball or fork of one link of a joint."""
    pair = linkage.mechanism.chain.joints[number].pair
    axes = linkage.frames[number, :3, :3]
    free = pair.freedoms[linkage.mechanism.chain.space]
    slides = [f.axis for f in free if f.travels or f.has_pitch]
    turns = [f.axis for f in free if f.turns]
    if pair.is_ball:
        yield ball_solid(at, _BALL * r if outer else 1.2 * r)
    elif len(slides) == 1 and len(free) <= 2:
        axis = axes[:, "xyz".index(slides[0])]
        if not outer:
            low, high = ends  # the sleeve goes from low to high along the rod
            if free[0].has_pitch:  # up to the bearings of the screw on its axis
                along = [float((other[:3, 3] - at) @ axis) for other in linkage.frames]
                lines = [float(np.linalg.norm(np.cross(other[:3, 3] - at, axis))) for other in linkage.frames]
                on_axis = [t for t, off in zip(along, lines, strict=True) if off < r]
                start, end = min([low, *on_axis]) - 4 * r, max([high, *on_axis]) + 4 * r
                lead = 2 * pi * linkage.places[number].pitch or r  # without a pitch it only turns
                yield _thread(at + start * axis, at + end * axis, r, lead)
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
        half = np.array([3, 0.3, 3]) * r + np.ptp(plane, axis=0) / 2
        yield box_solid(at + axes @ plane.mean(axis=0), axes, half) if outer else ball_solid(at, r)


def _thread(start: Reals, end: Reals, r: float, lead: float) -> Solid:
    """A threaded rod; a thread too fine to be seen is drawn with a multiple of its lead."""
    seen = lead * max(1, round(_FINEST * r / abs(lead)))
    return threaded_solid(start, end, 0.75 * r, 1.3 * r, seen)


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


def _away(linkage: SpatialLinkage, number: int, r: float, headings: Sequence[Reals]) -> Reals:
    """Where the ground of a bearing of the frame lies, across the bearing's axis.

    The way goes where the frame lies as a whole, else away from the linkage.
    """
    pair = linkage.mechanism.chain.joints[number].pair
    axis = linkage.frames[number, :3, 0 if pair.guides and not any(f.turns for f in pair.motion) else 2]
    free = pair.is_ball or pair.is_cross
    tried = [*headings, -r * np.eye(3)[2], r * linkage.frames[number, :3, 0], r * linkage.frames[number, :3, 2]]
    across = [heading if free else heading - (heading @ axis) * axis for heading in tried]
    away = next(each for each in across if np.linalg.norm(each) > r / 2)
    return np.asarray(away / np.linalg.norm(away))


def _is_outermost(at: Reals, others: Sequence[Reals]) -> bool:
    """Whether no other bearing lies farther out on the ray from the middle of the sphere.

    >>> _is_outermost(np.array([1.0, 0.0, 0.0]), [np.array([-2.0, 0.0, 0.0]), np.array([1.2, 0.0, 0.0])])
    False
    """
    far = float(np.linalg.norm(at))
    on_ray = [other for other in others if other @ at > 0 and np.linalg.norm(np.cross(at, other)) < _SAME]
    return all(float(np.linalg.norm(other)) <= far + _SAME for other in on_ray)


def _foot(at: Reals, level: Reals, away: Reals, r: float) -> Iterator[Solid]:
    """What a bearing of the frame stands on: a post from where it is held, and a plate so far from a level."""
    u = np.cross(away, np.eye(3)[int(np.argmin(np.round(abs(away), 6)))])
    u /= np.linalg.norm(u)
    foot = at + ((level - at) @ away + _POST * r) * away
    yield cylinder_solid(at, foot, 0.8 * r, phase=0.02)
    yield box_solid(foot, np.stack([away, u, np.cross(away, u)], axis=1), (0.35 * r, 3.2 * r, 3.2 * r))


def _bevel_axis(linkage: SpatialLinkage, number: int, index: int) -> tuple[Reals, float]:
    """The axis of a body of a contact on the sphere and the angle of its cone."""
    place, frame = linkage.places[number], linkage.frames[number]
    assert place.radii is not None  # checked with the linkage
    cone, sign = place.radii[index], (-1.0, 1.0)[index]
    return cos(cone) * frame[:3, 2] + sign * sin(cone) * frame[:3, 1], cone


def _bevel_gears(linkage: SpatialLinkage) -> dict[tuple[int, int], Solid]:
    """The toothed wheel of each body of a contact, by joint and body: teeth meet gaps, in even numbers.

    A wheel that meshes twice is the same solid.
    """
    wheels: dict[tuple[str, tuple[float, ...]], tuple[Solid, int, Reals]] = {}
    gears = {}
    for number, joint in enumerate(linkage.mechanism.chain.joints):
        if not joint.pair.has_contours:
            continue
        z = linkage.frames[number, :3, 2]
        gap, pitch = True, 0.0
        for index, link in enumerate(joint.links):
            axis, cone = _bevel_axis(linkage, number, index)
            outward = (z - cos(cone) * axis) / sin(cone)
            key = (link, tuple(np.round(axis, 6) + 0.0))
            if key not in wheels:
                teeth = max(8, 2 * round(pi * sin(cone) / pitch)) if pitch else _TEETH
                half = pi / teeth if gap and index else 0.0
                tooth = cos(half) * outward + sin(half) * np.cross(axis, outward)
                wheels[key] = bevel_solid(axis, tooth, cone, teeth, _CONE), teeth, tooth
            solid, teeth, tooth = wheels[key]
            pitch = 2 * pi * sin(cone) / teeth
            part = acos(max(-1.0, min(1.0, float(tooth @ outward)))) * teeth / (2 * pi)
            gap = abs(part - round(part)) < 0.25  # where this one has a tooth
            gears[number, index] = solid
    return gears


def _wheel(linkage: SpatialLinkage, number: int, index: int, r: float, gear: Solid | None) -> tuple[list[Solid], Reals]:
    """The disc of one body of a contact, or its bevel gear, with ribs that show how it turns, and its middle."""
    place, frame = linkage.places[number], linkage.frames[number]
    assert place.radii is not None  # checked with the linkage
    radius, sign = place.radii[index], (-1.0, 1.0)[index]
    y, z = frame[:3, 1], frame[:3, 2]
    if gear is not None:
        axis, cone = _bevel_axis(linkage, number, index)
        end = cos(cone) * axis
        return [gear, *_ribs(end, axis, 0.9 * sin(cone), r)], end
    at = frame[:3, 3]
    if not isfinite(radius):
        return [box_solid(at + sign * _DISC * r * y, frame[:3, :3], (6 * r, _DISC * r, 2 * r))], at
    middle = at + sign * radius * y
    half = _DISC * r * z
    disc = cylinder_solid(middle - half, middle + half, max(abs(radius), r), sides=SIDES_OF_WHEEL)
    return [disc, *_ribs(middle + half, z, abs(radius), r)], middle


def _ribs(middle: Reals, axis: Reals, radius: float, r: float) -> Iterator[Solid]:
    """On the face of a wheel, from near its middle to near its rim."""
    if radius < 6 * r:
        return
    u = np.cross(axis, np.eye(3)[int(np.argmin(np.round(abs(axis), 6)))])
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    for turn in 2 * pi * np.arange(3) / 3:
        outward, aside = cos(turn) * u + sin(turn) * v, cos(turn) * v - sin(turn) * u
        axes = np.stack([outward, aside, axis], axis=1)
        yield box_solid(middle + 0.55 * radius * outward, axes, (0.33 * radius, 0.7 * r, 0.5 * r))


def bars_between(places: Reals) -> Iterator[tuple[Reals, Reals]]:
    """From the place in the middle of a link to all others: the one with the least sum of distances."""
    if len(places) > 1:
        distances = np.linalg.norm(places[:, None] - places[None], axis=2)
        middle = int(np.argmin(np.round(distances.sum(axis=1), 9)))
        yield from ((places[middle], place) for k, place in enumerate(places) if k != middle)
