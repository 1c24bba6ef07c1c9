"""The lift of a follower over a turn of the cam: a sequence of motions and dwells, and its text form."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import nearest
from gruebler.base.immutable import settle
from gruebler.base.text import message
from gruebler.machines.cams.extremes import Function, extremes
from gruebler.machines.cams.laws import CamError, MotionLaw, boundary_law, finite_array, motion_law

_LEAST = 1e-9  # radians of a part: the parts must fill a turn to this


@dataclass(frozen=True, slots=True)
class LiftSegment:
    """A part of the turn: the lift changes by ``scale`` times the law; angle in radians. A dwell has no law."""

    angle: float
    scale: float = 0.0
    law: MotionLaw | None = None

    @property
    def change(self) -> float:
        """The difference of the lift between its ends."""
        return self.scale * (self.law.end(0) - float(self.law.at(0.0))) if self.law else 0.0


@dataclass(frozen=True, slots=True)
class DerivativeJump:
    """A jump of a derivative at an angle; 1: velocity, an impact; 2: acceleration, infinite jerk."""

    at: float
    order: int
    size: float


class SmoothSpan(NamedTuple):
    """An interval on which the lift is smooth: its ends, and the derivatives, one-sided at the ends."""

    start: float
    end: float
    segment: int
    orders: tuple[Function, ...]


def dwell(angle: float) -> LiftSegment:
    """A dwell over an angle in radians."""
    return LiftSegment(_angle(angle))


_LARGEST = 1e70  # of lengths, as everywhere: their squares and quotients by the square of an angle stay finite


def motion(change: float, angle: float, name: str | MotionLaw = "3-4-5") -> LiftSegment:
    """A rise (or fall, if negative) by a law."""
    if not isinstance(change, int | float) or not math.isfinite(change) or change == 0:
        raise CamError("a rise or fall has a finite lift that is not zero, not {change!r}", change=change)
    if not 1 / _LARGEST < abs(change) < _LARGEST:
        raise CamError(
            "a lift lies between {smallest:g} and {largest:g}, not {change!r}: choose another unit",
            smallest=1 / _LARGEST,
            largest=_LARGEST,
            change=change,
        )
    return LiftSegment(_angle(angle), float(change), name if isinstance(name, MotionLaw) else motion_law(name))


def _angle(angle: float) -> float:
    if not isinstance(angle, int | float) or not _LEAST <= angle <= math.tau * (1 + 1e-12):
        raise CamError(
            "a part of the turn has an angle from {least:g} to 2 pi, not {angle!r} rad", least=_LEAST, angle=angle
        )
    return float(angle)


@dataclass(frozen=True, slots=True)
class Lift:
    """A closed lift: the parts fill a turn and the last ends where the first began.

    >>> quarter = math.pi / 2
    >>> lift = Lift([motion(20, quarter), dwell(quarter), motion(-20, quarter, "cycloidal"), dwell(quarter)])
    >>> lift.at([0.0, math.pi / 4, 2.0]).round(6).tolist()
    [0.0, 10.0, 20.0]
    >>> round(float(lift.at(math.pi / 4, 1)), 6)  # 1.875 * 20 / (pi / 2)
    23.873241
    """

    segments: tuple[LiftSegment, ...]

    def __init__(self, segments: Iterable[LiftSegment]) -> None:
        settle(self, segments=tuple(segments))
        if not self.segments:
            raise CamError("a lift has at least one part")
        turn = sum(segment.angle for segment in self.segments)
        if abs(turn - math.tau) > _LEAST:
            raise CamError("the parts of a lift fill 360 degrees, not {turn:.6g}", turn=math.degrees(turn))
        remainder = sum(segment.change for segment in self.segments)
        if abs(remainder) > 1e-9 * max(1e-300, *(abs(segment.change) for segment in self.segments)):
            raise CamError("the lift must end where it began; {left:+.6g} is left over", left=remainder)

    def scaled(self, factor: float) -> Lift:
        """Every lift times a factor, as from degrees to radians."""
        return Lift(replace(segment, scale=segment.scale * factor) for segment in self.segments)

    @property
    def starts(self) -> tuple[float, ...]:
        """The angle at which each part begins."""
        angles = np.cumsum([0.0, *(segment.angle for segment in self.segments[:-1])])
        return tuple(map(float, angles))

    def spans(self) -> tuple[SmoothSpan, ...]:
        """The intervals on which the lift is smooth, with lift, velocity, acceleration, jerk per radian."""
        return _spans(self)

    def at(self, angle: ArrayLike, order: int = 0) -> Reals:
        """The lift, or its derivative (1 to 3) by the cam's angle, at any angles; at a jump the value after it."""
        if order not in range(4):
            raise CamError("a lift has derivatives 0 to 3 here, not {order!r}", order=order)
        phi = np.mod(finite_array(angle, message("the cam's angles")), math.tau)
        spans = self.spans()
        index = np.searchsorted([span.start for span in spans[1:]], phi, side="right")
        values = np.zeros(phi.shape)
        for k, span in enumerate(spans):
            values[index == k] = span.orders[order](phi[index == k])
        return values

    def jumps(self) -> list[DerivativeJump]:
        """The jumps of velocity or acceleration; at each angle only the one of the lowest order."""
        spans = self.spans()
        scales = [max(abs(value) for span in spans for _, value in extremes(span.orders[n], *span[:2])) for n in (1, 2)]
        jumps = []
        for before, after in zip(spans[-1:] + spans[:-1], spans, strict=True):
            for order, scale in zip((1, 2), scales, strict=True):
                size = float(after.orders[order](np.array(after.start)) - before.orders[order](np.array(before.end)))
                if abs(size) > 1e-9 * scale:
                    jumps.append(DerivativeJump(after.start, order, size))
                    break
        return jumps

    def extremes(self, order: int) -> list[tuple[float, float]]:
        """All places (angle, value) of extremes of the lift or a derivative, one-sided values at jumps included."""
        return [extremum for span in self.spans() for extremum in extremes(span.orders[order], span.start, span.end)]


