"""Plots over the drive: transfer functions of order 0, 1, 2, and the transmission angle."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from math import degrees

import numpy as np

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.events import GOOD
from gruebler.base.text import translate
from gruebler.mechanics.analysis import transmission_angle
from gruebler.mechanics.analysis.events import natural_speed, stops
from gruebler.mechanics.analysis.outputs import Output, find_output
from gruebler.mechanics.analysis.transmission import measure_transmission
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.pictures.canvas.axes import Axis, angles, decimals
from gruebler.pictures.canvas.drive_axes import order_words
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.panels import AxisMarker, Band, DwellMarker, Panel, PlottedCurve, PointMarker, draw_panels
from gruebler.pictures.canvas.shapes import Point
from gruebler.pictures.canvas.styles import LINES
from gruebler.pictures.linkage.piecewise_curves import Between, PlotRun, plot_run

_LOW = Point(520.0, 190.0)  # panels of which there are three
_NOISE = 1e-6  # of the usual size of an output or its derivative: smaller values count as zero


@door_that_raises(LinkageError)
def transfer_plot(
    linkage: LinkageLike,
    output: str | None = None,
    *,
    branch: Branch = None,
    between: Between = None,
    lang: str = "en",
    name: str = "",
    names: Mapping[str, str] | None = None,
) -> Figure:
    """The transfer functions of order 0, 1 and 2 over the drive, one below the other, with dead centres and dwells.

    Options as for `gruebler.plot`.

    Raises `LinkageError` for several drives, an unknown output, the frame, and if the linkage's own output moves
    without turning.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> transfer_plot(FourBar(25, 70, 40, 70).linkage()).title
    'four-bar linkage: transfer functions of rocker'
    """
    linkage = as_linkage(linkage, unit="")
    run = plot_run(linkage, 2, branch, between, lang, name)
    output_quantity = find_output(linkage, output)
    _check(run, output_quantity, output)
    called = (names or {}).get(output_quantity.name, output_quantity.name)
    marks, dwells = _stops(run, output_quantity)
    panels = []
    for order in range(3):
        values = output_quantity.values(run.motion, order)
        if order == 0 and np.ptp(values) < _least(run, output_quantity, 1):
            values = np.full_like(values, values.mean())
        if output_quantity.turning and order == 0:
            values = np.degrees(values)
        values = np.where(np.abs(values) < _least(run, output_quantity, max(order, 1)), 0.0, values)
        scale = angles if output_quantity.turning and order == 0 else decimals
        words = order_words(output_quantity.turning, run.cycle.turning_drive, run.unit, order)
        axis = Axis(words, scale(*run.bulk(values), few=6))
        shown = marks if order == 0 else tuple(replace(mark, text="") for mark in marks)
        curves = (PlottedCurve(x=run.x, y=values, name="", style=LINES[0]),)
        named = dwells if order == 0 else tuple(replace(dwell, text="") for dwell in dwells)
        panels.append(
            Panel(
                across=run.across,
                up=axis,
                curves=curves,
                marks=shown,
                dwells=named,
                size=_LOW,
                marked=translate("dead centre", lang),
            )
        )
    title = translate("{name}: transfer functions of {output}", lang, name=run.name, output=called)
    about = translate(
        "Output {output} and its first and second derivative over the drive, {range}.",
        lang,
        range=run.range,
        output=called,
    )
    return draw_panels(panels, title, about + _described(run, marks, dwells), lang)


def _check(run: PlotRun, output: Output, requested: str | None) -> None:
    """Raise `LinkageError` for an output without a transfer function: the frame, or a link that does not turn."""
    linkage = run.cycle.linkage
    frame = linkage.mechanism.frame
    moving = [link for link in linkage.mechanism.chain.links if link != frame]
    outputs = {link: find_output(linkage, link) for link in moving}
    sizes = {link: 1.0 if outputs[link].turning else run.cycle.size for link in moving}
    still = {link: np.ptp(outputs[link].values(run.motion, 0)) < _NOISE * sizes[link] for link in moving}
    others = ", ".join(link for link in moving if not still[link])
    if output.link == frame:
        raise LinkageError("the frame does not move: name another output, such as {others}", others=others)
    if requested is None and output.turning and still[output.link]:
        raise LinkageError(
            "the output {name} moves without turning, so it has no transfer function of an angle; name "
            "another output: {others}",
            name=output.name,
            others=others,
        )


def _described(run: PlotRun, marks: tuple[AxisMarker, ...], dwells: tuple[DwellMarker, ...]) -> str:
    """The dead centres and dwells as text."""
    values = ", ".join(dict.fromkeys(mark.text for mark in marks if mark.text))
    centres = " " + translate("Dead centres at {values}.", run.lang, values=values) if values else ""
    to = math.radians if run.cycle.turning_drive else float
    ranges = ", ".join(f"{run.value(to(dwell.low))} – {run.value(to(dwell.high))}" for dwell in dwells)
    return centres + (" " + translate("Dwells, shaded: {values}.", run.lang, values=ranges) if ranges else "")


def _least(run: PlotRun, output: Output, order: int) -> float:
    """The size of a derivative below which it is rounding error."""
    by = run.cycle.drive_size ** (order - 1)
    return _NOISE * natural_speed(run.cycle, output) / by


def _stops(run: PlotRun, output: Output) -> tuple[tuple[AxisMarker, ...], tuple[DwellMarker, ...]]:
    """The dead centres and the dwells within the plotted range."""
    centres, intervals = stops(run.cycle, output)
    drives = [run.within(centre.drive) for centre in centres]
    shown = sorted(drive for drive in drives if drive is not None)
    low, high, period = float(run.drives[0]), float(run.drives[-1]), run.cycle.span.period
    again = [drive + period for drive in shown if drive + period <= high + 1e-9 * period]
    marks = [AxisMarker(run.drive_in_units(drive), run.value(drive)) for drive in shown]
    marks += [AxisMarker(run.drive_in_units(drive), "") for drive in again]
    dwells = []
    for dwell in intervals:
        laps = range(math.floor((low - dwell.end) / period), math.ceil((high - dwell.begin) / period) + 1)
        for lap in laps if period < math.inf else (0,):
            shift = lap * period if lap else 0.0
            begin, end = max(low, dwell.begin + shift), min(high, dwell.end + shift)
            if end - begin > 1e-9 * (high - low):
                dwells.append(
                    DwellMarker(run.drive_in_units(begin), run.drive_in_units(end), translate("dwell", run.lang))
                )
    return tuple(marks), tuple(sorted(dwells, key=lambda dwell: dwell.low))


@door_that_raises(LinkageError)
def transmission_plot(
    linkage: LinkageLike,
    output: str | None = None,
    *,
    branch: Branch = None,
    between: Between = None,
    lang: str = "en",
    name: str = "",
    names: Mapping[str, str] | None = None,
) -> Figure:
    """The transmission angle over the drive, with the band below 40 degrees, its smallest value and the dead centres.

    Arguments and errors as for `transfer_plot`; `LinkageError` also where there is no transmission angle.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> transmission_plot(FourBar(2, 5, 4, 5).linkage()).description[-72:]
    'Smallest 36.87° at 0°; shaded below 40°. Dead centres at 34.05°, 233.1°.'
    """
    linkage = as_linkage(linkage, unit="")
    run = plot_run(linkage, 2, branch, between, lang, name)
    output_quantity = find_output(linkage, output)
    called = (names or {}).get(output_quantity.name, output_quantity.name)
    values = np.degrees(transmission_angle(run.motion, output_quantity.name))
    smallest = measure_transmission(run.cycle, output_quantity).smallest
    least, at = math.degrees(smallest.mu), run.within(smallest.drive)
    if at is None:
        row = int(values.argmin())
        least, at = float(values[row]), float(run.drives[row])
    marks, dwells = _stops(run, output_quantity)
    panel = Panel(
        across=run.across,
        up=Axis("μ in °", decimals(0.0, 90.0, few=9)),
        curves=(PlottedCurve(x=run.x, y=values, name="", style=LINES[0]),),
        bands=(Band(0.0, degrees(GOOD), "μ < 40°"),),
        marks=marks,
        dwells=dwells,
        spots=(PointMarker(x=run.drive_in_units(at), y=least, text=f"μ_min = {least:.1f}°"),),
        marked=translate("dead centre", lang),
    )
    title = translate("{name}: transmission angle of {output}", lang, name=run.name, output=called)
    about = translate(
        "Transmission angle over the drive, {range}. Smallest {mu:.2f}° at {at}; shaded below 40°.",
        lang,
        range=run.range,
        mu=least,
        at=run.value(at),
    )
    return draw_panels([panel], title, about + _described(run, marks, dwells), lang)
