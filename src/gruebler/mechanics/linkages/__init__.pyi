from .elements import (
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    LinkPoint,
    NonCircular,
    Outline,
    Pin,
    Pose2D,
    Wheel,
)
from .gear_trains import linkage_of_train, train_of
from .lower_pairs import has_only_lower_pairs, with_lower_pairs
from .model import Linkage

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
    "Outline",
    "Pin",
    "Pose2D",
    "Wheel",
    "has_only_lower_pairs",
    "linkage_of_train",
    "train_of",
    "with_lower_pairs",
]
