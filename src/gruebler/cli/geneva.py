"""`gruebler geneva`: figures and motion of a Geneva drive."""

from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, message, number
from gruebler.cli.machine_pictures import add_picture_options, angle_of, write_machine_picture
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.cli.turn_table import print_turn, records, turn_degrees
from gruebler.machines.geneva import Geneva

_ROWS = {
    "crank_ratio": (message("crank radius / centre distance"), ""),
    "most_pins": (message("largest number of pins"), ""),
    "step_deg": (message("step angle of the wheel"), "°"),
    "engaged_deg": (message("driver angle per step"), "°"),
    "moving_deg": (message("driver angle in motion, in a turn"), "°"),
    "motion_fraction": (message("motion as a fraction of a turn"), ""),
    "dwell_fraction": (message("dwell as a fraction of a turn"), ""),
    "motion_ratio": (message("time in motion / time in dwell"), ""),
    "dwell_begin_deg": (message("dwell from driver angle"), "°"),
    "dwell_end_deg": (message("dwell to driver angle"), "°"),
    "greatest_ratio": (message("greatest wheel speed / driver speed"), ""),
    "greatest_acceleration": (message("greatest angular acceleration, α_max/ω²"), ""),
    "greatest_acceleration_at_deg": (message("greatest angular acceleration at driver angle ±"), "°"),
    "entry_acceleration": (message("jump of the angular acceleration at start and stop, Δα/ω²"), ""),
    "crank": (message("crank radius"), ""),
    "wheel": (message("wheel radius at the slot's mouth"), ""),
    "slot_end": (message("distance of the pin from the wheel's axis in the middle of a step"), ""),
    "locking_arc_deg": (message("locking arc of the driver"), "°"),
    "greatest_speed": (message("greatest wheel speed"), " 1/min"),
    "greatest_acceleration_rad_s2": (message("greatest angular acceleration"), " rad/s²"),
    "entry_acceleration_rad_s2": (message("jump of the angular acceleration at start and stop"), " rad/s²"),
    "dwell_s": (message("dwell time"), " s"),
    "step_s": (message("step time"), " s"),
}
_KEYS = ("driver_deg", "wheel_deg", "ratio", "acceleration", "jerk", "dwell")
_DWELL = message("dwell")
_TABLE = (message("driver"), message("wheel"), message("ratio"), "α/ω²", "dα/dt/ω³", _DWELL)


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A Geneva drive with radial slots that the pins enter without impact.",
        epilog="Examples: gruebler geneva 4 --distance 100 --speed 60 --step 15; gruebler geneva 6 --pins 2 --animate "
        "-o geneva.html. PNG, PDF, GIF and WebP need matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.take(
        """
        slots N int  number of slots, at least 3
        --internal  the driver turns inside the wheel
        --pins K int =1  number of pins on the driver (default: 1)
        --distance D float  distance of the axes: adds the lengths
        --speed RPM float  driver speed in turns per minute: adds the times
        --step DEG float  also a table over the driver's turn with this step
        """
    )
    parser.add_printed(help="print an object with all figures", pictures=True)
    parser.take(
        """
        --at DEG float  with -o: the driver angle shown (default: 0)
        --plot  with -o: add diagrams of angle, ratio and acceleration
        """
    )
    add_picture_options(parser, help="with --animate: seconds for a turn (default: 4)")


def run(arguments: argparse.Namespace) -> int:
    """Print the figures, and the motion over a turn of the driver if a step is given."""
    drive = Geneva(arguments.slots, internal=arguments.internal, pins=arguments.pins)
    figures = _figures(drive, arguments.distance, arguments.speed)
    table = _table(drive, arguments.step) if arguments.step is not None else None
    _picture(arguments, drive)
    if arguments.json:
        document = plain(drive, "slots internal pins") | figures
        if table is not None:
            document["motion"] = records(_KEYS, table)
        print_json(document)
        return 0
    rows = [
        (_ROWS[key][0], number(value, arguments.lang, "n") + _ROWS[key][1])
        for key, value in figures.items()
        if value < math.inf
    ]
    print_table((message("quantity"), message("value")), rows, numbers=(1,), lang=arguments.lang)
    if table is not None:
        print()
        shown = [[*row[:5], _DWELL if row[5] else Message("")] for row in table]
        formats = (("n", "°"), ("n", "°"), ("n", ""), ("n", ""), ("n", ""), ("", ""))
        print_turn(_TABLE, shown, formats, arguments.lang)
    return 0


def _picture(arguments: argparse.Namespace, drive: Geneva) -> None:
    from gruebler.pictures.machines.geneva_picture import animate_geneva, draw_geneva

    at, plot, lang = angle_of(arguments), arguments.plot, arguments.lang
    write_machine_picture(
        arguments,
        lambda: draw_geneva(drive, at=at or 0.0, plot=plot, lang=lang),
        lambda seconds: animate_geneva(drive, plot=plot, seconds=seconds, lang=lang),
    )


def _figures(drive: Geneva, distance: float | None, speed: float | None) -> dict[str, float]:
    figures: dict[str, float] = {
        **plain(drive, "crank_ratio most_pins step_deg"),
        "engaged_deg": math.degrees(2 * drive.engaged),
        "moving_deg": math.degrees(drive.motion_fraction * math.tau),
        **plain(drive, "motion_fraction dwell_fraction motion_ratio"),
        "dwell_begin_deg": math.degrees(drive.engaged),
        "dwell_end_deg": math.degrees(math.tau / drive.pins - drive.engaged),
        **plain(drive, "greatest_ratio greatest_acceleration greatest_acceleration_at_deg entry_acceleration"),
    }
    if distance is not None:
        sizes = drive.sizes(distance)
        figures |= plain(sizes, "crank wheel slot_end locking_arc_deg")
    if speed is not None:
        if not 0 < abs(speed) < math.inf:
            raise GrueblerError("--speed: expected turns per minute other than zero, but found {speed:g}", speed=speed)
        omega = abs(speed) * math.tau / 60
        figures["greatest_speed"] = speed * drive.greatest_ratio
        figures["greatest_acceleration_rad_s2"] = omega**2 * drive.greatest_acceleration
        figures["entry_acceleration_rad_s2"] = omega**2 * drive.entry_acceleration
        figures["dwell_s"] = drive.dwell_fraction * math.tau / omega / drive.pins
        figures["step_s"] = drive.motion_fraction * math.tau / omega / drive.pins
    return figures


def _table(drive: Geneva, step: float) -> list[list[Any]]:
    driver = turn_degrees(step, closed=True)
    moved = drive.move(np.radians(driver))
    numbers = (np.degrees(moved.angle), moved.ratio, moved.acceleration, moved.jerk)
    plain = [(column + 0.0).tolist() for column in (driver, *numbers)]  # no minus before a zero
    return [list(row) for row in zip(*plain, moved.dwell.tolist(), strict=True)]
