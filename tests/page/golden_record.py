"""What the library's kernel finds, written so that the page's kernel can be compared with it."""

from __future__ import annotations

from typing import Any

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.mechanics.kinematics.kernel_calls import run_rows
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage
from gruebler.page.model import program_record


def golden_record(linkage: Linkage, rows: Reals, signs: Reals, unknowns: Reals) -> dict[str, Any]:
    """A path, (rows, drives), and what is found along it with velocities and accelerations for speed 1, as plain data.

    Numbers that are not finite are None.
    """
    plan = cached_plan(linkage)
    speeds = np.zeros((2, *rows.shape))
    speeds[0] = 1
    solved = run_rows(plan, rows, speeds, signs, unknowns)
    idle = np.tile(plan.held, (len(rows), 1))
    return {
        "program": program_record(plan),
        "path": np.concatenate([rows, idle], axis=1).ravel().tolist(),
        "speeds": [np.concatenate([s, np.zeros_like(idle)], axis=1).ravel().tolist() for s in speeds],
        "signs": signs.tolist(),
        "unknowns": unknowns.tolist(),
        "status": int(solved.status),
        "reached": int(solved.reached),
        "at": float(solved.at),
        "fault": int(solved.fault),
        "places": _finite(solved.places),
        "turns": _finite(solved.turns),
        "rates": _finite(solved.rates),
    }


def _finite(values: Reals | Complexes) -> list[float | None]:
    flat = np.stack([values.real, values.imag], axis=-1).ravel() if np.iscomplexobj(values) else values.ravel()
    return [float(v) if np.isfinite(v) else None for v in flat]
