"""Lengths that are given: which mechanisms can have them, and the size of a linkage that has one.

docs/theory/synthesis.md.
"""

from __future__ import annotations

from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.judging import NO_LENGTH, ONE_PIVOT, distances_of_pins
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism


def missing_length(mechanism: Mechanism, demands: Demands) -> Message | None:
    """Which given length or direction a mechanism cannot have, in a sentence: of a link with fewer than two pins."""
    links = links_with_lengths(mechanism)
    if demands.frame_direction is not None and mechanism.frame not in links:
        return ONE_PIVOT
    return next((NO_LENGTH.filled(link=message(link)) for link, _ in demands.lengths if link not in links), None)


def links_with_lengths(mechanism: Mechanism) -> list[str]:
    """Those with two pins or more."""
    held = [link for joint in mechanism.chain.joints if not joint.pair.is_sliding for link in joint.links]
    return [link for link in mechanism.chain.links if held.count(link) > 1]


def scale_to_length(linkage: Linkage, demands: Demands) -> float:
    """What makes a linkage for angles, which has no size of its own, one with the first of the given lengths."""
    wanted = demands.lengths[:1]
    return next((length / own for link, length in wanted for own in distances_of_pins(linkage, link)), 1.0)
