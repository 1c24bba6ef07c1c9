"""Linkages in space and on the sphere to scale, in isometric or oblique view, still and moving."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
