"""Any structure made for a task: dimensions by least squares with exact derivatives, from several starts.

docs/theory/synthesis-any.md. Each mechanism is realised, or taken from the atlas of its structure, poses that are most
like the targets are chosen, and all dimensions are improved together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, joined, joined_by_and, message
from gruebler.design.realisation import realise
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.dead_centre_verdicts import with_dead_centres
from gruebler.design.synthesis.demands import EXACT_AT_MOST, Demands
from gruebler.design.synthesis.drawing_limits import limits_of_drawings
from gruebler.design.synthesis.dyad_structures import dyad_structure
from gruebler.design.synthesis.first_states import first_state
from gruebler.design.synthesis.fitting import (
    FitState,
    FitTargets,
    fit_stages,
    fit_targets,
    guided_output,
    improved,
    links_moved_by_all,
    output_links,
)
from gruebler.design.synthesis.given_lengths import links_with_lengths, missing_length
from gruebler.design.synthesis.judging import (
    judge_design,
    judge_with_drives,
    order_notes,
    transmission_fault,
)
from gruebler.design.synthesis.law_motion import over_interval
from gruebler.design.synthesis.results import (
    FITTED,
    Design,
    DesignVerdict,
    Progress,
    SolutionCount,
    SynthesisResult,
    in_order_of,
    ranked,
)
from gruebler.design.synthesis.special_tasks import solved_where_it_lies
from gruebler.design.synthesis.structure_curves import fit_drawings, together
from gruebler.design.synthesis.targets import GuidedCurve, Probe, Targets, point_targets
from gruebler.design.synthesis.tasks import DeadCentreTask, FunctionTask, PathTask, PositionTask, Task
from gruebler.design.synthesis.tightest_demands import tightest_sought
from gruebler.design.synthesis.turning_poses import turns_by_poses, with_turn, without_turn
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.transmission import NoTransmissionAngleError, pushing_links
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.enumeration.worker_pool import run_work
from gruebler.structure.mechanism import Mechanism, check_drives

_KEPT, _REALISATIONS = 24, 4  # designs of one mechanism
_SAME = 1e-6  # of the size of a linkage: two that are drawn nearer to each other are one
_NEIGHBOURS = 50  # of each kind from the atlas for each design that is kept
_RAISED, _STEEPEST = 3, 1.5  # times a transmission angle at the targets; radians
ACCEPTED = 0.05


@solved_where_it_lies
def synthesise_structures(
    task: Task,
    structures: Iterable[Mechanism],
    demands: Demands | None = None,
    *,
    starts: int | None = None,
    link: str = "",
    executor: Executor | Callable[[], Executor] | None = None,
    progress: Progress | None = None,
) -> SynthesisResult:
    """Every mechanism fitted to a task: positions or points of one of its links, a function, dead centres.

    Args:
        task: what is wanted; which pins of the frame given pivots are, is tried in all ways. Of functions and dead
            centres only differences count, since a structure has no line from which angles are measured.
        structures: driven mechanisms of turning and sliding joints; with several drives for positions and points.
        demands: what a design has to do besides: pivots, lengths and their ratio are kept by every step, of
            a crank and dyads a crank that turns, too, and of larger groups a second try of starts whose crank does
            not; the transmission angle as far as the targets allow it.
        starts: how many are improved to the end of each mechanism: by default the best 24 of 1,200 neighbours from the
            atlas of its structure (a crank and dyads of turning joints, for a path), or 4 realisations of any other.
        link: that is guided, or whose motion is the output; for each start the one that is most alike without it.
        executor: see `enumeration.worker_pool.run_work`; the answer is the same with any.
        progress: called with the starts done and their number.

    Cost: a six-bar with an atlas 1 s for the atlas and 5 s for its neighbours, twice as much where a curve is nearly
    met; others 1 to 3 s a start.
    """
    mechanisms = tuple(structures)
    known = [link for mechanism in mechanisms for link in links_with_lengths(mechanism)]
    wanted = (demands or Demands()).of_task(task, known)
    if not mechanisms:
        raise SynthesisError("structures: expected at least one mechanism")
    if starts is not None and starts < 1:
        raise SynthesisError("starts: expected at least 1, but found {count}", count=starts)
    if (unheld := unheld_pivots(task)) is not None:
        raise SynthesisError(unheld)
    targets = fit_targets(task)
    unsized = {mechanism: missing_length(mechanism, wanted) for mechanism in mechanisms}
    left_out = [joined([each.text(), reason], " – ") for each, reason in unsized.items() if reason is not None]
    mechanisms = tuple(mechanism for mechanism in mechanisms if unsized[mechanism] is None)
    if not mechanisms:
        raise SynthesisError(left_out[0])
    for mechanism in mechanisms:
        _check(mechanism, targets, link, len(getattr(task, "fixed_pivots", ())))
    jobs = [job for mechanism in mechanisms for job in _jobs(task, targets, mechanism, starts, link)]
    candidates = _candidates(task, wanted, wanted, link, jobs, executor, progress)
    accepted, rejected = ranked(candidates)
    accepted = in_order_of(accepted, ["error"])
    own = isinstance(task, PathTask) and bool(task.tolerances)
    note = message(
        "Initial designs improved: {count}. Each target has its own tolerance, without one {limit:g} of the size."
        if own
        else "Initial designs improved: {count}. Designs that come nearer than {limit:g} of the size are accepted.",
        count=sum(job.kept for job in jobs),
        limit=_limit(wanted),
    )
    search = partial(_candidates, link=link, jobs=jobs, executor=executor)
    tight = [] if accepted else tightest_sought(task, wanted, search)
    count = SolutionCount(what=message("linkages"), theorem=0, found=len(candidates), real=len(candidates))
    notes = (*left_out, note, *order_notes(candidates, wanted), *tight)
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=notes)


def _candidates(
    task: Task,
    demands: Demands,
    limits: Demands,
    link: str,
    jobs: Sequence[_Job],
    executor: Executor | Callable[[], Executor] | None,
    progress: Progress | None = None,
) -> list[Design]:
    """The designs of all starts, each machine once, that were improved within limits and judged by the demands."""
    candidates: list[Design] = []
    placed = isinstance(task, PositionTask | PathTask)
    for done, designs in enumerate(run_work(partial(_fitted, task, demands, limits, link), jobs, executor), 1):
        for design in designs:
            if not any(same_machine(design.linkage, known.linkage, placed=placed) for known in candidates):
                candidates.append(design)
        if progress is not None:
            progress(done, len(jobs))
    return [over_interval(design, task) for design in candidates] if isinstance(task, FunctionTask) else candidates


def same_machine(first: Linkage, other: Linkage, *, placed: bool) -> bool:
    """Whether two linkages for a task are one machine, however their links are written: drawn alike in their poses.

    Of a slide only the direction counts, since its line may lie anywhere beside the pins.

    Args:
        first: with a reference pose, as the other one.
        other: to be compared.
        placed: whether the plane of the frame is that of the task; else place, turn and size do not count.
    """
    carriers = [[point.link for point in linkage.points.values()] for linkage in (first, other)]
    if (first.mechanism, first.outputs, carriers[0]) != (other.mechanism, other.outputs, carriers[1]):
        return False
    drawings = [_drawn(first, placed=placed), _drawn(other, placed=placed)]
    size = float(np.abs(drawings).max(initial=1.0))
    return bool(np.abs(drawings[0] - drawings[1]).max(initial=0.0) <= _SAME * size)


def _drawn(linkage: Linkage, *, placed: bool) -> Complexes:
    """(joints,) where the pins lie, and the squares of the directions of the slides."""
    pose, joints = linkage.required_pose, range(len(linkage.mechanism.chain.joints))
    own = {joint: linkage.mechanism.chain.joints[joint].links[0] for joint in joints}
    turns = np.exp(1j * np.array([pose[own[joint]][2] for joint in joints]))
    elements = [linkage.elements[joint, own[joint]] for joint in joints]
    pins = np.array([element.is_pin for element in elements], bool)
    places = np.array([complex(*pose[own[joint]][:2]) for joint in joints])
    places += turns * np.array([complex(element.x, element.y) for element in elements])
    if not placed:
        places = places - places[pins][0] if pins.any() else places
        scale = places[np.argmax(np.where(pins, np.abs(places), 0))] or 1.0
        places, turns = places / scale, turns / (scale / abs(scale))
    angles = np.array([0.0 if pin else element.place[2] for pin, element in zip(pins, elements, strict=True)])
    return np.where(pins, places, (turns * np.exp(1j * angles)) ** 2)


def unheld_pivots(task: Task) -> Message | None:
    """Which pivots of a task no fit holds, in a sentence; None if it gives none.

    >>> print(unheld_pivots(PositionTask([(0, 0, 0), (2, 1, 0.4)], moving_pivots=[(0, 1)])))
    moving_pivots: only four-bars and slider-cranks made without a structure take them
    """
    given = [key for key in ("moving_pivots", "curve_parameters") if getattr(task, key, ())]
    text = message("{keys}: only four-bars and slider-cranks made without a structure take them")
    return text.filled(keys=joined_by_and(given)) if given else None


def _check(mechanism: Mechanism, targets: FitTargets, link: str, pivots: int) -> None:
    """Refuse what cannot be fitted: the drives, given pivots, and the link that was asked for."""
    drives, frame = mechanism.drives, mechanism.frame
    chain = mechanism.chain
    own = sum(frame in joint.links and joint.pair.is_turning for joint in chain.joints)
    if pivots > own:
        raise SynthesisError(
            "{key}: {count} are given, but {mechanism!r} has {own}",
            key="fixed_pivots",
            count=pivots,
            mechanism=mechanism.text(),
            own=own,
        )
    if targets.inputs is not None:
        if len(drives) > 1:
            raise SynthesisError(
                "crank angles and functions have one drive, but {mechanism!r} has {count}",
                mechanism=mechanism.text(),
                count=len(drives),
            )
        if drives and not (drives[0].turning and frame in drives[0].between):
            raise SynthesisError(
                "crank angles and functions need a drive that turns at the frame, unlike that of {mechanism!r}",
                mechanism=mechanism.text(),
            )
    if targets.outputs is not None:
        named = link if targets.z is None else ""
        outputs = output_links(mechanism, targets.travel, named)
        if not outputs:
            raise (
                SynthesisError(
                    "no link of {mechanism!r} slides along the frame: there is no travel", mechanism=mechanism.text()
                )
                if targets.travel
                else SynthesisError(
                    "no link of {mechanism!r} but the driven one turns at the frame", mechanism=mechanism.text()
                )
            )
        if named and named not in outputs:
            raise SynthesisError("the output is one of {links}, not {link!r}", links=", ".join(outputs), link=link)
    if targets.z is not None and link and (link not in chain.links or link == frame):
        raise SynthesisError(
            "the link that carries the point is one of {links}, not {link!r}",
            links=", ".join(other for other in chain.links if other != frame),
            link=link,
        )
    whole = links_moved_by_all(mechanism)
    if targets.z is None:
        whole = tuple(each for each in output_links(mechanism, targets.travel) if each in whole)
    if not link and not whole:
        raise SynthesisError(
            "no link of {mechanism!r} needs all others to move it: a smaller mechanism does the same",
            mechanism=mechanism.text(),
        )
    report = check_drives(mechanism)
    if report.mobility < 1:
        raise SynthesisError("{mechanism!r} has no mobility: there is nothing to drive", mechanism=mechanism.text())
    if drives and not report.fixed:
        raise SynthesisError("{mechanism!r}: {reason}", mechanism=mechanism.text(), reason=report.message)


def _limit(demands: Demands) -> float:
    """How far a path may be missed, relative to its size: what the caller demands, if it is no exact task."""
    return demands.tolerance if demands.tolerance > 1e-6 else ACCEPTED


class _Job(NamedTuple):
    mechanism: Mechanism
    seed: int
    """Of its realisation."""
    drawn_link: str = ""
    """The link of a structure with an atlas whose curves are fitted; without one the mechanism is realised."""
    kept: int = 1
    """How many designs are judged."""


def _jobs(task: Task, targets: FitTargets, mechanism: Mechanism, starts: int | None, link: str) -> list[_Job]:
    """The starts of one mechanism: from the atlas of its structure if it has one, else so many realisations."""
    points_alone = targets.angles is None and targets.inputs is None and not targets.ranks
    if isinstance(task, PathTask) and not task.mixed and points_alone:
        structure = dyad_structure(mechanism)
        whole = set(links_moved_by_all(mechanism)) | {link}
        links = () if structure is None else tuple(each for each in structure.coupler_links if each in whole)
        if links and (not link or link in links):
            fitted = (link,) if link else links
            kept = -(-(starts or _KEPT) // len(fitted))
            return [_Job(mechanism, 0, each, kept) for each in fitted]
    return [_Job(mechanism, seed) for seed in range(starts or _REALISATIONS)]


def _fitted(task: Task, demands: Demands, limits: Demands, link: str, job: _Job) -> list[Design]:
    def realised(seeds: Iterable[int], link: str) -> list[Design]:
        fit = partial(fit_structure, task, job.mechanism, demands, limits=limits, link=link)
        return [design for design in (fit(seed=seed) for seed in seeds) if design is not None]

    if not job.drawn_link:
        return realised([job.seed], link)
    assert isinstance(task, PathTask)
    structure = dyad_structure(job.mechanism)
    assert structure is not None
    pivots = [complex(*p) for p in task.fixed_pivots]
    every = [
        *limits_of_drawings(structure, job.drawn_link, limits, pivots, closed=task.closed, unit=fit_targets(task).size)
    ]
    number = -(-_NEIGHBOURS * job.kept // len(every))
    fits = together([fit_drawings(each, job.drawn_link, task.z, closed=task.closed, number=number) for each in every])
    if not len(fits.cost):  # of no drawing the crank turns
        return realised(range(_REALISATIONS), job.drawn_link)
    names = job.mechanism.chain.joint_names()
    fitted = fit_targets(task)
    targets = replace(point_targets("P", task.z, fitted.size), curve=fitted.curve, ranks=task.order)
    designs = []
    for *joints, point in fits.places[np.argsort(fits.cost, kind="stable")[: job.kept]]:
        drawing: dict[str | int, object] = {name: (z.real, z.imag) for name, z in zip(names, joints, strict=True)}
        points = {"P": (job.drawn_link, point.real, point.imag)}
        linkage = Linkage.from_drawing(job.mechanism, drawing, points=points)
        linkage = linkage.with_outputs(guided_output(linkage, job.drawn_link))
        designs.append(judge_design(linkage, targets, replace(demands, tolerance=_limit(demands)), FITTED))
    return designs


def fit_structure(
    task: Task,
    mechanism: Mechanism,
    demands: Demands | None = None,
    *,
    limits: Demands | None = None,
    seed: int = 0,
    link: str = "",
) -> Design | None:
    """One mechanism fitted to a task from one realisation; None if it cannot be realised or started.

    Without a transmission angle, though one is demanded, its dimensions are those of the realisation.

    Args:
        task: positions, points, a function or dead centres.
        mechanism: with its drives, or none: then they are chosen.
        demands: what the design has to do besides.
        limits: what is kept on the way to it; the demands by default.
        seed: of the realisation and the poses that are tried.
        link: that is guided, or whose motion is the output; the one that is most alike without it.
    """
    first = realise(mechanism, seed=seed, budget=300)
    if first.linkage is None:
        return None
    stages = fit_stages(task)
    if demands is not None and not demands.in_order and stages[0].z is not None and stages[0].curve is GuidedCurve.NONE:
        stages = tuple(replace(targets, ranks=(0,) * len(targets)) for targets in stages)
    limits = limits or demands or Demands()
    if limits.transmission > 0 and len(first.linkage.mechanism.drives) < 2:
        try:
            pushing_links(cached_plan(first.linkage), find_output(first.linkage))
        except NoTransmissionAngleError:
            verdict = DesignVerdict(reasons=(transmission_fault(np.nan),))
            return Design(linkage=first.linkage, verdict=verdict, form=FITTED)
    closure = DesignClosure(first.linkage)
    pivots = [complex(*p) for p in getattr(task, "fixed_pivots", ())]
    state = first_state(closure, stages[0], np.random.default_rng(seed), link, pivots)
    if state is None:
        return None
    fit = partial(_fit_from, task, closure, state, stages, demands or Demands(), limits)
    design = fit(turning=False)
    asked = limits.crank and stages[-1].bands is None and turns_by_poses(first.linkage.mechanism)
    if asked and not (design is not None and design.verdict.turns_fully and design.verdict.one_circuit):
        other = fit(turning=True)
        if design is None or (other is not None and len(other.verdict.reasons) < len(design.verdict.reasons)):
            design = other
    return design


def _fit_from(
    task: Task,
    closure: DesignClosure,
    state: FitState,
    stages: Sequence[FitTargets],
    demands: Demands,
    limits: Demands,
    *,
    turning: bool,
) -> Design | None:
    """The design to which a state leads, with poses all round the turn of its crank or without them."""

    def improved_at(state: FitState, targets: FitTargets, limits: Demands) -> FitState:
        if turning:
            every = with_turn(closure, state, targets)
            state = without_turn(improved(closure, *every, limits, exact=False), targets)
        return improved(closure, state, targets, limits)

    for targets in stages:
        state = improved_at(state, targets, limits)
    outputs = (state.output,) if state.output else guided_output(closure.linkage, state.link)
    design = _judged(task, stages[-1], demands, closure, state, outputs)
    for _ in range(_RAISED):  # between the targets the angle may be smaller than at them
        if design is None or not limits.transmission > 0:
            break
        missing = demands.transmission - design.verdict.transmission
        if not missing > 0:
            break
        limits = replace(limits, transmission=min(limits.transmission + missing, _STEEPEST))
        state = improved_at(state, stages[-1], limits)
        design = _judged(task, stages[-1], demands, closure, state, outputs)
    return design


def _judged(
    task: Task,
    targets: FitTargets,
    demands: Demands,
    closure: DesignClosure,
    state: FitState,
    outputs: tuple[str, ...],
) -> Design | None:
    """The design of an improved state; None if its dimensions are none."""
    points = {} if targets.z is None else {"P": (state.link, state.point.real, state.point.imag)}
    try:
        linkage = closure.with_sizes(state.p, points, state.q[0]).with_outputs(outputs)
    except LinkageError:
        return None
    wanted = replace(_wanted(closure, targets, state), there_and_back=isinstance(task, DeadCentreTask))
    limit = _limit(demands)
    if targets.bands is not None:
        wanted = replace(wanted, allowed=targets.bands.band / targets.size)
        bands = replace(targets.bands, band=targets.bands.band / targets.size)
        limit = bands.tolerance(demands.tolerance, EXACT_AT_MOST, ACCEPTED)
    limits = replace(demands, tolerance=limit)
    if len(linkage.mechanism.drives) < 2:
        design = judge_design(linkage, wanted, limits, FITTED)
        return with_dead_centres(design, task, limit) if isinstance(task, DeadCentreTask) else design
    return judge_with_drives(linkage, wanted, limits, FITTED, closure.drive_values(state.q, state.p))


def _wanted(closure: DesignClosure, targets: FitTargets, state: FitState) -> Targets:
    """What the verdict looks at: the targets with the constants that the fit has chosen."""
    size, free = targets.size, list(state.free[2:] if targets.z is not None else state.free)
    probes: list[Probe] = []
    values: list[Complexes] = []
    if targets.z is not None:
        probes.append(Probe("P"))
        values.append(targets.z)
    turning = [
        (targets.angles, state.link),
        (targets.inputs, state.crank),
        (None if targets.travel else targets.outputs, state.output),
    ]
    for wanted, link in turning:
        if wanted is not None:
            probes.append(Probe(link=link, length=size))
            values.append(size * np.exp(1j * (wanted + free.pop(0))))
    if targets.travel and targets.outputs is not None:
        joint, frame = state.slide
        own, far = closure.start[joint, frame], closure.start[joint, state.output]
        along = np.exp(1j * state.p[own + 2])
        c = closure.column[state.output]
        # The displacement is measured between the points of both lines.
        arm = np.exp(1j * state.q[0, c + 2]) * complex(state.p[far], state.p[far + 1])
        between = float(np.real(np.conj(along) * (arm - complex(state.p[own], state.p[own + 1]))))
        probes.append(Probe(joint=joint))
        values.append((targets.outputs + free.pop(0) + between).astype(np.complex128))
    return Targets(tuple(probes), np.stack(values, axis=1), size, curve=targets.curve, ranks=targets.ranks)
