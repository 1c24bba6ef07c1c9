"""From the usual lengths to a linkage: coordinates of links, names, structure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    pass

__all__ = []

CouplerPoints = Mapping[str, tuple[float, float]]


def on_coupler(points: CouplerPoints | None) -> dict[str, tuple[str, float, float]]:
    return {name: ("coupler", u, v) for name, (u, v) in (points or {}).items()}
