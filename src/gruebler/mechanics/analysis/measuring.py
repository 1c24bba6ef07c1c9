"""Everything that is measured on a linkage with one drive, found by root finding: docs/theory/events.md.

`Measures` (fields are stable):

- ``linkage, output`` (`Output`: name, link, joint, turning), ``branch`` (labels at ``start``), ``start`` (drive value);
- ``span`` (`CycleSpan`: low, high, full, turns, stops, period, width): the drive's range; ``turning_drive``;
- ``ends``: the output at both ends of a range that is no full turn, else None;
- ``dead_centres`` (tuple of `DeadCentre`: drive, output, kind maximum/minimum/flat, flat, side inner/outer/"");
- ``dwells`` (tuple of `Dwell`: begin, end, duration, output, kind, side): where the output rests; ``dwell_share``;
  ``moving_span``, ``motion_ratio``: how far the drive moves while the output does, and that by the dwells;
- ``inner, outer`` (`DeadCentre`, `Dwell` or None), ``travel`` (stroke or swing, None if the output goes round),
  ``output_turns`` (turns of the output per period);
- ``phi_forward, phi_back, phi_max, phi_min, delta_phi, time_ratio`` (drive angles inner to outer and back while the
  output moves; None if not defined), ``speed``, ``times`` (`StrokeTimes` in seconds, None without a speed),
  ``dwell_time``;
- ``change_points`` (tuple of `ChangePoint`: drive, links, form; ``change_points_error`` says if some are not
  known);
- ``transfer`` (`Transfer`: still, uniform, ratio, largest, smallest, zeros, velocity, acceleration);
- ``transmission`` (`TransmissionExtremes`: extremes, smallest, largest, legs, good; None if undefined, then
  ``transmission_note`` says why); ``cams`` (tuple of `CamContour`: link, base, convex, hollow);
- ``explain(lang)`` prose, ``to_json()`` plain data with angles in degrees.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, isfinite, pi
from typing import Any

import numpy as np

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.events import ChangePoint, DeadCentre, Transmission, TransmissionExtremes
from gruebler.base.notebook import brief
from gruebler.base.plain_data import Units, plain
from gruebler.base.text import Message, message
from gruebler.mechanics.analysis.cam_contacts import CamContour, cam_contours
from gruebler.mechanics.analysis.cycle_spans import CycleSpan, by_place
from gruebler.mechanics.analysis.drive_cycles import DriveCycle, drive_cycle
from gruebler.mechanics.analysis.events import (
    Crossing,
    Dwell,
    change_points,
    crossings,
    dyad_change_points,
    natural_speed,
    output_turns,
    stops,
    transfer_function,
)
from gruebler.mechanics.analysis.measure_units import MeasureUnits
from gruebler.mechanics.analysis.messages import (
    cam_message,
    change_point_lines,
    dead_centre_message,
    dwell_lines,
    dwell_share_message,
    lift_message,
    motion_share_message,
    output_lines,
    stroke_lines,
    time_lines,
    transmission_lines,
    unknown_change_points_message,
    way_message,
)
from gruebler.mechanics.analysis.outputs import Output, find_output
from gruebler.mechanics.analysis.transmission import (
    NoTransmissionAngleError,
    in_line,
    measure_transmission,
)
from gruebler.mechanics.fourbar.extremes import StrokeTimes
from gruebler.mechanics.kinematics.drive_rows import in_rpm
from gruebler.mechanics.kinematics.motion import Stop
from gruebler.mechanics.kinematics.root_finding import sample_function
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

_UNIFORM = 1e-9  # by how much the velocity of a uniform transmission may vary
_KEYS = (
    "ends dead_centres dwells dwell_share moving_span motion_ratio dwell_time output_turns travel phi_forward phi_back "
    "time_ratio speed_rpm times change_points transmission transmission_note cams"
)
_SHOWN = {
    CamContour: "link base convex hollow",
    ChangePoint: "drive links form several",
    Crossing: "drive value kind",
    Dwell: "begin end duration output kind side",
    Stop: "reason links",
    StrokeTimes: "forward back",
    Transmission: "drive mu deviation links",
    TransmissionExtremes: "smallest largest good extremes",
}
_DRIVES, _OUTPUTS = ("start", "drive", "begin", "end", "duration", "moving_span"), ("ends", "output", "travel")
_ANGLES = ("phi_forward", "phi_back", "mu", "deviation")
_STILL = 1e-11  # of the natural size: an output, or its velocity, that varies by less does not move


@dataclass(frozen=True, slots=True, kw_only=True)
class Transfer:
    """What the transfer functions of order 0, 1 and 2 do over the range."""

    still: bool
    """Whether the output does not move at all."""
    uniform: bool
    """Whether psi' is constant: a linear transfer function."""
    ratio: float | None
    """The transmission ratio i = omega in by omega out, with its sign, if it is constant."""
    largest: float
    """The largest psi' in the grid and at its extremes; grows without bound towards a limit of the drive."""
    smallest: float
    """The smallest (most negative) psi'."""
    zeros: tuple[Crossing, ...]
    """Zeros of the output itself."""
    velocity: tuple[Crossing, ...]
    """Extremes of psi': zeros of psi''."""
    acceleration: tuple[Crossing, ...]
    """Extremes of psi'': zeros of psi'''."""


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class Measures:
    """The measures of a linkage on one branch; angles in radians, lengths in the linkage's unit.

    See Also:
        `measures`, `drive_range`, `Motion`

    Theory:
        docs/theory/events.md
    """

    linkage: Linkage
    output: Output
    branch: tuple[str, ...]
    start: float
    turning_drive: bool
    span: CycleSpan
    ends: tuple[float, float] | None
    dead_centres: tuple[DeadCentre, ...]
    in_line: bool
    """Whether crank and coupler lie in line there: else the output turns back without a dead centre in that sense."""
    dwells: tuple[Dwell, ...]
    """Where the output rests, behind a cam or a Geneva drive."""
    output_turns: int
    travel: float | None
    shift: float
    """How far apart the places of a point of the output are at most, if it only travels: alike for all; else 0."""
    change_points: tuple[ChangePoint, ...]
    change_points_error: LinkageError | None
    """Why those of larger groups are not known; None if they are."""
    transfer: Transfer
    transmission: TransmissionExtremes | None
    transmission_error: NoTransmissionAngleError | None
    """Why there is no transmission angle; None if there is one."""
    cams: tuple[CamContour, ...]
    """The radii of its cams."""
    speed: float | None
    """Of the drive, in rad/s."""

    @property
    def transmission_note(self) -> str:
        """Why there is no transmission angle, in English; empty if there is one."""
        return str(self.transmission_error or "")

    @property
    def lifted_by_cam(self) -> bool:
        """Whether a cam pushes the output itself, so that it has lifts and no dead centres."""
        return self.transmission is not None and self.transmission.legs[0] in self.transmission.cams

    @property
    def inner(self) -> DeadCentre | Dwell | None:
        """The inner dead centre, or the dwell in its place."""
        return self._extreme("inner")

    @property
    def outer(self) -> DeadCentre | Dwell | None:
        """The outer dead centre, or the dwell in its place."""
        return self._extreme("outer")

    @property
    def stops(self) -> tuple[DeadCentre | Dwell, ...]:
        """Where the output stops: dead centres, then dwells."""
        return (*self.dead_centres, *self.dwells)

    def _extreme(self, side: str) -> DeadCentre | Dwell | None:
        return next((stop for stop in self.stops if stop.side == side), None)

    @property
    def phi_forward(self) -> float | None:
        """The drive angle from the inner to the next outer dead centre, in the positive sense, less dwells between."""
        return self._way(self.inner, self.outer)

    @property
    def phi_back(self) -> float | None:
        """The drive angle from the outer to the next inner dead centre, in the positive sense, less dwells between."""
        return self._way(self.outer, self.inner)

    def _way(self, start: DeadCentre | Dwell | None, end: DeadCentre | Dwell | None) -> float | None:
        """How far the drive turns, while the output moves, from one stop to the next that is like the other.

        Of several stops like the first before that one the last counts: the ways are those of a mirror image, too.
        """
        if start is None or end is None or not self.span.full:
            return None
        period, near = self.span.period, 1e-9 * (self.travel or 0.0)

        def alike(extreme: DeadCentre | Dwell) -> list[DeadCentre | Dwell]:
            return [
                stop for stop in self.stops if stop.kind == extreme.kind and abs(stop.output - extreme.output) <= near
            ]

        def ahead(drive: float, of: float) -> float:
            return (drive - of) % period

        leaves = [stop.end if isinstance(stop, Dwell) else stop.drive for stop in alike(start)]
        first = start.end if isinstance(start, Dwell) else start.drive
        arrives = first + min(
            ahead(stop.begin if isinstance(stop, Dwell) else stop.drive, first) for stop in alike(end)
        )
        travel = min(ahead(arrives, leave) for leave in leaves)
        begins = arrives - travel
        return travel - sum(dwell.duration for dwell in self.dwells if ahead(dwell.drive, begins) < travel)

    @property
    def _whole(self) -> float:
        return self.span.period if self.span.full else self.span.width

    @property
    def dwell_share(self) -> float:
        """The part of the period, or of the drive's range, in which the output rests; 0 without a dwell."""
        return sum(dwell.duration for dwell in self.dwells) / self._whole

    @property
    def moving_span(self) -> float:
        """How far the drive moves, in the period or in its range, while the output does: without the dwells."""
        return self._whole - sum(dwell.duration for dwell in self.dwells)

    @property
    def motion_ratio(self) -> float | None:
        """The span in which the output moves by that in which it rests; None without a dwell."""
        return (1 - self.dwell_share) / self.dwell_share if self.dwells else None

    @property
    def speed_rpm(self) -> float | None:
        """The speed of the drive in revolutions per minute, as files and texts say it."""
        return None if self.speed is None else in_rpm(self.speed)

    @property
    def dwell_time(self) -> float | None:
        """How long the output rests in one period at the speed given, in seconds."""
        if self.speed is None or not self.span.full:
            return None
        return self.dwell_share * self.span.turns * 2 * pi / abs(self.speed)

    @property
    def phi_max(self) -> float | None:
        """The larger of the two."""
        return None if self.phi_forward is None or self.phi_back is None else max(self.phi_forward, self.phi_back)

    @property
    def phi_min(self) -> float | None:
        """The smaller of the two."""
        return None if self.phi_forward is None or self.phi_back is None else min(self.phi_forward, self.phi_back)

    @property
    def delta_phi(self) -> float | None:
        """By how much the larger is more than half the period."""
        return None if self.phi_max is None or self.phi_min is None else (self.phi_max - self.phi_min) / 2

    @property
    def time_ratio(self) -> float | None:
        """The larger by the smaller: the ratio of times at constant speed."""
        return None if self.phi_max is None or self.phi_min is None else self.phi_max / self.phi_min

    @property
    def times(self) -> StrokeTimes | None:
        """How long both ways take at the speed given, in seconds; a negative speed turns the other way."""
        if self.speed is None or self.phi_forward is None or self.phi_back is None:
            return None
        angles = (self.phi_forward, self.phi_back)
        return StrokeTimes(*(x / abs(self.speed) for x in angles[:: 1 if self.speed > 0 else -1]))

    def explain(self, lang: str = "en") -> str:
        """The measures as lines of prose, in English (``en``) or German (``de``)."""
        lines = [line.in_language(lang) for line in self._lines()]
        return "\n".join(line[:1].upper() + line[1:] for line in lines)

    def _lines(self) -> Iterator[Message]:
        units = MeasureUnits(
            turning_drive=self.turning_drive,
            turning_output=self.output.turning,
            unit=self.linkage.unit,
            size=self.linkage.size,
            round=self.output.turning and self.output_turns != 0,
        )
        yield from self.span.lines()
        ratio = self.transfer.ratio if self.transfer.uniform else None
        name, turns = self.output.name, self.output_turns
        yield from output_lines(
            units, name, still=self.transfer.still, ratio=ratio, turns=turns, travel=self.travel, shift=self.shift
        )
        if self.lifted_by_cam and self.inner is not None:
            least = self.inner.output
            yield from (lift_message(units, centre, least) for centre in self.dead_centres)
        else:
            yield from (dead_centre_message(units, centre, in_line=self.in_line) for centre in self.dead_centres)
        yield from dwell_lines(units, self.dwells, self.span.period)
        if self.dwells:
            yield dwell_share_message(self.dwell_share)
            if self.output_turns and self.motion_ratio:
                yield motion_share_message(units, self.moving_span, self.span.period, self.motion_ratio)
        outward = None
        if self.phi_forward is not None and self.phi_back is not None and self.inner and self.outer:
            outward = way_message(units, self.inner.output, self.outer.output, in_line=self.in_line)
            yield from stroke_lines(
                units, outward, self.phi_forward, self.phi_back, self.time_ratio, dwells=bool(self.dwells)
            )
        at_rest = self.dwell_time if self.dwells else None
        yield from time_lines(self.speed_rpm, outward, self.times, at_rest)
        drive_size = 1.0 if self.turning_drive else self.linkage.size
        yield from change_point_lines(units, by_place(self.change_points, drive_size))
        if self.change_points_error is not None:
            yield unknown_change_points_message(self.change_points_error)
        if self.transmission is not None:
            yield from transmission_lines(units, self.transmission)
        else:
            yield message("{why}.", why=self.transmission_error)
        yield from (cam_message(units, cam) for cam in self.cams)

    def to_json(self) -> dict[str, Any]:
        """The measures as plain data; angles in degrees, times in seconds."""
        turn = degrees if self.turning_drive else float
        in_unit = degrees if self.output.turning else float
        rate = in_unit(1.0) / turn(1.0)
        units: Units = {
            **dict.fromkeys(_DRIVES, turn),
            **dict.fromkeys(_OUTPUTS, in_unit),
            **dict.fromkeys(_ANGLES, degrees),
        }
        span, transfer = self.span, self.transfer
        rates = plain(transfer, "still uniform", shown=_SHOWN)
        rates["ratio"] = None if transfer.ratio is None else transfer.ratio / rate
        for keys, scale in (("smallest largest zeros velocity", rate), ("acceleration", rate / turn(1.0))):
            scaled = dict.fromkeys(("smallest", "largest", "value"), scale.__mul__)
            rates |= plain(transfer, keys, units={**units, **scaled}, shown=_SHOWN)
        return {
            "output": {"name": self.output.name, "unit": "deg" if self.output.turning else self.linkage.unit},
            "drive": {
                "unit": "deg" if self.turning_drive else self.linkage.unit,
                "range": None if span.full else [turn(span.low), turn(span.high)],
                **plain(self, "start branch", units=units),
                **plain(span, "full turns stops", shown=_SHOWN),
            },
            "transfer": rates,
            "change_points_note": str(self.change_points_error or ""),
            **plain(self, _KEYS, units=units, shown=_SHOWN),
        }


