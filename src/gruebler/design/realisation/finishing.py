"""From a drawing to a linkage: aligned, scaled, rounded to sensible numbers, and checked by moving it again."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, radians

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.design.realisation.layout_program import LayoutProgram, joint_places
from gruebler.design.realisation.layout_trial import FLOOR, LayoutTrial, range_path, returns_to_start
from gruebler.design.realisation.measures import conditioning
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan, move_quietly
from gruebler.mechanics.linkages import Linkage

Ranges = tuple[tuple[float, float], ...]

_SIZE = 100.0
_GRADES = ((1.0, 5.0), (0.5, 1.0), (0.1, 0.5), (0.01, 0.1), (1e-3, 1e-2))  # unit of lengths, of degrees
_LOSS = 0.9  # the share of the quality that remains at least after rounding
_OPEN = 1e-12


@dataclass(frozen=True, slots=True)
class FinishedLinkage:
    """A linkage of rounded dimensions, the ranges of its drives, and its quality."""

    linkage: Linkage
    ranges: Ranges
    quality: float


def finish_linkage(program: LayoutProgram, drawing: Reals, trial: LayoutTrial, unit: str) -> FinishedLinkage | None:
    """The linkage of the coarsest rounding that moves like the drawing, if there is one."""
    straight = _straight(program, drawing)
    scale = program.size(straight) / program.size(drawing)
    drawn = Linkage.from_drawing(program.mechanism, joint_places(program.mechanism, program.slots, straight), unit=unit)
    required_quality = max(FLOOR, _LOSS * _moved(drawn, trial, scale, 0.0)[1])
    for length, angle in _GRADES:
        linkage = _with_rounded_reference(_rounded(drawn, length, radians(angle)), length)
        if linkage is None:
            continue
        ranges, quality = _moved(linkage, trial, scale, length)
        if quality >= required_quality:
            return FinishedLinkage(linkage, ranges, quality)
    return None


def _moved(linkage: Linkage, trial: LayoutTrial, scale: float, length: float) -> tuple[Ranges, float]:
    """The ranges of a linkage and the smallest measure in them; 0 if it does not move through them."""
    ranges = _ranges(linkage, trial, scale, length)
    motion = move_quietly(linkage, range_path(ranges, full=trial.full, rows=361))
    quality = motion_quality(motion, full=trial.full)
    return ranges, quality if quality and motion.closure_error < _OPEN else 0.0


def motion_quality(motion: Motion, *, full: bool) -> float:
    """The smallest measure of a motion; 0 if it does not reach its end, or, for a full turn, does not close."""
    plan = motion.plan
    if not motion.complete or (full and not returns_to_start(motion.places[0], motion.turns, motion.size)):
        return 0.0
    return float(conditioning(plan, plan.program, motion.places[0], motion.turns, motion.roots).min())


def _straight(program: LayoutProgram, drawing: Reals) -> Reals:
    """The frame's driven (else first) joint at the origin, its slide or its farthest pin along the x axis; scaled."""
    mechanism, slides = program.mechanism, program.slides
    frame_joints = [k for k, joint in enumerate(mechanism.chain.joints) if mechanism.frame in joint.links]
    driven = [drive.joint for drive in mechanism.drives if drive.joint in frame_joints]
    pins = [k for k in [*driven, *frame_joints] if k not in slides] or frame_joints
    origin = drawing[pins[0], :2]
    along = next((float(drawing[k, 2]) for k in frame_joints if k in slides), None)
    if along is None:
        gaps = drawing[frame_joints, :2] - origin
        far = gaps[int(np.argmax(np.hypot(gaps[:, 0], gaps[:, 1])))]
        along = atan2(far[1], far[0])
    straight = drawing.copy()
    turn = np.exp(-1j * along) * _SIZE / program.size(drawing)
    z = ((drawing[:, 0] - origin[0]) + 1j * (drawing[:, 1] - origin[1])) * turn
    straight[:, 0], straight[:, 1], straight[:, 2] = z.real, z.imag, drawing[:, 2] - along
    return straight


def _rounded(linkage: Linkage, length: float, angle: float) -> Linkage:
    """Every element rounded in the coordinates of its link."""
    elements: dict[str, dict[str | int, object]] = {link: {} for link in linkage.mechanism.chain.links}
    for (number, link), e in linkage.elements.items():
        turned = radians(_grid(degrees(e.direction) % 360, degrees(angle)) % 360)
        elements[link][number] = e.placed(_grid(e.x, length), _grid(e.y, length), turned)
    return Linkage(linkage.mechanism, elements, unit=linkage.unit, reference_pose=linkage.required_pose)


def _with_rounded_reference(linkage: Linkage, length: float) -> Linkage | None:
    """The linkage with a closed reference pose of rounded drive values; None if it cannot be assembled."""
    reference = pose_at_reference(cached_plan(linkage), np.zeros(len(linkage.mechanism.drives)))
    turning = [drive.turning for drive in linkage.mechanism.drives]
    values: list[float] = [
        radians(round(degrees(value))) if turns else _grid(value, length)
        for value, turns in zip(reference.drives, turning, strict=True)
    ]
    try:
        motion = move_quietly(linkage, np.array([reference.drives, values]))
    except LinkageError:  # rounding has moved the joints too far apart
        return None
    if not motion.complete:
        return None
    links = linkage.mechanism.chain.links
    at = {
        link: (*(_grid(v, 1e-9) for v in (z.real, z.imag)), radians(_grid(degrees(motion.angle(link)[-1]), 1e-7)))
        for link, z in zip(links, motion.places[0, -1], strict=False)
    }
    return linkage._changed(reference_pose=at)


def _ranges(linkage: Linkage, trial: LayoutTrial, scale: float, length: float) -> Ranges:
    """The ranges of a drawing as values of the linkage's drives, their ends rounded inwards if a unit is given."""
    reference = pose_at_reference(cached_plan(linkage), np.zeros(len(linkage.mechanism.drives)))
    ranges = []
    for value, (low, high), drive in zip(reference.drives, trial.ranges, linkage.mechanism.drives, strict=True):
        turning = drive.turning
        unit, factor = (radians(1) if length else 0.0, 1.0) if turning else (length, scale)
        start, end = value + factor * low, value + factor * high
        if unit and not trial.full:
            start, end = np.ceil(start / unit) * unit, np.floor(end / unit) * unit
        ranges.append((float(start), float(end)))
    return tuple(ranges)


def _grid(value: float, unit: float) -> float:
    """The nearest multiple of a unit, written shortly."""
    return round(round(value / unit) * unit, 9) + 0.0
