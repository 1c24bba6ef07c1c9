"""The kernel run over rows of drive values: rows put in where it needs them, rests and turning points taken apart."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Integers, Reals
from gruebler.mechanics.kinematics.kernel_records import PoseBuffer, Program
from gruebler.mechanics.kinematics.plan import Plan

_AT_IT = 1e-12  # of the size: a row so near to the shortest way of a slide is there
_PASSED = 1e-9  # of the size: a step that ends so near to the shortest way of a slide ends at it
_AT_CHANGE = 1e-7  # below this root a path that turns back is taken to turn back in a change point


class SolvedRows(NamedTuple):
    """What the kernel wrote."""

    status: int
    reached: int
    at: float
    fault: int
    places: NDArray[np.complex128]
    turns: NDArray[np.complex128]
    rates: Reals
    whole: NDArray[np.int32]
    roots: Reals
    unknowns: Reals

    def picked(self, rows: slice | Integers, reached: int, at: float) -> SolvedRows:
        """Some of the rows, of which so many are reached, up to a place on their path."""
        return self._replace(
            reached=reached,
            at=at,
            places=self.places[:, rows],
            turns=self.turns[rows],
            rates=self.rates[:, rows],
            whole=self.whole[rows],
            roots=self.roots[rows],
            unknowns=self.unknowns[rows],
        )


def without_first(rows: SolvedRows) -> SolvedRows:
    """All rows but the first."""
    later = rows.picked(slice(1, None), max(rows.reached - 1, 0), max(rows.at - 1, 0.0))
    return later._replace(whole=later.whole - later.whole[:1])


def follow_path(plan: Plan, path: Reals, speeds: Reals, signs: Reals, unknowns: Reals) -> SolvedRows:
    """Run the kernel so that a path that rests or turns back in a change point is retraced."""
    rows = run_rows(plan, path, speeds, signs, unknowns)
    if _lingers(plan, path, rows):
        kept, again = _without_rests(path)
        rows = _there_and_back(plan, path[kept], speeds[:, kept], signs, unknowns)
        rows = _with_rests(rows, kept, again, plan, path, speeds)
    return rows


def _lingers(plan: Plan, path: Reals, rows: SolvedRows) -> bool:
    """Whether the path rests or turns back in a change point of a dyad, or rests where a larger group may have one."""
    ways = np.diff(path, axis=0)
    corners = np.flatnonzero((ways[1:] * ways[:-1] <= 0).all(axis=1)) + 1
    if not len(corners):
        return False
    if plan.higher_groups and rows.status and (ways[np.append(corners, 0)] == 0).all(axis=1).any():
        return True
    branching = plan.branching
    roots = rows.roots[corners[corners < len(rows.roots)]][:, branching]
    return bool((np.abs(roots).min(axis=1, initial=1.0) < _AT_CHANGE).any())


def _without_rests(path: Reals) -> tuple[Integers, Integers]:
    """The rows that differ from the one before, and for each row which of these it repeats."""
    moves = np.concatenate([[True], (np.diff(path, axis=0) != 0).any(axis=1)])
    return np.flatnonzero(moves), np.cumsum(moves) - 1


def _with_rests(
    rows: SolvedRows, kept: Integers, again: Integers, plan: Plan, path: Reals, speeds: Reals
) -> SolvedRows:
    """The rows of a path whose rests were left out; rates there are solved with the speeds that are given for them."""
    count = int(np.searchsorted(again, rows.reached))
    at = rows.at if rows.status == 0 else float(kept[min(int(rows.at), len(kept) - 1)]) + rows.at % 1
    every = rows.picked(again[:count], count, at)
    for row in np.setdiff1d(np.arange(count), kept) if len(speeds) else ():
        state = np.where(every.roots[row] < 0, -1.0, 1.0), every.unknowns[row].copy()
        solved = run_rows(plan, path[row : row + 1], speeds[:, row : row + 1], *state)
        if solved.reached and np.isfinite(rows.rates[:, again[row]]).all():
            every.places[1:, row], every.rates[:, row] = solved.places[1:, 0], solved.rates[:, 0]
    return every


def _there_and_back(plan: Plan, path: Reals, speeds: Reals, signs: Reals, unknowns: Reals) -> SolvedRows:
    """Run the kernel; where one drive turns back in a change point, go on from before it, so that the path is retraced.

    In a change point a dyad's sign is that of the way onward; for the way back it is the one before.
    """
    rows = run_rows(plan, path, speeds, signs, unknowns)
    branching = plan.branching
    if path.shape[1] > 1 or not branching or len(path) < 3:
        return rows
    steps = np.diff(path[:, 0])
    for corner in (1 + np.flatnonzero(steps[1:] * steps[:-1] < 0)).tolist():
        if corner >= rows.reached or np.abs(rows.roots[corner, branching]).min() > _AT_CHANGE:
            continue
        before = corner - 1
        while (
            before > 0
            and steps[before - 1] * steps[corner - 1] > 0
            and (np.abs(rows.roots[before, branching]).min() < _AT_CHANGE)
        ):
            before -= 1
        rest = np.concatenate([path[before : before + 1], path[corner + 1 :]])
        rates = np.concatenate([speeds[:, before : before + 1], speeds[:, corner + 1 :]], axis=1)
        state = np.where(rows.roots[before] < 0, -1.0, 1.0)
        back = run_rows(plan, rest, rates, state, rows.unknowns[before].copy())
        rows = _joined(rows, corner + 1, back, rows.whole[before])
    return rows


def _joined(rows: SolvedRows, count: int, back: SolvedRows, whole: NDArray[np.int32]) -> SolvedRows:
    """The first rows, then what another run found behind its first row."""
    return SolvedRows(
        back.status,
        count + back.reached - 1,
        count - 1 + back.at,
        back.fault,
        np.concatenate([rows.places[:, :count], back.places[:, 1:]], axis=1),
        np.concatenate([rows.turns[:count], back.turns[1:]]),
        np.concatenate([rows.rates[:, :count], back.rates[:, 1:]], axis=1),
        np.concatenate([rows.whole[:count], back.whole[1:] + whole]),
        np.concatenate([rows.roots[:count], back.roots[1:]]),
        np.concatenate([rows.unknowns[:count], back.unknowns[1:]]),
    )


def run_rows(
    plan: Plan, path: Reals, speeds: Reals | None, signs: Reals, unknowns: Reals, program: Program | None = None
) -> SolvedRows:
    """Run the kernel, with a row more wherever a driven slide passes its `Plan.shortest`; idle rollers are held.

    Args:
        plan: what is solved.
        path: (rows, drives) values of the drives.
        speeds: (order, rows, drives) their derivatives; None for poses alone.
        signs: of the dyads at the first row.
        unknowns: of larger groups there.
        program: for the kernel; by default that of the plan.
    """
    program = plan.program if program is None else program
    speeds, idle = np.zeros((0, *path.shape)) if speeds is None else speeds, plan.held
    if len(idle) and path.shape[1] < len(plan.lower.mechanism.drives):
        path = np.ascontiguousarray(np.concatenate([path, np.tile(idle, (len(path), 1))], axis=1))
        speeds = np.concatenate([speeds, np.zeros((*speeds.shape[:2], len(idle)))], axis=2)
    extra = _passed(plan, path)
    if len(extra):
        return _with_extra_rows(program, plan, path, speeds, signs, unknowns, extra)
    order, rows, links = len(speeds), len(path), len(plan.lower.mechanism.chain.links)
    poses = PoseBuffer(
        np.empty((order + 1, links, rows), np.complex128),
        np.empty((links, rows), np.complex128),
        np.empty((order, links, rows)),
        np.empty((links, rows), np.int32),
        np.empty((len(signs), rows)),
        np.empty((len(unknowns), rows)),
    )
    path, speeds, signs, unknowns = (np.ascontiguousarray(array) for array in (path, speeds, signs, unknowns))
    status, count, at, fault = _core.run_path(program, path, speeds, signs, unknowns, poses)
    arrays: list[Any] = [array[..., :count].swapaxes(-1, -2) for array in poses]
    return SolvedRows(status, count, at, fault, *arrays)


def _passed(plan: Plan, path: Reals) -> Reals:
    """The places on the path, in rows, where a driven slide passes its `Plan.shortest` between two rows."""
    places = []
    for k, value in plan.shortest if len(path) > 1 else ():
        before, behind = path[:-1, k] - value, path[1:, k] - value
        far = np.minimum(np.abs(before), np.abs(behind)) > _AT_IT * plan.lower.size
        rows = np.flatnonzero((before * behind < 0) & far)
        places.append(rows + before[rows] / (before[rows] - behind[rows]))
    return np.unique(np.concatenate(places)) if places else np.empty(0)


def _with_extra_rows(
    program: Program,
    plan: Plan,
    path: Reals,
    speeds: Reals,
    signs: Reals,
    unknowns: Reals,
    extra: Reals,
) -> SolvedRows:
    at = np.concatenate([np.arange(len(path), dtype=np.float64), extra])
    by_place = np.argsort(at, kind="stable")
    at, asked = at[by_place], by_place < len(path)
    row, part = np.minimum(at.astype(int), len(path) - 2), at - np.minimum(at.astype(int), len(path) - 2)
    filled = path[row] + part[:, None] * (path[row + 1] - path[row])
    filled[asked] = path
    for k, value in plan.shortest:  # exactly there, so that it is not passed once more
        near = ~asked & (np.abs(filled[:, k] - value) < _PASSED * plan.lower.size)
        filled[near, k] = value
    fast = np.zeros((len(speeds), *filled.shape))
    fast[:, asked] = speeds
    rows = run_rows(plan, filled, fast, signs, unknowns, program)
    pick = np.flatnonzero(asked[: rows.reached])
    low = min(int(rows.at), len(at) - 1)
    high = min(low + 1, len(at) - 1)
    return rows.picked(pick, len(pick), float(at[low] + (rows.at - low) * (at[high] - at[low])))
