"""Cognates: the other linkages whose coupler points trace the same curve (Roberts, Chebyshev)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.fourbar.crank_motion import CrankMotion
from gruebler.mechanics.fourbar.length_texts import ClosedForm
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch, branch_of_side
from gruebler.mechanics.linkages.quantities import as_finite, as_numbers
from gruebler.structure.mechanism import Mechanism

_AT_A_JOINT = 1e-9  # of the coupler: a nearer point draws an arc
_TURNS_WITH = (("crank", "coupler", "rocker"), ("coupler", "crank", "rocker"), ("coupler", "rocker", "crank"))
_PARALLEL = (
    "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker) "
    "R(crank-second) R(coupler-platform) R(second-platform); drive=R(frame-crank)"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class CognateSizes:
    """The three cognates of many four-bars; every array is (3, ...), the first of the three being the given one.

    A cognate stands with its crank's pivot at ``pivot`` and its frame line in the direction ``turn`` (unit, x + iy), in
    the coordinates of the given four-bar: A0 = 0, B0 = d.
    """

    a: Reals
    b: Reals
    c: Reals
    d: Reals
    u: Reals
    v: Reals
    pivot: Complexes
    turn: Complexes


@dataclass(frozen=True, kw_only=True)
class Cognate:
    """One of the linkages that trace one coupler curve, standing where it traces it."""

    size: FourBar | SliderCrank
    u: float
    """The coupler point from A along the coupler."""
    v: float
    """The coupler point to the left of the coupler."""
    pins: tuple[complex, ...]
    """A0, A, B and, for a four-bar, B0 in the reference pose, in the coordinates of the given linkage."""
    turn: complex
    """The unit vector from A0 to B0, or along the slider's path."""
    turns_with: tuple[str, ...]
    """The links of the given linkage with whose angular velocities crank, coupler and rocker turn."""

    @property
    def pivot(self) -> complex:
        """Where the crank's pivot stands."""
        return self.pins[0]

    @property
    def branch(self) -> str:
        """The assembly branch in the reference pose.

        It may change along the curve unless the crank turns with the given crank.
        """
        _, a, b, *end = self.pins
        side = ((end[0] - a).conjugate() * (b - a)).imag if end else (self.turn.conjugate() * (b - a)).real
        return branch_of_side(side)

    @property
    def point(self) -> complex:
        """The coupler point in the reference pose."""
        _, a, b, *_ = self.pins
        return a + complex(self.u, self.v) * (b - a) / self.size.b

    @property
    def phi(self) -> float:
        """The crank's angle against the frame line (or the slider's path) in the reference pose."""
        return float(np.angle((self.pins[1] - self.pins[0]) / self.turn))

    def reversed(self) -> Cognate:
        """The same four-bar with crank and rocker exchanged: the third one then has a crank that turns with the given.

        Raises `LinkageError` for a slider-crank.
        """
        if not isinstance(self.size, FourBar):
            raise LinkageError("a slider-crank has no second crank to be driven at")
        u, v = self.size.b - self.u, -self.v
        return Cognate(
            size=self.size.reversed(), u=u, v=v, pins=self.pins[::-1], turn=-self.turn, turns_with=self.turns_with[::-1]
        )

    def trace(self, motion: CrankMotion) -> Complexes:
        """Where the coupler point is, in the coordinates of the given linkage, as its own ``size`` moves."""
        at = motion.point(self.u, self.v).value
        return self.pivot + self.turn * (at[..., 0] + 1j * at[..., 1])

    def linkage(self, *, unit: str = "mm") -> Linkage:
        """The linkage that moves, in the coordinates of the given one, with the point K, in the reference pose.

        >>> from gruebler.mechanics.kinematics import move
        >>> other = cognates(FourBar(25, 70, 40, 70), 45, 40, phi=1.0)[2].reversed()
        >>> motion = move(other.linkage(), np.angle(other.pins[1] - other.pivot))
        >>> motion.complex_point("K").round(9)[0] == np.round(other.point, 9)
        np.True_
        """
        pins: list[tuple[float, ...]] = [(pin.real, pin.imag) for pin in self.pins]
        mechanism = self.size.linkage().mechanism
        names = mechanism.chain.joint_names()
        places: dict[str | int, object] = dict(zip(names, pins, strict=False))
        if self.size.output_slides:
            places[names[3]] = (*pins[2], float(np.angle(self.turn)))
        point = ("coupler", self.point.real, self.point.imag)
        return Linkage.from_drawing(
            mechanism, places, points={"K": point}, unit=unit, outputs=[mechanism.chain.links[3]]
        )


