"""Dimensions for a mechanism: any with which it moves, or those for a wanted motion."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
