"""`gruebler analyse`: what a linkage does: measures first, then a table of poses and rates."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Sequence
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gruebler.cli.analysis_table import Column, as_csv, columns, shown
from gruebler.cli.linkage_inputs import linkage_of
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError, LinkageError
from gruebler.kinematics import Motion, degrees, move
from gruebler.kinematics.branches import all_branches, read_branch
from gruebler.kinematics.moving import planned
from gruebler.kinematics.outputs import Output, find_output
from gruebler.kinematics.transmission import transmission_angle
from gruebler.linkages import Linkage
from gruebler.linkages.files import to_json

if TYPE_CHECKING:
    from gruebler.kinematics.measuring import Measures
    from gruebler.mechanism import Role

__all__ = ["run"]

Reals = NDArray[np.float64]

_MOST_ROWS = 1_000_000
_MOST_BRANCHES = 16
_STEP = 15.0  # degrees between the rows of a full turn
_WORDS = {
    "en": {
        "roles": "Roles: {roles}.",
        "branch": "Assembly mode: {branch}.",
        "others": "Other assembly modes there: {others}.",
        "mu": "transmission angle",
    },
    "de": {
        "roles": "Rollen: {roles}.",
        "branch": "Einbaulage: {branch}.",
        "others": "Andere Einbaulagen dort: {others}.",
        "mu": "Übertragungswinkel",
    },
}


def run(arguments: argparse.Namespace) -> int:
    """Measures and table; 1 if the linkage cannot be assembled, or not be moved all the way."""
    linkage, shown_range = linkage_of(arguments.linkage)
    turning = _turning(linkage)
    plan = planned(linkage)
    speed = _speed(arguments.speed, turning)
    outputs = [find_output(linkage, name) for name in arguments.output or linkage.outputs or [None]]
    for name in arguments.point:
        linkage.named(name)
    if arguments.branch is not None:
        read_branch(plan, arguments.branch)
    given = _given_rows(arguments.drive, arguments.at, turning)
    if len(turning) > 1:
        if given is None:
            raise GrueblerError(f"{len(turning)} drives: give --drive FROM:TO:STEP or --at once for each")
        motion = move(linkage, given, branch=arguments.branch, order=0)
        made = columns(motion, outputs, arguments.point) if len(motion) else []
        return _tell(linkage, None, motion, made, arguments)
    try:
        found = _measured(linkage, outputs[0], turning[0], arguments)
    except LinkageError as error:
        print(error)
        return 1
    rows = _default_rows(found, shown_range, turning[0]) if given is None else given
    motion, before = _moved(linkage, found, rows, arguments.branch)
    made = []
    if len(motion):
        angle = None if found.transmission is None else transmission_angle(motion, found.output.name)
        made = columns(motion, outputs, arguments.point, speed, angle, _WORDS[arguments.lang]["mu"])
    return _tell(linkage, found, motion, [column.without(before) for column in made], arguments)


# --- what was asked for ----------------------------------------------------------------------------


def _turning(linkage: Linkage) -> list[bool]:
    mechanism = linkage.mechanism
    if not mechanism.drives:
        raise GrueblerError(f"no joint is driven; name one in drives, such as {mechanism.chain.joint_names()[0]}")
    return [drive.direction.startswith("R") for drive in mechanism.drives]


def _speed(speed: float | None, turning: Sequence[bool]) -> float | None:
    """Of the drive, in radians a second, or lengths a second; given in revolutions a minute, or lengths a second."""
    if speed is None:
        return None
    if not math.isfinite(speed) or not 0 < abs(speed) < 1e12:
        raise GrueblerError(f"--speed: expected a number that is not 0, but found {speed:g}")
    if len(turning) > 1:
        raise GrueblerError("--speed is that of one drive; with several drives there are poses only")
    return speed * math.pi / 30 if turning[0] else speed


def _given_rows(spans: Sequence[str], at: Sequence[float], turning: Sequence[bool]) -> Reals | None:
    """(rows, drives) of --drive or --at; None if neither is given."""
    if not spans and not at:
        return None
    if spans and at:
        raise GrueblerError("--drive and --at do not go together")
    if len(spans or at) != len(turning):
        option = "--drive" if spans else "--at"
        raise GrueblerError(f"the linkage has {_drives(len(turning))}, but {option} was given {len(spans or at)} times")
    if at:
        if not all(math.isfinite(value) and abs(value) < 1e9 for value in at):
            raise GrueblerError(f"--at: expected a finite number below 1e9, but found {at[0]:g}")
        return np.array([[math.radians(v) if turns else v for v, turns in zip(at, turning, strict=True)]])
    ways = [_way(text, turns) for text, turns in zip(spans, turning, strict=True)]
    longest = max(map(len, ways))
    for text, way in zip(spans, ways, strict=True):
        if len(way) not in (1, longest):
            raise GrueblerError(f"--drive {text}: {len(way)} rows where another drive has {longest}")
    return np.column_stack([np.broadcast_to(way, longest) for way in ways])


def _drives(count: int) -> str:
    return f"{count} drive" if count == 1 else f"{count} drives"


def _way(text: str, turning: bool) -> Reals:
    try:
        start, stop, step = (float(part) for part in text.split(":")) if ":" in text else (float(text),) * 2 + (1.0,)
    except ValueError:
        raise GrueblerError(f"--drive: expected FROM:TO:STEP such as 0:360:15, but found {text!r}") from None
    if not all(math.isfinite(v) and abs(v) < 1e9 for v in (start, stop, step)) or not step:
        raise GrueblerError(f"--drive: expected finite numbers below 1e9 and a step other than 0, but found {text!r}")
    if abs((stop - start) / step) >= _MOST_ROWS:
        raise GrueblerError(f"--drive {text}: more than {_MOST_ROWS:,} rows")
    rows = degrees(start, stop, step)
    return rows if turning else np.degrees(rows)


def _default_rows(found: Measures, shown_range: tuple[float, float] | None, turning: bool) -> Reals:
    """A full turn by 15 degrees, or round numbers in the range."""
    span = found.span
    if shown_range is None and span.full:
        return degrees(0, 360 * span.turns, _STEP).reshape(-1, 1)
    scale = 180 / math.pi if turning else 1.0
    low, high = shown_range or (span.low * scale, span.high * scale)
    step = _round_step((high - low) / 20)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return np.array([[k * step / scale] for k in range(first, last + 1)])


def _round_step(step: float) -> float:
    """The next number of 1, 2, 5 times a power of ten.

    >>> _round_step(0.03), _round_step(3.4)
    (0.05, 5.0)
    """
    power = math.floor(math.log10(step))
    return next(float(f"{k}e{power}") for k in (1, 2, 5, 10) if k * 10.0**power >= step * (1 - 1e-9))


# --- what is found ---------------------------------------------------------------------------------


def _measured(linkage: Linkage, output: Output, turning: bool, arguments: argparse.Namespace) -> Measures:
    from gruebler.kinematics.measuring import measures

    return measures(linkage, arguments.speed if turning else None, arguments.branch, output.name)


def _moved(linkage: Linkage, found: Measures, rows: Reals, branch: str | None) -> tuple[Motion, int]:
    """The rows on the branch of the measures, reached from where these begin; else, if it can be, from the first row.

    Second comes how many rows at the beginning were not asked for.
    """
    motion = move(linkage, np.concatenate([[[found.start]], rows]), branch=found.branch, speed=1.0)
    return (motion, 1) if len(motion) > 1 else (move(linkage, rows, branch=branch, speed=1.0), 0)


def _others(linkage: Linkage, found: Measures) -> list[str]:
    branches = islice(all_branches(planned(linkage), np.array([found.start])), _MOST_BRANCHES)
    return [_label(branch) for branch in branches if branch != tuple(found.branch)]


def _label(branch: Sequence[str]) -> str:
    return "".join(branch) if set(branch) <= {"+", "-"} else ",".join(branch)


# --- what is said ----------------------------------------------------------------------------------


def _tell(
    linkage: Linkage, found: Measures | None, motion: Motion, made: Sequence[Column], arguments: argparse.Namespace
) -> int:
    if arguments.csv is not None:
        from gruebler.cli.draw import written

        written(arguments.csv, as_csv(made).encode("utf-8"))
    if arguments.json:
        print(
            json.dumps(
                _document(linkage, found, motion, made, arguments.lang), ensure_ascii=False, indent=2, allow_nan=False
            )
        )
    else:
        if found is not None:
            _say(linkage, found, _WORDS[arguments.lang], arguments.lang)
        if made and arguments.csv is None:
            print_table([column.header for column in made], shown(made), numbers=range(len(made)))
        if not motion.complete:
            print(motion.message(arguments.lang))
    return 0 if motion.complete else 1


def _say(linkage: Linkage, found: Measures, words: dict[str, str], lang: str) -> None:
    print(found.explain(lang))
    if roles := _roles(linkage, found):
        moving = (f"{link} = {role.said(lang)}" for link, role in roles.items() if link != linkage.mechanism.frame)
        print(words["roles"].format(roles=", ".join(moving)))
    if found.branch:
        print(words["branch"].format(branch=_label(found.branch)))
        if others := _others(linkage, found):
            print(words["others"].format(others=", ".join(others)))
    print()


def _roles(linkage: Linkage, found: Measures) -> dict[str, Role] | None:
    """What each link turns out to be; None where the measures begin in a place that no circuit can start from."""
    from gruebler.kinematics.turning import motion_roles

    try:
        return motion_roles(linkage, branch=found.branch)
    except LinkageError:
        return None


def _document(
    linkage: Linkage, found: Measures | None, motion: Motion, made: Sequence[Column], lang: str
) -> dict[str, Any]:
    document: dict[str, Any] = {"linkage": to_json(linkage)}
    if found is not None:
        document |= {"measures": found.to_json(), "other_branches": _others(linkage, found)}
        roles = _roles(linkage, found)
        document["roles"] = None if roles is None else {link: str(role) for link, role in roles.items()}
    rows = zip(*(column.values for column in made), strict=True)
    return document | {
        "columns": [{"name": column.name, "unit": column.unit} for column in made],
        "rows": [[float(value) if math.isfinite(value) else None for value in row] for row in rows],
        "complete": motion.complete,
        "message": motion.message(lang),
    }
