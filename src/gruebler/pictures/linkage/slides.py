"""The sliding joints of a linkage: which link is the guide and which the block, and how far this travels."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Element, Linkage, LinkPoint
from gruebler.pictures.canvas.shapes import Point
from gruebler.pictures.linkage.posed_linkage import PosedLinkage

BLOCK = (14.0, 8.5)  # half sides of a block
BEYOND = 5.0  # pixels by which a guide extends beyond the block
FLAT = 1e-6  # sizes: points nearer to a line lie on it
_CALLED_BLOCKS = ("block", "slider", "piston", "stein", "kolben")
_STILL = 24.0  # pixels of a slide to both sides in a picture without a motion
_LONGEST = 1.8  # times its shortest length: the largest length of a cylinder


@dataclass(frozen=True, slots=True, kw_only=True)
class Slide:
    """The sign of a sliding joint."""

    joint: int
    guide: str
    block: str
    sign: str
    """``block``, ``slot`` (a pin in a slot) or ``cylinder``."""
    middle: complex
    """The middle of the block, in its own coordinates."""
    along: complex
    """The direction of the guide, in its coordinates."""
    low: complex
    """The ends of the path of the middle, in the guide's coordinates."""
    high: complex


def slides(posed: PosedLinkage) -> tuple[Slide, ...]:
    """The sliding joints, with the travel of their blocks on the path of the linkage."""
    chain = posed.lower.mechanism.chain
    return tuple(_slide(posed, k) for k, joint in enumerate(chain.joints) if joint.pair.is_sliding)


def _slide(posed: PosedLinkage, number: int) -> Slide:
    lower = posed.lower
    guide, block = _guide_and_block(posed, number)
    line, block_line = lower.elements[number, guide], lower.elements[number, block]
    middle = _foot(lower, block, block_line)
    start, along = complex(line.x, line.y), cmath.rect(1, line.direction)
    places = np.concatenate([_seen(motion, guide, block, middle) for motion in (posed.path, posed.pose)])
    offsets = ((places - start) * along.conjugate()).real
    low, high = float(offsets.min()), float(offsets.max())
    beyond = _beyond_roller(posed, block, block_line.direction, high - low)
    middle, low, high = middle + beyond * cmath.rect(1, block_line.direction), low + beyond, high + beyond
    sign = "block"
    if high - low < FLAT * lower.size and len(posed.path) == 1:  # nothing moves in the picture: how far is not known
        low, high = low - _STILL / posed.scale, high + _STILL / posed.scale
    if block not in posed.linkage.mechanism.chain.links and pins_of(lower, block):
        sign = "slot"
    elif _is_cylinder(lower, number, guide, start, along, low, high):
        sign = "cylinder"
    return Slide(
        joint=number,
        guide=guide,
        block=block,
        sign=sign,
        middle=middle,
        along=along,
        low=start + low * along,
        high=start + high * along,
    )


def _beyond_roller(posed: PosedLinkage, block: str, along: float, travel: float) -> float:
    """How far a block stands off its pin, along its line, so that the guide ends before a roller on that pin."""
    linkage, pose = posed.linkage, posed.pose
    joints = linkage.mechanism.chain.joints
    if block not in linkage.mechanism.chain.links or len(pins_of(posed.lower, block)) != 1:
        return 0.0
    rollers = {link for joint in joints if block in joint.links and joint.pair.is_turning for link in joint.links}
    for number, joint in enumerate(joints):
        for roller in (rollers - {block, linkage.mechanism.frame}) & set(joint.links):
            wheel = linkage.elements[number, roller]
            partner = next(link for link in joint.links if link != roller)
            touched = linkage.elements[number, partner]
            if wheel.rim > 0 and partner != block:
                away = pose.complex_point(LinkPoint(roller, wheel.x, wheel.y))
                away = away - pose.complex_point(LinkPoint(partner, touched.x, touched.y))
                line = pose.turns[0, pose.link_index(block)] * cmath.rect(1, along)
                side = math.copysign(1.0, (complex(away[0]) * line.conjugate()).real)
                return side * (wheel.rim + travel + (BLOCK[0] + 2 * BEYOND) / posed.scale)
    return 0.0


def _guide_and_block(posed: PosedLinkage, number: int) -> tuple[str, str]:
    """The frame is the guide, a link that represents a pin in a slot is the block; else the one with fewer joints is.

    Of two equal links the one with a name such as "block" is the block, else the second.
    """
    mechanism, links = posed.lower.mechanism, posed.linkage.mechanism.chain.links
    chain = mechanism.chain

    def rank(link: str) -> tuple[bool, bool, int, bool]:
        joints = sum(link in joint.links for joint in chain.joints)
        points = sum(point.link == link for point in posed.lower.points.values())
        return (
            link not in links,
            link != mechanism.frame,
            -joints - points,
            any(name in link.lower() for name in _CALLED_BLOCKS),
        )

    first, second = sorted(chain.joints[number].links, key=rank)
    return first, second


def pins_of(lower: Linkage, link: str) -> list[complex]:
    """The pins of a link, in its coordinates."""
    elements = [e for (_, owner), e in lower.elements.items() if owner == link and e.is_pin]
    return [complex(e.x, e.y) for e in elements]


def _foot(lower: Linkage, link: str, line: Element) -> complex:
    """The middle of a block: its single pin if that is on its line, else the origin of the displacement."""
    start, pins = complex(line.x, line.y), pins_of(lower, link)
    if len(pins) != 1:
        return start
    along = cmath.rect(1, line.direction)
    return start + ((pins[0] - start) * along.conjugate()).real * along


def _seen(path: Motion, link: str, other: str, point: complex) -> np.ndarray:
    """A point of another link in coordinates of a link, along a path."""
    k, m = (path.link_index(name) for name in (link, other))
    place = path.places[0, :, m] + path.turns[:, m] * point
    relative: np.ndarray = (place - path.places[0, :, k]) * path.turns[:, k].conj()
    return relative


def _is_cylinder(
    lower: Linkage, number: int, guide: str, start: complex, along: complex, low: float, high: float
) -> bool:
    """Whether a driven slide between two moving links has the proportions of a cylinder with its rod."""
    mechanism = lower.mechanism
    if all(drive.joint != number for drive in mechanism.drives) or guide == mechanism.frame:
        return False
    pins = [(pin - start) * along.conjugate() for pin in pins_of(lower, guide)]
    if len(pins) != 1 or abs(pins[0].imag) > FLAT * lower.size:
        return False
    distances = sorted(abs(end - pins[0].real) for end in (low, high))
    return (low - pins[0].real) * (high - pins[0].real) > 0 and distances[1] <= _LONGEST * distances[0]


def along_block(posed: PosedLinkage, slide: Slide) -> Point:
    """The direction of a slide in coordinates of its block, in pixels."""
    line = posed.lower.elements[slide.joint, slide.block]
    return Point(math.cos(line.direction), -math.sin(line.direction))


def outline_extent(posed: PosedLinkage, slide: Slide) -> tuple[float, float] | None:
    """Half the length and half the width, in pixels, of a block that has an outline of its own; None without one."""
    at, u = posed.local(slide.middle), along_block(posed, slide)
    outlines = posed.linkage.outlines.get(slide.block, ())
    corners = [posed.local(complex(*place)).minus(at) for o in outlines for place in o.places if len(o.places) > 2]
    if not corners:
        return None
    return max(abs(corner.dot(u)) for corner in corners), max(abs(corner.dot(u.across)) for corner in corners)
