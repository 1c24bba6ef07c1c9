"""Function generation by six-bars: all that coordinate eight pairs of angles, or nine; some that coordinate eleven.

Generic solutions were listed by monodromy: those of nine pairs (Watt II) are data of the package, those of eight pairs
are computed once (`six_bar_starts`), of eleven pairs some (`six_bar_census`). They are followed to a task.
docs/theory/synthesis-functions.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gruebler.base.arrays import Complexes, Flags, compared_by_value
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, joined_by_or, message
from gruebler.design.synthesis.alt_burmester import (
    ARRIVED,
    CAREFUL,
    QUICK,
    GenericSolutions,
    Problem,
    distinct,
    follow_from_generic,
    load_generic_solutions,
    repeated,
    sharpened,
)
from gruebler.design.synthesis.coordination import pair_arrays
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.law_motion import over_interval
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, in_order_of, ranked
from gruebler.design.synthesis.six_bar_census import ELEVEN, START_SOLUTIONS, Census, as_start_solutions, kept_census
from gruebler.design.synthesis.six_bar_monodromy import LOOPS, LoopVectors, loop_vectors
from gruebler.design.synthesis.six_bar_starts import StartSet, eight_pairs, start_set
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import FunctionTask
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

NINE_PAIRS = Problem(name="nine pairs", poses=0, points=8, classes=26370, members=1, family="Watt II")
"""At least so many complex six-bars turn through nine general pairs."""
FORM = "six-bar"
_REAL = 1e-7  # relative: conjugate unknowns that differ by less are conjugate
_SPECIAL = 0.05  # of the paths: where more are lost, the task is special, not the way to it
_BENT = 0.1  # how far a way leads aside for what was lost on the straight one, relative to the task
_FEW = 64  # of the lost paths of a special task: if these find nothing new, the others would not


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class SixBarType:
    """A type of six-bar, and what of its ternary link is given besides eight pairs; the frame of its first loop is 1.

    Raises `SynthesisError` for other types, an arm that is not positive, a shape that is zero, start solutions that are
    none or more than half a million.

    >>> SixBarType(arm=0.5).family
    'Watt II'
    """

    family: str = "Watt II"
    """Watt II, Stephenson II or Stephenson III."""
    arm: float = 0.8
    """The length of one arm: of the ternary rocker that the coupler moves (Watt II), of the coupler from the crank to
    the other rocker (Stephenson III), of the ternary link from the output to a rod of the crank (Stephenson II). One as
    long as the frame has less regular solutions, since four-bars that fold move without their coupler."""
    shape: complex = 0.5 + 0.75**0.5 * 1j
    """Of Stephenson's: the other arm from the same pin, by this one; by default all sides are equal."""
    start_solutions: int = START_SOLUTIONS
    """Of eleven pairs, which leave arm and shape no choice: how many of the generic solutions are followed."""

    def __post_init__(self) -> None:
        """Refuse what there is not."""
        if self.family not in LOOPS:
            raise SynthesisError(
                "six-bars coordinate angles as {known}, not as {found!r}", known=", ".join(LOOPS), found=self.family
            )
        for name, length in (("arm", self.arm), ("shape", abs(self.shape))):
            if not 0 < length < np.inf:
                raise SynthesisError("{key}: expected a positive length, but found {value:g}", key=name, value=length)
        as_start_solutions(self.start_solutions)


