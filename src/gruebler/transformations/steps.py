"""The record of one transformation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gruebler.chain import Chain

__all__ = [
    "Step",
]


@dataclass(frozen=True)
class Step:
    """One transformation: what was done, where, and the chains before and after.

    `where` holds the arguments of the function that is called like `kind`, all names written out, as plain data; so the
    step can be done again (`gruebler.transformations.replay`).
    """

    kind: str
    where: Mapping[str, Any]
    before: Chain
    chain: Chain
    """The new chain."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "where", dict(self.where))

    def __hash__(self) -> int:
        return hash((self.kind, self.before, self.chain))

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`: kind, where, and the new chain as a text to compare with."""
        return {"kind": self.kind, "where": dict(self.where), "result": self.chain.text()}

    def explain(self, lang: str = "en") -> str:
        """The step in a sentence, in English (``en``) or German (``de``)."""
        from gruebler.transformations.messages import explain_step

        return explain_step(self, lang)
