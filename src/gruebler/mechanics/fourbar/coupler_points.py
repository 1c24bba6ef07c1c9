"""Named points of a coupler, given along it and to its left."""

from __future__ import annotations

from collections.abc import Mapping

CouplerPoints = Mapping[str, tuple[float, float]]


def on_coupler(points: CouplerPoints | None) -> dict[str, tuple[str, float, float]]:
    """The points as `Linkage` takes them: each with the name of its link."""
    return {name: ("coupler", u, v) for name, (u, v) in (points or {}).items()}