def synthesise_six_bars(
    task: FunctionTask,
    demands: Demands | None = None,
    *,
    kind: SixBarType | None = None,
    threads: int | None = None,
    executor: Executor | Callable[[], Executor] | None = None,
    progress: Progress | None = None,
) -> SynthesisResult:
    """All six-bars that coordinate eight pairs of angles, or nine (Watt II), some for eleven; their starts are free.

    Args:
        task: pairs of angles. Eight leave one length free, which is given.
        demands: what a design has to do besides.
        kind: of eight pairs: the type, and the arm that is given; Watt II with an arm of 0.8 frames by default. Of
            eleven pairs: a type of Stephenson's, and how many solutions are followed.
        threads: that follow paths.
        executor: of eleven pairs: what follows random six-bars to know more start solutions; the answer is the same.
        progress: called with the paths followed and their number; of the first eight pairs of a type at first with the
            ends of ways that are known and about how many there are; of eleven with the start solutions that are known.

    Returns:
        `SynthesisResult`: the designs that keep their assembly mode through all pairs, judged by their motion. The
        frame of the first loop is 1; the second four-bar of Watt II has any size and place, and gets the size of
        the first on the same line. Of a function, one that cannot go through its interval is rejected. The notes say
        how many there are besides, and whether the list is complete; of eleven pairs how many are estimated.

    Raises `SynthesisError` for other tasks. Cost: 25 to 55 s of processor time, of Stephenson's 60 to 100 s, and 10 to
    30 ms for each verdict; the first time that a type meets eight pairs 150 to 600 s more. Of eleven pairs 4 ms
    for each start solution, at first 4 ms more. docs/theory/synthesis-functions.md.
    """
    wanted = demands or Demands()
    if task.output != "angle" or task.start_input or task.start_output:
        raise SynthesisError("six-bars coordinate angles whose starts are free: give only their differences")
    if len(task) not in (8, 9, 11):
        raise SynthesisError(
            "six-bars meet eight, nine or eleven pairs exactly, but the task has {count}", count=len(task)
        )
    if executor is not None and len(task) != 11:
        raise SynthesisError("{name}: only of eleven pairs; of others all solutions are followed", name="executor")
    if len(task) == 9 and kind is not None:
        raise SynthesisError("nine pairs leave nothing of a six-bar free; give its type and an arm with eight pairs")
    of = kind or SixBarType()
    wanted = wanted.of_task(task, _six_bar(of.family).chain.links)
    phi, output = (values - values[0] for values in pair_arrays(task))
    pairs = len(task) - 1
    p = np.zeros((4, max(8, pairs)), np.complex128)
    p[0, :pairs], p[1, :pairs] = np.exp(1j * phi[1:]), np.exp(1j * output[1:])
    if pairs == 8:
        problem, base, known, damaged = NINE_PAIRS, load_generic_solutions(NINE_PAIRS), [], None
    elif pairs == 10:
        if of.family not in ELEVEN or (of.arm, of.shape) != (SixBarType.arm, SixBarType.shape):
            raise SynthesisError(
                "eleven pairs need a type, {types}, and leave no arm or shape to choose",
                types=joined_by_or(list(ELEVEN)),
            )
        census = kept_census(
            ELEVEN[of.family], of.start_solutions, threads=threads, executor=executor, progress=progress
        )
        problem, base = census.problem, GenericSolutions(census.task, census.z[: of.start_solutions])
        known, damaged = [how_many(message("eleven pairs"), census)], census.damaged
    else:
        problem, starts = eight_pairs(of.family), start_set(of.family, threads=threads, progress=progress)
        base, known = GenericSolutions(starts.parameters, starts.z), [_how_complete(of.family, starts)]
        damaged = starts.damaged
        p[3] = of.arm**2, 1, of.shape, np.conj(of.shape), 0, 0, 0, 0
    z = six_bar_solutions(problem, base, p, threads=threads, progress=progress)
    real = real_solutions(z)
    turns = np.exp(1j * np.stack([phi, output], axis=1))
    kept = keeps_modes(of, real, turns) if wanted.one_branch else np.ones(len(real), bool)
    judged = (_judged(task, wanted, of, vectors, turns) for vectors in real[kept])
    accepted, rejected = ranked(over_interval(design, task) for design in judged)
    if task.law is not None:
        accepted = in_order_of(accepted, ["error"])
    notes = [*known, *how_followed(len(base.z), len(z), kept, damaged)]
    count = SolutionCount(what=message("linkages"), theorem=0, found=len(z), real=len(real))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def how_followed(starts: int, arrived: int, kept: Flags, damaged: Path | None) -> list[Message]:
    """What became of start solutions: so many were followed to the task; which of the real ones keep their modes."""
    notes = [
        message(
            "Of {classes:,} start solutions {found:,} were followed to the task, {real:,} of them real six-bars. The "
            "others lie at infinity or were lost.",
            classes=starts,
            found=arrived,
            real=len(kept),
        )
    ]
    if damaged is not None:
        notes.insert(0, message("{file} was damaged: the search for start solutions began anew.", file=damaged))
    if not kept.all():
        notes.append(
            message(
                "Real ones that are not listed, since a part of them changes its assembly mode between the targets: "
                "{count:,}.",
                count=int(np.count_nonzero(~kept)),
            )
        )
    return notes


