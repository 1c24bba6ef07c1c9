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
from typing import NamedTuple

import numpy as np

from gruebler.arrays import Complexes, Reals
from gruebler.errors import LinkageError, SynthesisError
from gruebler.kinematics import circuit
from gruebler.linkages import Linkage
from gruebler.mechanism import Mechanism
from gruebler.realisation import realise
from gruebler.synthesis.closure import DesignClosure
from gruebler.synthesis.curve_matching import best_matches, drive_angles, resampled
from gruebler.synthesis.judging import Demands, judge_design, point_targets
from gruebler.synthesis.positions import ranked
from gruebler.synthesis.results import FITTED, Design, SolutionCount, SynthesisResult, in_order_of
from gruebler.synthesis.structure_atlas import dyad_structure, link_motions, structure_atlas
from gruebler.synthesis.tasks import PathTask
from gruebler.text import message

__all__ = ["ParetoRow", "fit_structure", "pareto", "synthesise_structures"]


_SAMPLES = 48  # places along a target and along a circuit
_POINTS = 60  # points of a link that are tried for the first likeness
_STEPS = 150
_NEIGHBOURS, _REALISATIONS = 24, 4  # starts of one mechanism
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
        own, its = self._costs, other._costs
        return all(a <= b for a, b in zip(own, its, strict=True)) and own != its

    @property
    def _costs(self) -> tuple[float, ...]:
        mu = 0.0 if isnan(self.transmission) else self.transmission
        return self.error, -mu, self.size, float(self.links)


def synthesise_structures(
    task: PathTask,
    structures: Iterable[Mechanism],
    demands: Demands | None = None,
    *,
    starts: int | None = None,
    link: str = "",
    executor: Executor | None = None,
) -> SynthesisResult:
    """Every mechanism fitted to a path by a point of one of its links.

    Args:
        task: points of a path, open or closed.
        structures: driven mechanisms of turning and sliding joints with one drive.
        demands: what a design has to do besides.
        starts: how many are improved of each mechanism: by default 24 neighbours from the atlas of its structure (a
            crank and dyads of turning joints), or 4 realisations of any other.
        link: that carries the point; for each start the one with the most similar path without it.
        executor: shares the work among processes or threads; the answer is the same without.

    Cost: a six-bar with an atlas 1 s for the atlas and 0.4 s a start; others 1 to 3 s a start.
    """
    wanted = demands or Demands()
    mechanisms = tuple(structures)
    if not mechanisms:
        raise SynthesisError("structures: expected at least one mechanism")
    if starts is not None and starts < 1:
        raise SynthesisError("starts: expected at least 1, but found {count}", count=starts)
    for mechanism in mechanisms:
        if len(mechanism.drives) > 1:
            raise SynthesisError(
                "a path is fitted with one drive, but {mechanism!r} has {count}",
                mechanism=mechanism.text(),
                count=len(mechanism.drives),
            )
    jobs = [job for mechanism in mechanisms for job in _jobs(task, mechanism, starts, link)]
    work = partial(_fitted, task, wanted, link)
    results = list(map(work, jobs) if executor is None else executor.map(work, jobs))
    candidates = [design for designs in results for design in designs]
    accepted, rejected = ranked(candidates)
    accepted = in_order_of(accepted, ["error"])
    note = message(
        "{count} initial designs were improved by least squares; designs that come nearer than {limit:g} of the "
        "size are accepted.",
        count=len(jobs),
        limit=_limit(wanted),
    )
    count = SolutionCount(message("linkages"), 0, len(candidates), len(candidates))
    return SynthesisResult(task, accepted, rejected, count, (note,))


def _limit(demands: Demands) -> float:
    """How far a path may be missed, relative to its size: what the caller demands, if it is no exact task."""
    return demands.tolerance if demands.tolerance > 1e-6 else ACCEPTED


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


class _AtlasStart(NamedTuple):
    """A linkage of the atlas of a structure, placed on the target."""

    drawn: Complexes
    """(joints,) where the joints lie in the drawing."""
    turned: Reals
    """(points,) how far the crank has turned from the drawing at each point."""
    link: str
    point: complex


class _Job(NamedTuple):
    mechanism: Mechanism
    seed: int
    start: _AtlasStart | None
    """From the atlas; without one the mechanism is realised."""


def _jobs(task: PathTask, mechanism: Mechanism, starts: int | None, link: str) -> list[_Job]:
    """The starts of one mechanism: from the atlas of its structure if it has one, else so many realisations."""
    near = _atlas_starts(task, mechanism, starts or _NEIGHBOURS, link)
    if near:
        return [_Job(mechanism, 0, start) for start in near]
    return [_Job(mechanism, seed, None) for seed in range(starts or _REALISATIONS)]


