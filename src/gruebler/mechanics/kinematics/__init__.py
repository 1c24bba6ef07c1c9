"""The solver: poses, velocities, accelerations, jerks of linkages, along any path of the drives.

`move` solves the groups of the Assur decomposition one after another and returns a `Motion`. `circuit` follows
all positions that are connected, all joints at once and without regard to the drive. Conventions, theorems and
what may err: docs/theory/kinematics.md, circuits.md, assembly-modes.md.
"""

from gruebler.mechanics.kinematics.batch import (
    Designs,
    Motions,
    designs,
    four_bars,
    inverted_slider_cranks,
    move_many,
    slider_cranks,
)
from gruebler.mechanics.kinematics.circuits import Circuit, MonotonePiece, circuit
from gruebler.mechanics.kinematics.drive_rows import from_degrees
from gruebler.mechanics.kinematics.motion import Motion, Stop
from gruebler.mechanics.kinematics.poses import Poses
from gruebler.mechanics.kinematics.solve import all_branches, move

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
    "slider_cranks",
]
