"""The four-bar, the slider-crank and the inverted slider-crank in closed form.

Types (`grashof`), dead centres, transmission angles, motion: docs/theory/four-bar.md.
"""

from gruebler.mechanics.fourbar.crank_motion import CrankMotion, CrankRates
from gruebler.mechanics.fourbar.extremes import CrankRange, DeadCentres, StrokeTimes
from gruebler.mechanics.fourbar.four_bar import FourBar
from gruebler.mechanics.fourbar.four_bar_types import (
    FOUR_BAR_TYPES,
    Grashof,
    LengthRange,
    LinkageType,
    grashof,
    turning_ranges,
    types_along,
)
from gruebler.mechanics.fourbar.inversions import SizedInversion, double_slide_inversions, sized_inversions
from gruebler.mechanics.fourbar.inverted_slider_crank import InvertedSliderCrank
from gruebler.mechanics.fourbar.slider_crank import SliderCrank, StrokeMidpoint
from gruebler.mechanics.fourbar.slider_crank_types import INVERTED_SLIDER_CRANK_TYPES, SLIDER_CRANK_TYPES

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
