"""In which order targets are to be passed: one after the other, some in any order, some at any time.

docs/theory/synthesis.md, "The order of the targets", defines it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, permutations

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Integers, Reals
from gruebler.base.text import Message, joined, joined_by_and, message

Ranks = tuple[int | None, ...]
"""Of each target its place in the order, the same for a group; None at any time. Empty: as they are listed."""

_ENUMERATED = 8  # targets: of more some sequences are drawn
_DRAWN = 4000

Groups = tuple[tuple[int, ...], ...]
"""Targets, by their numbers from 0, that are passed one after the other; those of a group in any order."""


def _numbered(targets: Sequence[int]) -> Message:
    return joined_by_and([target + 1 for target in targets])


@dataclass(frozen=True)
class TargetOrder:
    """Groups of targets that are passed one after the other, and targets that are passed at any time.

    >>> order = TargetOrder.of((1, 2, 2, None), 4)
    >>> order.groups, order.free
    (((0,), (1, 2)), (3,))
    >>> len(list(order.sequences()))
    8
    """

    groups: Groups
    free: tuple[int, ...] = ()

    @classmethod
    def of(cls, ranks: Ranks, count: int) -> TargetOrder:
        """The order of so many targets; ranks as of a task."""
        given = ranks or tuple(range(count))
        rising = sorted({rank for rank in given if rank is not None})
        groups = tuple(tuple(k for k, own in enumerate(given) if own == rank) for rank in rising)
        return cls(groups, tuple(k for k, own in enumerate(given) if own is None))

    @property
    def both_ways(self) -> tuple[Groups, Groups]:
        """The groups, and in the other sense of the curve."""
        return self.groups, self.groups[::-1]

    @property
    def demands_nothing(self) -> bool:
        """Whether any order will do."""
        return len(self.groups) < 2

    @property
    def remark(self) -> Message:
        """What it asks, with the numbers of targets from 1.

        >>> print(TargetOrder.of((1, 2, 2, None), 4).remark)
        Order of the targets: 1; 2 and 3. At any time: 4.
        """
        if self.demands_nothing:
            return message("The targets may be met in any order.")
        groups, free = joined(map(_numbered, self.groups), "; "), _numbered(self.free)
        if not self.free:
            return message("Order of the targets: {groups}.", groups=groups)
        return message("Order of the targets: {groups}. At any time: {free}.", groups=groups, free=free)

    @property
    def rows(self) -> list[int]:
        """The targets that have a place in the order."""
        return [target for group in self.groups for target in group]

    @cached_property
    def ranks(self) -> Integers:
        """(targets,) the number of the group of each target; 0 for those at any time."""
        ranks = np.zeros(sum(map(len, self.groups)) + len(self.free), np.int64)
        for rank, group in enumerate(self.groups):
            ranks[list(group)] = rank
        return ranks

    def keeps(self, sequence: Sequence[int]) -> bool:
        """Whether targets in this sequence are in order."""
        free = set(self.free)
        ranks = [int(self.ranks[target]) for target in sequence if target not in free]
        return ranks == sorted(ranks)

    def sequences(self) -> Iterator[tuple[int, ...]]:
        """All that keep the order, each or its reverse. Cost: the factorial of the number of targets."""
        for sequence in permutations(range(len(self.ranks))):
            if self.keeps(sequence) and (sequence[0] <= sequence[-1] or not self.keeps(sequence[::-1])):
                yield sequence

    def kept_along(self, places: Reals | Integers, lap: float = np.inf) -> Flags:
        """(rows,) whether places along a curve, (rows, targets), are in order, in one sense or the other.

        Args:
            places: of the targets, arcs or angles of a crank.
            lap: the length of a closed curve, on which a lap may begin at any target.

        >>> order = TargetOrder.of((1, 2, 2, None), 4)
        >>> order.kept_along(np.array([[0.1, 0.3, 0.2, 0.9], [0.2, 0.1, 0.3, 0.4]])).tolist()
        [True, False]
        >>> order.kept_along(np.array([[0.2, 0.1, 0.3, 0.4]]), lap=1.0).tolist()
        [True]
        """
        laps = places[:, None, :].astype(np.float64)
        if np.isfinite(lap):
            laps = (laps - places[:, :, None]) % lap
        kept = np.zeros(len(places), bool)
        for groups in self.both_ways:
            own = [laps[:, :, list(group)] for group in groups]
            rising = [first.max(axis=2) <= second.min(axis=2) for first, second in pairwise(own)]
            kept |= np.all(rising, axis=0).any(axis=1) if rising else True
        return kept

    def likely(self, z: Complexes, number: int) -> list[Integers]:
        """Sequences that keep the order in a lap begun anywhere, those with the shortest ways through places first.

        One of each and its reverse.

        Args:
            z: (targets,) the places, NaN where a target has none.
            number: at most.

        Cost: 20 ms for eight targets; of more of them 4,000 sequences are drawn.

        >>> [each.tolist() for each in TargetOrder.of((1, 1, 2, 3), 4).likely(np.array([0, 2, 1, 3 + 0j]), 2)]
        [[0, 2, 3, 1], [2, 0, 1, 3]]
        """
        count, ranks = len(z), self.ranks.copy()
        ranks[list(self.free)] = -1
        if count <= _ENUMERATED:
            every = np.array([*permutations(range(count))])
        else:
            rng = np.random.default_rng(0)
            every = np.unique([self.drawn(rng) for _ in range(_DRAWN)], axis=0)
        along = ranks[every]
        every = every[((along < 0) | (along >= np.maximum.accumulate(along, axis=1))).all(axis=1)]
        if not self.demands_nothing:
            every = np.concatenate([np.roll(every, k, axis=1) for k in range(count)])
            every = np.unique(np.where(every[:, :1] < every[:, -1:], every, every[:, ::-1]), axis=0)
        every = every[every[:, 0] < every[:, -1]]
        places = np.where(np.isnan(z), np.nan, z)[every]
        there = ~np.isnan(places)
        last = np.maximum.accumulate(np.where(there, np.arange(count), 0), axis=1)
        filled = np.take_along_axis(np.nan_to_num(places), last, axis=1)
        ways = np.abs(np.diff(filled, axis=1)) * np.maximum.accumulate(there, axis=1)[:, :-1]
        return [*every[np.argsort(np.round(ways.sum(axis=1), 9), kind="stable")[:number]]]

    def drawn(self, rng: np.random.Generator) -> Integers:
        """A sequence that keeps the order, at random."""
        keys = rng.uniform(size=len(self.ranks)) + self.ranks
        if self.free:
            keys[list(self.free)] = rng.uniform(0, len(self.groups), len(self.free))
        return np.asarray(np.argsort(keys))
