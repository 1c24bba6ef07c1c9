"""How values of drives and outputs are written: angles in degrees, lengths in the unit of the linkage."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, tau

from gruebler.base.text import Message, message
from gruebler.mechanics.linkages import Linkage

_TYPED = 1e-7  # degrees: beyond the rounding of what is found
_NOTHING = 1e-12  # of the size: lengths below it are roundings


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasureUnits:
    """How drive and output values are written."""

    turning_drive: bool
    turning_output: bool
    unit: str
    size: float
    """Of the linkage: a length that is nothing against it is 0."""
    round: bool = False
    """Whether the output turns fully: its angles are those of one turn, from 0."""

    def drive(self, value: float) -> Message:
        """A drive value."""
        return angle_message(value) if self.turning_drive else self.length(value)

    def output(self, value: float) -> Message:
        """A value of the output."""
        if self.turning_output:
            return angle_message(value % tau if self.round else value)
        return self.length(value)

    def length(self, value: float) -> Message:
        """A length."""
        return length_message(0.0 if abs(value) < _NOTHING * self.size else value, self.unit)

    def range(self, full: bool, low: float, high: float) -> Message:
        """How far the drive moves."""
        if full:
            return message("The drive turns fully.")
        text = _TURNS if self.turning_drive else _MOVES
        return text.filled(low=self.drive(low), high=self.drive(high))


_TURNS = message("The drive turns from {low} to {high}.")
_MOVES = message("The drive moves from {low} to {high}.")


def drive_units(linkage: Linkage) -> MeasureUnits:
    """How the values of the first drive of a linkage are written."""
    turning = linkage.mechanism.drives[0].turning
    return MeasureUnits(turning_drive=turning, turning_output=turning, unit=linkage.unit, size=linkage.size)


def length_message(value: float, unit: str) -> Message:
    """A length, with its unit if it has one."""
    return message("{length:n} {unit}" if unit else "{length:n}", length=value, unit=unit)


def angle_message(value: float) -> Message:
    """An angle in degrees; one that comes within 1e-7 of three places, as a person types it, is that."""
    turn = degrees(value)
    typed = round(turn, 3)
    return message("{degrees:n}°", degrees=(typed if abs(turn - typed) < _TYPED else turn) + 0.0)
