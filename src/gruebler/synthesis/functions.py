"""Function generation: four-bars, slider-cranks and inverted slider-cranks that coordinate input and output.

docs/theory/synthesis-functions.md: each kind of linkage is linear in as many numbers of its own; every start angle that
is free adds one pair and makes the condition quadratic; with both free the problem is that of guiding the output link
as seen from the crank.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gruebler.arrays import Reals
from gruebler.errors import LinkageError, SynthesisError
from gruebler.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.linkages import Linkage
from gruebler.mechanism import Mechanism
from gruebler.synthesis.dyads import GuidingDyad
from gruebler.synthesis.formulas import FunctionLaw, chebyshev_spacing
from gruebler.synthesis.judging import Demands, Probe, Targets, judge_design
from gruebler.synthesis.positions import guiding_dyads, ranked
from gruebler.synthesis.results import Design, SolutionCount, SynthesisResult
from gruebler.synthesis.tasks import FunctionTask, PositionTask
from gruebler.text import message

__all__ = ["Coordination", "coordination_of", "function_task", "minimax", "structural_error", "synthesise_function"]


_SMALL = 1e-9  # a length smaller than this part of the frame (or of the travel) is none


class Coordination(NamedTuple):
    """A linkage by its lengths, and where its input and output begin."""

    kind: str
    """``four-bar``, ``slider-crank`` or ``inverted-slider-crank``."""
    lengths: tuple[float, ...]
    """a, b, c, d; a, b, e; a, d, e. Lengths of links are positive."""
    input_start: float
    """The crank angle of the first pair."""
    output_start: float
    """The angle or travel of the output in the first pair."""
    branch: int
    """The assembly branch of the first pair."""

    def linkage(self) -> FourBar | SliderCrank | InvertedSliderCrank:
        """The linkage by its usual lengths."""
        made = {"four-bar": FourBar, "slider-crank": SliderCrank, "inverted-slider-crank": InvertedSliderCrank}
        return made[self.kind](*self.lengths)  # type: ignore[no-any-return]


@dataclass(frozen=True)
class _Kind:
    """A kind of linkage: linear conditions in some numbers of its own."""

    name: str
    output: str
    unknowns: int
    columns: Callable[[Reals, Reals], Reals]
    """(pairs, unknowns + 1): the conditions say that a combination of the first columns is the last one."""
    lengths: Callable[[Reals], tuple[float, ...] | None]
    """From the factors of that combination to signed lengths."""
    input_degree: int = 2
    """In how many columns the input enters: the degree of the condition for a free input start."""


def _four_bar_columns(phi: Reals, psi: Reals) -> Reals:
    return np.stack([np.cos(psi), -np.cos(phi), np.ones_like(phi), np.cos(phi - psi)], axis=1)


def _four_bar_lengths(k: Reals) -> tuple[float, ...] | None:
    if min(abs(k[0]), abs(k[1])) < _SMALL or max(abs(k[0]), abs(k[1])) > 1 / _SMALL:
        return None
    a, c = 1 / k[0], 1 / k[1]
    square = a * a + c * c + 1 - 2 * a * c * k[2]
    return (a, float(np.sqrt(square)), c, 1.0) if square > _SMALL**2 else None


def _slider_columns(phi: Reals, s: Reals) -> Reals:
    return np.stack([s * np.cos(phi), np.sin(phi), np.ones_like(phi), s * s], axis=1)


def _slider_lengths(k: Reals) -> tuple[float, ...] | None:
    if abs(k[0]) < _SMALL:
        return None
    a = k[0] / 2
    e = k[1] / k[0]
    square = k[2] + a * a + e * e
    return (a, float(np.sqrt(square)), e) if square > 0 else None


def _inverted_columns(phi: Reals, psi: Reals) -> Reals:
    return np.stack([np.sin(phi - psi), np.ones_like(phi), -np.sin(psi)], axis=1)


def _inverted_lengths(k: Reals) -> tuple[float, ...] | None:
    return (k[0], 1.0, k[1]) if abs(k[0]) > _SMALL else None


_KINDS = (
    _Kind("four-bar", "angle", 3, _four_bar_columns, _four_bar_lengths),
    _Kind("slider-crank", "travel", 3, _slider_columns, _slider_lengths),
    _Kind("inverted-slider-crank", "angle", 2, _inverted_columns, _inverted_lengths, 1),
)


def function_task(law: FunctionLaw, count: int, *, output: str = "angle", unit: str = "mm") -> FunctionTask:
    """The precision pairs of a function at Chebyshev's spacing.

    >>> function_task(FunctionLaw("log10(x)", (1, 2), 1.0, 1.0, 0.8, 0.9), 3).inputs
    (0.866987..., 1.3, 1.733012...)
    """
    if count < 2:
        raise SynthesisError("a function needs at least two precision points, not {count}", count=count)
    x = chebyshev_spacing(*law.interval, count)
    return FunctionTask(
        tuple(law.inputs(x).tolist()),
        tuple(law.outputs(x).tolist()),
        output,
        law.input_start is not None,
        law.output_start is not None,
        unit,
    )


def synthesise_function(task: FunctionTask, demands: Demands | None = None, *, number: int = 16) -> SynthesisResult:
    """All linkages that coordinate the pairs; the frame of four-bars has the length 1.

    Args:
        task: two to five pairs.
        demands: besides one branch and the order.
        number: of dyads taken where there are infinitely many.

    Raises `SynthesisError` for more pairs than can be met exactly (`minimax` meets a function as well as possible).
    Cost: below 1 ms and 10 ms for each verdict.

    >>> task = FunctionTask([0.8, 1.2, 1.7], [0.9, 1.1, 1.5])
    >>> found = synthesise_function(task)
    >>> found.count.found, found.count.theorem
    (1, 1)
    """
    wanted = demands or Demands()
    free = (not task.start_input) + (not task.start_output)
    made, notes = [], []
    theorem: int | None = 0
    found = real = 0
    for kind in (kind for kind in _KINDS if kind.output == task.output):
        if len(task) > kind.unknowns + free:
            continue
        if len(task) == kind.unknowns + free and free < 2:
            solutions = _one_free(kind, task) if free else _none_free(kind, task)
            theorem = theorem if theorem is None else theorem + (solutions.complex if free else 1)
            found, real = found + solutions.complex, real + len(solutions.real)
            made += [_design(task, wanted, solution) for solution in solutions.real]
    if free == 2:
        dyads = _connecting(task, number)
        real = len(dyads)
        theorem = 3 if len(task) == 5 else None  # four dyads less the frame
        found = 3 if len(task) == 5 else len(dyads)
        made += [design for dyad in dyads if (design := _connected(task, wanted, dyad)) is not None]
        if len(task) < 5:
            notes.append(
                message(
                    "There are infinitely many solutions, one for each point of a curve; {count} were taken.",
                    count=len(dyads),
                )
            )
    elif not made and not theorem:
        most = 3 + free
        if len(task) > most:
            raise SynthesisError(
                "{count} pairs cannot be met exactly, at most {most} with this many free starts ({free}): free a start "
                "(start_input or start_output = false) or ask for the minimax optimum",
                count=len(task),
                free=free,
                most=most,
            )
        notes.append(message("There are infinitely many solutions: give more pairs."))
        theorem = None
    designs, rejected = ranked(made)
    count = SolutionCount(message("linkages"), theorem, found, real)
    return SynthesisResult(task, designs, rejected, count, tuple(notes))


class _Solutions(NamedTuple):
    real: tuple[Coordination, ...]
    complex: int


def _arrays(task: FunctionTask) -> tuple[Reals, Reals]:
    return np.array(task.inputs), np.array(task.outputs)


def _none_free(kind: _Kind, task: FunctionTask) -> _Solutions:
    phi, out = _arrays(task)
    return _Solutions(tuple(_solved(kind, phi, out)), 1)


def _one_free(kind: _Kind, task: FunctionTask) -> _Solutions:
    """One start is free: the determinant of the conditions is a quadratic in its tangent, or in the travel itself."""
    phi, out = _arrays(task)
    travel = kind.output == "travel" and not task.start_output

    def shifted(start: float) -> tuple[Reals, Reals]:
        return (phi, out + start) if task.start_input else (phi + start, out)

    if travel:
        size = float(np.ptp(out)) or 1.0
        at = size * np.array([-1.0, 0.0, 1.0])

        def plain(start: float) -> float:
            return float(np.linalg.det(kind.columns(*shifted(start)) / np.array([size, 1, 1, size**2])))

        starts = np.roots(np.polyfit(at, [plain(v) for v in at], 2))
    elif not task.start_input and kind.input_degree == 1:
        one, other = (np.linalg.det(kind.columns(*shifted(v))) for v in (0.0, np.pi / 2))
        starts = np.array([np.arctan2(-one, other)])
    else:
        # A quadratic form in cosine and sine of the start: constant, cos 2t, sin 2t, from three values.
        angles = np.pi * np.arange(3) / 3
        values = np.array([np.linalg.det(kind.columns(*shifted(v))) for v in angles])
        mean, c, s = np.linalg.solve(np.stack([np.ones(3), np.cos(2 * angles), np.sin(2 * angles)], axis=1), values)
        reach = np.hypot(c, s)
        if reach < 1e-14 * abs(mean):
            return _Solutions((), 0)
        if abs(mean) > reach * (1 + 1e-10):  # less is a double root with rounding
            return _Solutions((), 2)
        middle, half = np.arctan2(s, c), np.arccos(np.clip(-mean / reach, -1, 1))
        starts = np.array([(middle + half) / 2, (middle - half) / 2])
    real = []
    for start in starts:
        if abs(start.imag) < 1e-9 * (1 + abs(start)):
            real += _solved(kind, *shifted(float(start.real)))
    return _Solutions(tuple(real), len(starts))


def _solved(kind: _Kind, phi: Reals, out: Reals) -> list[Coordination]:
    """The linkage of these pairs, negative lengths turned round; none if a length is zero or not real."""
    columns = kind.columns(phi, out)
    scale = np.abs(columns).max(axis=0).clip(1e-300)
    factors, *_ = np.linalg.lstsq(columns[:, :-1] / scale[:-1], columns[:, -1], rcond=1e-14)
    if np.abs(columns[:, :-1] / scale[:-1] @ factors - columns[:, -1]).max() > 1e-8 * scale[-1]:
        return []
    signed = kind.lengths(factors / scale[:-1])
    if signed is None:
        return []
    return [_coordination(kind.name, signed, float(phi[0]), float(out[0]))]


def _coordination(kind: str, signed: tuple[float, ...], phi: float, out: float) -> Coordination:
    a = signed[0]
    crank = phi + (np.pi if a < 0 else 0.0)
    point = a * np.exp(1j * phi)
    if kind == "four-bar":
        b, c, d = signed[1:]
        rocker = out + (np.pi if c < 0 else 0.0)
        gap = d + c * np.exp(1j * out) - point
        branch = 1 if np.imag(np.conj(d - point) * gap) >= 0 else -1
        return Coordination(kind, (abs(a), b, abs(c), d), crank, rocker, branch)
    if kind == "slider-crank":
        branch = 1 if out - point.real >= 0 else -1
        return Coordination(kind, (abs(a), signed[1], signed[2]), crank, out, branch)
    # The guide has the direction psi; B0 lies on it towards the block for branch +1.
    d, e = signed[1:]
    way = float(np.real((d - point) * np.exp(-1j * out)))
    return Coordination(kind, (abs(a), d, e), crank, out, 1 if way >= 0 else -1)


def _design(task: FunctionTask, demands: Demands, solution: Coordination) -> Design:
    dyads = _own_dyads(solution)
    return _judged_function(task, demands, *dyads, solution.kind)


def _own_dyads(solution: Coordination) -> tuple[complex, complex, GuidingDyad]:
    """Crank pivot A and, for the output, its pivot (or a point of the slide), and the dyad between crank and output."""
    start = complex(np.exp(1j * solution.input_start))
    point = solution.lengths[0] * start
    if solution.kind == "four-bar":
        _, _, c, d = solution.lengths
        far = d + c * complex(np.exp(1j * solution.output_start))
        return 0j, complex(d), GuidingDyad("RR", far, point)
    if solution.kind == "slider-crank":
        far = complex(solution.output_start, solution.lengths[2])
        return 0j, far, GuidingDyad("RR", far, point)
    direction = complex(np.exp(1j * solution.output_start))
    return 0j, complex(solution.lengths[1]), GuidingDyad("RP", point, point, direction)


def _seen_from_crank(task: FunctionTask) -> PositionTask:
    """The positions of the output link as seen from the crank, in its first position; frame 0 and 1, or the travel."""
    phi, out = _arrays(task)
    turned, moved = np.exp(-1j * (phi - phi[0])), out - out[0]
    if task.output == "angle":
        q, t = turned * np.exp(1j * moved), turned * (1 - np.exp(1j * moved))
    else:
        q, t = turned, turned * moved
    angles = np.unwrap(np.angle(q))
    return PositionTask(tuple((z.real, z.imag, a) for z, a in zip(t, angles, strict=True)))


def _connecting(task: FunctionTask, number: int) -> list[GuidingDyad]:
    """The dyads between crank and output, without the frame, which connects them too."""
    seen = _seen_from_crank(task)
    size = 1.0 if task.output == "angle" else seen.size
    out = []
    for dyad in guiding_dyads(seen, number):
        if task.output == "angle" and dyad.form == "RR":
            frame = abs(dyad.moving - 1) + abs(dyad.fixed) < 1e-6
        else:
            frame = task.output == "travel" and dyad.form == "RP" and abs(dyad.fixed) < 1e-6 * size
        if not frame:
            out.append(dyad)
    return out


def _connected(task: FunctionTask, demands: Demands, dyad: GuidingDyad) -> Design | None:
    far = 1 + 0j if task.output == "angle" else dyad.moving
    try:
        return _judged_function(task, demands, 0j, far, dyad, dyad.form)
    except LinkageError:
        return None


def _judged_function(
    task: FunctionTask, demands: Demands, near: complex, far: complex, dyad: GuidingDyad, form: str
) -> Design:
    """The linkage of crank, coupling dyad and output in its first position, judged."""
    side = "rocker" if task.output == "angle" else "slider"
    parts: list[str] = []
    places: dict[str | int, object] = {}

    def joint(kind: str, a: str, b: str, at: complex, direction: complex = 1 + 0j) -> None:
        name = f"{kind}({a}-{b})"
        parts.append(name)
        angle = (float(np.angle(direction)),) if kind == "P" else ()
        places[name] = (at.real, at.imag, *angle)

    joint("R", "frame", "crank", near)
    joint(dyad.form[0], "crank", "coupler", dyad.moving if dyad.form == "PR" else dyad.fixed, dyad.direction)
    joint(dyad.form[1], "coupler", side, dyad.fixed if dyad.form == "RP" else dyad.moving, dyad.direction)
    joint("R" if side == "rocker" else "P", "frame", side, far)
    mechanism = Mechanism.parse(f"{' '.join(parts)}; frame=frame; drive={parts[0]}")
    linkage = Linkage.from_drawing(mechanism, places, unit=task.unit, outputs=[side])
    return judge_design(linkage, _function_targets(task, linkage, side), demands, form)


def _function_targets(task: FunctionTask, linkage: Linkage, side: str) -> Targets:
    assert linkage.reference_pose is not None
    phi, out = _arrays(task)
    phi, out = phi - phi[0], out - out[0]
    crank = np.exp(1j * (linkage.reference_pose["crank"].angle + phi))
    if side == "rocker":
        rocker = np.exp(1j * (linkage.reference_pose["rocker"].angle + out))
        return Targets((Probe(link="crank"), Probe(link="rocker")), np.stack([crank, rocker], axis=1), 1.0)
    size = float(np.ptp(out)) or 1.0
    probes = (Probe(link="crank", length=size), Probe(joint=3))
    return Targets(probes, np.stack([size * crank, out.astype(np.complex128)], axis=1), size)


def coordination_of(design: Design, task: FunctionTask, law: FunctionLaw) -> Coordination | None:
    """The lengths and starts of a four-bar or slider-crank that was made for a function; None for another linkage.

    The starts are those of x at the begin of the interval.
    """
    linkage = design.linkage
    chain, home = linkage.mechanism.chain, linkage.reference_pose
    if home is None or any(joint.pair.name != "revolute" for joint in chain.joints[:3]):
        return None
    places = [
        complex(*home[link].put(*linkage.elements[number, link][:2]))
        for number, link in ((0, "frame"), (0, "crank"), (1, "crank"), (2, "coupler"), (3, "frame"))
    ]
    pivot, pin, far, other = places[0], places[2], places[3], places[4]
    x = chebyshev_spacing(*law.interval, len(task))[:1]
    free = replace(law, input_start=0.0, output_start=0.0)
    crank = float(np.angle(pin - pivot)) - float(free.inputs(x)[0])
    if task.output == "angle":
        lengths = (abs(pin - pivot), abs(far - pin), abs(far - other), abs(other - pivot))
        side = np.imag(np.conj(other - pin) * (far - pin))
        output = float(np.angle((far - other) / (other - pivot))) - float(free.outputs(x)[0])
        return Coordination("four-bar", lengths, crank, output, 1 if side >= 0 else -1)
    output = far.real - float(free.outputs(x)[0])
    lengths_ = (abs(pin - pivot), abs(far - pin), far.imag - pivot.imag)
    return Coordination("slider-crank", lengths_, crank, output, 1 if far.real >= pin.real else -1)


def structural_error(solution: Coordination, law: FunctionLaw, x: ArrayLike) -> Reals:
    """The output of a linkage less the output wanted, over x; angles in radians. NaN where it cannot be assembled.

    The linkage starts as its first precision pair says. Cost: 50 us and 0.1 us a point.
    """
    return _errors(solution, law, np.atleast_1d(np.asarray(x, np.float64)))[0]


def _errors(solution: Coordination, law: FunctionLaw, x: Reals) -> tuple[Reals, Reals]:
    """Errors and their derivatives by the lengths (without d), input start and output start."""
    free_law = replace(law, input_start=0.0, output_start=0.0)
    phi = solution.input_start + free_law.inputs(x)
    wanted = solution.output_start + free_law.outputs(x)
    motion = solution.linkage().motion(phi, branch=solution.branch)
    theta, out = np.asarray(motion.coupler.value), np.asarray(motion.output.value)
    a = solution.lengths[0]
    if solution.kind == "four-bar":
        error = np.angle(np.exp(1j * (out - wanted)))
        c = solution.lengths[2]
        divisor = c * np.sin(out - theta)
        rows = [-np.cos(phi - theta), -np.ones_like(phi), np.cos(out - theta), a * np.sin(phi - theta)]
    else:
        error = out - wanted
        divisor = np.cos(theta)
        rows = [np.cos(phi - theta), np.ones_like(phi), -np.sin(theta), -a * np.sin(phi - theta)]
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = np.stack([*(row / divisor for row in rows), -np.ones_like(phi)], axis=1)
    return error, slopes


class Minimax(NamedTuple):
    """A linkage whose largest structural error is as small as possible nearby."""

    solution: Coordination
    error: float
    """The largest structural error, in radians or the unit of the travel."""
    start_error: float
    """The same of the linkage from which the search began."""


def minimax(start: Coordination, law: FunctionLaw, *, samples: int = 121, steps: int = 60) -> Minimax:
    """Make the largest structural error as small as possible, from a linkage nearby.

    Each step is a linear programme in a region that shrinks when it does not help. The starts that the law gives stay
    fixed. Cost: 5 ms a step. Raises `SynthesisError` if the start cannot be assembled throughout.

    >>> law = FunctionLaw("x**2", (0, 1), np.pi / 2, np.pi / 2)
    >>> begin = Coordination("four-bar", (0.8, 1.1, 0.9, 1.0), 0.5, 0.9, 1)
    >>> best = minimax(begin, law, steps=5)
    >>> best.error < best.start_error
    True
    """
    from scipy.optimize import linprog

    if start.kind == "inverted-slider-crank":
        raise SynthesisError("the minimax optimum is sought of four-bars and slider-cranks")
    k = np.arange(samples)
    low, high = law.interval
    x = (low + high) / 2 - (high - low) / 2 * np.cos(np.pi * k / (samples - 1))  # the ends count

    def worst(solution: Coordination) -> float:
        error = structural_error(solution, law, x)
        return float(np.abs(error).max()) if np.isfinite(error).all() else float("inf")

    best, error = start, worst(start)
    if not np.isfinite(error):
        raise SynthesisError("the linkage from which the search is to begin cannot be assembled throughout")
    first, radius = error, 0.05
    scale = np.array([max(abs(v), 0.1) for v in start.lengths[:3]] + [1.0, 1.0 if start.kind == "four-bar" else 0.1])
    if start.kind == "slider-crank":
        scale[:3] = max(start.lengths[1], abs(law.output_swing))
        scale[4] = abs(law.output_swing)
    held = [law.input_start is not None, law.output_start is not None]
    for _ in range(steps):
        values, slopes = _errors(best, law, x)
        slopes = slopes * scale
        one = np.ones((samples, 1))
        matrix = np.block([[slopes, -one], [-slopes, -one]])
        limits = [(-radius, radius)] * 3 + [(0, 0) if h else (-radius, radius) for h in held] + [(0, None)]
        answer = linprog([0] * 5 + [1], A_ub=matrix, b_ub=np.concatenate([-values, values]), bounds=limits)
        if answer.status != 0:
            break
        moved = _moved(best, answer.x[:5] * scale)
        trial = float("inf") if moved is None else worst(moved)
        if moved is not None and trial < error:
            gained, best, error = error - trial, moved, trial
            radius = min(radius * 1.5, 0.3)
            if gained < 1e-10 * error:
                break
        else:
            radius *= 0.35
            if radius < 1e-10:
                break
    return Minimax(best, error, first)


def _moved(solution: Coordination, step: Reals) -> Coordination | None:
    lengths = [*(v + s for v, s in zip(solution.lengths[:3], step[:3], strict=True)), *solution.lengths[3:]]
    positive: Sequence[float] = lengths if solution.kind == "four-bar" else lengths[:2]
    if min(positive) <= 0:
        return None
    return solution._replace(
        lengths=tuple(float(v) for v in lengths),
        input_start=solution.input_start + float(step[3]),
        output_start=solution.output_start + float(step[4]),
    )
