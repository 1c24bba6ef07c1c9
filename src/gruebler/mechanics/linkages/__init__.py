"""Linkages: mechanisms with dimensions.

`Linkage` holds the sizes of any planar mechanism; docs/theory/kinematics.md has the conventions.
"""

from gruebler.mechanics.linkages.elements import (
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    LinkPoint,
    NonCircular,
    Pin,
    Pose2D,
    Wheel,
)
from gruebler.mechanics.linkages.gear_trains import linkage_of_train, train_of
from gruebler.mechanics.linkages.lower_pairs import with_lower_pairs
from gruebler.mechanics.linkages.model import Linkage

__all__ = [
    "CamDisc",
    "Circle",
    "Element",
    "GenevaDriver",
    "GenevaWheel",
    "Line",
    "LinkPoint",
    "Linkage",
    "NonCircular",
    "Pin",
    "Pose2D",
    "Wheel",
    "linkage_of_train",
    "train_of",
    "with_lower_pairs",
]
