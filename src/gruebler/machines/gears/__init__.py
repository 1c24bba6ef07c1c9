"""Gear trains: meshes, one linear system for all speeds, exact ratios, torques and power, assembly of planets."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
