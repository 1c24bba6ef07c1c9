"""The number of chains that are not fractionated, estimated: random pairings, a pebble game, orders of groups by bliss.

Theory: docs/theory/enumeration.md, "An estimate without a list".
"""

from __future__ import annotations

from collections.abc import Iterator
from math import factorial, fsum, prod
from typing import NamedTuple

import igraph
import numba
import numpy as np
from numpy.typing import NDArray

from tests.structure.enumeration.pebble_oracle import _add_joint

__all__ = ["Sampled", "sampled_chains"]

Int64 = NDArray[np.int64]
_PILOT = 2000  # samples of each sequence of degrees, before the others are shared out
_BLOCK = 20_000  # samples at once


class Sampled(NamedTuple):
    """An estimate without bias, and its standard deviation as far as the sample shows it."""

    chains: float
    deviation: float
    samples: int


class _Stratum:
    """Weighted pairings of one sequence of degrees: how many there are, and what was drawn of them."""

    def __init__(self, degrees: tuple[int, ...], links: int, mobility: int) -> None:
        self.degrees = np.array(degrees, np.int64)
        self.links, self.mobility, self.strings = links, mobility, sum(degrees) // 2
        found = sorted(set(_weights(links - len(degrees), self.strings, mobility - 1, mobility + 1)))
        kinds = [_arrangements(weights, self.strings) for weights in found]
        self.ways = np.cumsum([k / sum(kinds) for k in kinds])
        self.weights = np.array([row + (0,) * (self.strings - len(row)) for row in found], np.int64)
        group = prod(map(factorial, degrees)) * prod(factorial(degrees.count(d)) for d in set(degrees))
        self.scale = prod(range(1, 2 * self.strings, 2)) * sum(kinds) / group
        self.drawn, self.sum, self.squares = 0, 0.0, 0.0

    def draw(self, samples: int, seed: int) -> None:
        while samples > 0 and self.scale:
            some = min(samples, _BLOCK)
            found = _draw(self.degrees, self.links, self.ways, self.weights, some, seed + self.drawn)
            graphs = [igraph.Graph(joints.tolist()) for joints in found]
            if self.mobility > 1:  # others are never fractionated
                graphs = [graph for graph in graphs if graph.is_biconnected()]
            orders = np.array([graph.count_automorphisms() for graph in graphs], float)
            self.sum += orders.sum()
            self.squares += (orders**2).sum()
            self.drawn += some
            samples -= some

    @property
    def spread(self) -> float:
        """The standard deviation of one sample; of a sequence without a hit as if there had been one."""
        mean = self.sum / max(self.drawn, 1)
        hit = max(self.squares, 1.0) / max(self.drawn, 1)
        return self.scale * float(np.sqrt(max(hit - mean**2, 0.0)))


def sampled_chains(links: int, samples: int, *, mobility: int = 1, seed: int = 1) -> Sampled:
    """Estimate the chains with F > 0 and two loops or more, not fractionated, from about so many weighted pairings."""
    loops = (links - 1 - mobility) // 2
    strata = [_Stratum(d, links, mobility) for d in _degree_sequences(2 * loops - 2, loops + 1)]
    strata = [s for s in strata if s.scale]
    for k, stratum in enumerate(strata):
        stratum.draw(min(_PILOT, 1 + samples // (2 * len(strata))), _seed(seed, k))
    spreads = [s.spread for s in strata]
    total = fsum(spreads)
    left = max(samples - sum(s.drawn for s in strata), 0)
    estimates = []
    for k, (stratum, spread) in enumerate(zip(strata, spreads, strict=True)):
        fresh = _Stratum(
            tuple(stratum.degrees.tolist()), links, mobility
        )  # the pilot is left out: its share depends on it
        fresh.draw(max(int(left * spread / total), _PILOT // 10), _seed(seed + 1, k))
        estimates.append(fresh)
    chains = sum(s.scale * s.sum / s.drawn for s in estimates)
    deviation = float(np.sqrt(sum(s.spread**2 / s.drawn for s in estimates)))
    return Sampled(chains, deviation, sum(s.drawn for s in [*strata, *estimates]))


def _seed(seed: int, k: int) -> int:
    return (seed * 1_000_003 + k * 10_000_019) % 2**31


def _degree_sequences(excess: int, most: int) -> Iterator[tuple[int, ...]]:
    """Descending degrees from 3 to the most, with the sum of degree - 2."""

    def parts(rest: int, top: int) -> Iterator[tuple[int, ...]]:
        if rest == 0:
            yield ()
        for part in range(min(rest, top), 0, -1):
            yield from ((part + 2, *more) for more in parts(rest - part, part))

    return (degrees for degrees in parts(excess, most - 2) if len(degrees) > 1)


def _weights(binary: int, strings: int, excess: int, most: int) -> Iterator[tuple[int, ...]]:
    """Descending weights of strings that add up to so many binary links; beyond 2 they add up to the excess at most."""
    if not binary:
        yield ()
    elif strings:
        for weight in range(min(binary, most), 0, -1):
            over = max(weight - 2, 0)
            if over <= excess:
                yield from ((weight, *more) for more in _weights(binary - weight, strings - 1, excess - over, weight))


def _arrangements(weights: tuple[int, ...], strings: int) -> int:
    """In how many ways strings have these weights."""
    alike = [weights.count(w) for w in set(weights)]
    return factorial(strings) // prod(map(factorial, [*alike, strings - len(weights)]))


@numba.njit
def _draw(degrees: Int64, links: int, ways: NDArray[np.float64], weights: Int64, samples: int, seed: int) -> Int64:
    """The chains among so many random weighted pairings: int64[k, joints, 2]."""
    np.random.seed(seed)
    nodes, halves = degrees.size, degrees.sum()
    strings = halves // 2
    joints = strings + links - nodes
    found = np.empty((samples, joints, 2), np.int64)
    owner = np.empty(halves, np.int64)
    k = 0
    for v in range(nodes):
        for _ in range(degrees[v]):
            owner[k] = v
            k += 1
    place = np.arange(strings)
    weight = np.zeros(strings, np.int64)
    before, queue = np.zeros(links, np.int64), np.zeros(links, np.int64)
    out, free = np.zeros((links, links), np.int8), np.zeros(links, np.int8)
    chain = np.empty((joints, 2), np.int64)
    number = 0
    for _ in range(samples):
        for i in range(halves - 1, 0, -1):
            j = np.random.randint(0, i + 1)
            owner[i], owner[j] = owner[j], owner[i]
        good = True
        for s in range(strings):
            good = good and owner[2 * s] != owner[2 * s + 1]
        if not good:
            continue
        kind = min(np.searchsorted(ways, np.random.random(), side="right"), ways.size - 1)
        weight[:] = 0
        for i in range(strings):
            if weights[kind, i] == 0:
                break
            j = np.random.randint(i, strings)
            place[i], place[j] = place[j], place[i]
            weight[place[i]] = weights[kind, i]
        out[:] = 0
        free[:] = 3
        fresh, joint = nodes, 0
        for s in range(strings):
            here = owner[2 * s]
            for i in range(weight[s] + 1):
                there = fresh if i < weight[s] else owner[2 * s + 1]
                fresh += i < weight[s]
                good = good and _add_joint(links, here, there, free, out, before, queue)
                chain[joint, 0], chain[joint, 1] = here, there
                joint += 1
                here = there
            if not good:
                break
        if good:
            found[number] = chain
            number += 1
    return found[:number]
