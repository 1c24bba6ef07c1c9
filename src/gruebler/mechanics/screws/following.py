"""Joints of a linkage moved through given values, the others following: all joints closed at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import joined, message
from gruebler.mechanics.screws.closing import CLOSED, RANK, Closing

_STEP = 0.05  # of the driven joint, in radians or sizes, between two corrections


def joint_value(closing: Closing, pose: Reals, joint: int) -> float:
    """The turn about z of a turning joint, else the way along x (prismatic) in sizes; 0 in the reference pose."""
    k = next(k for k, tie in enumerate(closing.ties) if tie.joint == joint)
    e = closing.seen(pose)[k]
    if closing.mechanism.chain.joints[joint].pair.is_sliding:
        return float(e[0, 3])
    return float(np.arctan2(e[1, 0], e[0, 0]))


def follow_joints(closing: Closing, pose: Reals, joints: Sequence[int], values: Reals) -> list[Reals]:
    """The poses (n, 4, 4) in which revolute or prismatic joints have these values (rows, joints), followed from a pose.

    Translations are in units of the linkage's size, from its centre. Between rows the joints go evenly in steps of at
    most 0.05, so that the linkage stays on its way; where several ways lead on it takes the nearest pose. Redundant
    constraints are allowed.

    Raises:
        LinkageError: a joint that is neither, or a value that cannot be reached.
    """
    chain = closing.mechanism.chain
    for joint in joints:
        if not chain.joints[joint].pair.is_basic or chain.joints[joint].count > 1:
            raise LinkageError(
                "{joint}: only a revolute or prismatic joint of two links is driven",
                joint=chain.joint_title(joint),
            )
    now, poses = np.array([joint_value(closing, pose, joint) for joint in joints]), []
    for row in values:
        steps = max(1, int(np.ceil(abs(row - now).max() / _STEP)))
        for target in np.linspace(now, row, steps + 1)[1:]:
            pose = _reached(closing, pose, joints, target)
        now = row
        poses.append(pose)
    return poses


def _reached(closing: Closing, pose: Reals, joints: Sequence[int], target: Reals) -> Reals:
    chain = closing.mechanism.chain
    turns = np.array([chain.joints[joint].pair.is_turning for joint in joints])
    drivers = [_driving_row(closing, joint) for joint in joints]
    for _ in range(30):
        value, by_twist = closing.linearised(pose)
        missing = target - np.array([joint_value(closing, pose, joint) for joint in joints])
        missing = np.where(turns, (missing + np.pi) % (2 * np.pi) - np.pi, missing)
        if max(abs(value).max(initial=0.0), abs(missing).max()) < CLOSED:
            return pose
        system = np.vstack([by_twist, *(row(pose) for row in drivers)])
        pose = closing.moved(pose, np.linalg.lstsq(system, np.append(-value, missing), rcond=RANK)[0])
    names = joined(chain.joint_title(joint) for joint in joints)
    values = joined(message("{value:.6g}", value=float(value)) for value in target)
    raise LinkageError(
        "{joints} does not reach {values}" if len(joints) == 1 else "{joints} do not reach {values}",
        joints=names,
        values=values,
    )


def _driving_row(closing: Closing, joint: int) -> Callable[[Reals], Reals]:
    """The derivative of the joint's value by the motion: its axis as a functional of the relative twist."""
    k = next(k for k, tie in enumerate(closing.ties) if tie.joint == joint)
    tie = closing.ties[k]
    turns = closing.mechanism.chain.joints[joint].pair.is_turning

    def row(pose: Reals) -> Reals:
        frame = pose[tie.first] @ tie.on_first
        functional = np.zeros(6)
        if turns:
            functional[:3] = frame[:3, 2]
        else:
            far = (pose[tie.second] @ tie.on_second)[:3, 3]
            functional[:3], functional[3:] = np.cross(far, frame[:3, 0]), frame[:3, 0]
        by_link = np.zeros((len(pose), len(closing.columns)))
        by_link[tie.second] += functional[closing.columns]
        by_link[tie.first] -= functional[closing.columns]
        flat: Reals = by_link[closing.moving].ravel()
        return flat

    return row
