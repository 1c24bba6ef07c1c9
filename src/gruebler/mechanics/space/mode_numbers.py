"""How many assembly modes linkages of a structure have, complex ones included, as theorems say.

Theory and sources: docs/theory/modes-in-space.md.
"""

from __future__ import annotations

import numpy as np

from gruebler.mechanics.space.tree import ClosureTree
from gruebler.structure.assur.modes import MOST_JOINTS, MOST_LINKS, modes_of_trusses
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Space

ROD = "L"  # a rod between two balls, which only holds a length

LOOPS = {
    ("L", "R"): 2,  # RSSR, RRSS: a circle and a sphere
    ("L", "P"): 2,  # RSSP: a straight line and a sphere
    ("C", "C", "C"): 2,  # RCCC: the spherical four-bar of its directions, then two linear equations
    ("R", "R", "R", "R", "R", "R"): 16,  # 7R, the inverse of the general 6R: Primrose 1986; Lee, Liang 1988
}
"""Closed loops of bodies, by the kinds of their joints, the drive held."""

LEGS = {
    (("L",),) * 6: 40,  # Gough and Stewart: Ronga, Vust 1992; Lazard 1992; Mourrain 1993
    (("R", "S"),) * 3: 16,  # 3-RPS: Innocenti, Parenti-Castelli 1990
}
"""Two bodies and the legs between them, by the kinds of their joints from the first body on, the drives held."""

Leg = tuple[str, ...]


def known_number(tree: ClosureTree) -> int | None:
    """The number for almost all dimensions of this structure, its drives held; None if no theorem is known."""
    chain, of = tree.linkage.mechanism.chain, tree.bodies.of
    rods = {rod.link for rod in tree.rods}
    held = tree.bodies.held
    free = [joint for k, joint in enumerate(chain.joints) if k not in held]
    if tree.drives or any(len(joint.links) > 2 for joint in free if chain.space is Space.SPATIAL):
        return None
    if chain.space is not Space.SPATIAL:
        turning = all(joint.pair.is_turning for joint in free)
        return _of_truss(tree) if turning else None
    ties = []
    for joint in free:
        first, second = (of[chain.index(name)] for name in joint.links)
        if not rods & {first, second}:
            ties.append((joint.pair.symbol(Alphabet.INTERNATIONAL), first, second))
    ties += [(ROD, of[rod.first], of[rod.second]) for rod in tree.rods]
    legs = _legs(ties)
    if len(legs) == 1:
        ((_, _, word),) = legs
        turns = [turned[k:] + turned[:k] for turned in (word, word[::-1]) for k in range(len(word))]
        return LOOPS.get(min(turns))
    ends = {frozenset((first, last)) for first, last, _ in legs}
    if len(ends) != 1 or len(next(iter(ends))) != 2:
        return None
    base = legs[0][0]
    words = [word if first == base else word[::-1] for first, _, word in legs]
    return LEGS.get(min(tuple(sorted(words)), tuple(sorted(word[::-1] for word in words))))


def _of_truss(tree: ClosureTree) -> int | None:
    """Of turning joints in the plane and on the sphere: counted, docs/theory/counting-modes.md."""
    chain, of = tree.linkage.mechanism.chain, tree.bodies.of
    number = {body: k for k, body in enumerate(sorted({*of}))}
    joints = [
        sum({1 << number[of[chain.index(name)]] for name in joint.links})
        for k, joint in enumerate(chain.joints)
        if k not in tree.bodies.held
    ]
    if len(number) > MOST_LINKS or len(joints) > MOST_JOINTS:
        return None
    spherical = chain.space is Space.SPHERICAL
    return int(modes_of_trusses(len(number), np.array([joints], np.int64), spherical=spherical)[0]) or None


def _legs(ties: list[tuple[str, int, int]]) -> list[tuple[int, int, Leg]]:
    """Chains of bodies with two joints, from body to body; a loop of such bodies is one leg."""
    at: dict[int, list[int]] = {}
    for k, (_, first, second) in enumerate(ties):
        at.setdefault(first, []).append(k)
        at.setdefault(second, []).append(k)
    hubs = [body for body, joints in at.items() if len(joints) != 2] or list(at)[:1]
    left, legs = {*range(len(ties))}, []
    for hub in hubs:
        for start in at[hub]:
            if start not in left:
                continue
            body, tie, word = hub, start, []
            while True:
                left.discard(tie)
                kind, first, second = ties[tie]
                word.append(kind)
                body = second if body == first else first
                if body in hubs:
                    break
                tie = next(k for k in at[body] if k in left)
            legs.append((hub, body, tuple(word)))
    return legs
