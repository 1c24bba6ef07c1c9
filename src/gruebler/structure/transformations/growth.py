"""The growth of a chain by dyads: from a closed loop, or from a core without a removable dyad.

A dyad of a closed chain is *removable* if every other link keeps two joints or more. Removing one may make another
irremovable (they share a neighbour with three joints), so in general the order matters and all are tried. For a sound
chain with F = 1 it does not: docs/theory/transformations.md, "Growth".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from gruebler.base.doors import door
from gruebler.base.errors import TransformationError
from gruebler.base.notebook import explained
from gruebler.base.text import message, plural, translate
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.isomorphism import code
from gruebler.structure.mobility import counted, generic
from gruebler.structure.transformations.derivations import Derivation
from gruebler.structure.transformations.dyads import Insertion, dyad_at
from gruebler.structure.transformations.places import Attachment

_BUDGET = 5_000  # chains visited


@explained
@dataclass(frozen=True)
class Growth:
    """The growth of a chain by dyads."""

    chain: Chain
    derivation: Derivation
    """From the loop or the core, dyad by dyad, to the chain."""
    exact: bool
    """False if the search ended early and had not found a growth from a loop."""

    @property
    def core(self) -> Chain:
        """The loop, or the chain that remains when no dyad can be removed."""
        return self.derivation.start

    @property
    def from_loop(self) -> bool:
        """Whether the chain grows from a closed loop by dyads alone."""
        return is_loop(self.core)

    def explain(self, lang: str = "en") -> str:
        """In words, in English (``en``) or German (``de``)."""
        core, steps = self.core, len(self.derivation.steps)
        text, links = core.text(Alphabet.of_language(lang)), ", ".join(core.links)
        if self.from_loop and not steps:
            return translate("The chain is one closed loop of {links} links.", lang, links=core.n)
        if self.from_loop:
            lines = [
                plural(
                    "The chain grows from the closed loop of {links} links {loop} by one dyad.",
                    "The chain grows from the closed loop of {links} links {loop} by {count} dyads.",
                    steps,
                    lang,
                    links=core.n,
                    loop=text,
                )
            ]
        else:
            if steps:
                verdict = message(
                    "The chain does not grow from a closed loop by dyads: {core} is left ({n} links: {links}; "
                    "F = {F}), in which no dyad can be removed."
                )
            else:
                verdict = message(
                    "The chain does not grow by dyads: none can be removed from it ({n} links: {links}; F = {F})."
                )
            lines = [verdict.filled(core=text, n=core.n, links=links, F=counted(core)).in_language(lang)]
            lines.append(translate("Code of the core: {code}", lang, code=code(core)))
            if steps:
                lines.append(
                    plural("From there it grows by one dyad.", "From there it grows by {count} dyads.", steps, lang)
                )
            if not self.exact:
                lines.append(
                    translate("The search ended early: another order of the dyads might lead to a loop.", lang)
                )
        if steps:
            lines.append(self.derivation.explain(lang))
        return "\n".join(lines)


def is_loop(chain: Chain) -> bool:
    """Whether the chain is one closed loop of binary links.

    >>> is_loop(Chain.parse("R(0-1) R(1-2) P(2-0)"))
    True
    """
    return not chain.multiple_joints and set(chain.degrees.values()) == {2}


def removable_dyads(chain: Chain) -> Iterator[Insertion]:
    """The dyads that can be removed such that every remaining link keeps two joints or more.

    >>> [dyad.links for dyad in removable_dyads(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"))]
    [('0', '1'), ('4', '5')]
    """
    if chain.n < 5:
        return
    degrees = chain.degrees
    for joint in chain.joints:
        if joint.count > 1 or any(degrees[link] != 2 for link in joint.links):
            continue
        x, y = joint.links
        around = [j for link in (x, y) for j in chain.joints_of(link) if j is not joint]
        if any(degrees[link] < 3 for j in around if j.count == 1 for link in j.links if link not in (x, y)):
            continue
        try:
            yield dyad_at(chain, (x, y))
        except TransformationError:
            continue


@door
def derive(chain: Chain) -> Growth:
    """The growth of a chain by dyads from a closed loop; without one, from the smallest core found.

    Exact: that there is no growth from a loop is proved by trying all orders, or by the theorem for sound chains with
    F = 1. Only for other chains of many dyads the search ends early, and `Growth.exact` is False.

    Args:
        chain: any planar or spherical chain.

    Returns:
        `Growth`: ``core`` and the steps that lead from it to the chain; ``exact`` False if the search ended early.

    Raises:
        GrueblerError: a chain that is neither planar nor spherical.

    Cost:
        O(dyads · links) where the order does not matter.

    Example:
        >>> growth = derive(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"))
        >>> print(growth.core)
        R(2-3) R(2-4) R(4-5) R(5-3)

    See Also:
        `extend`, `mobility_report`, `decompose`

    Theory:
        docs/theory/transformations.md
    """
    longest: list[Insertion] = []
    visited: set[frozenset[str]] = set()
    stack: list[tuple[Chain, list[Insertion]]] = [(chain, [])]
    one_order: bool | None = None
    complete = True
    while stack:
        current, removed = stack.pop()
        if len(removed) > len(longest):
            longest = removed
        if is_loop(current):
            longest = removed
            break
        if len(visited) >= _BUDGET:
            complete = False
            break
        dyads = list(removable_dyads(current))
        if not dyads:
            one_order = _order_does_not_matter(chain) if one_order is None else one_order
            if one_order:
                break
        for dyad in reversed(dyads):
            remaining = frozenset(dyad.remainder.links)
            if remaining not in visited:
                visited.add(remaining)
                stack.append((dyad.remainder, [*removed, dyad]))
    derivation = Derivation(longest[-1].remainder if longest else chain)
    for dyad in reversed(longest):
        places = [_same_place(dyad.remainder, place, derivation.chain) for place in dyad.between]
        derivation = derivation.then("insert_dyad", form=dyad.letters, between=places, links=list(dyad.links))
    return Growth(chain, derivation, complete or is_loop(derivation.start))


def _same_place(chain: Chain, place: Attachment, other: Chain) -> Attachment:
    """The place in an equal chain with its joints in another order."""
    if isinstance(place, str):
        return place
    joint = chain.joints[place]
    return next(k for k, j in enumerate(other.joints) if j.pair == joint.pair and set(j.links) == set(joint.links))


def _order_does_not_matter(chain: Chain) -> bool:
    """Whether the chain is sound with F = 1: nothing redundant, and no two links rigid against each other."""
    if chain.space.b != 3 or counted(chain) != 1:
        return False
    rank = generic(chain)
    return rank.redundancy == 0 and len(rank.clusters) == chain.n
