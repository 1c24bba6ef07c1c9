"""Other sizes of links in space, and the position beside the reference pose in which the joints are closed with them.

The sizes go evenly from the old ones to the new ones, and each position comes from the one before by Newton's method
on all closing conditions, so that the linkage stays in its assembly mode. Where no way leads there, the position with
the new sizes is sought at once: sizes of overconstrained linkages fit together at the end only.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from math import isfinite, radians

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws.closing import CLOSED, Closing, JointFrames
from gruebler.mechanics.screws.joint_places import JointPlace, Vector
from gruebler.mechanics.screws.link_sizes import LinkSize, has_axis, link_sizes, sized_links
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.rigid_motions import exponential
from gruebler.structure.chain.spaces import Space

Wanted = Mapping[str, tuple[float | None, float | None]]
"""Distance and angle in degrees of links, None for one that stays."""

_STEP = 1 / 8  # of the way from the old sizes to the new ones, between two positions
_LEAST = 1 / 512  # shorter steps are not tried
_NEAR = 0.5  # sizes and radians: a link that moves farther in a step has left its assembly mode
_PATIENT = 60  # steps of Newton's method
_SAME = 1e-9  # of the size, and sines: axes that are less apart have no common normal of their own


def resized(linkage: SpatialLinkage, sizes: Wanted, *, in_proportion: bool = False) -> SpatialLinkage:
    """The linkage with other sizes of links, those of `link_sizes`, in a position where it is closed.

    ``in_proportion``: where one distance alone fits nowhere, all distances change in the same ratio. Raises
    `LinkageError` for a size that no link has, and where the joints cannot be closed; with one size it says how far
    they can be.

    >>> from gruebler.teaching.catalog import entry
    >>> longer = resized(entry("wiper_rssr").placed(), {"crank": (50.0, None)})
    >>> [(size.link, round(size.distance, 6)) for size in link_sizes(longer)][:2]
    [('body', 300.0), ('crank', 50.0)]
    """
    now = {size.link: size for size in link_sizes(linkage)}
    for link, size in sizes.items():
        _check(linkage, now, link, *size)
    closing = Closing.of(linkage)
    pose, part, step = closing.reference, 0.0, _STEP
    while part < 1 and step >= _LEAST:
        further = min(part + step, 1.0)
        settled = _closed(_with_sizes(linkage, closing, now, sizes, further), pose)
        if settled is None or abs(settled - pose).max() > _NEAR:
            step /= 2
        else:
            pose, part, step = settled, further, min(2 * step, _STEP)
    wanted = _with_sizes(linkage, closing, now, sizes, 1.0)
    if part < 1:
        there = next(
            (settled for start in (pose, closing.reference) if (settled := _closed(wanted, start)) is not None), None
        )
        if there is None:
            if in_proportion and not part and (all_sizes := _in_proportion(now, sizes)):
                with suppress(LinkageError):
                    return resized(linkage, all_sizes)
            raise _open(linkage, now, sizes, part)
        pose = there
    return _placed(linkage, wanted, pose)


def can_be_resized(linkage: SpatialLinkage) -> bool:
    """Whether links have sizes that stand for themselves: beside wheels and crossed bodies they do not."""
    joints = linkage.mechanism.chain.joints
    return not any(joint.pair.has_contours or joint.pair.has_body_between for joint in joints)


def _check(
    linkage: SpatialLinkage, now: Mapping[str, LinkSize], link: str, distance: float | None, angle: float | None
) -> None:
    if not can_be_resized(linkage):
        raise LinkageError("sizes beside wheels and crossed bodies are not changed here: they go with these")
    size = now.get(link)
    if size is None or (angle is not None and size.angle is None):
        raise LinkageError("{link} has no such size", link=link)
    if distance is not None and not (isfinite(distance) and distance >= 0):
        raise LinkageError("{link}: a distance is a number from 0 on, not {distance:g}", link=link, distance=distance)
    if angle is not None and not 0 <= angle <= 180:
        raise LinkageError("{link}: the angle of two axes is 0° to 180°, not {angle:g}°", link=link, angle=angle)


def _in_proportion(now: Mapping[str, LinkSize], sizes: Wanted) -> Wanted:
    """All distances with the one that is wanted, if it is the only size; otherwise nothing.

    >>> now = {"a": LinkSize("a", 120.0, 90.0), "b": LinkSize("b", 60.0, 30.0)}
    >>> _in_proportion(now, {"a": (60.0, None)}), _in_proportion(now, {"a": (None, 60.0)})
    ({'a': (60.0, None), 'b': (30.0, None)}, {})
    """
    if len(sizes) != 1:
        return {}
    ((link, (distance, angle)),) = sizes.items()
    if angle is not None or not distance or not now[link].distance:
        return {}
    ratio = distance / now[link].distance
    return {size.link: (ratio * size.distance, None) for size in now.values() if size.distance} if len(now) > 1 else {}


def _closed(closing: Closing, start: Reals) -> Reals | None:
    """A closed pose by Newton's method, in which no joint is put together the other way round."""
    settled = closing.settled(start, most=_PATIENT)
    if abs(closing.residual(settled)).max(initial=0.0) > CLOSED:
        return None
    chain = closing.mechanism.chain
    for tie, seen in zip(closing.ties, closing.seen(settled), strict=True):
        free = [f.axis for f in chain.joints[tie.joint].pair.freedoms[chain.space] if f.turns]
        kept = {0: "xyz", 1: "".join(free)}.get(len(free), "")
        if any(seen[k, k] < 0 for k in map("xyz".index, kept)):
            return None
    return settled


