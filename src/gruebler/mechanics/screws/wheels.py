"""Wheels on a common carrier: how their turns go together, as a row that is linear in the values of their bearings.

Pitch circles (on a sphere pitch cones) roll on each other: r₁ α + r₂ β = 0 for the turns against the carrier, α about
the axis of the first wheel and β about that of the second, on the sphere with the sines of the cones' angles. In space
the axes lie anywhere (spur, bevel, worm, hypoid gears), and the weights are the speeds of the teeth along the contact's
x axis.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import product
from math import sin
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.machines.gears import Mesh, Train
from gruebler.machines.gears.train import FRAME
from gruebler.mechanics.screws.closing_rows import WheelAxes
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space

_TEETH = 1000  # ratios of whole numbers up to this one are found again in radii
_RATIO = 1e-9  # by how much the ratio of radii may miss that of speeds
_SAME = 1e-9  # sizes and cosines: axes that differ by more are not those of the wheels


class GearRow(NamedTuple):
    """A sum of weights times the values of turning joints that stays 0."""

    joint: int
    turns: tuple[tuple[int, float], ...]


def is_gear(linkage: SpatialLinkage, joint: int) -> bool:
    """Whether a joint is the contact of two wheels that do not slip."""
    pair, place = linkage.mechanism.chain.joints[joint].pair, linkage.places[joint]
    return pair.has_contours and (pair.rolls or place.pressure is not None)


def gear_rows(linkage: SpatialLinkage) -> tuple[GearRow, ...]:
    """A row for each contact of wheels; `LinkageError` for wheels without a common carrier, and for sliding cones."""
    chain = linkage.mechanism.chain
    rows = []
    for number, joint in enumerate(chain.joints):
        if not joint.pair.has_contours:
            continue
        title = chain.joint_title(number)
        if not is_gear(linkage, number):
            if chain.space is not Space.SPHERICAL:
                continue
            raise LinkageError(
                "{joint}: cones that slide on each other are not moved on a sphere; wheels need the pressure angle of "
                "their teeth",
                joint=title,
            )
        bearings = (_bearings_in_space if chain.space is Space.SPATIAL else _bearings)(linkage, number)
        if not bearings:
            raise LinkageError(
                "{joint}: no link carries the axes of both wheels, directly or by joints on the same axes", joint=title
            )
        rows.append(GearRow(number, bearings))
    return tuple(rows)


def _bearings(linkage: SpatialLinkage, contact: int) -> tuple[tuple[int, float], ...]:
    """The turning joints between both wheels and their carrier, with their weights; none without a carrier."""
    chain, place = linkage.mechanism.chain, linkage.places[contact]
    assert place.radii is not None  # checked with the linkage
    radii = [sin(r) if chain.space is Space.SPHERICAL else r / linkage.size for r in place.radii]
    if not np.isfinite(radii).all():
        return ()
    ways = [
        _coaxial_ways(linkage, wheel, axis, radius)
        for wheel, axis, radius in zip(chain.joints[contact].links, _axes(linkage, contact), radii, strict=True)
    ]
    arms = [arm for arm in ways[0] if arm in ways[1]]
    if not arms:
        return ()
    arm = min(arms, key=lambda link: len(ways[0][link]) + len(ways[1][link]))
    return (*ways[0][arm], *ways[1][arm])


def _bearings_in_space(linkage: SpatialLinkage, contact: int) -> tuple[tuple[int, float], ...]:
    """The same for axes that lie anywhere."""
    pair = _mesh(linkage, contact)
    return () if pair is None else pair.turns


class WheelPair(NamedTuple):
    """Two wheels in space: their axes (point, direction) in the contact's frame, speeds of teeth, turns of bearings."""

    axes: tuple[Reals, Reals]
    speeds: tuple[float, float]
    turns: tuple[tuple[int, float], ...]


