"""How straight a path is: the band of a piece, the longest piece in a band, the relative deviation Q_G."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.points import PointLike
from gruebler.mechanics.linkages.quantities import as_finite, as_positive

Path = Callable[[Reals], Complexes]
"""Points x + iy of a path at values of its parameter, such as the crank's angle."""

_STENCIL = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
_STENCIL_STEP = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class PathPiece:
    """A piece of a path against a straight line."""

    start: float
    """The parameter at its beginning."""
    end: float
    length: float
    """How far it reaches along the line."""
    band: float
    """How far it reaches across the line: the largest deviation to one side less that to the other."""
    direction: float
    """The angle of the line, in radians from 0 to pi."""

    @property
    def ratio(self) -> float:
        """The relative deviation Q_G = band/length."""
        return self.band / self.length if self.length else math.inf


def coupler_path(
    size: FourBar | SliderCrank | InvertedSliderCrank, u: float, v: float, *, branch: Branch = None
) -> Path:
    """The path of a coupler point over crank angles, in closed form; NaN where it cannot be assembled."""

    def at(phi: Reals) -> Complexes:
        place = size.motion(phi, branch=branch).point(u, v).value
        return np.asarray(place[..., 0] + 1j * place[..., 1])

    return at


def linkage_path(linkage: Linkage, point: PointLike, *, branch: Branch = None) -> Path:
    """The path of a named point of any linkage with one drive, over the drive's values.

    The path raises `LinkageError` where the linkage cannot be moved all the way.
    """

    def at(values: Reals) -> Complexes:
        motion = move_quietly(linkage, np.ravel(values), branch=branch)
        if not motion.complete:
            raise LinkageError("{reason}", reason=motion.reason)
        return motion.complex_point(point).reshape(np.shape(values))

    return at


def path_piece(path: Path, start: float, end: float, direction: float | None = None, samples: int = 1001) -> PathPiece:
    """Length and band of a piece of a path against lines of a direction; without one, of that of the narrowest band.

    Error: with a direction, of the fourth order in the spacing of the samples; without, of the second.

    Between the ends the path should bend slowly against the spacing of the samples: at most a turn or two of a crank.

    Raises `LinkageError` where the path has no points, and for equal ends.

    >>> lever = coupler_path(FourBar(20, 50, 50, 40), 100, 0)  # 1 : 2 : 2.5, half a turn on a line
    >>> half = path_piece(lever, math.pi / 2, 3 * math.pi / 2, direction=0)
    >>> round(half.length, 6), round(half.band, 6), round(half.ratio, 6)
    (80.0, 0.195075, 0.002438)
    """
    if as_finite("start", start) == as_finite("end", end):
        raise LinkageError("a piece has two different ends, but both are at {start:.6g}", start=start)
    parameters = np.linspace(start, end, _samples(samples))
    points = _points(path, parameters)
    angle = _narrowest(points)[1] if direction is None else as_finite("direction", direction)
    seen = (points - points[0]) * np.exp(-1j * angle)
    return PathPiece(
        start=float(start), end=float(end), length=_reach(seen.real), band=_reach(seen.imag), direction=angle % math.pi
    )


def piece_of_ratio(
    path: Path,
    centre: float,
    ratio: float,
    direction: float | None = None,
    widest: float = 2 * math.pi,
    samples: int = 1001,
) -> PathPiece | None:
    """The piece symmetric about a value of the parameter whose relative deviation Q_G is the given one.

    Args:
        path: the path.
        centre: the middle of the window in the parameter.
        ratio: Q_G = (range of the deviations from the line)/(length along the line).
        direction: of the line; without one, of the path's tangent at the centre.
        widest: no window wider than this is looked at.
        samples: points of a window.

    Returns None if every window up to the widest is straighter. Of several windows it is the first, going outwards.
    Raises `LinkageError` where the path has no points, or is too curved for so small a ratio.

    >>> lenker = coupler_path(FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4), 8.018753738744802, 2.268046058132576)
    >>> found = piece_of_ratio(lenker, math.pi, 0.005)
    >>> round(math.degrees(found.end - found.start), 4), round(found.length, 4)
    (163.3248, 3.9074)
    """
    middle, wanted, half = as_finite("centre", centre), as_positive("ratio", ratio), as_positive("widest", widest) / 2
    angle = _tangent(path, middle) if direction is None else as_finite("direction", direction)
    halves = np.linspace(0, half, _samples(samples))
    both = np.array([_points(path, middle + side * halves) for side in (-1, 1)])
    seen = (both - both[0, 0]) * np.exp(-1j * angle)
    length, band = (_growing(part) for part in (seen.real, seen.imag))
    beyond = np.flatnonzero(band[1:] >= wanted * length[1:]) + 1
    if not len(beyond):
        return None
    from scipy.optimize import brentq

    def excess(width: float) -> float:
        piece = path_piece(path, middle - width, middle + width, angle, samples)
        return piece.band - wanted * piece.length

    high = float(halves[beyond[0]])
    low = _below(excess, float(halves[beyond[0] - 1]) or high / 2)
    if low is None:
        raise LinkageError(
            "at the parameter {middle:.6g} the path bends too much for a relative deviation of {wanted:g}",
            middle=middle,
            wanted=wanted,
        )
    width = float(brentq(excess, low, high, xtol=1e-14, rtol=1e-14)) if excess(high) > 0 else high
    return path_piece(path, middle - width, middle + width, angle, samples)


