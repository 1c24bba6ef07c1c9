from .bennett import Bennett
from .circuits import SpatialCircuit, circuit
from .crank_output import OutputMotion
from .drive_ranges import SpatialRange, drive_range
from .measuring import JointRange, SpatialMeasures, measures
from .modes import SpatialModes, assembly_modes
from .motion import SpatialMotion, SpatialStop
from .moving import move
from .rotating import rotatability
from .rssr import RSSR
from .spherical_four_bar import SphericalFourBar
from .swash_plate import SwashPlate
from .universal_joint import DoubleUniversalJoint, UniversalJoint

__all__ = [
    "RSSR",
    "Bennett",
    "DoubleUniversalJoint",
    "JointRange",
    "OutputMotion",
    "SpatialCircuit",
    "SpatialMeasures",
    "SpatialModes",
    "SpatialMotion",
    "SpatialRange",
    "SpatialStop",
    "SphericalFourBar",
    "SwashPlate",
    "UniversalJoint",
    "assembly_modes",
    "circuit",
    "drive_range",
    "measures",
    "move",
    "rotatability",
]
