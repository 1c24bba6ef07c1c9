"""How closely the path of a coupler lever touches its tangent: in closed form, by power series in the crank's angle.

A series is the array of the coefficients of 1, t, t^2, ..., t the crank angle from the point looked at. For linkages of
any kind there is `gruebler.mechanics.geometry.contact`, by another way.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch, branch_of_side, branch_side
from gruebler.mechanics.linkages.quantities import as_finite

_ORDER = 9
_ZERO = 1e-9  # of the linkage's size, or of what a coefficient may be: smaller ones are roundings


@dataclass(frozen=True, slots=True)
class LeverContact:
    """The path as y = c x^n + ... in the frame of its point and its tangent."""

    points: int
    """n: the curve and the tangent have so many points in common there (2: an ordinary point, 3: an inflection)."""
    coefficient: float
    """c, per length^(n - 1); positive if the curve is to the left of the tangent, as it is run through."""
    direction: float
    """Of the tangent, in radians; the way the point moves."""
    place: complex


class LeverPose(NamedTuple):
    """A linkage of one loop by its usual lengths, with a coupler point (u along AB, v to its left), in one position."""

    size: FourBar | InvertedSliderCrank
    u: float
    v: float
    phi: float
    """The crank's angle against A0B0."""
    branch: str
    """``+`` or ``-``."""


def lever_pose(linkage: Linkage, point: str, drive: float, *, branch: Branch = None) -> LeverPose:
    """A four-bar or a central inverted slider-crank (joints in the order A0, A, B, B0), wherever its frame lies.

    Raises `LinkageError` for other linkages, and a drive value that is out of reach.

    >>> pose = lever_pose(FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}), "K", 1.0)
    >>> round(pose.size.c, 9), round(pose.u, 9), round(pose.phi, 9), pose.branch
    (40.0, 45.0, 1.0, '+')
    """
    motion = move(linkage, drive, branch=branch)
    if not motion.complete:
        raise LinkageError("{reason}", reason=motion.reason)
    mechanism = linkage.mechanism
    joints, links = mechanism.chain.joints, [set(joint.links) for joint in mechanism.chain.joints]
    names = mechanism.chain.joint_names()
    pins = [name for name, joint in zip(names, joints, strict=True) if joint.pair.is_turning]
    turning = [complex(motion.complex_point(name)[0]) for name in pins]
    pairs = [joint.pair for joint in joints]
    if len(pairs) != 4 or not all(pair.is_turning for pair in (*pairs[:2], pairs[3])) or not pairs[2].is_basic:
        raise LinkageError(
            "expected a four-bar or an inverted slider-crank, but found joints {joints}", joints=", ".join(names)
        )
    if not links[0] & links[-1] == {mechanism.frame} or not all(first & second for first, second in pairwise(links)):
        raise LinkageError(
            "expected joints in order round the loop, from the frame over the crank, but found {joints}",
            joints=", ".join(names),
        )
    a0, a, *b, b0 = turning
    along, crank = (b[0] if b else b0) - a, (a - a0) / (b0 - a0)
    arm = (complex(motion.complex_point(point)[0]) - a) / along * abs(along)
    phi = math.atan2(crank.imag, crank.real)
    if not b:
        return LeverPose(InvertedSliderCrank(abs(a - a0), abs(b0 - a0)), arm.real, arm.imag, phi, "+")
    size = FourBar(abs(a - a0), abs(along), abs(b[0] - b0), abs(b0 - a0))
    return LeverPose(size, arm.real, arm.imag, phi, branch_of_side(((b0 - a).conjugate() * along).imag))


def lever_contact(
    size: FourBar | InvertedSliderCrank, u: float, v: float, phi: float, *, branch: Branch = None
) -> LeverContact:
    """The contact of a coupler point's path with its tangent at a crank angle.

    Error: the coefficients are sums of products of doubles; of order n counts as zero what is below 1e-9 s g^(n - 1),
    with the speed s and the least g for which no coefficient of the path is larger than s g^(n - 1).

    Raises `LinkageError` where the path has a cusp or is straight to order 8, in dead centres of the output, and out of
    reach.

    >>> found = lever_contact(FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4), 8.018753738744802, 2.268046058132576, math.pi)
    >>> found.points, round(abs(found.coefficient) * 1e4, 9)
    (6, 1.550067728)
    """
    side, angle, arm = branch_side(branch), as_finite("phi", phi), complex(as_finite("u", u), as_finite("v", v))
    where = message("at the crank angle {angle:g} degrees", angle=math.degrees(angle))
    crank = size.a * np.exp(1j * angle) * 1j ** np.arange(_ORDER) / np.cumprod([1.0, *range(1, _ORDER)])
    to_b0 = -crank
    to_b0[0] += size.d
    path = crank + arm * _COUPLERS[type(size)](size, to_b0, _times(to_b0, np.conj(to_b0)), side, where)
    largest = max(size.a, size.d, abs(arm))
    if abs(path[1]) < _ZERO * largest:
        raise LinkageError("the path has a cusp {where}, and no tangent", where=where)
    heading = path[1] / abs(path[1])
    seen = path[1:] / heading
    orders = np.arange(1, _ORDER - 1)
    growth = ((np.abs(seen[1:]) / abs(seen[0])) ** (1 / orders)).max()
    high = 1 + np.flatnonzero(np.abs(seen[1:].imag) > _ZERO * abs(seen[0]) * growth**orders)
    if not len(high):
        raise LinkageError("the path is straight to order {order} {where}", order=_ORDER - 1, where=where)
    points = int(high[0]) + 1
    slope = float(seen.imag[points - 1] / seen.real[0] ** points)
    return LeverContact(points, slope, float(np.angle(heading)), complex(path[0]))


def _guide(size: InvertedSliderCrank, to_b0: Complexes, square: Complexes, side: int, where: Message) -> Complexes:
    contact = side * _root(_plus(square, -(size.e**2)), where)
    return _over(to_b0, _plus(contact, 1j * size.e))


def _coupler_of_four_bar(size: FourBar, to_b0: Complexes, square: Complexes, side: int, where: Message) -> Complexes:
    b, c = size.b, size.c
    area = _root(_times(_plus(-square, (b + c) ** 2), _plus(square, -((b - c) ** 2))), where)
    return _over(_times(to_b0, _plus(square + 1j * side * area, b**2 - c**2)), 2 * b * square)


_COUPLERS: dict[type, Callable[..., Complexes]] = {FourBar: _coupler_of_four_bar, InvertedSliderCrank: _guide}


# --- series -----------------------------------------------------------------------------------------


def _plus(a: Complexes, constant: complex) -> Complexes:
    total = a.copy()
    total[0] += constant
    return total


def _times(a: Complexes, b: Complexes) -> Complexes:
    return np.convolve(a, b)[: len(a)]


def _over(a: Complexes, b: Complexes) -> Complexes:
    quotient = np.zeros_like(a)
    for n in range(len(a)):
        quotient[n] = (a[n] - quotient[:n] @ b[n:0:-1]) / b[0]
    return quotient


def _root(a: Complexes, where: Message) -> Complexes:
    """The square root of a real series that begins with a positive number."""
    if not a[0].real > 0:
        raise LinkageError("the output is in a dead centre or out of reach {where}", where=where)
    root = np.zeros_like(a)
    root[0] = math.sqrt(a[0].real)
    for n in range(1, len(a)):
        root[n] = (a[n] - root[1:n] @ root[n - 1 : 0 : -1]) / (2 * root[0])
    return root
