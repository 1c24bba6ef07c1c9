"""Motion of linkages in space and on the sphere: any closed linkage of lower pairs, with wheels on crossed axes.

`move` takes linkages in the plane too. A `SpatialLinkage` is cut open into a tree of joints (`tree`), whose closing
conditions (`closure`) are followed along the drives (`following`); rates of any order come from power series
(`series`). Definitions, theorems and what may err: docs/theory/space.md.
"""

from gruebler.mechanics.space.motion import SpatialMotion, SpatialStop
from gruebler.mechanics.space.moving import move

__all__ = ["SpatialMotion", "SpatialStop", "move"]
