"""The slider-crank a, b, e in closed form: what it is, how it moves, where it turns back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.events import TransmissionExtremes
from gruebler.base.immutable import settle
from gruebler.mechanics.fourbar.coupler_points import on_coupler
from gruebler.mechanics.fourbar.crank_motion import (
    CrankMotion,
    CrankRates,
    determined_rates,
    points,
    rotation_derivative,
)
from gruebler.mechanics.fourbar.extremes import (
    TURN,
    CrankRange,
    DeadCentres,
    cannot_assemble,
    clipped_cosine,
    transmission_extremes,
)
from gruebler.mechanics.fourbar.four_bar_types import LinkageType
from gruebler.mechanics.fourbar.lengths import Lengths
from gruebler.mechanics.fourbar.slider_crank_types import SLIDER_CRANK_TYPES, offset_relation, offset_sentence
from gruebler.mechanics.linkages.model import Linkage
from gruebler.mechanics.linkages.quantities import (
    FloatArray,
    as_eccentricity,
    as_finite,
    as_lengths,
    as_numbers,
    as_positive,
)
from gruebler.structure.mechanism import Mechanism


@dataclass(frozen=True, slots=True)
class StrokeMidpoint:
    """The middle of the way against the middle of the time, from the outer to the inner dead centre."""

    displacement: float
    """The slider's way s halfway between the dead centres."""
    time: float
    """The slider's way s when half the time of the travel is over."""
    phi_displacement: float
    """The crank angle from the outer dead centre to the middle of the way."""
    phi_time: float
    """The crank angle from the outer dead centre to the middle of the time."""

    @property
    def offset(self) -> float:
        """How far the middle of the way lies outside the middle of the time."""
        return self.displacement - self.time

    @property
    def time_fraction(self) -> float:
        """The part of the travel's time that the outer half of the way takes; 1/2 for an endless rod."""
        return self.phi_displacement / (2 * self.phi_time)


