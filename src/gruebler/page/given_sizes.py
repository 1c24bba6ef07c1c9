"""Sizes that have no field on the page: of wheels, cams and slotted wheels, and of points on their links."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import hypot

from gruebler.base.text import message, number, number_separator
from gruebler.mechanics.linkages import Linkage
from gruebler.teaching.worksheets.places import element_sizes


def given_sizes(linkage: Linkage, points: Mapping[str, str], lang: str) -> Iterator[str]:
    """A line for each round element and each named point, the points with their names in the language.

    >>> from gruebler.teaching.catalog import entry
    >>> linkage = entry("cam").linkage()
    >>> list(given_sizes(linkage, {}, "en"))
    ['cam [mm]: lift (rise 8 over 75°, fall 8 over 75°, dwell), base circle 40, flat face.']
    >>> list(given_sizes(entry("cam_rocker_flat").linkage(), {}, "de"))[0][:59]
    'cam [mm]: Hub (Anstieg 12° über 90°; Rast 60°; Abstieg 12° '
    """
    unit = f" [{linkage.unit}]" if linkage.unit else ""
    between = number_separator(lang)
    lines: dict[str, None] = {}
    for (_, link), element in sorted(linkage.elements.items()):
        sizes = between.join(element_sizes(element, lang, in_words=True)) if element.form == "round" else ""
        if sizes:
            lines[f"{link}{unit}: {sizes}."] = None  # a wheel that meets several is said once
    yield from lines
    joints = linkage.mechanism.chain.joints
    for name, point in linkage.points.items():
        ways = [
            message(
                "{length} to {links}",
                length=number(hypot(e.x - point.x, e.y - point.y), lang, ".5g"),
                links=" – ".join(other for other in joints[joint].links if other != link),
            ).in_language(lang)
            for (joint, link), e in sorted(linkage.elements.items())
            if link == point.link and e.form == "pin"
        ]
        if ways:
            yield f"{points.get(name, name)}{unit}: {between.join(ways)}."
