"""A linkage followed with all its joints closed at once: another way than that of the solvers along a drive."""

import numpy as np

from gruebler.mechanics.screws import Closing
from gruebler.mechanics.screws.following import follow_joints


def follow_joint(linkage, joint, values):
    """The poses (values, n, 4, 4) in which a revolute or prismatic joint has these values, from the reference pose."""
    closing = Closing.of(linkage)
    number = linkage.mechanism.chain.joint_number(joint)
    return np.array(follow_joints(closing, closing.reference, [number], np.reshape(values, (-1, 1))))
