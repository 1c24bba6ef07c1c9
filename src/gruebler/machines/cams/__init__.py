"""Cams: laws of motion, profiles for given lifts, and follower motions for given contours."""

from gruebler.machines.cams.cam import Cam, CamReport
from gruebler.machines.cams.contour import ArcContour, ContourArc, FollowerMotion, follower_motion, tangent_cam
from gruebler.machines.cams.follower import Flat, Follower, Roller
from gruebler.machines.cams.laws import (
    LAWS,
    CamError,
    LawPeaks,
    LawPiece,
    MotionLaw,
    boundary_law,
    motion_law,
    polynomial_law,
)
from gruebler.machines.cams.lift import DerivativeJump, Lift, LiftSegment, dwell, motion, read_lift
from gruebler.machines.cams.smooth import SmoothContour

__all__ = [
    "LAWS",
    "ArcContour",
    "Cam",
    "CamError",
    "CamReport",
    "ContourArc",
    "DerivativeJump",
    "Flat",
    "Follower",
    "FollowerMotion",
    "LawPeaks",
    "LawPiece",
    "Lift",
    "LiftSegment",
    "MotionLaw",
    "Roller",
    "SmoothContour",
    "boundary_law",
    "dwell",
    "follower_motion",
    "motion",
    "motion_law",
    "polynomial_law",
    "read_lift",
    "tangent_cam",
]
