"""Motion of linkages in space and on the sphere: any closed linkage of lower pairs, with wheels on crossed axes.

`move` and `measures` take linkages in the plane too. A `SpatialLinkage` is cut open into a tree of joints (`tree`),
whose closing conditions (`closure`) are followed along the drives (`following`); rates of any order come from power
series (`series`). Definitions, theorems and what may err: docs/theory/space.md.

Closed forms as values: `SphericalFourBar`, `UniversalJoint`, `DoubleUniversalJoint`, `RSSR`, `Bennett`
(docs/theory/closed-forms-in-space.md).
"""

from gruebler.mechanics.space.bennett import Bennett
from gruebler.mechanics.space.crank_output import OutputMotion
from gruebler.mechanics.space.measuring import SpatialMeasures, measures
from gruebler.mechanics.space.motion import SpatialMotion, SpatialStop
from gruebler.mechanics.space.moving import move
from gruebler.mechanics.space.rssr import RSSR
from gruebler.mechanics.space.spherical_four_bar import SphericalFourBar
from gruebler.mechanics.space.universal_joint import DoubleUniversalJoint, UniversalJoint

__all__ = [
    "RSSR",
    "Bennett",
    "DoubleUniversalJoint",
    "OutputMotion",
    "SpatialMeasures",
    "SpatialMotion",
    "SpatialStop",
    "SphericalFourBar",
    "UniversalJoint",
    "measures",
    "move",
]
