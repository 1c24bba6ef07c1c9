"""Many designs of one mechanism moved along one path."""

from __future__ import annotations

from typing import NamedTuple

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

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]


class DesignInputs(NamedTuple):
    """In what designs of one program differ."""

    points: Complexes
    """(designs, elements)"""
    lines: Complexes
    """(designs, elements)"""
    most: Reals
    """(designs, drives) longest steps."""
    sizes: Reals
    """(designs,)"""
    signs: Reals
    """(designs, dyads); NaN for a design that is not to be moved."""
    starts: Reals
    """(designs, 3 bodies of larger groups)"""


class DesignPoses(NamedTuple):
    """What is written of each design, NaN in rows that were not reached."""

    places: Complexes
    """(order + 1, designs, kept, rows)"""
    turns: Complexes
    """(designs, kept, rows)"""
    rates: Reals
    """(order, designs, kept, rows)"""
    reached: Ints
    """(designs,) how many rows."""


def run_designs(
    program: Program,
    designs: DesignInputs,
    path: Reals,
    speeds: Reals,
    kept: Ints,
    out: DesignPoses,
    part: tuple[int, int],
) -> None:
    """Move designs one after another; the interpreter is free meanwhile, so that threads may share the work.

    Args:
        program: one of the designs.
        designs: the sizes and starts of all of them.
        path: (rows, drives) drive values, the same for all.
        speeds: (order, rows, drives).
        kept: (kept,) the links that are written.
        out: written.
        part: the first design of this call, and the one behind its last.
    """
    order, rows = len(speeds), len(path)
    links = 1 + max(int(program.links.max()), int(program.roots.max(initial=0)))
    dyads, unknowns = designs.signs.shape[1], designs.starts.shape[1]
    poses = PoseBuffer(
        np.empty((order + 1, links, rows), np.complex128),
        np.empty((links, rows), np.complex128),
        np.empty((order, links, rows)),
        np.zeros((links, rows), np.int32),
        np.empty((dyads, rows)),
        np.empty((unknowns, rows)),
    )
    memory = new_pose_memory(dyads, unknowns, len(program.conditions) - 1)
    scratch = new_motion_scratch(links, len(program.kinds), len(program.roots), path.shape[1])
    move = for_work(_designs, (part[1] - part[0]) * walking(program, rows, order))
    move(program, designs, path, speeds, kept, out, part, poses, memory, scratch, np.zeros(REGISTERS))


@njit(cache=True, error_model="numpy", _nrt=False, nogil=True)
def _designs(
    program: Program,
    designs: DesignInputs,
    path: Reals,
    speeds: Reals,
    kept: Ints,
    out: DesignPoses,
    part: tuple[int, int],
    poses: PoseBuffer,
    memory: PoseMemory,
    scratch: MotionScratch,
    registers: Reals,
) -> None:
    p = program
    for n in range(part[0], part[1]):
        design = Program(
            p.operations, p.links, designs.points[n], designs.lines[n], p.conditions, p.kinds, p.sides, p.owners,
            p.bodies, p.roots, designs.most[n], designs.sizes[n], p.values, p.windings, p.pieces,
        )  # fmt: skip
        end, signs, start = 0, designs.signs[n], designs.starts[n]
        if not np.isnan(signs.sum()):
            poses.whole[:] = 0
            end = walk_path(design, path, speeds, signs, start, poses, memory, scratch, registers)[1]
        out.reached[n] = end
        for m in range(len(kept)):
            link = kept[m]
            _copy(poses.turns[link], out.turns[n, m], end)
            for k in range(len(out.places)):
                _copy(poses.places[k, link], out.places[k, n, m], end)
            for k in range(len(out.rates)):
                for row in range(len(path)):
                    out.rates[k, n, m, row] = poses.rates[k, link, row] if row < end else np.nan


@njit(cache=True, error_model="numpy", _nrt=False)
def _copy(source: Complexes, target: Complexes, end: int) -> None:
    for row in range(end):
        target[row] = source[row]
    for row in range(end, len(target)):
        target[row] = complex(np.nan, np.nan)
