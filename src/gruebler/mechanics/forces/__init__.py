"""The static side of a linkage: what the drive and the joints carry when loads act, without masses in motion.

`statics` solves the equilibrium of all links at every row of a motion, with Coulomb friction if asked, and sets the
drive's effort against the one that virtual work gives; `statics_table` has them as columns; `slider_friction` is the
closed form of a slider-crank. docs/theory/statics.md.
"""

from gruebler.mechanics.forces.friction import Friction, FrictionForces, RubbingContact
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.slider_crank import SliderFriction, slider_friction
from gruebler.mechanics.forces.solution import Statics, statics
from gruebler.mechanics.forces.tables import component_table, statics_table

__all__ = [
    "Friction",
    "FrictionForces",
    "Loads",
    "RubbingContact",
    "SliderFriction",
    "Statics",
    "component_table",
    "slider_friction",
    "statics",
    "statics_table",
]
