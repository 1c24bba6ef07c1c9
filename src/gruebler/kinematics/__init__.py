"""Linkages in motion: poses, velocities, accelerations, jerks, along any path of the drives.

`move` solves the groups of the Assur decomposition one after another; a `Motion` holds what it found. `circuit` follows
all positions that belong together, all joints at once and without regard to the drive. `measures` tells dead centres,
strokes, times, transmission angles; `rotatability` and `motion_roles` who turns fully. Conventions, theorems and what
may err: docs/theory/kinematics.md, circuits.md, events.md, assembly-modes.md.
"""

from gruebler.kinematics.batch import (
    Designs,
    Motions,
    designs,
    four_bars,
    inverted_slider_cranks,
    move_many,
    slider_cranks,
)
from gruebler.kinematics.branches import all_branches
from gruebler.kinematics.circuits import ChangePoint, Circuit, Extreme, Stretch, circuit
from gruebler.kinematics.course import follow
from gruebler.kinematics.drive_rows import degrees
from gruebler.kinematics.measuring import Measures, measures
from gruebler.kinematics.motion import Motion, Stop
from gruebler.kinematics.moving import move
from gruebler.kinematics.poses import Poses
from gruebler.kinematics.transmission import deviation_angle, transmission_angle
from gruebler.kinematics.triads import assembly_modes
from gruebler.kinematics.turning import DriveRange, Rotatability, drive_range, motion_roles, rotatability

__all__ = [
    "ChangePoint",
    "Circuit",
    "Designs",
    "DriveRange",
    "Extreme",
    "Measures",
    "Motion",
    "Motions",
    "Poses",
    "Rotatability",
    "Stop",
    "Stretch",
    "all_branches",
    "assembly_modes",
    "circuit",
    "degrees",
    "designs",
    "deviation_angle",
    "drive_range",
    "follow",
    "four_bars",
    "inverted_slider_cranks",
    "measures",
    "motion_roles",
    "move",
    "move_many",
    "rotatability",
    "slider_cranks",
    "transmission_angle",
]
