"""The four-bar, the slider-crank and the inverted slider-crank in closed form.

Types (`grashof`), dead centres, transmission angles, motion: docs/theory/four-bar.md.
"""

from gruebler.fourbar.crank_motion import CrankMotion, CrankRates, InvertedMotion
from gruebler.fourbar.extremes import CrankRange, DeadCentres, StrokeTimes
from gruebler.fourbar.four_bar import FourBar
from gruebler.fourbar.grashof import (
    FOUR_BAR_TYPES,
    Grashof,
    LengthRange,
    LinkageType,
    grashof,
    turning_ranges,
    types_along,
)
from gruebler.fourbar.inversions import SizedInversion, double_slide_inversions, sized_inversions
from gruebler.fourbar.inverted_slider_crank import InvertedSliderCrank
from gruebler.fourbar.slider_crank import SliderCrank, StrokeMidpoint
from gruebler.fourbar.slider_crank_types import INVERTED_SLIDER_CRANK_TYPES, SLIDER_CRANK_TYPES

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
    "InvertedMotion",
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
