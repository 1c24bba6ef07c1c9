"""The numbers of chains and of their mechanisms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gruebler.base.notebook import explained
from gruebler.base.plain_data import plain
from gruebler.base.text import message
from gruebler.structure.enumeration.assortment import Assortment


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

        >>> from gruebler.structure.enumeration import count_chains
        >>> print(count_chains(6, orbits=True))
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

        >>> from gruebler.structure.enumeration import count_chains
        >>> count_chains(6).to_json()
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
