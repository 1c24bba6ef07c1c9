from .animation import animate_spatial
from .picture import draw_spatial
from .plots import plot_point, plot_spatial

__all__ = ["animate_spatial", "draw_spatial", "plot_point", "plot_spatial"]
