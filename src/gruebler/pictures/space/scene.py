"""A linkage in space as parts in pixels: symbols of its joints, bars of its links, supports of its frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import acos, sin

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.crosses import crosses_of, put_apart
from gruebler.mechanics.space.sleeves import shaft_first, sleeve_travels
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, Shape
from gruebler.pictures.space.painting import painted_parts
from gruebler.pictures.space.parts import SpatialPart, across, ground_support, link_bar, points_on_paper, wheel
from gruebler.pictures.space.symbols import SOLIDS, SPHERE, PlacedJoint, SlidingRod, drive_arrow, held_cross
from gruebler.pictures.space.views import View
from gruebler.structure.chain.spaces import Space

_WIDE = 330.0  # pixels of the reference pose
_MANY = 10  # joints: with more of them a picture is larger, so that their symbols and letters have room
_APART = 32.0  # pixels between the symbols of two joints
_STEP = 42.0  # pixels by which a symbol is shifted along its axis
_SUPPORT = 26.0
_SHORT = 1.0  # pixels: shorter bars are left out
_FLAT = 1e-6  # of the extent: points nearer to a line lie on it
_INSIDE = 0.25  # of the farthest place from the middle: nearer ones lie inside a ring
_PLANE = 0.1  # of the extent: places that are no farther from a plane make a plate
_THICK = 6.0  # pixels of a disc
_PIECES = 24  # of the arc of a link on a sphere
_POINT = 2.6


@dataclass(frozen=True, eq=False, kw_only=True)
class SpatialScene:
    """Parts of a linkage in pixels about its middle, in the reference pose."""

    linkage: SpatialLinkage
    view: View
    scale: float
    """Pixels of a unit of length."""
    middle: Reals
    """The place that is the origin in pixels."""
    parts: tuple[SpatialPart, ...]
    rods: tuple[SlidingRod, ...]
    lines: tuple[tuple[str, str, Reals], ...]
    """Link, style and places of lines below everything: axes; or above: drives."""
    solids: tuple[str, ...]
    """The links that are shown as plates: with three joints or points and more in a plane."""
    outlines: Mapping[str, Reals]
    """The corners of each link, to which its name is put."""
    joints: Reals
    """The places of the joints' symbols; of a cross those of an eye of each fork."""

    def beside(self, link: str) -> Reals:
        """The places of a link to which its name is put: its corners, of a moving arc those about its middle."""
        corners, mechanism = self.outlines[link], self.linkage.mechanism
        is_arc = mechanism.chain.space is Space.SPHERICAL and link != mechanism.frame and len(corners) == 2
        if not (is_arc and corners.any()):  # both ends of a cross lie in the middle
            return corners
        arc = _arc(*corners)
        middle = len(arc) // 2
        return arc[middle - 2 : middle + 3] if middle > 1 else corners

    @property
    def frame_arc(self) -> Reals:
        """On the sphere the places from one of two joints of the frame to the other; elsewhere none."""
        mechanism = self.linkage.mechanism
        held = [k for k, joint in enumerate(mechanism.chain.joints) if mechanism.frame in joint.links]
        if mechanism.chain.space is not Space.SPHERICAL or len(held) != 2:
            return np.zeros((0, 3))
        return _arc(*self.joints[held])

    def placed(self, places: Reals, pose: Reals) -> Reals:
        """Places of a link on paper, after its rigid motion (4, 4) since the reference pose."""
        turn, shift = pose[:3, :3], pose[:3, 3]
        moved = places @ turn.T + self.scale * (turn @ self.middle + shift - self.middle)
        return self.view.on_paper(moved)

    def on_paper(self, place: Reals) -> Reals:
        """A place in the linkage's own lengths, on paper."""
        return self.view.on_paper(self.scale * (place - self.middle))

    def shapes(self, poses: Reals | None = None) -> list[Shape]:
        """Everything at a pose, (links, 4, 4); without one in the reference pose."""
        chain = self.linkage.mechanism.chain
        at = np.tile(np.eye(4), (chain.n, 1, 1)) if poses is None else poses

        def pose(link: str) -> Reals:
            return np.asarray(at[chain.index(link)])

        drawn = [
            Polylines((points_on_paper(self.placed(places, pose(link))),), style, closed=style == "head")
            for link, style, places in self.lines
        ]
        below = [shape for shape in drawn if shape.style == "pitch"]
        above = [shape for shape in drawn if shape.style != "pitch"]
        rods = [part for rod in self.rods for part in rod.parts(self._shift(rod, pose(rod.link), pose(rod.sleeve)))]
        solid = painted_parts([part.at(self.placed(part.points, pose(part.link))) for part in (*self.parts, *rods)])
        points = [
            CircleShape(points_on_paper(self.placed(self._point(at_), pose(link)))[0], _POINT, "dot")
            for link, at_ in self.linkage.points.values()
        ]
        bodies = [
            Polylines((points_on_paper(self.placed(self.outlines[link], pose(link))),), "solid", closed=True)
            for link in self.solids
        ]
        return [*bodies, *below, *solid, *above, *points]

    def _shift(self, rod: SlidingRod, shaft: Reals, sleeve: Reals) -> float:
        """How far the sleeve has gone along the rod."""
        at = np.append(rod.at / self.scale + self.middle, 1.0)
        moved = np.linalg.inv(shaft) @ (sleeve @ at) - at
        return float(self.scale * moved[:3] @ rod.axis)

    def _point(self, at: Sequence[float]) -> Reals:
        return self.scale * (np.array([at]) - self.middle)


