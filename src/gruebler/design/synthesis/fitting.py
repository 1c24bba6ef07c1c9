"""Dimensions improved for any task by Newton's and by Levenberg and Marquardt's method with exact derivatives.

docs/theory/synthesis-any.md. Each target is compared with one pose; where the pose may move along its freedoms without
any change of the dimensions, that is no error.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis.closure import DesignClosure, PoseDerivatives
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.fit_limits import HELD
from gruebler.design.synthesis.leg_angles import LegAngles
from gruebler.design.synthesis.size_limits import SizeLimits, limits_of_sizes
from gruebler.design.synthesis.target_bands import STAGES, TargetBands, numbers_or
from gruebler.design.synthesis.target_orders import Ranks
from gruebler.design.synthesis.targets import GuidedCurve
from gruebler.design.synthesis.tasks import DeadCentreTask, DwellTask, FunctionTask, PathTask, PositionTask, Task
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.assur import AssurError, decompose
from gruebler.structure.mechanism import Mechanism

_STEPS = 150
_MOTIONS = 4  # of the poses to their targets after each step
_LEAST = 1e-12  # damping of the motion of poses, of their mean square rate: a pose may stand at a dead centre
_FARTHEST = 0.2  # radians or sizes: how far a pose moves at once
_FEW_STEPS = 20  # of least squares, after which Newton's method is tried again
_NEWTON_STEPS = 60
_SHORTEST = 1e-4  # part of a step of Newton's method: if not even so much is good, it is given up
_RANK = 1e-13  # of the largest singular value: smaller ones are rounding
_MET = 1e-26  # sum of squared errors by the squared size of the task: all targets are met
_AT_REST = np.zeros((1, 0))  # no crank angles
_ASIDE = (0.1, 0.01, 1e-3, 1e-5)
"""Radians: a dead centre lies where the output is the same so far before and after it, but for the square of this."""


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class FitTargets:
    """What poses are compared with; what a task does not give is None."""

    size: float
    """Errors are relative to it; an angle counts as an arc of this radius."""
    z: Complexes | None = None
    """(targets,) where a point of a link is wanted; NaN where it is free, as below."""
    angles: Reals | None = None
    """(targets,) the angle of that link up to a constant."""
    inputs: Reals | None = None
    """(targets,) the angle of the driven link up to a constant."""
    outputs: Reals | None = None
    """(targets,) the angle of the output link, or its travel, up to a constant."""
    travel: bool = False
    curve: GuidedCurve = GuidedCurve.NONE
    ranks: Ranks = ()
    bands: TargetBands | None = None
    """How far each may be missed; None if all of them are met alike."""
    legs: LegAngles | None = None
    """What the transmission angle keeps to."""

    @property
    def given(self) -> int:
        """How many numbers are wanted."""
        kinds = (self.z, self.z, self.angles, self.inputs, self.outputs)
        return sum(int(np.count_nonzero(~np.isnan(values))) for values in kinds if values is not None)

    @property
    def closed(self) -> bool:
        """Whether a curve returns to its begin."""
        return self.curve is GuidedCurve.CLOSED

    def __len__(self) -> int:
        return len(next(v for v in (self.z, self.outputs) if v is not None))

    def mirrored(self) -> FitTargets:
        """The targets as a mirror shows them: angles change their sign, the travel does not."""

        def turned(values: Reals | None) -> Reals | None:
            return None if values is None else -values

        return replace(
            self,
            z=None if self.z is None else np.conj(self.z),
            angles=turned(self.angles),
            inputs=turned(self.inputs),
            outputs=self.outputs if self.travel else turned(self.outputs),
        )


def fit_stages(task: Task) -> tuple[FitTargets, ...]:
    """The targets of a task, for fits one after the other.

    Those of dead centres come nearer and nearer; those with bands are first all met alike, then more and more as said.
    """
    if isinstance(task, DeadCentreTask):
        return tuple(fit_targets(task, aside) for aside in _ASIDE)
    targets = fit_targets(task)
    if not isinstance(task, PathTask) or not task.mixed:
        return (targets,)
    bands = TargetBands.of(task, 1.0)
    if bands.exact.all():
        return (replace(targets, bands=replace(bands, hard=1.0)),)
    return (targets, *(replace(targets, bands=replace(bands, hard=hard)) for hard in STAGES))


def fit_targets(task: Task, aside: float = _ASIDE[-1]) -> FitTargets:
    """The targets of a task. A dead centre is one where the output is the same a little before and after it."""
    match task:
        case PositionTask():
            return FitTargets(size=task.size, z=task.origins, angles=task.angles, ranks=task.order)
        case PathTask():
            extent = task.size if task.mixed else float(max(np.ptp(task.z.real), np.ptp(task.z.imag)))
            angles, timing, outputs = (
                numbers_or(values, np.nan, len(task)) if values else None
                for values in (task.angles, task.crank_angles, task.output_angles)
            )
            return FitTargets(
                size=extent,
                z=task.z,
                angles=angles,
                inputs=timing,
                outputs=outputs,
                curve=GuidedCurve.of(task),
                ranks=task.order,
            )
        case FunctionTask():
            outputs = np.array(task.outputs)
            travel = task.output == "travel"
            size = float(np.ptp(outputs)) if travel else 1.0
            return FitTargets(size=size or 1.0, inputs=np.array(task.inputs), outputs=outputs, travel=travel)
        case DeadCentreTask():
            reach = task.swing if task.swing is not None else task.stroke
            assert reach is not None
            inputs = np.array([-aside, aside, task.angle - aside, task.angle + aside])
            outputs = np.array([0.0, 0.0, reach, reach])
            travel = task.swing is None
            return FitTargets(size=reach if travel else 1.0, inputs=inputs, outputs=outputs, travel=travel)
    if isinstance(task, DwellTask):
        raise SynthesisError("a rest is made by a rod on a coupler curve, not by given structures")
    raise SynthesisError(
        "expected a task of positions, points, a function or dead centres, but found {found!r}", found=task
    )


def output_links(mechanism: Mechanism, travel: bool, named: str | None = "") -> tuple[str, ...]:
    """The links whose motion may be an output: those that slide along the frame, or turn about it undriven.

    Where one is named, it may turn off the frame, too.
    """
    frame, driven = mechanism.frame, {link for drive in mechanism.drives for link in drive.between}
    if named and not travel:
        return tuple(link for link in mechanism.chain.links if link != frame and link not in driven)
    held = {
        link
        for joint in mechanism.chain.joints
        if frame in joint.links and (joint.pair.is_sliding if travel else joint.pair.is_turning)
        for link in joint.links
        if travel or link not in driven
    }
    return tuple(link for link in mechanism.chain.links if link in held)


def links_moved_by_all(mechanism: Mechanism) -> tuple[str, ...]:
    """The moving links whose motion needs every link; those of others need a smaller mechanism, and the rest is idle.

    >>> watt = Mechanism.parse("R(0-1) R(0-2) R(2-3) R(3-1) R(0-4) R(4-5) R(5-1); frame=0; drive=R(0-2)")
    >>> links_moved_by_all(watt)
    ('4', '5')
    """
    frame = mechanism.frame
    moving = tuple(link for link in mechanism.chain.links if link != frame)
    try:
        order = decompose(mechanism)
    except AssurError:
        return moving
    if not order.complete or not order.groups:
        return moving
    needed: list[set[int]] = []
    for k, group in enumerate(order.groups):
        needed.append({k}.union(*(needed[before] for before in group.after)))
    last = {
        link for group, own in zip(order.groups, needed, strict=True) if len(own) == len(needed) for link in group.links
    }
    return tuple(link for link in moving if link in last)


def guided_output(linkage: Linkage, link: str) -> tuple[str, ...]:
    """A guided link as the output, where the force to the usual output does not go through its group; else the usual.

    >>> from gruebler.design.realisation import realise
    >>> watt = Mechanism.parse("R(0-1) R(0-2) R(2-3) R(3-1) R(0-4) R(4-5) R(5-1); frame=2; drive=R(0-2)")
    >>> guided_output(realise(watt).linkage, "4")
    ('4',)
    """
    try:
        groups = decompose(linkage.mechanism).groups
    except AssurError:
        return linkage.outputs
    own = next((group.links for group in groups if link in group.links), None)
    return linkage.outputs if own is None or find_output(linkage).link in own else (link,)


@dataclass
class FitState:
    """Dimensions, the poses at all targets, the links that are compared, and what else is free."""

    p: Reals
    _: KW_ONLY
    q: Reals
    """(targets, unknowns)"""
    link: str = ""
    """The link that carries the point."""
    crank: str = ""
    output: str = ""
    slide: tuple[int, str] = (-1, "")
    """The slide of an output that travels: joint and frame."""
    held: frozenset[int] = frozenset()
    """Dimensions that do not change: the coordinates of given pivots."""
    free: Reals = ()  # type: ignore[assignment]
    """The point on its link (two numbers), then the constants of coupler angles, inputs and outputs."""

    @property
    def point(self) -> complex:
        """The point on its link."""
        return complex(self.free[0], self.free[1])


class _Compared(NamedTuple):
    """The errors of all targets, with derivatives."""

    errors: Reals
    """(targets, errors)"""
    by_pose: Reals
    """(targets, errors, unknowns)"""
    by_sizes: Reals
    """(targets, errors, dimensions) directly, with the poses at rest."""
    by_free: Reals
    """(targets, errors, free numbers)"""


def _turned(angles: Reals) -> Reals:
    """Angles between -pi and pi."""
    return np.asarray(np.angle(np.exp(1j * angles)))


def compared(closure: DesignClosure, targets: FitTargets, state: FitState) -> _Compared:
    """The errors of a state. Cost: 5 us a target."""
    rows = len(targets)
    columns = 2 * (targets.z is not None) + sum(
        v is not None for v in (targets.angles, targets.inputs, targets.outputs)
    )
    errors = np.zeros((rows, columns))
    by_pose = np.zeros((rows, columns, closure.unknowns))
    by_sizes = np.zeros((rows, columns, len(state.p)))
    by_free = np.zeros((rows, columns, len(state.free)))
    at = free = 0
    if targets.z is not None:
        c = closure.column[state.link]
        turn = np.exp(1j * state.q[:, c + 2])
        arm = turn * state.point
        given = ~np.isnan(targets.z)
        rest = np.where(given, state.q[:, c] + 1j * state.q[:, c + 1] + arm - targets.z, 0)
        by_angle, by_point = 1j * arm, np.stack([turn, 1j * turn], axis=1)
        for row, part in enumerate((np.real, np.imag)):
            errors[:, row] = part(rest)
            by_pose[:, row, c + row] = given
            by_pose[:, row, c + 2] = part(by_angle) * given
            by_free[:, row, :2] = part(by_point) * given[:, None]
        at = free = 2
    turning = [
        (targets.angles, state.link),
        (targets.inputs, state.crank),
        (None if targets.travel else targets.outputs, state.output),
    ]
    for wanted, link in turning:
        if wanted is None:
            continue
        given = ~np.isnan(wanted)
        c = closure.column[link] + 2
        errors[:, at] = targets.size * np.where(
            given, _turned(state.q[:, c] - np.nan_to_num(wanted) - state.free[free]), 0
        )
        by_pose[:, at, c] = targets.size * given
        by_free[:, at, free] = -targets.size * given
        at, free = at + 1, free + 1
    if targets.travel and targets.outputs is not None:
        c, angle = closure.column[state.output], closure.start[state.slide] + 2
        along = np.exp(1j * state.p[angle])
        place = state.q[:, c] + 1j * state.q[:, c + 1]
        given = ~np.isnan(targets.outputs)
        travel = np.real(np.conj(along) * place) - targets.outputs - state.free[free]
        errors[:, at] = np.where(given, travel, 0)
        by_pose[:, at, c], by_pose[:, at, c + 1] = along.real * given, along.imag * given
        by_sizes[:, at, angle] = np.imag(np.conj(along) * place) * given
        by_free[:, at, free] = -1.0 * given
    slopes = np.concatenate([by_pose, by_sizes, by_free], axis=2)
    if targets.bands is not None:
        errors, slopes = targets.bands.weighed(errors, slopes)
    if targets.legs is not None:
        beyond, *by_numbers = targets.legs.beyond(closure, state.q, state.p)
        still = np.zeros((*beyond.shape, len(state.free)))
        errors = np.concatenate([errors, targets.size * beyond], axis=1)
        slopes = np.concatenate([slopes, targets.size * np.concatenate([*by_numbers, still], axis=2)], axis=1)
    borders = np.cumsum([closure.unknowns, len(state.p)])
    return _Compared(errors, *np.split(slopes, borders, axis=2))


def improved(
    closure: DesignClosure,
    state: FitState,
    targets: FitTargets,
    demands: Demands | None = None,
    *,
    steps: int = _STEPS,
    exact: bool = True,
) -> FitState:
    """The state at a minimum nearby of the sum of squared errors: where it vanishes, if that can be reached.

    What is demanded of pivots and lengths is kept, as far as the task can be approached with it. The transmission angle
    at the targets is one more error of each, which counts where it is too small.

    Few targets are met exactly by many linkages: if wanted, Newton's method looks for the nearest of them, again after
    some steps of least squares if that fails at first. Cost: for a six-bar 1 ms a step.
    """
    # Errors are in the task's size; the poses of a function task have that of the linkage.
    size = closure.linkage.size if targets.z is None else float(np.nanmax(np.abs(targets.z - np.nanmean(targets.z))))
    q, good = closure.closed(state.q, state.p, size=size)
    if not good.all():
        return state
    units = _units(closure, targets, state, size)
    wanted = demands or Demands(size_ratio=np.inf)
    limits = limits_of_sizes(closure, wanted, q[0], state.p, held=state.held, unit=size)
    if demands is not None and demands.transmission > 0 and len(closure.linkage.mechanism.drives) < 2:
        outputs = (state.output,) if state.output else guided_output(closure.linkage, state.link)
        targets = replace(targets, legs=LegAngles.of(closure, outputs, demands.transmission))
    start = _at(closure, targets, replace(state, q=q), size)
    freedoms = start.by_motion.shape[2]
    alike = targets.bands is None or bool(targets.bands.exact.all())
    same = 3 * (len(closure.linkage.mechanism.chain.links) - 1)  # numbers that place a link's own coordinates on it
    if not exact or not alike or targets.given - len(targets) * freedoms > len(units) - len(state.held) - same:
        return _least_squares(closure, targets, start, limits, units, steps).state
    for more in (0, min(steps, _FEW_STEPS), steps):
        start = _least_squares(closure, targets, start, limits, units, more)
        if (met := _met(closure, targets, start, limits, units)) is not None:
            return met.state
    return start.state


def _met(
    closure: DesignClosure, targets: FitTargets, now: _Nearest, limits: SizeLimits, units: Reals
) -> _Nearest | None:
    """The state nearby that meets all targets, by Newton's method with least steps; None if it is not reached.

    Targets close to each other make the sum of squares a narrow curved valley. So a part of a step is good if the next
    step from there, with the same Jacobian, is shorter, however large the errors (Deuflhard's natural monotonicity).
    """
    part = 1.0
    numbers = len(units)
    for _ in range(_NEWTON_STEPS):
        beyond = now.beyond(limits)
        if now.cost < _MET * targets.size**2 and beyond.max(initial=0.0) < HELD:
            return now
        count, errors, freedoms = now.by_motion.shape
        slopes = np.zeros((count, errors, numbers + count * freedoms))
        slopes[:, :, :numbers] = now.slopes(units)
        for k in range(count):
            at = numbers + k * freedoms
            slopes[k, :, at : at + freedoms] = now.by_motion[k]
        slopes = slopes.reshape(count * errors, -1)
        own = limits.linearised(now.state.p[:, None], _AT_REST)[1][:, :, 0] * (beyond > 0)[:, None]
        bounds = np.zeros((len(beyond), slopes.shape[1]))
        bounds[:, : len(now.state.p)] = own * units[: len(now.state.p)]
        inverse = np.linalg.pinv(np.concatenate([slopes, bounds]), rcond=_RANK)
        step = -inverse @ np.append(now.own.errors, beyond)
        length = float(np.linalg.norm(step)) + 1e-300
        part = min(1.0, 4 * part)
        while True:
            change, along = units * part * step[:numbers], part * step[numbers:].reshape(count, freedoms, 1)
            slide = (now.derivatives.motion @ along)[:, :, 0]
            trial = _changed(closure, targets, now.state, slide, change, limits.unit)
            shrunk = part / 4
            if trial is not None:
                rest = -inverse @ np.append(trial.own.errors, trial.beyond(limits))
                if np.linalg.norm(rest) <= (1 - part / 4) * length:
                    now = trial
                    break
                # The rest is (1 - part) step + curvature part^2/2: the largest part whose curvature is no larger.
                curvature = 2 * float(np.linalg.norm(rest - (1 - part) * step)) / (part**2 * length)
                shrunk = min(part / 2, 1 / curvature)
            part = shrunk
            if part < _SHORTEST:
                return None
    return None


def _changed(
    closure: DesignClosure, targets: FitTargets, state: FitState, slide: Reals, change: Reals, size: float
) -> _Nearest | None:
    """The state with all numbers changed and the poses moved, then closed again; None if a pose cannot be closed."""
    p = state.p + change[: len(state.p)]
    q, good = closure.closed(state.q + slide, p, size=size)
    if not good.all():
        return None
    return _at(closure, targets, replace(state, p=p, q=q, free=state.free + change[len(state.p) :]), size)


def _least_squares(
    closure: DesignClosure, targets: FitTargets, start: _Nearest, limits: SizeLimits, units: Reals, steps: int
) -> _Nearest:
    """Levenberg and Marquardt's method, within the limits if the start is, else first back to them.

    The place of each pose along its freedoms is eliminated: only the part of an error counts that no motion changes,
    and after each step of the dimensions the poses move to where they are nearest to their targets.
    """
    size = limits.unit
    now = _nearest(closure, targets, start, size)
    damping = 1e-3
    for _ in range(steps):
        passed = now.passed(limits)
        slopes = now.slopes(units)
        back = now.motion_against(damping)
        errors = now.own.errors[:, :, None]
        left = slopes - now.by_motion @ (back @ slopes)  # what the motion of the poses does not make up for
        gram = np.sum(slopes.transpose(0, 2, 1) @ left, axis=0)
        right = np.sum(left.transpose(0, 2, 1) @ errors, axis=0)[:, 0]
        weight = np.diag(gram).mean() + 1e-30
        gram += damping * weight * np.eye(len(gram))
        step = -np.linalg.solve(gram, right)
        share = np.array([1 / (1 + 100 * damping) if passed else 1.0])
        asked = (gram / np.outer(units, units))[None], (units * step)[None]
        step = limits.kept(now.state.p[:, None], _AT_REST, *asked, share)[0] / units
        slide = now.slide(back @ (errors + slopes @ step[:, None]))
        trial = _changed(closure, targets, now.state, slide, units * step, size)
        if trial is not None:
            trial = _nearest(closure, targets, trial, size)
        beyond = np.inf if trial is None else trial.passed(limits)
        if trial is not None and (beyond < passed or (beyond == passed == 0 and trial.cost < now.cost)):
            gain, now = now.cost - trial.cost, trial
            damping = max(damping * 0.3, 1e-12)
            if not passed and (gain < 1e-9 * now.cost or now.cost < _MET * targets.size**2):
                break
        else:
            damping *= 5
            if damping > 1e8:
                break
    return now


def _units(closure: DesignClosure, targets: FitTargets, state: FitState, size: float) -> Reals:
    """What counts as one of each number that is changed: a length of the order of the task, or a radian."""
    units = np.full(len(state.p) + len(state.free), size)
    for key, at in closure.start.items():
        if closure.linkage.elements[key].is_line:
            units[at + 2] = 1.0
    constants = len(state.p) + (2 if targets.z is not None else 0)
    units[constants:] = 1.0
    if targets.travel:
        units[-1] = size
    return units


@dataclass(frozen=True, slots=True, kw_only=True)
class _Nearest:
    """A state with its errors, and how they change when the poses move."""

    state: FitState
    derivatives: PoseDerivatives
    own: _Compared
    by_motion: Reals
    """(targets, errors, freedoms)"""
    cost: float

    def slopes(self, units: Reals) -> Reals:
        """(targets, errors, numbers) how errors change with dimensions and what else is free, counted in units."""
        by_sizes = self.derivatives.gradient(self.own.by_pose) + self.own.by_sizes
        by_sizes[:, :, [*self.state.held]] = 0
        return np.asarray(np.concatenate([by_sizes, self.own.by_free], axis=2) * units)

    def beyond(self, limits: SizeLimits) -> Reals:
        """(limits,) by how much the dimensions pass each; 0 inside."""
        return np.asarray(np.maximum(limits.values(self.state.p[:, None], _AT_REST)[:, 0], 0.0))

    def passed(self, limits: SizeLimits) -> float:
        """By how much the dimensions pass the limit that they pass most; 0 inside."""
        return float(limits.passed(self.state.p[:, None], _AT_REST)[0])

    def motion_against(self, damping: float) -> Reals:
        """(targets, freedoms, errors) the motion whose negative makes up for errors, as far as damping lets it."""
        square = self.by_motion.transpose(0, 2, 1) @ self.by_motion
        freedoms = square.shape[1]
        weight = float(np.einsum("nkk->", square)) / (len(square) * freedoms) + 1e-300
        return np.asarray(
            np.linalg.solve(
                square + max(damping, _LEAST) * weight * np.eye(freedoms), self.by_motion.transpose(0, 2, 1)
            )
        )

    def slide(self, along: Reals) -> Reals:
        """(targets, unknowns) the poses moved against (targets, freedoms, 1), not too far at once."""
        return -np.asarray((self.derivatives.motion @ np.clip(along, -_FARTHEST, _FARTHEST))[:, :, 0])


def _at(closure: DesignClosure, targets: FitTargets, state: FitState, size: float) -> _Nearest:
    derivatives = closure.derivatives(state.q, state.p, size=size)
    own = compared(closure, targets, state)
    return _Nearest(
        state=state,
        derivatives=derivatives,
        own=own,
        by_motion=own.by_pose @ derivatives.motion,
        cost=float(np.sum(own.errors**2)),
    )


def _nearest(closure: DesignClosure, targets: FitTargets, now: _Nearest, size: float) -> _Nearest:
    """The state with each pose moved to where it is nearest to its target."""
    damping = _LEAST
    at_rest = np.zeros(len(now.state.p) + len(now.state.free))
    for _ in range(_MOTIONS):
        along = now.motion_against(damping) @ now.own.errors[:, :, None]
        trial = _changed(closure, targets, now.state, now.slide(along), at_rest, size)
        if trial is not None and trial.cost < now.cost:
            settled = trial.cost > now.cost * (1 - 1e-4)
            now = trial
            if settled:
                break
        else:
            damping = max(100 * damping, 1e-2)
    return now
