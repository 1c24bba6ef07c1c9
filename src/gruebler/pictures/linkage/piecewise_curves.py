"""A linkage through the range of its drive, prepared for plots."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import translate
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.pictures.canvas.axes import Axis, angles, decimals
from gruebler.pictures.canvas.drive_axes import ROWS, bulk, drive_axis, drive_text
from gruebler.pictures.linkage.posed_linkage import drive_rows
from gruebler.pictures.structure.messages import title

Between = tuple[float, float] | None

_DOZEN = 12
_TINY = 1e-9  # of a period or range


@dataclass(frozen=True, kw_only=True)
class PlotRun:
    """Poses of a linkage with one drive, and the texts of the drive."""

    cycle: Course
    drives: Reals
    motion: Motion
    lang: str
    name: str
    """The name of the linkage."""

    @property
    def unit(self) -> str:
        """The unit of lengths."""
        return self.cycle.linkage.unit

    @property
    def drive_unit(self) -> str:
        """The unit of the drive in rates."""
        return "rad" if self.cycle.turning_drive else self.unit

    @cached_property
    def x(self) -> Reals:
        """The drive in degrees, or in the unit."""
        return np.degrees(self.drives) if self.cycle.turning_drive else self.drives

    @property
    def across(self) -> Axis:
        """The axis of the drive."""
        return drive_axis(self.x, self.cycle.turning_drive, self.unit)

    def within(self, drive: float) -> float | None:
        """The first value of the same position in the plotted range; None if there is none."""
        low, high = float(self.drives[0]), float(self.drives[-1])
        period = self.cycle.span.period
        value = drive + period * math.ceil((low - drive) / period - _TINY) if period < math.inf else drive
        slack = _TINY * (high - low)
        return min(max(value, low), high) if low - slack <= value <= high + slack else None

    def drive_in_units(self, drive: float) -> float:
        """A drive value in the unit of the axis."""
        return math.degrees(drive) if self.cycle.turning_drive else drive

    def value(self, drive: float) -> str:
        """A drive value as text."""
        return drive_text(self.drive_in_units(drive), self.cycle.turning_drive, self.unit, self.lang)

    @cached_property
    def round_drives(self) -> Reals:
        """About a dozen round drive values; for full turns without the last, which equals the first."""
        scale = angles if self.cycle.turning_drive else decimals
        ticks = scale(float(self.x.min()), float(self.x.max()), few=_DOZEN, tight=True).ticks
        inner = [tick for tick in ticks if not self.cycle.span.full or tick < self.x.max() - 1e-9]
        return np.radians(inner) if self.cycle.turning_drive else np.array(inner)

    def bulk(self, values: Reals) -> tuple[float, float]:
        """The range of values that is shown."""
        return bulk(values, self.drives, self.cycle.span.full)

    @property
    def range(self) -> str:
        """The range of the drive as text."""
        low, high = self.value(self.drives[0]), self.value(self.drives[-1])
        return translate("drive from {low} to {high}", self.lang, low=low, high=high)


def plot_run(linkage: LinkageLike, order: int, branch: Branch, between: Between, lang: str, name: str) -> PlotRun:
    """Poses over full turns from 0, else over the range, or its part between two values; rates for a drive of speed 1.

    Raises `LinkageError` for a linkage without a drive, or with several, or if nothing lies between the two values.
    """
    linkage = as_linkage(linkage, unit="")
    if not linkage.mechanism.drives:
        raise LinkageError("no joint is driven, so there is nothing to be plotted; name a drive")
    cycle = drive_cycle(linkage, branch=branch)
    drives = drive_rows(cycle, between, ROWS)
    if between is None and cycle.span.full:
        drives = drives - drives[0]
    return PlotRun(
        cycle=cycle, drives=drives, motion=cycle.at(drives, order), lang=lang, name=title(linkage.mechanism, lang, name)
    )
