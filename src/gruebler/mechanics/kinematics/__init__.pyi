from .batch import (
    Designs,
    Motions,
    designs,
    four_bars,
    inverted_slider_cranks,
    move_many,
    slider_cranks,
)
from .circuits import Circuit, MonotonePiece, circuit
from .drive_rows import from_degrees
from .motion import Motion, Stop
from .poses import Poses
from .solve import all_branches, move, possible_modes

__all__ = [
    "Circuit",
    "Designs",
    "MonotonePiece",
    "Motion",
    "Motions",
    "Poses",
    "Stop",
    "all_branches",
    "circuit",
    "designs",
    "four_bars",
    "from_degrees",
    "inverted_slider_cranks",
    "move",
    "move_many",
    "possible_modes",
    "slider_cranks",
]
