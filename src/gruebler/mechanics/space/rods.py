"""Rods between two balls: their spin is idle, and is fixed by a rule, the shortest turn from the reference pose.

The core places them (`core/src/space/rods.hpp`). A leg between a cross joint and a ball, which counts as a rod where
positions are counted, is placed here.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.joint_places import JointPlace, joint_axes
from gruebler.mechanics.screws.rigid_motions import exponential, inverse_motion
from gruebler.mechanics.space.bodies import Cross
from gruebler.mechanics.space.tree import ClosureTree
from gruebler.structure.chain.spaces import Space


class RodTables(NamedTuple):
    """Rods between two balls as the core takes them."""

    links: NDArray[np.int64]
    """(rods, 3): the rod, the links of its balls."""
    vectors: Reals
    """(rods, 5, 3): the balls on those links, the balls on the rod, a unit vector across it."""


def rod_tables(tree: ClosureTree) -> RodTables:
    """The rods of a tree, legs on cross joints left out."""
    rods = [rod for rod in tree.rods if rod.cross is None]
    vectors = np.zeros((len(rods), 5, 3))
    for own, rod in zip(vectors, rods, strict=True):
        along = tuple(np.subtract(rod.balls[1], rod.balls[0]).tolist())
        own[:4] = *(_ball(tree, joint) for joint in rod.joints), *rod.balls
        own[4] = joint_axes(JointPlace(x=along), Space.SPATIAL)[:, 1]
    links = np.array([(rod.link, rod.first, rod.second) for rod in rods], np.int64)
    return RodTables(links.reshape(-1, 3), vectors)


def place_rods(tree: ClosureTree, poses: Reals) -> None:
    """Put the rods into poses (rows, links, 4, 4) of the other links."""
    _core.place_rods(*rod_tables(tree), poses)
    for rod in tree.rods:
        if rod.cross is not None:
            other = poses[:, rod.second]
            now = other[:, :3, :3] @ _ball(tree, rod.joints[1]) + other[:, :3, 3]
            poses[:, rod.link] = _at_cross(rod.cross, rod.balls[1], poses[:, rod.first], now)


def _ball(tree: ClosureTree, joint: int) -> Reals:
    at = (np.array(tree.linkage.places[joint].at) - tree.linkage.centre) / tree.linkage.size
    return np.asarray(at)


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