def _how_complete(family: str, starts: StartSet) -> Message:
    """What the trace test says of a start set."""
    return message(
        "{family}, eight pairs: {listed:,} complex solutions in a general plane, as many in each of four tasks; the "
        "trace test leaves {residual:.0e} of the change of their sum. All are known. With the length of the arm given "
        "{finite:,} stay finite."
        if starts.complete
        else "{family}, eight pairs: {listed:,} complex solutions in a general plane are known; the trace test "
        "leaves {residual:.0e} of the change of their sum. Some may be missing. With the length of the arm given "
        "{finite:,} stay finite.",
        family=family,
        listed=starts.listed,
        residual=starts.residual,
        finite=len(starts.z),
    )


def how_many(targets: Message, census: Census) -> Message:
    """What a census, or a list, says of all solutions."""
    if census.problem.classes:
        return message(
            "{family}, {targets}: {known:,} complex solutions are known, of {classes:,} that were listed by monodromy. "
            "The others are not sought.",
            family=census.problem.family,
            targets=targets,
            known=len(census.z),
            classes=census.problem.classes,
        )
    estimate = census.estimate()
    return message(
        "{family}, {targets}: {known:,} complex solutions are known, of an estimated {number:,.0f} (95 %: "
        "{least:,.0f} to {most:,.0f}, from how often {count:,} six-bars made at random led to the same one). The "
        "others are not sought.",
        family=census.problem.family,
        targets=targets,
        known=len(census.z),
        count=census.count,
        number=estimate.number,
        least=estimate.least,
        most=estimate.most,
    )


