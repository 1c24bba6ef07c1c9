"""The names of the links of a mechanism: frame, crank, rocker, coupler, slider, ..."""

from __future__ import annotations

from collections import Counter
from enum import StrEnum
from itertools import count

from gruebler.base.text import message
from gruebler.structure.mechanism.model import Mechanism


class Role(StrEnum):
    """The role of a link, as far as the structure alone determines it."""

    FRAME = "frame"
    CRANK = "crank"
    ROCKER = "rocker"
    SLIDER = "slider"
    ROLLER = "wheel"
    COUPLER = "coupler"

    def in_language(self, lang: str) -> str:
        """The role in English (``en``) or German (``de``)."""
        return _NAMES[self].in_language(lang)


_NAMES = {
    Role.FRAME: message("frame"),
    Role.CRANK: message("crank"),
    Role.ROCKER: message("rocker"),
    Role.SLIDER: message("slider"),
    Role.ROLLER: message("wheel"),
    Role.COUPLER: message("coupler"),
}


def roles(mechanism: Mechanism) -> dict[str, Role]:
    """The role of each link.

    The frame; a crank (a revolute at the frame that is driven); a slider (a sliding joint at the frame); a wheel (a
    revolute at the frame and a rolling or roll-slide contact); a rocker (any other revolute at the frame: the structure
    does not determine whether it turns fully); a coupler (not joined to the frame).

    >>> [str(r) for r in roles(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)")).values()]
    ['frame', 'crank', 'coupler', 'rocker']
    """
    chain, frame = mechanism.chain, mechanism.frame
    driven = {(d.joint, link) for d in mechanism.drives for link in d.between if frame in d.between}
    named = {}
    for link in chain.links:
        joints = {k: j for k, j in enumerate(chain.joints) if link in j.links}
        at_frame = {k: j.pair for k, j in joints.items() if frame in j.links}
        touches = any(j.pair.has_contours for j in joints.values())
        if link == frame:
            role = Role.FRAME
        elif any(pair.is_turning and (k, link) in driven for k, pair in at_frame.items()):
            role = Role.CRANK
        elif any(pair.guides for pair in at_frame.values()):
            role = Role.SLIDER
        elif any(pair.is_turning for pair in at_frame.values()):
            role = Role.ROLLER if touches else Role.ROCKER
        else:
            role = Role.COUPLER
        named[link] = role
    return named


def named_by_roles(mechanism: Mechanism) -> Mechanism:
    """The mechanism with roles for names where its links have only numbers; several of a role are counted.

    >>> watt = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3) R(3-4) R(4-5) R(0-5); drive=R(0-1)")
    >>> named_by_roles(watt).chain.links
    ('frame', 'crank', 'coupler1', 'rocker1', 'coupler2', 'rocker2')
    >>> print(named_by_roles(Mechanism.parse("R(a-b) R(b-c) R(c-d) R(d-a); drive=R(a-b)")))
    R(a-b) R(b-c) R(c-d) R(d-a); frame=a; drive=R(a-b)
    """
    if not all(link.isdigit() for link in mechanism.chain.links):
        return mechanism
    named = roles(mechanism)
    total, numbers = Counter(named.values()), {role: count(1) for role in Role}
    return mechanism.renamed(
        {link: f"{role}{next(numbers[role])}" if total[role] > 1 else str(role) for link, role in named.items()}
    )
