"""What an entry says of its motion, derived again: how straight, how far, how long at rest, how fast.

A printed number may be rounded: it holds within half a percent. A printed zero holds within the roundings of the
solver.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from math import degrees, radians
from typing import TYPE_CHECKING

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.files.catalog_records import Entry, MotionQuantity
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan, move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.teaching.catalog.claims import WrongClaim

if TYPE_CHECKING:
    from gruebler.mechanics.space.measuring import SpatialMeasures
    from gruebler.mechanics.space.motion import SpatialMotion

_ROWS = 361
_ROUNDED = 5e-3  # of the printed number
_EXACT = 1e-9  # of the linkage's size, of a turn, of a ratio of 1


def wrong_quantities(entry: Entry) -> Iterator[WrongClaim]:
    """The claims of an entry's motion that do not hold.

    Cost: a motion of 361 poses for each claim.

    >>> from gruebler.teaching.catalog import entry
    >>> list(wrong_quantities(entry("lambda")))
    []
    """
    linkage = _moving(entry)
    for number, claim in enumerate(entry.quantities, 1):
        where = f"quantities {number}, {claim.kind} {claim.of}"
        try:
            derived = derived_numbers(entry, claim, linkage)
        except LinkageError as error:
            yield WrongClaim(where, claim.of, error)
            continue
        for key, printed in claim.numbers.items():
            scale = linkage.size if key in ("length", "band") else 360.0 if key == "degrees" else 1.0
            if printed is None or abs(derived[key] - printed) > _ROUNDED * abs(printed) + _EXACT * scale:
                yield WrongClaim(f"{where}: {key}", printed, f"{derived[key]:.6g}")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Run:
    """A linkage that one of its drives moves."""

    linkage: Linkage
    claim: MotionQuantity
    drive: int
    low: float
    high: float

    def values(self, rows: Reals) -> Reals:
        """All drives over values of the moving one; (rows, drives)."""
        drives = self.linkage.mechanism.drives
        if len(drives) == 1:
            return rows[:, None]
        reference = pose_at_reference(cached_plan(self.linkage), np.zeros(len(drives))).drives
        values = np.tile(reference, (len(rows), 1))
        values[:, self.drive] = rows
        return values

    def moved(self, low: float, high: float, rows: int = _ROWS) -> Motion:
        """The motion between two values of the drive, at speed 1."""
        speed = [float(k == self.drive) for k in range(len(self.linkage.mechanism.drives))]
        motion = move_quietly(self.linkage, self.values(np.linspace(low, high, rows)), speed=[speed], order=1)
        if not motion.complete:
            raise LinkageError("{reason}", reason=motion.reason)
        return motion

    @property
    def motion(self) -> Motion:
        """The motion over the range of the claim."""
        return self.moved(self.low, self.high)

    def coordinate(self, motion: Motion, order: int = 0) -> Reals:
        """The angle of the link, or the way of the slide."""
        if self.claim.of in self.linkage.mechanism.chain.links:
            return motion.angular(self.claim.of, order=order)
        return motion.displacement(self.claim.of, order=order)


def _moving(entry: Entry) -> Linkage | SpatialLinkage:
    placed = entry.placed() if entry.dimensions is None else None
    return placed if isinstance(placed, SpatialLinkage) else entry.linkage()


def derived_numbers(
    entry: Entry, claim: MotionQuantity, linkage: Linkage | SpatialLinkage | None = None
) -> dict[str, float]:
    """The numbers of a claim as the entry's dimensions give them.

    `LinkageError` where the linkage cannot be moved so far, or has no such point, link or joint.

    >>> from gruebler.teaching.catalog import entry
    >>> record = entry("lambda")
    >>> {key: round(value, 3) for key, value in derived_numbers(record, record.quantities[0]).items()}
    {'length': 80.0, 'band': 0.195}
    """
    linkage = _moving(entry) if linkage is None else linkage
    if isinstance(linkage, SpatialLinkage):
        return _derived_in_space(entry, linkage, claim)
    mechanism = linkage.mechanism
    drive = 0
    if claim.drive is not None:
        joint = mechanism.chain.joint_number(claim.drive)
        drive = next((k for k, each in enumerate(mechanism.drives) if each.joint == joint), -1)
        if drive < 0:
            raise LinkageError("{joint} is not driven", joint=claim.drive)
    turning = mechanism.drives[drive].turning
    sizes = entry.dimensions
    span = claim.range or (None if sizes is None else sizes.range) or (0.0, 360.0)
    low, high = (radians(value) if turning else value for value in span)
    return _DERIVED[claim.kind](_Run(linkage=linkage, claim=claim, drive=drive, low=low, high=high))


def _straight(run: _Run) -> dict[str, float]:
    from gruebler.mechanics.geometry import path_piece

    def path(values: Reals) -> np.ndarray:
        rows = np.ravel(values)
        motion = run.moved(float(rows[0]), float(rows[-1]), len(rows))
        return motion.complex_point(run.claim.of).reshape(np.shape(values))

    direction = None if run.claim.direction is None else radians(_angle(run.claim))
    piece = path_piece(path, run.low, run.high, direction, samples=_ROWS)
    return {"length": piece.length, "band": piece.band}


def _angle(claim: MotionQuantity) -> float:
    if not isinstance(claim.direction, float | int):
        raise LinkageError("{of}: in the plane a direction is an angle in degrees", of=claim.of)
    return claim.direction


def _swing(run: _Run) -> dict[str, float]:
    return {"degrees": float(np.degrees(np.ptp(run.motion.angle(run.claim.of))))}


def _stroke(run: _Run) -> dict[str, float]:
    motion = run.motion
    if run.claim.direction is None:
        return {"length": float(np.ptp(motion.displacement(run.claim.of)))}
    along = np.exp(-1j * radians(_angle(run.claim)))
    return {"length": float(np.ptp((motion.complex_point(run.claim.of) * along).real))}


def _dwell(run: _Run) -> dict[str, float]:
    """The longest part of two cycles of the drive in which the coordinate stays what it is."""
    width = run.high - run.low
    motion = run.moved(run.low, run.low + 2 * width, 4 * _ROWS - 3)
    still = np.abs(run.coordinate(motion, 1)) < 1e-9 * max(1.0, run.linkage.size)
    ends = np.flatnonzero(np.diff(np.concatenate([[False], still, [False]]).astype(int)))
    longest = max((b - 1 - a for a, b in zip(ends[::2], ends[1::2], strict=True)), default=0)
    part = longest / (len(still) - 1) * 2 * width
    return {"degrees": float(np.degrees(part)) if run.linkage.mechanism.drives[run.drive].turning else part}


def _ratio(run: _Run) -> dict[str, float]:
    rates = run.coordinate(run.motion, 1)
    return {"least": float(rates.min()), "greatest": float(rates.max())}


def _turns(run: _Run) -> dict[str, float]:
    angles = run.motion.angle(run.claim.of)
    return {"turns": float(angles[-1] - angles[0]) / (2 * np.pi)}


_DERIVED: Mapping[str, Callable[[_Run], dict[str, float]]] = {
    "straight": _straight,
    "swing": _swing,
    "stroke": _stroke,
    "dwell": _dwell,
    "ratio": _ratio,
    "turns": _turns,
}


def _derived_in_space(entry: Entry, linkage: SpatialLinkage, claim: MotionQuantity) -> dict[str, float]:
    """Of a joint over all that the one drive can reach by root finding, else along the range of the claim."""
    from gruebler.mechanics.space.measuring import measures

    joint = linkage.mechanism.chain.find_joint(claim.of) is not None
    ranged = claim.range is not None or (entry.screws is not None and entry.screws.range is not None)
    if joint and claim.kind in _MEASURED and not ranged and len(linkage.mechanism.drives) == 1:
        return _MEASURED[claim.kind](measures(linkage, output=claim.of))
    known = _OF_JOINT if joint else _OF_LINK_OR_POINT
    if claim.kind not in known:
        raise LinkageError("{kind} is not derived in space", kind=claim.kind)
    return known[claim.kind](_course_in_space(entry, linkage, claim), claim)


def _course_in_space(entry: Entry, linkage: SpatialLinkage, claim: MotionQuantity) -> SpatialMotion:
    """The motion over the range of the claim, of the entry, or all there is; several drives move alike."""
    from gruebler.mechanics.space.drive_ranges import followed, spatial_range

    drives = linkage.mechanism.drives
    moving = [claim.drive in (None, name) for name in linkage.mechanism.drive_names()]
    if not any(moving):
        raise LinkageError("{joint} is not driven", joint=claim.drive)
    span = claim.range or (None if entry.screws is None else entry.screws.range)
    if span is None:
        values = spatial_range(linkage).inside(_ROWS)
    else:
        low, high = (radians(v) if drives[moving.index(True)].turning else v for v in span)
        values = np.linspace(low, high, _ROWS)
    return followed(linkage, values[:, None] * np.array(moving, float), order=1)


_MEASURED: Mapping[str, Callable[[SpatialMeasures], dict[str, float]]] = {
    "swing": lambda measured: {"degrees": degrees(measured.travel)},
    "stroke": lambda measured: {"length": measured.travel},
    "ratio": lambda measured: {"least": measured.least_ratio.value, "greatest": measured.greatest_ratio.value},
    "turns": lambda measured: {"turns": float(measured.turns)},
}


def _turned(course: SpatialMotion, claim: MotionQuantity) -> dict[str, float]:
    """The largest turn of a link away from the reference pose; its half has the sine of the quaternion's vector."""
    vector = np.linalg.norm(course.quaternion(claim.of)[:, 1:], axis=1)
    return {"degrees": 2 * degrees(float(np.arcsin(np.minimum(vector, 1.0)).max()))}