@door_that_raises(LinkageError)
def measures(
    linkage: LinkageLike,
    *,
    branch: Branch = None,
    speed: float | None = None,
    output: str | None = None,
) -> Measures:
    """All measures of a linkage with one drive, over a full turn of the drive or over its whole range.

    What the arguments are, what it costs, and an example: `gruebler.measures`, which takes linkages in space, too.

    Raises:
        LinkageError: more drives than one, a linkage that cannot be assembled, a wrong name or number.
    """
    linkage = as_linkage(linkage, unit="")
    looked_at = find_output(linkage, output)
    checked = _speed(speed)
    cycle = drive_cycle(linkage, branch=branch)
    if checked is not None and not cycle.turning_drive:
        raise LinkageError("a speed in rad/s needs a turning drive; this linkage has a sliding one")
    return measures_of(cycle, linkage, looked_at, checked)


def measures_of(cycle: DriveCycle, linkage: Linkage, looked_at: Output, speed: float | None = None) -> Measures:
    """All measures of a linkage over a course of its drive, which may be a part of its range."""
    span = cycle.span
    ends = None
    if not span.full:
        size = 1.0 if looked_at.turning else cycle.size
        low, high = (cycle.end(looked_at.values, upper, size).real for upper in (False, True))
        ends = low, high
    centres, rests = stops(cycle, looked_at)
    turns = output_turns(cycle, looked_at)
    changes_error: LinkageError | None = None
    try:
        changes = change_points(cycle)
    except LinkageError as error:
        changes, changes_error = dyad_change_points(cycle), error
    transmission_error: NoTransmissionAngleError | None = None
    try:
        transmission = measure_transmission(cycle, looked_at)
    except NoTransmissionAngleError as error:
        transmission, transmission_error = None, error
    transfer = _transfer(cycle, looked_at)
    return Measures(
        linkage=linkage,
        output=looked_at,
        branch=cycle.start.branch,
        start=float(cycle.start.drives[0, 0]),
        turning_drive=cycle.turning_drive,
        span=span,
        ends=ends,
        dead_centres=centres,
        in_line=in_line(cycle.plan, looked_at),
        dwells=rests,
        output_turns=turns,
        travel=None
        if turns
        else _travel(cycle, looked_at, [*(c.output for c in centres), *(r.output for r in rests), *(ends or ())]),
        shift=_shift(cycle, looked_at) if transfer.still and looked_at.turning else 0.0,
        change_points=changes,
        change_points_error=changes_error,
        transfer=transfer,
        transmission=transmission,
        transmission_error=transmission_error,
        cams=cam_contours(linkage),
        speed=speed,
    )


