"""Linkages given by the screws of their joints, and the mobility of linkages with dimensions.

A `SpatialLinkage` is a mechanism whose joints have places; `Closing` holds the equations that close its joints,
with their Jacobian. `freedoms` takes it, or a planar `Linkage`, and compares the mobility by count, at almost all
sizes, at the pose, and finite. docs/theory/freedoms.md has the conventions, the theorems and what may err.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
