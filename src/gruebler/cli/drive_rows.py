"""Rows of drive values as commands are given them: --drive FROM:TO:STEP, --at VALUE, or the whole range."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gruebler.arrays import Reals
from gruebler.cli.parser import Parser
from gruebler.errors import GrueblerError
from gruebler.kinematics import from_degrees
from gruebler.linkages import Linkage

if TYPE_CHECKING:
    from gruebler.analysis.drive_cycle import CycleSpan

__all__ = ["add_drive_path", "default_rows", "driven_path", "given_rows", "turning_drives"]


_MOST_ROWS = 1_000_000
_STEP = 15.0  # degrees between the rows of a full turn


def add_drive_path(command: Parser) -> None:
    """The option for a path of the drives."""
    command.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="a straight path of the drives, in degrees or the unit, for several drives once each with as many steps; "
        "one number holds a drive still (default: the whole motion of one drive)",
    )


def turning_drives(linkage: Linkage) -> list[bool]:
    """Which drives turn; the others slide. `GrueblerError` for a linkage without drives."""
    mechanism = linkage.mechanism
    if not mechanism.drives:
        raise GrueblerError(
            "no joint is driven; name one in drives, such as {joint_names}",
            joint_names=mechanism.chain.joint_names()[0],
        )
    return [drive.turning for drive in mechanism.drives]


def given_rows(spans: Sequence[str], at: Sequence[float], turning: Sequence[bool]) -> Reals | None:
    """(rows, drives) of --drive or --at; None if neither is given."""
    if not spans and not at:
        return None
    if spans and at:
        raise GrueblerError("--drive and --at do not go together")
    if len(spans or at) != len(turning):
        option = "--drive" if spans else "--at"
        raise GrueblerError(
            "the linkage has {drives}, but {option} was given {count} times",
            drives=_drives(len(turning)),
            option=option,
            count=len(spans or at),
        )
    if at:
        if not all(math.isfinite(value) and abs(value) < 1e9 for value in at):
            raise GrueblerError("--at: expected a finite number below 1e9, but found {at:g}", at=at[0])
        return np.array([[math.radians(v) if turns else v for v, turns in zip(at, turning, strict=True)]])
    ways = [_way(text, turns) for text, turns in zip(spans, turning, strict=True)]
    longest = max(map(len, ways))
    for text, way in zip(spans, ways, strict=True):
        if len(way) not in (1, longest):
            raise GrueblerError(
                "--drive {text_}: {count} rows where another drive has {longest}",
                text_=text,
                count=len(way),
                longest=longest,
            )
    return np.column_stack([np.broadcast_to(way, longest) for way in ways])


def driven_path(spans: Sequence[str], linkage: Linkage) -> Reals | None:
    """(rows, drives) of --drive for a command that follows a straight path; None for the whole motion of one drive."""
    turning = turning_drives(linkage)
    if not spans and len(turning) > 1:
        raise GrueblerError(
            "the linkage has {drives}: give --drive FROM:TO:STEP once for each; one number holds a drive still",
            drives=_drives(len(turning)),
        )
    return given_rows(spans, (), turning)


def _drives(count: int) -> str:
    return f"{count} drive" if count == 1 else f"{count} drives"


def _way(text: str, turning: bool) -> Reals:
    try:
        start, stop, step = (float(part) for part in text.split(":")) if ":" in text else (float(text),) * 2 + (1.0,)
    except ValueError:
        raise GrueblerError(
            "--drive: expected FROM:TO:STEP such as 0:360:15, but found {text_!r}", text_=text
        ) from None
    if not all(math.isfinite(v) and abs(v) < 1e9 for v in (start, stop, step)) or not step:
        raise GrueblerError(
            "--drive: expected finite numbers below 1e9 and a step other than 0, but found {text_!r}", text_=text
        )
    if abs((stop - start) / step) >= _MOST_ROWS:
        raise GrueblerError("--drive {text_}: more than {most_rows:,} rows", text_=text, most_rows=_MOST_ROWS)
    rows = from_degrees(start, stop, step)
    return rows if turning else np.degrees(rows)


def default_rows(span: CycleSpan, shown_range: tuple[float, float] | None, turning: bool) -> Reals:
    """A full turn by 15 degrees, or round numbers in the range; (rows, 1)."""
    if shown_range is None and span.full:
        return from_degrees(0, 360 * span.turns, _STEP).reshape(-1, 1)
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