def _atlas_starts(task: PathTask, mechanism: Mechanism, number: int, link: str) -> list[_AtlasStart]:
    """The linkages of the atlas whose curves are most like the target, no drawing twice."""
    structure = dyad_structure(mechanism)
    if structure is None or not structure.coupler_links or (link and link not in structure.coupler_links):
        return []
    book = structure_atlas(structure)
    own = np.arange(len(book.z)) if not link else np.flatnonzero(book.link == structure.coupler_links.index(link))
    starts: list[_AtlasStart] = []
    seen: set[bytes] = set()
    for match in best_matches(book.z[own], task.z, 4 * number, closed=task.closed):
        n = int(own[match.number])
        places = match.turn * np.append(book.drawn[n], book.point[n]) + match.shift
        turned = drive_angles(book.turned[n], match.at)
        if match.mirrored:
            places, turned = np.conj(places), -turned
        if (name := book.drawn[n].tobytes()) not in seen and len(starts) < number:
            seen.add(name)
            starts.append(_AtlasStart(places[:-1], turned, structure.coupler_links[book.link[n]], complex(places[-1])))
    return starts


def _fitted(task: PathTask, demands: Demands, link: str, job: _Job) -> list[Design]:
    if job.start is None:
        design = fit_structure(task, job.mechanism, demands, seed=job.seed, link=link)
    else:
        design = _fitted_drawing(task, job.mechanism, demands, job.start)
    return [] if design is None else [design]


def _fitted_drawing(task: PathTask, mechanism: Mechanism, demands: Demands, start: _AtlasStart) -> Design | None:
    """A linkage of the atlas improved."""
    structure = dyad_structure(mechanism)
    assert structure is not None
    names = mechanism.chain.joint_names()
    places: dict[str | int, object] = {name: (z.real, z.imag) for name, z in zip(names, start.drawn, strict=True)}
    drawing = Linkage.from_drawing(mechanism, places, {"P": (start.link, start.point.real, start.point.imag)})
    closure = DesignClosure(drawing)
    motions = link_motions(structure, start.drawn, start.turned)
    q = np.empty((len(task), closure.unknowns))
    for link, c in closure.column.items():
        pose = drawing.required_pose[link]
        rotation, shift = motions[link]
        z = rotation * complex(pose.x, pose.y) + shift
        q[:, c], q[:, c + 1], q[:, c + 2] = z.real, z.imag, pose.angle + np.unwrap(np.angle(rotation))
    point = drawing.points["P"]
    state = _State(closure.sizes, q, start.link, point.x, point.y)
    return _judged(task, demands, closure, _improved(closure, state, task.z, _reach(task)), drawing.outputs)


def _reach(task: PathTask) -> float:
    return float(np.abs(task.z - task.z.mean()).max())


def _judged(
    task: PathTask, demands: Demands, closure: DesignClosure, state: _State, outputs: tuple[str, ...]
) -> Design | None:
    """The design of an improved state; None if its dimensions are none."""
    try:
        linkage = closure.with_sizes(state.p, {"P": (state.link, state.u, state.v)}, state.q[0]).with_outputs(outputs)
    except LinkageError:
        return None
    targets = point_targets("P", task.z, float(max(np.ptp(task.z.real), np.ptp(task.z.imag))))
    return judge_design(linkage, targets, replace(demands, tolerance=_limit(demands)), FITTED)


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
    arcs = np.linspace(0, course.length, 2 * _SAMPLES + 1)[:-1]
    q = closure.poses(course.at(arcs))
    start = _start(closure, q, task.z, task.closed, np.random.default_rng(seed), (link,) if link else closure.links)
    if start is None:
        return None
    state = _improved(closure, start, task.z, _reach(task))
    return _judged(task, demands or Demands(), closure, state, first.linkage.outputs)


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
                target, _ = resampled(z, length, closed=closed)
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
    _, parts = resampled(z, length, closed=closed)
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
        derivatives = closure.derivatives(state.q, state.p, size=size)
        turn = np.exp(1j * state.q[:, c + 2])
        arm = turn * complex(state.u, state.v)
        rest = state.q[:, c] + 1j * state.q[:, c + 1] + arm - z
        by_pose = np.zeros((len(z), closure.unknowns), np.complex128)
        by_pose[:, c], by_pose[:, c + 1], by_pose[:, c + 2] = 1.0, 1j, 1j * arm
        along = np.einsum("nk,nk->n", by_pose, derivatives.motion)
        tangent = along / np.maximum(np.abs(along), 1e-12 * size)
        # Of each point the distance across the path and that along it, by dimensions and the point's place on the link.
        sides = np.stack([np.conj(1j * tangent), np.conj(tangent)], axis=1)
        by_point = np.real(sides[:, :, None] * np.stack([turn, 1j * turn], axis=1)[:, None, :])
        by_sizes = derivatives.gradient(np.real(sides[:, :, None] * by_pose[:, None, :]))
        slopes = np.concatenate([by_sizes, by_point], axis=2)
        value, matrix = np.real(sides[:, 0] * rest), slopes[:, 0]
        gram = matrix.T @ matrix
        right = matrix.T @ value
        weight = np.diag(gram).mean() + 1e-30
        step = -np.linalg.solve(gram + damping * weight * np.eye(len(gram)), right)
        slide = -(np.real(sides[:, 1] * rest) + slopes[:, 1] @ step) / np.maximum(np.abs(along), 1e-9 * size)
        trial = _State(
            state.p + step[:-2],
            state.q + np.clip(slide, -0.2, 0.2)[:, None] * derivatives.motion,
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