def longest_piece(path: Path, start: float, end: float, band: float, samples: int = 1441) -> PathPiece:
    """The piece of a path between two values of its parameter that stays in a band of any direction and is longest.

    Its ends are samples: the longest piece may be longer by the way between two of them at either end. Over a full
    turn a piece that contains the seam is found if the range is longer than the turn. Cost: about 1 ms a sample.

    Raises `LinkageError` where the path has no points.

    >>> lever = coupler_path(FourBar(20, 50, 50, 40), 100, 0)
    >>> found = longest_piece(lever, 0, 2 * math.pi, band=0.2, samples=361)
    >>> round(math.degrees(found.start)), round(math.degrees(found.end)), round(found.length, 3)
    (76, 284, 88.504)
    """
    width = as_positive("band", band)
    parameters = np.linspace(as_finite("start", start), as_finite("end", end), _samples(samples))
    points = _points(path, parameters)
    best, last = (0.0, 0, 0), 1
    for first in range(len(points) - 1):
        last = max(last, first + 1)
        while last + 1 < len(points) and _narrowest(points[first : last + 2])[0] <= width:
            last += 1
        angle = _narrowest(points[first : last + 1])[1]
        best = max(best, (float(np.ptp((points[first : last + 1] * np.exp(-1j * angle)).real)), first, last))
    length, first, last = best
    across, angle = _narrowest(points[first : last + 1])
    return PathPiece(
        start=float(parameters[first]),
        end=float(parameters[last]),
        length=length,
        band=across,
        direction=angle % math.pi,
    )


def _below(excess: Callable[[float], float], width: float) -> float | None:
    """A width that is not too large, found by halving; None if there is none above the roundings."""
    for _ in range(20):
        if excess(width) < 0:
            return width
        width /= 2
    return None


# --- points -----------------------------------------------------------------------------------------


def _samples(samples: int) -> int:
    if not isinstance(samples, int) or not 5 <= samples <= 1_000_000:
        raise LinkageError("samples must be a whole number from 5 to 1,000,000, not {samples!r}", samples=samples)
    return samples


def _points(path: Path, parameters: Reals) -> Complexes:
    points = np.asarray(path(parameters), np.complex128)
    if points.shape != parameters.shape:
        raise LinkageError(
            "a path gives one point for each parameter, but found {points} for {parameters}",
            points=points.shape,
            parameters=parameters.shape,
        )
    missing = np.flatnonzero(~np.isfinite(points))
    if len(missing):
        raise LinkageError("the path has no point at the parameter {parameter:.6g}", parameter=parameters[missing[0]])
    return points


def _tangent(path: Path, centre: float) -> float:
    """The direction of the path there, from differences of the eighth order."""
    slope = complex(_points(path, centre + _STENCIL_STEP * np.arange(-4.0, 5.0)) @ _STENCIL)
    return math.atan2(slope.imag, slope.real)


def _reach(values: Reals) -> float:
    """Largest less smallest value of a smooth function, by parabolas through the extreme samples."""
    return _peak(values) + _peak(-values)


def _peak(values: Reals) -> float:
    k = int(np.argmax(values))
    top = float(values[k])
    if not 0 < k < len(values) - 1:
        return top
    before, after = float(values[k - 1]), float(values[k + 1])
    bend = 2 * top - before - after
    return top + (after - before) ** 2 / (8 * bend) if bend > 0 else top


def _growing(both: Reals) -> Reals:
    """The range of values of windows that grow from the middle to both sides; (2, n) to (n,)."""
    largest = np.maximum.accumulate(both.max(axis=0))
    smallest = np.minimum.accumulate(both.min(axis=0))
    return np.asarray(largest - smallest)


def _narrowest(points: Complexes) -> tuple[float, float]:
    """The width of the narrowest strip that contains the points, and its direction: along an edge of their hull."""
    from scipy.spatial import ConvexHull, QhullError

    flat = np.column_stack([points.real, points.imag])
    try:
        hull = points[ConvexHull(flat).vertices]
    except QhullError:  # all on one line, or two points only
        chord = points[np.argmax(np.abs(points - points[0]))] - points[0]
        away = (points - points[0]) * np.exp(-1j * np.angle(chord))
        return float(np.ptp(away.imag)), float(np.angle(chord))
    edges = np.roll(hull, -1) - hull
    edges = edges[edges != 0]
    edges /= np.abs(edges)
    widths = np.ptp((np.conj(edges)[:, None] * hull).imag, axis=1)
    k = int(np.argmin(widths))
    return float(widths[k]), float(np.angle(edges[k]))