@lru_cache(maxsize=64)
def _spans(lift: Lift) -> tuple[SmoothSpan, ...]:
    return tuple(_smooth_spans(lift))


def _smooth_spans(lift: Lift) -> Iterator[SmoothSpan]:
    height = 0.0
    for k, (segment, start) in enumerate(zip(lift.segments, lift.starts, strict=True)):
        if segment.law is None:
            orders = tuple(_constant(height if n == 0 else 0.0) for n in range(4))
            yield SmoothSpan(start, start + segment.angle, k, orders)
            continue
        base = height - segment.scale * float(segment.law.at(0.0))
        for piece, a, b in zip(segment.law.pieces, segment.law.joints, segment.law.joints[1:], strict=False):
            orders = tuple(_scaled(piece.at, n, segment, start, base if n == 0 else 0.0) for n in range(4))
            yield SmoothSpan(start + a * segment.angle, start + b * segment.angle, k, orders)
        height += segment.change


def _constant(value: float) -> Function:
    return lambda phi: np.full(np.shape(phi), value)


def _scaled(piece: object, order: int, segment: LiftSegment, start: float, base: float) -> Function:
    factor = segment.scale / segment.angle**order
    return lambda phi: base + factor * piece((phi - start) / segment.angle, order)  # type: ignore[operator]


def read_lift(text: str) -> Lift:
    """Read a lift; lengths as they are (degrees if ``swinging``), angles in degrees, parts between semicolons.

    ``rise LIFT ANGLE [LAW]``, ``fall LIFT ANGLE [LAW]``, ``dwell [ANGLE]``: one dwell may omit its angle and gets
    the remainder. Boundary values may replace the law, per radian: ``rise 20 60 v0=0 a0=0 v1=5 a1=0``.

    >>> lift = read_lift("rise 20 60 3-4-5; dwell 30; fall 20 90 cycloidal; dwell")
    >>> [round(math.degrees(segment.angle), 9) for segment in lift.segments]
    [60.0, 30.0, 90.0, 180.0]
    """
    parts: list[LiftSegment | None] = []
    for statement in (
        " ".join(part.split()) for line in text.splitlines() for part in line.partition("#")[0].split(";")
    ):
        if statement:
            parts.append(_read_part(statement))
    if not parts:
        raise CamError(
            "expected a lift such as 'rise 20 60 3-4-5; dwell 30; fall 20 90 cycloidal; dwell', but found nothing"
        )
    if parts.count(None) > 1:
        raise CamError("only one dwell may leave out its angle")
    remaining = math.tau - sum(part.angle for part in parts if part)
    if None in parts and remaining <= 1e-12:
        raise CamError("no angle is left for the dwell without one")
    return Lift(dwell(remaining) if part is None else part for part in parts)


def _read_part(statement: str) -> LiftSegment | None:
    keyword, *arguments = statement.split()
    if keyword not in ("rise", "fall", "dwell"):
        raise CamError(
            "'{statement}': expected rise, fall or dwell{suggestion}",
            statement=statement,
            suggestion=nearest(keyword, ("rise", "fall", "dwell")),
        )
    if keyword == "dwell":
        if len(arguments) > 1:
            raise CamError("'{statement}': a dwell has an angle and nothing else", statement=statement)
        return dwell(math.radians(_number(arguments[0], statement))) if arguments else None
    if len(arguments) < 2:
        raise CamError(
            "'{statement}': expected a lift and an angle in degrees, such as '{word} 20 60 3-4-5'",
            statement=statement,
            word=keyword,
        )
    sign = 1 if keyword == "rise" else -1
    change, angle = sign * _number(arguments[0], statement), math.radians(_number(arguments[1], statement))
    if len(arguments) > 2 and "=" in arguments[2]:
        return LiftSegment(_angle(angle), 1.0, _bounded(change, angle, arguments[2:], statement))
    if len(arguments) > 3:
        raise CamError(
            "'{statement}': expected nothing after the law, but found {rest!r}",
            statement=statement,
            rest=" ".join(arguments[2:]),
        )
    return motion(change, angle, arguments[2] if len(arguments) > 2 else "3-4-5")


def _bounded(change: float, angle: float, assignments: list[str], statement: str) -> MotionLaw:
    """The polynomial with velocities v0, v1, accelerations a0, a1, jerks j0, j1 per radian; the others are free."""
    ends: tuple[dict[int, float], dict[int, float]] = ({0: 0.0}, {0: change})
    for assignment in assignments:
        match = re.fullmatch(r"([vaj])([01])=(\S+)", assignment)
        if not match:
            raise CamError(
                "'{statement}': expected boundary values such as v0=0 a1=2, not {word!r}",
                statement=statement,
                word=assignment,
            )
        order = "vaj".index(match[1]) + 1
        ends[int(match[2])][order] = _number(match[3], statement) * angle**order
    for values, end in zip(ends, "01", strict=True):
        if sorted(values) != list(range(len(values))):
            raise CamError(
                "'{statement}': at end {end} lower derivatives are missing; give v before a before j",
                statement=statement,
                end=end,
            )
    start, final = ([values[k] for k in range(len(values))] for values in ends)
    return boundary_law(start, final)


def _number(text: str, statement: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise CamError("'{statement}': expected a finite number, not {found!r}", statement=statement, found=text)
    if abs(value) >= _LARGEST:
        raise CamError(
            "'{statement}': expected a number below {largest:g}, not {found!r}",
            statement=statement,
            largest=_LARGEST,
            found=text,
        )
    return value
