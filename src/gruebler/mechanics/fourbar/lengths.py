"""What the linkages of a few lengths in closed form have in common: how they are read, printed and drawn."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from math import degrees
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from gruebler.base.events import TransmissionExtremes
from gruebler.base.notebook import Drawn, explained
from gruebler.base.text import joined_by_or, message
from gruebler.mechanics.fourbar.crank_motion import CrankMotion, CrankRates, crank_rates
from gruebler.mechanics.fourbar.extremes import CrankRange, DeadCentres
from gruebler.mechanics.fourbar.four_bar_types import NOT_ASSEMBLABLE, Grashof, LinkageType
from gruebler.mechanics.linkages.branch import Branch, branch_side
from gruebler.mechanics.linkages.model import Linkage


@explained
class Lengths(ABC, Drawn):
    """A linkage of one crank that is given by its lengths."""

    __slots__ = ()

    __match_args__: ClassVar[tuple[str, ...]]
    output_slides: ClassVar[bool]
    """Whether the output travels along a line; of the others it turns."""

    @property
    def named(self) -> dict[str, float]:
        """The lengths by their letters."""
        return {name: getattr(self, name) for name in self.__match_args__}

    @property
    def assemblable(self) -> bool:
        """Whether there is any position at all."""
        return self.type is not NOT_ASSEMBLABLE

    @property
    @abstractmethod
    def type(self) -> LinkageType:
        """What it is."""

    @abstractmethod
    def linkage(self, points: Mapping[str, tuple[float, float]] | None = None, *, unit: str = "mm") -> Linkage:
        """The linkage of these lengths."""

    @abstractmethod
    def condition(self, lang: str = "en") -> str:
        """What it is by its lengths, and what turns fully, in a sentence."""

    @property
    @abstractmethod
    def grashof(self) -> Grashof | None:
        """Grashof's condition, which only four-bars have."""

    @property
    @abstractmethod
    def turning(self) -> tuple[str, ...]:
        """The links that turn fully against the frame."""

    @property
    @abstractmethod
    def limits(self) -> tuple[CrankRange, ...]:
        """The crank angles for which it can be assembled."""

    @property
    @abstractmethod
    def dead_centres(self) -> DeadCentres | None:
        """Where the output turns back."""

    @property
    @abstractmethod
    def transmission_angle(self) -> TransmissionExtremes:
        """The extremes of the transmission angle."""

    def motion(
        self,
        phi: npt.ArrayLike,
        *,
        omega: npt.ArrayLike = 1.0,
        alpha: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
        branch: Branch = None,
    ) -> CrankMotion:
        """Positions, velocities, accelerations and jerks over crank angles of any shape, in closed form.

        ``omega``, ``alpha`` and ``jerk`` are the first three derivatives of phi. ``output`` is the angle of the output,
        or the slider's way s; of an inverted slider-crank ``coupler`` is the guide's direction theta, ``output``
        psi = theta + pi (for e = 0 the direction from B0 to A), ``displacement`` the way r. Poses that cannot be
        assembled are NaN; ``message`` says where (``limits``). A gap of a few roundings counts as closed.

        >>> from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
        >>> motion = FourBar(a=25, b=70, c=40, d=70).motion(np.radians(55), omega=10)
        >>> round(float(motion.output.velocity), 9), round(float(motion.coupler.acceleration), 9)
        (4.785205278, 25.805259492)
        >>> motion = SliderCrank(a=25, b=70).motion(np.radians(55), omega=10)
        >>> round(float(motion.output.velocity), 6), round(float(motion.output.acceleration), 6)
        (-248.657931, -1143.345966)
        >>> shaper = InvertedSliderCrank(a=30, d=50).motion(np.radians(60), omega=2)
        >>> round(float(shaper.displacement.value), 6), round(degrees(shaper.coupler.value), 6)
        (43.588989, -36.586776)
        >>> shaper.point(90).value.round(6)
        array([ 87.265956, -27.662798])
        """
        side, crank = branch_side(branch), crank_rates(phi, omega, alpha, jerk)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            return self._moved(crank, side)

    @abstractmethod
    def _moved(self, crank: CrankRates, side: int) -> CrankMotion:
        """`motion` at rates of the crank, on the branch of a side."""

    @abstractmethod
    def output_place(self, pose: CrankMotion) -> tuple[float, float, float]:
        """Where the output link of `linkage` lies in a single pose: its origin and its angle."""

    def explain(self, lang: str = "en") -> str:
        """What it is, where the crank turns, how far the output goes: lines in English or German (``de``).

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> print(FourBar(a=25, b=70, c=40, d=70))
        l_min + l_max = 25 + 70 = 95 < 110 = 70 + 40: crank-rocker. Turns fully against the frame: a (crank).
        crank angle: full turn
        swing of the output: 79.85°
        time ratio: 1.12
        smallest transmission angle: 36.96°
        """
        lines = []
        if self.limits:
            lines.append(message("crank angle: {ranges}", ranges=joined_by_or([arc.title for arc in self.limits])))
            if (centres := self.dead_centres) is not None:
                travel = _STROKE if self.output_slides else _SWING
                lines.append(travel.filled(length=centres.travel, angle=degrees(centres.travel)))
                lines.append(message("time ratio: {ratio:n}", ratio=centres.time_ratio))
            smallest = degrees(self.transmission_angle.smallest.mu)
            lines.append(message("smallest transmission angle: {angle:n}°", angle=smallest))
        return "\n".join([self.condition(lang), *(line.in_language(lang) for line in lines)])


_STROKE = message("stroke of the output: {length:n}")
_SWING = message("swing of the output: {angle:n}°")
