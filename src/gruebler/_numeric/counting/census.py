"""All chains of contracted graphs, counted up to symmetry by Burnside's lemma, together with their orbits.

The chains of one contracted graph are the orbits of its automorphisms on string assignments; their number is
the mean number of assignments that an automorphism leaves as they are. Links, joints and (link, joint at it)
are counted in the same sum: docs/theory/enumeration.md, "Symmetry".
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.packed_graph import NODES, LabelMemory, label_packed, make_label_memory
from gruebler._numeric.counting.string_blocks import BlockTables, CounterMemory, block_tables, make_counter_memory
from gruebler._numeric.counting.string_count import FOUND, LINK_CLASSES, count_strings
from gruebler._numeric.counting.strings import PreparedGraph, Values, make_prepared_graph, make_values, survey_strings

Int64 = NDArray[np.int64]

# Columns of a census.
DEGREES: Final = 0  # five bits a degree, from 3 on: how many nodes have it
CHAINS: Final = 1
INVERSIONS: Final = 2
JOINT_ORBITS: Final = 3
DRIVES: Final = 4
COLUMNS: Final = 5

DIGITS: Final = 5  # bits of each number in DEGREES
LARGEST: Final = 9.2e18


class CensusMemory(NamedTuple):
    """Everything `take_census` needs besides the graphs."""

    frame: PreparedGraph
    values: Values
    pair_values: Values  # for two nodes alone, where F = 0 allows c = 3
    counter: CounterMemory
    tables: BlockTables
    labels: LabelMemory
    image: Int64
    totals: Int64


def make_census_memory(loops: int, mobility: int) -> CensusMemory:
    """Memory and tables for contracted graphs of so many loops and chains of this mobility."""
    return CensusMemory(
        frame=make_prepared_graph(),
        values=make_values(loops + 1, mobility),
        pair_values=make_values(loops + 1, mobility, 3 if mobility == 0 else 2),
        counter=make_counter_memory(),
        tables=block_tables(),
        labels=make_label_memory(),
        image=np.zeros(NODES, np.int64),
        totals=np.zeros(4, np.int64),
    )


@njit(cache=True)
def _automorphism(n: int, g: int, labels: LabelMemory, image: Int64) -> int:
    """Write out one automorphism; returns the number of nodes it leaves in place."""
    fixed = 0
    for i in range(n):
        image[labels.leaves[0, i]] = labels.leaves[g, i]
        if labels.leaves[0, i] == labels.leaves[g, i]:
            fixed += 1
    return fixed


@njit(cache=True, nogil=True)
def take_census(graphs: Int64, mobility: int, orbits: bool, bench: CensusMemory, out: Int64) -> None:
    """Count the chains of each contracted graph.

    Args:
        graphs: int64[k, nodes], packed graphs.
        mobility: F of the chains; the number of their links is 2 * loops + 1 + F.
        orbits: whether to fill the last three columns.
        bench: from `make_census_memory`, for the number of loops and the mobility.
        out: int64[k, COLUMNS].

    Raises:
        ValueError: the mean of Burnside's lemma is no whole number, which would be a fault of the program.
        OverflowError: a number of flags beyond 64 bits, or near them.
    """
    frame, labels, image, totals = bench.frame, bench.labels, bench.image, bench.totals
    for k in range(graphs.shape[0]):
        rows = graphs[k]
        n, bundles, sets = survey_strings(rows, frame)
        group = label_packed(n, frame.near, rows, labels)
        degrees = 0
        for v in range(n):
            degrees += 1 << (DIGITS * (frame.degree[v] - 3))
        values = bench.pair_values if n == 2 else bench.values
        links = 0
        bench.counter.bulk[0] = 0
        for i in range(4):
            totals[i] = 0
        for g in range(group):
            fixed = _automorphism(n, g, labels, image)
            before = totals[FOUND]
            count_strings(n, bundles, sets, image, mobility, orbits, frame, values, bench.tables, bench.counter, totals)
            links += fixed * (totals[FOUND] - before)
        totals[LINK_CLASSES] += links
        joints = (frame.degree[:n].sum() // 2 - n) * 3 + 1 + mobility
        if bench.counter.bulk[0] * 2 * joints > LARGEST:
            raise OverflowError("the numbers of one contracted graph do not fit in 64 bits")
        out[k, DEGREES] = degrees
        for i in range(4):
            if totals[i] % group and (orbits or i == 0):
                raise ValueError("the sum over the automorphisms is not a multiple of their number")
            out[k, CHAINS + i] = totals[i] // group if orbits or i == 0 else 0
