"""Second methods for what is counted: `python -m benchmarks.evidence [LOOPS]` compares the contracted graphs.

Sums of 1/|Aut| over contracted graphs of the same degrees come from generating functions
(`tests.structure.enumeration.mass_oracle`), chains of a contracted graph from a pebble game on all distributions of
its binary links (`tests.structure.enumeration.pebble_oracle`).
"""

import sys
from collections import defaultdict
from collections.abc import Iterator
from fractions import Fraction
from math import factorial
from random import Random
from time import process_time
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.structure.enumeration.contracted import packed_graphs, unpacked
from gruebler.structure.enumeration.pieces import WorkPiece, count_piece, strings_of_graphs, work_of_graphs

Int64 = NDArray[np.int64]
Degrees = tuple[int, ...]
"""How many nodes of 3, 4, ... strings there are."""

_FACTORIALS = np.array([factorial(k) for k in range(16)], np.int64)
_SAMPLE = 3  # contracted graphs that are checked of an assortment with too much work for all


class Checked(NamedTuple):
    """What a second method confirmed of the chains of an assortment."""

    assortment: Degrees
    """Numbers of binary, ternary, ... links."""
    graphs: int
    """Contracted graphs of the assortment."""
    checked: int
    """Those whose chains were counted twice."""
    chains: int
    """Chains of the latter."""


def check_chains(links: int, most: int) -> Iterator[Checked]:
    """Count the chains with F = 1 of contracted graphs once more, by pebbles: all graphs of an assortment, or some.

    Args:
        links: number of links.
        most: the work, as of `pieces.WorkPiece`, up to which all graphs of an assortment are checked; else a sample,
            each graph with the same probability.

    Raises ValueError where the two counts differ. Cost: some 15 us for each chain.
    """
    from tests.structure.enumeration.pebble_oracle import count_by_pebbles

    random = Random(links)
    numbers: defaultdict[Degrees, int] = defaultdict(int)
    work: defaultdict[Degrees, int] = defaultdict(int)
    chosen: defaultdict[Degrees, list[Int64]] = defaultdict(list)
    for block in packed_graphs((links - 2) // 2):
        for degrees, rows, more in zip(_degree_sequences(block), block, work_of_graphs(block).tolist(), strict=True):
            numbers[degrees] += 1
            work[degrees] += more
            if work[degrees] <= most:
                chosen[degrees].append(rows)
            else:
                if len(chosen[degrees]) > _SAMPLE:
                    chosen[degrees] = random.sample(chosen[degrees], _SAMPLE)
                place = random.randrange(numbers[degrees])
                if len(chosen[degrees]) < _SAMPLE:
                    chosen[degrees].append(rows)
                elif place < _SAMPLE:  # reservoir sampling
                    chosen[degrees][place] = rows
    for degrees in sorted(numbers):
        total = 0
        for rows in chosen[degrees]:
            graph = unpacked(rows)
            here = count_by_pebbles(graph.bundles, links)
            counted = sum(count.chains for count in count_piece(WorkPiece(links, 1, rows[None], 0)))
            if here != counted:
                raise ValueError(f"{graph.bundles}: {counted} chains, by pebbles {here}")
            total += here
        yield Checked((links - sum(degrees), *degrees), numbers[degrees], len(chosen[degrees]), total)


def _degree_sequences(block: Int64) -> list[Degrees]:
    strings = strings_of_graphs(block).sum(axis=2)
    most = int(strings.max())
    table = np.stack([(strings == k).sum(axis=1) for k in range(3, most + 1)], axis=1)
    unique, place = np.unique(table, axis=0, return_inverse=True)
    sequences = [tuple(np.trim_zeros(row, "b").tolist()) for row in unique]
    return [sequences[k] for k in place.reshape(-1).tolist()]


def sums_of_graphs(loops: int) -> tuple[int, dict[Degrees, Fraction]]:
    """The number of contracted graphs, and the sum of 1/|Aut| for each sequence of degrees."""
    sums: defaultdict[Degrees, Fraction] = defaultdict(Fraction)
    number = 0
    for block in packed_graphs(loops):
        strings = strings_of_graphs(block)
        orders = _FACTORIALS[np.tril(strings)].prod(axis=(1, 2))  # equal strings told apart
        orders *= [len(_core.find_automorphisms(rows)) for rows in block]
        degrees = strings.sum(axis=2)
        sequences = (degrees[:, :, None] == np.arange(3, degrees.max() + 1)).sum(axis=1)
        rows, counts = np.unique(np.column_stack([sequences, orders]), axis=0, return_counts=True)
        for (*sequence, order), count in zip(rows.tolist(), counts.tolist(), strict=True):
            sums[tuple(np.trim_zeros(sequence, "b"))] += Fraction(count, order)
        number += len(block)
    return number, dict(sums)


def main(most: int = 9) -> None:
    """Print for each number of loops whether all sums agree."""
    from tests.structure.enumeration.mass_oracle import contracted_masses

    expected = contracted_masses(most)
    for loops in range(2, most + 1):
        begun = process_time()
        number, sums = sums_of_graphs(loops)
        same = {d: v for d, v in expected.items() if sum(k * m for k, m in enumerate(d, 1)) == 2 * loops - 2}
        print(
            f"{loops} loops: {number} graphs, {len(sums)} sequences of degrees, sum of 1/|Aut| {sum(sums.values())},",
            "as by generating functions" if sums == same else "OTHER THAN by generating functions",
            f"({process_time() - begun:.0f} s)",
            flush=True,
        )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
