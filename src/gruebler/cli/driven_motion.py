"""The motion that commands on forces show: through the drive values that are given, else through the whole range."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gruebler.base.errors import GrueblerError
from gruebler.cli.drive_rows import given_rows, turning_drives
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.table import default_rows
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage

_FROM_LIMITS = 1e-9  # of the range: a row at a limit of the drive is taken so far inside


def driven_motion(
    linkage: Linkage,
    shown_range: tuple[float, float] | None,
    *,
    spans: Sequence[str],
    at: Sequence[str] = (),
    branch: str | None = None,
    grid: bool = False,
) -> Motion:
    """The motion, with first derivatives, through --range or --at, else through the range in which it is shown.

    Several ranges are passed side by side, as a grid in all combinations.
    """
    turning = turning_drives(linkage)
    rows = given_rows(spans, at, linkage.mechanism, grid=grid)
    if rows is None and len(turning) > 1:
        raise GrueblerError("{count} drives: give --range FROM:TO:STEP once for each, or --at", count=len(turning))
    if rows is not None:
        return move_quietly(linkage, rows, branch=branch, order=1)
    cycle = drive_cycle(linkage, branch=branch)
    values = default_rows(cycle.span, shown_range, turning[0])[:, 0]
    if not cycle.span.full:
        margin = _FROM_LIMITS * cycle.span.width
        values = np.clip(values, cycle.span.low + margin, cycle.span.high - margin)
    return cycle.at(values, 1)