def six_bar_solutions(
    problem: Problem,
    base: GenericSolutions,
    p: Complexes,
    *,
    special: float = _SPECIAL,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Complexes:
    """The regular complex solutions of a task, complex[4, unknowns] as `_core.track` takes it; (found, unknowns).

    Paths that fail or end alike are followed again with fine steps, then along a way that is bent. Where more than a
    part of them does, the task is a special one, and only the bent way is tried, and only if a few find more on it.
    """
    ends, status = follow_from_generic(problem, base.z, base.parameters, p, QUICK, threads=threads, progress=progress)

    def lost() -> Flags:
        good = status == ARRIVED
        good[good] = sharpened(problem, ends[good].copy(), p)
        return np.asarray(~good | repeated(problem, ends, good))

    again = lost()
    loose = CAREFUL if again.mean() <= special else QUICK  # fine steps would follow singular ends without an end
    if loose == CAREFUL:
        ends[again], status[again] = follow_from_generic(
            problem, base.z[again], base.parameters, p, loose, threads=threads
        )
        again = lost()
    rng = np.random.default_rng(9)  # fixed: the same task has the same answer
    aside = rng.normal(size=p.shape) + 1j * rng.normal(size=p.shape)
    middle = (base.parameters + p) / 2 + _BENT * np.where(p == 0, 0, aside)

    def with_bent(starts: Complexes) -> Complexes:
        halfway, there = follow_from_generic(problem, starts, base.parameters, middle, loose, threads=threads)
        more, arrived = follow_from_generic(problem, halfway[there == ARRIVED], middle, p, loose, threads=threads)
        z = np.concatenate([ends[~again], more[arrived == ARRIVED]])
        return distinct(problem, z[sharpened(problem, z, p)])

    starts = base.z[again]
    if loose == QUICK and len(starts) > _FEW:
        sample = with_bent(np.ascontiguousarray(starts[:: len(starts) // _FEW]))
        if len(sample) == np.count_nonzero(~again):
            return sample
    return with_bent(starts)


def real_solutions(z: Complexes) -> Complexes:
    """Those whose unknowns are conjugate by twos, without the conjugates; (real, unknowns / 2)."""
    gaps = np.abs(z[:, 1::2] - np.conj(z[:, ::2])).max(axis=1, initial=0.0)
    return np.asarray(z[gaps <= _REAL * (1 + np.abs(z).max(axis=1, initial=0.0))][:, ::2])


def common_turns(loops: Sequence[LoopVectors]) -> Complexes:
    """How the link that both loops share turns from the first pair to each one; (solutions, pairs)."""
    # |w + p T| is that of the first pair: p w* T + its conjugate + k = 0, and the same of the other loop.
    k, m = (
        np.abs(loop.w) ** 2 - np.abs(loop.w[:, :1]) ** 2 - 2 * (loop.arm * np.conj(loop.w[:, :1])).real
        for loop in loops
    )
    own, other = (loop.arm * np.conj(loop.w) for loop in loops)
    with np.errstate(all="ignore"):
        turn = (m * np.conj(own) - k * np.conj(other)) / (own * np.conj(other) - np.conj(own) * other)
    turn[:, 0] = 1
    return np.asarray(turn)


def keeps_modes(kind: SixBarType, vectors: Complexes, turns: Complexes) -> Flags:
    """Whether each six-bar (solutions, vectors) has one assembly mode in all pairs of turns (pairs, 2), input driven.

    The determinant by which the shared link and the output follow the input keeps its sign; if the first loop does not
    see the output, both of its factors do.
    """
    loops = loop_vectors(kind.family, vectors, kind.shape, *turns.T)
    turn = common_turns(loops)
    (first, own), (other, second) = (
        [np.imag(np.conj(loop.w + loop.arm * turn) * part) for part in (loop.arm * turn, loop.by_output)]
        for loop in loops
    )
    signs = [np.sign(first * second - own * other)]
    if not own.any():
        signs = [np.sign(first), np.sign(second)]
    return np.asarray(np.all([(sign == sign[:, :1]).all(axis=1) for sign in signs], axis=0))


_JOINTS = {
    "Watt II": "R(coupler-ternary) R(frame-ternary) R(ternary-link) R(link-rocker)",
    "Stephenson III": "R(coupler-rocker1) R(frame-rocker1) R(coupler-link) R(link-rocker)",
    "Stephenson II": "R(coupler-ternary) R(crank-link) R(link-ternary) R(ternary-rocker)",
}


def _six_bar(family: str) -> Mechanism:
    """The mechanism of a type, its links with names."""
    joints = f"R(frame-crank) R(crank-coupler) {_JOINTS[family]} R(frame-rocker)"
    return Mechanism.parse(f"{joints}; frame=frame; drive=R(frame-crank)")


def drawn_six_bar(kind: SixBarType, vectors: Complexes) -> tuple[Mechanism, Complexes]:
    """The mechanism of a real six-bar (vectors,) and where its joints lie in the first pair."""
    if kind.family == "Watt II":
        a, f, p, q = vectors.tolist()
        own, other = ([1.0, abs(arm), abs(rocker), abs(1 - arm + rocker)] for arm, rocker in ((a, p), (f, q)))
        # The second four-bar is drawn from its own frame, output to ternary rocker, which lies on the first one's line.
        size = float(np.exp(np.mean(np.log(own)) - np.mean(np.log(other))))
        end = 1 + size
        places = [0, a, 1 + p, 1, 1 - size * q, end - size * f, end]
    elif kind.family == "Stephenson III":
        a, f, c, p, *other = vectors.tolist()
        q = other[0] if other else kind.shape * p
        places = [0, a, a + p, 1, a + q, c + f, c]
    else:
        a, b, f, p, *other = vectors.tolist()
        q = other[0] if other else kind.shape * p
        places = [0, a, 1 + f - p, b, 1 + f - q, 1 + f, 1]
    return _six_bar(kind.family), np.array(places, np.complex128)


def _judged(task: FunctionTask, demands: Demands, kind: SixBarType, vectors: Complexes, turns: Complexes) -> Design:
    mechanism, drawn = drawn_six_bar(kind, vectors)
    places: dict[str | int, object] = {k: (z.real, z.imag) for k, z in enumerate(drawn)}
    linkage = Linkage.from_drawing(mechanism, places, unit=task.unit, outputs=["rocker"])
    starts = np.exp(1j * np.array([linkage.required_pose[link].angle for link in ("crank", "rocker")]))
    targets = Targets((Probe(link="crank"), Probe(link="rocker")), starts * turns, 1.0)
    return judge_design(linkage, targets, demands, FORM)
