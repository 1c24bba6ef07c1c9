"""The linkage nearby that misses a function least, and the proof that no other one nearby misses it less.

docs/theory/synthesis-functions.md has the theorem, the method and the meaning of the certificate.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.coordination import Coordination, Minimax, MinimaxCertificate
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.freudenstein import LEAST_NUMBER
from gruebler.design.synthesis.structural_errors import ErrorFamily
from gruebler.mechanics.linkages.branch import branch_of_side

_REGION = 0.1
"""The region for which a certificate says by how much the error may still fall: parts of the numbers, and radians."""
_EQUAL, _STATIONARY, _CONVEX = 1e-6, 1e-7, 1e-6
"""Relative to the error: sizes that are equal, a decrease that is none, a curvature that is positive."""
_LONGEST, _LONG = 1e4, 10
"""Lengths that differ by more than this factor for more steps run away to a linkage of another kind; for fewer they
pass through infinity."""
_DEAD_CENTRE = 1e-2
"""A transmission angle, in radians, at which the error changes too quickly with the lengths for a linear model."""
_NO_LOSS = 1e-10
"""An error larger by this part of it is not larger: Newton's method ends in the conditions, not in the last digit."""
_FEWER = 4
"""Of the samples every so manyth stands in the linear programme, besides all extremes."""


class _Place(NamedTuple):
    """A linkage by its numbers, and what is known of its error."""

    numbers: Reals
    error: float
    x: Reals
    """Its extremes."""
    values: Reals


class _Linear(NamedTuple):
    """The answer of a linear programme: the best step within a region if errors were linear in the numbers."""

    step: Reals
    decrease: float
    """By how much the largest error would fall, as a part of it."""
    weights: Reals
    """(extremes of the place,) the multiplier of each, with the sign of its error."""


class _Model(NamedTuple):
    """The second order of the largest error where some extremes are kept equal."""

    step: Reals
    decrease: float
    residual: float
    curvature: float | None


def minimax(start: Coordination, law: FunctionLaw, *, steps: int = 200) -> Minimax:
    """Make the largest structural error as small as possible, from a linkage nearby, and show that it is.

    The starts that the law gives stay fixed. The certificate of the answer says whether it is a strict local minimum;
    where it is none, why not and by how much the error may still fall.

    Args:
        start: a four-bar or slider-crank that can be assembled over the whole interval.
        law: the function.
        steps: after so many steps the search is given up.

    Raises `SynthesisError` if the start cannot be assembled throughout, and for inverted slider-cranks.
    Cost: 5 ms a step, mostly 5 to 60 steps.

    >>> law = FunctionLaw("log10(x)", interval=(1, 2), input_swing=np.pi / 3, output_swing=np.pi / 3)
    >>> sizes = {"lengths": (3.4, 0.8, 3.5, 1.0), "input_start": 0.9, "output_start": 1.36}
    >>> best = minimax(Coordination("four-bar", **sizes, side=-1), law)
    >>> best.error < best.start_error, best.certificate.optimum, best.certificate.alternations
    (True, True, 6)
    """
    search = _Search(ErrorFamily(start.kind, start.side, law))
    place = search.at(search.family.numbers_of(start))
    if place is None:
        raise SynthesisError("the linkage from which the search is to begin cannot be assembled throughout")
    first = place.error
    place, stopped = search.descend(place, steps)
    place, certificate = search.certify(place, stopped)
    solution = search.family.linkage_of(place.numbers)
    assert solution is not None
    unit = search.family.unit
    return Minimax(solution=solution, error=unit * place.error, start_error=unit * first, certificate=certificate)


def digits_for_error(optimum: Minimax, law: FunctionLaw) -> int:
    """How many digits of the dimensions give the stated error again, to half a unit of its fourth digit.

    >>> law = FunctionLaw("log10(x)", interval=(1, 2), input_swing=np.pi / 3, output_swing=np.pi / 3)
    >>> sizes = {"lengths": (3.4, 0.8, 3.5, 1.0), "input_start": 0.9, "output_start": 1.36}
    >>> digits_for_error(minimax(Coordination("four-bar", **sizes, side=-1), law), law) > 6
    True
    """
    solution = optimum.solution
    family = ErrorFamily(solution.kind, solution.side, law)
    unit = solution.unit
    for digits in range(5, 16):
        rounded = replace(
            solution,
            lengths=tuple(_rounded(length, digits) for length in solution.lengths),
            input_start=float(np.radians(_rounded(np.degrees(solution.input_start), digits))),
            output_start=_rounded(solution.output_start * unit, digits) / unit,
        )
        _, errors = family.extremes(family.numbers_of(rounded))
        error = family.unit * float(np.abs(errors).max(initial=0.0))
        if abs(error - optimum.error) < 5e-5 * optimum.error:
            return digits
    return 16