def scene_of(linkage: SpatialLinkage, view: View, poses: Reals | None = None) -> SpatialScene:
    """The scene of a linkage that is seen in its reference pose and in these poses, (rows, links, 4, 4)."""
    spherical = linkage.mechanism.chain.space is Space.SPHERICAL
    if poses is None:
        poses = np.tile(np.eye(4), (1, linkage.mechanism.chain.n, 1, 1))
    scale, middle = _scaled(linkage, view, poses)
    joints = _drawn_joints(linkage, scale, middle, sleeve_travels(linkage, poses))
    held = {
        number: (cross, link) for cross in crosses_of(linkage) if cross.body for link, (number, _) in cross.arms.items()
    }
    symbols = [
        held_cross(joint, *held[number], scale * (held[number][0].at - middle))
        if number in held
        else SOLIDS[joint.pair.name](joint)
        for number, joint in enumerate(joints)
    ]
    parts = _distinct([part for symbol in symbols for part in symbol.parts])
    frame = linkage.mechanism.frame
    outlines, solids = {}, []
    for link in linkage.mechanism.chain.links:
        ends = [(s.holds[link], s.clear.get(link, 0.0)) for s in symbols if link in s.holds]
        if link == frame:
            supports = [_support(j, s.holds[frame]) for j, s in zip(joints, symbols, strict=True) if frame in s.holds]
            parts += supports
            outlines[link] = supports[0].points if supports else np.zeros((0, 3))
            continue
        ends += [(scale * (np.array(at) - middle), 0.0) for of, at in linkage.points.values() if of == link]
        order, spurs = _round_trip(np.array([place for place, _ in ends]))
        outlines[link] = np.array([ends[k][0] for k in dict.fromkeys(order)])
        disc = _disc(link, joints)
        if disc is not None:
            parts.append(disc)
            continue
        if order[0] == order[-1] and not spherical and _is_flat(outlines[link]):
            solids.append(link)
        for first, second in [*pairwise(order), *spurs]:
            parts += _bars(link, *ends[first], *ends[second], spherical)
    for body in linkage.round_bodies.values():
        at, z = scale * (np.array(body.at) - middle), np.array(body.z) / np.linalg.norm(body.z)
        half = scale * body.length / 2 * z
        parts.append(wheel(body.link, at - half, at + half, scale * body.radius))
    lines = [(joint.links[0], "pitch", np.array(s.axis)) for joint, s in zip(joints, symbols, strict=True) if s.axis]
    for number in {drive.joint for drive in linkage.mechanism.drives}:
        if joints[number].pair.motion[0].turns or not joints[number].pair.is_higher:
            line, head = drive_arrow(joints[number], view.sight)
            driven = joints[number].links[-1]
            lines += [(driven, "drive", line), (driven, "head", head)]
    return SpatialScene(
        linkage=linkage,
        view=view,
        scale=scale,
        middle=middle,
        rods=tuple(rod for symbol in symbols for rod in symbol.rods),
        parts=tuple(replace(part, fixed=part.link == frame) for part in parts),
        lines=tuple(lines),
        outlines=outlines,
        solids=tuple(solids),
        joints=np.array(
            [symbols[k].parts[-1].points.mean(axis=0) if k in held else joint.at for k, joint in enumerate(joints)]
        ),
    )


