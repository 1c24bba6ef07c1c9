"""The joint: a place where links meet."""

from __future__ import annotations

from dataclasses import dataclass

from gruebler.structure.chain import notation
from gruebler.structure.chain.pairs import Pair


@dataclass(frozen=True, slots=True)
class Joint:
    """A place where two or more links meet with one pair; a joint of k links counts k - 1.

    See Also:
        `Chain`

    Theory:
        docs/theory/freedoms.md
    """

    pair: Pair
    links: tuple[str, ...]

    @property
    def count(self) -> int:
        """How often the joint counts in F: k - 1."""
        return len(self.links) - 1

    def __str__(self) -> str:
        return notation.joint_text(self.pair.symbol(), self.links)

    @property
    def key(self) -> tuple[str, tuple[str, ...]]:
        """What makes two joints equal: the pair and the links in any order."""
        return self.pair.name, tuple(sorted(self.links))
