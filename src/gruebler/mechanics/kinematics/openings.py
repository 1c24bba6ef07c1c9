"""How well the poses of a motion close the joints."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.kinematics.contacts import contact_opening, point_at
from gruebler.mechanics.kinematics.link_poses import LinkPoses
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.wheels import round_joints


def closure_error(poses: LinkPoses, released: Iterable[int]) -> float:
    """The largest distance by which a joint of any pose is open, relative to the linkage's size.

    Looked at are the linkage with lower pairs, what is round in the linkage as given, and the joints released in it.
    """
    linkage, lower = poses.linkage, poses.lower_linkage
    held = set(range(len(lower.mechanism.chain.joints))) - set(round_joints(lower.mechanism, lower.elements))
    contacts = (contact_opening(poses, k) / linkage.size for k in round_joints(linkage.mechanism, linkage.elements))
    gaps = [joint_openings(poses, part, k) for part, numbers in ((lower, held), (linkage, released)) for k in numbers]
    return max([0.0, *contacts, *(float(gap.max(initial=0.0)) for gap in gaps)])


def joint_openings(poses: LinkPoses, linkage: Linkage, number: int) -> Reals:
    """By how much a joint of pins and lines is open in each row, in sizes and radians; (rows,).

    The linkage is that of the motion, or the one with lower pairs.
    """
    joint = linkage.mechanism.chain.joints[number]
    openings = np.zeros(len(poses.turns))
    for first, other in ((joint.links[0], other) for other in joint.links[1:]):
        if not linkage.elements[number, first].is_line:
            first, other = other, first  # noqa: PLW2901
        element, other_element = linkage.elements[number, first], linkage.elements[number, other]
        gap = (
            point_at(poses, other, other_element.x, other_element.y) - point_at(poses, first, element.x, element.y)
        ) / linkage.size
        if element.is_line:
            line = poses.turns[:, poses.link_index(first)] * rect(1, element.direction)
            if not joint.pair.slides_two_ways:
                openings = np.maximum(openings, np.abs((np.conj(line) * gap).imag))
            if other_element.is_line:
                openings = np.maximum(
                    openings, np.abs(poses.turns[:, poses.link_index(other)] * rect(1, other_element.direction) - line)
                )
        else:
            openings = np.maximum(openings, np.abs(gap))
    return openings
