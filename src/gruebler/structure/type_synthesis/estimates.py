"""Estimates of the time for a list of typed chains and mechanisms, before the computation."""

from __future__ import annotations

from math import comb

from gruebler.structure.type_synthesis.requirements import Requirements

# Seconds on one core, measured on chains of eight and ten links.
_CHAIN = 1e-3
_TYPED = 2e-4
_CHOICE = 2e-6  # a choice of sliding joints that is only counted
_RANK = 6e-4  # the mobility of a typed chain with sliders
_FRAME = 3e-4
_DRIVEN = 1e-3  # a frame with its drives, and the check that they fix the motion


def expected_seconds_of_variants(requirements: Requirements, *, mechanisms: bool, drives: bool) -> float:
    """The estimated time of `variants`, to a factor of about three; symmetry shortens it.

    Every assignment of the pairs to the joints of every chain counts.

    >>> few = expected_seconds_of_variants(Requirements(6, prismatic=2), mechanisms=False, drives=False)
    >>> many = expected_seconds_of_variants(Requirements(10, prismatic=5), mechanisms=False, drives=False)
    >>> few < 1, many > 100
    (True, True)
    """
    chains, simple = _chains_with_simple_joints(requirements, requirements.roll_slide)
    revolutes = max(0, simple - requirements.prismatic)
    typed = (
        chains
        * comb(requirements.links + requirements.roll_slide, requirements.roll_slide)
        * comb(simple, requirements.prismatic)
        * comb(revolutes, requirements.rolling)
    )
    seconds = chains * _CHAIN + typed * (_TYPED + _RANK * (requirements.prismatic > 0))
    if drives:
        # A link has two or three joints, each of which can be driven when it is the frame.
        return seconds + typed * comb(3 * requirements.links, max(1, requirements.mobility)) * _DRIVEN
    return seconds + typed * requirements.links * _FRAME * mechanisms


def expected_seconds_of_sliding(requirements: Requirements) -> float:
    """The estimated time of `count_sliding_variants`, to a factor of about three.

    >>> expected_seconds_of_sliding(Requirements(10)) < 15
    True
    """
    chains, simple = _chains_with_simple_joints(requirements)
    return float(chains * (_CHAIN + 2.0**simple * _CHOICE))


def _chains_with_simple_joints(requirements: Requirements, replaced: int = 0) -> tuple[int, int]:
    """About how many chains there are before links are replaced by contacts, and how many simple joints each has."""
    from gruebler.structure.enumeration.assortment import joint_count
    from gruebler.structure.enumeration.estimates import expected_chains
    from gruebler.structure.enumeration.request import Request

    links, mobility, multiple = requirements.links + replaced, requirements.mobility, requirements.multiple_joints
    chains, _ = expected_chains(Request(links, mobility=mobility, fractionated="all", multiple_joints=multiple))
    return chains, max(0, (joint_count(links, mobility) or 0) - 2 * (multiple + replaced))
