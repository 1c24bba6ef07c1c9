from .crank_motion import CrankMotion, CrankRates
from .extremes import CrankRange, DeadCentres, StrokeTimes
from .four_bar import FourBar
from .four_bar_types import (
    FOUR_BAR_TYPES,
    Grashof,
    LengthRange,
    LinkageType,
    grashof,
    turning_ranges,
    types_along,
)
from .inversions import SizedInversion, double_slide_inversions, sized_inversions
from .inverted_slider_crank import InvertedSliderCrank
from .slider_crank import SliderCrank, StrokeMidpoint
from .slider_crank_types import INVERTED_SLIDER_CRANK_TYPES, SLIDER_CRANK_TYPES

__all__ = [
    "FOUR_BAR_TYPES",
    "INVERTED_SLIDER_CRANK_TYPES",
    "SLIDER_CRANK_TYPES",
    "CrankMotion",
    "CrankRange",
    "CrankRates",
    "DeadCentres",
    "FourBar",
    "Grashof",
    "InvertedSliderCrank",
    "LengthRange",
    "LinkageType",
    "SizedInversion",
    "SliderCrank",
    "StrokeMidpoint",
    "StrokeTimes",
    "double_slide_inversions",
    "grashof",
    "sized_inversions",
    "turning_ranges",
    "types_along",
]
