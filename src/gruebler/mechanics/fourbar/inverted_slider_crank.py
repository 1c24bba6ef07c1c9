"""The inverted slider-crank a, d, e in closed form: turning and swinging block, slotted lever, conchoid linkage."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from gruebler.base.arrays import Reals
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
    crank_ranges,
    transmission_extremes,
)
from gruebler.mechanics.fourbar.four_bar_types import LinkageType
from gruebler.mechanics.fourbar.lengths import Lengths
from gruebler.mechanics.fourbar.slider_crank_types import INVERTED_SLIDER_CRANK_TYPES, offset_relation, offset_sentence
from gruebler.mechanics.linkages.model import Linkage
from gruebler.mechanics.linkages.quantities import as_eccentricity, as_finite, as_lengths, as_positive
from gruebler.structure.mechanism import Mechanism


@dataclass(frozen=True, slots=True)
class InvertedSliderCrank(Lengths):
    """An inverted slider-crank: crank a = A0A, frame d = A0B0, eccentricity e of the guide.

    A0 = (0, 0), B0 = (d, 0), A = a exp(i phi). The guide runs through A in the direction theta and passes B0 on its
    right at the distance e: B0 = A + (r + i e) exp(i theta), r the displacement of the block. Branch ``+`` has r > 0,
    ``-`` r < 0. The same motion belongs to a rod on the crank pin that slides through a block swivelling about B0
    (turning and swinging block, conchoid linkage) and to a block on the crank pin in a slotted lever pivoted in B0.

    >>> shaper = InvertedSliderCrank(a=30, d=50)
    >>> print(shaper.type.name("de"), round(shaper.dead_centres.time_ratio, 6))
    schwingende Kurbelschleife 2.38791

    See Also:
        `FourBar`, `SliderCrank`, `Linkage`, `move`, `measures`

    Theory:
        docs/theory/four-bar.md
    """

    a: float
    d: float
    e: float = 0.0

    output_slides = False

    def __post_init__(self) -> None:
        settle(self, **as_lengths(a=self.a, d=self.d))
        settle(self, e=as_eccentricity(self.e, self.a, self.d))

    @classmethod
    def for_time_ratio(cls, time_ratio: float, *, d: float) -> InvertedSliderCrank:
        """The central one on the frame d whose guide swings with a ratio of times: a = d cos(pi/(1 + ratio)).

        >>> round(InvertedSliderCrank.for_time_ratio(2, d=100).a, 9)
        50.0
        """
        ratio = as_finite("time_ratio", time_ratio)
        if ratio <= 1:
            raise LinkageError(
                "the time ratio, slow by quick, must be above 1, not {time_ratio!r}", time_ratio=time_ratio
            )
        return cls(as_positive("d", d) * math.cos(math.pi / (1 + ratio)), d)

    def condition(self, lang: str = "en") -> str:
        """The lengths, the type and the links that turn fully, in English or German (``de``)."""
        return offset_sentence(self.type, self.turning, lang, a=self.a, d=self.d, e=self.e)

    def linkage(self, points: Mapping[str, tuple[float, float]] | None = None, *, unit: str = "mm") -> Linkage:
        """The linkage of these lengths, with named coupler points (u from A along the coupler, v to its left).

        Frame, crank, coupler (a rod through the block), block swivelling about B0.
        """
        return Linkage(
            Mechanism.parse(_INVERTED),
            {
                "frame": {"R(frame-crank)": (0, 0), "R(frame-block)": (self.d, 0)},
                "crank": {"R(frame-crank)": (0, 0), "R(crank-coupler)": (self.a, 0)},
                "coupler": {"R(crank-coupler)": (0, 0), "P(coupler-block)": (0, self.e, 0)},
                "block": {"R(frame-block)": (0, 0), "P(coupler-block)": (0, 0, 0)},
            },
            points=on_coupler(points),
            unit=unit,
            outputs=["block"],
        )

    @property
    def type(self) -> LinkageType:
        """What it is: with swinging guide, with turning guide, ..."""
        return INVERTED_SLIDER_CRANK_TYPES[offset_relation(self.e, a=self.a, d=self.d)]

    @property
    def grashof(self) -> None:
        """None: Grashof's condition is for four-bars."""

    @property
    def turning(self) -> tuple[str, ...]:
        """The links that turn fully against the frame: ``a`` the crank, ``guide``."""
        relation, shorter = offset_relation(self.e, a=self.a, d=self.d)
        return (("a",) if relation in "<=" else ()) + (("guide",) if "d" in shorter else ())

    @property
    def limits(self) -> tuple[CrankRange, ...]:
        """The crank angles for which it can be assembled: those with A at least |e| from B0."""
        return crank_ranges(self.a, self.d, abs(self.e), math.inf)

    @property
    def dead_centres(self) -> DeadCentres | None:
        """Where the guide turns back, on branch ``+``: the crank is perpendicular to it. None if it turns fully.

        ``output`` is psi; as with a four-bar it is larger in the inner one.

        >>> round(math.degrees(InvertedSliderCrank(a=30, d=50).dead_centres.outer.drive), 6)
        53.130102
        """
        if self.turning != ("a",):
            return None
        centres = []
        for side in (-1, 1):
            theta = math.asin(clipped_cosine((-side * self.a - self.e) / self.d))
            centres.append(((theta + side * math.pi / 2) % TURN, theta + math.pi, theta))
        outer, inner = sorted(centres, key=lambda centre: centre[1])
        return DeadCentres.between(inner, outer)

    @property
    def swing(self) -> float | None:
        """The angle between the dead centres; None if there are none."""
        centres = self.dead_centres
        return None if centres is None else centres.travel

    def output_place(self, pose: CrankMotion) -> tuple[float, float, float]:
        """See `Lengths.output_place`."""
        return (self.d, 0.0, float(pose.coupler.value))

    @property
    def transmission_angle(self) -> TransmissionExtremes:
        """The extremes of the transmission angle onto the lever about B0: crank over the frame, and away from it.

        cos mu = |e|/AB0, so that it is pi/2 throughout for e = 0. Raises LinkageError if it is not assemblable.
        """
        limits = self.limits
        if not limits:
            raise LinkageError(
                "the inverted slider-crank {a:g}, {d:g}, e = {e:g} is not assemblable", a=self.a, d=self.d, e=self.e
            )
        nearest = max(abs(self.d - self.a), abs(self.e))
        first = limits[0].start
        return transmission_extremes(
            (first, math.acos(clipped_cosine(abs(self.e) / nearest)) if nearest else math.pi / 2),
            (math.pi, math.acos(clipped_cosine(abs(self.e) / (self.d + self.a)))),
        )

    def _moved(self, crank: CrankRates, side: int) -> CrankMotion:
        a, d, e = self.a, self.d, self.e
        slack = 64 * np.finfo(float).eps * (a + d + abs(e))
        to_b0 = d - a * np.exp(1j * crank.value)
        f = np.abs(to_b0)
        gap = f - abs(e)
        slide = [side * np.sqrt(np.where(np.abs(gap) < slack, 0, gap) * (f + abs(e)))]
        undetermined = (f < slack) & (abs(e) < slack)
        theta = [np.where(undetermined, np.nan, np.angle(to_b0 / (slide[0] + 1j * e)))]
        self._add_rates(crank, theta, slide)
        mu = np.where(np.isnan(theta[0]), np.nan, np.arctan2(np.abs(slide[0]), abs(e)))
        guide, block = determined_rates(theta), determined_rates(slide)
        output = guide._replace(value=(guide.value + np.pi) % TURN)
        foot = [points(1j * e * rotation_derivative(guide[: k + 1], k)) for k in range(4)]
        joint_a = [a * rotation_derivative(crank[: k + 1], k) for k in range(4)]
        b0 = np.array([d, 0.0])
        singular = np.isnan(guide.velocity) & ~np.isnan(guide.value)
        return CrankMotion(
            crank=crank,
            coupler=guide,
            output=output,
            A=CrankRates(*map(points, joint_a)),
            B=CrankRates(b0 - foot[0], *(-rate for rate in foot[1:])),
            mu=mu,
            side=side,
            reason=cannot_assemble(self.limits, np.isnan(slide[0]), undetermined, singular),
            displacement=block,
        )

    def _add_rates(self, crank: CrankRates, theta: list[Reals], slide: list[Reals]) -> None:
        """Append three derivatives of theta and of the way r, by differentiating the loop."""
        for k in (1, 2, 3):
            arm: list[Any] = [slide[0] + 1j * self.e, *slide[1:], 0.0]
            known = self.a * rotation_derivative(crank[: k + 1], k)
            for j in range(k + 1):
                known = known + math.comb(k, j) * arm[j] * rotation_derivative(theta[: k - j + 1], k - j)
            wanted = -known * np.exp(-1j * theta[0])
            theta_k = np.imag(wanted) / slide[0]
            slide.append(np.real(wanted) + theta_k * self.e)
            theta.append(theta_k)


_INVERTED = "R(frame-crank) R(crank-coupler) P(coupler-block) R(frame-block); drive=R(frame-crank)"
