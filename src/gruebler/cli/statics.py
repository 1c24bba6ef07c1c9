"""`gruebler statics`: drive torque and joint forces of a linkage under loads."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gruebler.analysis.drive_cycle import drive_cycle
from gruebler.cli.analysis_table import Column, as_csv, check_csv, shown
from gruebler.cli.drive_rows import default_rows, given_rows, turning_drives
from gruebler.cli.linkage_inputs import linkage_of
from gruebler.cli.output import print_json, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.point_inputs import point_of
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.forces import Loads, Statics, slide_friction, statics
from gruebler.kinematics import Motion, move
from gruebler.linkages import Linkage

__all__ = ["add", "run"]

_FROM_LIMITS = 1e-9  # of the range: a row at a limit of the drive is taken so far inside
_NOISE = 1e-13  # of the loads: a smaller effort is none
_WORDS = {
    "en": {
        "torque": "torque {name}",
        "force": "force {name}",
        "work": "{name} by virtual work",
        "joint": "force of {joint} on {link}",
        "couple": "moment of {joint} on {link}",
        "side": "side force {joint}",
        "friction": "friction {joint}",
        "effort": "with friction {name}",
        "none": "Nothing acts: give --load, --moment or --mass.",
        "most": "Largest effort, without friction: {name} = {value:.6g} {unit} at {drive}.",
        "idle": "The drive carries nothing: {name} = 0.",
        "agree": "Equilibrium and virtual work agree to {part:.1e} of the largest load.",
    },
    "de": {
        "torque": "Antriebsmoment {name}",
        "force": "Antriebskraft {name}",
        "work": "{name} (virtuelle Arbeit)",
        "joint": "Kraft von {joint} auf {link}",
        "couple": "Moment von {joint} auf {link}",
        "side": "Normalkraft {joint}",
        "friction": "Reibkraft {joint}",
        "effort": "{name} mit Reibung",
        "none": "Es wirkt nichts: --load, --moment oder --mass angeben.",
        "most": "Größtwert ohne Reibung: {name} = {value:.6g} {unit} bei {drive}.",
        "idle": "Der Antrieb trägt nichts: {name} = 0.",
        "agree": "Gleichgewicht und virtuelle Arbeit stimmen auf {part:.1e} der größten Last überein.",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="What the drive and the joints carry when forces act at points and moments on links: equilibrium "
        "of every link, and the drive's torque once more by virtual work. Torques are in force times the unit of the "
        "linkage. Without inertia; friction of slides as an estimate.",
        epilog="Example: gruebler statics slider-crank:20,50 --load 'R(coupler-slider)=-100,0' --friction 0.1. "
        "Exit status: 0 all well, 1 it cannot be moved all the way or is not held in some pose, 2 wrong usage or "
        "unreadable input.",
    )
    parser.add_argument(
        "linkage", metavar="FILE|ID|LENGTHS", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    parser.add_argument(
        "--load",
        action="append",
        default=[],
        metavar="POINT=FX,FY",
        help="a force at a point, a joint or LINK:X,Y; repeatable",
    )
    parser.add_argument(
        "--moment", action="append", default=[], metavar="LINK=M", help="a moment on a link, left about; repeatable"
    )
    parser.add_argument(
        "--mass", action="append", default=[], metavar="POINT=M", help="a mass that weighs M times 9.80665; repeatable"
    )
    parser.add_argument("--gravity", metavar="GX,GY", help="other than 0,-9.80665")
    parser.add_argument("--friction", type=float, metavar="MU", help="coefficient: friction of slides, an estimate")
    parser.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="rows, in degrees or the unit; for several drives once each (default: a full turn, or the whole range)",
    )
    parser.add_argument("--at", action="append", type=float, default=[], metavar="VALUE", help="one row only")
    parser.add_argument("--branch", metavar="B", help="the assembly mode, such as + or +-; write --branch=- for minus")
    parser.add_argument("--json", action="store_true", help="an object with columns and rows, forces by components")
    parser.add_argument("-o", dest="csv", type=Path, metavar="FILE", help="the columns as CSV, units in its header")


def run(arguments: argparse.Namespace) -> int:
    """A table over the rows, or all forces of one row; 1 if it stops or is not held somewhere."""
    check_csv(arguments.csv)
    linkage, shown_range = linkage_of(arguments.linkage)
    turning, words = turning_drives(linkage), _WORDS[arguments.lang]
    loads = _loads(arguments)
    if not (loads.forces or loads.moments or loads.masses):
        raise GrueblerError(words["none"])
    motion = _motion(linkage, shown_range, turning, arguments)
    if not len(motion):
        print(motion.message(arguments.lang))
        return 1
    held = statics(motion, loads)
    columns = _columns(held, arguments.friction, words)
    if arguments.csv is not None:
        write_file(arguments.csv, as_csv([*columns, *_components(held, words)]).encode("utf-8"), arguments.lang)
    if arguments.json:
        print_json(_document(held, [*columns, *_components(held, words)], arguments.lang))
    elif arguments.csv is None:
        _say(held, columns, words, arguments.lang)
    return 0 if motion.complete and not held.singular.any() else 1


# --- what was asked for ----------------------------------------------------------------------------


def _loads(arguments: argparse.Namespace) -> Loads:
    forces, moments, masses = (
        _added(option, given, count)
        for option, given, count in (
            ("--load", arguments.load, 2),
            ("--moment", arguments.moment, 1),
            ("--mass", arguments.mass, 1),
        )
    )
    if arguments.gravity is None:
        return Loads(forces, moments, masses)
    x, y = _numbers("--gravity", arguments.gravity, 2)
    return Loads(forces, moments, masses, (x, y))


def _added(option: str, given: Sequence[str], count: int) -> dict[Any, ArrayLike]:
    """What is given for each name; several times the same name add up."""
    out: dict[Any, ArrayLike] = {}
    for text in given:
        name, numbers = _named(option, text, count)
        key = name if option == "--moment" else point_of(name)
        out[key] = np.add(out.get(key, 0.0), numbers)
    return out


def _named(option: str, text: str, count: int) -> tuple[str, list[float] | float]:
    name, equals, values = text.rpartition("=")
    if not equals or not name:
        wanted = "POINT=FX,FY or LINK:X,Y=FX,FY" if count == 2 else "NAME=NUMBER"
        raise GrueblerError(
            "{option}: expected {wanted}, but found {text_!r}", option=option, wanted=wanted, text_=text
        )
    numbers = _numbers(option, values, count)
    return name.strip(), numbers if count > 1 else numbers[0]


def _numbers(option: str, text: str, count: int) -> list[float]:
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise GrueblerError(
            "{option}: expected {value}, but found {text_!r}",
            option=option,
            value="two numbers X,Y" if count == 2 else "a number",
            text_=text,
        )
    return numbers


def _motion(
    linkage: Linkage, shown_range: tuple[float, float] | None, turning: Sequence[bool], arguments: argparse.Namespace
) -> Motion:
    rows = given_rows(arguments.drive, arguments.at, turning)
    if rows is None and len(turning) > 1:
        raise GrueblerError("{count} drives: give --drive FROM:TO:STEP or --at once for each", count=len(turning))
    if rows is not None:
        return move(linkage, rows, branch=arguments.branch, order=1)
    cycle = drive_cycle(linkage, arguments.branch)
    values = default_rows(cycle.span, shown_range, turning[0])[:, 0]
    if not cycle.span.full:
        margin = _FROM_LIMITS * cycle.span.width
        values = np.clip(values, cycle.span.low + margin, cycle.span.high - margin)
    return cycle.at(values, 1)


# --- what is said ----------------------------------------------------------------------------------


def _columns(statics: Statics, coefficient: float | None, words: dict[str, str]) -> list[Column]:
    """Drive values, their efforts, the sizes of joint forces, friction of slides."""
    linkage, motion = statics.motion.linkage, statics.motion
    mechanism = linkage.mechanism
    out, efforts = [], []
    for k, (name, drive) in enumerate(zip(mechanism.drive_names(), mechanism.drives, strict=True)):
        turns = drive.turning
        values = motion.drives[:, k]
        out.append(Column(name, "°", np.degrees(values)) if turns else Column(name, linkage.unit, values))
        effort = words["torque" if turns else "force"].format(name=name)
        work = np.where(np.abs(statics.work[:, k]) <= _NOISE * statics.load[k], 0.0, statics.work[:, k])
        efforts.append(Column(effort, f"N·{linkage.unit}" if turns else "N", work))
    out += efforts
    names, largest = mechanism.chain.joint_names(), _largest_force(statics)
    for number, joint in enumerate(mechanism.chain.joints):
        links = joint.links[1:] if len(joint.links) > 2 else [_moving(joint.links, mechanism.frame)]
        for link in links:
            size = np.hypot(*statics.force(number, link).T)
            out.append(Column(words["joint"].format(joint=names[number], link=link), "N", size, largest))
    for number, joint in enumerate(mechanism.chain.joints if coefficient is not None else ()):
        if joint.pair.name in ("prismatic", "roll_slide"):
            assert coefficient is not None
            found = slide_friction(statics, number, coefficient)
            out.append(Column(words["friction"].format(joint=names[number]), "N", found.friction, largest))
            more = words["effort"].format(name=efforts[0].name)
            out.append(Column(more, efforts[0].unit, efforts[0].values + found.effort))
    return out


def _largest_force(statics: Statics) -> float:
    """The largest force of a joint over all rows: what rounding leaves of other forces is as small against it."""
    joints = enumerate(statics.motion.linkage.mechanism.chain.joints)
    sizes = [np.abs(statics.force(number, link)) for number, joint in joints for link in joint.links]
    return max(float(np.where(np.isfinite(size), size, 0.0).max(initial=0.0)) for size in sizes)


def _components(held: Statics, words: dict[str, str], once: bool = False) -> list[Column]:
    """The forces of all joints on all their links, and the moments of slides; ``once``: no reactions."""
    mechanism, unit = held.motion.linkage.mechanism, held.motion.linkage.unit
    out, largest = [], _largest_force(held)
    for number, (joint, name) in enumerate(zip(mechanism.chain.joints, mechanism.chain.joint_names(), strict=True)):
        for link in (_moving(joint.links, mechanism.frame),) if once and len(joint.links) == 2 else joint.links:
            said = words["joint"].format(joint=name, link=link)
            force = held.force(number, link)
            out += [Column(f"{said} {axis}", "N", force[:, k], largest) for k, axis in enumerate("xy")]
            if joint.pair.name in ("prismatic", "double_slide"):
                moment = words["couple"].format(joint=name, link=link)
                out.append(Column(moment, f"N·{unit}", held.couple(number, link), largest * held.motion.linkage.size))
    return out


def _moving(links: Sequence[str], frame: str) -> str:
    return next(link for link in reversed(links) if link != frame)


def _say(statics: Statics, made: list[Column], words: dict[str, str], lang: str) -> None:
    motion, drives = statics.motion, len(statics.motion.linkage.mechanism.drives)
    if len(motion) > 1:
        for column in made[drives : 2 * drives]:
            if np.isfinite(column.values).any():
                row = int(np.nanargmax(np.abs(column.values)))
                key = "most" if column.values[row] else "idle"
                at = f"{made[0].values[row]:.6g}{'' if made[0].unit == '°' else ' '}{made[0].unit}"
                print(words[key].format(name=column.name, value=column.values[row], unit=column.unit, drive=at))
    if math.isfinite(statics.disagreement):
        print(words["agree"].format(part=statics.disagreement))
    if len(motion) > 1 or math.isfinite(statics.disagreement):
        print()
    if len(motion) > 1:
        print_table([column.header for column in made], shown(made), numbers=range(len(made)))
    else:
        every = [*made, *_components(statics, words, once=True)]
        print_table(
            ["", "", ""], [[c.name, value, c.unit] for c, value in zip(every, shown(every)[0], strict=True)], [1]
        )
    for message in (motion.message(lang), statics.message(lang)):
        if message:
            print(message)


def _document(statics: Statics, made: list[Column], lang: str) -> dict[str, object]:
    rows = zip(*(column.values for column in made), strict=True)
    return {
        "columns": [{"name": column.name, "unit": column.unit} for column in made],
        "rows": [[float(value) if math.isfinite(value) else None for value in row] for row in rows],
        "disagreement": statics.disagreement if math.isfinite(statics.disagreement) else None,
        "singular": [int(row) for row in np.flatnonzero(statics.singular)],
        "complete": statics.motion.complete,
        "message": " ".join(filter(None, (statics.motion.message(lang), statics.message(lang)))),
    }
