"""Figures as values, written as SVG without any dependency; panels, labels, moving pictures, files."""

from gruebler.drawing.canvas.figure import Figure
from gruebler.drawing.canvas.gallery import Item, Section, gallery_html

__all__ = [
    "Figure",
    "Item",
    "Section",
    "gallery_html",
]