def cognate_sizes(
    a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike
) -> CognateSizes:
    """Sizes and places of the three cognates of four-bars given as arrays; about 0.5 us a four-bar.

    A coupler point on a joint gives cognates without size. Raises `LinkageError` for what are no finite numbers, or
    lengths that are not positive.

    >>> found = cognate_sizes(1, 75**0.5 / 2, 75**0.5 / 2, 4, 8.018753738744802, 2.268046058132576)
    >>> [float(x) for x in found.a.round(6)], float(abs(found.pivot + found.turn * found.d)[1].round(9))
    ([1.0, 8.333333, 4.330127], 7.698003589)
    """
    given = {"a": a, "b": b, "c": c, "d": d, "u": u, "v": v}
    numbers = [as_numbers(name, value) for name, value in given.items()]
    for name, length in zip("abcd", numbers[:4], strict=True):
        if (length <= 0).any():
            raise LinkageError("{name} must be positive, not {length:g}", name=name, length=length.min())
    try:
        la, lb, lc, ld, lu, lv = np.broadcast_arrays(*numbers)
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(given, numbers, strict=True))
        raise LinkageError("arrays of one shape are needed, not {shapes}", shapes=shapes) from None
    arm = lu + 1j * lv
    s, t = arm / lb, (lb - arm) / lb
    k, m = np.abs(s), np.abs(t)
    with np.errstate(divide="ignore", invalid="ignore"):
        points = np.array([arm, np.where(k > 0, la * k / s, 0), np.where(m > 0, lc * m / t, 0)])
        turns = np.array([np.ones_like(s), np.where(k > 0, s / k, 1), np.where(m > 0, -t / m, -1)])
    return CognateSizes(
        a=np.array([la, k * lb, m * lb]),
        b=np.array([lb, k * la, m * lc]),
        c=np.array([lc, k * lc, m * la]),
        d=np.array([ld, k * ld, m * ld]),
        u=points.real,
        v=points.imag,
        pivot=np.array([np.zeros_like(s), np.zeros_like(s), ld + 0j]),
        turn=turns,
    )


def cognates(
    four_bar: FourBar, u: float, v: float, *, branch: Branch = None, phi: float | None = None
) -> tuple[Cognate, Cognate, Cognate]:
    """The three Roberts-Chebyshev cognates of a four-bar with a coupler point (u from A along AB, v to the left).

    The first is the given four-bar, the second stands on A0 and C0, the third on B0 and C0. The reference pose is
    that at the crank angle phi (without one: in the middle of the crank's range; of a linkage that folds at a third).

    Raises `LinkageError` for a coupler point on a joint (its curve is a circle), for the parallelogram and kites with
    coincident joints, of which a link does not turn, and for a pose that cannot be assembled.

    >>> for one in cognates(FourBar(25, 70, 40, 70), 45, 40):
    ...     print(one.size.type.key, one.turns_with)
    crank_rocker ('crank', 'coupler', 'rocker')
    grashof_double_rocker ('coupler', 'crank', 'rocker')
    rocker_crank ('coupler', 'rocker', 'crank')
    """
    a, b, k, s = _pose(four_bar, u, v, branch, phi)
    b0, c0 = complex(four_bar.d), s * four_bar.d
    pins = (
        (0j, a, b, b0),
        (0j, k - a, s * b, c0),
        (b0, b0 + k - b, b0 + (1 - s) * (a - b0), c0),
    )
    sizes = cognate_sizes(four_bar.a, four_bar.b, four_bar.c, four_bar.d, u, v)
    first, second, third = (
        Cognate(
            size=four_bar
            if n == 0
            else FourBar(*(float(length[n]) for length in (sizes.a, sizes.b, sizes.c, sizes.d))),
            u=float(sizes.u[n]),
            v=float(sizes.v[n]),
            pins=pins[n],
            turn=complex(sizes.turn[n]),
            turns_with=_TURNS_WITH[n],
        )
        for n in range(3)
    )
    return first, second, third


def slider_cognates(
    slider: SliderCrank, u: float, v: float, *, branch: Branch = None, phi: float | None = None
) -> tuple[Cognate, Cognate]:
    """The two cognates of a slider-crank: the given one, and that on the same pivot with its path turned.

    The third pivot is at infinity. Raises `LinkageError` like `cognates`.

    >>> _, other = slider_cognates(SliderCrank(25, 70, 10), 35, 40)
    >>> round(other.size.a, 6), round(other.size.b, 6), round(other.size.e, 6)
    (53.150729, 18.982403, 7.592961)
    """
    a, b, k, s = _pose(slider, u, v, branch, phi)
    first = Cognate(size=slider, u=float(u), v=float(v), pins=(0j, a, b), turn=1 + 0j, turns_with=("crank", "coupler"))
    ratio = abs(s)
    size = SliderCrank(ratio * slider.b, ratio * slider.a, ratio * slider.e)
    point = ratio * slider.a / s
    second = Cognate(
        size=size, u=point.real, v=point.imag, pins=(0j, k - a, s * b), turn=s / ratio, turns_with=("coupler", "crank")
    )
    return first, second


def all_cognates(
    size: ClosedForm, u: float, v: float, *, branch: Branch = None, phi: float | None = None
) -> tuple[Cognate, ...]:
    """The cognates of a four-bar or a slider-crank, the given one first.

    Raises `LinkageError` for inverted slider-cranks, and like `cognates`.
    """
    if type(size) not in _COGNATES:
        raise LinkageError("cognates are known for the four-bar and the slider-crank, not for its inversion")
    return _COGNATES[type(size)](size, u, v, branch=branch, phi=phi)


