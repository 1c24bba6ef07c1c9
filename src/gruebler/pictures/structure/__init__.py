"""Structure pictures of chains and mechanisms, and their graphs."""

from gruebler.pictures.structure.block import draw_block
from gruebler.pictures.structure.graphs import draw_contracted, draw_graph, draw_loops
from gruebler.pictures.structure.picture import PlacedChain, draw_structure, held_outlines, paint, place_joints
from gruebler.pictures.structure.side_view import draw_side_view

__all__ = [
    "PlacedChain",
    "draw_block",
    "draw_contracted",
    "draw_graph",
    "draw_loops",
    "draw_side_view",
    "draw_structure",
    "held_outlines",
    "paint",
    "place_joints",
]
