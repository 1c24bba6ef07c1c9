"""Linkages given by the screws of their joints, and the mobility of linkages with dimensions.

A `SpatialLinkage` is a mechanism whose joints have places; `Closing` holds the equations that close its joints,
with their Jacobian. `freedoms` takes it, or a planar `Linkage`, and compares the mobility by count, at almost all
sizes, at the pose, and finite. docs/theory/freedoms.md has the conventions, the theorems and what may err.
"""

from gruebler.mechanics.screws.closed_poses import has_only_lower_pairs
from gruebler.mechanics.screws.closing import Closing
from gruebler.mechanics.screws.finite_mobility import Evidence, FiniteMobility
from gruebler.mechanics.screws.following import follow_joint, joint_value
from gruebler.mechanics.screws.instant_mobility import InstantMobility
from gruebler.mechanics.screws.joint_geometry import Reason
from gruebler.mechanics.screws.joint_places import JointPlace
from gruebler.mechanics.screws.mobility_report import Freedoms, freedoms
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.motion_groups import MotionGroup, common_group
from gruebler.mechanics.screws.rigid_motions import adjoint, exponential, twist_matrix

__all__ = [
    "Closing",
    "Evidence",
    "FiniteMobility",
    "Freedoms",
    "InstantMobility",
    "JointPlace",
    "MotionGroup",
    "Reason",
    "SpatialLinkage",
    "adjoint",
    "common_group",
    "exponential",
    "follow_joint",
    "freedoms",
    "has_only_lower_pairs",
    "joint_value",
    "twist_matrix",
]
