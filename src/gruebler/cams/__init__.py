"""Cams: laws of motion, profiles for given lifts, and the motion that a given contour gives."""

from gruebler.cams.cam import Cam, Extreme, Findings
from gruebler.cams.contour import Arc, ArcContour, FollowerMotion, follow, tangent_cam
from gruebler.cams.follower import Flat, Follower, Roller
from gruebler.cams.laws import LAWS, CamError, Law, Peaks, Piece, boundary_law, law, polynomial_law
from gruebler.cams.lift import Jump, Lift, Segment, dwell, motion, read_lift
from gruebler.cams.smooth import SmoothContour

__all__ = [
    "LAWS",
    "Arc",
    "ArcContour",
    "Cam",
    "CamError",
    "Extreme",
    "Findings",
    "Flat",
    "Follower",
    "FollowerMotion",
    "Jump",
    "Law",
    "Lift",
    "Peaks",
    "Piece",
    "Roller",
    "Segment",
    "SmoothContour",
    "boundary_law",
    "dwell",
    "follow",
    "law",
    "motion",
    "polynomial_law",
    "read_lift",
    "tangent_cam",
]
