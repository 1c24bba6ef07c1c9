"""The input of the layers of a linkage picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from gruebler.base.text import Message
from gruebler.pictures.canvas.shapes import Shape
from gruebler.pictures.linkage.posed_linkage import PosedLinkage


class LayerContext(NamedTuple):
    """The input of a layer."""

    posed: PosedLinkage
    output: str | None
    """The output link or joint; None for the linkage's own."""
    drawn: Sequence[Shape]
    """The shapes drawn before, which texts avoid."""
    lang: str = "en"


class Layer(NamedTuple):
    """What can be shown in addition."""

    title: Message
    shapes: Callable[[LayerContext], list[Shape]]
