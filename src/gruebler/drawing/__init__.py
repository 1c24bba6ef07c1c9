"""Pictures: structure pictures of chains and mechanisms, their graphs, galleries; SVG without any dependency."""

from gruebler.drawing.figure import Figure
from gruebler.drawing.gallery import Item, Section, gallery_html
from gruebler.drawing.graphs import draw_contracted, draw_graph, draw_loops
from gruebler.drawing.structure import Placed, draw, paint, place

__all__ = [
    "Figure",
    "Item",
    "Placed",
    "Section",
    "draw",
    "draw_contracted",
    "draw_graph",
    "draw_loops",
    "gallery_html",
    "paint",
    "place",
]
