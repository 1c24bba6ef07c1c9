"""From the usual lengths to a linkage: coordinates of links, names, structure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from gruebler.linkages.model import Linkage
from gruebler.mechanism import Mechanism

if TYPE_CHECKING:
    from gruebler.linkages.four_bar import FourBar
    from gruebler.linkages.inverted_slider_crank import InvertedSliderCrank
    from gruebler.linkages.slider_crank import SliderCrank

__all__ = ["four_bar_linkage", "inverted_slider_crank_linkage", "slider_crank_linkage"]

CouplerPoints = Mapping[str, tuple[float, float]]

_FOUR_BAR = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); drive=R(frame-crank)"
_SLIDER_CRANK = "R(frame-crank) R(crank-coupler) R(coupler-slider) P(frame-slider); drive=R(frame-crank)"
_INVERTED = "R(frame-crank) R(crank-coupler) P(coupler-block) R(frame-block); drive=R(frame-crank)"


def four_bar_linkage(size: FourBar, points: CouplerPoints | None = None, unit: str = "mm") -> Linkage:
    """Frame, crank, coupler, rocker; coupler points (u along AB, v to the left)."""
    return Linkage(
        Mechanism.parse(_FOUR_BAR),
        {
            "frame": {"R(frame-crank)": (0, 0), "R(frame-rocker)": (size.d, 0)},
            "crank": {"R(frame-crank)": (0, 0), "R(crank-coupler)": (size.a, 0)},
            "coupler": {"R(crank-coupler)": (0, 0), "R(coupler-rocker)": (size.b, 0)},
            "rocker": {"R(frame-rocker)": (0, 0), "R(coupler-rocker)": (size.c, 0)},
        },
        _on_coupler(points),
        unit=unit,
        outputs=["rocker"],
    )


def slider_crank_linkage(size: SliderCrank, points: CouplerPoints | None = None, unit: str = "mm") -> Linkage:
    """Frame, crank, coupler (connecting rod), slider; the slider's way is counted from below the crank's pivot."""
    return Linkage(
        Mechanism.parse(_SLIDER_CRANK),
        {
            "frame": {"R(frame-crank)": (0, 0), "P(frame-slider)": (0, size.e, 0)},
            "crank": {"R(frame-crank)": (0, 0), "R(crank-coupler)": (size.a, 0)},
            "coupler": {"R(crank-coupler)": (0, 0), "R(coupler-slider)": (size.b, 0)},
            "slider": {"R(coupler-slider)": (0, 0), "P(frame-slider)": (0, 0, 0)},
        },
        _on_coupler(points),
        unit=unit,
        outputs=["slider"],
    )


def inverted_slider_crank_linkage(
    size: InvertedSliderCrank, points: CouplerPoints | None = None, unit: str = "mm"
) -> Linkage:
    """Frame, crank, coupler (a rod through the block), block swivelling about B0; points (u from A, v)."""
    return Linkage(
        Mechanism.parse(_INVERTED),
        {
            "frame": {"R(frame-crank)": (0, 0), "R(frame-block)": (size.d, 0)},
            "crank": {"R(frame-crank)": (0, 0), "R(crank-coupler)": (size.a, 0)},
            "coupler": {"R(crank-coupler)": (0, 0), "P(coupler-block)": (0, size.e, 0)},
            "block": {"R(frame-block)": (0, 0), "P(coupler-block)": (0, 0, 0)},
        },
        _on_coupler(points),
        unit=unit,
        outputs=["block"],
    )


def _on_coupler(points: CouplerPoints | None) -> dict[str, tuple[str, float, float]]:
    return {name: ("coupler", u, v) for name, (u, v) in (points or {}).items()}
