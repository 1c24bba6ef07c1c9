"""Curves of cams, turns of Geneva and non-circular wheels as polynomials for the kernel; docs/theory/wheels.md."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import log, pi

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError, naming
from gruebler.base.text import message
from gruebler.machines.cams import Cam, CamError, Flat, Roller, read_lift
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.kinematics.noncircular import transfer_of
from gruebler.mechanics.linkages import CamDisc, GenevaDriver, GenevaWheel, NonCircular

COEFFICIENTS = 12
_EXACT = 5e-16  # of the largest value: terms of a piece that are rounding
_CONSTANT = 1e-14  # of the largest value: a law that varies by less between two joints varies by rounding only
_NO_TURN = 1e-12  # radians: between joints of a law that are nearer lies nothing but rounding
_ROUNDING = 1e-14  # radians: a step of Newton's method that is shorter changes nothing
_SHORTEST = 0.04  # radians: shorter pieces would lose in their rates what they gain in themselves


@dataclass(frozen=True, slots=True)
class PiecewiseLaw:
    """A function of an angle on one turn."""

    pieces: tuple[tuple[float, ...], ...]
    """Middle, half the width, coefficients on [-1, 1], by rising angle."""
    advance: float = 0.0
    """What it grows by in a turn."""
    joints: tuple[float, ...] = ()
    """The angles at which it is not smooth: where rises, falls, dwells and the pieces of their laws begin."""

    def scaled(self, size: float, logarithm: bool) -> PiecewiseLaw:
        """The same in another unit of length: values by size, of a logarithm less its logarithm."""
        if logarithm:
            return replace(self, pieces=tuple((m, h, c - log(size), *rest) for m, h, c, *rest in self.pieces))
        return replace(self, pieces=tuple((m, h, *(c / size for c in rest)) for m, h, *rest in self.pieces))


@lru_cache(maxsize=64)
def cam_of(disc: CamDisc) -> Cam:
    """The cam of an element, in its own unit; `LinkageError` for one that cannot be."""
    with naming(message("cam"), LinkageError):
        if disc.flat and (disc.roller or disc.offset or disc.arm):
            raise CamError("a flat face has no roller, no offset and no arm")
        if disc.face and not disc.flat:
            raise CamError("only a flat face has a distance from its pivot")
        follower: Flat | Roller = Flat(disc.distance, disc.face) if disc.flat else _roller(disc)
        lift = read_lift(disc.lift)
        cam = Cam(lift.scaled(pi / 180) if follower.swings else lift, disc.base, follower)
        undercut = cam.findings().undercut
    if undercut:
        raise LinkageError("cam: the profile crosses itself, so that the follower cannot follow the lift")
    return cam


def _roller(disc: CamDisc) -> Roller:
    return Roller(disc.roller, disc.offset, disc.arm, disc.distance)


@lru_cache(maxsize=64)
def cam_law(disc: CamDisc) -> PiecewiseLaw:
    """The curve of a cam.

    For a roller: the logarithm of the pitch curve's radius by its direction; for a flat face: its distance by the
    direction of its outward normal. `LinkageError` for a cam that cannot be.
    """
    cam = cam_of(disc)
    breaks = [span.start for span in cam.lift.spans()] + [2 * pi]
    if not (np.diff(_bearing(cam, np.linspace(0, 2 * pi, 2881))[0]) < 0).all():
        raise LinkageError(
            "cam: the face turns faster than the cam; less lift or a longer angle for it helps"
            if cam.follower.has_face
            else "cam: the pitch curve turns back as seen from the axis; less lift or a larger base circle helps"
        )
    bounds = _bearing(cam, np.array(breaks[::-1]) - 1e-300)[0].tolist()
    base = cam.follower.reach(np.array([cam.start]))
    length = disc.scale * float(base[0])

    def value(t: Reals, low: float, high: float) -> Reals:
        ends = np.interp([low, high], bounds, breaks[::-1])
        gain = cam.follower.gain(cam.start, cam.lift.at(_turned(cam, t, *ends)))
        logarithm: Reals = disc.scale * gain if cam.follower.has_face else np.log1p(gain / base**2) / 2
        return logarithm

    return _law(value, bounds, length if cam.follower.has_face else log(length))


def _bearing(cam: Cam, phi: Reals) -> tuple[Reals, Reals]:
    """The direction of the roller's centre, or of the face's normal, in the cam's frame; its derivative by phi."""
    direction, turn = cam.follower.bearing(cam.start + cam.lift.at(phi))
    return direction - phi, turn * cam.lift.at(phi, 1) - 1


