"""What the motion of a linkage in space shows: range of the drive, dead centres, speed ratio, range of every joint."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite, tau
from typing import Any, NamedTuple, overload

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.events import DeadCentre, Extremum
from gruebler.base.notebook import brief, explained
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, joined, joined_by_and, message
from gruebler.mechanics.analysis import measuring
from gruebler.mechanics.analysis.measuring import Measures
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, linkage_made
from gruebler.mechanics.screws.conversion import SpatialLike
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.curve import ConfigurationCurve
from gruebler.mechanics.space.drive_ranges import SpatialRange, followed, spatial_range, value_message
from gruebler.mechanics.space.ends import endless
from gruebler.mechanics.space.following import setting
from gruebler.mechanics.space.motion import SpatialMotion, SpatialStop
from gruebler.mechanics.space.outputs import against_frame, output_freedom, valued_freedoms
from gruebler.structure.chain.spaces import Freedom

_ROWS = 145
_ASIDE = 0.0123  # radians: rows do not begin at the reference pose, where a symmetric linkage often stops
_STEPS = 3  # of Newton's method, which begins within 2.5 degrees by regula falsi
_MOVES = 1e-6  # by the length of the curve: a joint that is slower stands
_STILL = 1e-9  # of the usual rate: smaller ones are 0 all the way

_WITH = message("Output {joint}: it turns fully in the sense of the drive, {turns:g} : 1.")
_AGAINST = message("Output {joint}: it turns fully against the sense of the drive, {turns:g} : 1.")
_SWINGS = message("Output {joint}: from {low} to {high}, that is {travel}.")
_ENDLESS = message("Output {joint}: unbounded, from {low} to {high}.")
_CENTRES = message("Dead centres of the output {joint} at {centres}.")
_RATIO = message("Speed ratio, output by drive: from {least:n} at {first} to {most:n} at {second} of the drive.")
_CONSTANT = message("Speed ratio, output by drive: {ratio:.4g}, constant.")
_JOINTS = message("Relative motion at the joints: {joints}.")


@dataclass(frozen=True, kw_only=True)
class JointRange:
    """How far one freedom of a joint goes, of its second link against its first."""

    joint: str
    freedom: str
    """Such as ``Rz``."""
    lowest: float
    highest: float
    """Radians or lengths, counted from the reference pose; infinite for a shift that grows without end."""
    full: bool
    """Whether its links turn fully against each other."""


@explained
@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class SpatialMeasures:
    """The measures of a linkage in space with one drive; values of drive and output are 0 in the reference pose."""

    linkage: SpatialLinkage
    range: SpatialRange
    output: str
    """The joint of the output."""
    freedom: str
    joints: tuple[JointRange, ...]
    """All joints whose freedoms have values; balls have none."""
    dead_centres: tuple[DeadCentre, ...]
    ratios: tuple[Extremum, ...]
    """Where the output's speed by the drive's is largest or smallest, the ends of the range among them; in order.

    Infinite where the drive stands at a limit and the output does not."""
    turns: int
    """Whole turns of the output in one of the drive; 0 where it swings or slides."""

    @cached_property
    def least_ratio(self) -> Extremum:
        """The smallest speed ratio."""
        return min(self.ratios, key=lambda each: each.value)

    @cached_property
    def greatest_ratio(self) -> Extremum:
        """The largest speed ratio."""
        return max(self.ratios, key=lambda each: each.value)

    @property
    def travel(self) -> float:
        """How far the output goes, in radians or lengths; infinite for a slide that goes on without end."""
        (row,) = (row for row in self.joints if (row.joint, row.freedom) == (self.output, self.freedom))
        return row.highest - row.lowest

    def rows(self, count: int) -> Reals:
        """Values of the drive for a table, (rows, 1): a full turn from the reference pose, or the range."""
        values = np.linspace(0.0, tau, count) if self.range.full else self.range.inside(count)
        return values[:, None]

    def explain(self, lang: str = "en") -> str:
        """Range of the drive with its reasons, output, dead centres, speed ratio and joints: a line each."""
        return "\n".join(line.in_language(lang) for line in self._lines())

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`; angles in radians."""
        return {
            "low": self.range.lowest,
            "high": self.range.highest,
            "full": self.range.full,
            "ends": [None if stop is None else stop.explain() for stop in self.range.stops],
            **plain(self, "output freedom turns travel dead_centres least_ratio greatest_ratio joints"),
        }

    def _lines(self) -> Iterator[Message]:
        chain = self.linkage.mechanism.chain

        def drive(value: float) -> Message:
            return drive_values(self.linkage, (value,))

        def title(joint: str) -> Message:
            return joined([chain.joint_title(chain.joint_number(joint))])

        yield from self.range.lines()
        if self.turns:
            yield (_WITH if self.turns > 0 else _AGAINST).filled(joint=title(self.output), turns=abs(self.turns))
        else:
            (row,) = (row for row in self.joints if (row.joint, row.freedom) == (self.output, self.freedom))
            texts = [self._value(v, Freedom(row.freedom).turns) for v in (row.lowest, row.highest, self.travel)]
            text = _SWINGS if isfinite(self.travel) else _ENDLESS
            yield text.filled(joint=title(self.output), low=texts[0], high=texts[1], travel=texts[2])
        if self.dead_centres:
            centres = joined_by_and([drive(each.drive) for each in self.dead_centres])
            yield _CENTRES.filled(joint=title(self.output), centres=centres)
        least, greatest = self.least_ratio, self.greatest_ratio
        natural = self._natural(Freedom(self.freedom).turns) / self._natural(self._drive_turns)
        if greatest.value - least.value < _STILL * max(abs(greatest.value), natural):
            yield _CONSTANT.filled(ratio=greatest.value if abs(greatest.value) > _STILL * natural else 0.0)
        else:
            first, second = (self._value(each.at, self._drive_turns) for each in (least, greatest))
            low, high = (float(f"{each.value:.4g}") for each in (least, greatest))
            yield _RATIO.filled(least=low, first=first, most=high, second=second)
        parts = [message("{joint} {range}", joint=title(row.joint), range=self._extent(row)) for row in self.joints]
        yield _JOINTS.filled(joints=joined(parts, "; "))

    @property
    def _drive_turns(self) -> bool:
        return self.linkage.mechanism.drives[0].turning

    def _natural(self, turns: bool) -> float:
        return 1.0 if turns else self.linkage.size

    def _extent(self, row: JointRange) -> Message:
        if row.full:
            return message("full turns")
        if not isfinite(row.highest - row.lowest):
            return message("unbounded")
        return self._value(row.highest - row.lowest, Freedom(row.freedom).turns)

    def _value(self, value: float, turns: bool) -> Message:
        return value_message(self.linkage, value, turns)


