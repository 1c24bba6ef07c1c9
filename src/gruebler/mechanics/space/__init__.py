"""Motion of linkages in space and on the sphere: any closed linkage of lower pairs, with wheels on crossed axes.

`move` and `measures` take linkages in the plane too. A `SpatialLinkage` is cut open into a tree of joints (`tree`),
whose closing conditions (`closure`) the core follows along the drives, with rates from power series; all assembly modes
come from those of random dimensions (`modes`). Definitions, theorems and what may err:
docs/theory/space.md, docs/theory/modes-in-space.md.

Closed forms as values: `SphericalFourBar`, `UniversalJoint`, `DoubleUniversalJoint`, `RSSR`, `SwashPlate`,
`Bennett` (docs/theory/closed-forms-in-space.md).
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
