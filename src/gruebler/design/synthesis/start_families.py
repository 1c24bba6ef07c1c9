"""Families of linkages that coordinate two to four pairs: by where input and output start, which is free.

docs/theory/synthesis-functions.md: with the starts chosen, the linear condition of a four-bar or slider-crank gives the
linkage of three pairs; of two pairs its first factor is free, too, and of four pairs the start of the output is not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.coordination import (
    coordinations_with_one_free_start,
    pair_arrays,
    turning_kind,
)
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.tasks import FunctionTask

MOST_PAIRS = 5
"""So many pairs a four-bar or slider-crank with free starts can meet exactly."""
_STARTS = {2: 24, 3: 96, 4: 360}
"""By the number of pairs: how many starts of each side are tried."""
_STEPS = 40
_LONGEST = 0.3  # of a step to given ratios, by the frame
_REACHED = 1e-12
_RESTS = 1e-13  # of a step, by the frame: one that is shorter only moves the last digits
_SAME = 1e-7  # by the frame: pivots of two linkages that are one differ by less
_FACTORS = 24
_LARGEST_FACTOR = 32.0  # first factors are tried between its inverse and this, by the size of the output
FARTHEST = 4.0  # start travels: to the hyperbolic sine of so much, by the size of the output, denser near 0


def sampled_by_starts(task: FunctionTask) -> list[GuidingDyad]:
    """A sample of the family of two to four pairs, as the dyads between crank and output. Cost: 0.2 s."""
    count = _STARTS[len(task)]
    places = (np.arange(count) + 0.5) / count
    if len(task) == 4:
        return _with_input_starts(task, np.pi * places)
    starts = np.pi * places if task.output == "angle" else FARTHEST * (2 * places - 1)
    if len(task) == 3:  # a start half a turn on is that of a negative crank
        inputs, begins = np.meshgrid(np.pi * places, starts)
        return _with_starts(task, inputs.ravel(), begins.ravel())
    logs = np.log(_LARGEST_FACTOR) * (2 * (np.arange(_FACTORS) + 0.5) / _FACTORS - 1)
    inputs, begins, factors = np.meshgrid(np.pi * np.append(places, 1 + places), starts, logs)
    return _with_starts(task, inputs.ravel(), begins.ravel(), factors.ravel())


def near_by_starts(task: FunctionTask, dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
    """Dyads of the family beside one of them, whose starts differ by so large a part of all that there are."""
    size = _output_size(task)
    at, step = [float(np.angle(dyad.fixed))], [np.pi * width]
    if len(task) == 4:
        return _with_input_starts(task, at[0] + step[0] * np.array([-1.0, -0.5, 0.5, 1.0]))
    if task.output == "angle":
        at, step = [*at, float(np.angle(dyad.moving - 1))], [*step, np.pi * width]
    else:
        at, step = [*at, float(np.arcsinh(dyad.moving.real / size))], [*step, 2 * FARTHEST * width]
    if len(task) == 2:
        factor = 1 / abs(dyad.fixed) if task.output == "angle" else 2 * abs(dyad.fixed) / size
        at, step = [*at, float(np.log(factor))], [*step, 2 * np.log(_LARGEST_FACTOR) * width]
    moves = np.array([move for move in product((-1.0, -0.5, 0.0, 0.5, 1.0), repeat=len(at)) if any(move)])
    inputs, starts, *logs = (np.array(at) + moves * np.array(step)).T
    return _with_starts(task, inputs, starts, logs[0] if logs else None)


def family_dimension(task: FunctionTask) -> int:
    """The dimension of the family of two to four pairs."""
    return MOST_PAIRS - len(task)


def with_ratios(
    task: FunctionTask, lengths: Sequence[tuple[str, float]], dyads: Sequence[GuidingDyad]
) -> list[GuidingDyad]:
    """The four-bars nearest to some of the family whose lengths are to each other as given; each once.

    By Gauss and Newton in both moving pivots, with the frame from 0 to 1: the coupler is as long at every pair, and the
    logarithms of the lengths differ as those of the given ones.

    Args:
        task: two to four pairs of angles.
        lengths: links and their lengths, at least two, at most one more than the family has dimensions.
        dyads: with which is begun, between crank and output.
    """
    phi, output = pair_arrays(task)
    crank, rocker = (np.exp(1j * (angles - angles[0])) for angles in (phi, output))
    z = np.array([(dyad.fixed, dyad.moving) for dyad in dyads])
    moving, met = np.arange(len(z)), np.zeros(len(z), bool)
    for _ in range(_STEPS):
        values, slopes = _ratio_equations(z[moving], crank, rocker, lengths)
        good = np.isfinite(values).all(axis=1) & np.isfinite(slopes).all(axis=(1, 2))
        met[moving[~good]] = False
        moving, values, slopes = moving[good], values[good], slopes[good]
        matrix = np.stack([slopes.real, slopes.imag], axis=3).reshape(*values.shape, 4)
        step = -np.einsum("nij,nj->ni", np.linalg.pinv(matrix), values)
        far = np.linalg.norm(step, axis=1)
        step *= np.minimum(1, _LONGEST / np.maximum(far, 1e-300))[:, None]
        z[moving] += step.view(np.complex128)
        met[moving] = np.abs(values).max(axis=1, initial=0.0) < _REACHED
        moving = moving[~met[moving] | (far > _RESTS)]
        if not len(moving):
            break
    each = np.empty((0, 2), np.complex128)
    for pivots in z[met]:  # rounded places would part two that are one, where they lie on an edge
        if (np.abs(each - pivots).max(axis=1) > _SAME).all():
            each = np.vstack([each, pivots])
    return [GuidingDyad(CRANK, complex(moving), complex(fixed)) for fixed, moving in each]


def _ratio_equations(
    z: Complexes, crank: Complexes, rocker: Complexes, lengths: Sequence[tuple[str, float]]
) -> tuple[Reals, Complexes]:
    """(dyads, equations) what is to be zero in `with_ratios`, and (dyads, equations, 2) its gradients as x + y i."""
    wanted = np.log([length for _, length in lengths])
    with np.errstate(all="ignore"):
        pins, far = z[:, :1] * crank, (z[:, 1:] - 1) * rocker
        gap = 1 + far - pins
        square = np.abs(gap) ** 2
        # Rows by x, y of both pivots: the gradient of |w|^2 for w = w0 + t z is 2 conj(t) w.
        by_fixed, by_moving = -2 * np.conj(crank) * gap, 2 * np.conj(rocker) * gap
        lines = {"crank": (z[:, 0], 1, 0), "coupler": (z[:, 1] - z[:, 0], -1, 1), "rocker": (z[:, 1] - 1, 0, 1)}
        logs, changes = [], []
        for link, _ in lengths:
            w, first, second = lines.get(link, (np.ones(len(z)), 0, 0))
            logs.append(np.log(np.abs(w)))
            changes.append(np.stack([first / np.conj(w), second / np.conj(w)], axis=1))
        ratios = np.stack(logs, axis=1) - wanted
        values = np.concatenate([square[:, 1:] - square[:, :1], ratios[:, 1:] - ratios[:, :1]], axis=1)
        pairs = np.stack([by_fixed, by_moving], axis=2)
        own = np.stack(changes, axis=1)
        slopes = np.concatenate([pairs[:, 1:] - pairs[:, :1], own[:, 1:] - own[:, :1]], axis=1)
    return values, slopes


def _output_size(task: FunctionTask) -> float:
    return 1.0 if task.output == "angle" else float(np.ptp(task.outputs)) or 1.0


def _with_starts(task: FunctionTask, inputs: Reals, starts: Reals, logs: Reals | None = None) -> list[GuidingDyad]:
    """The linkages of three pairs with such starts, of two pairs with such logarithms of the first factor, too."""
    kind, size = turning_kind(task), _output_size(task)
    phi, output = pair_arrays(task)
    begins = starts if task.output == "angle" else size * np.sinh(starts)
    columns = kind.columns(inputs[:, None] + phi - phi[0], begins[:, None] + output - output[0])
    right, chosen = columns[..., -1], np.empty((len(inputs), 0))
    if logs is not None:
        chosen = (np.exp(logs) * size)[:, None]
        right = right - columns[..., 0] * chosen
    matrices = columns[..., chosen.shape[1] : -1]
    scale = np.abs(matrices).max(axis=1, keepdims=True)  # a travel in metres weighs as much as one in millimetres
    with np.errstate(divide="ignore", invalid="ignore"):
        solved = np.einsum("kij,kj->ki", np.linalg.pinv(matrices / scale), right) / scale[:, 0]
    dyads = []
    for factors, phi_0, begin in zip(np.hstack([chosen, solved]), inputs.tolist(), begins.tolist(), strict=True):
        lengths = kind.lengths(factors)
        if lengths is not None:
            dyads.append(kind.dyad(lengths, complex(lengths[0] * np.exp(1j * phi_0)), begin)[1])
    return dyads


def _with_input_starts(task: FunctionTask, inputs: Reals) -> list[GuidingDyad]:
    """The linkages of four pairs whose crank starts so: at most two for each start."""
    kind = turning_kind(task)
    phi, _ = pair_arrays(task)
    dyads = []
    for start in inputs:
        counted = replace(task, inputs=tuple(start + phi - phi[0]), start_input=True, law=None)
        for solution in coordinations_with_one_free_start(kind, counted).real:
            pin = solution.lengths[0] * complex(np.exp(1j * solution.input_start))
            dyads.append(kind.dyad(solution.lengths, pin, solution.output_start)[1])
    return dyads