def _speed(speed: float | None) -> float | None:
    if speed is None:
        return None
    if not isfinite(speed) or speed == 0:
        raise LinkageError("the speed is a number in rad/s other than 0, not {speed!r}; rpm() converts", speed=speed)
    return float(speed)


def _travel(cycle: DriveCycle, output: Output, values: list[float]) -> float:
    """The difference of the largest and the smallest output among its stops and ends."""
    if not values:  # it goes nowhere, or its motion has no end: what the grid shows
        track = transfer_function(cycle, output, cycle.grid)
        least = _STILL * (1.0 if output.turning else cycle.size)
        return float(np.ptp(track)) if np.ptp(track) > least else 0.0
    return max(values) - min(values)


def _shift(cycle: DriveCycle, output: Output) -> float:
    """How far apart the places of the output's origin are, in the grid."""
    apart = output.shift(cycle.at(cycle.grid, 0))
    return apart if apart > _STILL * cycle.size else 0.0


def _transfer(cycle: DriveCycle, output: Output) -> Transfer:
    track = transfer_function(cycle, output, cycle.grid, 1)
    still, uniform = _kind(cycle, output)
    usual = float(np.median(track))
    velocity = () if still or uniform else crossings(cycle, output, 2)
    acceleration = () if still or uniform else crossings(cycle, output, 3)
    values = [*track.tolist(), *(crossing.value for crossing in velocity)]
    return Transfer(
        still=still,
        uniform=uniform,
        ratio=1 / usual if uniform else None,
        largest=usual if uniform else max(values),
        smallest=usual if uniform else min(values),
        zeros=() if still else crossings(cycle, output, 0),
        velocity=velocity,
        acceleration=acceleration,
    )


def _kind(cycle: DriveCycle, output: Output) -> tuple[bool, bool]:
    """Whether the output never moves, and whether psi' is constant: on each piece on which the motion is analytic."""
    parts = sample_function(lambda drives: transfer_function(cycle, output, drives, 1)[None], cycle.samples(1))
    usual = float(np.median(np.concatenate([part[0] for part in parts])))
    scale = _STILL * natural_speed(cycle, output)
    still = all(float(np.quantile(np.abs(part[0]), 0.9)) <= scale for part in parts)
    varies = max(float(np.quantile(np.abs(part[0] - usual), 0.9)) for part in parts)
    return still, not still and varies <= _UNIFORM * abs(usual)
