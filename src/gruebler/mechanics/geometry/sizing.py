"""How large a straight-line linkage has to be: its relative deviation over the window, and the size for a task."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.geometry.straight import Path, PathPiece, linkage_path, longest_piece, path_piece
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.points import PointLike, point_name
from gruebler.mechanics.linkages.quantities import as_finite, as_positive


@dataclass(frozen=True, slots=True)
class Window:
    """Parts of a path about a value of its parameter, growing to both ends in one ratio."""

    start: float
    centre: float
    end: float
    direction: float
    """Of the line, in radians."""

    @property
    def width(self) -> float:
        """Of the whole of it."""
        return self.end - self.start

    def ends(self, width: Any) -> tuple[Any, Any]:
        """Beginning and end of the part that is so wide; of parts, for an array."""
        part = width / self.width
        return self.centre - part * (self.centre - self.start), self.centre + part * (self.end - self.centre)


class RatioCurve(NamedTuple):
    """The relative deviation Q_G and the length over windows that grow; arrays (n,)."""

    widths: Reals
    """phi_G, growing, without 0."""
    starts: Reals
    """phi_A."""
    lengths: Reals
    ratios: Reals


@dataclass(frozen=True, slots=True)
class Sizing:
    """The size of a linkage for a task."""

    factor: float
    """By which all its lengths are multiplied."""
    piece: PathPiece
    """The piece of the path that is used, before that."""


def ratio_curve(path: Path, window: Window, samples: int = 721) -> RatioCurve:
    """Q_G and L over the windows of a path; error of the second order in the spacing where extremes lie inside.

    Raises `LinkageError` where the path has no points.

    >>> from gruebler.mechanics.geometry import coupler_path
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> lever = coupler_path(FourBar(20, 50, 50, 40), 100, 0)
    >>> curve = ratio_curve(lever, Window(np.pi / 2, np.pi, 3 * np.pi / 2, 0.0))
    >>> round(float(curve.lengths[-1]), 6), round(float(curve.ratios[-1]), 6)
    (80.0, 0.002438)
    """
    widths = np.linspace(0, window.width, samples)
    both = np.array([_points(path, end) for end in window.ends(widths)])
    seen = (both - both[0, 0]) * np.exp(-1j * window.direction)
    lengths, bands = (_growing(part)[1:] for part in (seen.real, seen.imag))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = np.where(lengths > 0, bands / lengths, np.inf)
    return RatioCurve(widths[1:], window.ends(widths[1:])[0], lengths, ratios)


def tangent_windows(
    linkage: Linkage,
    point: PointLike,
    centre: float,
    *,
    branch: Branch = None,
    ratios: tuple[float, float] = (1e-6, 0.02),
) -> RatioCurve:
    """Q_G and L over the windows about a crank angle, against the path's tangent there.

    Args:
        linkage: With one drive that turns.
        point: A named point, a joint or a point of a link.
        centre: The crank angle in radians.
        branch: The assembly mode.
        ratios: The least and the greatest Q_G of the windows.

    Raises `LinkageError` where the linkage cannot be moved all the way, and if fewer than two windows are so straight.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> lever = FourBar(20, 50, 50, 40).linkage({"K": (100, 0)})
    >>> curve = tangent_windows(lever, "K", np.pi)
    >>> bool((np.diff(curve.widths) > 0).all()), round(float(curve.ratios[-1]), 2)
    (True, 0.02)
    """
    least, most = ratios
    middle = move_quietly(linkage, [as_finite("centre", centre)], speed=1.0, branch=branch)
    if not len(middle):
        raise LinkageError("{reason}", reason=middle.reason)
    path = linkage_path(linkage, point, branch=branch)
    tangent = float(np.angle(middle.complex_point(point, order=1)[0]))
    width = 2 * np.pi
    for _ in range(2):  # first the range of the windows, then that range finely
        curve = ratio_curve(path, Window(centre - width / 2, centre, centre + width / 2, tangent))
        shown = (least <= curve.ratios) & (curve.ratios <= most)
        if np.count_nonzero(shown) < 2:
            raise LinkageError(
                "the path of {point} about {centre:g}° has no windows with Q_G from {least:g} to {most:g}",
                point=point_name(point),
                centre=np.degrees(centre),
                least=least,
                most=most,
            )
        width = min(1.01 * float(curve.widths[shown][-1]), width)
    return RatioCurve(*(values[shown] for values in curve))


def crank_length(linkage: Linkage) -> float:
    """The length of the driven link: from the driven joint to the next revolute joint on it.

    Raises `LinkageError` for a linkage without such a link, or with several drives.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> crank_length(FourBar(25, 70, 40, 70).linkage())
    25.0
    """
    drives = linkage.mechanism.drives
    if len(drives) == 1 and drives[0].turning:
        driven, link = drives[0].joint, linkage.reference(0)[1]
        for number, joint in enumerate(linkage.mechanism.chain.joints):
            if number != driven and link in joint.links and joint.pair.is_turning:
                length = linkage.length(link, driven, number)
                if length > 0:
                    return length
    raise LinkageError("expected a linkage with one drive, a crank with two revolute joints")


def _points(path: Path, parameters: Reals) -> Complexes:
    points = path(parameters)
    if not np.isfinite(points).all():
        raise LinkageError("the path has no point at {parameter:.6g}", parameter=parameters[~np.isfinite(points)][0])
    return points


def _growing(both: Reals) -> Reals:
    """The range of values of windows that grow from the middle to both sides; (2, n) to (n,)."""
    return np.asarray(np.maximum.accumulate(both.max(axis=0)) - np.minimum.accumulate(both.min(axis=0)))


def widest_piece(path: Path, window: Window, ratio: float, samples: int = 721) -> PathPiece:
    """The widest window whose relative deviation is at most the given one; the whole if all are.

    Raises `LinkageError` if not even the smallest is so straight.

    >>> from gruebler.mechanics.geometry import coupler_path
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> lever = coupler_path(FourBar(20, 50, 50, 40), 100, 0)
    >>> found = widest_piece(lever, Window(0, np.pi, 2 * np.pi, 0.0), 0.003)
    >>> round(float(np.degrees(found.start)), 2), round(found.length, 2)
    (73.46, 89.72)
    """
    wanted = as_positive("ratio", ratio)
    curve = ratio_curve(path, window, samples)
    good = np.flatnonzero(curve.ratios <= wanted)
    if not len(good):
        raise LinkageError("no window of the path has a relative deviation of {ratio:g} or less", ratio=ratio)
    last = int(good[-1])
    width = float(curve.widths[last])
    if last + 1 < len(curve.widths):
        from scipy.optimize import brentq

        def excess(wide: float) -> float:
            piece = path_piece(path, *window.ends(wide), window.direction)
            return piece.band - wanted * piece.length

        beyond = float(curve.widths[last + 1])
        if excess(width) < 0 < excess(beyond):
            width = float(brentq(excess, width, beyond, xtol=1e-14, rtol=1e-14))
    return path_piece(path, *window.ends(width), window.direction)


def longest_in_band(path: Path, start: float, end: float, band: float, samples: int = 181) -> PathPiece:
    """The longest piece in a band of any direction, its ends between the samples: `longest_piece`, refined.

    Every piece that begins near the best one of the samples is led on until it just fills the band, and the longest of
    them is sought. Error: of the second order in the spacing of the samples of `path_piece`, about 1e-6 of the band;
    the place of the piece is less sharp than its length, being that of a maximum. A piece at the end of the range
    stays.

    Raises `LinkageError` like `longest_piece`.

    >>> from gruebler.mechanics.geometry import coupler_path
    >>> from gruebler.mechanics.fourbar import InvertedSliderCrank
    >>> found = longest_in_band(coupler_path(InvertedSliderCrank(30, 50), 90, 0), 0.0, np.pi, 0.5)
    >>> round(found.length, 3), round(found.band, 6)
    (32.559, 0.5)
    """
    from scipy.optimize import brentq, minimize_scalar

    rough = longest_piece(path, start, end, band, samples)
    step = (end - start) / (samples - 1)

    def filled(begin: float, fine: int = 401) -> PathPiece | None:
        def excess(stop: float) -> float:
            return path_piece(path, begin, stop, samples=fine).band - band

        low, high = rough.end - 2 * step, min(rough.end + 3 * step, end)
        if not begin < low or excess(low) > 0 or excess(high) < 0:
            return None
        return path_piece(path, begin, float(brentq(excess, low, high, xtol=1e-10)), samples=fine)

    def shortness(begin: float) -> float:
        piece = filled(begin)
        return 0.0 if piece is None else -piece.length

    ends = max(rough.start - step, start), rough.start + step
    best = minimize_scalar(shortness, bounds=ends, method="bounded", options={"xatol": 1e-7})
    piece = filled(float(best.x), fine=2001)
    return rough if piece is None or piece.length < rough.length else piece


def scale_for(path: Path, window: Window, length: float, tolerance: float) -> Sizing:
    """The factor that makes a path straight within a tolerance over a length: the smallest linkage that does it.

    Both in one unit. Raises `LinkageError` like `widest_piece`.

    >>> from gruebler.mechanics.geometry import coupler_path
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> lenker = coupler_path(FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4), 8.018753738744802, 2.268046058132576)
    >>> round(scale_for(lenker, Window(0, np.pi, 2 * np.pi, np.radians(15.79316904826399)), 15, 0.075).factor, 4)
    3.8389
    """
    wanted = as_positive("length", length)
    piece = widest_piece(path, window, as_positive("tolerance", as_finite("tolerance", tolerance)) / wanted)
    return Sizing(wanted / piece.length, piece)
