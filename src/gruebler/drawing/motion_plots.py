"""Plots over the drive: transfer functions of order 0, 1, 2, and the transmission angle."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gruebler.drawing.axes import Axis, angles, decimals
from gruebler.drawing.figure import Figure, Point
from gruebler.drawing.plot_runs import Between, Branch, PlotRun, plot_run
from gruebler.drawing.plots import Band, Curve, Mark, Panel, Spot, plotted
from gruebler.drawing.styles import LINES
from gruebler.kinematics import transmission_angle
from gruebler.kinematics.events import dead_centres, natural
from gruebler.kinematics.outputs import Output, find_output
from gruebler.kinematics.transmission import measure_transmission
from gruebler.linkages import Linkage

__all__ = ["transfer_plot", "transmission_plot"]

Reals = NDArray[np.float64]

_GOOD = 40.0  # degrees: the least transmission angle that is usual
_LOW = Point(520.0, 190.0)  # panels of which there are three
_NOISE = 1e-6  # of the usual size of a derivative: smaller values are none
_WORDS = {
    "en": {
        "transfer": "{name}: transfer functions of {output}",
        "transfer_about": "Output {output} and its first and second derivative over the drive, {range}.",
        "transmission": "{name}: transmission angle of {output}",
        "transmission_about": "Transmission angle over the drive, {range}. Smallest {mu:.2f}° at {at}; shaded below "
        "40°.",
        "dead": "Dead centres at {values}.",
    },
    "de": {
        "transfer": "{name}: Übertragungsfunktionen von {output}",
        "transfer_about": "Abtrieb {output} und seine erste und zweite Ableitung über dem Antrieb, {range}.",
        "transmission": "{name}: Übertragungswinkel von {output}",
        "transmission_about": "Übertragungswinkel über dem Antrieb, {range}. Kleinster {mu:.2f}° bei {at}; unter 40° "
        "getönt.",
        "dead": "Totlagen bei {values}.",
    },
}


def transfer_plot(
    linkage: Linkage,
    output: str | None = None,
    *,
    branch: Branch = None,
    between: Between = None,
    lang: str = "en",
    name: str = "",
) -> Figure:
    """The transfer functions of order 0, 1 and 2 over the drive, one below the other, with the dead centres.

    Args:
        linkage: with one drive.
        output: a link or sliding joint; the linkage's own output without it.
        branch: the assembly mode, as for `gruebler.kinematics.move`.
        between: drive values between which it is plotted (radians, or a way), if not the whole range.
        lang: ``en`` or ``de``.
        name: of the linkage, if it is not to be found out.

    Raises `LinkageError` for several drives or an unknown output.

    >>> from gruebler.linkages import FourBar
    >>> transfer_plot(FourBar(25, 70, 40, 70).linkage()).title
    'four-bar linkage: transfer functions of rocker'
    """
    run = plot_run(linkage, 2, branch, between, lang, name)
    found, words = find_output(linkage, output), _WORDS[lang]
    marks = _dead(run, found)
    panels = []
    for order in range(3):
        values = found.track(run.motion, order)
        if found.turning and order == 0:
            values = np.degrees(values)
        if order:
            values = np.where(np.abs(values) < _least(run, found, order), 0.0, values)
        scale = angles if found.turning and order == 0 else decimals
        axis = Axis(_order_words(run, found, order), scale(*run.bulk(values), few=6))
        shown = marks if order == 0 else tuple(mark._replace(words="") for mark in marks)
        panels.append(Panel(run.across, axis, (Curve(run.x, values, "", LINES[0]),), marks=shown, size=_LOW))
    about = words["transfer_about"].format(range=run.range, output=found.name)
    if marks:
        about += " " + words["dead"].format(values=", ".join(mark.words for mark in marks))
    return plotted(panels, words["transfer"].format(name=run.name, output=found.name), about)


def _order_words(run: PlotRun, output: Output, order: int) -> str:
    """What a transfer function is called, with its unit."""
    letter, over = "ψ" if output.turning else "s", "φ" if run.course.turning_drive else "s₁"
    if order == 0:
        return f"{letter} in {'°' if output.turning else run.unit}"
    mark = ("", "", "²")[order]
    units = {
        (True, True): "",
        (True, False): f"rad/{run.unit}{mark}",
        (False, True): f"{run.unit}/rad{mark}",
        (False, False): "" if order == 1 else f"1/{run.unit}",
    }
    unit = units[output.turning, run.course.turning_drive]
    words = f"{letter}{'′' * order} = d{mark}{letter}/d{over}{mark}"
    return f"{words} in {unit}" if unit else words


def _least(run: PlotRun, output: Output, order: int) -> float:
    """The size of a derivative that is rounding only."""
    by = 1.0 if run.course.turning_drive else run.course.plan.lower.size ** (order - 1)
    return _NOISE * natural(run.course, output) / by


def _dead(run: PlotRun, output: Output) -> tuple[Mark, ...]:
    """The dead centres within what is plotted."""
    drives = [run.within(centre.drive) for centre in dead_centres(run.course, output)]
    shown = sorted(drive for drive in drives if drive is not None)
    return tuple(Mark(run.shown(drive), run.value(drive)) for drive in shown)


def transmission_plot(
    linkage: Linkage,
    output: str | None = None,
    *,
    branch: Branch = None,
    between: Between = None,
    lang: str = "en",
    name: str = "",
) -> Figure:
    """The transmission angle over the drive, with the band below 40 degrees, its smallest value and the dead centres.

    Arguments and errors as for `transfer_plot`; `LinkageError` also where there is no transmission angle.

    >>> from gruebler.linkages import FourBar
    >>> transmission_plot(FourBar(2, 5, 4, 5).linkage()).description[-72:]
    'Smallest 36.87° at 0°; shaded below 40°. Dead centres at 34.05°, 233.1°.'
    """
    run = plot_run(linkage, 2, branch, between, lang, name)
    found, words = find_output(linkage, output), _WORDS[lang]
    values = np.degrees(transmission_angle(run.motion, found.name))
    smallest = measure_transmission(run.course, found).smallest
    least, at = math.degrees(smallest.mu), run.within(smallest.drive)
    if at is None:
        row = int(values.argmin())
        least, at = float(values[row]), float(run.drives[row])
    panel = Panel(
        run.across,
        Axis("μ in °", decimals(0.0, 90.0, few=9)),
        (Curve(run.x, values, "", LINES[0]),),
        bands=(Band(0.0, _GOOD, "μ < 40°"),),
        marks=_dead(run, found),
        spots=(Spot(run.shown(at), least, f"μ_min = {least:.1f}°"),),
    )
    about = words["transmission_about"].format(range=run.range, mu=least, at=run.value(at))
    if panel.marks:
        about += " " + words["dead"].format(values=", ".join(mark.words for mark in panel.marks))
    return plotted([panel], words["transmission"].format(name=run.name, output=found.name), about)
