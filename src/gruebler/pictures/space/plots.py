"""Diagrams of linkages in space over their drive."""

from __future__ import annotations

from math import ceil, degrees, floor, tau

import numpy as np

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import translate
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space.drive_ranges import followed
from gruebler.mechanics.space.measuring import SpatialMeasures, measures
from gruebler.mechanics.space.motion_tables import spatial_table
from gruebler.mechanics.space.outputs import output_freedom
from gruebler.pictures.canvas.axes import Axis, angles, axis_name, decimals
from gruebler.pictures.canvas.drive_axes import ROWS, bulk, drive_axis, drive_text, order_words
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.panels import AxisMarker, Panel, PlottedCurve, draw_panels
from gruebler.pictures.canvas.shapes import Point
from gruebler.pictures.canvas.styles import LINES
from gruebler.pictures.structure.messages import title
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Freedom

_LOW = Point(520.0, 190.0)
_NOISE = 1e-9  # of the largest value of a joint's rates: smaller ones are shown as 0


@door_that_raises(LinkageError)
def plot_spatial(
    linkage: SpatialLinkage,
    output: str | None = None,
    *,
    drive: str | None = None,
    between: tuple[float, float] | None = None,
    lang: str = "en",
    name: str = "",
) -> Figure:
    """The output and its first and second derivative over the drive, one below the other, with dead centres.

    Of several drives one moves, and the others stay at 0; dead centres are not marked then.

    The values are those of `gruebler.mechanics.space.motion_tables.spatial_table`, 0 in the reference pose.

    Options as for `gruebler.plot`; without ``between`` a turn, or the range of the only drive.

    Raises `LinkageError` for a joint without values, drive values that cannot be reached, slides among several drives
    without values between which they move.

    >>> from gruebler.mechanics.space import Bennett
    >>> plot_spatial(Bennett(2, 1, 0.5).linkage(), name="Bennett").title
    'Bennett: transfer functions of R(3-0)'
    """
    mechanism = linkage.mechanism
    moving = _moving_drive(linkage, drive)
    turning = mechanism.drives[moving].turning
    measured = measures(linkage, output=output) if len(mechanism.drives) == 1 else None
    number, freedom = output_freedom(linkage, output)
    turns = Freedom(freedom).turns
    if measured is not None and between is None:
        row = measured.rows(ROWS + 1)[:, 0]
    elif between is None and not turning:
        raise LinkageError(
            "{drive} slides: of several drives it needs values between which it moves",
            drive=mechanism.drive_names()[moving],
        )
    else:
        row = np.linspace(*(between or (0.0, tau)), ROWS + 1)
    alone = np.eye(len(mechanism.drives))[moving]
    motion = followed(linkage, row[:, None] * alone, order=2, speed=alone)
    names = mechanism.chain.joint_names()
    columns = spatial_table(motion, (names[number],), (), by_drive=True, lang=lang).columns[len(alone) :]
    x = np.degrees(row) if turning else row
    marks = [] if measured is None else _dead_centres(measured, float(row.min()), float(row.max()), lang)
    full = measured.range.full if measured is not None else turning
    panels = []
    for order, column in enumerate(columns):
        values = np.asarray(column.values, float)
        values = np.where(abs(values) < _NOISE * max(abs(columns[1].values).max(), 1.0), 0.0, values)
        scale = angles if turns and not order else decimals
        panels.append(
            Panel(
                across=drive_axis(x, turning, linkage.unit),
                up=Axis(
                    order_words(turns, turning, linkage.unit, order),
                    scale(*bulk(values, row, full), few=6),
                ),
                curves=(PlottedCurve(x=x, y=values, name="", style=LINES[0]),),
                marks=tuple(AxisMarker(each.x, "" if order else each.text) for each in marks),
                size=_LOW,
                marked=translate("dead centre", lang),
            )
        )
    called = mechanism.chain.joint_names(Alphabet.of_language(lang))[number]
    heading = translate(
        "{name}: transfer functions of {output}", lang, name=title(mechanism, lang, name), output=called
    )
    ends = [drive_text(float(end), turning, linkage.unit, lang) for end in x[[0, -1]]]
    about = translate(
        "Output {output} and its first and second derivative over the drive, {range}.",
        lang,
        range=translate("drive from {low} to {high}", lang, low=ends[0], high=ends[1]),
        output=called,
    )
    values_said = ", ".join(mark.text for mark in marks)
    said = " " + translate("Dead centres at {values}.", lang, values=values_said) if marks else ""
    return draw_panels(panels, heading, about + said, lang)


def plot_point(
    linkage: SpatialLinkage, point: str, between: tuple[float, float], *, lang: str = "en", name: str = ""
) -> Figure:
    """The three coordinates of a named point over the first drive (radians, or a length); others stay at 0.

    Raises `LinkageError` for drive values that cannot be reached.
    """
    turning = linkage.mechanism.drives[0].turning
    row = np.linspace(*between, ROWS + 1)
    places = followed(linkage, row[:, None] * np.eye(len(linkage.mechanism.drives))[0]).point(point)
    x = np.degrees(row) if turning else row
    panel = Panel(
        across=drive_axis(x, turning, linkage.unit),
        up=Axis(
            axis_name("x, y, z", linkage.unit), decimals(*bulk(places.ravel(), np.tile(row, 3), full=False), few=6)
        ),
        curves=tuple(PlottedCurve(x=x, y=places[:, k], name="xyz"[k], style=LINES[k]) for k in range(3)),
    )
    heading = translate("{name}: coordinates of {point}", lang, name=title(linkage.mechanism, lang, name), point=point)
    return draw_panels([panel], heading, heading, lang)


def _moving_drive(linkage: SpatialLinkage, drive: str | None) -> int:
    """The place of a joint among the drives; `LinkageError` if there are none or it is not driven."""
    mechanism = linkage.mechanism
    if not mechanism.drives:
        raise LinkageError("a diagram over the drive needs a driven joint, but the mechanism has none")
    if drive is None:
        return 0
    joint = mechanism.chain.joint_number(drive, error=LinkageError)
    driven = [k for k, each in enumerate(mechanism.drives) if each.joint == joint]
    if not driven:
        raise LinkageError("{joint} is not driven", joint=drive)
    return driven[0]


def _dead_centres(measured: SpatialMeasures, low: float, high: float, lang: str) -> list[AxisMarker]:
    """Those between two values of the drive; of a drive that turns fully they come again with every turn."""
    linkage, marks = measured.linkage, []
    turning = linkage.mechanism.drives[0].turning
    for centre in measured.dead_centres:
        laps = range(floor((low - centre.drive) / tau), ceil((high - centre.drive) / tau) + 1)
        for drive in (centre.drive + tau * lap for lap in (laps if measured.range.full else (0,))):
            if low <= drive <= high:
                x = degrees(drive) if turning else drive
                marks.append(AxisMarker(x, drive_text(x, turning, linkage.unit, lang)))
    return sorted(marks, key=lambda mark: mark.x)
