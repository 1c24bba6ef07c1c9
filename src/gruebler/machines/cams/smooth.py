"""Contours given by points or by a function: periodic splines with numerical contacts."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.notebook import brief
from gruebler.base.text import message
from gruebler.machines.cams.contour import ContactSamples, arm_coordinate, face_coordinate
from gruebler.machines.cams.follower import Flat, Follower, Roller
from gruebler.machines.cams.laws import CamError, finite_array

_BISECTIONS = 52
_CHUNK = 1 << 20
_MOST = 1e70  # of lengths, as for followers: their powers stay finite


@brief
@dataclass(frozen=True, slots=True, repr=False)
class SmoothContour:
    """A closed smooth curve, counter-clockwise about the cam's axis; it may be hollow.

    Contacts are bracketed on ``resolution`` places of the curve and bisected to machine precision; a wave of the
    contour that is shorter than a step of that table can be missed. Cost O(angles * resolution).
    """

    spline: Any
    period: float
    resolution: int

    @classmethod
    def through(cls, points: ArrayLike, degree: int = 3, resolution: int = 2048) -> SmoothContour:
        """The periodic spline through points of shape (n, 2), by chord length; degree 3 has a continuous curvature.

        >>> angles = np.linspace(0, 2 * math.pi, 60, endpoint=False)
        >>> circle = SmoothContour.through(np.stack([10 + 30 * np.cos(angles), 30 * np.sin(angles)], axis=1))
        >>> from gruebler.machines.cams import Flat, follower_motion
        >>> [round(float(value), 3) for value in follower_motion(circle, Flat(), 0.5)]
        [34.794, 8.776, -4.793]
        """
        table = finite_array(points, message("points of a contour"))
        if table.ndim != 2 or table.shape[1] != 2:
            raise CamError("a contour is given by rows of two finite numbers, x and y")
        if (np.abs(table) >= _MOST).any():
            raise CamError("a contour has coordinates below {most:g}", most=_MOST)
        if len(table) > 1 and (table[0] == table[-1]).all():
            table = table[:-1]
        closed = np.vstack([table, table[:1]])
        steps = np.hypot(*np.diff(closed, axis=0).T)
        if len(table) < 4 or not (steps > 0).all():
            raise CamError("a contour has at least four points, neighbours different")
        return cls._closed(np.concatenate([[0.0], np.cumsum(steps)]), closed, degree, resolution)

    @classmethod
    def of(cls, curve: Callable[[Reals], ArrayLike], samples: int = 1440, resolution: int = 2048) -> SmoothContour:
        """The contour of a function from angles in [0, 2 pi) to points of shape (n, 2); a quintic spline."""
        u = np.linspace(0, math.tau, samples + 1)
        table = finite_array(curve(u[:-1]), message("points of a contour"))
        if table.shape != (samples, 2):
            raise CamError(
                "the function gives {samples} points x, y for {samples} angles, not the shape {shape}",
                samples=samples,
                shape=table.shape,
            )
        return cls._closed(u, np.vstack([table, table[:1]]), 5, resolution)

    @classmethod
    def _closed(cls, u: Reals, points: Reals, degree: int, resolution: int) -> SmoothContour:
        from scipy.interpolate import make_interp_spline

        x, y = points.T
        if float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) < 0:
            u, points = u[-1] - u[::-1], points[::-1]
        turns = np.angle((points[1:] @ [1, 1j]) / (points[:-1] @ [1, 1j])).sum() / math.tau
        if round(float(turns)) != 1:
            raise CamError("the contour goes once around the cam's axis, the point (0, 0)")
        return cls(make_interp_spline(u, points, k=degree, bc_type="periodic"), float(u[-1]), resolution)

    def at(self, u: Reals, order: int = 0) -> Complexes:
        """Points of the curve, or derivatives by its parameter."""
        pair = self.spline(np.mod(u, self.period), order)
        return np.asarray(pair[..., 0] + 1j * pair[..., 1])

    def touch(self, follower: Follower, angle: Reals) -> ContactSamples:
        """The outermost contact at each angle; NaN where there is none."""
        rows = max(1, _CHUNK // self.resolution)
        parts = [self._touch(follower, angle[k : k + rows]) for k in range(0, len(angle), rows)]
        return ContactSamples(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def _touch(self, follower: Follower, angle: Reals) -> ContactSamples:
        turn = np.exp(1j * angle)
        table = np.linspace(0, self.period, self.resolution + 1)
        find = self._roller_place if isinstance(follower, Roller) else self._flat_place
        u = find(follower, turn, table)  # type: ignore[arg-type]
        known = np.where(np.isnan(u), 0.0, u)
        z, z1, z2 = (self.at(known, order) for order in range(3))
        normal = -1j * z1 / np.abs(z1) * turn
        with np.errstate(divide="ignore"):
            radius = np.abs(z1) ** 3 / np.imag(np.conj(z1) * z2)
        if isinstance(follower, Flat):
            s, along = face_coordinate(follower, z * turn, 0.0), np.imag(np.conj(normal) * z * turn)
        else:
            centre = z * turn + follower.radius * normal
            s = arm_coordinate(follower, centre - follower.distance) if follower.swings else centre.imag
            along = np.zeros(len(angle))
        return ContactSamples(np.where(np.isnan(u), np.nan, s), normal, radius, along)

    def _roller_place(self, roller: Roller, turn: Complexes, table: Reals) -> Reals:
        """The outermost place where the offset curve meets the guide of the roller's centre."""

        def offset(u: Reals) -> Complexes:
            tangent = self.at(u, 1)
            return np.asarray(self.at(u) - 1j * roller.radius * tangent / np.abs(tangent))

        def beside(centre: Complexes) -> Reals:
            if not roller.swings:
                return np.asarray(centre.real - roller.offset)
            return np.abs(centre - roller.distance) - roller.arm

        centres = offset(table)[None, :] * turn[:, None]
        side = beside(centres)
        s = arm_coordinate(roller, centres - roller.distance) if roller.swings else centres.imag
        crossing = (side[:, :-1] <= 0) != (side[:, 1:] <= 0)
        height = np.where(crossing & np.isfinite(s[:, :-1]), s[:, :-1], -np.inf)
        k = np.argmax(height, axis=1)
        places = _bisected(lambda u: beside(offset(u) * turn), table[k], table[k + 1])
        return np.where(np.isfinite(height[np.arange(len(turn)), k]), places, np.nan)

    def _flat_place(self, flat: Flat, turn: Complexes, table: Reals) -> Reals:
        """The outermost place of the contour in the direction of the face's normal."""

        def climb(u: Reals) -> Reals:
            normal = np.exp(1j * flat.line(face_coordinate(flat, self.at(u) * turn, 0.0)).angle)
            return np.asarray(np.real(np.conj(normal) * self.at(u, 1) * turn))

        s = face_coordinate(flat, self.at(table[:-1])[None, :] * turn[:, None], 0.0)
        lost: NDArray[np.bool_] = np.asarray(~np.isfinite(s).all(axis=1))
        k = np.argmax(np.where(lost[:, None], 0.0, s), axis=1)
        step = table[1]
        return np.where(lost, np.nan, _bisected(climb, table[k] - step, table[k] + step))


def _bisected(function: Callable[[Reals], Reals], a: Reals, b: Reals) -> Reals:
    """A place in each [a, b] where the sign changes."""
    below = function(a) <= 0
    for _ in range(_BISECTIONS):
        middle = (a + b) / 2
        same = (function(middle) <= 0) == below
        a, b = np.where(same, middle, a), np.where(same, b, middle)
    return (a + b) / 2
