"""The replacement of a roll-slide joint by its instantaneously equivalent binary link, and its inverse.

The link's revolutes lie in the centres of curvature of the two contours; a straight contour has its centre at infinity,
which makes a prismatic joint of that end. Counted and generic mobility stay: docs/theory/transformations.md.
"""

from __future__ import annotations

from gruebler.base.errors import TransformationError, naming
from gruebler.base.text import message
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Pair, pair
from gruebler.structure.transformations.places import (
    ChainBuilder,
    check_counting,
    letters_of_pairs,
    links_at,
    new_link_names,
    pairs_from_letters,
)
from gruebler.structure.transformations.steps import Step


def _replaces_roll_slide(first: Pair, second: Pair) -> bool:
    return first.is_basic and second.is_basic and (first.is_turning or second.is_turning)


def replace_roll_slide(chain: Chain, joint: int, pairs: str = "RR", link: str | None = None) -> Step:
    """Replace a roll-slide joint by a binary link; F is unchanged.

    Args:
        chain: a planar or spherical chain.
        joint: the number of the roll-slide joint.
        pairs: RR, or RP (PR) where the second (first) of the joint's links has a straight contour.
        link: the name of the new link; by default the lowest free number.

    >>> print(replace_roll_slide(Chain.parse("R(frame-cam) G(cam-valve) P(valve-frame)"), 1, "RP", "contact").chain)
    R(frame-cam) R(cam-contact) P(contact-valve) P(valve-frame)
    """
    check_counting(chain)
    first, second = pairs_from_letters(pairs, 2, message("pair of joints"))
    letters = letters_of_pairs((first, second))
    if not _replaces_roll_slide(first, second):
        raise TransformationError("a roll-slide joint is replaced by RR, RP or PR, not by {pairs!r}", pairs=pairs)
    a, *rest = links_at(chain, joint)
    if not chain.joints[joint].pair.rolls_and_slides:
        raise TransformationError("{joints} is not a roll-slide joint", joints=chain.joints[joint])
    (name,) = new_link_names(chain, 1, None if link is None else [link])
    builder = ChainBuilder(chain)
    builder.joints[joint : joint + 1] = [(first, [a, name]), (second, [name, *rest])]
    return Step("replace_roll_slide", {"joint": joint, "pairs": letters, "link": name}, chain, builder.done([name]))


def restore_roll_slide(chain: Chain, link: str) -> Step:
    """Replace a binary link with two revolutes, or a revolute and a prismatic joint, by a roll-slide joint.

    >>> print(restore_roll_slide(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), "2").chain)
    R(0-1) G(1-3) R(3-0)
    """
    check_counting(chain)
    chain.index(link)
    numbers = [k for k, joint in enumerate(chain.joints) if link in joint.links]
    joints = [chain.joints[k] for k in numbers]
    others = [a for joint in joints for a in joint.links if a != link]
    if len(numbers) != 2 or any(j.count > 1 for j in joints) or not _replaces_roll_slide(*(j.pair for j in joints)):
        raise TransformationError(
            "{link} cannot be replaced by a roll-slide joint: it must be a binary link with two simple "
            "revolutes, or one revolute and one prismatic joint",
            link=link,
        )
    if others[0] == others[1]:
        raise TransformationError(
            "{link} cannot be replaced by a roll-slide joint: both its joints are on {others!r}",
            link=link,
            others=others[0],
        )
    contact = (pair("roll_slide"), others)
    joints_left = [(j.pair, list(j.links)) for j in chain.joints]
    joints_left[numbers[0]] = contact
    del joints_left[numbers[1]]
    with naming(message("without {link} there is no chain left", link=link), TransformationError):
        restored = Chain(joints_left, links=[a for a in chain.links if a != link], space=chain.space)
    return Step("restore_roll_slide", {"link": link}, chain, restored)
