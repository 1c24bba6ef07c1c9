"""Cams: laws of motion, profiles for given lifts, and follower motions for given contours."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
