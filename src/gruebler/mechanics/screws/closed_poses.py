"""A linkage in a pose: its closing conditions and where its links are."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, inf, sin

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.linkages import Element, Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.model import NEAR_REFERENCE
from gruebler.mechanics.screws.closing import CLOSED, RANK, Closing, JointFrames
from gruebler.mechanics.screws.double_roots import refined_at_double_root
from gruebler.mechanics.screws.following import follow_joints, joint_value
from gruebler.mechanics.screws.instant_mobility import instant_mobility
from gruebler.mechanics.screws.joint_places import JointPlace
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.rigid_motions import inverse_motion

_EXACT = 1e-15  # a reference pose that is closed so well is meant as it is
_STARTS = 60  # random poses from which a linkage without a reference pose is assembled
_NEARLY = 1e-8  # of the size: joints that may be closed at a double root, where a pose is known to that only
_PATIENT = 60  # steps of Newton's method: beside a double root each halves the error only
_ENOUGH = 6  # closed poses among which the best is taken
_GOOD = 0.01  # a smallest singular value, for each unknown, with which the search for a pose stops


def closed_pose(
    linkage: Linkage | SpatialLinkage, at: Sequence[float] | None = None, branch: Branch = None
) -> tuple[Closing, Reals]:
    """The closing conditions of a linkage and a pose: at drive values, else its reference pose, else a regular one.

    Raises `LinkageError` if there is no such pose.
    """
    if isinstance(linkage, SpatialLinkage):
        if branch is not None:
            raise LinkageError("a linkage given by its reference pose has no assembly mode to choose")
        closing = Closing.of(linkage)
        return closing, closing.reference if at is None else _driven(closing, closing.reference, at, linkage.size)
    closing = _planar(linkage)
    if at is not None or branch is not None:
        return closing, _at(linkage, closing, at, branch)
    if linkage.reference_pose is None:
        return closing, _assembled(closing)
    return closing, _centred(closing, _settled(closing, _reference_pose(linkage)))


def _planar(linkage: Linkage) -> Closing:
    chain, size = linkage.mechanism.chain, linkage.size
    ties = []
    for number, joint in enumerate(chain.joints):
        first = joint.links[0]
        for other in joint.links[1:]:
            element, other_element = linkage.elements[number, first], linkage.elements[number, other]
            radii = (inf if element.is_line else 0.0, inf if other_element.is_line else 0.0)
            place = JointPlace(radii=radii if joint.pair.rolls_and_slides else None)
            ends = _frame(element, size), _frame(other_element, size)
            ties.append(
                JointFrames(
                    joint=number,
                    first=chain.index(first),
                    second=chain.index(other),
                    on_first=ends[0],
                    on_second=ends[1],
                    place=place,
                )
            )
    return Closing(linkage.mechanism, ties, np.tile(np.eye(4), (chain.n, 1, 1)))


def _frame(element: Element, size: float) -> Reals:
    if element.is_round:
        raise LinkageError(
            "mobility with dimensions knows pins and lines, not {element!r}; give the joints' screws", element=element
        )
    return _matrix(element.x / size, element.y / size, element.direction)


def _matrix(x: float, y: float, angle: float) -> Reals:
    c, s = cos(angle), sin(angle)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def _reference_pose(linkage: Linkage) -> Reals:
    places = [linkage.required_pose[link] for link in linkage.mechanism.chain.links]
    return np.array([_matrix(p.x / linkage.size, p.y / linkage.size, p.angle) for p in places])


def _settled(closing: Closing, reference: Reals) -> Reals:
    """The pose near the reference pose in which the joints are closed."""
    pose = closing.settled(reference)
    if abs(closing.residual(pose)).max() > CLOSED or abs(pose - reference).max() > NEAR_REFERENCE:
        gap = abs(closing.residual(reference)).max()
        raise LinkageError(
            "the joints cannot be closed there: they are open by {gap:.1e} of the linkage's size", gap=gap
        )
    inexact = (pose != reference).any() or abs(closing.residual(pose)).max() > _EXACT
    return refined_at_double_root(closing, pose) if inexact else pose


def _centred(closing: Closing, pose: Reals) -> Reals:
    """The same pose with the mean of the joints' points at the origin, so that no frame is preferred."""
    points = [(pose[tie.first] @ tie.on_first)[:3, 3] for tie in closing.ties]
    moved = pose.copy()
    moved[:, :3, 3] -= np.mean(points, axis=0)
    return moved


