"""The coupler curve: the path of a point over a whole turn or the whole range of the drive, with all that is on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import degrees, pi

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.text import message
from gruebler.mechanics.geometry.contact import TangentContact, tangent_contact
from gruebler.mechanics.geometry.double_points import DoublePoint, double_points
from gruebler.mechanics.geometry.path_events import (
    Cusp,
    Inflection,
    TurningPoint,
    Vertex,
    cusps,
    goes_back,
    inflections,
    turning_points,
    vertices,
)
from gruebler.mechanics.geometry.point_path import PointPath, point_path
from gruebler.mechanics.geometry.sampling import PathPolygon, path_area, path_length, path_polygon
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.mechanics.linkages.points import PointLike
from gruebler.mechanics.linkages.quantities import as_finite

_TOLERANCE = 1e-4  # of the reach of linkage and path


_CLOSED = message("Closed path, {length:n} {unit} long, around {area:n} {unit}².")
_OPEN = message("Path from one limit of the drive to the other, {length:n} {unit} long.")
_CLOSED_WITHOUT_UNIT = message("Closed path, {length:n} long, around an area of {area:n}.")
_OPEN_WITHOUT_UNIT = message("Path from one limit of the drive to the other, {length:n} long.")
_EXTENT = message("It reaches from x = {left:n} to {right:n} and from y = {bottom:n} to {top:n}.")
_EVENTS = message("Cusps: {cusps}; points of inflection: {inflections}; double points: {doubles}.")
_RETRACED = message("It runs to and fro along itself.")


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False)
class CouplerCurve:
    """The path of a point on one branch of a linkage. Everything is found when it is asked for.

    Drive values are in radians (or the unit), those of a drive that turns fully from 0 to the period.
    """

    point_path: PointPath
    tolerance: float
    """How far the polygon of `points` may be off, in the linkage's unit."""

    @property
    def closed(self) -> bool:
        """Whether the drive turns fully; else the path goes from one limit of the drive to the other."""
        return self.point_path.closed

    @property
    def points(self) -> Complexes:
        """Corners x + iy of a polygon within the tolerance; the last one of a closed path is the first."""
        return self._samples.points

    @property
    def drives(self) -> Reals:
        """The drive's values at `points`."""
        return self.point_path.drive(self._samples.parameters)

    @property
    def length(self) -> float:
        """How long it is; a path between limits is measured once."""
        return self._length[0]

    @property
    def length_error(self) -> float:
        """About by how much the length may be wrong."""
        return self._length[1]

    @cached_property
    def arcs(self) -> Reals:
        """The way along the polygon to each of `points`; its end differs from `length` by the tolerance's share."""
        return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.points)))])

    @cached_property
    def area(self) -> float | None:
        """The area that it goes round, counter-clockwise positive; None for a path between limits."""
        return path_area(self.point_path, self._samples) if self.closed else None

    @cached_property
    def cusps(self) -> tuple[Cusp, ...]:
        """Where the point stands still."""
        return cusps(self.point_path)

    @cached_property
    def inflections(self) -> tuple[Inflection, ...]:
        """Where the curvature is zero, without cusps."""
        return inflections(self.point_path, self.cusps)

    @cached_property
    def vertices(self) -> tuple[Vertex, ...]:
        """Where the curvature is extreme, without cusps."""
        return vertices(self.point_path, self.cusps, self.inflections)

    def turning_points(self, direction: float = 0.0) -> tuple[TurningPoint, ...]:
        """Where the path turns back along a direction: 0 in x, pi/2 in y."""
        return turning_points(self.point_path, direction)

    @property
    def retraced(self) -> bool:
        """Whether it runs along itself, as the arc of a rocker's pin does: then no double points are told."""
        return self._doubles is None

    @property
    def double_points(self) -> tuple[DoublePoint, ...]:
        """Where it crosses or touches itself."""
        return self._doubles or ()

    def contact(self, drive: float, highest: int = 10) -> TangentContact:
        """The order of contact with the tangent at a drive value; angles up to whole turns.

        Raises `LinkageError` for a value outside the range of the drive.
        """
        value, cycle = as_finite("drive", drive), self.point_path.cycle
        span, scale, unit = cycle.span, 1.0, f" {cycle.linkage.unit}".rstrip()
        if cycle.turning_drive:
            scale, unit = degrees(1), "°"
            if not span.low <= value <= span.high:
                value = span.low + (value - span.low) % (span.period if span.full else 2 * pi)
        if not span.low <= value <= span.high:
            low, high, drive = span.low * scale, span.high * scale, drive * scale
            raise LinkageError(
                "the drive goes from {low:.6g}{unit} to {high:.6g}{unit}, not to {drive:.6g}{unit}",
                low=low,
                unit=unit,
                high=high,
                drive=drive,
            )
        motion = cycle.at(np.array([value]), 1)
        return tangent_contact(motion, self.point_path.place, 0, highest)

    def explain(self, lang: str = "en") -> str:
        """How long it is, how far it reaches and what is on it, in English or German (``de``).

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> print(coupler_curve(FourBar(25, 70, 40, 70).linkage({"K": (30, 20)}), "K"))
        Closed path, 138.2 mm long, around 1282 mm².
        It reaches from x = -6.536 to 43.47 and from y = 10.93 to 50.95.
        Cusps: 0; points of inflection: 2; double points: 0.
        """
        unit = self.point_path.cycle.linkage.unit
        opened, closed = (_OPEN, _CLOSED) if unit else (_OPEN_WITHOUT_UNIT, _CLOSED_WITHOUT_UNIT)
        length = opened if self.area is None else closed.filled(area=abs(self.area))
        x, y = self.points.real, self.points.imag
        numbers = {"cusps": self.cusps, "inflections": self.inflections, "doubles": self.double_points}
        lines = (
            length.filled(length=self.length, unit=unit),
            _EXTENT.filled(left=x.min(), right=x.max(), bottom=y.min(), top=y.max()),
            _RETRACED if self.retraced else _EVENTS.filled(**{name: len(each) for name, each in numbers.items()}),
        )
        return "\n".join(line.in_language(lang) for line in lines)

    @cached_property
    def _samples(self) -> PathPolygon:
        return path_polygon(self.point_path, self.tolerance)

    @cached_property
    def _length(self) -> tuple[float, float]:
        return path_length(self.point_path, self._samples, np.array([cusp.parameter for cusp in self.cusps]))

    @cached_property
    def _doubles(self) -> tuple[DoublePoint, ...] | None:
        if any(goes_back(self.point_path, cusp) for cusp in self.cusps):
            return None
        if not self.vertices and not self.cusps and self.closed:  # a smooth one has four, unless it is a circle
            return ()
        return double_points(self.point_path, self._samples, 2 * self.tolerance)


