"""Any structure made to follow a path: dimensions by least squares with exact derivatives, from several starts.

docs/theory/synthesis-any.md. Each mechanism is realised, a point of one of its links whose path is like the target is
chosen, and all dimensions are improved together.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial
from math import isnan, pi

import numpy as np

from gruebler.arrays import Complexes, Reals
from gruebler.errors import LinkageError, SynthesisError
from gruebler.kinematics import circuit
from gruebler.mechanism import Mechanism
from gruebler.realisation import realise
from gruebler.synthesis.closure import DesignClosure
from gruebler.synthesis.judging import Demands, judge_design, point_targets
from gruebler.synthesis.positions import ranked
from gruebler.synthesis.results import Design, SolutionCount, SynthesisResult
from gruebler.synthesis.tasks import PathTask

__all__ = ["ParetoRow", "fit_structure", "pareto", "synthesise_structures"]


_SAMPLES = 48  # places along a target and along a circuit
_POINTS = 60  # points of a link that are tried for the first likeness
_STEPS = 60
ACCEPTED = 0.05


@dataclass(frozen=True)
class ParetoRow:
    """A design by what counts: the smaller error, size and number of links, the larger transmission angle."""

    structure: str
    error: float
    transmission: float
    size: float
    links: int
    design: Design

    def dominates(self, other: ParetoRow) -> bool:
        """Whether it is nowhere worse and somewhere better."""
        mine, its = self._costs, other._costs
        return all(a <= b for a, b in zip(mine, its, strict=True)) and mine != its

    @property
    def _costs(self) -> tuple[float, ...]:
        mu = 0.0 if isnan(self.transmission) else self.transmission
        return self.error, -mu, self.size, float(self.links)


def synthesise_structures(
    task: PathTask,
    structures: Iterable[Mechanism],
    demands: Demands | None = None,
    *,
    starts: int = 4,
    link: str = "",
    executor: Executor | None = None,
) -> SynthesisResult:
    """Every mechanism fitted to a path by a point of one of its links.

    Args:
        task: points of a path, open or closed.
        structures: driven mechanisms of turning and sliding joints with one drive.
        demands: what a design has to do besides.
        starts: realisations tried of each mechanism.
        link: that carries the point; for each start the one with the most similar path without it.
        executor: shares the work among processes or threads; the answer is the same without.

    Cost: 0.3 to 2 s a start of a six-bar.
    """
    wanted = demands or Demands()
    jobs = [(mechanism, seed) for mechanism in structures for seed in range(starts)]
    if not jobs:
        raise SynthesisError("structures: expected at least one mechanism")
    for mechanism, _ in jobs:
        if len(mechanism.drives) > 1:
            raise SynthesisError(
                "a path is fitted with one drive, but {text_!r} has {count}",
                text_=mechanism.text(),
                count=len(mechanism.drives),
            )
    work = partial(_fitted, task, wanted, link)
    found = list(map(work, jobs) if executor is None else executor.map(work, jobs))
    made = [design for designs in found for design in designs]
    accepted, rejected = ranked(made)
    accepted = tuple(sorted(accepted, key=lambda design: design.verdict.error))
    note = f"{len(jobs)} starts were improved by least squares; accepted is what comes nearer than the tolerance."
    return SynthesisResult(task, accepted, rejected, SolutionCount("linkages", 0, len(made), len(made)), (note,))


def pareto(found: SynthesisResult) -> tuple[ParetoRow, ...]:
    """The accepted designs that no other one dominates, by error, transmission angle, size and number of links."""
    rows = [
        ParetoRow(
            design.linkage.mechanism.text(),
            design.verdict.error,
            design.verdict.transmission,
            design.linkage.size,
            len(design.linkage.mechanism.chain.links),
            design,
        )
        for design in found.designs
    ]
    best = [row for row in rows if not any(other.dominates(row) for other in rows)]
    return tuple(sorted(best, key=lambda row: row.error))


def _fitted(task: PathTask, demands: Demands, link: str, job: tuple[Mechanism, int]) -> list[Design]:
    mechanism, seed = job
    design = fit_structure(task, mechanism, demands, seed=seed, link=link)
    return [] if design is None else [design]


def fit_structure(
    task: PathTask, mechanism: Mechanism, demands: Demands | None = None, *, seed: int = 0, link: str = ""
) -> Design | None:
    """One mechanism fitted to a path from one realisation; None if it cannot be realised or started.

    Args:
        task: points of a path.
        mechanism: with one drive, or none: then one is chosen.
        demands: what the design has to do besides.
        seed: of the realisation and the points that are tried.
        link: that carries the point; the one with the most similar path without it.
    """
    wanted = demands or Demands()
    limit = wanted.tolerance if wanted.tolerance > 1e-6 else ACCEPTED
    first = realise(mechanism, seed=seed, budget=300)
    if first.linkage is None:
        return None
    try:
        course = circuit(first.linkage)
    except LinkageError:
        return None
    closure = DesignClosure(first.linkage)
    if link and link not in closure.column:
        raise SynthesisError(
            "the link that carries the point is one of {links}, not {link!r}", links=", ".join(closure.links), link=link
        )
    z = task.z
    size = float(np.abs(z - z.mean()).max())
    arcs = np.linspace(0, course.length, 2 * _SAMPLES + 1)[:-1]
    q = closure.poses(course.at(arcs))
    start = _start(closure, q, z, task.closed, np.random.default_rng(seed), (link,) if link else closure.links)
    if start is None:
        return None
    state = _improved(closure, start, z, size)
    try:
        linkage = closure.with_sizes(state.p, {"P": (state.link, state.u, state.v)}, state.q[0])
    except LinkageError:
        return None
    linkage = linkage.with_outputs(first.linkage.outputs)
    extent = float(max(np.ptp(z.real), np.ptp(z.imag)))
    targets = point_targets("P", z, extent)
    return judge_design(linkage, targets, replace(wanted, tolerance=limit), f"{len(closure.links) + 1} links")


@dataclass
class _State:
    """Dimensions, the poses at all targets, and the point of the link."""

    p: Reals
    q: Reals
    link: str
    u: float
    v: float


def _start(
    closure: DesignClosure, q: Reals, z: Complexes, closed: bool, rng: np.random.Generator, links: Sequence[str]
) -> _State | None:
    """The point whose path is most like the target, everything turned, scaled and shifted onto it."""
    from gruebler.synthesis.curves import _resampled

    count = len(q)
    lengths = [count] if closed else [count // 6, count // 4, count // 3, count // 2]
    best: tuple[float, str, complex, int, int, bool, complex, complex] | None = None
    reach = closure.linkage.size
    for link in links:
        c = closure.column[link]
        origin, turn = q[:, c] + 1j * q[:, c + 1], np.exp(1j * q[:, c + 2])
        for w in reach * rng.uniform(0, 1.2, _POINTS) ** 0.7 * np.exp(2j * pi * rng.uniform(0, 1, _POINTS)):
            curve = origin + turn * w
            for length in lengths:
                target, _ = _resampled(z, closed, length)
                for back in (False, True):
                    wanted = target[::-1] if back else target
                    for begin in range(0, count, 4):
                        piece = np.take(curve, np.arange(begin, begin + length), mode="wrap")
                        u, v = piece - piece.mean(), wanted - wanted.mean()
                        energy = float(np.vdot(u, u).real * np.vdot(v, v).real)
                        inner = complex(np.vdot(u, v))
                        gap = 1 - abs(inner) ** 2 / max(energy, 1e-300)
                        if best is None or gap < best[0]:
                            turned = inner / float(np.vdot(u, u).real)
                            shift = complex(wanted.mean() - turned * piece.mean())
                            best = gap, link, complex(w), begin, length, back, turned, shift
    if best is None:
        return None
    _, link, w, begin, length, back, turned, shift = best
    _, parts = _resampled(z, closed, length)
    along = (1 - parts) if back else parts
    rows = (begin + np.round(along * (length if closed else length - 1)).astype(int)) % count
    p, chosen = closure.sizes.copy(), q[rows].copy()
    scale = abs(turned)
    for key in closure.keys:
        at = closure.start[key]
        if key[1] in closure.column:
            p[at : at + 2] *= scale
            continue
        place = turned * complex(p[at], p[at + 1]) + shift
        p[at], p[at + 1] = place.real, place.imag
        if len(closure.linkage.elements[key]) == 3:
            p[at + 2] += float(np.angle(turned))
    for c in closure.column.values():
        place = turned * (chosen[:, c] + 1j * chosen[:, c + 1]) + shift
        chosen[:, c], chosen[:, c + 1] = place.real, place.imag
        chosen[:, c + 2] += float(np.angle(turned))
    return _State(p, chosen, link, (scale * w).real, (scale * w).imag)


def _improved(closure: DesignClosure, state: _State, z: Complexes, size: float) -> _State:
    """Levenberg and Marquardt's method over all dimensions; the drive value of each target is eliminated."""
    q, good = closure.closed(state.q, state.p, size=size)
    state.q = q
    cost = _cost(closure, state, z) if good.all() else float("inf")
    damping = 1e-3
    for _ in range(_STEPS):
        c = closure.column[state.link]
        motion, by_sizes = closure.tangents(state.q, state.p, size=size)
        turn = np.exp(1j * state.q[:, c + 2])
        arm = turn * complex(state.u, state.v)
        rest = state.q[:, c] + 1j * state.q[:, c + 1] + arm - z
        by_pose = np.zeros((len(z), closure.unknowns), np.complex128)
        by_pose[:, c], by_pose[:, c + 1], by_pose[:, c + 2] = 1.0, 1j, 1j * arm
        along = np.einsum("nk,nk->n", by_pose, motion)
        slopes = np.concatenate(
            [np.einsum("nk,nkm->nm", by_pose, by_sizes), turn[:, None], (1j * turn)[:, None]], axis=1
        )
        normal = 1j * along / np.maximum(np.abs(along), 1e-12 * size)
        value = np.real(np.conj(normal) * rest)
        matrix = np.real(np.conj(normal)[:, None] * slopes)
        gram = matrix.T @ matrix
        right = matrix.T @ value
        weight = np.diag(gram).mean() + 1e-30
        step = -np.linalg.solve(gram + damping * weight * np.eye(len(gram)), right)
        slide = -np.real(np.conj(along) * (rest + slopes @ step)) / np.maximum(np.abs(along) ** 2, 1e-9 * size**2)
        trial = _State(
            state.p + step[:-2],
            state.q + np.einsum("nkm,m->nk", by_sizes, step[:-2]) + np.clip(slide, -0.2, 0.2)[:, None] * motion,
            state.link,
            state.u + float(step[-2]),
            state.v + float(step[-1]),
        )
        trial.q, good = closure.closed(trial.q, trial.p, size=size)
        value_ = _cost(closure, trial, z) if good.all() else float("inf")
        if value_ < cost:
            gain, state, cost = cost - value_, trial, value_
            damping = max(damping * 0.3, 1e-12)
            if gain < 1e-9 * cost or cost < 1e-26 * size**2:
                break
        else:
            damping *= 5
            if damping > 1e8:
                break
    return state


def _cost(closure: DesignClosure, state: _State, z: Complexes) -> float:
    c = closure.column[state.link]
    point = state.q[:, c] + 1j * state.q[:, c + 1] + np.exp(1j * state.q[:, c + 2]) * complex(state.u, state.v)
    return float(np.sum(np.abs(point - z) ** 2))
