"""Linkages: mechanisms with dimensions.

`Linkage` holds the sizes of any planar mechanism; docs/theory/kinematics.md has the conventions.
"""

from gruebler.linkages.elements import Circle, Cross, Disc, Driver, Element, Line, Named, NonCircular, Pin, Place, Wheel
from gruebler.linkages.lower_pairs import with_lower_pairs
from gruebler.linkages.model import Linkage

__all__ = [
    "Circle",
    "Cross",
    "Disc",
    "Driver",
    "Element",
    "Line",
    "Linkage",
    "Named",
    "NonCircular",
    "Pin",
    "Place",
    "Wheel",
    "with_lower_pairs",
]