_COGNATES: dict[type, Callable[..., tuple[Cognate, ...]]] = {FourBar: cognates, SliderCrank: slider_cognates}


def parallel_motion(
    four_bar: FourBar, u: float, v: float, *, branch: Branch = None, phi: float | None = None, unit: str = "mm"
) -> Linkage:
    """A six-bar whose link ``platform`` translates: each of its points, such as K, traces the given coupler curve.

    The third cognate, moved so that its pivot C0 comes to A0, has a crank that turns with the given one: both are made
    one link; its coupler carries the point K + A0 - C0, and its rocker is left out.

    >>> from gruebler.mechanics.kinematics import from_degrees, move
    >>> motion = move(parallel_motion(FourBar(25, 70, 40, 70), 45, 40), from_degrees(180, 540, 5))
    >>> motion.complete, bool(np.ptp(motion.angle("platform")) < 1e-9)
    (True, True)
    """
    first, _, third = cognates(four_bar, u, v, branch=branch, phi=phi)
    a0, a, b, b0 = first.pins
    back = a0 - third.pins[3]
    pins = (a0, a, b, b0, third.pins[2] + back, first.point, first.point + back)
    mechanism = Mechanism.parse(_PARALLEL)
    names = mechanism.chain.joint_names()
    places: dict[str | int, object] = {name: (p.real, p.imag) for name, p in zip(names, pins, strict=True)}
    point = ("platform", first.point.real, first.point.imag)
    return Linkage.from_drawing(mechanism, places, points={"K": point}, unit=unit, outputs=["platform"])


def _pose(
    size: FourBar | SliderCrank, u: float, v: float, branch: Branch, phi: float | None
) -> tuple[complex, complex, complex, complex]:
    """A, B, K in the reference pose, and the coupler triangle's shape (K - A)/(B - A)."""
    arm = complex(as_finite("u", u), as_finite("v", v))
    for name, joint in (("A", 0.0), ("B", size.b)):
        if abs(arm - joint) <= _AT_A_JOINT * size.b:
            raise LinkageError(
                "the coupler point lies on the joint {name}: it traces an arc, and has no cognates", name=name
            )
    if phi is None:
        if not size.limits:
            raise LinkageError("it cannot be assembled in any position: {size!r}", size=size)
        start, end = size.limits[0]
        phi = start + (end - start) * (1 / 3 if _SHAPES[type(size)].folds(size) else 1 / 2)
    motion = size.motion(as_finite("phi", phi), branch=branch)
    if not motion.assembled:
        raise LinkageError(
            "it cannot be assembled at the crank angle {phi:g} degrees: {reason}",
            phi=math.degrees(phi),
            reason=motion.reason,
        )
    a, b = (complex(*(float(x) for x in track.value)) for track in (motion.A, motion.B))
    _check_moving(size, a, b)
    s = arm / size.b
    return a, b, a + s * (b - a), s


def _check_moving(size: FourBar | SliderCrank, a: complex, b: complex) -> None:
    """Refuse assembly modes in which a moving link stands still: a parallelogram, or a kite whose joints coincide."""
    for still, gaps in _SHAPES[type(size)].standing(size, a, b):
        if max(map(abs, gaps)) <= _AT_A_JOINT * size.b:
            raise LinkageError(
                "{still} in this assembly mode: the coupler point traces a circle, and a cognate whose crank "
                "would turn with that link does not move",
                still=still,
            )


class _Shape(NamedTuple):
    """What a kind of linkage may look like that has no cognates, or not everywhere."""

    folds: Callable[..., bool]
    """Whether its links can lie on one line: at the crank angle pi, in the middle of its range, modes may meet."""
    standing: Callable[..., Sequence[tuple[Message, Sequence[complex]]]]
    """From A and B: which link stands still if all of some lengths are zero."""


def _four_bar_folds(size: FourBar) -> bool:
    lengths = sorted((size.a, size.b, size.c, size.d))
    return abs(lengths[0] + lengths[3] - lengths[1] - lengths[2]) <= _AT_A_JOINT * lengths[3]


def _standing_of_four_bar(size: FourBar, a: complex, b: complex) -> Sequence[tuple[Message, Sequence[complex]]]:
    return (
        (message("the coupler only translates"), (size.a - size.c, size.b - size.d, b - a - size.d)),
        (message("the rocker stands still"), (size.a - size.b, size.c - size.d, b)),
    )


def _slider_folds(size: SliderCrank) -> bool:
    return abs(size.a - size.b) <= _AT_A_JOINT * size.b


def _standing_of_slider(size: SliderCrank, _: complex, b: complex) -> Sequence[tuple[Message, Sequence[complex]]]:
    return ((message("the slider stands still"), (size.a - size.b, b)),)


_SHAPES = {
    FourBar: _Shape(_four_bar_folds, _standing_of_four_bar),
    SliderCrank: _Shape(_slider_folds, _standing_of_slider),
}
