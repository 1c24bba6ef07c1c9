"""What the bodies of higher pairs are, for the structure picture of a linkage."""

from __future__ import annotations

from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.elements import (
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    NonCircular,
    Pin,
    Wheel,
)


def contact_shapes(linkage: Linkage) -> dict[tuple[int, str], str]:
    """For every joint that rolls or slides in a point, by number and link: a word of `symbols.CONTACTS`.

    >>> from gruebler.structure.mechanism import Mechanism
    >>> pair = Mechanism.parse("R(0-1) R(0-2) G(1-2); drive=R(0-1)")
    >>> wheels = {"1": Wheel(0, 0, 20, 20), "2": Wheel(60, 0, 40, 40)}
    >>> made = Linkage.from_drawing(pair, {"R(0-1)": (0, 0), "R(0-2)": (60, 0), "G(1-2)": wheels})
    >>> sorted(contact_shapes(made).values())
    ['gear', 'gear']
    """
    shapes = {}
    for number, joint in enumerate(linkage.mechanism.chain.joints):
        if not joint.pair.is_higher or len(joint.links) != 2:
            continue
        first, second = (linkage.elements[number, link] for link in joint.links)
        rolls = joint.pair.rolls
        for link, element, other in zip(joint.links, (first, second), (second, first), strict=True):
            shapes[number, link] = _shape(element, other, rolls=rolls)
    return shapes


_SHAPES = {
    Circle: "roller",
    CamDisc: "cam",
    GenevaDriver: "geneva-driver",
    GenevaWheel: "geneva-wheel",
    NonCircular: "oval",
    Pin: "pin",
}


def _shape(element: Element, other: Element, *, rolls: bool) -> str:
    if isinstance(element, Wheel):
        if element.belt:
            return "crossed" if element.belt == "crossed" else "belt"
        return "ring" if element.radius < 0 else "wheel" if rolls else "gear"
    if isinstance(element, Line):
        return "slot" if isinstance(other, Pin) else "rack" if isinstance(other, Wheel) else "flat"
    return _SHAPES[type(element)]