def _at(linkage: Linkage, closing: Closing, at: Sequence[float] | None, branch: Branch) -> Reals:
    """The pose at drive values, as `move` finds it; with redundant constraints followed from the reference pose."""
    drives = linkage.mechanism.drives
    if at is None:
        raise LinkageError("an assembly mode is one of several at a drive value, which is missing")
    _check_count(at, len(drives))
    if linkage.reference_pose is not None and branch is None:
        reference = _settled(closing, _reference_pose(linkage))
        sided = [_sided(linkage, k, value) for k, value in enumerate(at)]
        return _centred(closing, _driven(closing, reference, sided, linkage.size))
    from gruebler.mechanics.kinematics.solve import move_quietly

    motion = move_quietly(linkage, [tuple(at)], branch=branch)
    if not len(motion):
        raise LinkageError("{reason}", reason=motion.reason)
    chain = linkage.mechanism.chain
    rows = []
    for link in chain.links:
        k = motion.link_index(link)
        z, turn = motion.places[0, 0, k] / linkage.size, motion.turns[0, k]
        rows.append(_matrix(z.real, z.imag, float(np.angle(turn))))
    return _centred(closing, _settled(closing, np.array(rows)))


def _check_count(at: Sequence[float], drives: int) -> None:
    if not drives:
        raise LinkageError("the linkage has no drive; a pose at a drive value needs one")
    if len(at) != drives:
        raise LinkageError(
            "expected 1 drive value, but found {count}"
            if drives == 1
            else "expected {drives} drive values, one for each, but found {count}",
            drives=drives,
            count=len(at),
        )


def _sided(linkage: Linkage, drive: int, value: float) -> float:
    """The drive value with the first link of the joint as the one that is measured against."""
    first, _ = linkage.reference(drive)
    mechanism = linkage.mechanism
    return value if first == mechanism.chain.joints[mechanism.drives[drive].joint].links[0] else -value


def _driven(closing: Closing, reference: Reals, at: Sequence[float], size: float) -> Reals:
    """The pose at the values of all drives, which are followed from the reference pose together."""
    mechanism = closing.mechanism
    _check_count(at, len(mechanism.drives))
    joints, values = [drive.joint for drive in mechanism.drives], []
    for joint, value in zip(joints, at, strict=True):
        if mechanism.chain.joints[joint].pair.is_turning:
            now = joint_value(closing, reference, joint)
            values.append(now + (value - now + np.pi) % (2 * np.pi) - np.pi)
        else:
            values.append(value / size)
    return follow_joints(closing, reference, joints, np.array([values]))[0]


def _assembled(closing: Closing) -> Reals:
    """A pose with closed joints: of some the most movable, with the drives and most joints moving, the most regular."""
    random = np.random.default_rng(20_261_121)
    candidates: list[tuple[int, tuple[bool, int], float, Reals]] = []
    driven = {drive.joint for drive in closing.mechanism.drives}
    least = np.inf
    frame = closing.mechanism.chain.index(closing.mechanism.frame)
    for _ in range(_STARTS):
        start = np.array([_matrix(x, y, np.pi * t) for x, y, t in random.uniform(-1, 1, (len(closing.reference), 3))])
        pose = closing.settled(inverse_motion(start[frame]) @ start, most=_PATIENT)
        open_by = float(abs(closing.residual(pose)).max())
        if CLOSED < open_by < _NEARLY:  # at a double root steps only halve
            pose = refined_at_double_root(closing, pose)
            open_by = float(abs(closing.residual(pose)).max())
        least = min(least, open_by)
        if open_by > CLOSED:
            continue
        instant = instant_mobility(closing, pose, RANK)
        margin = float(instant.values[instant.rank - 1]) / closing.unknowns
        moving = driven.isdisjoint(instant.immobile), -len(instant.immobile)
        candidates.append((instant.mobility, moving, margin, pose))
        if len(candidates) >= _ENOUGH or (not instant.redundancy and not instant.immobile and margin > _GOOD):
            break
    if not candidates:
        raise LinkageError(
            "no position was found in which the joints can be closed: they stay open by {least:.1e} of the "
            "linkage's size at least",
            least=least,
        )
    return _centred(closing, refined_at_double_root(closing, max(candidates, key=lambda candidate: candidate[:3])[3]))