@dataclass(frozen=True, slots=True)
class SliderCrank(Lengths):
    """A slider-crank: crank a = A0A, connecting rod b = AB, eccentricity e.

    A0 = (0, 0), A = a exp(i phi), B = (s, e): the slider's path lies e above A0, below if e is negative. Branch ``+``
    has B to the right of A (s larger), branch ``-`` to the left.

    >>> compressor = SliderCrank(a=20, b=50)
    >>> print(compressor.type, round(compressor.stroke, 9), compressor.ratio)
    slider-crank 40.0 0.4

    See Also:
        `FourBar`, `InvertedSliderCrank`, `Linkage`, `move`, `measures`

    Theory:
        docs/theory/four-bar.md
    """

    a: float
    b: float
    e: float = 0.0

    output_slides = True

    def __post_init__(self) -> None:
        settle(self, **as_lengths(a=self.a, b=self.b))
        settle(self, e=as_eccentricity(self.e, self.a, self.b))

    @classmethod
    def from_ratio(cls, *, a: float, ratio: float, e: float = 0.0) -> SliderCrank:
        """The slider-crank with a ratio of crank to connecting rod lambda = a/b.

        >>> SliderCrank.from_ratio(a=35, ratio=0.35, e=-20).b
        100.0
        """
        return cls(a, as_positive("a", a) / as_positive("ratio", ratio), e)

    @classmethod
    def from_dead_centres(cls, inner: float, outer: float, *, e: float = 0.0) -> SliderCrank:
        """The slider-crank whose slider turns back at s = inner and s = outer.

        >>> SliderCrank.from_dead_centres(30, 70)
        SliderCrank(a=20.0, b=50.0, e=0.0)
        """
        near, far = as_positive("inner", inner), as_positive("outer", outer)
        if near >= far:
            raise LinkageError(
                "the outer dead centre must lie outside the inner one: {outer!r} against {inner!r}",
                outer=outer,
                inner=inner,
            )
        e = as_finite("e", e)
        difference, total = math.hypot(near, e), math.hypot(far, e)
        return cls((total - difference) / 2, (total + difference) / 2, e)

    @classmethod
    @door_that_raises(LinkageError)
    def from_stroke(cls, stroke: float, ratio: float, *, e: float = 0.0) -> SliderCrank:
        """The slider-crank with a stroke H, a ratio of crank to rod lambda = a/b below 1 and an eccentricity.

        With a large eccentricity there may be two; this is the one with the longer crank, where e weighs less.

        >>> SliderCrank.from_stroke(40, ratio=0.4)
        SliderCrank(a=20.0, b=50.0, e=0.0)
        """
        h, lam, e = as_positive("stroke", stroke), as_positive("ratio", ratio), as_finite("e", e)
        if max(h, abs(e)) > 1e100:
            raise LinkageError("lengths must be below 1e100, not {length:g}", length=max(h, abs(e)))
        if lam >= 1:
            raise LinkageError("ratio = a/b must be below 1 for a crank that turns fully, not {ratio!r}", ratio=ratio)
        # sqrt((b + a)^2 - e^2) - sqrt((b - a)^2 - e^2) = H is a quadratic equation for a^2.
        p, q, r = 4 / lam**2, h**2 * (1 + 1 / lam**2), h**2 * (h**2 / 4 + e**2)
        if q**2 < 4 * p * r:
            most = h * (1 / lam - lam) / 4
            raise LinkageError(
                "stroke {h:g} with ratio {lam:g} allows |e| = {most:g} at most, not {e:g}",
                h=h,
                lam=lam,
                most=most,
                e=abs(e),
            )
        a = math.sqrt((q + math.sqrt(q**2 - 4 * p * r)) / (2 * p))
        return cls(a, a / lam, e)

    def condition(self, lang: str = "en") -> str:
        """The lengths, the type and the links that turn fully, in English or German (``de``)."""
        return offset_sentence(self.type, self.turning, lang, a=self.a, b=self.b, e=self.e)

    def linkage(self, points: Mapping[str, tuple[float, float]] | None = None, *, unit: str = "mm") -> Linkage:
        """The linkage of these lengths, with named coupler points (u from A along the coupler, v to its left).

        Frame, crank, coupler (connecting rod), slider; the slider's way is counted from below the crank's pivot.
        """
        return Linkage(
            Mechanism.parse(_SLIDER_CRANK),
            {
                "frame": {"R(frame-crank)": (0, 0), "P(frame-slider)": (0, self.e, 0)},
                "crank": {"R(frame-crank)": (0, 0), "R(crank-coupler)": (self.a, 0)},
                "coupler": {"R(crank-coupler)": (0, 0), "R(coupler-slider)": (self.b, 0)},
                "slider": {"R(coupler-slider)": (0, 0), "P(frame-slider)": (0, 0, 0)},
            },
            points=on_coupler(points),
            unit=unit,
            outputs=["slider"],
        )

    @property
    def type(self) -> LinkageType:
        """What it is: slider-crank, slider-rocker, ..."""
        return SLIDER_CRANK_TYPES[offset_relation(self.e, a=self.a, b=self.b)]

    @property
    def grashof(self) -> None:
        """None: Grashof's condition is for four-bars."""

    @property
    def turning(self) -> tuple[str, ...]:
        """The links a, b that turn fully against the frame: the shorter one, if l_min + |e| is at most l_max."""
        return tuple(offset_relation(self.e, a=self.a, b=self.b)[1])

    @property
    def ratio(self) -> float:
        """The ratio of crank to connecting rod, lambda = a/b."""
        return self.a / self.b

    @property
    def is_central(self) -> bool:
        """Whether the slider's path goes through A0."""
        return self.e == 0

    @property
    def limits(self) -> tuple[CrankRange, ...]:
        """The crank angles for which it can be assembled: those with A at most b from the slider's path."""
        close = 1e-14 * (self.a + self.b + abs(self.e))
        low, high = self.e - self.b, self.e + self.b
        if low > self.a + close or high < -self.a - close:
            return ()
        below, above = low <= close - self.a, high >= self.a - close
        first, last = math.asin(clipped_cosine(low / self.a)), math.asin(clipped_cosine(high / self.a))
        if below and above:
            return (CrankRange(0.0, TURN),)
        if below:
            return (CrankRange(math.pi - last, TURN + last),)
        if above:
            return (CrankRange(first, math.pi - first),)
        return (CrankRange(first, last), CrankRange(math.pi - last, math.pi - first))

    @property
    def dead_centres(self) -> DeadCentres | None:
        """Where the slider turns back, on branch ``+``; None if the crank does not turn or is as long as the rod.

        >>> centres = SliderCrank(a=1.7, b=6, e=1.5).dead_centres
        >>> round(centres.inner.output, 6), round(centres.outer.output, 6)
        (4.029888, 7.552483)
        """
        if self.turning != ("a",):
            return None
        near, far = self.b - self.a, self.b + self.a
        line_in, line_out = math.asin(clipped_cosine(self.e / near)), math.asin(clipped_cosine(self.e / far))
        way_in = math.sqrt(max(0.0, (near - self.e) * (near + self.e)))
        way_out = math.sqrt((far - self.e) * (far + self.e))
        return DeadCentres.between(((line_in + math.pi) % TURN, way_in, line_in), (line_out % TURN, way_out, line_out))

    @property
    def stroke(self) -> float | None:
        """The stroke H, from one dead centre to the other; None if there are none."""
        centres = self.dead_centres
        return None if centres is None else centres.travel

    @property
    def middle(self) -> StrokeMidpoint | None:
        """The middle of the way against the middle of the time, going inwards; None without dead centres.

        The smaller lambda, the closer they lie.

        >>> round(SliderCrank(a=2, b=5).middle.offset, 6)
        0.417424
        """
        centres = self.dead_centres
        if centres is None:
            return None
        displacement = (centres.inner.output + centres.outer.output) / 2
        phi_time = centres.phi_back / 2
        time = float(self.motion(centres.outer.drive + phi_time).output.value)
        return StrokeMidpoint(
            displacement, time, float(self.phi_at(displacement)[0] - centres.outer.drive) % TURN, phi_time
        )

    def phi_at(self, displacement: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """The two crank angles, in 0..2 pi, at which the slider has a displacement; NaN where it never is.

        The first comes after the outer dead centre, the second before it (crank turning in the positive sense).

        >>> [round(math.degrees(phi), 4) for phi in SliderCrank(a=20, b=50).phi_at(50)]
        [78.463, 281.537]
        """
        s = as_numbers("way", displacement)
        reach, line = np.hypot(s, self.e), np.arctan2(self.e, s)
        with np.errstate(invalid="ignore", divide="ignore"):
            cosine = (self.a**2 + reach**2 - self.b**2) / (2 * self.a * reach)
            close = np.where(np.abs(np.abs(cosine) - 1) < 1e-14, np.sign(cosine), cosine)
            angle = np.arccos(close)
        return np.asarray((line + angle) % TURN), np.asarray((line - angle) % TURN)

    def output_place(self, pose: CrankMotion) -> tuple[float, float, float]:
        """See `Lengths.output_place`."""
        return (float(pose.output.value), self.e, 0.0)

    @property
    def transmission_angle(self) -> TransmissionExtremes:
        """The extremes of the transmission angle: crank straight up and straight down, and a right angle between.

        For e >= 0 straight down is the worse, cos mu_min = (a + e)/b. A crank that does not get there has its extremes
        where it stops, with transmission angle 0. Raises LinkageError if the slider-crank is not assemblable.

        >>> round(math.degrees(SliderCrank(a=3, b=5, e=1).transmission_angle.smallest.mu), 6)
        36.869898
        """
        if not self.limits:
            raise LinkageError(
                "the slider-crank {a:g}, {b:g}, e = {e:g} is not assemblable", a=self.a, b=self.b, e=self.e
            )
        high, low = min(self.a, self.e + self.b), max(-self.a, self.e - self.b)
        first, second = (
            (math.asin(clipped_cosine(y / self.a)) % TURN, math.acos(clipped_cosine((y - self.e) / self.b)))
            for y in (high, low)
        )
        right = math.pi - math.asin(clipped_cosine(self.e / self.a))
        return transmission_extremes(first, second, right)

    def _moved(self, crank: CrankRates, side: int) -> CrankMotion:
        a, b, e = self.a, self.b, self.e
        slack = 64 * np.finfo(float).eps * (a + b + abs(e))
        rise = e - a * np.sin(crank.value)
        gap = b - np.abs(rise)
        along = side * np.sqrt(np.where(np.abs(gap) < slack, 0, gap) * (b + np.abs(rise)))
        theta = [np.arctan2(rise, along)]
        displacements = [a * np.cos(crank.value) + along]
        for k in (1, 2, 3):
            rest = a * rotation_derivative(crank[: k + 1], k) + b * rotation_derivative(theta, k)
            theta_k = -np.imag(rest) / along
            displacements.append(np.real(rest) - theta_k * rise)
            theta.append(theta_k)
        mu = np.arctan2(np.abs(along), -rise)
        coupler, output = determined_rates(theta), determined_rates(displacements)
        joint_a = [a * rotation_derivative(crank[: k + 1], k) for k in range(4)]
        missing = np.isnan(along)
        return CrankMotion(
            crank=crank,
            coupler=coupler,
            output=output,
            A=CrankRates(*map(points, joint_a)),
            B=CrankRates(*(points(s + (1j * e if k == 0 else 0j)) for k, s in enumerate(output))),
            mu=mu,
            side=side,
            reason=cannot_assemble(self.limits, missing, np.zeros_like(missing), np.isnan(output.velocity) & ~missing),
        )


_SLIDER_CRANK = "R(frame-crank) R(crank-coupler) R(coupler-slider) P(frame-slider); drive=R(frame-crank)"
