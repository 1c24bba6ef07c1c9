"""Rods between two balls: their spin is idle, and is fixed by a rule, the shortest turn from the reference pose.

With the directions u of the rod in the reference pose and v now, s = u + v, that turn is two half turns, about u and
then about s. It depends on v alone, not on the way there. Where the rod points back, s is nearly 0, and the way leads
by a direction across u.
"""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.joint_places import JointPlace, joint_axes
from gruebler.mechanics.screws.rigid_motions import exponential, inverse_motion
from gruebler.mechanics.space.bodies import Cross
from gruebler.mechanics.space.power_series import product, reciprocal
from gruebler.mechanics.space.tree import ClosureTree
from gruebler.structure.chain.spaces import Space

_OPPOSITE = 0.03  # radians: the nearer, the faster the shortest turn spins, and the fewer digits its rates have


def place_rods(tree: ClosureTree, poses: Reals) -> None:
    """Put the rods into poses (..., links, 4, 4) of the other links."""
    place_rods_of_series(tree, poses[None])


def place_rods_of_series(tree: ClosureTree, poses: Reals) -> None:
    """Put the rods into power series of poses, (orders, ..., links, 4, 4)."""
    for rod in tree.rods:
        a, b = _ball(tree, rod.joints[0]), _ball(tree, rod.joints[1])
        now = [_seen(poses[..., link, :, :], p) for link, p in ((rod.first, a), (rod.second, b))]
        if rod.cross is not None:
            poses[0, ..., rod.link, :, :] = _at_cross(
                rod.cross, rod.balls[1], poses[0, ..., rod.first, :, :], now[1][0]
            )
        else:
            poses[..., rod.link, :, :] = _turned(*rod.balls, now[0], now[1])


def _ball(tree: ClosureTree, joint: int) -> Reals:
    at = (np.array(tree.linkage.places[joint].at) - tree.linkage.centre) / tree.linkage.size
    return np.asarray(at)


def _seen(poses: Reals, point: Reals) -> Reals:
    return np.asarray(poses[..., :3, :3] @ point + poses[..., :3, 3])


def _turned(a: Reals, b: Reals, first: Reals, second: Reals) -> Reals:
    """The series of poses that takes a and b to these points, (orders, ..., 3) each."""
    length = float(np.linalg.norm(b - a))
    u, v = (b - a) / length, (second - first) / length
    back = np.linalg.norm(u + v[0], axis=-1) < _OPPOSITE
    across = joint_axes(JointPlace(x=tuple(u.tolist())), Space.SPATIAL)[:, 1]
    turn = _shortest(np.where(back[..., None], across, u), v)
    if back.any():
        turn = np.where(back[..., None, None], turn @ _shortest(u, across[None])[0], turn)
    pose = np.zeros((*v.shape[:-1], 4, 4))
    pose[..., :3, :3] = turn
    pose[..., :3, 3] = first - turn @ a
    pose[0, ..., 3, 3] = 1
    return pose


def _shortest(u: Reals, v: Reals) -> Reals:
    """The series of the shortest turn from a direction to a series of directions: half turns about u and u + v."""
    s = v.copy()
    s[0] += u
    square = product(s[..., None, :], s[..., :, None], np.matmul)[..., 0, 0]
    turn = 2 * product(
        product(s[..., :, None], s[..., None, :], np.multiply), reciprocal(square)[..., None, None], np.multiply
    )
    turn[0] -= np.eye(3)
    return np.asarray(turn @ (2 * u[..., :, None] * u[..., None, :] - np.eye(3)))


def _at_cross(cross: Cross, ball: Reals, body: Reals, now: Reals) -> Reals:
    """The poses of a rod whose cross joint is on a body (..., 4, 4) and whose ball is at places (..., 3).

    From the body's frame of the joint to the rod's: turns about x and y, or back if the rod is the first link. Of the
    two ways in which the cross closes it is that of the reference pose.
    """
    frame = body @ cross.frame
    there = np.swapaxes(frame[..., :3, :3], -1, -2) @ (now - frame[..., :3, 3])[..., None]
    there = there[..., 0] / np.linalg.norm(there, axis=-2)
    here = (inverse_motion(cross.on_rod) @ np.append(ball, 1.0))[:3]
    here = np.broadcast_to(here / np.linalg.norm(here), there.shape)
    start, end = (there, here) if cross.is_first else (here, there)
    side = np.copysign(1.0, here[..., 2])
    z = side * np.sqrt(np.maximum(start[..., 0] ** 2 + start[..., 2] ** 2 - end[..., 0] ** 2, 0.0))
    second = np.arctan2(start[..., 2], start[..., 0]) - np.arctan2(z, end[..., 0])
    first = np.arctan2(end[..., 2], end[..., 1]) - np.arctan2(z, start[..., 1])
    axes = np.eye(3)
    turn = exponential(_about(axes[0], first)) @ exponential(_about(axes[1], second))
    return np.asarray(frame @ (inverse_motion(turn) if cross.is_first else turn) @ inverse_motion(cross.on_rod))


def _about(axis: Reals, angle: Reals) -> Reals:
    return np.concatenate([angle[..., None] * axis, np.zeros((*angle.shape, 3))], axis=-1)