def _disc(link: str, joints: Sequence[PlacedJoint]) -> SpatialPart | None:
    """A disc for a link that turns on a journal and has three balls and more around it, such as a wobble plate."""
    own = [joint for joint in joints if link in joint.links]
    balls = [joint.at for joint in own if sum(freedom.turns for freedom in joint.pair.motion) == 3]
    journals = [j for j in own if j.pair.is_turning or (j.pair.guides and any(f.turns for f in j.pair.motion))]
    if len(journals) != 1 or len(balls) < 3 or len(own) > 1 + len(balls):
        return None
    at, z = journals[0].at, journals[0].axes[:, 2]
    away = np.array(balls) - at
    radius = float(np.linalg.norm(away, axis=1).max())
    if abs(away @ z).max() > _PLANE * radius:
        return None
    return wheel(link, at - _THICK / 2 * z, at + _THICK / 2 * z, radius)


def _is_flat(places: Reals) -> bool:
    """Whether places are about in a plane."""
    extents = np.linalg.svd(places - places.mean(axis=0), compute_uv=False)
    return bool(extents[-1] <= _PLANE * extents[0]) if len(places) > 3 else True


def _distinct(parts: Sequence[SpatialPart]) -> list[SpatialPart]:
    """Without a wheel that meshes twice."""
    kept: list[SpatialPart] = []
    for part in parts:
        same = [other for other in kept if other.look == part.look == "wheel" and other.link == part.link]
        if not any(np.allclose(other.points, part.points, rtol=0, atol=_SHORT) for other in same):
            kept.append(part)
    return kept


def _scaled(linkage: SpatialLinkage, view: View, poses: Reals) -> tuple[float, Reals]:
    """Pixels of a unit, and the middle."""
    chain = linkage.mechanism.chain
    if chain.space is Space.SPHERICAL:
        return SPHERE, np.zeros(3)
    on_links = [
        (link, place.at) for joint, place in zip(chain.joints, linkage.places, strict=True) for link in joint.links
    ]
    on_links += list(linkage.points.values())
    at = np.array([[*at, 1.0] for _, at in on_links])
    moved = np.einsum("rkij,kj->rki", poses[:, [chain.index(link) for link, _ in on_links]], at)
    seen = view.on_paper(np.concatenate([at, moved.reshape(-1, 4)])[:, :3])[:, :2]
    extent = float(np.ptp(seen, axis=0).max())
    wide = _WIDE * max(1.0, len(chain.joints) / _MANY) ** 0.5
    return wide / (extent if extent > _FLAT * linkage.size else linkage.size), linkage.centre


def _drawn_joints(
    linkage: SpatialLinkage, scale: float, middle: Reals, travels: Mapping[int, tuple[float, float]]
) -> list[PlacedJoint]:
    """The joints; those at one place are shifted along their axes, which changes no motion."""
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    spherical = chain.space is Space.SPHERICAL
    sides = _sides(linkage) if spherical else {}
    ats: list[Reals] = []
    for number, (joint, at_and_axes) in enumerate(zip(chain.joints, linkage.frames, strict=True)):
        z = at_and_axes[:3, 2]
        at = SPHERE * sides.get(number, 1.0) * z if spherical else scale * (at_and_axes[:3, 3] - middle)
        if joint.pair.motion[0].turns and joint.pair.motion[0].axis == "z" and not joint.pair.has_contours:
            outward = sides.get(number, 1.0) if spherical else 1.0
            tried = [at + step * _STEP * outward * z for step in (0, 1, -1, 2, -2, 3, -3)]
            free = (place for place in tried if all(np.linalg.norm(place - other) > _APART for other in ats))
            at = next(free, at)
        ats.append(at)
    for cross in crosses_of(linkage):
        put_apart(linkage, cross, ats, scale * (cross.at - middle))
    middles = {
        link: np.mean([ats[k] for k, joint in enumerate(chain.joints) if link in joint.links], axis=0)
        for link in chain.links
    }
    return [
        PlacedJoint(
            pair=joint.pair,
            links=shaft_first(joint, frame),
            at=ats[number],
            axes=linkage.frames[number, :3, :3],
            middles=middles,
            place=linkage.places[number],
            scale=scale,
            spherical=spherical,
            travel=(scale * travels[number][0], scale * travels[number][1]) if number in travels else (0.0, 0.0),
        )
        for number, joint in enumerate(chain.joints)
    ]


