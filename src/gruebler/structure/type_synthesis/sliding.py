"""The numbers of typed chains by the number of sliding joints, counted without making a typed chain.

Theorem: docs/theory/joint-types.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from itertools import islice
from random import Random
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.errors import ChainError, RunError
from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space
from gruebler.structure.enumeration import Request
from gruebler.structure.enumeration.work_units import chains_of_request
from gruebler.structure.enumeration.worker_pool import run_work
from gruebler.structure.isomorphism import symmetry

Int64 = NDArray[np.int64]

_PRIME = 2**31 - 1
_AT_ONCE = 16  # chains in a piece of work


def count_sliding_variants(
    request: Request, *, executor: Executor | Callable[[], Executor] | None = None
) -> tuple[int, ...]:
    """How many typed chains with 0, 1, 2, ... sliding joints the chains of a request give, all joints moving.

    The numbers are those of `typed_chains`. Cost: half a microsecond for each choice of sliding joints: some
    seconds for all chains of ten links, four minutes of one core for those of twelve.

    >>> count_sliding_variants(Request(4)), count_sliding_variants(Request(6))
    ((1, 1, 2), (2, 6, 16, 19, 9))
    """
    total: list[int] = []
    for numbers in run_work(_numbers, _pieces(request), executor):
        total += [0] * (len(numbers) - len(total))
        total = [a + b for a, b in zip(total, [*numbers, *[0] * (len(total) - len(numbers))], strict=True)]
    while total and not total[-1]:
        total.pop()
    return tuple(total)


def _pieces(request: Request) -> Iterator[list[Chain]]:
    chains = chains_of_request(request)
    while some := list(islice(chains, _AT_ONCE)):
        yield some


def _numbers(chains: list[Chain]) -> list[int]:
    total = [0] * (1 + max(len(chain.joints) for chain in chains))
    for chain in chains:
        for k, number in enumerate(sliding_numbers(chain)):
            total[k] += number
    return total


def sliding_numbers(chain: Chain) -> tuple[int, ...]:
    """How many choices of 0, 1, 2, ... of its simple joints can slide, up to symmetry, with all joints moving.

    Args:
        chain: a planar chain of turning joints with generic mobility F = 3(n - 1) - 2 g1.

    Raises `ChainError` for another chain.

    >>> sliding_numbers(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"))
    (1, 1, 2, 0, 0)
    """
    if chain.space is not Space.PLANAR or not all(joint.pair.is_turning for joint in chain.joints):
        raise ChainError("{chain}: expected a planar chain of turning joints", chain=chain)
    loops = _loops(chain)
    columns = _ordered(loops)
    simple = sum(chain.joints[column.joint].count == 1 for column in columns)
    joint = np.array([column.joint for column in columns], np.int64)
    mobility = 3 * (chain.n - 1) - 2 * len(columns)
    group = _group(chain, joint[:simple].tolist())
    # by chance a placement may lose rank, never gain it: the larger number is right
    numbers = (_core.count_sliding(_vectors(columns, joint, seed), simple, joint, mobility, group) for seed in (1, 2))
    total = np.maximum(*numbers)
    if (total % len(group)).any():
        raise RunError("the numbers of choices of {chain} are no multiples of its symmetries", chain=chain)
    return tuple((total // len(group)).tolist())


class _Column(NamedTuple):
    """The turning of one link of a joint against its first link, in the equations of the loops."""

    joint: int
    simple: bool
    signs: tuple[int, ...]
    """For each loop 1 or -1 if it runs through the joint with or against the direction, else 0."""


def _loops(chain: Chain) -> list[_Column]:
    """The columns of the closure equations: a loop for each joint that closes one, of a tree of shortest paths."""
    edges = [
        (k, chain.index(joint.links[0]), chain.index(other))
        for k, joint in enumerate(chain.joints)
        for other in joint.links[1:]
    ]
    to: dict[int, tuple[int, int, int] | None] = {0: None}  # link -> edge towards the root, direction, link there
    queue = [0]
    for link in queue:
        for e, (_, a, b) in enumerate(edges):
            if link in (a, b) and (other := a + b - link) not in to:
                to[other] = (e, 1 if other == a else -1, link)
                queue.append(other)
    tree = {step[0] for step in to.values() if step is not None}
    closing = [e for e in range(len(edges)) if e not in tree]
    signs = [[0] * len(closing) for _ in edges]
    for loop, e in enumerate(closing):
        signs[e][loop] = 1
        for link, sense in ((edges[e][2], 1), (edges[e][1], -1)):
            step = to[link]
            while step is not None:
                signs[step[0]][loop] += sense * step[1]
                step = to[step[2]]
    return [_Column(k, chain.joints[k].count == 1, tuple(row)) for (k, _, _), row in zip(edges, signs, strict=True)]


def _ordered(columns: list[_Column]) -> list[_Column]:
    """Columns of simple joints first, loop by loop, always the one with the fewest new columns."""
    loops = set(range(len(columns[0].signs)))
    rest = [column for column in columns if column.simple]
    ordered: list[_Column] = []
    while loops:
        best = min(loops, key=lambda loop: (sum(column.signs[loop] != 0 for column in rest), loop))
        loops.remove(best)
        ordered += [column for column in rest if column.signs[best]]
        rest = [column for column in rest if not column.signs[best]]
    return [*ordered, *rest, *(column for column in columns if not column.simple)]


def _vectors(columns: list[_Column], joint: Int64, seed: int) -> Int64:
    """int64[2, columns, 3 loops]: each column for a turning and for a sliding joint at random places."""
    random = Random(seed)
    places = {k: [random.randrange(1, _PRIME) for _ in range(4)] for k in dict.fromkeys(joint.tolist())}
    table = np.zeros((2, len(columns), 3 * len(columns[0].signs)), np.int64)
    for k, column in enumerate(columns):
        x, y, c, s = places[column.joint]
        for loop, sign in enumerate(column.signs):
            table[0, k, 3 * loop : 3 * loop + 3] = [sign % _PRIME, sign * y % _PRIME, -sign * x % _PRIME]
            table[1, k, 3 * loop : 3 * loop + 3] = [0, sign * c % _PRIME, sign * s % _PRIME]
    return table


def _group(chain: Chain, joints: list[int]) -> Int64:
    """int64[automorphisms, joints]: the images of these joints, as places in the list."""
    place = {k: i for i, k in enumerate(joints)}
    generators = [tuple(place[g.joints[k]] for k in joints) for g in symmetry(chain).generators]
    permutations = {tuple(range(len(joints)))}
    front = list(permutations)
    while front:
        front = list({tuple(g[i] for i in image) for image in front for g in generators} - permutations)
        permutations.update(front)
    return np.array(sorted(permutations), np.int64).reshape(len(permutations), len(joints))
