"""How long a list of typed chains and mechanisms will take, told before it is begun."""

from __future__ import annotations

from math import comb

from gruebler.type_synthesis.requirements import Requirements

__all__ = ["expected_seconds_of_variants"]

# Seconds on one core, measured on chains of eight and ten links.
_CHAIN = 1e-3
_TYPED = 2e-4
_RANK = 6e-4  # the mobility of a typed chain with sliders
_FRAME = 3e-4
_DRIVEN = 1e-3  # a frame with its drives, whether they fix the motion


def expected_seconds_of_variants(wanted: Requirements, *, mechanisms: bool, drives: bool) -> float:
    """About how long `variants` takes, to a factor of three or so; symmetry makes it shorter.

    Args:
        wanted: the requirements.
        mechanisms: whether frames are distinguished.
        drives: whether drives are, too.

    Every way to put the pairs on the joints of every chain is tried.

    >>> few = expected_seconds_of_variants(Requirements(6, prismatic=2), mechanisms=False, drives=False)
    >>> many = expected_seconds_of_variants(Requirements(10, prismatic=5), mechanisms=False, drives=False)
    >>> few < 1, many > 100
    (True, True)
    """
    from gruebler.enumeration.assortment import joint_count
    from gruebler.enumeration.estimates import expected_chains
    from gruebler.enumeration.request import Request

    links = wanted.links + wanted.roll_slide
    chains, _ = expected_chains(Request(links, wanted.mobility, "all", None, wanted.multiple_joints))
    simple = (joint_count(links, wanted.mobility) or 0) - 2 * (wanted.multiple_joints + wanted.roll_slide)
    left = max(0, simple - wanted.prismatic)
    typed = (
        chains * comb(links, wanted.roll_slide) * comb(max(0, simple), wanted.prismatic) * comb(left, wanted.rolling)
    )
    seconds = chains * _CHAIN + typed * (_TYPED + _RANK * (wanted.prismatic > 0))
    if drives:
        # A link has two or three joints, each of which can be driven when it is the frame.
        return seconds + typed * comb(3 * wanted.links, max(1, wanted.mobility)) * _DRIVEN
    return seconds + typed * wanted.links * _FRAME * mechanisms
