"""Linkages with dimensions: how they move, what can be measured on them, their geometry, their forces, their screws."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
