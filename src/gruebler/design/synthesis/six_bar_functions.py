"""Function generation by six-bars: every six-bar of Watt's second kind that coordinates nine pairs of angles.

Two four-bars one behind the other share a ternary rocker. Generic solutions were listed by monodromy
(`python -m benchmarks.six_bars`) and are data of the package; they are followed to a task.
docs/theory/synthesis-functions.md.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gruebler.base.arrays import Complexes, Flags
from gruebler.base.errors import SynthesisError
from gruebler.base.text import message
from gruebler.design.synthesis.alt_burmester import (
    ARRIVED,
    CAREFUL,
    QUICK,
    Problem,
    distinct,
    follow_from_generic,
    load_generic_solutions,
    repeated,
    sharpened,
)
from gruebler.design.synthesis.coordination import pair_arrays
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.judging import Demands, judge_design
from gruebler.design.synthesis.positions import ranked
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, in_order_of
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import FunctionTask
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

NINE_PAIRS = Problem(name="nine pairs", poses=0, points=8, classes=26370, members=1, family="Watt II")
"""At least so many complex six-bars turn through nine general pairs."""
FORM = "six-bar"
_JOINTS = "R(frame-crank) R(crank-coupler) R(coupler-ternary) R(frame-ternary) R(ternary-link) R(link-rocker)"
_MECHANISM = f"{_JOINTS} R(frame-rocker); frame=frame; drive=R(frame-crank)"
_REAL = 1e-7  # relative: conjugate unknowns that differ by less are conjugate
_PLACES = 400  # where the error of a function is looked at
_BENT = 0.1  # how far a way leads aside for what was lost on the straight one, relative to the task


def synthesise_six_bars(
    task: FunctionTask,
    demands: Demands | None = None,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> SynthesisResult:
    """All six-bars of Watt's second kind that coordinate nine pairs of angles, whose starts are free.

    Args:
        task: nine pairs of angles.
        demands: what a design has to do besides.
        threads: that follow paths.
        progress: called with the paths followed and their number.

    Returns:
        `SynthesisResult`: the designs whose two four-bars keep their assembly modes through all pairs, judged by their
        motion. The frame of the first four-bar is 1; the second four-bar has any size and place, and gets the size of
        the first on the same line. Of a function the error is the largest over its interval, seen at 400 places. The
        notes say how many there are besides.

    Raises `SynthesisError` for other tasks. Cost: 25 to 55 s of processor time, and 10 to 30 ms for each verdict.
    docs/theory/synthesis-functions.md.
    """
    wanted = demands or Demands()
    if task.output != "angle" or task.start_input or task.start_output:
        raise SynthesisError("six-bars coordinate angles whose starts are free: give only their differences")
    if len(task) != NINE_PAIRS.points + 1:
        raise SynthesisError("six-bars meet nine pairs exactly, but the task has {count}", count=len(task))
    phi, output = (values - values[0] for values in pair_arrays(task))
    p = np.zeros((4, 8), np.complex128)
    p[0], p[1] = np.exp(1j * phi[1:]), np.exp(1j * output[1:])
    z = six_bar_solutions(p, threads=threads, progress=progress)
    real = z[np.abs(z[:, 1::2] - np.conj(z[:, ::2])).max(axis=1) <= _REAL * (1 + np.abs(z).max(axis=1))][:, ::2]
    kept = keeps_modes(real, p) if wanted.one_branch else np.ones(len(real), bool)
    turns = np.exp(1j * np.stack([phi, output], axis=1))
    accepted, rejected = ranked([_judged(task, wanted, arms, turns) for arms in real[kept]])
    if task.law is not None:
        accepted = in_order_of((_with_error_between(design, task, task.law) for design in accepted), ["error"])
    notes = [
        message(
            "At least {classes:,} complex six-bars turn through nine general pairs; {found:,} were followed to these, "
            "{real:,} of them real. The others lie at infinity or were lost.",
            classes=NINE_PAIRS.classes,
            found=len(z),
            real=len(real),
        )
    ]
    if not kept.all():
        notes.append(
            message(
                "Real ones that are not listed, since one of their four-bars changes its assembly mode between the "
                "pairs: {count:,}.",
                count=int(np.count_nonzero(~kept)),
            )
        )
    count = SolutionCount(what=message("linkages"), theorem=0, found=len(z), real=len(real))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def six_bar_solutions(p: Complexes, *, threads: int | None = None, progress: Progress | None = None) -> Complexes:
    """The regular complex solutions of a task, complex[4, 8] as `_core.track` takes it; (found, 8).

    Paths that fail or end alike are followed again with fine steps, then along a way that is bent.
    """
    problem, base = NINE_PAIRS, load_generic_solutions(NINE_PAIRS)
    ends, status = follow_from_generic(problem, base.z, base.parameters, p, QUICK, threads=threads, progress=progress)

    def lost() -> Flags:
        good = status == ARRIVED
        good[good] = sharpened(problem, ends[good].copy(), p)
        return np.asarray(~good | repeated(problem, ends, good))

    again = lost()
    ends[again], status[again] = follow_from_generic(
        problem, base.z[again], base.parameters, p, CAREFUL, threads=threads
    )
    again = lost()
    rng = np.random.default_rng(9)  # fixed: the same task has the same answer
    aside = rng.normal(size=p.shape) + 1j * rng.normal(size=p.shape)
    middle = (base.parameters + p) / 2 + _BENT * np.where(p == 0, 0, aside)
    halfway, there = follow_from_generic(problem, base.z[again], base.parameters, middle, CAREFUL, threads=threads)
    more, arrived = follow_from_generic(problem, halfway[there == ARRIVED], middle, p, CAREFUL, threads=threads)
    z = np.concatenate([ends[~again], more[arrived == ARRIVED]])
    return distinct(problem, z[sharpened(problem, z, p)])


def common_turns(arms: Complexes, p: Complexes) -> Complexes:
    """How the ternary rocker turns from the first pair to each of the nine; (solutions, 9)."""
    a, f, first, second = arms.T[:, :, None]
    inputs, outputs = (np.concatenate([[1], row]) for row in p[:2])
    w, v = 1 - a * inputs, 1 - f * outputs
    # |w + p T| is that of the first pair: p w* T + its conjugate + k = 0, and the same of the other four-bar.
    k, m = (
        np.abs(now) ** 2 - np.abs(now[:, :1]) ** 2 - 2 * (arm * np.conj(now[:, :1])).real
        for now, arm in ((w, first), (v, second))
    )
    own, other = first * np.conj(w), second * np.conj(v)
    with np.errstate(all="ignore"):
        turn = (m * np.conj(own) - k * np.conj(other)) / (own * np.conj(other) - np.conj(own) * other)
    turn[:, 0] = 1
    return np.asarray(turn)


def keeps_modes(arms: Complexes, p: Complexes) -> Flags:
    """Whether both four-bars of each solution have one assembly mode in all pairs, the crank and the rocker driven."""
    a, f, first, second = arms.T[:, :, None]
    turn = common_turns(arms, p)
    inputs, outputs = (np.concatenate([[1], row]) for row in p[:2])
    signs = [
        np.sign((np.conj(1 - a * inputs) * first * turn).imag),
        np.sign((np.conj(1 + second * turn) * f * outputs).imag),
    ]
    return np.asarray(np.all([(sign == sign[:, :1]).all(axis=1) for sign in signs], axis=0))


def _judged(task: FunctionTask, demands: Demands, arms: Complexes, turns: Complexes) -> Design:
    a, f, p, q = arms.tolist()
    own, other = ([1.0, abs(arm), abs(rocker), abs(1 - arm + rocker)] for arm, rocker in ((a, p), (f, q)))
    # The second four-bar is drawn from its own frame, output to ternary rocker, which lies on the first one's line.
    size = float(np.exp(np.mean(np.log(own)) - np.mean(np.log(other))))
    end = 1 + size
    drawn = {
        "R(frame-crank)": 0j,
        "R(crank-coupler)": a,
        "R(coupler-ternary)": 1 + p,
        "R(frame-ternary)": 1 + 0j,
        "R(ternary-link)": 1 - size * q,
        "R(link-rocker)": end - size * f,
        "R(frame-rocker)": end + 0j,
    }
    places: dict[str | int, object] = {name: (z.real, z.imag) for name, z in drawn.items()}
    mechanism = Mechanism.parse(_MECHANISM)
    linkage = Linkage.from_drawing(mechanism, places, unit=task.unit, outputs=["rocker"])
    starts = np.exp(1j * np.array([linkage.required_pose[link].angle for link in ("crank", "rocker")]))
    targets = Targets((Probe(link="crank"), Probe(link="rocker")), starts * turns, 1.0)
    return judge_design(linkage, targets, demands, FORM)


def _with_error_between(design: Design, task: FunctionTask, law: FunctionLaw) -> Design:
    """With the largest error over the interval of the function, by motion; inf if it is not followed there."""
    x = np.linspace(*law.interval, _PLACES)
    inputs, outputs = law.inputs(x) - task.inputs[0], law.outputs(x) - task.outputs[0]
    motion = move_quietly(design.linkage, design.drives[0] + np.concatenate([[0.0], inputs]))
    error = np.inf
    if motion.complete:
        turned = motion.angle("rocker")
        error = float(np.abs(turned[1:] - turned[0] - outputs).max())
    return replace(design, verdict=replace(design.verdict, error=error))
