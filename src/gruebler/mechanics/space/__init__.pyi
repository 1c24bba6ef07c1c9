from .bennett import Bennett
from .crank_output import OutputMotion
from .measuring import SpatialMeasures, measures
from .motion import SpatialMotion, SpatialStop
from .moving import move
from .rssr import RSSR
from .spherical_four_bar import SphericalFourBar
from .universal_joint import DoubleUniversalJoint, UniversalJoint

__all__ = [
    "RSSR",
    "Bennett",
    "DoubleUniversalJoint",
    "OutputMotion",
    "SpatialMeasures",
    "SpatialMotion",
    "SpatialStop",
    "SphericalFourBar",
    "UniversalJoint",
    "measures",
    "move",
]
