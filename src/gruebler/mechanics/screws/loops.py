"""Loops of skew axes that move although almost all are rigid: Bennett, Bricard, Sarrus, Schatz, two cross joints."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.mechanics.screws.joint_geometry import SAME, JointGeometry, Reason
from gruebler.structure.chain.spaces import Space


def _turning_loop(s: JointGeometry, joints: int) -> list[int]:
    """The joints in order, if the chain is in space and one loop of so many turning joints; else none."""
    ring = s.ring() if s.chain.space is Space.SPATIAL else None
    return ring if ring is not None and len(ring) == joints and s.turning == sorted(ring) else []


def bennett(s: JointGeometry) -> Iterator[Reason]:
    """Four skew axes, opposite links equal, length over sine of the twist the same for all, no offsets."""
    ring = _turning_loop(s, 4)
    if not ring:
        return
    bars = [_bar(s, ring[k], ring[(k + 1) % 4]) for k in range(4)]
    if any(bar is None for bar in bars):
        return
    known = [bar for bar in bars if bar is not None]
    lengths, sines = np.array([bar[0] for bar in known]), np.array([bar[1] for bar in known])
    offsets = [np.linalg.norm(known[k][2][0] - known[k - 1][2][1]) for k in range(4)]
    even = max(abs(lengths[:2] - lengths[2:]).max(), abs(sines[:2] - sines[2:]).max())
    if max(*offsets, even, abs(lengths[0] * sines[1] - lengths[1] * sines[0])) < 10 * SAME and min(lengths) > SAME:
        yield Reason("bennett", s.chain.links, tuple(ring))


def _bar(s: JointGeometry, first: int, second: int) -> tuple[float, float, tuple[Reals, Reals]] | None:
    """The distance of two axes, the sine of their angle, and the feet of their common normal; None if parallel."""
    u, v, p, q = s.axis(first), s.axis(second), s.at(first), s.at(second)
    normal = np.cross(u, v)
    sine = float(np.linalg.norm(normal))
    if sine < SAME:
        return None
    a, b, _ = np.linalg.solve(np.stack([u, -v, normal], axis=1), q - p)
    feet = p + a * u, q + b * v
    return float(np.linalg.norm(feet[0] - feet[1])), sine, feet


def bricard(s: JointGeometry) -> Iterator[Reason]:
    """Six turning joints in a loop that a half-turn, or a mirror, takes to itself: Bricard's movable octahedra."""
    ring = _turning_loop(s, 6)
    if not ring:
        return
    bars = [_bar(s, ring[k], ring[(k + 1) % 6]) for k in range(6)]
    feet = np.array([bar[2] for bar in bars if bar is not None])
    if len(feet) < 6:
        return
    if _maps(feet, np.roll(feet, 3, axis=0), 1):
        yield Reason("line_symmetric", (), tuple(ring))
    # a mirror takes bar k to bar c - k - 1 and swaps its ends; axis k lies in it if 2k = c, and has no offset then
    offsets = np.linalg.norm(feet[:, 0] - np.roll(feet[:, 1], 1, axis=0), axis=1)
    mirrored = (c for c in (0, 2, 4) if max(offsets[c // 2], offsets[c // 2 + 3]) < 10 * SAME)
    if any(_maps(feet, feet[(c - 1 - np.arange(6)) % 6, ::-1], -1) for c in mirrored):
        yield Reason("plane_symmetric", (), tuple(ring))


def _maps(points: Reals, images: Reals, sense: int) -> bool:
    """Whether a half-turn (sense 1) or a mirror (-1) takes these points to those."""
    first, second = (p.reshape(-1, 3) - p.reshape(-1, 3).mean(axis=0) for p in (points, images))
    left, values, right = np.linalg.svd(first.T @ second)
    turn = right.T @ np.diag([1, 1, sense * np.linalg.det(left) * np.linalg.det(right)]) @ left.T
    return bool(
        values[1] > SAME and abs(first @ turn.T - second).max() < 10 * SAME and abs(np.trace(turn) + sense) < 10 * SAME
    )


def sarrus(s: JointGeometry) -> Iterator[Reason]:
    """Six axes in a loop, three and three parallel."""
    ring = _turning_loop(s, 6)
    if not ring:
        return
    for k in range(3):
        turned = ring[k:] + ring[:k]
        sides = [[s.axis(j) for j in side] for side in (turned[:3], turned[3:])]
        parallel = all(np.linalg.norm(np.cross(side[0], axis)) < SAME for side in sides for axis in side)
        if parallel and np.linalg.norm(np.cross(sides[0][0], sides[1][0])) > SAME:
            yield Reason("sarrus", (), tuple(turned))
            return


def schatz(s: JointGeometry) -> Iterator[Reason]:
    """Six axes at right angles but for two parallel shafts: lengths 0, a, a, a, 0 and √3 a, feet level, no offsets."""
    ring = _turning_loop(s, 6)
    for turned in (ring[k:] + ring[:k] for k in range(len(ring))):
        bars = [bar for bar in (_bar(s, turned[k], turned[k + 1]) for k in range(5)) if bar is not None]
        if len(bars) < 5 or np.linalg.norm(np.cross(s.axis(turned[0]), s.axis(turned[5]))) > SAME:
            continue
        twists = [s.axis(turned[k]) @ s.axis(turned[k + 1]) for k in range(5)]
        lengths, length = np.array([bar[0] for bar in bars]), bars[2][0]
        offsets = [np.linalg.norm(bars[k][2][1] - bars[k + 1][2][0]) for k in range(4)]
        across = bars[4][2][1] - bars[0][2][0]
        sizes = lengths - [0, length, length, length, 0]
        shafts = abs(np.linalg.norm(across) - np.sqrt(3) * length), abs(across @ s.axis(turned[0]))
        if max(*np.abs(twists), *offsets, *np.abs(sizes), *shafts) < 10 * SAME < length:
            yield Reason("schatz", (), tuple(turned))


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True)
class Hooke:
    """A Hooke's joint: its centre, the two links that it joins, and its joints."""

    centre: Reals
    shafts: frozenset[str]
    joints: tuple[int, ...]


def _hookes_joints(s: JointGeometry) -> Iterator[Hooke]:
    """The cross joints, and the crosses that are links: two turning joints whose axes meet and are not parallel."""
    for k in s.crosses:
        yield Hooke(s.at(k), frozenset(s.chain.joints[k].links), (k,))
    turning = s.turning
    for link in s.chain.links:
        joints = [k for k, joint in enumerate(s.chain.joints) if link in joint.links]
        if len(joints) != 2 or not set(joints) <= set(turning) or any(len(s.chain.joints[k].links) > 2 for k in joints):
            continue
        bar = _bar(s, *joints)
        if bar is not None and bar[0] < SAME:
            shafts = {name for k in joints for name in s.chain.joints[k].links} - {link}
            if len(shafts) == 2:
                yield Hooke(bar[2][0], frozenset(shafts), (joints[0], joints[1]))


def cardan(s: JointGeometry) -> Iterator[Reason]:
    """Two Hooke's joints, each with its centre on the axis of a bearing of its shaft: both centres stand still."""
    if s.chain.space is not Space.SPATIAL:
        return
    hookes = [
        (j, hooke)
        for hooke in _hookes_joints(s)
        for j in s.turning
        if j not in hooke.joints and set(s.chain.joints[j].links) & hooke.shafts and s.on_axis(j, hooke.centre)
    ]
    reasons = []
    for (j, first), (i, second) in itertools.combinations(hookes, 2):
        shaft = first.shafts & second.shafts
        bearings = set(s.chain.joints[j].links) & set(s.chain.joints[i].links)
        if first.joints != second.joints and j != i and shaft and bearings:
            reasons.append(Reason("cardan", tuple(sorted(shaft)), (j, *first.joints, *second.joints, i)))
    # Of two crosses that are links the frame is a shaft as well, seen from the shaft between them: said once.
    frame = s.closing.mechanism.frame
    yield from [reason for reason in reasons if frame not in reason.links] or reasons
