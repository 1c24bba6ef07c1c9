"""All chains of contracted graphs, counted up to symmetry by Burnside's lemma, together with their orbits.

The chains of one contracted graph are the orbits of its automorphisms on string assignments; their number is
the mean number of assignments that an automorphism leaves as they are. Links, joints and (link, joint at it)
are counted in the same sum: docs/theory/enumeration.md, "Symmetry".
"""

from typing import Final, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from gruebler._numeric.packed_graph import NODES, Labels, label, make_labels
from gruebler._numeric.string_blocks import BlockTables, Blocks, block_tables, count_strings, make_blocks
from gruebler._numeric.strings import (
    Frame,
    Values,
    Walk,
    make_frame,
    make_values,
    make_walk,
    set_budgets,
    survey_strings,
    walk,
)

Int64 = NDArray[np.int64]

# Columns of a census.
DEGREES: Final = 0  # five bits a degree, from 3 on: how many nodes have it
CHAINS: Final = 1
INVERSIONS: Final = 2
DRIVES: Final = 3
JOINT_ORBITS: Final = 4
COLUMNS: Final = 5

DIGITS: Final = 5  # bits of each number in DEGREES


class Bench(NamedTuple):
    """Everything the kernels below need besides the graphs."""

    frame: Frame
    values: Values
    pair_values: Values  # for two nodes alone, where F = 0 allows c = 3
    walk: Walk
    blocks: Blocks
    tables: BlockTables
    labels: Labels
    image: Int64
    sums: Int64


def make_bench(loops: int, mobility: int) -> Bench:
    """Memory and tables for contracted graphs of so many loops and chains of this mobility."""
    return Bench(
        frame=make_frame(),
        values=make_values(loops + 1, mobility),
        pair_values=make_values(loops + 1, mobility, 3 if mobility == 0 else 2),
        walk=make_walk(),
        blocks=make_blocks(make_values(loops + 1, 1)),
        tables=block_tables(),
        labels=make_labels(),
        image=np.zeros(NODES, np.int64),
        sums=np.zeros(8, np.int64),
    )


@njit(cache=True)
def _automorphism(n: int, g: int, labels: Labels, image: Int64) -> int:
    """Write out one automorphism; returns the number of nodes it leaves in place."""
    fixed = 0
    for i in range(n):
        image[labels.leaves[0, i]] = labels.leaves[g, i]
        if labels.leaves[0, i] == labels.leaves[g, i]:
            fixed += 1
    return fixed


@njit(cache=True, nogil=True)
def take_census(
    graphs: Int64, mobility: int, orbits: bool, by_blocks: bool, bench: Bench, out: Int64
) -> None:
    """Count the chains of each contracted graph.

    Args:
        graphs: int64[k, nodes], packed graphs.
        mobility: F of the chains; the number of their links is 2 * loops + 1 + F.
        orbits: whether to fill the last three columns.
        by_blocks: whether to count the identity by blocks where that is possible (F = 1); the numbers are the
            same without.
        bench: from `make_bench`, for the number of loops and the mobility.
        out: int64[k, COLUMNS].

    Raises:
        ValueError: the mean of Burnside's lemma is no whole number, which would be a fault of the program.
    """
    frame, memory, labels, image, sums = bench.frame, bench.walk, bench.labels, bench.image, bench.sums
    nothing = np.zeros((0, 0), np.int64)
    for k in range(graphs.shape[0]):
        rows = graphs[k]
        n, bundles, sets = survey_strings(rows, frame)
        group = label(n, frame.near, rows, labels)
        target = 3 * n - 3 - mobility
        values = bench.pair_values if n == 2 else bench.values
        degrees = 0
        total = 0
        for v in range(n):
            degrees += 1 << (DIGITS * (frame.degree[v] - 3))
            total += frame.degree[v]
        loops = total // 2 - n + 1
        links = 2 * loops + 1 + mobility
        joints = links + loops - 1
        chains, link_orbits, flags, joint_orbits = 0, 0, 0, 0
        first = 0
        if by_blocks and mobility == 1 and n > 2:
            sums[3] = 0
            sums[4] = 0
            found = count_strings(
                n, bundles, sets, orbits, frame, bench.tables.allowed, bench.tables.pattern,
                bench.blocks, sums[3:5],
            )  # fmt: skip
            chains = found
            link_orbits = found * links - sums[3]
            joint_orbits = found * joints - sums[4]
            flags = 2 * joint_orbits
            first = 1
        words = set_budgets(bundles, sets, target, frame, memory)
        for g in range(first, group):
            fixed = _automorphism(n, g, labels, image)
            sums[0] = 0
            sums[1] = 0
            sums[2] = 0
            found = walk(
                bundles, words, image, target, mobility, frame, values, memory, sums[:3], nothing
            )
            chains += found
            link_orbits += found * fixed + sums[0]
            joint_orbits += sums[1]
            flags += sums[2]
        if chains % group or link_orbits % group or joint_orbits % group or flags % group:
            if orbits or chains % group:
                raise ValueError("the sum over the automorphisms is not a multiple of their number")
        out[k, DEGREES] = degrees
        out[k, CHAINS] = chains // group
        out[k, INVERSIONS] = link_orbits // group
        out[k, DRIVES] = flags // group
        out[k, JOINT_ORBITS] = joint_orbits // group
