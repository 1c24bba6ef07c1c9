"""Drive values as commands are given them: --range FROM:TO:STEP, --at VALUE[,VALUE], or the whole range."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.kinematics import from_degrees
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.mechanism import Mechanism

_MOST_ROWS = 1_000_000
_LARGEST = 1e9


def turning_drives(linkage: Linkage | SpatialLinkage) -> list[bool]:
    """Which drives turn; the others slide. `GrueblerError` for a linkage without drives."""
    return _turning(linkage.mechanism)


def _turning(mechanism: Mechanism) -> list[bool]:
    if not mechanism.drives:
        raise GrueblerError(
            "no joint is driven; name one in drives, such as {joint}", joint=mechanism.chain.joint_names()[0]
        )
    return [drive.turning for drive in mechanism.drives]


def given_rows(spans: Sequence[str], at: Sequence[str], mechanism: Mechanism, *, grid: bool = False) -> Reals | None:
    """(rows, drives) of --range, or of --at, a row each; None if neither is given.

    The drives are taken in their order in the file.

    Several drives go through their ranges side by side; as a grid in all combinations, to and fro.
    """
    if not spans and not at:
        return None
    if spans and at:
        raise GrueblerError("--range and --at do not go together")
    turning = _turning(mechanism)
    if at:
        if len(at) == len(turning) > 1 and not any("," in text for text in at):
            raise GrueblerError(
                "one --at gives the values of all drives: --at {values}", values=",".join(text.strip() for text in at)
            )
        return np.array([pose_of(text, mechanism) for text in at])
    if len(spans) != len(turning):
        raise GrueblerError(
            "expected --range once for each drive, in the order {drives}, but it was given {times}"
            if len(turning) > 1
            else "the linkage has one drive, {drives}, but --range was given {times}",
            drives=titles_of_drives(mechanism),
            times=times(len(spans)),
        )
    paths = [_path(text, turns) for text, turns in zip(spans, turning, strict=True)]
    if grid:
        return _combined(paths)
    longest = max(map(len, paths))
    for text, path in zip(spans, paths, strict=True):
        if len(path) not in (1, longest):
            raise GrueblerError(
                "--range {text}: {count} rows where another drive has {longest}",
                text=text,
                count=len(path),
                longest=longest,
            )
    return np.column_stack([np.broadcast_to(path, longest) for path in paths])


def _combined(paths: Sequence[Reals]) -> Reals:
    """All combinations, of which one drive alone moves from each to the next."""
    count = math.prod(map(len, paths))
    if count > _MOST_ROWS:
        raise GrueblerError("--range: {count:,} combinations are more than {most:,}", count=count, most=_MOST_ROWS)
    rows = np.zeros((1, 0))
    for path in paths:
        columns = [path if k % 2 == 0 else path[::-1] for k in range(len(rows))]
        rows = np.column_stack([np.repeat(rows, len(path), axis=0), np.concatenate(columns)])
    return rows


def given_speeds(given: Sequence[float], turning: Sequence[bool], *, from_rest: bool = False) -> list[float]:
    """Of --speed for each drive: radians a second, or lengths a second; given in revolutions a minute, or lengths.

    A single drive has no speed 0, unless it starts from rest.
    """
    if given and len(given) != len(turning):
        raise GrueblerError(
            "expected --speed once for each drive, {drives}, but found it {count}",
            drives=times(len(turning)),
            count=times(len(given)),
        )
    for speed in given:
        if not math.isfinite(speed) or not abs(speed) < 1e12 or (speed == 0 and len(given) == 1 and not from_rest):
            raise GrueblerError("--speed: expected a number that is not 0, but found {speed:g}", speed=speed)
    return [speed * math.pi / 30 if turns else speed for speed, turns in zip(given, turning, strict=bool(given))]


def driven_path(spans: Sequence[str], linkage: Linkage | SpatialLinkage) -> Reals | None:
    """(rows, drives) of --range for a command that follows a straight path; None for the whole motion of one drive."""
    turning = turning_drives(linkage)
    if not spans and len(turning) > 1:
        raise GrueblerError(
            "the linkage has {count} drives: give --range FROM:TO:STEP once for each, in the order {drives}; a single "
            "number keeps a drive at rest",
            count=len(turning),
            drives=titles_of_drives(linkage.mechanism),
        )
    return given_rows(spans, (), linkage.mechanism)


def pose_of(text: str, mechanism: Mechanism) -> list[float]:
    """The drive values of --at, in radians where the drive turns."""
    turning = [drive.turning for drive in mechanism.drives]
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != len(turning) or not all(math.isfinite(value) and abs(value) < _LARGEST for value in values):
        several = message(
            "{count} finite numbers separated by commas, for {drives},",
            count=len(turning),
            drives=titles_of_drives(mechanism),
        )
        raise GrueblerError(
            "--at: expected {numbers} below 1e9, degrees where a drive turns, but found {found!r}",
            numbers=message("one finite number") if len(turning) == 1 else several,
            found=text,
        )
    return [math.radians(value) if turns else value for value, turns in zip(values, turning, strict=True)]


def titles_of_drives(mechanism: Mechanism) -> Message:
    """The driven joints in the order in which their values are given."""
    return joined(mechanism.chain.joint_title(drive.joint) for drive in mechanism.drives)


def times(count: int) -> Message:
    """How often."""
    return message("once") if count == 1 else message("{count} times", count=count)


def _path(text: str, turning: bool) -> Reals:
    try:
        start, stop, step = (float(part) for part in text.split(":")) if ":" in text else (float(text),) * 2 + (1.0,)
    except ValueError:
        raise GrueblerError("--range: expected FROM:TO:STEP such as 0:360:15, but found {text!r}", text=text) from None
    if not all(math.isfinite(v) and abs(v) < _LARGEST for v in (start, stop, step)) or not step:
        raise GrueblerError(
            "--range: expected finite numbers below 1e9 and a step other than 0, but found {text!r}", text=text
        )
    if abs((stop - start) / step) >= _MOST_ROWS:
        raise GrueblerError("--range {text}: more than {most:,} rows", text=text, most=_MOST_ROWS)
    rows = from_degrees(start, stop, step)
    return rows if turning else np.degrees(rows)
