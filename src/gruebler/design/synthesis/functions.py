"""Function generation: four-bars, slider-cranks and inverted slider-cranks that coordinate input and output.

docs/theory/synthesis-functions.md: each kind of linkage is linear in as many numbers of its own; every start angle that
is free adds one pair and makes the condition quadratic; with both free the problem is that of guiding the output link
as seen from the crank.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import zip_longest
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.coordination import (
    KINDS,
    Coordination,
    Minimax,
    coordinations_with_fixed_starts,
    coordinations_with_one_free_start,
    pair_arrays,
    turning_kind,
)
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyad_families import guiding_dyads
from gruebler.design.synthesis.dyads import CRANK, SLIDER, GuidingDyad
from gruebler.design.synthesis.formulas import FunctionLaw, chebyshev_spacing
from gruebler.design.synthesis.freudenstein import output_errors
from gruebler.design.synthesis.function_bounds import improved_couplers, seen_from_crank
from gruebler.design.synthesis.given_lengths import scale_to_length
from gruebler.design.synthesis.judging import TOO_FAR, judge_design
from gruebler.design.synthesis.law_motion import over_interval
from gruebler.design.synthesis.minimax_search import minimax as minimax_near
from gruebler.design.synthesis.nearest_functions import nearest_linkages
from gruebler.design.synthesis.pair_facts import PairFacts, facts_of_pins
from gruebler.design.synthesis.pair_search import IMPROVED, best_dyads
from gruebler.design.synthesis.pair_shifts import output_shifts
from gruebler.design.synthesis.positions import NEAR
from gruebler.design.synthesis.results import EXACT, Design, SolutionCount, SynthesisResult, in_order_of, ranked
from gruebler.design.synthesis.start_families import (
    MOST_PAIRS,
    family_dimension,
    near_by_starts,
    sampled_by_starts,
    with_ratios,
)
from gruebler.design.synthesis.structural_errors import coordination_of, links_turned_round
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import FunctionTask
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

_FAMILIES = {
    2: message("There are infinitely many solutions, a family of dimension 3; {count} were taken."),
    3: message("There are infinitely many solutions, one for each point of the plane; {count} were taken."),
    4: message("There are infinitely many solutions, one for each point of a curve; {count} were taken."),
}
"""By how many pairs, with both starts free: what a dyad between crank and output can be."""
_FEW = message("The ratios of the given lengths leave finitely many four-bars; {count:,} were found.")
_MANY = message("There are infinitely many four-bars with the ratio of the given lengths; {count:,} were taken.")
_DEAD_STARTS = message(
    "Linkages that begin at a dead centre, where rounding may part them, are passed over: {count}; the nearest of them "
    "misses a pair by {error:.3g} of the size."
)
_FORMS = {"angle": "four-bar", "travel": "slider-crank"}
"""What crank, coupler and output form together; slides between crank and output name themselves."""


def synthesise_function(
    task: FunctionTask,
    demands: Demands | None = None,
    *,
    number: int = 16,
    minimax: bool = False,
    sort: Sequence[str] = (),
) -> SynthesisResult:
    """All linkages that coordinate the pairs; the frame of four-bars has the length 1 unless another length is given.

    Args:
        task: two to five pairs; with both starts free more of them, by least squares.
        demands: besides one branch and the order.
        number: of dyads taken where there are infinitely many.
        minimax: the linkages near these whose largest structural error is as small as possible, the best first.
        sort: by what the best of a family are sought: names as for `SynthesisResult.sorted_by`.

    Two to four pairs with free starts leave families, which are searched by the demands.

    Raises `SynthesisError` for more pairs than can be met exactly, and for the minimax optimum of a table of pairs.
    Cost: below 1 ms and 10 ms for each verdict; minimax optima and tables of more than five pairs 1 s.

    >>> task = FunctionTask([0.8, 1.2, 1.7], outputs=[0.9, 1.1, 1.5])
    >>> found = synthesise_function(task)
    >>> found.count.found, found.count.theorem
    (1, 1)
    """
    wanted = (demands or Demands()).of_task(task)
    if minimax and task.law is None:
        raise SynthesisError("the minimax optimum needs the function as an expression, not a table of pairs")
    free = (not task.start_input) + (not task.start_output)
    fitted = free == 2 and len(task) > MOST_PAIRS
    if fitted and wanted.tolerance <= EXACT:
        wanted = replace(wanted, tolerance=NEAR)
    met = (
        _by_free_starts(task, wanted, number, None if minimax else sort)
        if free == 2
        else _by_given_starts(task, wanted, free)
    )
    designs, rejected = ranked(met.candidates if minimax else (over_interval(each, task) for each in met.candidates))
    notes = met.notes
    if not designs and task.law is None and free < 2:
        notes = (
            *notes,
            message(
                "The angles of the table count from the line of the frame; with free starts only their differences "
                "count."
            ),
        )
    if (
        not designs
        and task.output == "angle"
        and len(wanted.lengths) > 1 + (family_dimension(task) if free == 2 else 0)
    ):
        notes = (
            *notes,
            message(
                "Angles leave one length free, the first of the given ones; the others were only compared. A "
                "structure fitted to the pairs keeps all of them."
            ),
        )
    if fitted:
        designs = in_order_of(designs, ["error"])
    opposite = [(k, links) for k, design in enumerate(designs, 1) if (links := links_turned_round(design, task))]
    if opposite:
        notes = (
            *notes,
            message(
                "Given angles are those of the shafts; links that point the other way, at 180 degrees to them, by "
                "design: {links}.",
                links=", ".join(f"{k} ({', '.join(names)})" for k, names in opposite),
            ),
        )
    result = SynthesisResult(task=task, designs=designs, rejected=rejected, count=met.solutions, notes=notes)
    return _optima(result, task.law, wanted) if minimax and task.law is not None else result


class _Candidates(NamedTuple):
    """Designs that meet the pairs, in any order."""

    candidates: list[Design]
    solutions: SolutionCount
    notes: tuple[Message, ...] = ()


def _by_given_starts(task: FunctionTask, wanted: Demands, free: int) -> _Candidates:
    """In closed form, with both starts given or one of them free."""
    candidates: list[Design] = []
    theorem = complex_count = real = 0
    for kind in KINDS:
        if kind.output == task.output and len(task) == kind.unknowns + free:
            solve = coordinations_with_one_free_start if free else coordinations_with_fixed_starts
            solutions = solve(kind, task)
            theorem += solutions.complex if free else 1
            complex_count, real = complex_count + solutions.complex, real + len(solutions.real)
            candidates += [_design(task, wanted, solution) for solution in solutions.real]
    most = 3 + free
    if candidates or theorem:
        count = SolutionCount(what=message("linkages"), theorem=theorem, found=complex_count, real=real)
        if task.output != "angle" or len(task) >= most:
            return _Candidates(candidates, count)
        note = message(
            "There are infinitely many four-bars besides, a family of dimension 1: {count} pairs determine them.",
            count=most,
        )
        return _Candidates(candidates, replace(count, what=message("inverted slider-cranks")), (note,))
    if len(task) > most:
        raise SynthesisError(
            "{count} pairs cannot be met exactly, at most {most} with this many free starts ({free}): give fewer "
            "pairs, leave a start free, or fit a structure to them",
            count=len(task),
            free=free,
            most=most,
        )
    note = message(
        "There are infinitely many solutions, a family of dimension {dimension}: give more pairs.",
        dimension=most - len(task),
    )
    return _Candidates([], SolutionCount(what=message("linkages"), theorem=None, found=0, real=0), (note,))


def _by_free_starts(task: FunctionTask, wanted: Demands, number: int, sort: Sequence[str] | None) -> _Candidates:
    """By the dyads between crank and output, with both starts free; families are searched unless ``sort`` is None."""
    dyads = _connecting(task, number)
    notes: tuple[Message, ...] = ()
    turning = sampled_by_starts(task) if sort is not None and len(task) < MOST_PAIRS else []
    near, family = partial(near_by_starts, task), None
    ratios = len(wanted.lengths) - 1
    if turning and task.output == "angle" and 0 < ratios <= family_dimension(task):
        turning = with_ratios(task, wanted.lengths, turning[:: len(turning) // _BEGUN + 1])
        near = partial(_near_with_ratios, task, wanted)
        family = (_FEW if ratios == family_dimension(task) else _MANY).filled(count=len(turning))
    if turning:
        best, search = best_dyads(turning, partial(_facts, task), wanted, near, orders=sort or (), number=number)
        finite = family is not None and family.text == _FEW.text
        notes = tuple(each for each in search if each.text != IMPROVED.text or not finite)
        if ratios < 1:
            better, proved = improved_couplers(task, wanted, partial(_facts_of_pivots, task), best, len(turning))
            best, notes = [*better, *best], (*notes, *proved)
        some = turning[:: max(1, len(turning) // number)]
        dyads = (best or some) + [dyad for dyad in dyads if dyad.slides]
    theorem: int | None = None
    nearest: list[Design] = []
    if len(task) > MOST_PAIRS:
        theorem, dyads = 0, [dyad for dyad in dyads if dyad.slides]
        nearest, passed_over = _nearest_pairs(task, wanted)
        notes = (
            message(
                "More than five pairs are met by least squares; designs that come nearer than {tolerance:g} are "
                "accepted.",
                tolerance=wanted.tolerance,
            ),
            *passed_over,
        )
    elif len(task) == MOST_PAIRS:
        theorem = 3  # four dyads less the frame
    else:
        notes = (*notes, family or _FAMILIES[len(task)].filled(count=max(len(turning), len(dyads))))
    candidates = nearest + [design for dyad in dyads if (design := _connected(task, wanted, dyad)) is not None]
    real = len(nearest) + len(dyads)
    complex_count = 3 if len(task) == MOST_PAIRS else real
    return _Candidates(
        candidates, SolutionCount(what=message("linkages"), theorem=theorem, found=complex_count, real=real), notes
    )


def _near_with_ratios(task: FunctionTask, wanted: Demands, dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
    """Dyads beside one of them that keep the ratios of the given lengths."""
    return with_ratios(task, wanted.lengths, near_by_starts(task, dyad, width))


def _nearest_pairs(task: FunctionTask, wanted: Demands) -> tuple[list[Design], list[Message]]:
    """The four-bars or slider-cranks that follow more than five pairs most nearly, by the output at crank angles.

    Besides what is said of others that are no designs.
    """
    phi, output = pair_arrays(task)
    turned, moved = phi - phi[0], output - output[0]
    size = 1.0 if task.output == "angle" else float(np.ptp(output)) or 1.0
    designs, unsteady = list[Design](), list[float]()
    for solution in nearest_linkages(turning_kind(task), phi, output):
        error = float(np.abs(output_errors(solution, turned, moved)).max()) / size
        if not solution.can_start:
            unsteady.append(error)
            continue
        design = _judged_at_starts(task, wanted, solution, turned, moved, size, error)
        verdict = replace(design.verdict, error=error)
        if error > wanted.tolerance:
            reason = TOO_FAR.filled(error=error)
            verdict = replace(verdict, reasons=(*verdict.reasons, reason))
        designs.append(replace(design, verdict=verdict))
    said = _DEAD_STARTS.filled(count=len(unsteady), error=min(unsteady, default=0.0))
    return designs, [said] if unsteady else []


def _facts(task: FunctionTask, dyads: Sequence[GuidingDyad]) -> PairFacts:
    """What the linkages of crank, RR dyad and output do, in closed form: (dyads, 1)."""
    moving, fixed = (np.array([getattr(dyad, name) for dyad in dyads]) for name in ("moving", "fixed"))
    return _facts_of_pivots(task, moving, fixed)


def _facts_of_pivots(task: FunctionTask, moving: Complexes, fixed: Complexes) -> PairFacts:
    """The same, from the moving pivots of output and crank in the first position."""
    phi, output = pair_arrays(task)
    far_pins, pins = moving[:, None, None], fixed[:, None, None]
    moved = output - output[0]
    pins = pins * np.exp(1j * (phi - phi[0]))
    none, inside = np.zeros((1, 1), np.complex128), np.ones((len(moving), 1), bool)
    if task.output == "angle":
        other = 1 + (far_pins - 1) * np.exp(1j * moved), none + 1
        return facts_of_pins(
            (pins, none),
            other,
            none[..., None],
            CRANK,
            inside=inside,
            size=1.0,
            shifts=partial(output_shifts, size=1.0),
            pivot_distance=none.real,
        )
    other = far_pins + moved, far_pins[..., 0]
    size = float(np.ptp(output)) or np.inf
    return facts_of_pins(
        (pins, none),
        other,
        1 + none[..., None],
        SLIDER,
        inside=inside,
        size=size,
        shifts=partial(output_shifts, size=float(np.ptp(output)) or 1.0),
        pivot_distance=none.real,
    )


def _optima(exact: SynthesisResult, law: FunctionLaw, demands: Demands) -> SynthesisResult:
    """The minimax optima near the designs of a result and near the linkages that follow the function most nearly.

    Designs without one are rejected.
    """
    task = exact.task
    assert isinstance(task, FunctionTask)
    optima, candidates = list[Minimax](), list[Design]()
    x = np.array([law.interval[0], *chebyshev_spacing(*law.interval, _NEAREST), law.interval[1]])
    phi, output = law.inputs(x), law.outputs(x)
    nearest = nearest_linkages(
        turning_kind(task), phi, output, start_input=task.start_input, start_output=task.start_output
    )
    errors = [float(np.abs(output_errors(each, phi - phi[0], output - output[0])).max()) for each in nearest]
    far = max(_FARTHER * min(errors, default=0.0), _FAR * abs(law.output_swing))
    nearest = [each for each, error in zip(nearest, errors, strict=True) if error <= far]
    exactly = (*exact.designs, *exact.rejected)
    starts = [coordination_of(design, task, law) for design in exactly] + nearest
    for start, design in zip_longest(starts, exactly):
        try:
            if start is None:
                raise SynthesisError("the minimax optimum is sought of four-bars and slider-cranks")
            optimum = minimax_near(start, law)
        except SynthesisError:
            if design is not None:
                reason = message("it does not follow the function over the whole interval: no minimax optimum is near")
                reasons = (*design.verdict.reasons, reason)
                candidates.append(replace(design, verdict=replace(design.verdict, reasons=reasons)))
            continue
        if design is None and not optimum.certificate.optimum:
            continue
        if not any(optimum.solution.is_near(other.solution, _SAME_OPTIMUM) for other in optima):
            optima.append(optimum)
            candidates.append(_judged_optimum(task, law, demands, optimum))
    accepted, rejected = ranked(candidates)
    note = message(
        "The search for minimax optima also begins at {count} linkages that follow the function most nearly, by least "
        "squares from a grid of starts.",
        count=len(nearest),
    )
    exact = replace(exact, notes=(*exact.notes, note))
    return replace(exact, designs=in_order_of(accepted, ["error"]), rejected=rejected)


_BEGUN = 1500  # members of a sample from which given ratios of lengths are sought
_NEAREST = 25
"""At so many places of the interval the linkages that follow a function most nearly are sought."""
_FARTHER, _FAR = 10.0, 0.02
"""What misses it by so much more than the nearest one, and by so large a part of the output, is not followed."""
_SAME_OPTIMUM = 1e-4  # relative: optima are flat, so that two searches for one end near each other, not in one place


def _judged_optimum(task: FunctionTask, law: FunctionLaw, demands: Demands, optimum: Minimax) -> Design:
    """A minimax optimum as a design, carried from one end of the interval to the other through the pairs."""
    x = np.array([law.interval[0], *chebyshev_spacing(*law.interval, len(task)), law.interval[1]])
    free_law = replace(law, input_start=0.0, output_start=0.0)
    size = 1.0 if task.output == "angle" else abs(law.output_swing)
    error = optimum.error / size
    design = _judged_at_starts(
        task, demands, optimum.solution, free_law.inputs(x), free_law.outputs(x), size, 1.1 * error
    )  # 1.1: the error is rounded
    verdict = replace(design.verdict, error=error, over_interval=optimum.error)
    optimum = replace(optimum, solution=_scaled(task, demands, optimum.solution))
    targets = None if design.targets is None else replace(design.targets, values=design.targets.values[1:-1])
    return replace(design, verdict=verdict, drives=design.drives[1:-1], optimum=optimum, targets=targets)


def _scaled(task: FunctionTask, demands: Demands, solution: Coordination) -> Coordination:
    """With the first of the given lengths, where the task leaves the size free."""
    scale = scale_to_length(solution.placed(), demands) if task.output == "angle" else 1.0
    return replace(solution, lengths=tuple(scale * length for length in solution.lengths))


def _judged_at_starts(
    task: FunctionTask,
    demands: Demands,
    solution: Coordination,
    turned: Reals,
    moved: Reals,
    size: float,
    error: float,
) -> Design:
    """A linkage by its starts, judged at (pairs,) crank angles and outputs counted from them, which it may so miss."""
    phi, output = solution.input_start + turned, solution.output_start + moved
    if task.output == "angle":
        probes, values = (Probe(link="crank"), Probe(link="rocker")), [np.exp(1j * phi), np.exp(1j * output)]
    else:
        probes, values = (Probe(link="crank", length=size), Probe(joint=3)), [size * np.exp(1j * phi), output + 0j]
    linkage = _scaled(task, demands, solution).placed(task.unit)
    travel = np.inf if task.output == "angle" else float(np.ptp(moved)) or np.inf
    targets = Targets(probes, np.stack(values, axis=1), size, travel=travel)
    met = replace(demands, tolerance=max(demands.tolerance, error))
    design = judge_design(linkage, targets, met, solution.kind)
    return replace(design, drives=tuple(map(float, phi)), targets=targets)


def _design(task: FunctionTask, demands: Demands, solution: Coordination) -> Design:
    pin = solution.lengths[0] * complex(np.exp(1j * solution.input_start))
    far, dyad = solution.row.dyad(solution.lengths, pin, solution.output_start)
    return _judged_function(task, demands, 0j, far, dyad, solution.kind)


def _connecting(task: FunctionTask, number: int) -> list[GuidingDyad]:
    """The dyads between crank and output, without the frame, which connects them too."""
    seen = seen_from_crank(task)
    size = 1.0 if task.output == "angle" else seen.size
    family = guiding_dyads(seen, number)
    connecting = []
    for dyad in family:
        if task.output == "angle" and not dyad.slides:
            frame = abs(dyad.moving - 1) + abs(dyad.fixed) < 1e-6
        else:
            frame = task.output == "travel" and dyad.kind.pairs[1].is_sliding and abs(dyad.fixed) < 1e-6 * size
        if not frame:
            connecting.append(dyad)
    return connecting


def _connected(task: FunctionTask, demands: Demands, dyad: GuidingDyad) -> Design | None:
    far = 1 + 0j if task.output == "angle" else dyad.moving
    form = dyad.kind.form if dyad.slides else _FORMS[task.output]
    try:
        return _judged_function(task, demands, 0j, far, dyad, form)
    except LinkageError:
        return None


def _judged_function(
    task: FunctionTask, demands: Demands, near: complex, far: complex, dyad: GuidingDyad, form: str
) -> Design:
    """The linkage of crank, coupling dyad and output in its first position, judged."""
    side = "rocker" if task.output == "angle" else "slider"
    (first, at_crank), (second, at_output) = dyad.joints
    last, *along = ("R",) if side == "rocker" else ("P", 0.0)
    places: dict[str | int, object] = {
        "R(frame-crank)": (near.real, near.imag),
        f"{first}(crank-coupler)": at_crank,
        f"{second}(coupler-{side})": at_output,
        f"{last}(frame-{side})": (far.real, far.imag, *along),
    }
    mechanism = Mechanism.parse(f"{' '.join(map(str, places))}; frame=frame; drive=R(frame-crank)")
    linkage = Linkage.from_drawing(mechanism, places, unit=task.unit, outputs=[side])
    if task.output == "angle":
        linkage = linkage.scaled(scale_to_length(linkage, demands))
    return judge_design(linkage, _function_targets(task, linkage, side), demands, form)


def _function_targets(task: FunctionTask, linkage: Linkage, side: str) -> Targets:
    phi, output = pair_arrays(task)
    phi, output = phi - phi[0], output - output[0]
    crank = np.exp(1j * (linkage.required_pose["crank"].angle + phi))
    if side == "rocker":
        rocker = np.exp(1j * (linkage.required_pose["rocker"].angle + output))
        return Targets((Probe(link="crank"), Probe(link="rocker")), np.stack([crank, rocker], axis=1), 1.0)
    size = float(np.ptp(output)) or 1.0
    probes = (Probe(link="crank", length=size), Probe(joint=3))
    values = np.stack([size * crank, output.astype(np.complex128)], axis=1)
    return Targets(probes, values, size, travel=float(np.ptp(output)) or np.inf)
