"""What the linkages of a few lengths in closed form have in common: how they are read, printed and drawn."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from math import degrees
from typing import ClassVar

from gruebler.base import notebook
from gruebler.base.events import TransmissionExtremes
from gruebler.base.notebook import explained
from gruebler.base.text import joined_by_or, message
from gruebler.mechanics.fourbar.crank_motion import CrankMotion
from gruebler.mechanics.fourbar.extremes import CrankRange, DeadCentres
from gruebler.mechanics.fourbar.four_bar_types import NOT_ASSEMBLABLE, Grashof, LinkageType
from gruebler.mechanics.linkages.model import Linkage


@explained
class Lengths(ABC):
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

    def _repr_svg_(self) -> str | None:
        """The linkage to scale, for notebooks."""
        return notebook.svg_of(self) if notebook.svg_of else None


_STROKE = message("stroke of the output: {length:n}")
_SWING = message("swing of the output: {angle:n}°")
