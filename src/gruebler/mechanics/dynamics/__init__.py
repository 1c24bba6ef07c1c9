"""Forces in motion: the equations of motion of a linkage in the values of its drives, what drives and joints carry.

docs/theory/dynamics.md.
"""

from gruebler.mechanics.dynamics.balancing import Counterweight, ForceBalance, balance_forces
from gruebler.mechanics.dynamics.equations import (
    EquationsOfMotion,
    Influences,
    ReducedEquations,
    Terms,
    influences_of,
    reduced_equations,
)
from gruebler.mechanics.dynamics.flywheels import Flywheel, flywheel
from gruebler.mechanics.dynamics.inverse import InverseDynamics, inverse_dynamics
from gruebler.mechanics.dynamics.partial_balance import (
    MomentBalance,
    PartialBalance,
    balance_moments,
    balance_partly,
    shaking_harmonics,
)
from gruebler.mechanics.dynamics.simulating import simulate
from gruebler.mechanics.dynamics.simulation import Simulation
from gruebler.mechanics.dynamics.small_motions import Equilibria, Linearised, equilibria, linearised
from gruebler.mechanics.dynamics.spring_balance import SpringFit, balance_weights, fit_springs

__all__ = [
    "Counterweight",
    "EquationsOfMotion",
    "Equilibria",
    "Flywheel",
    "ForceBalance",
    "Influences",
    "InverseDynamics",
    "Linearised",
    "MomentBalance",
    "PartialBalance",
    "ReducedEquations",
    "Simulation",
    "SpringFit",
    "Terms",
    "balance_forces",
    "balance_moments",
    "balance_partly",
    "balance_weights",
    "equilibria",
    "fit_springs",
    "flywheel",
    "influences_of",
    "inverse_dynamics",
    "linearised",
    "reduced_equations",
    "shaking_harmonics",
    "simulate",
]
