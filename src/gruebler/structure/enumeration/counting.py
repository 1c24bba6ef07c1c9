"""The numbers of chains and of their mechanisms, counted without building a chain."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from gruebler.base.notebook import explained
from gruebler.base.plain_data import plain
from gruebler.base.text import message
from gruebler.structure.enumeration.assortment import Assortment, loop_count
from gruebler.structure.enumeration.pieces import PieceCount, count_piece, pieces, run_pieces


@explained
@dataclass(frozen=True, kw_only=True)
class ChainCount:
    """The numbers of chains with n links and mobility F, and of their mechanisms."""

    links: int
    mobility: int
    chains: int
    by_assortment: dict[Assortment, int] = field(default_factory=dict)
    """Chains of each assortment (n_2, n_3, ...) that has any, sorted."""
    inversions: int | None = None
    """Orbits of links over all chains, that is choices of a frame; None if not counted."""
    drives: int | None = None
    """Orbits of (link, joint at it): choices of a frame and of a driven joint at the frame, of a multiple joint also
    of the link that it drives."""
    joint_orbits: int | None = None
    """Orbits of joints."""
    by_fractionation: dict[str, int] = field(default_factory=dict)
    """Chains of each requested class: ``none``, ``link``, ``joint``; empty where one class only can be counted."""

    def explain(self, lang: str = "en") -> str:
        """The numbers, a line each, in English or German (``de``).

        >>> print(count_simple_chains(6, orbits=True))
        Chains of 6 links with F = 1: 2.
        By numbers of binary, ternary, ... links: 4,2: 2.
        Choices of a frame: 5; of a frame and a driven joint at it: 9.
        """
        parts = {",".join(map(str, each)): number for each, number in self.by_assortment.items()}
        texts = [_CHAINS.filled(links=self.links, mobility=self.mobility, chains=self.chains)]
        texts += [_ASSORTMENTS.filled(parts=_parts(parts))] if parts else []
        texts += [_CLASSES.filled(parts=_parts(self.by_fractionation))] if len(self.by_fractionation) > 1 else []
        if self.inversions is not None and self.drives is not None:
            texts.append(_ORBITS.filled(inversions=self.inversions, drives=self.drives))
        return "\n".join(text.in_language(lang) for text in texts)

    def to_json(self) -> dict[str, Any]:
        """Plain data; an assortment is written ``4,4``, orbits only if they were counted, classes only if several were.

        >>> count_simple_chains(6).to_json()
        {'links': 6, 'mobility': 1, 'chains': 2, 'by_assortment': {'4,2': 2}}
        """
        counted = [name for name in ("inversions", "drives", "joint_orbits") if getattr(self, name) is not None]
        classes = ["by_fractionation"] * (len(self.by_fractionation) > 1)
        document: dict[str, Any] = plain(self, " ".join(["links mobility chains by_assortment", *counted, *classes]))
        return document | {"by_assortment": {",".join(map(str, a)): k for a, k in self.by_assortment.items()}}


_CHAINS = message("Chains of {links} links with F = {mobility}: {chains}.")
_ASSORTMENTS = message("By numbers of binary, ternary, ... links: {parts}.")
_CLASSES = message("By where they fall apart: {parts}.")
_ORBITS = message("Choices of a frame: {inversions}; of a frame and a driven joint at it: {drives}.")


def _parts(numbers: Mapping[str, int]) -> str:
    return "; ".join(f"{name}: {number}" for name, number in numbers.items())


def count_simple_chains(
    links: int,
    mobility: int = 1,
    *,
    assortment: Sequence[int] | None = None,
    orbits: bool = False,
    executor: Executor | None = None,
) -> ChainCount:
    """Count the non-fractionated planar chains of simple revolute joints, none of them with a rigid part.

    Args:
        links: number of links, n.
        mobility: F >= 0; with F = 0 the chains are the Baranov trusses.
        assortment: count only chains with these numbers of binary, ternary, ... links.
        orbits: whether to count inversions, drives and joint orbits too; costs a few per cent.
        executor: runs the pieces of the work; by default this process.

    Definition and proofs: docs/theory/enumeration.md. Cost on one core: 0.01 s for 14 links, 0.17 s for 16,
    5.5 s for 18; the kernels release the lock of the interpreter, so threads (``ThreadPoolExecutor``) share the pieces.

    Raises:
        GrueblerError: links < 1, mobility < 0, or more loops than can be worked on.

    >>> count_simple_chains(8, orbits=True)
    ChainCount(links=8, mobility=1, chains=16, by_assortment={(4, 4): 9, (5, 2, 1): 5, (6, 0, 2): 2},
               inversions=71, drives=153, joint_orbits=84, by_fractionation={})
    """
    work = pieces(links, mobility, assortment=assortment)
    counts = [count for done in run_pieces(partial(count_piece, orbits=orbits), work, executor) for count in done]
    if loop_count(links, mobility) == 1 and (assortment is None or tuple(assortment) == (links,)):
        counts.append(
            PieceCount(assortment=(links,), chains=1, inversions=1, joint_orbits=1, drives=1)
        )  # one loop: all links alike, all joints alike
    return add_counts(links, mobility, counts, orbits)


def add_counts(links: int, mobility: int, counts: Iterable[PieceCount], orbits: bool) -> ChainCount:
    """The sum of the counts of pieces, in any order."""
    by_assortment: dict[Assortment, int] = {}
    chains = inversions = drives = joint_orbits = 0
    for count in counts:
        if count.chains:
            by_assortment[count.assortment] = by_assortment.get(count.assortment, 0) + count.chains
        chains += count.chains
        inversions += count.inversions
        drives += count.drives
        joint_orbits += count.joint_orbits
    ordered = dict(sorted(by_assortment.items()))
    return ChainCount(
        links=links,
        mobility=mobility,
        chains=chains,
        by_assortment=ordered,
        inversions=inversions if orbits else None,
        drives=drives if orbits else None,
        joint_orbits=joint_orbits if orbits else None,
    )
