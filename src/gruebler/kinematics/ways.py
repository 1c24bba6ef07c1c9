"""Ways and gaps of joints in a motion."""

from __future__ import annotations

from cmath import rect

import numpy as np

from gruebler.errors import LinkageError
from gruebler.kinematics.motion import Motion, Reals
from gruebler.linkages import Line, Named
from gruebler.linkages.wheels import sliding_joint

__all__ = ["slide"]


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
