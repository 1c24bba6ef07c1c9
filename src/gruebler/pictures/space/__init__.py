"""Linkages in space and on the sphere to scale, in isometric or oblique view, still and moving."""

from gruebler.pictures.space.animation import animate_spatial
from gruebler.pictures.space.picture import draw_spatial

__all__ = ["animate_spatial", "draw_spatial"]
