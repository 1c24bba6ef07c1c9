"""How long kernels take if they are interpreted: the estimates for `compiling.for_work`, in seconds.

Measured on one core of a 2020s server with Python 3.11; right to a factor of two or three, which is all that the choice of
a tier needs.
"""

from __future__ import annotations

from gruebler._numeric.program import Program

__all__ = ["LABEL", "SURVEY", "census", "closing_seconds", "growing", "labelling", "layout", "lines_of", "listing",
           "newton_seconds", "sampling", "walking"]  # fmt: skip

SURVEY = 1e-4
LABEL = 5e-4


def walking(program: Program, rows: int, order: int) -> float:
    return rows * 1e-5


def closing_seconds(unknowns: int) -> float:
    return 2e-5 * unknowns


def newton_seconds(unknowns: int) -> float:
    return 1e-4 * unknowns


def sampling(unknowns: int, places: int) -> float:
    return 3e-4 * unknowns * places


def labelling(n: int, m: int) -> float:
    return 1e-5 * (n + m)


def growing(loops: int, parents: int) -> float:
    return 1e-3 * parents


def census(graphs: int, work: int) -> float:
    return 1e-3 * graphs


def listing(graphs: int, work: int) -> float:
    return 1e-3 * graphs


def lines_of(chains: int, links: int) -> float:
    return 1e-5 * chains * links


def layout(watched: int, rounds: int) -> float:
    return 1e-5 * watched * rounds
