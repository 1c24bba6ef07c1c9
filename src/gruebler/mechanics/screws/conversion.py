"""What stands for a linkage in space wherever one is asked for."""

from __future__ import annotations

from typing import Protocol

from gruebler.mechanics.screws.model import SpatialLinkage


class HasSpatialLinkage(Protocol):
    """Lengths that make a linkage in space: `RSSR`, `Bennett`, `SphericalFourBar`, `SwashPlate`."""

    def linkage(self) -> SpatialLinkage:
        """The linkage of these lengths."""
        ...


SpatialLike = SpatialLinkage | HasSpatialLinkage
