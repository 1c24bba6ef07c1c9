from .closing import Closing
from .finite_mobility import Evidence, FiniteMobility
from .following import joint_value
from .instant_mobility import InstantMobility
from .joint_geometry import Reason
from .joint_places import JointPlace
from .mobility_report import Freedoms, freedoms
from .model import SpatialLinkage
from .motion_groups import MotionGroup, common_group
from .rigid_motions import adjoint, exponential, twist_matrix

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
    "freedoms",
    "joint_value",
    "twist_matrix",
]
