"""The mobility of a chain, by the formula and by rank, and the causes where the two differ."""

from gruebler.structure.mobility.circuits import Overconstrained, overconstrained
from gruebler.structure.mobility.counting import Count, count_freedoms, counted
from gruebler.structure.mobility.idle import IdleFreedom, idle_freedoms
from gruebler.structure.mobility.rank import Generic, TooLargeError, generic, generic_mobility
from gruebler.structure.mobility.report import MobilityReport, Verdict, mobility_report
from gruebler.structure.mobility.sparsity import License, pebble_mobility, pebble_rank, theorem

__all__ = [
    "Count",
    "Generic",
    "IdleFreedom",
    "License",
    "MobilityReport",
    "Overconstrained",
    "TooLargeError",
    "Verdict",
    "count_freedoms",
    "counted",
    "generic",
    "generic_mobility",
    "idle_freedoms",
    "mobility_report",
    "overconstrained",
    "pebble_mobility",
    "pebble_rank",
    "theorem",
]