def mesh_row(linkage: SpatialLinkage, contact: int, scale: float) -> WheelAxes | None:
    """The axes and speeds of a contact of teeth in space, in lengths of a scale.

    None for other contacts, and for wheels in a plane whose axes lie where those of circles with these radii do.
    """
    if linkage.mechanism.chain.space is not Space.SPATIAL or not is_gear(linkage, contact):
        return None
    pair = _mesh(linkage, contact)
    if pair is None or _as_in_plane(linkage, contact, pair):
        return None
    points = [axis * np.array([[1 / scale], [1.0]]) for axis in pair.axes]
    return WheelAxes(points[0], points[1], pair.speeds[0] / scale, pair.speeds[1] / scale)


def _as_in_plane(linkage: SpatialLinkage, contact: int, pair: WheelPair) -> bool:
    radii = linkage.places[contact].radii
    assert radii is not None
    along = all(np.hypot(*axis[1, :2]) < _SAME for axis in pair.axes)
    wanted = np.array([[0.0, -radii[0]], [0.0, radii[1]]])
    points = np.array([axis[0, :2] for axis in pair.axes])
    return along and bool(abs(points - wanted).max() < _SAME * linkage.size)


def _mesh(linkage: SpatialLinkage, contact: int) -> WheelPair | None:
    """The wheels of a contact on a common carrier: what both teeth do along its x axis is the same.

    Raises `LinkageError` for radii in another ratio.
    """
    chain, frame = linkage.mechanism.chain, linkage.frames[contact]
    radii = linkage.places[contact].radii
    assert radii is not None  # checked with the linkage
    wheels = chain.joints[contact].links
    best: WheelPair | None = None
    for first, second in product(_axes_of(linkage, wheels[0]), _axes_of(linkage, wheels[1])):
        ways = _coaxial_ways(linkage, wheels[0], first, 1.0), _coaxial_ways(linkage, wheels[1], second, 1.0)
        speeds = [float(frame[:3, 0] @ np.cross(axis[1], frame[:3, 3] - axis[0])) for axis in (first, second)]
        for arm in (arm for arm in ways[0] if arm in ways[1]):
            turns = [(joint, weight * speeds[0] / linkage.size) for joint, weight in ways[0][arm]]
            turns += [(joint, -weight * speeds[1] / linkage.size) for joint, weight in ways[1][arm]]
            if best is None or len(turns) < len(best.turns):
                seen = [(axis - np.array([frame[:3, 3], [0, 0, 0]])) @ frame[:3, :3] for axis in (first, second)]
                best = WheelPair((seen[0], seen[1]), (speeds[0], speeds[1]), tuple(turns))
    if best is None:
        return None
    first_speed, second_speed = best.speeds
    if (
        abs(abs(first_speed * radii[1]) - abs(second_speed * radii[0])) > _RATIO * abs(second_speed * radii[0])
        or not first_speed * second_speed
    ):
        raise LinkageError(
            "{joint}: the radii {first:g} and {second:g} are not in the ratio of {one:.6g} and {other:.6g}, the speeds "
            "of teeth at the contact along its x axis",
            joint=chain.joint_title(contact),
            first=radii[0],
            second=radii[1],
            one=abs(first_speed),
            other=abs(second_speed),
        )
    return best


def _axes_of(linkage: SpatialLinkage, wheel: str) -> list[Reals]:
    """The axes about which a wheel turns, point and direction (2, 3)."""
    joints = enumerate(linkage.mechanism.chain.joints)
    frames = [linkage.frames[k] for k, joint in joints if joint.pair.is_turning and wheel in joint.links]
    return [np.array([frame[:3, 3], frame[:3, 2]]) for frame in frames]


def _coaxial_ways(
    linkage: SpatialLinkage, wheel: str, axis: Reals, weight: float
) -> dict[str, tuple[tuple[int, float], ...]]:
    """For each link that joints on the axis of a wheel lead to: their numbers, weighted by the turn against it."""
    chain = linkage.mechanism.chain
    along = {k: _along(linkage, k, axis) for k, joint in enumerate(chain.joints) if joint.pair.is_turning}
    ways: dict[str, tuple[tuple[int, float], ...]] = {wheel: ()}
    reached = [wheel]
    for link in reached:
        for k, joint in enumerate(chain.joints):
            if not along.get(k) or link not in joint.links or len(joint.links) != 2:
                continue
            other = joint.links[joint.links[0] == link]
            if other not in ways:
                ways[other] = (*ways[link], (k, weight * along[k] * (1.0 if joint.links[1] == link else -1.0)))
                reached.append(other)
    del ways[wheel]
    return ways