def _rounded(value: float, digits: int) -> float:
    return float(f"{value:.{digits}g}")


class _Search:
    """Steps by linear programmes, and along the linkages whose largest errors are equal."""

    def __init__(self, family: ErrorFamily) -> None:
        self.family = family
        law = family.law
        self.free = np.array([0, 1, 2] + [3] * (law.input_start is None) + [4] * (law.output_start is None))
        self.fewer = family.samples[::_FEWER]

    def at(self, numbers: Reals) -> _Place | None:
        """The place of these numbers; None where the linkage cannot be assembled throughout."""
        x, values = self.family.extremes(numbers)
        if not len(x) or self.family.linkage_of(numbers) is None:
            return None
        return _Place(numbers, float(np.abs(values).max()), x, values)

    def moved(self, numbers: Reals, step: Reals) -> Reals:
        """The numbers after a step, given relative to `scale`."""
        moved = numbers.copy()
        moved[self.free] += step * self.scale(numbers)
        return moved

    def scale(self, numbers: Reals) -> Reals:
        """(free,) what steps are relative to: the numbers of the equation themselves, one radian or one travel."""
        return np.asarray(np.append(np.maximum(np.abs(numbers[:3]), LEAST_NUMBER), [1.0, 1.0])[self.free])

    def gradients(self, numbers: Reals, x: Reals, scale: Reals) -> tuple[Reals, Reals]:
        """The errors at some x and (x, free) their derivatives by relative steps."""
        values, slopes = self.family.slopes(numbers, x)
        return values, slopes[:, self.free] * scale

    def descend(self, place: _Place, steps: int) -> tuple[_Place, Message | None]:
        """The place where no step helps any more, and what stopped the search before that."""
        near = along = 0.05
        long = 0
        for _ in range(steps):
            linear = self.linear(place, near)
            if linear is None:
                break
            trial = self.at(self.moved(place.numbers, linear.step))
            near = _region(near, place, trial, linear.decrease)
            trials, model = [trial], self.model(place, linear.weights, along)
            if model is not None:
                trials.append(self.equalised(place, linear.weights, model.step))
                along = _region(along, place, trials[1], model.decrease)
            best = min((t for t in trials if t is not None), key=lambda t: t.error, default=place)
            small = max(linear.decrease, 0 if model is None else model.decrease) < 1e-11
            if best.error < place.error:
                place = best
                long = long + 1 if self.differ(place) else 0
            if small or long > _LONG or max(near, along if model is not None else 0) < 1e-9:
                break
        else:
            return place, message("the search was given up after {steps} steps", steps=steps)
        return place, None

    def differ(self, place: _Place) -> bool:
        """Whether the lengths differ too much."""
        solution = self.family.linkage_of(place.numbers)
        assert solution is not None
        return max(map(abs, solution.lengths)) > _LONGEST * min(self.family.links_of(solution))

    def linear(self, place: _Place, region: float) -> _Linear | None:
        """The best step within a region for errors linear in the numbers; None at a dead centre.

        All is relative to the largest error and to the region, as the tolerances of the solver are absolute.
        """
        from scipy.optimize import linprog

        x = np.concatenate([place.x, self.fewer])
        values, slopes = self.gradients(place.numbers, x, self.scale(place.numbers))
        if not np.isfinite(slopes).all():
            return None
        values, slopes = values / place.error, slopes * (region / place.error)
        free, ones = len(self.free), np.ones((len(x), 1))
        answer = linprog(
            [0] * free + [1],
            A_ub=np.block([[slopes, -ones], [-slopes, -ones]]),
            b_ub=np.concatenate([-values, values]),
            bounds=[(-1, 1)] * free + [(0, None)],
            method="highs",
            options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
        )
        if answer.status != 0:
            return None
        marginals = -answer.ineqlin.marginals
        weights = np.zeros(len(place.x))
        for k in np.flatnonzero(marginals > 1e-9):
            sign = 1 if k < len(x) else -1
            near = np.where(np.sign(place.values) == sign, np.abs(place.x - x[k % len(x)]), np.inf)
            weights[near.argmin()] += sign * marginals[k]
        return _Linear(answer.x[:free] * region, float(1 - answer.x[free]), weights)

    def model(self, place: _Place, weights: Reals, region: float) -> _Model | None:
        """The step to the least value of the second order, among those that make the weighted extremes equal.

        None if more extremes are weighted than a step can make equal, or their curvature cannot be had.
        """
        active = np.flatnonzero(weights)
        scale = self.scale(place.numbers)
        second = self.second_order(place, weights, scale)
        if not 0 < len(active) <= len(self.free) + 1 or second is None:
            return None
        sign, share = np.sign(weights[active]), np.abs(weights[active]) / np.abs(weights).sum()
        values, slopes = self.gradients(place.numbers, place.x[active], scale)
        sizes, slopes, second = sign * values / place.error, sign[:, None] * slopes / place.error, second / place.error
        equal = slopes[1:] - slopes[0]
        to_equal = np.linalg.lstsq(equal, sizes[0] - sizes[1:], rcond=1e-12)[0]
        length = float(np.linalg.norm(to_equal))
        to_equal *= min(1.0, region / max(length, 1e-300))
        _, singular, directions = np.linalg.svd(equal, full_matrices=True)
        rank = int((singular > 1e-10 * max(singular.max(initial=0), 1e-300)).sum())
        along = directions[rank:].T
        slope = share @ slopes
        step = to_equal + along @ _least(along.T @ (slope + second @ to_equal), along.T @ second @ along, region)
        decrease = float(1 - share @ sizes - slope @ step - step @ second @ step / 2)
        curvature = float(np.linalg.eigvalsh(along.T @ second @ along)[0]) if along.shape[1] else None
        return _Model(step, decrease, float(np.abs(slope).sum()), curvature)

    def second_order(self, place: _Place, weights: Reals, scale: Reals) -> Reals | None:
        """(free, free) second derivatives of the weighted sizes of extremes, which move with the numbers.

        Differences of the exact first derivatives; an extreme within the interval stays one, which takes away the
        square of its mixed derivatives by its curvature.
        """
        total = np.abs(weights).sum()
        chosen = np.flatnonzero(weights)
        x, share = place.x[chosen], weights[chosen] / total
        ends, width = self.family.law.interval, 1e-4 * float(np.ptp(self.family.law.interval))
        rows, own = [], 1e-5
        for k in range(len(self.free)):
            step = own * np.eye(len(self.free))[k]
            sides = [self.gradients(self.moved(place.numbers, s), x, scale)[1] for s in (step, -step)]
            rows.append(share @ (sides[0] - sides[1]) / (2 * own))
        second = np.array(rows)
        inside = (x - ends[0] > width) & (ends[1] - x > width)
        before, here, after = (self.gradients(place.numbers, x[inside] + w, scale) for w in (-width, 0, width))
        bends = (after[0] - 2 * here[0] + before[0]) / width**2
        mixed = (after[1] - before[1]) / (2 * width)
        with np.errstate(divide="ignore", invalid="ignore"):
            second = (second + second.T) / 2 - np.einsum("i,ij,ik->jk", share[inside] / bends, mixed, mixed)
        return second if np.isfinite(second).all() else None

    def equalised(self, place: _Place, weights: Reals, step: Reals) -> _Place | None:
        """The best place after a step whose weighted extremes are made equal again by Newton's method.

        First at the former extremes, as a long step may make the error so large that it has fewer of them.
        """
        active = np.flatnonzero(weights)
        sign, scale = np.sign(weights[active]), self.scale(place.numbers)
        numbers = self.moved(place.numbers, step)
        best = trial = self.at(numbers)
        last = max(float(np.linalg.norm(step)), 1e-6)
        for _ in range(8 if len(active) > 1 else 0):
            x = place.x[active]
            if trial is not None and trial.error < 1.5 * place.error:
                gaps = np.abs(trial.x - x[:, None])
                gaps[np.sign(trial.values) != sign[:, None]] = np.inf
                matched = gaps.argmin(axis=1)
                x = trial.x[matched] if len(set(matched)) == len(active) else x
            values, slopes = self.gradients(numbers, x, scale)
            if not (np.isfinite(values).all() and np.isfinite(slopes).all()):
                break
            sizes, slopes = sign * values / place.error, sign[:, None] * slopes / place.error
            change = np.linalg.lstsq(slopes[1:] - slopes[0], sizes[0] - sizes[1:], rcond=1e-12)[0]
            if np.linalg.norm(change) > last:
                break
            last = float(np.linalg.norm(change))
            numbers = numbers.copy()
            numbers[self.free] += change * scale
            trial = self.at(numbers)
            if trial is not None and (best is None or trial.error < best.error * (1 + _NO_LOSS)):
                best = trial
            if last < 1e-12:
                break
        return best

    def certify(self, place: _Place, stopped: Message | None) -> tuple[_Place, MinimaxCertificate]:
        """The place after Newton's method for its conditions, and what shows that it is an optimum, or not."""
        linear = self.linear(place, _REGION)
        model = None if linear is None else self.model(place, linear.weights, _REGION)
        for _ in range(4):
            if linear is None or model is None or linear.decrease < 1e-13:
                break
            after = self.equalised(place, linear.weights, model.step)
            if after is None or after.error > place.error * (1 + _NO_LOSS):
                break
            its = self.linear(after, _REGION)
            if its is None or its.decrease >= linear.decrease:
                break
            place, linear, model = after, its, self.model(after, its.weights, _REGION)
        weights = np.zeros(len(place.x)) if linear is None else np.abs(linear.weights)
        tall = np.flatnonzero((np.abs(place.values) > (1 - _EQUAL) * place.error) | (weights > 0))
        decrease = float("nan") if linear is None else max(linear.decrease, 0.0)
        curvature = None if model is None else model.curvature
        strict = model is not None and (curvature is None or (curvature > _CONVEX and not self.differ(place)))
        stationary = decrease < _STATIONARY
        reason = None if stationary and strict else self.why_not(place, stopped, stationary)
        total = max(float(weights.sum()), 1e-300)
        certificate = MinimaxCertificate(
            x=tuple(float(v) for v in place.x[tall]),
            signs=tuple(int(v) for v in np.sign(place.values[tall])),
            multipliers=tuple(float(v) for v in weights[tall] / total),
            parameters=len(self.free),
            residual=float("nan") if model is None else model.residual,
            decrease=self.family.unit * place.error * decrease,
            curvature=curvature,
            reason=reason,
        )
        return place, certificate

    def why_not(self, place: _Place, stopped: Message | None, stationary: bool) -> Message:
        """What keeps the search from an optimum."""
        if self.differ(place):
            return message("its lengths run away to a linkage of another kind")
        solution = self.family.linkage_of(place.numbers)
        assert solution is not None
        x = np.concatenate([place.x, self.family.samples])
        motion = solution.linkage().motion(self.family.inputs(place.numbers, x), branch=branch_of_side(solution.side))
        if np.nanmin(motion.transmission_angle) < _DEAD_CENTRE:
            return message("it comes to a dead centre")
        if stopped is not None or stationary:
            return stopped or message("the second order does not show that the error rises in every direction")
        return message("no step leads any further")