def _open(linkage: SpatialLinkage, now: Mapping[str, LinkSize], sizes: Wanted, part: float) -> LinkageError:
    """What to say where the joints stay open, after a part of the way."""
    changes = [
        (link, old, new, unit)
        for link, wanted in sizes.items()
        for old, new, unit in zip((now[link].distance, now[link].angle), wanted, (f" {linkage.unit}", "°"), strict=True)
        if old is not None and new is not None and old != new
    ]
    if len(changes) != 1:
        return LinkageError("the joints cannot be closed with these sizes; go there in smaller steps, or change others")
    ((link, old, new, unit),) = changes
    if not part:
        return LinkageError(
            "{link}: with {size:.6g}{unit} the joints cannot be closed unless other sizes change as well",
            link=link,
            size=new,
            unit=unit,
        )
    return LinkageError(
        "{link}: the joints can be closed as far as {last:.4g}{unit}, not with {size:.6g}{unit}",
        link=link,
        size=new,
        unit=unit,
        last=old + part * (new - old),
    )


def _with_sizes(
    linkage: SpatialLinkage, closing: Closing, now: Mapping[str, LinkSize], sizes: Wanted, part: float
) -> Closing:
    """The closing conditions after a part of the way to the wanted sizes: the second joint of a link is moved on it."""
    chain = linkage.mechanism.chain
    moves: dict[tuple[int, int], Reals] = {}
    for link, (distance, angle) in sizes.items():
        size = now[link]
        shift = 0.0 if distance is None else part * (distance - size.distance) / _scale(linkage)
        turn = 0.0 if angle is None or size.angle is None else radians(part * (angle - size.angle))
        if shift or turn:
            first, second = sized_links(linkage)[link]
            moves[chain.index(link), second] = _along_normal(linkage, closing, link, (first, second), shift, turn)

    def moved(tie: JointFrames) -> JointFrames:
        on_first, on_second = (moves.get((link, tie.joint)) for link in (tie.first, tie.second))
        return replace(
            tie,
            on_first=tie.on_first if on_first is None else on_first @ tie.on_first,
            on_second=tie.on_second if on_second is None else on_second @ tie.on_second,
        )

    return Closing(linkage.mechanism, [moved(tie) for tie in closing.ties], closing.reference)


