"""The mobility of a chain, by the formula and by rank, and the causes where the two differ."""

from gruebler.mobility.circuits import Overconstrained, overconstrained
from gruebler.mobility.counting import Count, count_freedoms, counted
from gruebler.mobility.idle import IdleFreedom, idle_freedoms
from gruebler.mobility.rank import Generic, TooLargeError, generic, generic_mobility
from gruebler.mobility.report import MobilityReport, Verdict, mobility_report
from gruebler.mobility.sparsity import License, pebble_mobility, pebble_rank, theorem

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
