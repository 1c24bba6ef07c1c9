"""What is said of a motion."""

from __future__ import annotations

from math import degrees
from typing import Protocol

from gruebler.base.text import Message, joined, message
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.assur.forms import form_message
from gruebler.structure.chain.pairs import SymbolText, in_alphabets
from gruebler.structure.mechanism import Mechanism

_UNBOUNDED = message("At {drives} the drive stands at its limit: there are no finite rates.")
_EXACT = message(
    "From {first} to {last} the sizes miss a change point by so little that they were taken for exact: poses and rates "
    "there are those of a linkage that meets it."
)
_EXACT_THERE = message(
    "At {first} the sizes miss a change point by so little that they were taken for exact: pose and rates there are "
    "those of a linkage that meets it."
)
_STOPS = {
    "limit": message("The motion ends at {drives}: there {form} {{{links}}} can no longer be assembled."),
    "singular": message("The motion ends at {drives}: there two assembly modes of {form} {{{links}}} meet."),
    "open": message(
        "The motion ends at {drives}: there {form} is open. The sizes do not let this overconstrained linkage move on; "
        "`gruebler check --explain` shows what they allow."
    ),
    "start": message("At the start, {drives}, {form} {{{links}}} cannot be assembled in this way."),
}


def unbounded_message(linkage: Linkage, drives: tuple[float, ...]) -> Message:
    """That there are no finite rates at these drive values."""
    return _UNBOUNDED.filled(drives=drive_values(linkage, drives))


def taken_for_exact_message(linkage: Linkage, first: tuple[float, ...], last: tuple[float, ...]) -> Message:
    """That a linkage was taken to meet a change point which it misses, in the rows between these drive values."""
    text = _EXACT_THERE if first == last else _EXACT
    return text.filled(first=drive_values(linkage, first), last=drive_values(linkage, last))


def stop_message(
    linkage: Linkage, reason: str, drives: tuple[float, ...], links: tuple[str, ...], form: str
) -> Message:
    """Where and why a motion ends; the arguments are those of `Stop`."""
    at = drive_values(linkage, drives)
    return _STOPS[reason].filled(drives=at, form=form_message(form), links=", ".join(links))


class Driven(Protocol):
    """What has drives and a unit of length."""

    @property
    def mechanism(self) -> Mechanism:
        """Frame and drives."""

    @property
    def unit(self) -> str:
        """The unit of lengths."""


def drive_values(linkage: Driven, values: tuple[float, ...]) -> Message:
    """Drive values with the names of their joints, turning ones in degrees."""
    mechanism = linkage.mechanism
    parts = []
    for k, (drive, value) in enumerate(zip(mechanism.drives, values, strict=True)):
        name = drive_name(mechanism, k)
        if drive.turning:
            parts.append(message("{name} = {value:n}°", name=name, value=degrees(value)))
        else:
            text = message("{name} = {value:n} {unit}") if linkage.unit else message("{name} = {value:n}")
            parts.append(text.filled(name=name, value=value, unit=linkage.unit))
    return joined(parts)


def drive_name(mechanism: Mechanism, drive: int) -> SymbolText:
    """The name of a driven joint."""
    return in_alphabets(lambda alphabet: mechanism.drive_names(alphabet)[drive])
