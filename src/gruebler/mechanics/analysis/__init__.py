"""What a motion shows: dead centres, strokes, times, transmission angles, and which links turn fully.

`measures` computes all of them for a linkage with one drive; `rotatability` and `motion_roles` tell who turns
fully: docs/theory/events.md.
"""

from gruebler.mechanics.analysis.circuit_ranges import DriveRange, Rotatability, drive_range, motion_roles, rotatability
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.measuring import Measures, measures
from gruebler.mechanics.analysis.table import motion_table
from gruebler.mechanics.analysis.transmission import deviation_angle, transmission_angle

__all__ = [
    "DriveRange",
    "Measures",
    "Rotatability",
    "deviation_angle",
    "drive_cycle",
    "drive_range",
    "measures",
    "motion_roles",
    "motion_table",
    "rotatability",
    "transmission_angle",
]
