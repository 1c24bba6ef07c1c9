"""The trial of one drawing: the ranges of its drives, its conditioning, and the look of the layout."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.design.realisation.layout_program import KernelLayout, LayoutProgram
from gruebler.design.realisation.measures import conditioning
from gruebler.mechanics.kinematics.kernel_calls import SolvedRows, run_rows

FLOOR = 0.1
"""A pose with a smaller measure does not count as within the range."""
_ROWS = 73
_WINDINGS = (1, 5, 7, 11, 13)
_SWINGS = (1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.08)
_STROKE = 0.3  # of the size, to either side: the search tries no longer stroke
_LENGTH, _GAP, _FRAME, _CROSSING = 0.15, 0.1, 0.4, 0.97


@dataclass(frozen=True, slots=True)
class LayoutTrial:
    """The quality of a drawing."""

    score: float
    """Higher is better: 1 and more if every drive turns fully, 0 if it does not move."""
    ranges: tuple[tuple[float, float], ...]
    """The range of each drive, relative to the drawn position."""
    full: bool
    """Whether every drive turns fully."""
    quality: float
    """The smallest measure in that range."""


_NOTHING = LayoutTrial(0.0, (), False, 0.0)


def try_layout(program: LayoutProgram, drawing: Reals, target_quality: float) -> LayoutTrial:
    """Move a drawing and evaluate it.

    Args:
        program: the layout program.
        drawing: (joints, 3).
        target_quality: the measure above which a higher one does not count.
    """
    beauty = _beauty(program, drawing)
    if beauty < 1e-3:
        return _NOTHING
    setting = program.setting(drawing)
    drives = program.mechanism.drives
    turning = all(drive.turning for drive in drives)
    if turning:
        around = ((0.0, 2 * np.pi),) * len(drives)
        quality = closed_path_quality(program, setting, range_path(around, full=True))
        if quality >= FLOOR:
            return LayoutTrial(1 + beauty * min(quality / target_quality, 1.0), around, True, quality)
    ranges, quality = _limited(program, setting) if len(drives) == 1 else _swinging(program, setting)
    if not ranges:
        return _NOTHING
    unit = [2 * np.pi if d.turning else 2 * _STROKE * setting.program.size for d in drives]
    share = min(min(1.0, (r[1] - r[0]) / u) for r, u in zip(ranges, unit, strict=True))
    return LayoutTrial(share * beauty * (0.5 + 0.5 * min(quality / target_quality, 1.0)), ranges, False, quality)


def range_path(ranges: tuple[tuple[float, float], ...], *, full: bool, rows: int = _ROWS) -> Reals:
    """A path through ranges of drives: (rows, drives).

    One drive moves from end to end. Several move at different speeds: fully turning ones around, others to and fro.
    """
    count = (rows - 1) * _WINDINGS[len(ranges) - 1] + 1
    parameter = np.linspace(0.0, 1.0, count)
    if len(ranges) == 1 or full:
        return np.stack([a + (b - a) * n * parameter for (a, b), n in zip(ranges, _WINDINGS, strict=False)], axis=1)
    waves = [np.sin(2 * np.pi * n * parameter) for n in _WINDINGS]
    return np.stack([(a + b) / 2 + (b - a) / 2 * wave for (a, b), wave in zip(ranges, waves, strict=False)], axis=1)


def _run(program: LayoutProgram, setting: KernelLayout, path: Reals) -> tuple[SolvedRows, Reals]:
    """The rows that are reached and their measures."""
    rows = run_rows(program.plan, path, None, setting.signs, setting.unknowns, setting.program)
    return rows, conditioning(program.plan, setting.program, rows.places[0], rows.turns, rows.roots)


def returns_to_start(places: NDArray[np.complex128], turns: NDArray[np.complex128], size: float) -> bool:
    """Whether the last pose equals the first: a larger group may return in another assembly mode."""
    return bool(abs(places[-1] - places[0]).max() < 1e-6 * size and abs(turns[-1] - turns[0]).max() < 1e-6)


def closed_path_quality(program: LayoutProgram, setting: KernelLayout, path: Reals) -> float:
    """The smallest measure on a closed path; 0 if it cannot be followed to its end or does not close."""
    rows = run_rows(program.plan, path, None, setting.signs, setting.unknowns, setting.program)
    if rows.reached < len(path) or not returns_to_start(rows.places[0], rows.turns, setting.program.size):
        return 0.0
    return float(conditioning(program.plan, setting.program, rows.places[0], rows.turns, rows.roots).min())


def _limited(program: LayoutProgram, setting: KernelLayout) -> tuple[tuple[tuple[float, float], ...], float]:
    """The range of one drive to both sides of the drawn position, and the smallest measure there."""
    turning = program.mechanism.drives[0].turning
    most = 2 * np.pi if turning else _STROKE * setting.program.size
    ends, worst = [], 1.0
    for side in (-most, most):
        path = np.linspace(0.0, side, _ROWS).reshape(-1, 1)
        _, measures = _run(program, setting, path)
        usable = len(measures) if (measures >= FLOOR).all() else int(np.argmax(measures < FLOOR))
        if usable < 2:
            return (), 0.0
        ends.append(float(path[usable - 1, 0]))
        worst = min(worst, float(measures[:usable].min()))
    if turning and ends[1] - ends[0] > 2 * np.pi:  # it does not close after one turn
        ends = [max(ends[0], -np.pi), min(ends[1], np.pi)]
    return ((ends[0], ends[1]),), worst


def _swinging(program: LayoutProgram, setting: KernelLayout) -> tuple[tuple[tuple[float, float], ...], float]:
    """The widest of some ranges about the drawn position through which all drives move at once."""
    for swing in _SWINGS:
        units = [np.pi if d.turning else setting.program.size / 2 for d in program.mechanism.drives]
        ranges = tuple((-swing * unit, swing * unit) for unit in units)
        quality = closed_path_quality(program, setting, range_path(ranges, full=False))
        if quality >= FLOOR:
            return ranges, quality
    return (), 0.0


def _beauty(program: LayoutProgram, drawing: Reals) -> float:
    """1 if no length is short, no joints are near each other, the frame is wide, and nothing crosses; else less."""
    z = drawing[:, 0] + 1j * drawing[:, 1]
    size = program.size(drawing)
    lengths = np.abs(z[program.pairs[:, 0]] - z[program.pairs[:, 1]])
    gaps = np.abs(z[:, None] - z[None, :])[program.apart]
    short = min(1.0, float(lengths.min(initial=np.inf)) / (_LENGTH * size))
    near = min(1.0, float(gaps.min(initial=np.inf)) / (_GAP * size))
    wide = min(1.0, program.frame_width(drawing) / (_FRAME * size))
    return float(short * near**0.5 * wide**0.5 * _CROSSING ** _crossed(z, program.crossings))


def _crossed(z: NDArray[np.complex128], quads: NDArray[np.int64]) -> int:
    """The number of pairs of segments that cross."""
    a, b, c, d = z[quads].T

    def side(p: NDArray[np.complex128], q: NDArray[np.complex128], r: NDArray[np.complex128]) -> Reals:
        orientation: Reals = ((q - p).conj() * (r - p)).imag
        return orientation

    return int(np.count_nonzero((side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)))
