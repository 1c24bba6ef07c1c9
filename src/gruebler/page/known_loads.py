"""What the page knows of the loads of a linkage before it asks for forces: where they come from, and its springs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gruebler.base.units import metres_of
from gruebler.files.load_reading import loads_of_document
from gruebler.mechanics.forces import Loads, Spring, TorsionSpring
from gruebler.mechanics.linkages import Linkage
from gruebler.teaching.catalog import entries

RATES = ("stiffness", "preload", "damping")


def loads_at_hand(document: Mapping[str, Any], source: str, linkage: Linkage) -> tuple[Loads, float | None]:
    """Loads of the document of a linkage, or of its catalog entry while its links are there; and the usual speed."""
    entry = entries().get(source)
    links = linkage.mechanism.chain.links
    if document.get("loads") or entry is None or entry.loads is None or entry.chain().links != links:
        return loads_of_document(document, linkage)
    _, loads, speed = entry.loaded()
    return loads, speed


def all_springs(loads: Loads) -> tuple[Spring | TorsionSpring, ...]:
    """Straight ones, then torsion springs."""
    return (*loads.springs, *loads.torsion_springs)


def springs_of(linkage: Linkage, loads: Loads) -> list[dict[str, Any]]:
    """The springs, straight ones first, as the page sends them back."""
    records: list[dict[str, Any]] = []
    for known, spring in enumerate(all_springs(loads)):
        turning, ends = isinstance(spring, TorsionSpring), spring_ends(linkage, spring)
        free = spring.free_angle if isinstance(spring, TorsionSpring) else spring.free_length
        scale = metres_of(linkage.unit) if turning else 1.0
        rates = {rate: scale * getattr(spring, rate) for rate in RATES} | {"free": free}
        records.append({"turning": turning, "ends": ends, "known": None if spring.law is None else known, **rates})
    return records


def spring_ends(linkage: Linkage, spring: Spring | TorsionSpring) -> tuple[tuple[int, float, float], ...]:
    """The links of its ends, and the places there; those of a torsion spring say nothing."""
    index = linkage.mechanism.chain.index
    if isinstance(spring, TorsionSpring):
        return tuple((index(link), 0.0, 0.0) for link in spring.between)
    places = [linkage.points_named(end) for end in spring.between]
    pairs = ((near, far) for near in places[0] for far in places[1] if near.link != far.link)
    return tuple((index(place.link), place.x, place.y) for place in next(pairs))