@overload
def measures(
    linkage: SpatialLike, *, branch: Branch = None, speed: float | None = None, output: str | None = None
) -> SpatialMeasures: ...


@overload
def measures(
    linkage: LinkageLike, *, branch: Branch = None, speed: float | None = None, output: str | None = None
) -> Measures: ...


@door_that_raises(LinkageError)
def measures(
    linkage: LinkageLike | SpatialLike,
    *,
    branch: Branch = None,
    speed: float | None = None,
    output: str | None = None,
) -> Measures | SpatialMeasures:
    """All measures of a linkage with one drive, over a full turn of the drive or over its whole range.

    Args:
        linkage: a linkage whose drive fixes the motion, in the plane or a `SpatialLinkage`; or a `FourBar`,
            `SliderCrank`, `InvertedSliderCrank`.
        branch: as for `move`; without it that of the reference pose, else all ``+`` and 1. It applies where the motion
            starts: `gruebler.mechanics.analysis.drive_cycles.drive_cycle`. Not in space.
        speed: of the drive in rad/s, for the times; not zero. `gruebler.rpm` converts. Not in space.
        output: a link or a sliding joint; without it the linkage's first output, else the last link at the frame. In
            space a joint; without it that of the first output at the frame, else the last one of the frame.

    Returns:
        `Measures`: dead centres, stroke, times (seconds), transmission angle, transfer functions; angles in radians,
        lengths in the linkage's unit. In space `SpatialMeasures`: range of the drive with its reasons, dead centres,
        speed ratio, range of every joint.

    Raises:
        LinkageError: more drives than one, a linkage that cannot be assembled, a wrong name or number.

    Cost:
        Some 60 ms for a dyad, 0.2 s for a group of four links, 1 to 2 s in space.

    Example:
        >>> from gruebler.mechanics.kinematics.drive_rows import rpm
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> found = measures(FourBar(a=2, b=7, c=4.5, d=5.5), speed=rpm(300))
        >>> round(found.time_ratio, 6), round(found.times.longest, 6), round(found.travel, 6)
        (1.357364, 0.115159, 1.205044)

    See Also:
        `move`, `plot`, `rpm`, `drive_range`, `Measures`

    Theory:
        docs/theory/events.md
    """
    placed = linkage_made(linkage, unit="")
    if not isinstance(placed, SpatialLinkage):
        return measuring.measures(placed, branch=branch, speed=speed, output=output)
    if branch is not None or speed is not None:
        raise LinkageError("a linkage in space has measures by its drive, without branch and speed")
    return _measured(placed, output)


