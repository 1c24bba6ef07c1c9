"""Linkages: mechanisms with dimensions, and what closed forms know of the classical ones.

`Linkage` holds the sizes of any planar mechanism; docs/theory/kinematics.md has the conventions. `FourBar`,
`SliderCrank` and `InvertedSliderCrank` are the doors by the usual lengths, with types (`grashof`), dead centres,
transmission angles and closed forms of their motion: docs/theory/four-bar.md.
"""

from gruebler.linkages.crank_motion import CrankMotion, InvertedMotion, Track
from gruebler.linkages.elements import (
    Circle,
    Cross,
    Disc,
    Driver,
    Element,
    Line,
    Named,
    NonCircular,
    Pin,
    Place,
    Wheel,
)
from gruebler.linkages.extremes import Arc, DeadCentre, DeadCentres, StrokeTimes, Transmission, TransmissionAngle
from gruebler.linkages.files import linkage_from_json, read_linkage, to_json, to_toml, write_linkage
from gruebler.linkages.four_bar import FourBar
from gruebler.linkages.grashof import (
    FOUR_BAR_TYPES,
    Grashof,
    LengthRange,
    LinkageType,
    grashof,
    turning_ranges,
    types_along,
)
from gruebler.linkages.inverted_slider_crank import InvertedSliderCrank
from gruebler.linkages.lower_pairs import with_lower_pairs
from gruebler.linkages.model import Linkage
from gruebler.linkages.offset import INVERTED_SLIDER_CRANK_TYPES, SLIDER_CRANK_TYPES
from gruebler.linkages.slider_crank import SliderCrank, StrokeMiddle

__all__ = [
    "FOUR_BAR_TYPES",
    "INVERTED_SLIDER_CRANK_TYPES",
    "SLIDER_CRANK_TYPES",
    "Arc",
    "Circle",
    "CrankMotion",
    "Cross",
    "DeadCentre",
    "DeadCentres",
    "Disc",
    "Driver",
    "Element",
    "FourBar",
    "Grashof",
    "InvertedMotion",
    "InvertedSliderCrank",
    "LengthRange",
    "Line",
    "Linkage",
    "LinkageType",
    "Named",
    "NonCircular",
    "Pin",
    "Place",
    "SliderCrank",
    "StrokeMiddle",
    "StrokeTimes",
    "Track",
    "Transmission",
    "TransmissionAngle",
    "Wheel",
    "grashof",
    "linkage_from_json",
    "read_linkage",
    "to_json",
    "to_toml",
    "turning_ranges",
    "types_along",
    "with_lower_pairs",
    "write_linkage",
]
