"""The four-bar a, b, c, d in closed form: what it is, how it moves, where it turns back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

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
    CrankRange,
    DeadCentres,
    cannot_assemble,
    clipped_cosine,
    crank_ranges,
    transmission_extremes,
    triangle_angle,
)
from gruebler.mechanics.fourbar.four_bar_types import (
    Grashof,
    LengthRange,
    LinkageType,
    grashof,
    turning_ranges,
    types_along,
)
from gruebler.mechanics.fourbar.lengths import Lengths
from gruebler.mechanics.linkages.model import Linkage
from gruebler.mechanics.linkages.quantities import as_finite, as_lengths, as_positive, given_and_missing
from gruebler.structure.mechanism import Mechanism


@dataclass(frozen=True, slots=True)
class FourBar(Lengths):
    """A four-bar: crank a = A0A, coupler b = AB, rocker c = B0B, frame d = A0B0.

    A0 = (0, 0), B0 = (d, 0), A = a exp(i phi). Of the two assembly modes, branch ``+`` has B to the left of the line
    from A to B0, branch ``-`` to the right. Lengths that close in no position are a result (``type``), not an error.

    >>> rocker = FourBar(a=2, b=7, c=4.5, d=5.5)
    >>> print(rocker.type, round(math.degrees(rocker.swing), 3))
    crank-rocker 69.044

    See Also:
        `SliderCrank`, `InvertedSliderCrank`, `Linkage`, `move`, `measures`

    Theory:
        docs/theory/four-bar.md
    """

    a: float
    b: float
    c: float
    d: float

    output_slides = False

    def __post_init__(self) -> None:
        settle(self, **as_lengths(a=self.a, b=self.b, c=self.c, d=self.d))

    @classmethod
    def central(
        cls, *, a: float | None = None, b: float | None = None, c: float | None = None, d: float | None = None
    ) -> FourBar:
        """The central crank-rocker with three given lengths: forth and back take the same time, a^2 + d^2 = b^2 + c^2.

        >>> round(FourBar.central(a=30, b=75, c=60).d, 4)
        91.2414
        """
        given, missing = given_and_missing(a=a, b=b, c=c, d=d)
        own, others = ("ad", "bc") if missing in "ad" else ("bc", "ad")
        square = math.fsum(given[x] ** 2 for x in others) - math.fsum(given[x] ** 2 for x in own if x != missing)
        if square <= 0:
            lengths = ", ".join(f"{name} = {value:g}" for name, value in given.items())
            raise LinkageError(
                "no central crank-rocker has {lengths}: {missing}^2 would be {square:g}",
                lengths=lengths,
                missing=missing,
                square=square,
            )
        four_bar = cls(**given, **{missing: math.sqrt(square)})
        if four_bar.dead_centres is None:
            raise LinkageError(
                "a^2 + d^2 = b^2 + c^2 asks for {missing} = {length:g}: {type}",
                missing=missing,
                length=math.sqrt(square),
                type=four_bar.type.title,
            )
        return four_bar

    @classmethod
    def central_for_swing(cls, swing: float, *, c: float, b: float | None = None, d: float | None = None) -> FourBar:
        """The central crank-rocker whose rocker c swings by an angle: a = c sin(swing/2), and b or d is given.

        >>> round(FourBar.central_for_swing(math.radians(60), c=60, b=75).a, 9)
        30.0
        """
        if not 0 < as_finite("swing", swing) < math.pi:
            raise LinkageError("the swing must lie between 0 and pi, not {swing!r}", swing=swing)
        return cls.central(a=as_positive("c", c) * math.sin(swing / 2), b=b, c=c, d=d)

    def condition(self, lang: str = "en") -> str:
        """Grashof's condition with its figures, the type and the links that turn fully: English or German (``de``)."""
        return self.grashof.explain(lang)

    def linkage(self, points: Mapping[str, tuple[float, float]] | None = None, *, unit: str = "mm") -> Linkage:
        """The linkage of these lengths, with named coupler points (u from A along the coupler, v to its left).

        Frame, crank, coupler, rocker.
        """
        return Linkage(
            Mechanism.parse(_FOUR_BAR),
            {
                "frame": {"R(frame-crank)": (0, 0), "R(frame-rocker)": (self.d, 0)},
                "crank": {"R(frame-crank)": (0, 0), "R(crank-coupler)": (self.a, 0)},
                "coupler": {"R(crank-coupler)": (0, 0), "R(coupler-rocker)": (self.b, 0)},
                "rocker": {"R(frame-rocker)": (0, 0), "R(coupler-rocker)": (self.c, 0)},
            },
            points=on_coupler(points),
            unit=unit,
            outputs=["rocker"],
        )

    @property
    def grashof(self) -> Grashof:
        """Grashof's condition, the type and the links that turn fully."""
        return grashof(self.a, self.b, self.c, self.d)

    @property
    def type(self) -> LinkageType:
        """What it is: crank-rocker, double crank, ..."""
        return self.grashof.type

    @property
    def turning(self) -> tuple[str, ...]:
        """The links a, b, c that turn fully against the frame."""
        return self.grashof.turning

    @property
    def ratio(self) -> float:
        """The ratio of crank to connecting rod, lambda = a/b."""
        return self.a / self.b

    def turning_ranges(self, free: str, *, turns: str = "a") -> tuple[LengthRange, ...]:
        """The values of the length ``free`` for which the link ``turns`` goes round fully, the others as they are.

        >>> [(r.lower, r.upper) for r in FourBar(a=30, b=110, c=100, d=80).turning_ranges("c")]
        [(60.0, 160.0)]
        """
        return turning_ranges(turns, **self._without(free))

    def types_along(self, free: str) -> tuple[LengthRange, ...]:
        """All types that the four-bar runs through as the length ``free`` grows from 0, the others as they are."""
        return types_along(**self._without(free))

    def _without(self, free: str) -> dict[str, float]:
        if free not in ("a", "b", "c", "d"):
            raise LinkageError("the free length must be a, b, c or d, not {free!r}", free=free)
        return {name: getattr(self, name) for name in "abcd" if name != free}

    def reversed(self) -> FourBar:
        """The same four-bar driven at the other side: c is the crank and a the rocker."""
        return FourBar(self.c, self.b, self.a, self.d)

    @property
    def limits(self) -> tuple[CrankRange, ...]:
        """The crank angles for which it can be assembled: one arc, or two mirror images, or none."""
        return crank_ranges(self.a, self.d, abs(self.b - self.c), self.b + self.c)

    @property
    def output_limits(self) -> tuple[CrankRange, ...]:
        """The angles psi that the output can take, on either branch."""
        mirrored = crank_ranges(self.c, self.d, abs(self.b - self.a), self.a + self.b)
        return tuple(arc if arc.full else CrankRange(math.pi - arc.end, math.pi - arc.start) for arc in mirrored[::-1])

    @property
    def dead_centres(self) -> DeadCentres | None:
        """Where the output turns back, on branch ``+`` (the other is its mirror image in the frame line).

        None unless a alone is the shortest link and turns fully: only then a turn of the crank drives the output to and
        fro. At a change point one of the two is the position where the motion may also go on.

        >>> centres = FourBar(a=2, b=7, c=4.5, d=5.5).dead_centres
        >>> round(math.degrees(centres.inner_line), 4), round(math.degrees(centres.outer_line), 4)
        (50.4788, 23.1918)
        """
        grashof = self.grashof
        if "a" not in grashof.turning or grashof.shortest != ("a",):
            return None
        inner, outer = (
            (triangle_angle(reach, self.d, self.c), math.pi - triangle_angle(self.c, self.d, reach))
            for reach in (self.b - self.a, self.b + self.a)
        )
        return DeadCentres.between((inner[0] + math.pi, inner[1], inner[0]), (outer[0], outer[1], outer[0]))

    @property
    def swing(self) -> float | None:
        """The angle psi_H between the dead centres; None if there are none."""
        centres = self.dead_centres
        return None if centres is None else centres.travel

    @property
    def is_central(self) -> bool:
        """Whether the line through the dead centres goes through A0, so that both ways take the same time."""
        centres = self.dead_centres
        return centres is not None and centres.delta_phi < 1e-9

    def output_place(self, pose: CrankMotion) -> tuple[float, float, float]:
        """See `Lengths.output_place`."""
        return (self.d, 0.0, float(pose.output.value))

    @property
    def transmission_angle(self) -> TransmissionExtremes:
        """The extremes of the transmission angle: crank over the frame and away from it, and a right angle between.

        A crank that does not get there has its extremes where it stops, with transmission angle 0. Raises
        LinkageError if the four-bar is not assemblable.

        >>> round(math.degrees(FourBar(a=2, b=5, c=4, d=5).transmission_angle.smallest.mu), 6)
        36.869898
        """
        limits = self.limits
        if not limits:
            raise LinkageError(
                "the four-bar {a:g}, {b:g}, {c:g}, {d:g} is not assemblable", a=self.a, b=self.b, c=self.c, d=self.d
            )
        arc = limits[0]
        first = max(arc.start, 0.0)
        second = math.pi if arc.end > math.pi else arc.end
        right = (self.a**2 + self.d**2 - self.b**2 - self.c**2) / (2 * self.a * self.d)
        return transmission_extremes(
            (first, triangle_angle(self.b, self.c, max(abs(self.d - self.a), abs(self.b - self.c)))),
            (second, triangle_angle(self.b, self.c, min(self.d + self.a, self.b + self.c))),
            math.acos(clipped_cosine(right)),
        )

    def _moved(self, crank: CrankRates, side: int) -> CrankMotion:
        a, b, c, d = self.a, self.b, self.c, self.d
        to_b0 = d - a * np.exp(1j * crank.value)
        f = np.abs(to_b0)
        stretched, overlapping = b + c - f, f - abs(b - c)
        slack = 64 * np.finfo(float).eps * (a + b + c + d)
        undetermined = (f < slack) & (abs(b - c) < slack)
        area = np.sqrt(
            np.where(np.abs(stretched) < slack, 0, stretched)
            * np.where(np.abs(overlapping) < slack, 0, overlapping)
            * (b + c + f)
            * (f + abs(b - c))
        )
        # Twice f times the coupler and the rocker, in the frame of the line from A to B0.
        unit = np.where(undetermined, np.nan, to_b0 / f)
        theta = [np.angle(unit * (b**2 - c**2 + f**2 + 1j * side * area))]
        psi = [np.angle(unit * (b**2 - c**2 - f**2 + 1j * side * area))]
        self._add_rates(crank, theta, psi, side * -area / (2 * b * c))
        mu = np.where(undetermined, np.nan, np.arctan2(area, b**2 + c**2 - f**2))
        coupler, output = determined_rates(theta), determined_rates(psi)
        joint_a = [a * rotation_derivative(crank[: k + 1], k) for k in range(4)]
        joint_b = [(d if k == 0 else 0) + c * rotation_derivative(output[: k + 1], k) for k in range(4)]
        singular = np.isnan(output.velocity) & ~np.isnan(output.value)
        return CrankMotion(
            crank=crank,
            coupler=coupler,
            output=output,
            A=CrankRates(*map(points, joint_a)),
            B=CrankRates(*map(points, joint_b)),
            mu=mu,
            side=side,
            reason=cannot_assemble(self.limits, np.isnan(area), undetermined, singular),
        )

    def _add_rates(self, crank: CrankRates, theta: list[Reals], psi: list[Reals], sine: Reals) -> None:
        """Append three derivatives of theta and psi, by differentiating the loop; ``sine`` is sin(theta - psi)."""
        for k in (1, 2, 3):
            known = (
                self.a * rotation_derivative(crank[: k + 1], k)
                + self.b * rotation_derivative(theta, k)
                - self.c * rotation_derivative(psi, k)
            )
            theta_k = np.imag(1j * known * np.exp(-1j * psi[0])) / (self.b * sine)
            psi_k = np.imag(1j * known * np.exp(-1j * theta[0])) / (self.c * sine)
            theta.append(theta_k)
            psi.append(psi_k)


_FOUR_BAR = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); drive=R(frame-crank)"