def _region(region: float, place: _Place, trial: _Place | None, promised: float) -> float:
    """The next region of steps: larger if a step brought what it promised, smaller if it brought little of it."""
    kept = -1.0 if trial is None or promised <= 0 else (1 - trial.error / place.error) / promised
    return min(2 * region, 0.5) if kept > 0.75 else 0.35 * region if kept < 0.25 else region


def _least(slope: Reals, second: Reals, region: float) -> Reals:
    """The least value of slope y + y second y / 2 with |y| <= region: a trust region, by the eigenvectors."""
    if not len(slope):
        return slope
    curvatures, vectors = np.linalg.eigh(second)
    parts = vectors.T @ slope
    if curvatures[0] > 0 and np.linalg.norm(parts / curvatures) <= region:
        return np.asarray(-vectors @ (parts / curvatures))
    low: float = max(0.0, -float(curvatures[0])) * (1 + 1e-12) + 1e-12
    high = low + float(np.linalg.norm(parts)) / region
    if np.linalg.norm(parts / (curvatures + low)) < region:  # nothing leads along the direction of least curvature
        least = -parts / (curvatures + low)
        least[0] += np.sqrt(max(region**2 - float(least @ least), 0.0))
        return np.asarray(vectors @ least)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if np.linalg.norm(parts / (curvatures + middle)) > region else (low, middle)
    return np.asarray(-vectors @ (parts / (curvatures + high)))
