"""`gruebler geneva`: figures and motion of a Geneva drive."""

from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from gruebler.cli.machine_pictures import add_picture_options, angle_of, write_picture
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.cli.turn_table import print_turn, records, turn_degrees
from gruebler.errors import GrueblerError
from gruebler.geneva import Geneva

__all__ = ["add", "run"]

# key: (English, German, unit)
_ROWS = {
    "crank_ratio": ("crank by distance of centres", "Kurbel durch Achsabstand", ""),
    "most_pins": ("pins that have room", "mögliche Treiberzahl", ""),
    "step_deg": ("step of the wheel", "Schrittwinkel des Rades", "°"),
    "engaged_deg": ("driver's angle for a step", "Treiberwinkel je Schritt", "°"),
    "motion_fraction": ("part of a turn in motion", "Bewegungsanteil einer Umdrehung", ""),
    "dwell_fraction": ("part of a turn in dwell", "Rastanteil einer Umdrehung", ""),
    "dwell_begin_deg": ("dwell from the driver's angle", "Rast vom Treiberwinkel", "°"),
    "dwell_end_deg": ("... to", "... bis", "°"),
    "greatest_ratio": ("greatest speed by driver's speed", "größte Drehzahl durch Antriebsdrehzahl", ""),
    "greatest_acceleration": ("greatest acceleration by speed²", "größte Beschleunigung durch Drehzahl²", ""),
    "greatest_acceleration_at_deg": ("... at the driver's angle ±", "... beim Treiberwinkel ±", "°"),
    "entry_acceleration": (
        "jump of acceleration at start and stop, by speed²",
        "Beschleunigungssprung bei Anfang und Ende, durch Drehzahl²",
        "",
    ),
    "crank": ("crank", "Kurbel", ""),
    "wheel": ("radius of the wheel at the slot's mouth", "Radradius am Schlitzanfang", ""),
    "slot_end": ("pin from the wheel's axis on the line of centres", "Zapfen von der Radachse auf der Mittenlinie", ""),
    "locking_arc_deg": ("locking arc of the driver", "Sperrbogen des Treibers", "°"),
    "greatest_speed": ("greatest speed of the wheel", "größte Drehzahl des Rades", ""),
    "greatest_acceleration_rad_s2": ("greatest acceleration", "größte Beschleunigung", " rad/s²"),
    "entry_acceleration_rad_s2": ("jump at start and stop", "Sprung bei Anfang und Ende", " rad/s²"),
    "dwell_s": ("time of a dwell", "Rastzeit", " s"),
    "step_s": ("time of a step", "Schrittzeit", " s"),
}
_TABLE = {
    "en": ("driver", "wheel", "ratio", "acceleration", "jerk", "dwell"),
    "de": ("Treiber", "Rad", "Übersetzung", "Beschleunigung", "Ruck", "Rast"),
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A Geneva drive with radial slots that the pins enter without a blow.",
        epilog="Examples: gruebler geneva 4 --distance 100 --speed 60 --step 15; gruebler geneva 6 --pins 2 --animate "
        "-o geneva.html. PNG, PDF, GIF and WebP need matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.add_argument("slots", type=int, metavar="N", help="number of slots, at least 3")
    parser.add_argument("--internal", action="store_true", help="the driver turns inside the wheel")
    parser.add_argument("--pins", type=int, default=1, metavar="K", help="pins on the driver (default: 1)")
    parser.add_argument("--distance", type=float, metavar="D", help="distance of the axes: lengths are told")
    parser.add_argument("--speed", type=float, metavar="RPM", help="of the driver, turns a minute: times are told")
    parser.add_argument("--step", type=float, metavar="DEG", help="a table of the driver's turn in such steps")
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.add_argument("--at", type=float, metavar="DEG", help="with -o: the driver's angle (default: 0)")
    parser.add_argument("--plot", action="store_true", help="with -o: angle, ratio and acceleration beneath")
    add_picture_options(parser, "a turn")


def run(arguments: argparse.Namespace) -> int:
    """Print the figures, and the motion over a turn of the driver if a step is given."""
    drive = Geneva(arguments.slots, arguments.internal, arguments.pins)
    figures = _figures(drive, arguments.distance, arguments.speed)
    table = _table(drive, arguments.step) if arguments.step is not None else None
    _picture(arguments, drive)
    if arguments.json:
        document: dict[str, Any] = {"slots": drive.slots, "internal": drive.internal, "pins": drive.pins, **figures}
        if table is not None:
            keys = ("driver_deg", "wheel_deg", *_TABLE["en"][2:])
            document["motion"] = records(keys, table)
        print_json(document)
        return 0
    german = arguments.lang == "de"
    rows = [(_ROWS[key][german], f"{value:.10g}{_ROWS[key][2]}") for key, value in figures.items()]
    print_table(("Größe", "Wert") if german else ("quantity", "value"), rows, numbers=(1,))
    if table is not None:
        print()
        rest = _TABLE[arguments.lang][-1]
        shown = [[*row[:5], rest if row[5] else ""] for row in table]
        print_turn(_TABLE[arguments.lang], shown, ("{:g}°", "{:.6f}°", "{:.6f}", "{:.6f}", "{:.6f}", "{}"))
    return 0


def _picture(arguments: argparse.Namespace, drive: Geneva) -> None:
    from gruebler.drawing.machines.geneva_picture import animate_geneva, draw_geneva

    at, plot, lang = angle_of(arguments), arguments.plot, arguments.lang
    write_picture(
        arguments,
        lambda: draw_geneva(drive, at or 0.0, plot=plot, lang=lang),
        lambda seconds: animate_geneva(drive, plot=plot, seconds=seconds, lang=lang),
    )


def _figures(drive: Geneva, distance: float | None, speed: float | None) -> dict[str, float]:
    found: dict[str, float] = {
        "crank_ratio": drive.crank_ratio,
        "most_pins": drive.most_pins,
        "step_deg": math.degrees(drive.step),
        "engaged_deg": math.degrees(2 * drive.engaged),
        "motion_fraction": drive.motion_fraction,
        "dwell_fraction": drive.dwell_fraction,
        "dwell_begin_deg": math.degrees(drive.engaged),
        "dwell_end_deg": math.degrees(math.tau / drive.pins - drive.engaged),
        "greatest_ratio": drive.greatest_ratio,
        "greatest_acceleration": drive.greatest_acceleration,
        "greatest_acceleration_at_deg": math.degrees(drive.greatest_acceleration_at),
        "entry_acceleration": drive.entry_acceleration,
    }
    if distance is not None:
        sizes = drive.sizes(distance)
        found |= {"crank": sizes.crank, "wheel": sizes.wheel, "slot_end": sizes.slot_end}
        found["locking_arc_deg"] = math.degrees(sizes.locking_arc)
    if speed is not None:
        if not 0 < abs(speed) < math.inf:
            raise GrueblerError("--speed: expected turns a minute that are not zero, not {speed:g}", speed=speed)
        omega = abs(speed) * math.tau / 60
        found["greatest_speed"] = speed * drive.greatest_ratio
        found["greatest_acceleration_rad_s2"] = omega**2 * drive.greatest_acceleration
        found["entry_acceleration_rad_s2"] = omega**2 * drive.entry_acceleration
        found["dwell_s"] = drive.dwell_fraction * math.tau / omega / drive.pins
        found["step_s"] = drive.motion_fraction * math.tau / omega / drive.pins
    return found


def _table(drive: Geneva, step: float) -> list[list[Any]]:
    driver = turn_degrees(step, closed=True)
    moved = drive.move(np.radians(driver))
    numbers = (np.degrees(moved.angle), moved.ratio, moved.acceleration, moved.jerk)
    plain = [(column + 0.0).tolist() for column in (driver, *numbers)]  # no minus before a zero
    return [list(row) for row in zip(*plain, moved.dwell.tolist(), strict=True)]
