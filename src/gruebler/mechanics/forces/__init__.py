"""The static side of a linkage: what the drive and the joints carry when loads act, without masses in motion.

`Loads` are what acts, for statics and dynamics alike: forces, moments, `RigidBody`s, `Spring`s, `Motor`s.
`statics` solves the equilibrium of all links at every row of a motion, with Coulomb friction if asked, and sets the
drive's effort against the one that virtual work gives; `statics_table` has them as columns; `slider_friction` is the
closed form of a slider-crank. docs/theory/statics.md.
"""

from gruebler.mechanics.forces.bodies import RigidBody
from gruebler.mechanics.forces.friction import Friction, FrictionForces, RubbingContact
from gruebler.mechanics.forces.laws import Curve, Law, LoadFormula, Motor, State
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.slider_crank import SliderFriction, slider_friction
from gruebler.mechanics.forces.solution import Statics, statics
from gruebler.mechanics.forces.springs import Gas, Spring, TorsionSpring
from gruebler.mechanics.forces.tables import component_table, statics_table

__all__ = [
    "Curve",
    "Friction",
    "FrictionForces",
    "Gas",
    "Law",
    "LoadFormula",
    "Loads",
    "Motor",
    "RigidBody",
    "RubbingContact",
    "SliderFriction",
    "Spring",
    "State",
    "Statics",
    "TorsionSpring",
    "component_table",
    "slider_friction",
    "statics",
    "statics_table",
]
