"""Linkages given by the screws of their joints in one position, planar, spherical or spatial.

A `SpatialLinkage` is a mechanism whose joints have places; `Closing` holds the equations that close its joints, with
their Jacobian; `follow` moves one of its joints; `common_group` finds the group of motions that no link ever leaves.
docs/theory/freedoms.md has the conventions.
"""

from gruebler.screws.closing import Closing
from gruebler.screws.following import follow, joint_value
from gruebler.screws.groups import Group, common_group
from gruebler.screws.model import SpatialLinkage
from gruebler.screws.motions import adjoint, exponential, hat
from gruebler.screws.places import JointPlace

__all__ = [
    "Closing",
    "Group",
    "JointPlace",
    "SpatialLinkage",
    "adjoint",
    "common_group",
    "exponential",
    "follow",
    "hat",
    "joint_value",
]
