"""By how much the joints of a motion are open."""

from __future__ import annotations

from cmath import rect

import numpy as np

from gruebler.kinematics.contacts import law_at
from gruebler.kinematics.contours import cam_law, turn_law
from gruebler.kinematics.motion import Complexes, Motion, Reals
from gruebler.linkages import Circle, Disc, Driver, Line, Linkage, NonCircular, Wheel
from gruebler.linkages.elements import INVERSE
from gruebler.linkages.wheels import arms, factors, round_joints

__all__ = ["joint_openings", "openness"]

_LEADING = (Disc, Driver, NonCircular)


def openness(motion: Motion) -> float:
    """See `Motion.closure`."""
    lower = motion.plan.lower
    wheels = round_joints(lower.mechanism, lower.elements)
    largest = max(
        (_open_contact(motion, k) for k in round_joints(motion.linkage.mechanism, motion.linkage.elements)), default=0.0
    )
    gaps = [
        joint_openings(motion, linkage, number)
        for linkage, numbers in (
            (lower, set(range(len(lower.mechanism.chain.joints))) - set(wheels)),
            (motion.linkage, motion.plan.released),
        )
        for number in numbers
    ]
    return max([largest, *(float(gap.max(initial=0.0)) for gap in gaps)])


def joint_openings(motion: Motion, linkage: Linkage, number: int) -> Reals:
    """By how much a joint of pins and lines is open in each row, in sizes and radians; (rows,).

    The linkage is that of the motion, or the one with lower pairs.
    """
    joint = linkage.mechanism.chain.joints[number]
    out = np.zeros(len(motion))
    for first, other in ((joint.links[0], other) for other in joint.links[1:]):
        if not isinstance(linkage.elements[number, first], Line):
            first, other = other, first  # noqa: PLW2901
        one, two = linkage.elements[number, first], linkage.elements[number, other]
        gap = (_at(motion, other, two.x, two.y) - _at(motion, first, one.x, one.y)) / linkage.size
        if isinstance(one, Line):
            line = motion.turns[:, motion._link(first)] * rect(1, one.angle)
            if joint.pair.name != "double_slide":
                out = np.maximum(out, np.abs((np.conj(line) * gap).imag))
            if isinstance(two, Line):
                out = np.maximum(out, np.abs(motion.turns[:, motion._link(other)] * rect(1, two.angle) - line))
        else:
            out = np.maximum(out, np.abs(gap))
    return out


def _open_contact(motion: Motion, number: int) -> float:
    """How far wheels or circles leave each other, or turn against each other since the first row, in sizes."""
    linkage = motion.linkage
    chain, elements = linkage.mechanism.chain, linkage.elements
    a, b = chain.joints[number].links
    if isinstance(elements[number, b], Line):
        a, b = b, a
    one, other = elements[number, a], elements[number, b]
    if isinstance(one, _LEADING) or isinstance(other, _LEADING):
        return _open_curve(motion, number) / linkage.size
    assert isinstance(other, Wheel | Circle)
    gap = _at(motion, b, other.x, other.y) - _at(motion, a, one.x, one.y)
    touching = chain.joints[number].pair.name == "rolling" or isinstance(other, Circle)
    if isinstance(one, Line):
        gap *= np.conj(motion.turns[:, motion._link(a)] * rect(1, one.angle))
        radius = np.copysign(other.radius, gap.imag)
        far, rolled = np.abs(gap.imag - radius), radius * (motion.angle(b) - motion.angle(a)) + gap.real
    else:
        assert isinstance(one, Wheel | Circle)
        far = np.abs(np.abs(gap) - abs(one.radius + other.radius))
        arm = arms(linkage.mechanism, elements).get(number)
        along = np.unwrap(np.angle(gap)) if arm is None else motion.angle(arm.link)
        if isinstance(one, Wheel) and isinstance(other, Wheel):
            first, second = factors(one, other)
            rolled = first * (motion.angle(a) - along) + second * (motion.angle(b) - along)
    largest = float(far.max()) if touching else 0.0
    if isinstance(other, Wheel):
        largest = max(largest, float(np.abs(rolled - rolled[0]).max()))
    return largest / linkage.size


def _open_curve(motion: Motion, number: int) -> float:
    """How far a follower leaves its cam, or a Geneva or non-circular wheel its angle, times a length."""
    elements = motion.linkage.elements
    a, b = motion.linkage.mechanism.chain.joints[number].links
    last = elements[number, b]
    if isinstance(last, Disc | Driver) or (isinstance(last, NonCircular) and last.transfer != INVERSE):
        a, b = b, a
    one, other = elements[number, a], elements[number, b]
    assert isinstance(one, Disc | Driver | NonCircular)
    gap = _at(motion, b, other.x, other.y) - _at(motion, a, one.x, one.y)
    along = motion.turns[:, motion._link(a)] * rect(1, one.angle)
    if isinstance(one, Driver | NonCircular):
        law = turn_law(one, other)
        bearing = np.unwrap(np.angle(gap))
        turned = motion.angle(a) + one.angle - bearing
        turned += np.angle(along[0] / gap[0] * abs(gap[0])) - turned[0]
        wheel = motion.angle(b) - bearing
        off = np.array([law_at(law, float(t)) for t in turned]) - wheel
        return float(np.abs(off - off[0]).max()) * motion.linkage.size
    law = cam_law(one)
    if isinstance(other, Line):
        normal = 1j * motion.turns[:, motion._link(b)] * rect(1, other.angle)
        height = (np.conj(normal) * gap).real
        normal, height = normal * np.sign(height), np.abs(height)
        wanted = np.array([law_at(law, float(t)) for t in np.angle(normal / along)])
    else:
        wanted = np.exp([law_at(law, float(t)) for t in np.angle(gap / along)])
        height = np.abs(gap)
    return float(np.abs(height - wanted).max())


def _at(motion: Motion, link: str, x: float, y: float) -> Complexes:
    k = motion._link(link)
    return motion.places[0, :, k] + motion.turns[:, k] * complex(x, y)
