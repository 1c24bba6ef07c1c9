from .bodies import RigidBody
from .friction import Friction, FrictionForces, RubbingContact
from .laws import Curve, Law, LoadFormula, Motor, State
from .loads import Loads
from .solution import Statics, statics
from .springs import Gas, Spring, TorsionSpring
from .tables import component_table, statics_table

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
    "Spring",
    "State",
    "Statics",
    "TorsionSpring",
    "component_table",
    "statics",
    "statics_table",
]
