from . import (
    canvas,
    designs,
    linkage,
    machines,
    structure,
)
from .values import Animation, Picture, animate, draw, plot

__all__ = [
    "Animation",
    "Picture",
    "animate",
    "canvas",
    "designs",
    "draw",
    "linkage",
    "machines",
    "plot",
    "structure",
]