def _axes(linkage: SpatialLinkage, contact: int) -> tuple[Reals, Reals]:
    """Point and direction (2, 3) of each wheel's axis in the reference pose; on a sphere all meet in its centre."""
    frame, radii = linkage.frames[contact], linkage.places[contact].radii
    assert radii is not None
    y, z = frame[:3, 1], frame[:3, 2]
    if linkage.mechanism.chain.space is Space.SPHERICAL:
        directions = z * np.cos(radii[0]) - y * np.sin(radii[0]), z * np.cos(radii[1]) + y * np.sin(radii[1])
        return np.array([0 * z, directions[0]]), np.array([0 * z, directions[1]])
    at = frame[:3, 3]
    return np.array([at - radii[0] * y, z]), np.array([at + radii[1] * y, z])


def _along(linkage: SpatialLinkage, joint: int, axis: Reals) -> int:
    """1 if a turning joint has this axis, -1 if it points the other way, 0 if it lies elsewhere."""
    frame = linkage.frames[joint]
    point = frame[:3, 3] - axis[0]
    aside = np.linalg.norm(point - (point @ axis[1]) * axis[1]) / linkage.size
    cosine = float(frame[:3, 2] @ axis[1])
    same = abs(abs(cosine) - 1) < _SAME and (linkage.mechanism.chain.space is Space.SPHERICAL or aside < _SAME)
    return int(np.sign(cosine)) if same else 0


def bevel_train(linkage: SpatialLinkage) -> Train:
    """The train of the bevel wheels of a linkage on the sphere, with the radii of their circles in place of teeth.

    Raises `LinkageError` for contacts that are no wheels, and for a wheel whose carrier does not bear the other one.

    >>> from gruebler.machines.gears import ratio
    >>> from gruebler.structure.mechanism import Mechanism
    >>> text = "spherical: R(frame-small) R(frame-large) G(small-large)"
    >>> bearings = {0: {"z": (0, 0, 1)}, 1: {"z": (1, 0, 0)}}
    >>> contact = {2: {"z": (3, 0, 4), "y": (4, 0, -3), "radii": (np.arctan2(3, 4), np.arctan2(4, 3)), "pressure": 0}}
    >>> str(ratio(bevel_train(SpatialLinkage(Mechanism.parse(text), bearings | contact)), "small", "large"))
    '-4/3'
    """
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    meshes = []
    if not (rows := gear_rows(linkage)):
        raise LinkageError("the linkage has no wheels")
    for row in rows:
        title = chain.joint_title(row.joint)
        weights = dict(row.turns)
        wheels = chain.joints[row.joint].links
        arms = [link for link in chain.links if link not in wheels and _borne(chain, link, wheels, weights)]
        if not arms:
            raise LinkageError("{joint}: no link bears one of the wheels and is borne beside the other", joint=title)
        arm = min(arms, key=lambda link: link == frame)
        own = {link: next(k for k in weights if link in chain.joints[k].links) for link in wheels}
        planet = next(link for link in reversed(wheels) if arm in chain.joints[own[link]].links)
        sun = wheels[wheels[0] == planet]
        signed = {
            link: weights[own[link]] * (1.0 if chain.joints[own[link]].links[1] == link else -1.0) for link in wheels
        }
        share = Fraction(signed[sun] / signed[planet]).limit_denominator(_TEETH)
        names = {each: FRAME if each == frame else each for each in (sun, planet, arm)}
        meshes.append(
            Mesh(
                a=names[sun],
                b=names[planet],
                size_a=Fraction(share.numerator),
                size_b=Fraction(share.denominator),
                carrier=names[arm],
                kind="bevel",
            )
        )
    return Train(meshes)


def _borne(chain: Chain, link: str, wheels: Sequence[str], weights: Mapping[int, float]) -> bool:
    """Whether a link bears one of the wheels by a weighted joint."""
    return any(link in chain.joints[k].links and set(wheels) & set(chain.joints[k].links) for k in weights)
