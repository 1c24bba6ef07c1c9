"""The range of a drive, and the order of events in it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from math import inf, pi
from typing import Protocol, TypeVar

from gruebler.base.notebook import explained
from gruebler.base.text import Message, message
from gruebler.mechanics.analysis.measure_units import drive_units
from gruebler.mechanics.kinematics.motion import Stop
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.assur.forms import form_message

_TOGETHER = 1e-7  # radians or sizes: events that are nearer are at one place; change points are known to 1e-12, some of
# larger groups to 1e-9, a transmission angle of 0 where modes meet to the root of rounding


@explained
@dataclass(frozen=True, slots=True, kw_only=True)
class CycleSpan:
    """The range of a drive: radians, or lengths for a slide."""

    low: float
    high: float
    full: bool
    """Whether the drive goes round, and the linkage is back after ``turns`` turns."""
    turns: int
    """After how many turns of the drive everything repeats; 0 if it does not go round."""
    stops: tuple[Stop | None, Stop | None]
    """What ends it below and above; None where no limit was found (full turns, endless slides)."""
    linkage: Linkage = field(repr=False)
    """The linkage that is driven."""

    @property
    def period(self) -> float:
        """After how much the motion repeats; infinite if the drive does not go round."""
        return 2 * pi * self.turns if self.full else float("inf")

    @property
    def width(self) -> float:
        """How far the drive can go."""
        return self.high - self.low

    def wrapped(self, drive: float) -> float:
        """A drive value as it is reported: of full turns the one in 0 to the period."""
        if not self.full:
            return drive
        value = drive % self.period
        return 0.0 if self.period - value < _TOGETHER else value

    def lines(self) -> Iterator[Message]:
        """How far the drive moves, and what stops it."""
        if len(self.linkage.mechanism.drives) > 1:
            yield message("A path of {count} drives.", count=len(self.linkage.mechanism.drives))
            return
        units = drive_units(self.linkage)
        if self.full and self.turns > 1:
            yield message("The drive turns fully; everything repeats after {turns} turns.", turns=self.turns)
        else:
            yield units.range(self.full, self.low, self.high)
        for stop, value in zip(self.stops, (self.low, self.high), strict=True):
            if stop is not None:
                text = _LIMIT if stop.reason == "limit" else _MEETING
                links = ", ".join(stop.links)
                yield text.filled(drive=units.drive(value), form=form_message(stop.form), links=links)

    def explain(self, lang: str = "en") -> str:
        """How far the drive moves and what stops it, in English or German (``de``).

        >>> from gruebler.mechanics.analysis.drive_cycles import drive_cycle
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> print(drive_cycle(FourBar(65, 70, 40, 70).linkage()).span)
        The drive turns from 25.33° to 109.1°.
        At 25.33° the group RRR {coupler, rocker} can no longer be assembled.
        At 109.1° the group RRR {coupler, rocker} can no longer be assembled.
        """
        return "\n".join(line.in_language(lang) for line in self.lines())


_LIMIT = message("At {drive} the group {form} {{{links}}} can no longer be assembled.")


_MEETING = message("At {drive} two assembly modes of the group {form} {{{links}}} meet.")


class _Event(Protocol):
    @property
    def drive(self) -> float: ...

    @property
    def links(self) -> tuple[str, ...]: ...


AnyEvent = TypeVar("AnyEvent", bound=_Event)


def by_place(events: Iterable[AnyEvent], drive_size: float) -> list[list[AnyEvent]]:
    """Events in the order of the drive, those at one place together and in the order of their links' names.

    Rounding orders nothing: what is nearer than 1e-7 of the drive's size is at one place.
    """
    near = _TOGETHER * drive_size
    places: list[list[AnyEvent]] = []
    last = -inf
    for event in sorted(events, key=lambda event: event.drive):
        if event.drive - last > near:
            places.append([])
        places[-1].append(event)
        last = event.drive
    return [sorted(together, key=lambda event: event.links) for together in places]
