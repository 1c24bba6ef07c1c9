"""Figures as values, written as SVG without any dependency; panels, labels, moving pictures, files."""

from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.gallery import Item, Section, gallery_html

__all__ = ["Figure", "Item", "Section", "gallery_html"]
