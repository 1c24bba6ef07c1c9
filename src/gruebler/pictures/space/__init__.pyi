from .animation import animate_spatial
from .picture import draw_spatial

__all__ = ["animate_spatial", "draw_spatial"]
