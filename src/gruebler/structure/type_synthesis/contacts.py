"""Roll-slide joints: a contact replaces a binary link between two turning pairs.

A roll-slide joint takes away one motion, along the common normal at the point of contact. So does a binary link with
two revolutes, along its own line: the two centres of curvature lie at its ends. Counted and generic mobility are the
same (docs/theory/mobility.md, where a contact is a bar), so the chains with k contacts and mobility F are exactly the
chains of revolutes with k more links, k binary ones of which, no two of them neighbours, are taken as contacts.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from gruebler.base.errors import ChainError
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import orbits, symmetry


def with_contacts(chain: Chain, number: int) -> Iterator[Chain]:
    """The chain with this number of its binary links, joined by revolutes, replaced by roll-slide joints.

    One for each orbit of choices; the remaining links keep their names. Cost O(choices · generators).

    >>> [str(gears) for gears in with_contacts(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), 1)]
    ['R(1-2) R(2-3) G(1-3)']
    """
    if number < 0:
        raise ChainError("the number of roll_slide joints is 0 or more, not {number}", number=number)
    ends = {link: _neighbours(chain, link) for link in chain.links}
    bars = [link for link in chain.links if len(set(ends[link])) == 2 == chain.degrees[link]]
    choices = [
        frozenset(chosen)
        for chosen in combinations(bars, number)
        if not any(other in ends[link] for link in chosen for other in chosen) and chain.n - number >= 3
    ]
    images = [
        {choice: frozenset(chain.links[g.links[chain.index(link)]] for link in choice) for choice in choices}
        for g in symmetry(chain).generators
    ]
    for orbit in orbits(choices, images):
        chosen = orbit[0]
        remaining = [joint for joint in chain.joints if not chosen & set(joint.links)]
        contacts = [("roll_slide", ends[link]) for link in chain.links if link in chosen]
        links = [link for link in chain.links if link not in chosen]
        yield Chain([*remaining, *contacts], links=links, space=chain.space)


def _neighbours(chain: Chain, link: str) -> list[str]:
    """The links at the other ends of a link's simple revolutes; other joints do not count."""
    return [
        other
        for joint in chain.joints_of(link)
        if joint.pair.is_turning and joint.count == 1
        for other in joint.links
        if other != link
    ]
