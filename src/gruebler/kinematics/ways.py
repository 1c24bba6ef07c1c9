"""Ways and gaps of joints in a motion."""

from __future__ import annotations

from cmath import rect

import numpy as np

from gruebler.errors import LinkageError
from gruebler.kinematics.motion import Complexes, Motion, Reals
from gruebler.linkages import Circle, Line, Named, Wheel
from gruebler.linkages.wheels import arms, factors, round_joints, sliding_joint

__all__ = ["openness", "slide"]


def slide(motion: Motion, joint: str | int, order: int) -> Reals:
    """See `Motion.slide`."""
    mechanism = motion.linkage.mechanism
    number = joint if isinstance(joint, int) else mechanism.chain.find_joint(joint)
    if number is None or not sliding_joint(motion.linkage, number):
        sliding = [n for k, n in enumerate(mechanism.chain.joint_names()) if sliding_joint(motion.linkage, k)]
        raise LinkageError(f"{joint!r} is no sliding joint; there are {', '.join(sliding) or 'none'}")
    first, other = mechanism.chain.joints[number].links[:2]
    elements = motion.linkage.elements
    if not isinstance(elements[number, first], Line) or (
        other == mechanism.frame and isinstance(elements[number, other], Line)
    ):
        first, other = other, first
    line = elements[number, first]
    assert isinstance(line, Line)
    far = elements[number, other]
    gaps = [
        motion.complex_point(Named(other, far.x, far.y), k) - motion.complex_point(Named(first, line.x, line.y), k)
        for k in range(order + 1)
    ]
    k = motion._link(first)
    w, a, j = (motion.rates[m, :, k] if m < order else np.zeros(len(motion)) for m in range(3))
    direction = np.conj(motion.turns[:, k] * rect(1, line.angle))
    # the gap in coordinates that turn with the line
    if order == 0:
        seen = gaps[0]
    elif order == 1:
        seen = gaps[1] - 1j * w * gaps[0]
    elif order == 2:
        seen = gaps[2] - 2j * w * gaps[1] + (-1j * a - w**2) * gaps[0]
    else:
        seen = gaps[3] - 3j * w * gaps[2] + 3 * (-1j * a - w**2) * gaps[1] + (1j * (w**3 - j) - 3 * w * a) * gaps[0]
    out: Reals = (direction * seen).real
    return out


def openness(motion: Motion) -> float:
    """See `Motion.closure`."""
    lower = motion.plan.lower
    wheels = round_joints(lower.mechanism, lower.elements)
    largest = max(
        (_open_contact(motion, k) for k in round_joints(motion.linkage.mechanism, motion.linkage.elements)), default=0.0
    )
    for number, joint in enumerate(lower.mechanism.chain.joints):
        if number in wheels:
            continue
        first = joint.links[0]
        for other in joint.links[1:]:
            one, two = lower.elements[number, first], lower.elements[number, other]
            gap = _at(motion, other, two.x, two.y) - _at(motion, first, one.x, one.y)
            if isinstance(one, Line):
                assert isinstance(two, Line)
                turns = motion.turns
                direction = turns[:, motion._link(first)] * rect(1, one.angle)
                other_way = turns[:, motion._link(other)] * rect(1, two.angle)
                gap = np.conj(direction) * gap
                largest = max(largest, float(np.max(np.abs(gap.imag))) / lower.size)
                largest = max(largest, float(np.max(np.abs(other_way - direction))))
            else:
                largest = max(largest, float(np.max(np.abs(gap))) / lower.size)
    return largest


def _open_contact(motion: Motion, number: int) -> float:
    """How far wheels or circles leave each other, or turn against each other since the first row, in sizes."""
    linkage = motion.linkage
    chain, elements = linkage.mechanism.chain, linkage.elements
    a, b = chain.joints[number].links
    if isinstance(elements[number, b], Line):
        a, b = b, a
    one, other = elements[number, a], elements[number, b]
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


def _at(motion: Motion, link: str, x: float, y: float) -> Complexes:
    k = motion._link(link)
    return motion.places[0, :, k] + motion.turns[:, k] * complex(x, y)
