"""Linkages: mechanisms with dimensions.

`Linkage` holds the sizes of any planar mechanism; docs/theory/kinematics.md has the conventions.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
