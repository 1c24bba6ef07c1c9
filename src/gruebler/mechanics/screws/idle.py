"""Idle freedoms with dimensions: what moves for itself alone because axes coincide.

The rod of a ram that turns in its barrel spins for itself if the axis of the barrel passes through the two balls.
A link whose neighbours are held may move as its lower pairs allow at once. Each of them allows a group of motions, and
the intersection of groups is a group: what the screws have in common at a pose is a motion, not only a velocity, and it
is the same in every pose. A roller spins for itself if its round contour has its centre on the axis of its pin and no
teeth: then it slides on what it touches. docs/theory/freedoms.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.closing import Closing
from gruebler.mechanics.screws.instant_mobility import InstantMobility
from gruebler.mechanics.screws.motion_groups import screws_of
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mobility.idle import IdleCondition, IdleFreedom, between_balls

_SAME = 1e-7  # lines and directions that differ by less, in sizes, coincide: ten times what a pose may be open by


def idle_parts(instant: InstantMobility, generic: Sequence[IdleFreedom]) -> tuple[IdleFreedom, ...]:
    """The idle freedoms of a linkage in a pose: those of almost all sizes and those of coinciding axes.

    Args:
        instant: the linkage in a pose.
        generic: what the structure alone tells (`MobilityReport.idle_freedoms`).

    Cost O(joint elements), a small singular value decomposition for each link.
    """
    chain, frame = instant.closing.mechanism.chain, instant.closing.mechanism.frame
    known = {idle.links: idle for idle in generic if idle.when is IdleCondition.ALWAYS}
    alone = {}
    for link in chain.links:
        joints = [k for k, joint in enumerate(chain.joints) if link in joint.links]
        if link != frame and len(joints) > 1 and all(chain.joints[k].pair.is_group for k in joints):
            alone[link] = _common([screws_of(instant.closing, instant.pose, k) for k in joints])
    freedoms = []
    for link in chain.links:
        number = max(len(alone.get(link, ())), known[(link,)].freedoms if (link,) in known else 0)
        if number or (link != frame and _is_roller(instant.closing, chain.index(link))):
            number = number or 1
            freedoms.append(IdleFreedom((link,), number, IdleCondition.ALWAYS))
    for part, balls in between_balls(chain, frame):
        spin = _common([screws_of(instant.closing, instant.pose, k) for k in balls])
        if not all(link in alone and _within(spin, alone[link]) for link in part):  # else it is the sum of their spins
            freedoms.append(IdleFreedom(part, 1, IdleCondition.ALWAYS))
    return tuple(sorted(freedoms, key=lambda idle: chain.index(idle.links[0])))


def _is_roller(closing: Closing, link: int) -> bool:
    """Whether a link turns on a pin and touches others by round contours about it alone, on which it slides."""
    chain = closing.mechanism.chain
    pins, contours = [], []
    for tie in closing.ties:
        if link in (tie.first, tie.second):
            pair, own = chain.joints[tie.joint].pair, tie.on_first if link == tie.first else tie.on_second
            if pair.is_turning:
                pins.append(own)
            elif pair.has_contours and not pair.rolls and tie.place.pressure is None and tie.place.radii is not None:
                radius = -tie.place.radii[0] if link == tie.first else tie.place.radii[1]
                if not isfinite(radius):
                    return False
                contours.append((own @ (0, radius, 0, 1), own[:3, 2]))
            else:
                return False
    if len(pins) != 1 or not contours or chain.space is Space.SPHERICAL:
        return False
    axis, at = pins[0][:3, 2], pins[0][:3, 3]
    return all(
        np.linalg.norm(np.cross(axis, along)) < _SAME and np.linalg.norm(np.cross(axis, centre[:3] - at)) < _SAME
        for centre, along in contours
    )


def _common(spaces: Sequence[Reals]) -> Reals:
    """An orthonormal basis (d, 6) of what these spaces of screws (f, 6) have in common."""
    outside = np.vstack([np.eye(6) - basis @ basis.T for basis in (np.linalg.qr(space.T)[0] for space in spaces)])
    _, values, rows = np.linalg.svd(outside)
    return rows[values < _SAME]


def _within(screws: Reals, space: Reals) -> bool:
    return bool(abs(screws - screws @ space.T @ space).max(initial=0) < 10 * _SAME)