def _sides(linkage: SpatialLinkage) -> dict[int, float]:
    """On which side of the sphere each axis of a wheel is drawn: where its wheel is."""
    chain = linkage.mechanism.chain
    sides: dict[int, float] = {}
    for number, joint in enumerate(chain.joints):
        touched = [
            linkage.frames[k, :3, 2]
            for k, other in enumerate(chain.joints)
            if other.pair.has_contours and set(other.links) & set(joint.links) - {linkage.mechanism.frame}
        ]
        if touched and not joint.pair.has_contours:
            sides[number] = 1.0 if sum(float(t @ linkage.frames[number, :3, 2]) for t in touched) > -_FLAT else -1.0
    driven = {drive.joint for drive in linkage.mechanism.drives}
    axes = linkage.frames[:, :3, 2]
    for number in driven - set(sides):  # apart from the other drives about its axis
        others = sum(sides[k] * float(axes[k] @ axes[number]) for k in driven & set(sides))
        sides[number] = -1.0 if others > 1 - _FLAT else 1.0
    return sides


def _support(joint: PlacedJoint, hold: Reals) -> SpatialPart:
    """The ground of a joint, on the side away from the moving links."""
    frame = joint.links[-1]
    others = np.mean([middle for link, middle in joint.middles.items()], axis=0)
    heading = joint.at - others
    axis = joint.axes[:, 0] if joint.pair.guides and not any(f.turns for f in joint.pair.motion) else joint.axes[:, 2]
    if not joint.pair.is_ball:
        heading = heading - (heading @ axis) * axis
    size = float(np.linalg.norm(heading))
    down = np.array([0.0, 0.0, -1.0])
    if size < _APART / 4:
        heading = down if joint.pair.is_ball else down - (down @ axis) * axis
        size = float(np.linalg.norm(heading))
    if size < _FLAT:
        heading, size = across(axis)[0], 1.0
    return ground_support(frame, hold, hold + _SUPPORT * heading / size)


def _round_trip(places: Reals) -> tuple[list[int], list[tuple[int, int]]]:
    """Places in the order of the bars between them: there and back for two, in a ring around their middle for more.

    With it bars from places well inside the ring, which would bend it, to the nearest ones on it.
    """
    if len(places) < 3:
        return list(range(len(places))), []
    centred = places - places.mean(axis=0)
    axes = np.linalg.svd(centred)[2]
    x, y = centred @ axes[0], centred @ axes[1]
    if abs(y).max() < _FLAT * abs(x).max():
        return list(np.argsort(np.round(x, 6), kind="stable").tolist()), []
    reach = np.linalg.norm(centred, axis=1)
    inside = reach < _INSIDE * reach.max() if len(places) > 3 else np.zeros(len(places), bool)
    every = np.argsort(np.round(np.arctan2(y, x), 9), kind="stable").tolist()
    ring = [k for k in every if not inside[k]]
    spurs = [(k, min(ring, key=lambda n: float(np.linalg.norm(places[n] - places[k])))) for k in every if inside[k]]
    return [*ring, ring[0]], spurs


def _bars(link: str, start: Reals, clear: float, end: Reals, other: float, spherical: bool) -> list[SpatialPart]:
    """Bars from place to place, on a sphere along a great circle; they begin outside of the joints."""
    if np.linalg.norm(end - start) < _SHORT:
        return []
    places = _arc(start, end) if spherical else np.array([start, end])
    lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
    if lengths.sum() < clear + other + _SHORT:
        return []
    places[0] += min(clear, 0.9 * lengths[0]) * (places[1] - places[0]) / lengths[0]
    places[-1] -= min(other, 0.9 * lengths[-1]) * (places[-1] - places[-2]) / lengths[-1]
    pieces = [link_bar(link, a, b) for a, b in pairwise(places)]
    last = len(pieces) - 1
    return [replace(piece, cut=(k > 0, k < last)) for k, piece in enumerate(pieces)]


def _arc(start: Reals, end: Reals) -> Reals:
    """Places from start to end whose directions go along a great circle."""
    a, b = float(np.linalg.norm(start)), float(np.linalg.norm(end))
    u, v = start / a, end / b
    angle = acos(max(-1.0, min(1.0, float(u @ v))))
    parts = np.linspace(0, 1, _PIECES + 1)[:, None]
    if not 1e-3 < angle < 3.1:
        return np.array([start, end])
    directions = (np.sin((1 - parts) * angle) * u + np.sin(parts * angle) * v) / sin(angle)
    return np.asarray((a + parts * (b - a)) * directions)