def _path(course: SpatialMotion, claim: MotionQuantity) -> tuple[Reals, Reals]:
    """The path of a point along a direction, and its places across it, (rows, 3)."""
    if not isinstance(claim.direction, tuple):
        raise LinkageError("{of}: the path of a point in space needs a direction of three numbers", of=claim.of)
    unit = np.array(claim.direction) / np.linalg.norm(claim.direction)
    places = course.point(claim.of)
    along = places @ unit
    return along, places - along[:, None] * unit


def _straight_in_space(course: SpatialMotion, claim: MotionQuantity) -> dict[str, float]:
    along, across = _path(course, claim)
    apart = np.linalg.norm(across[:, None] - across[None], axis=2)
    return {"length": float(np.ptp(along)), "band": float(apart.max())}


_OF_LINK_OR_POINT: Mapping[str, Callable[[SpatialMotion, MotionQuantity], dict[str, float]]] = {
    "swing": _turned,
    "stroke": lambda course, claim: {"length": float(np.ptp(_path(course, claim)[0]))},
    "straight": _straight_in_space,
}
_OF_JOINT: Mapping[str, Callable[[SpatialMotion, MotionQuantity], dict[str, float]]] = {
    "swing": lambda course, claim: {"degrees": degrees(float(np.ptp(course.joint(claim.of))))},
    "stroke": lambda course, claim: {"length": float(np.ptp(course.joint(claim.of)))},
}
