"""A linkage prepared for drawing: one pose, the path of its drive through all others, and the scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.angles import warn_of_degrees
from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.analysis.drive_cycles import drive_cycle, path_cycle
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan, move_quietly
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.mechanics.linkages.lower_pairs import with_lower_pairs
from gruebler.pictures.canvas.shapes import Point
from gruebler.structure.mechanism import Mechanism

_FARTHEST = 1e9  # of drive values that are shown: beyond, an angle has lost its sense
_PIXELS = 380.0  # for the longer side of all that the pins reach
_WITH_WHEELS = 520.0  # for that of all that wheels reach, too
_SHORTEST = 34.0  # pixels between two pins of one link, unless the picture becomes too large
_LARGEST = 1.6  # times the usual size
_ROWS = 72  # poses of a turn, or of a range
_INSIDE = 1e-6  # of the range: the distance of the last pose from a limit
_ENDLESS = 1.5  # sizes on both sides of the start of a slide without limits


@dataclass(frozen=True, kw_only=True)
class PosedLinkage:
    """The motion of a linkage as input of pictures and animations."""

    lower: Linkage
    """The linkage with turning and sliding joints only; its original links keep their names."""
    cycle: Course | None
    """The full motion; None with several drives or none, and where there is one position only."""
    pose: Motion
    """One row, with rates for a drive of speed 1 where there is one drive."""
    path: Motion
    """Rows through the range of the drive, evenly in time; without a cycle the pose alone."""
    scale: float
    """Pixels to a unit of length."""

    @property
    def linkage(self) -> Linkage:
        """The original linkage."""
        return self.pose.linkage

    @property
    def repeats(self) -> bool:
        """Whether the path is closed: after its last row it continues with its first."""
        drives = self.path.drives[:, 0]
        return self.cycle is not None and _is_whole(self.cycle, drives)

    def local(self, z: complex) -> Point:
        """A point of a link in pixels, in coordinates of the link."""
        return Point(self.scale * z.real, -self.scale * z.imag)

    def place(self, point: LinkPoint) -> Point:
        """The place of a point in the pose, in pixels."""
        return self.local(complex(self.pose.complex_point(point)[0]))

    @property
    def reach(self) -> tuple[Point, Point]:
        """The upper left and lower right corner of the reach of joints and named points on the path, in pixels."""
        z = self.scale * _reached(self.lower, self.path)
        low, high = z.real.min() + 1j * z.imag.min(), z.real.max() + 1j * z.imag.max()
        return Point(float(low.real), -float(high.imag)), Point(float(high.real), -float(low.imag))

    def driven(self) -> Course:
        """The cycle; `LinkageError` with several drives."""
        if self.cycle is None:
            count = len(self.linkage.mechanism.drives)
            if count == 1:
                raise LinkageError("the linkage can be assembled in one position only, so there is no motion to draw")
            raise LinkageError(
                "this is drawn for linkages with one drive only; this one has {count}: leave one of them driven, "
                "or draw a path of all drives with draw_motion(move(linkage, path))",
                count=count,
            )
        return self.cycle


def posed_along_motion(motion: Motion) -> PosedLinkage:
    """A solved motion of one row or more, its first row as the pose; without the other drive values of its cycle."""
    first = replace(
        motion,
        drives=motion.drives[:1],
        places=motion.places[:, :1],
        turns=motion.turns[:1],
        rates=motion.rates[:, :1],
        whole=motion.whole[:1],
        roots=motion.roots[:1],
        unknowns=motion.unknowns[:1],
        unbounded=(),
        taken_for_exact=(),
    )
    return PosedLinkage(
        lower=motion.lower_linkage, cycle=None, pose=first, path=motion, scale=_scale(motion.lower_linkage, motion)
    )


def _is_whole(cycle: Course, drives: Reals) -> bool:
    """Whether drive values cover all turns of the period."""
    return bool(drives[-1] - drives[0] > cycle.span.period * (1 - 1e-9))


def posed_linkage(
    linkage: LinkageLike,
    drive: float | Sequence[float] | None = None,
    *,
    branch: Branch = None,
    between: tuple[float, float] | None = None,
    drives: ArrayLike | None = None,
) -> PosedLinkage:
    """Follow a linkage through its range, between two drive values, or along a path of its drives, and choose a pose.

    Without a drive value the pose is the reference pose; else at a sixth of a turn; else at a quarter of the range,
    since its middle and ends are often singular. A linkage that has one position only is shown in it, one without a
    drive in the reference pose.

    Raises `LinkageError` for an unreachable pose, and without a drive if there is no reference pose.
    """
    linkage = as_linkage(linkage, unit="")
    try:
        values = None if drive is None else np.atleast_1d(np.asarray(drive, np.float64))
    except (TypeError, ValueError, OverflowError):
        raise LinkageError("drive values are numbers, but found {drive!r}", drive=drive) from None
    if not linkage.mechanism.drives:
        return _at_rest(linkage)
    for k, driven in enumerate(linkage.mechanism.drives):
        if driven.turning:
            for name, given in (("drive", values), ("between", between), ("drives", drives)):
                warn_of_degrees(name, _of_drive(given, k, len(linkage.mechanism.drives)))
    plan = cached_plan(linkage)
    if drives is not None:
        along = path_cycle(linkage, drives, branch=branch)
        path = along.at(np.sin(np.linspace(0, math.pi / 2, _ROWS + 1)) ** 2, 0)
        return PosedLinkage(
            lower=along.lower_linkage,
            cycle=along,
            pose=along.at(np.array([1 / 3]), 2),
            path=path,
            scale=_scale(along.lower_linkage, path),
        )
    if len(linkage.mechanism.drives) == 1:
        try:
            cycle = drive_cycle(linkage, branch=branch)
        except LinkageError as error:
            return _one_position(linkage, values, branch, error)
        path = cycle.at(drive_rows(cycle, between), 0)
        pose = cycle.at(np.array([_value(cycle, values, path.drives[:, 0])]), 2)
        return PosedLinkage(
            lower=cycle.lower_linkage, cycle=cycle, pose=pose, path=path, scale=_scale(cycle.lower_linkage, path)
        )
    if values is None:
        zeros = np.zeros(len(linkage.mechanism.drives))
        values = zeros if plan.lower.reference_pose is None else pose_at_reference(plan, zeros).drives
    pose = move_quietly(linkage, values.reshape(1, -1), branch=branch)
    if not len(pose):
        raise LinkageError("{reason}", reason=pose.reason)
    return _posed(pose)


def _posed(pose: Motion) -> PosedLinkage:
    """One pose without a range."""
    return PosedLinkage(
        lower=pose.lower_linkage, cycle=None, pose=pose, path=pose, scale=_scale(pose.lower_linkage, pose)
    )


def _one_position(linkage: Linkage, values: Reals | None, branch: Branch, error: LinkageError) -> PosedLinkage:
    """The pose of a linkage that cannot move, at the given value or at the first possible one; else its error."""
    candidates = values.reshape(1, -1) if values is not None else np.radians(np.arange(0.0, 360.0, 5.0))[:, None]
    turning = linkage.mechanism.drives[0].turning
    for row in candidates if values is not None or turning else ():
        try:
            pose = move_quietly(linkage, row.reshape(1, -1), branch=branch)
        except LinkageError:
            raise error from None
        if len(pose):
            return _posed(pose)
    raise error


def _at_rest(linkage: Linkage) -> PosedLinkage:
    """The reference pose of a linkage without a drive, solved as that of the same linkage with one."""
    mechanism = linkage.mechanism
    for number in range(len(mechanism.chain.joints)) if linkage.reference_pose is not None else ():
        try:
            driven = linkage.with_mechanism(Mechanism(mechanism.chain, mechanism.frame, [number]))
            plan = cached_plan(driven)
            pose = move_quietly(driven, pose_at_reference(plan, np.zeros(1)).drives.reshape(1, -1))
        except GrueblerError:
            continue
        if len(pose):
            return _posed(replace(_whole(pose, linkage) if plan.released else pose, linkage=linkage))
    name = mechanism.chain.joint_title(0)
    raise LinkageError("no joint is driven, so there is no pose; name a drive, such as {name}", name=name)


def _whole(pose: Motion, linkage: Linkage) -> Motion:
    """The reference pose with the joints, too, that are released because they repeat what others say."""
    lower = with_lower_pairs(linkage)
    assert lower.reference_pose is not None
    x, y, angle = np.array([lower.reference_pose[link] for link in lower.mechanism.chain.links]).T
    still = np.zeros((len(pose.places), 1, len(x)))
    return replace(
        pose,
        plan=replace(pose.plan, lower=lower),
        places=still + (x + 1j * y) * (np.arange(len(still)) == 0)[:, None, None],
        turns=np.exp(1j * angle)[None],
        rates=still[1:],
        whole=np.zeros((1, len(x)), np.int32),
    )


def drive_rows(cycle: Course, between: tuple[float, float] | None = None, count: int = _ROWS) -> Reals:
    """Drive values: ``count`` even steps of each full turn, else of the range, denser at both ends.

    Of a range without an end one turn is shown, or one and a half sizes to either side.

    Raises `LinkageError` if no part of the range lies between the two requested values.
    """
    span = cycle.span
    low, high = span.low, span.high
    if between is None and span.full:
        return np.linspace(low, high, count * span.turns + 1)
    if not span.full:
        middle, room = float(cycle.start.drives[0, 0]), math.pi if cycle.turning_drive else _ENDLESS * cycle.size
        low = low if span.stops[0] is not None else max(low, middle - room)
        high = high if span.stops[1] is not None else min(high, middle + room)
    low, high = low + _INSIDE * (high - low), high - _INSIDE * (high - low)
    if between is not None:
        turn = 2 * math.pi if cycle.turning_drive and not span.full else math.inf
        shift = turn * round((low + high - sum(between)) / 2 / turn) if turn < math.inf else 0.0
        interval = between[0] + shift, between[1] + shift
        low, high = interval if span.full else (max(low, interval[0]), min(high, interval[1]))
    if not high > low:
        raise LinkageError("{range}; nothing of it lies between the two values asked for", range=_range(cycle))
    return low + (high - low) * np.sin(np.linspace(0, math.pi / 2, count + 1)) ** 2


def _value(cycle: Course, values: Reals | None, rows: Reals) -> float:
    """The drive value of the pose."""
    if values is None:
        start = float(cycle.start.drives[0, 0])
        if cycle.lower_linkage.reference_pose is not None and rows[0] <= start <= rows[-1]:
            return start
        return math.pi / 3 if _is_whole(cycle, rows) else float(rows[len(rows) // 3])
    if values.shape != (1,) or not abs(values[0]) < _FARTHEST:
        raise LinkageError("expected one finite drive value, but found {found}", found=values.tolist())
    value, span = float(values[0]), cycle.span
    if cycle.turning_drive and not span.full:
        value += 2 * math.pi * math.ceil((span.low - value) / (2 * math.pi))
    if not span.full and not span.low <= value <= span.high:
        raise LinkageError(
            "{range}; there is no pose at {drive}", range=_range(cycle), drive=_drive_value(cycle, float(values[0]))
        )
    return value


def _range(cycle: Course) -> Message:
    low, high = (_drive_value(cycle, value) for value in (cycle.span.low, cycle.span.high))
    return message("the drive goes from {low} to {high} on this branch", low=low, high=high)


def _drive_value(cycle: Course, value: float) -> Message:
    if cycle.turning_drive:
        return message("{angle:.6g} degrees", angle=math.degrees(value))
    return message(
        "{length:.6g} {unit}" if cycle.linkage.unit else "{length:.6g}", length=value, unit=cycle.linkage.unit
    )


def floating_link(linkage: Linkage) -> str:
    """The link with most joints and points among those that are no neighbours of the frame; else the last link."""
    mechanism = linkage.mechanism
    near = {link for joint in mechanism.chain.joints if mechanism.frame in joint.links for link in joint.links}
    far = [link for link in mechanism.chain.links if link not in near]
    moving = [link for link in mechanism.chain.links if link != mechanism.frame]
    return max(far, key=lambda link: len(link_nodes(linkage, link))) if far else moving[-1]


def link_nodes(linkage: Linkage, link: str) -> list[complex]:
    """The places of the joints and then the named points of a link, in its coordinates, each once."""
    joints = [complex(e.x, e.y) for (_, owner), e in linkage.elements.items() if owner == link]
    return list(dict.fromkeys([*joints, *(complex(p.x, p.y) for p in linkage.points.values() if p.link == link)]))


def _reached(lower: Linkage, path: Motion) -> Complexes:
    """The places of all joints and named points on the path, one after another."""
    places = [LinkPoint(link, e.x, e.y) for (_, link), e in lower.elements.items()]
    return np.concatenate([path.complex_point(place) for place in (*places, *lower.points.values())])


def _round_extent(lower: Linkage, path: Motion) -> float:
    """The longer side of all that wheels, circles and outlines reach; 0 without any."""
    round_places = [(link, e.x, e.y, e.rim) for (_, link), e in lower.elements.items() if e.rim]
    round_places += [
        (link, x, y, outline.radius)
        for link, of in path.linkage.outlines.items()
        for outline in of
        for x, y in outline.places
    ]
    rims = [(path.complex_point(LinkPoint(link, x, y)), rim) for link, x, y, rim in round_places]
    sides = (
        max((float(part(z).max()) + r for z, r in rims), default=0.0)
        - min((float(part(z).min()) - r for z, r in rims), default=0.0)
        for part in (np.real, np.imag)
    )
    return max(sides)


def _scale(lower: Linkage, path: Motion) -> float:
    """Pixels to a unit, so that all poses fit and short links are longer than the diameter of their pins."""
    links, z = lower.mechanism.chain.links, _reached(lower, path)
    extent = max(float(np.ptp(z.real)), float(np.ptp(z.imag)), 1e-9 * lower.size)
    usual = min(_PIXELS / extent, _WITH_WHEELS / max(_round_extent(lower, path), extent))
    pins = {
        link: {(e.x, e.y) for (_, owner), e in lower.elements.items() if owner == link and e.is_pin} for link in links
    }
    pins.pop(lower.mechanism.frame)
    sides = [math.dist(a, b) for link_pins in pins.values() for a, b in combinations(sorted(link_pins), 2)]
    return min(max(usual, _SHORTEST / min(sides, default=math.inf)), _LARGEST * usual)


def _of_drive(given: ArrayLike | None, number: int, drives: int) -> Reals:
    """Of drive values in a row, or in rows, those of one drive; a range of the only drive is all its own."""
    values = np.asarray(() if given is None else given, np.float64)
    return values if drives == 1 else np.atleast_1d(values)[..., number : number + 1]
