"""Forces in motion: the equations of motion of a linkage in the values of its drives, what drives and joints carry.

docs/theory/dynamics.md.
"""

from gruebler.mechanics.dynamics.equations import (
    EquationsOfMotion,
    Influences,
    ReducedEquations,
    Terms,
    influences_of,
    reduced_equations,
)
from gruebler.mechanics.dynamics.inverse import InverseDynamics, inverse_dynamics

__all__ = [
    "EquationsOfMotion",
    "Influences",
    "InverseDynamics",
    "ReducedEquations",
    "Terms",
    "influences_of",
    "inverse_dynamics",
    "reduced_equations",
]
