"""Structure pictures of chains and mechanisms, and their graphs."""

from gruebler.drawing.structure.block import draw_block
from gruebler.drawing.structure.graphs import draw_contracted, draw_graph, draw_loops
from gruebler.drawing.structure.picture import PlacedChain, draw_structure, paint, place_joints
from gruebler.drawing.structure.side_view import draw_side_view

__all__ = [
    "PlacedChain",
    "draw_block",
    "draw_contracted",
    "draw_graph",
    "draw_loops",
    "draw_side_view",
    "draw_structure",
    "paint",
    "place_joints",
]