@door_that_raises(LinkageError)
def coupler_curve(
    linkage: LinkageLike,
    point: PointLike,
    *,
    drives: ArrayLike | None = None,
    branch: Branch = None,
    tolerance: float | None = None,
) -> CouplerCurve:
    """The path of a point of any linkage with one drive, over a full turn or range.

    Args:
        linkage: a linkage with one drive, or with several and a path of them.
        point: a point that moves: its name, ``(link, x, y)``, or ``(x, y)`` on the coupler of a four-bar
            (`Linkage.points_named`).
        drives: (rows, drives) a straight path of the drives, from its first row to its last; events then have the part
            of it, 0 to 1, instead of a drive value.
        branch: the assembly mode, as for `move`.
        tolerance: how far the polygon may be off; 1/10,000 of the linkage's size, or of the path's extent
            if that is larger, if it is left out.

    Returns:
        `CouplerCurve`: the polygon (rows, 2), cusps, inflections, double points and extremes, in the linkage's unit;
        drive values in radians or the unit. Events are exact to some 1e-13 of the parameter; within 1/720 of its range
        from a limit of the drive none are looked for.

    Raises:
        LinkageError: a point that does not move, several drives without a path of them, an unknown point.

    Cost:
        Some milliseconds; with double points some tens.

    Example:
        >>> from gruebler.mechanics.fourbar import InvertedSliderCrank
        >>> conchoid = coupler_curve(InvertedSliderCrank(30, 50).linkage({"C": (90, 0)}), "C")
        >>> [round(float(np.degrees(one.drive)), 2) for one in conchoid.inflections]
        [80.56, 147.1, 212.9, 279.44]

    See Also:
        `move`, `plot`, `measures`

    Theory:
        docs/theory/coupler-curves.md
    """
    trail = point_path(as_linkage(linkage, unit=""), point, branch=branch, drives=drives)
    return CouplerCurve(trail, _TOLERANCE * trail.reach if tolerance is None else tolerance)
