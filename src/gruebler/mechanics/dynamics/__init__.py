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
from gruebler.mechanics.dynamics.simulating import simulate
from gruebler.mechanics.dynamics.simulation import Simulation
from gruebler.mechanics.dynamics.small_motions import Equilibria, Linearised, equilibria, linearised

__all__ = [
    "EquationsOfMotion",
    "Equilibria",
    "Influences",
    "InverseDynamics",
    "Linearised",
    "ReducedEquations",
    "Simulation",
    "Terms",
    "equilibria",
    "influences_of",
    "inverse_dynamics",
    "linearised",
    "reduced_equations",
    "simulate",
]