def _along_normal(
    linkage: SpatialLinkage, closing: Closing, link: str, joints: tuple[int, int], shift: float, turn: float
) -> Reals:
    """The motion of the second joint on its link: along and about the common normal of axes, away from a ball."""
    frames = [next(tie.on_first for tie in closing.ties if tie.joint == joint) for joint in joints]
    axes = [frame[:3, 2] for frame in frames]
    straight = [has_axis(linkage.mechanism.chain.joints[joint].pair) for joint in joints]
    start, end = (frame[:3, 3] for frame in frames)
    gap = end - start
    if all(straight) and np.linalg.norm(normal := np.cross(axes[0], axes[1])) > _SAME:
        normal = normal / np.linalg.norm(normal)
        # where the normal meets the second axis
        end = end - axes[1] * (np.cross(gap, axes[0]) @ normal) / np.linalg.norm(np.cross(axes[0], axes[1]))
        turned, normal = normal, normal * (-1.0 if gap @ normal < 0 else 1.0)
    else:
        for axis, has in zip(axes, straight, strict=True):
            gap = gap - (gap @ axis) * axis if has else gap
        if np.linalg.norm(gap) <= _SAME:
            raise LinkageError("{link}: its joints lie on one axis or in one point, which says no direction", link=link)
        turned = normal = gap / np.linalg.norm(gap)
    motion: Reals = exponential([*(turn * turned), *(np.cross(end, turn * turned) + shift * normal)])
    return motion


def _scale(linkage: SpatialLinkage) -> float:
    return 1.0 if linkage.mechanism.chain.space is Space.SPHERICAL else linkage.size


def _placed(linkage: SpatialLinkage, closing: Closing, pose: Reals) -> SpatialLinkage:
    """The linkage whose reference pose is a closed pose."""
    chain = linkage.mechanism.chain
    spherical = chain.space is Space.SPHERICAL
    places = []
    for number, (joint, place) in enumerate(zip(chain.joints, linkage.places, strict=True)):
        tie = next(tie for tie in closing.ties if tie.joint == number)
        frame, other = pose[tie.first] @ tie.on_first, pose[tie.second] @ tie.on_second
        axes = frame[:3, :3].copy()
        free = ["xyz".index(freedom.axis) for freedom in joint.pair.freedoms[chain.space] if freedom.turns]
        if len(free) == 2:  # one axis on either link
            first_axis, last_axis = free
            axes[:, last_axis] = other[:3, last_axis]
            normal = np.cross(axes[:, first_axis], axes[:, last_axis])
            axes[:, 3 - first_axis - last_axis] = normal if (last_axis - first_axis) % 3 == 1 else -normal
        x, y, z = (
            None if given is None else _vector(axis)
            for given, axis in zip((place.x, place.y, place.z), axes.T, strict=True)
        )
        at = _vector(np.zeros(3)) if spherical else _there(linkage, np.eye(4), other[:3, 3])
        places.append(JointPlace(at, x=x, y=y, z=z, pitch=place.pitch))
    size, centre = _scale(linkage), np.zeros(3) if spherical else linkage.centre
    moved = {link: pose[k] for k, link in enumerate(chain.links)}

    def taken(link: str, at: Vector) -> Vector:
        return _there(linkage, moved[link], (np.array(at) - centre) / size)

    return SpatialLinkage(
        linkage.mechanism,
        tuple(places),
        unit=linkage.unit,
        points={name: (link, *taken(link, at)) for name, (link, at) in linkage.points.items()},
        outputs=linkage.outputs,
        round_bodies={
            name: replace(body, at=taken(body.link, body.at), z=_vector(moved[body.link][:3, :3] @ body.z))
            for name, body in linkage.round_bodies.items()
        },
    )


def _there(linkage: SpatialLinkage, motion: Reals, at: Reals) -> Vector:
    spherical = linkage.mechanism.chain.space is Space.SPHERICAL
    centre = np.zeros(3) if spherical else linkage.centre
    return _vector(_scale(linkage) * (motion[:3, :3] @ at + motion[:3, 3]) + centre)


def _vector(v: Reals) -> Vector:
    x, y, z = v.tolist()
    return x, y, z