def _measured(linkage: SpatialLinkage, output: str | None) -> SpatialMeasures:
    number, freedom = output_freedom(linkage, output)
    span = spatial_range(linkage)
    low, high = (_ASIDE, _ASIDE + tau) if span.full else (None, None)
    values = np.linspace(low, high, _ROWS) if low is not None and high is not None else span.inside(_ROWS)
    course = followed(linkage, values[:, None], order=3)
    freedoms = list(valued_freedoms(linkage))
    rests = _zeros(linkage, course, [*((*each, 1) for each in freedoms), (number, freedom, 2)])
    sign = against_frame(linkage, number)
    names = linkage.mechanism.chain.joint_names()
    value, rate = course.joint(number, freedom, 0), sign * course.joint(number, freedom, 1)
    ratios = [
        Extremum(
            at=zero.drive % tau if span.full else zero.drive,
            value=sign * zero.rate,
            kind="minimum" if sign * zero.next > 0 else "maximum",
        )
        for zero in rests[-1]
    ]
    ends = [Extremum(at=float(values[k]), value=float(rate[k]), kind="") for k in ((0,) if span.full else (0, -1))]
    if not span.full:
        at_ends = _at_ends(linkage, span, number, freedom)
        ends = [_towards(linkage, *each, number, freedom) for each in zip(ends, span.stops, at_ends, strict=True)]
    return SpatialMeasures(
        linkage=linkage,
        range=span,
        output=names[number],
        freedom=freedom,
        joints=tuple(
            _joint_range(names[k], f, course.joint(k, f), _at_ends(linkage, span, k, f), span, found_zeros)
            for (k, f), found_zeros in zip(freedoms, rests, strict=False)
        ),
        dead_centres=tuple(
            DeadCentre(
                drive=zero.drive % tau if span.full else zero.drive,
                output=sign * zero.value,
                kind="minimum" if sign * zero.next > 0 else "maximum",
            )
            for zero in rests[freedoms.index((number, freedom))]
        ),
        ratios=tuple(sorted([*ratios, *([] if span.full and ratios else ends)], key=lambda each: each.at)),
        turns=round(float(value[-1] - value[0]) * sign / tau) if span.full and Freedom(freedom).turns else 0,
    )


class _Zero(NamedTuple):
    """Where a derivative of a joint's value vanishes."""

    drive: float
    value: float
    rate: float
    next: float
    """The derivative of the next order."""