def _turned(cam: Cam, t: Reals, high: float, low: float) -> Reals:
    """The cam's angles at which `_bearing` has given values; Newton's method."""
    phi: Reals = high + (low - high) * (t - t.min()) / max(float(np.ptp(t)), 1e-300)
    for _ in range(40):
        at, slope = _bearing(cam, phi)
        step = (at - t) / slope
        phi -= step
        if np.abs(step).max() < _ROUNDING:
            break
    return phi


@lru_cache(maxsize=64)
def noncircular_law(first: NonCircular, second: NonCircular) -> PiecewiseLaw:
    """The angle of a non-circular wheel by that of the first, both against the line of centres.

    `LinkageError` for a pair that cannot be.
    """
    pair = transfer_of(first, second)
    bounds = [*(pair.breaks or (0.0,)), 2 * pi]
    law = _law(lambda t, _a, _b: -pair.at(t), bounds, advance=-2 * pi * float(pair.mean))
    return replace(law, joints=law.joints if pair.breaks else ())


@lru_cache(maxsize=64)
def geneva_law(driver: GenevaDriver, cross: GenevaWheel) -> PiecewiseLaw:
    """The angle of a Geneva wheel by that of its driver, both against the line of centres.

    `LinkageError` for a pair that cannot be.
    """
    with naming(message("Geneva drive"), LinkageError):
        drive = Geneva(cross.slots, internal=cross.internal, pins=driver.pins)
    pitch = 2 * pi / driver.pins
    bounds = sorted({k * pitch + side * drive.engaged for k in range(driver.pins) for side in (-1, 1)})
    bounds = [*bounds, bounds[0] + 2 * pi]
    ends = drive.move(np.array([0.0, 2 * pi])).angle
    return _law(lambda t, _a, _b: drive.move(t).angle, bounds, advance=float(ends[1] - ends[0]))


def _law(
    function: Callable[[Reals, float, float], Reals], bounds: Sequence[float], base: float = 0.0, advance: float = 0.0
) -> PiecewiseLaw:
    """Polynomials for ``base + function``, through Chebyshev's points between the bounds, halved until they are exact.

    Coefficients are sums in closed form, not the solution of a system, and those that are rounding are 0: a dwell
    has one coefficient, so that velocities in it are exactly 0 on every machine.
    """
    angles = pi * (np.arange(COEFFICIENTS) + 0.5) / COEFFICIENTS
    nodes, cosines = np.cos(angles), np.cos(np.outer(np.arange(COEFFICIENTS), angles))
    pieces: list[tuple[float, ...]] = []

    def add(low: float, high: float) -> None:
        middle, half = (low + high) / 2, (high - low) / 2
        values = function(middle + half * nodes, low, high)
        first, size = float(values[0]), float(np.abs(values).max())
        series = 2 / COEFFICIENTS * (cosines * (values - first)).sum(axis=1)
        series[0] = base + first + series[0] / 2
        if np.ptp(values) <= _CONSTANT * (abs(base) + size):
            series[1:] = 0.0
        elif np.abs(series[-2:]).max() > _EXACT * (abs(base) + size) and half > _SHORTEST:
            add(low, middle)
            add(middle, high)
            return
        series[1:][np.abs(series[1:]) <= 4 * _EXACT * size] = 0.0
        coefficients = np.polynomial.chebyshev.cheb2poly(series)
        pieces.append((middle, half, *np.pad(coefficients, (0, COEFFICIENTS - len(coefficients))).tolist()))

    for low, high in pairwise(bounds):
        if high - low > _NO_TURN:
            add(low, high)
    return PiecewiseLaw(tuple(pieces), advance, tuple(bounds))
