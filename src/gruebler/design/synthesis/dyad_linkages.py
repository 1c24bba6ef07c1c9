"""The linkage of two guiding dyads, placed in its first position."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from gruebler.design.synthesis.dyads import GuidingDyad
from gruebler.mechanics.fourbar import grashof
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism


def four_bar_linkages(
    first_dyad: GuidingDyad, second_dyad: GuidingDyad, point: complex, *, unit: str = "mm"
) -> Iterator[Linkage]:
    """The linkage of two dyads in its first position with a coupler point P, driven at each side: the better first.

    A side that turns fully drives first. Each is built when it is asked for. Raises `LinkageError` if pivots coincide.
    """
    orders = [(first_dyad, second_dyad), (second_dyad, first_dyad)]
    if not (first_dyad.slides or second_dyad.slides):
        turning = grashof(
            first_dyad.length,
            abs(first_dyad.moving - second_dyad.moving),
            second_dyad.length,
            abs(first_dyad.fixed - second_dyad.fixed),
        ).turning
        if "c" in turning and "a" not in turning:
            orders.reverse()
    elif first_dyad.kind.pairs[0].is_sliding and not second_dyad.kind.pairs[0].is_sliding:
        orders.reverse()
    return (linkage_of_dyads(first, second, point, unit) for first, second in orders)


def linkage_of_dyads(first_dyad: GuidingDyad, other_dyad: GuidingDyad, point: complex, unit: str) -> Linkage:
    """The linkage of two dyads in its first position, driven at the first; P lies on the coupler.

    Raises `LinkageError` if pivots of a link coincide.
    """
    first = first_dyad.kind.sides[0]
    second = other_dyad.kind.sides[1 if first_dyad.kind == other_dyad.kind or not other_dyad.slides else 0]
    parts: list[str] = []
    places: dict[str | int, object] = {}
    for side, dyad in ((first, first_dyad), (second, other_dyad)):
        for (symbol, place), links in zip(dyad.joints, (f"frame-{side}", f"{side}-coupler"), strict=True):
            parts.append(f"{symbol}({links})")
            places[parts[-1]] = place
    mechanism = _mechanism(f"{parts[0]} {parts[1]} {parts[3]} {parts[2]}; frame=frame; drive={parts[0]}")
    points = {"P": ("coupler", point.real, point.imag)}
    return Linkage.from_drawing(mechanism, places, points=points, unit=unit, outputs=[second])


_mechanism = cache(Mechanism.parse)
"""A synthesis gives some hundred linkages of few mechanisms."""
