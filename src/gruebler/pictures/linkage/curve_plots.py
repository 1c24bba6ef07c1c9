"""Plots in the plane: hodographs, coupler curves, and coupler curves of a family of points."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import decimal_sign_in, message, number_separator, translate
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.mechanics.linkages.points import PointLike, each_point, place_of
from gruebler.pictures.canvas.axes import Axis, Scale, axis_name, decimals, rate_unit
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.panels import Panel, PlottedCurve, PointMarker, draw_panels
from gruebler.pictures.canvas.shapes import Point
from gruebler.pictures.canvas.styles import LINES
from gruebler.pictures.linkage.piecewise_curves import Between, PlotRun, plot_run
from gruebler.pictures.linkage.posed_linkage import floating_link, link_nodes

_SQUARE = 460.0  # pixels of the longer side
_NEAR = 0.03  # of the field: the smallest distance of labelled drive values
_AROUND = 0.04  # of the field
_MOST = len(LINES)


@door_that_raises(LinkageError)
def hodograph(
    linkage: LinkageLike,
    points: Sequence[PointLike],
    *,
    speed: float | None = None,
    branch: Branch = None,
    between: Between = None,
    lang: str = "en",
    name: str = "",
) -> Figure:
    """The curves of the tips of velocity vectors, with drive values beside the first.

    Options as for `gruebler.plot`.

    Raises `LinkageError` for several drives, unknown points, none or more than eight.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> hodograph(FourBar(25, 70, 40, 70).linkage({"K": (35, 20)}), ["K"]).title
    'four-bar linkage: hodograph of K'
    """
    linkage = as_linkage(linkage, unit="")
    chosen = _few(points)
    if speed is not None and not (math.isfinite(speed) and speed):
        raise LinkageError(
            "a hodograph needs a drive that moves: expected a speed that is not 0, but found {speed}", speed=speed
        )
    run = plot_run(linkage, 1, branch, between, lang, name)
    places = [place_of(linkage, point) for point in chosen.values()]
    factor = 1.0 if speed is None else speed
    paths = [factor * run.motion.complex_point(place, order=1) for place in places]
    per = run.drive_unit if speed is None else "s"
    rate = (
        message("1")
        if speed is None
        else message("{speed:.6g} {unit}", speed=speed, unit=rate_unit(run.drive_unit, "s"))
    )
    symbols = ("x′", "y′") if speed is None else ("ẋ", "ẏ")
    axes = [axis_name(symbol, rate_unit(run.unit, per)) for symbol in symbols]
    names = list(chosen)
    ranges = [
        _joined([run.bulk(part) for part in parts]) for parts in zip(*((z.real, z.imag) for z in paths), strict=True)
    ]
    tips = factor * run.cycle.at(run.round_drives, 1).complex_point(places[0], order=1)
    spots = _tips(run, tips, _NEAR * max(high - low for low, high in ranges))
    panel = square_panel(
        paths, names if len(names) > 1 else [""], axes, [*spots, PointMarker(x=0.0, y=0.0, text="")], ranges=ranges
    )
    title = translate("{name}: hodograph of {points}", lang, name=run.name, points=", ".join(names))
    about = translate(
        "Tips of the velocity vectors of {points} put at one origin, {range}, with a speed of {speed}.",
        lang,
        points=", ".join(names),
        range=run.range,
        speed=rate,
    )
    return draw_panels([panel], title, about, lang)


def _tips(run: PlotRun, path: Complexes, near: float) -> list[PointMarker]:
    """Points at round drive values; of points near to each other only the first has a name."""
    spots: list[PointMarker] = []
    for drive, z in zip(run.round_drives, path, strict=True):
        if np.isfinite(z):
            named = [spot for spot in spots if spot.text]
            apart = all(math.hypot(spot.x - z.real, spot.y - z.imag) > near for spot in named)
            spots.append(PointMarker(x=z.real, y=z.imag, text=run.value(drive) if apart else ""))
    return spots


def _joined(ranges: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """The range that contains all of them, and 0."""
    return min(0.0, *(low for low, _ in ranges)), max(0.0, *(high for _, high in ranges))


@door_that_raises(LinkageError)
def coupler_plot(
    linkage: LinkageLike,
    points: Sequence[PointLike],
    *,
    branch: Branch = None,
    between: Between = None,
    lang: str = "en",
    name: str = "",
) -> Figure:
    """The paths of named points or joints over axes with the linkage's unit, with thin links in one pose.

    Arguments and errors as for `hodograph`.
    """
    linkage = as_linkage(linkage, unit="")
    places = {name: place_of(linkage, point) for name, point in _few(points).items()}
    return _paths(linkage, places, branch, between, lang, name)


@door_that_raises(LinkageError)
def family_plot(
    linkage: LinkageLike,
    link: str | None = None,
    *,
    start: complex | None = None,
    end: complex | None = None,
    count: int = 5,
    branch: Branch = None,
    between: Between = None,
    lang: str = "en",
    name: str = "",
) -> Figure:
    """The coupler curves of a family of points: evenly spaced on a line of one link.

    Options as for `gruebler.plot`; ``start`` and ``end`` as x + iy in coordinates of the link, by default on the line
    through its first two joints or points, half their distance beyond each.

    Raises `LinkageError` for several drives, an unknown link, or one without two joints where a line is needed.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> family_plot(FourBar(25, 70, 40, 70).linkage(), count=3).description[:36]
    'Paths of (−35, 0); (35, 0); (105, 0)'
    """
    linkage = as_linkage(linkage, unit="")
    return _paths(linkage, family_of(linkage, link, start, end, count, lang), branch, between, lang, name)


def family_of(
    linkage: Linkage, link: str | None, start: complex | None, end: complex | None, count: int, lang: str = "en"
) -> dict[str, LinkPoint]:
    """The points of a family, named by their coordinates in the link as the language writes them."""
    if not 2 <= count <= _MOST:
        raise LinkageError("a family has 2 to {most} points, not {count!r}", most=_MOST, count=count)
    chosen = floating_link(linkage) if link is None else link
    if chosen not in linkage.mechanism.chain.links:
        raise LinkageError(
            "there is no link {link!r}; the links are {links}",
            link=chosen,
            links=", ".join(linkage.mechanism.chain.links),
        )
    if chosen == linkage.mechanism.frame:
        raise LinkageError("{link!r} is the frame: its points do not move", link=chosen)
    places = link_nodes(linkage, chosen)
    if start is None or end is None:
        if len(places) < 2:
            raise LinkageError(
                "{link!r} has one joint and no point: say between which points the family lies", link=chosen
            )
        first, second = places[:2]
        start, end = (first - (second - first) / 2, second + (second - first) / 2)
    if not np.isfinite([start, end]).all() or start == end:
        raise LinkageError("expected two different finite points, but found {start} and {end}", start=start, end=end)
    points = [start + k / (count - 1) * (end - start) for k in range(count)]
    names = (
        number_separator(lang).join(decimal_sign_in(f"{value + 0.0:.4g}", lang) for value in (p.real, p.imag))
        for p in points
    )
    return {
        f"({name})".replace("-", "−"): LinkPoint(chosen, p.real, p.imag) for name, p in zip(names, points, strict=True)
    }


def _paths(
    linkage: Linkage, places: dict[str, LinkPoint], branch: Branch, between: Between, lang: str, name: str
) -> Figure:
    run = plot_run(linkage, 0, branch, between, lang, name)
    paths = [run.motion.complex_point(place) for place in places.values()]
    row = len(run.drives) // 6
    skeleton = _skeleton(run.motion, row, places.values())
    spots = [PointMarker(x=path[row].real, y=path[row].imag, text="") for path in paths]
    panel = square_panel(paths, list(places), [axis_name(axis, run.unit) for axis in "xy"], spots, skeleton)
    about = translate(
        "Paths of {points}, {range}; dots and thin lines show the pose at {at}.",
        lang,
        points="; ".join(decimal_sign_in(point, lang) for point in places),
        range=run.range,
        at=run.value(run.drives[row]),
    )
    return draw_panels([panel], translate("{name}: coupler curves", lang, name=run.name), about, lang)


def _skeleton(motion: Motion, row: int, places: Iterable[LinkPoint]) -> list[Complexes]:
    """The lines between the joints of every moving link in a pose, and from one of them to each point of the link."""
    lower = motion.lower_linkage
    lines = []
    for k, link in enumerate(lower.mechanism.chain.links):
        pins = list(dict.fromkeys(complex(e.x, e.y) for (_, owner), e in lower.elements.items() if owner == link))
        points = [complex(place.x, place.y) for place in places if place.link == link]
        if link != lower.mechanism.frame:
            pairs = [*combinations(pins, 2), *((pins[0], point) for point in points)]
            lines += [motion.places[0, row, k] + motion.turns[row, k] * np.array(pair) for pair in pairs]
    return lines


def square_panel(
    paths: Sequence[Complexes],
    names: Sequence[str],
    axes: Sequence[str],
    spots: Sequence[PointMarker],
    thin: Sequence[Complexes] = (),
    ranges: Sequence[tuple[float, float]] = (),
) -> Panel:
    """A panel of paths with the same scale on both axes; without ranges it contains everything."""
    if not ranges:
        everything = np.concatenate([*paths, *thin])
        ranges = [(float(np.nanmin(v)), float(np.nanmax(v))) for v in (everything.real, everything.imag)]
    longest = max(high - low for low, high in ranges) or 1.0
    wide = [(low - _AROUND * longest, high + _AROUND * longest) for low, high in ranges]
    longest *= 1 + 2 * _AROUND
    x, y = (_even(low, high, longest) for low, high in wide)
    curves = [PlottedCurve(x=line.real, y=line.imag, name="", style="ghost") for line in thin]
    curves += [
        PlottedCurve(x=z.real, y=z.imag, name=name, style=style)
        for z, name, style in zip(paths, names, LINES, strict=False)
    ]
    size = Point(*(_SQUARE / longest * (scale.high - scale.low) for scale in (x, y)))
    visible = tuple(spot for spot in spots if x.low <= spot.x <= x.high and y.low <= spot.y <= y.high)
    return Panel(across=Axis(axes[0], x), up=Axis(axes[1], y), curves=tuple(curves), spots=visible, size=size)


def _even(low: float, high: float, longest: float) -> Scale:
    """A tight scale whose step is that of the longer one."""
    few = max(1, round(8 * (high - low) / longest))
    scales = (decimals(low, high, few=most, tight=True) for most in (few, *range(2, 8)))
    return next((scale for scale in scales if len(scale.ticks) > 1), decimals(low, high, tight=True))


def _few(points: Sequence[PointLike]) -> dict[str, PointLike]:
    chosen = each_point(points)
    if not 1 <= len(chosen) <= _MOST:
        raise LinkageError("expected 1 to {most} points or joints, but found {count}", most=_MOST, count=len(chosen))
    return chosen
