from .cam import Cam, CamReport
from .contour import ArcContour, ContourArc, FollowerMotion, follower_motion, tangent_cam
from .follower import Flat, Follower, Roller
from .laws import (
    LAWS,
    CamError,
    LawPeaks,
    LawPiece,
    MotionLaw,
    boundary_law,
    motion_law,
    polynomial_law,
)
from .lift import DerivativeJump, Lift, LiftSegment, dwell, motion, read_lift
from .smooth import SmoothContour

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
