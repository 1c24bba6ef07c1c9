"""The static side of a linkage: what the drive and the joints carry when loads act, without masses in motion.

`statics` solves the equilibrium of all links at every row of a motion and sets the drive's effort against the one that
virtual work gives; `statics_table` has them as columns; `slide_friction` and `slider_friction` estimate the friction of
a slide. docs/theory/statics.md.
"""

from gruebler.forces.friction import SlideFriction, SliderFriction, slide_friction, slider_friction
from gruebler.forces.loads import Loads
from gruebler.forces.solution import Statics, statics
from gruebler.forces.tables import component_table, statics_table

__all__ = [
    "Loads",
    "SlideFriction",
    "SliderFriction",
    "Statics",
    "component_table",
    "slide_friction",
    "slider_friction",
    "statics",
    "statics_table",
]