def _zeros(linkage: SpatialLinkage, course: SpatialMotion, wanted: Sequence[tuple[int, str, int]]) -> list[list[_Zero]]:
    """Where derivatives of joints' values vanish, for each (joint, freedom, order): all refined along one path."""
    values = course.drives[:, 0]
    places: list[tuple[float, float, float, int]] = []
    for n, (number, freedom, order) in enumerate(wanted):
        f = course.joint(number, freedom, order)
        if float(abs(f).max()) < _STILL * max(float(abs(course.joint(number, freedom, 1)).max()), 1.0):
            continue
        signs = np.sign(f[np.maximum.accumulate(np.where(f, np.arange(len(f)), 0))])  # of a row of 0 that before it
        for k in np.flatnonzero(signs[:-1] * signs[1:] < 0).tolist():
            low, high = float(values[k]), float(values[k + 1])
            places.append((low + (high - low) * float(f[k] / (f[k] - f[k + 1])), low, high, n))
    zeros: list[list[_Zero]] = [[] for _ in wanted]
    if not places:
        return zeros
    for step in range(_STEPS + 1):
        places.sort()
        there = followed(linkage, np.array([[place[0]] for place in places]), order=3)
        derivatives = {n: [there.joint(k, f, m) for m in range(4)] for n, (k, f, _) in enumerate(wanted)}
        if step < _STEPS:
            places = [
                _nearer(place, derivatives[place[3]], wanted[place[3]][2], row) for row, place in enumerate(places)
            ]
    for row, (at, _, _, n) in enumerate(places):
        own = [float(each[row]) for each in derivatives[n]]
        zeros[n].append(_Zero(at, own[0], own[1], own[wanted[n][2] + 1]))
    return zeros


def _nearer(
    place: tuple[float, float, float, int], derivatives: Sequence[Reals], order: int, row: int
) -> tuple[float, float, float, int]:
    """One step of Newton's method, not out of the rows around."""
    at, low, high, n = place
    slope = float(derivatives[order + 1][row])
    step = float(derivatives[order][row]) / slope if slope else 0.0
    return min(max(at - step, low), high), low, high, n


def _at_ends(linkage: SpatialLinkage, span: SpatialRange, joint: int, freedom: str) -> tuple[float | None, ...]:
    """A joint's value where the range ends, up to whole turns; None without a stop, or where modes meet."""
    set_up = setting(linkage)
    curve = ConfigurationCurve(set_up)

    def value(stop: SpatialStop | None, side: float) -> float | None:
        if stop is not None and stop.reason == "endless":
            beyond = endless(set_up, 0, stop.place, side * set_up.closure.tree.signs[0])
            known = None if beyond is None else beyond.value(joint, freedom)
            if known is not None:
                return known
        point = None if stop is None else curve.near(stop.place)
        return None if point is None else float(curve.motion([point]).joint(joint, freedom)[0])

    return tuple(value(stop, side) for stop, side in zip(span.stops, (-1.0, 1.0), strict=True))


def _towards(
    linkage: SpatialLinkage, beside: Extremum, stop: SpatialStop | None, value: float | None, joint: int, freedom: str
) -> Extremum:
    """The speed ratio towards an end: infinite where the drive stands and the output does not, or shifts without end.

    Else that in the last row, of which it also has the sign.
    """
    grows = value is not None and not isfinite(value)
    if stop is not None and stop.reason == "limit":
        curve = ConfigurationCurve(setting(linkage))
        point = curve.near(stop.place)
        if point is not None:
            natural = 1.0 if Freedom(freedom).turns else linkage.size
            grows = abs(float(curve.motion([point]).joint(joint, freedom, 1)[0])) > _MOVES * natural
    if stop is None or not grows:
        return beside
    return Extremum(at=stop.drives[0], value=float(np.copysign(np.inf, beside.value)), kind="")


def _joint_range(
    name: str,
    freedom: str,
    value: Reals,
    at_ends: tuple[float | None, ...],
    span: SpatialRange,
    zeros: Sequence[_Zero],
) -> JointRange:
    extremes = [zero.value for zero in zeros]
    net = float(value[-1] - value[0])
    ends = [] if span.full and extremes else [0.0, net] if span.full else value[[0, -1]].tolist()
    for side, exact in enumerate(at_ends):
        if exact is not None and not span.full:
            whole = round((ends[side] - exact) / tau) if Freedom(freedom).turns else 0
            ends[side] = exact + tau * whole
    extent = [*extremes, *ends]
    turns = Freedom(freedom).turns
    return JointRange(
        joint=name,
        freedom=freedom,
        lowest=min(extent),
        highest=max(extent),
        full=turns and (max(extent) - min(extent) >= tau - _STILL or (span.full and abs(net) > tau / 2)),
    )
