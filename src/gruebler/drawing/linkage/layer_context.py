"""What the layers of a linkage picture are drawn on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from gruebler.drawing.canvas.shapes import Shape
from gruebler.drawing.linkage.posed_linkage import PosedLinkage

__all__ = ["Layer", "LayerContext"]


class LayerContext(NamedTuple):
    """What a layer is drawn on."""

    posed: PosedLinkage
    output: str | None
    """The link or joint that is looked at; None for the linkage's own."""
    drawn: Sequence[Shape]
    """What is there already; texts keep clear of it."""
    lang: str = "en"


Layer = Callable[[LayerContext], list[Shape]]
