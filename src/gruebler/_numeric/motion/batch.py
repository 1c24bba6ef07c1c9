"""Many designs of one mechanism moved along one path."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import for_work, njit
from gruebler._numeric.motion.path import walk_path
from gruebler._numeric.motion.program import (
    MotionScratch,
    PoseBuffer,
    PoseMemory,
    Program,
    new_motion_scratch,
    new_pose_memory,
)
from gruebler._numeric.motion.registers import REGISTERS
from gruebler._numeric.work_estimates import walking

__all__ = ["run_designs"]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]


def run_designs(
    program: Program,
    sizes: tuple[Complexes, Complexes, Reals, Reals],
    path: Reals,
    speeds: Reals,
    signs: Reals,
    starts: Reals,
    kept: Ints,
    out: tuple[Complexes, Complexes, Reals, Ints],
    part: tuple[int, int],
) -> None:
    """Move designs one after another; the interpreter is free meanwhile, so that threads may share the work.

    Args:
        program: one of the designs.
        sizes: points and lines (designs, elements), longest steps (designs, drives), sizes (designs,).
        path: (rows, drives) drive values, the same for all.
        speeds: (order, rows, drives).
        signs: (designs, dyads); NaN for a design that is not to be moved.
        starts: (designs, 3 bodies of larger groups).
        kept: (kept,) the links that are written.
        out: places (order + 1, designs, kept, rows), turns (designs, kept, rows), rates (order, designs, kept, rows),
            rows reached (designs,); written, NaN in rows that were not reached.
        part: the first design of this call, and the one behind its last.
    """
    order, rows = len(speeds), len(path)
    links = 1 + max(int(program.links.max()), int(program.roots.max(initial=0)))
    poses = PoseBuffer(
        np.empty((order + 1, links, rows), np.complex128),
        np.empty((links, rows), np.complex128),
        np.empty((order, links, rows)),
        np.zeros((links, rows), np.int32),
        np.empty((signs.shape[1], rows)),
        np.empty((starts.shape[1], rows)),
    )
    memory = new_pose_memory(signs.shape[1], starts.shape[1], len(program.conditions) - 1)
    scratch = new_motion_scratch(links, len(program.kinds), len(program.roots), path.shape[1])
    move = for_work(_designs, (part[1] - part[0]) * walking(program, rows, order))
    move(program, sizes, path, speeds, signs, starts, kept, out, part, poses, memory, scratch, np.zeros(REGISTERS))


@njit(cache=True, error_model="numpy", _nrt=False, nogil=True)
def _designs(
    program: Program,
    sizes: tuple[Complexes, Complexes, Reals, Reals],
    path: Reals,
    speeds: Reals,
    signs: Reals,
    starts: Reals,
    kept: Ints,
    out: tuple[Complexes, Complexes, Reals, Ints],
    part: tuple[int, int],
    poses: PoseBuffer,
    memory: PoseMemory,
    scratch: MotionScratch,
    registers: Reals,
) -> None:
    points, lines, longest, lengths = sizes
    places, turns, rates, reached = out
    p = program
    for n in range(part[0], part[1]):
        mine = Program(
            p.operations, p.links, points[n], lines[n], p.conditions, p.kinds, p.sides, p.owners, p.bodies, p.roots,
            longest[n], lengths[n], p.values, p.windings, p.pieces,
        )  # fmt: skip
        end = 0
        if not np.isnan(signs[n].sum()):
            poses.whole[:] = 0
            end = walk_path(mine, path, speeds, signs[n], starts[n], poses, memory, scratch, registers)[1]
        reached[n] = end
        for m in range(len(kept)):
            link = kept[m]
            _copy(poses.turns[link], turns[n, m], end)
            for k in range(len(places)):
                _copy(poses.places[k, link], places[k, n, m], end)
            for k in range(len(rates)):
                for row in range(len(path)):
                    rates[k, n, m, row] = poses.rates[k, link, row] if row < end else np.nan


@njit(cache=True, error_model="numpy", _nrt=False)
def _copy(source: Complexes, target: Complexes, end: int) -> None:
    for row in range(end):
        target[row] = source[row]
    for row in range(end, len(target)):
        target[row] = complex(np.nan, np.nan)
