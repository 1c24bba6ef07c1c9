"""The equations of a whole linkage without its drives, and the curve of their solutions, followed from a start.

docs/theory/circuits.md has the method, its tolerances and what it may miss.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.contacts import contact_conditions, law_tables
from gruebler.mechanics.kinematics.contours import PiecewiseLaw
from gruebler.mechanics.kinematics.kernel_records import (
    CLOSED,
    EQUATIONS,
    FLIP,
    FULL,
    LONG,
    MESH,
    PIN,
    POLAR,
    RACK,
    RIDE,
    SHORTEST,
    SLIDE,
    TRAIN,
    TRAVEL,
    Conditions,
    SampleBuffer,
)
from gruebler.mechanics.linkages import Linkage, Pose2D
from gruebler.mechanics.linkages.model import NEAR_REFERENCE
from gruebler.mechanics.linkages.wheels import carriers, round_joints

_SHORT = 0.02  # a change point is passed by a step of at most this length
_EXACT = 1e-12  # a change point is open by less; if by more, the linkage only passes near one
_SAME = 1e-9  # sizes and radians: poses that differ by less are one; samples are closed to some 1e-13
_AHEAD = 0.9  # the cosine of tangents that go the same way; where a curve crosses itself they differ
_REAL = 1e-9  # the imaginary part of a root that is real: the polynomial is known to some 1e-12
_ZERO = 1e-9  # of a singular value at a pose found to `_EXACT`
_DIFFERENCE = 1e-5  # sizes and radians: the cube root of the rounding, the best step of a central difference
_BESIDE = np.array([-2.0, -1.0, 1.0, 2.0])  # places about a meeting of curves, in widths
_NEARER = (0.1, 0.02, 0.02)  # the widths, in parts of the way between two samples
_BORDER = 1e-6  # parts of a way between samples, sizes and radians: meetings at a sample are one
_BETWEEN = 2  # times the difference of two Jacobians: more than that along an arc that hardly bends
_LOST = 1e-5  # of the singular value a width away: less is zero
_SMALL = 0.2  # below this gauge a redundantly constrained linkage is looked at for change points


@dataclass(frozen=True, eq=False, kw_only=True)
class ClosureSystem:
    """The closing conditions of all joints of a linkage with lower pairs.

    The unknowns are x, y and angle of each link but the frame, and of an arm between the centres of two wheels that no
    link holds; lengths are in units of the linkage's size.
    """

    lower: Linkage
    bodies: tuple[str, ...]
    """The links; the arms are numbered behind them."""
    arms: tuple[tuple[tuple[int, str], tuple[int, str]], ...]
    """For each arm the wheels between which it lies, by joint and link."""
    conditions: Conditions
    equations: int
    meshes: tuple[NDArray[np.int64], NDArray[np.int64]]
    """The equations that hold the phases of wheels, and their conditions."""

    @property
    def unknowns(self) -> int:
        """How many there are."""
        return 3 * (len(self.bodies) + len(self.arms))

    @property
    def redundant(self) -> bool:
        """Whether there are more equations than a linkage with one freedom needs."""
        return self.equations > self.unknowns - 1

    def with_arms(self, x: Reals) -> Reals:
        """The unknowns if those of the links are given; the wheels mesh in this position from now on."""
        where = {link: Pose2D(*x[3 * k : 3 * k + 3]) for k, link in enumerate(self.bodies)}
        rows = [x]
        for ends in self.arms:
            elements = [self.lower.elements[key] for key in ends]
            centres = [
                complex(*where.get(link, Pose2D(0, 0, 0)).put(e.x / self.lower.size, e.y / self.lower.size))
                for (_, link), e in zip(ends, elements, strict=True)
            ]
            rows.append(np.array([centres[0].real, centres[0].imag, phase(centres[1] - centres[0])]))
        pose = np.concatenate(rows)
        self.conditions.values[self.meshes[1], 2] = 0
        self.conditions.values[self.meshes[1], 2] = self.linearised(pose)[0][self.meshes[0]]
        return pose

    def linearised(self, x: Reals) -> tuple[Reals, Reals]:
        """Residual and Jacobian: (equations,) and (equations, unknowns)."""
        return _core.jacobian(self.conditions, x)

    def independent(self, x: Reals) -> NDArray[np.int64]:
        """The numbers of equations on which the others depend at a pose on the curve."""
        if not self.redundant:
            return np.arange(self.equations)
        return np.sort(_core.settle_on_curve(self.conditions, x.copy(), np.ones(self.unknowns))[-1])


class ChangeSample(NamedTuple):
    """A change point: its pose, exactly, and the sample before it."""

    pose: Reals
    sample: int
    several: bool = False
    """Whether more than one other curve goes through it, or one that touches this one."""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class TracedCurve:
    """Samples of a curve, in order."""

    arcs: Reals
    poses: Reals
    tangents: Reals
    closed: bool
    ended: str
    """Empty if closed; ``long`` or ``singular``."""
    changes: tuple[ChangeSample, ...]
    start: float
    """The length at which the start lies."""


def closure_system(lower: Linkage, still: Sequence[tuple[str, str]] = ()) -> ClosureSystem:
    """The equations of a linkage with lower pairs, some links of which do not turn against each other.

    `LinkageError` if it has more than one freedom by count.
    """
    chain, frame, size = lower.mechanism.chain, lower.mechanism.frame, lower.size
    bodies = tuple(link for link in chain.links if link != frame)
    keys = tuple(lower.elements)
    wheels, held = round_joints(lower.mechanism, lower.elements), carriers(lower.mechanism, lower.elements)
    rows: list[_Row] = []
    free: list[tuple[tuple[int, str], tuple[int, str]]] = []
    for number, joint in enumerate(chain.joints):
        ends = [(number, link) for link in joint.links]
        owners = [-1 if link == frame else bodies.index(link) for link in joint.links]
        if number not in wheels:
            kind = PIN if joint.pair.is_turning else SLIDE
            rows += [
                _Row(kind=kind, owners=(owners[0], b), places=(_at(lower, ends[0]), _at(lower, e)))
                for b, e in zip(owners[1:], ends[1:], strict=True)
            ]
            continue
        sides = keys.index(ends[0]), keys.index(ends[1])
        for condition in contact_conditions(lower, joint.pair, keys, sides, (owners[0], owners[1])):
            weight, other_weight, value = condition.values
            places = _at(lower, keys[condition.sides[0]]), _at(lower, keys[condition.sides[1]])
            if condition.kind == MESH:
                arm = len(bodies) + len(free)
                if number in held:
                    arm = -1 if held[number].link == frame else bodies.index(held[number].link)
                else:
                    free.append((ends[0], ends[1]))
                    rows.append(_Row(kind=PIN, owners=(arm, owners[0]), places=((0j, 1 + 0j), places[0])))
                    rows.append(_Row(kind=RIDE, owners=(arm, owners[1]), places=((0j, 1 + 0j), places[1])))
                turned = lower.elements[keys[condition.sides[0]]].direction
                if number in held:
                    turned -= held[number].direction + (pi if condition.sides != sides else 0.0)
                rows.append(
                    _Row(
                        kind=TRAIN,
                        owners=condition.owners,
                        places=places,
                        values=(weight / size, other_weight / size, 0.0, arm, turned),
                        law=condition.law,
                    )
                )
            elif condition.kind == RACK:
                rows.append(
                    _Row(
                        kind=TRAVEL,
                        owners=condition.owners,
                        places=places,
                        values=(weight / size, other_weight, 0.0, 0.0, 0.0),
                    )
                )
            else:
                law = condition.law.scaled(size, condition.kind == POLAR)
                rows.append(
                    _Row(
                        kind=condition.kind,
                        owners=condition.owners,
                        places=places,
                        values=(weight / size, other_weight, value / size, 0.0, 0.0),
                        law=law,
                    )
                )
    for a, b in still:
        owners = [-1 if link == frame else bodies.index(link) for link in (a, b)]
        rows.append(
            _Row(
                kind=TRAIN,
                owners=(owners[0], owners[1]),
                places=((0j, 1 + 0j), (0j, 1 + 0j)),
                values=(1.0, -1.0, 0.0, -1.0, 0.0),
            )
        )
    ends_of = [end for row in rows for end in row.places]
    laws, pieces = law_tables([row.law for row in rows])
    conditions = Conditions(
        kinds=np.array([row.kind for row in rows], np.int64),
        values=np.array([(*row.values, *law) for row, law in zip(rows, laws, strict=True)]),
        pieces=pieces,
        owners=np.array([owner for row in rows for owner in row.owners], np.int64),
        points=np.array([[point] for point, _ in ends_of], np.complex128),
        lines=np.array([line for _, line in ends_of], np.complex128),
        spins=np.zeros((0, 3)),
        size=1.0,
    )
    first = np.cumsum([0, *(EQUATIONS[row.kind] for row in rows)])
    meshes = np.array([k for k, row in enumerate(rows) if row.kind in (TRAIN, TRAVEL)], np.int64)
    unknowns, equations = 3 * (len(bodies) + len(free)), int(first[-1])
    if equations < unknowns - 1:
        raise LinkageError(
            "a circuit is the motion of a linkage with one freedom, but this one has {unknowns}",
            unknowns=unknowns - equations,
        )
    return ClosureSystem(
        lower=lower,
        bodies=bodies,
        arms=tuple(free),
        conditions=conditions,
        equations=equations,
        meshes=(first[meshes], meshes),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    """A closing condition in the making."""

    kind: int
    owners: tuple[int, int]
    places: tuple[tuple[complex, complex], tuple[complex, complex]]
    """Point and direction on both sides."""
    values: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)
    law: PiecewiseLaw = field(default_factory=lambda: PiecewiseLaw(()))


def _at(lower: Linkage, key: tuple[int, str]) -> tuple[complex, complex]:
    element = lower.elements[key]
    return complex(element.x, element.y) / lower.size, rect(1, element.direction)


def nearest_on_curve(system: ClosureSystem, x: Reals) -> tuple[Reals, Reals, float, int]:
    """The nearest pose on the curve, tangent, gauge (`SampleBuffer`) and rank there; `LinkageError` if none is near.

    The error is raised for a pose that is off by more than `NEAR_REFERENCE`, in sizes and radians.
    """
    pose = x.copy()
    _, matrix = system.linearised(pose)
    tangent = np.linalg.svd(matrix)[2][-1].copy()
    arrived, miss, gauge, rank, _ = _core.settle_on_curve(system.conditions, pose, tangent)
    if not arrived or np.abs(pose - x).max() > NEAR_REFERENCE or not (miss < _SAME or rank == system.unknowns):
        raise LinkageError("the joints are not closed in the position from which the circuit is to start")
    return pose, tangent, gauge, rank


def trace_circuit(system: ClosureSystem, pose: Reals, tangent: Reals, step: float, most: float) -> TracedCurve:
    """The circuit through a pose, forwards until it closes; if it does not, backwards as well."""
    ahead = _follow(system, pose, tangent, step, most)
    if ahead.closed:
        return ahead
    back = _follow(system, pose, -tangent, step, most)
    length, last = back.arcs[-1], len(back.arcs) - 1
    changes = [c._replace(sample=last - 1 - c.sample) for c in reversed(back.changes)]
    changes += [c._replace(sample=last + c.sample) for c in ahead.changes]
    return TracedCurve(
        arcs=np.concatenate([length - back.arcs[:0:-1], length + ahead.arcs]),
        poses=np.concatenate([back.poses[:0:-1], ahead.poses]),
        tangents=np.concatenate([-back.tangents[:0:-1], ahead.tangents]),
        closed=False,
        ended="singular" if "singular" in (ahead.ended, back.ended) else "long",
        changes=tuple(changes),
        start=float(length),
    )


def _follow(system: ClosureSystem, pose: Reals, tangent: Reals, longest: float, most: float) -> TracedCurve:
    curve = _room(64, system.unknowns)
    curve.poses[0], curve.tangents[0] = pose, tangent
    curve.gauges[0] = _core.settle_on_curve(system.conditions, curve.poses[0], curve.tangents[0])[2]
    count, step, changes = 1, longest / 4, list[ChangeSample]()
    while True:
        status, count, step = _core.trace_curve(system.conditions, curve, count, step, longest, most)
        if status == FULL:
            curve = _larger(curve)
        elif status == FLIP:
            chord = float(np.linalg.norm(curve.poses[count] - curve.poses[count - 1]))
            ends = curve.poses[count - 1], curve.poses[count]
            change_pose, several = None, False
            if chord <= _SHORT:
                change_pose, several = _change_or_meeting(system, *ends, curve.tangents[count - 1])
            if change_pose is None:
                step = chord / 2
                if step < SHORTEST:
                    status = -1
                    break
                continue
            changes.append(ChangeSample(change_pose, count - 1, several))
            count += 1
            if _is_start(curve, count - 1):
                status = CLOSED
                break
        else:
            break
    arcs, poses, tangents = (part[:count].copy() for part in curve[:3])
    samples = TracedCurve(
        arcs=arcs, poses=poses, tangents=tangents, closed=status == CLOSED, ended="", changes=tuple(changes), start=0.0
    )
    if system.redundant:
        samples = replace(samples, changes=_quiet_changes(system, samples, curve.gauges[:count]))
    else:
        touches = [*changes, *_touches(system, samples, curve.gauges[:count])]
        samples = replace(samples, changes=tuple(sorted(touches, key=lambda change: change.sample)))
    return replace(samples, ended="" if status == CLOSED else "long" if status == LONG else "singular")


def _room(samples: int, unknowns: int) -> SampleBuffer:
    shape = (samples, unknowns)
    return SampleBuffer(np.zeros(samples), np.zeros(shape), np.zeros(shape), np.zeros(samples))


def _larger(curve: SampleBuffer) -> SampleBuffer:
    larger = _room(2 * len(curve.arcs), curve.poses.shape[1])
    for new, old in zip(larger, curve, strict=True):
        new[: len(old)] = old
    return larger


def _is_start(curve: SampleBuffer, sample: int) -> bool:
    gap = curve.poses[sample] - curve.poses[0]
    gap[2::3] -= 2 * np.pi * np.round(gap[2::3] / (2 * np.pi))
    return bool(sample > 1 and np.abs(gap).max() < _SAME and curve.tangents[sample] @ curve.tangents[0] > _AHEAD)


def _change_or_meeting(system: ClosureSystem, first: Reals, second: Reals, tangent: Reals) -> tuple[Reals | None, bool]:
    """The change point between two neighbouring samples, None if there is none; whether several curves meet there.

    Newton's method for one other curve hardly converges where several meet, but it may, so their number is counted.
    """
    pose = _change(system, first, second)
    if pose is None:
        pose, lost = _meeting(system, first, second, tangent)
    else:
        singular = np.linalg.svd(system.linearised(pose)[1], compute_uv=False)[: system.unknowns - 1]
        lost = int(np.count_nonzero(singular < _ZERO))
    return pose, lost > 1


def _change(closure: ClosureSystem, first: Reals, second: Reals) -> Reals | None:
    """The pose between two neighbouring samples in which the Jacobian loses its rank; None if it does not on the curve.

    Newton's method on F(x) + beta psi = 0, J(x)^T psi = 0, |psi| = 1 for x, psi, beta; beta is 0 at a change point.
    """
    rows = closure.independent(first)
    x, n, p = (first + second) / 2, closure.unknowns, len(rows)
    beta = 0.0
    psi = np.linalg.svd(closure.linearised(x)[1][rows])[0][:, -1]
    for _ in range(15):
        residual, matrix = (part[rows] for part in closure.linearised(x))
        equations = np.concatenate([residual + beta * psi, matrix.T @ psi, [(psi @ psi - 1) / 2]])
        system = np.zeros((n + p + 1, n + p + 1))
        system[:p, :n], system[:p, n : n + p], system[:p, -1] = matrix, beta * np.eye(p), psi
        system[p:-1, :n], system[p:-1, n : n + p] = _curvature(closure, x, psi, rows), matrix.T
        system[-1, n : n + p] = psi
        try:
            move = np.linalg.solve(system, equations)
        except np.linalg.LinAlgError:
            return None
        x, psi, beta = x - move[:n], psi - move[n:-1], beta - move[-1]
        if not np.abs(move).max() < 1:
            return None
        if np.abs(move).max() < _EXACT:
            near = np.linalg.norm(x - (first + second) / 2) <= np.linalg.norm(second - first)
            return x if near and abs(beta) < _EXACT else None
    return None


def _meeting(system: ClosureSystem, first: Reals, second: Reals, tangent: Reals) -> tuple[Reals | None, int]:
    """The pose between two neighbouring samples in which other curves meet this one, and how many ranks are lost there.

    The pose is None if there is none.

    A singular value changes by no more than the Jacobian (Weyl): larger than the change from sample to sample, it is
    nowhere zero between them. Along the curve the smallest one of the Jacobian, with the other sign behind it, goes
    through zero there: the place is the zero of a cubic through four values, the pose lies on cubics of four poses.
    """

    def least(pose: Reals) -> float:
        return float(np.linalg.svd(system.linearised(pose)[1], compute_uv=False)[system.unknowns - 2])

    def at(part: float) -> tuple[Reals, float]:
        pose = first + part * (second - first)
        _core.settle_on_curve(system.conditions, pose, tangent.copy())
        return pose, least(pose)

    before, behind = least(first), least(second)
    if before + behind > _BETWEEN * np.linalg.norm(system.linearised(second)[1] - system.linearised(first)[1]):
        return None, 0
    place = before / max(before + behind, 1e-300)
    for width in _NEARER:
        places = place + width * _BESIDE
        samples = [at(float(part)) for part in places]
        values = np.array([value for _, value in samples])
        line = np.polynomial.Polynomial.fit(_BESIDE, np.sign(_BESIDE) * values, 3)
        roots = [root.real for root in line.roots() if abs(root.imag) < _REAL and abs(root.real) < 1]
        if not roots:
            return None, 0
        shift = float(min(roots, key=abs))
        place += width * shift
    weights = np.array([np.prod([(shift - v) / (u - v) for v in _BESIDE if v != u]) for u in _BESIDE])
    pose = weights @ np.array([first for first, _ in samples])
    singular = np.linalg.svd(system.linearised(pose)[1], compute_uv=False)[: system.unknowns - 1]
    lost = int((singular < _LOST * values.min()).sum())
    return (np.asarray(pose) if lost and -_BORDER < place < 1 + _BORDER else None), lost


def _touches(system: ClosureSystem, samples: TracedCurve, gauges: Reals) -> Iterator[ChangeSample]:
    """Change points at which the determinant is zero without a change of its sign."""
    size = np.abs(gauges)
    wide = np.concatenate([[np.inf], size, [np.inf]])
    lowest = np.flatnonzero((size <= wide[:-2]) & (size <= wide[2:]) & (size < _SMALL * size.max()))
    last = None
    for k in sorted({part for low in lowest.tolist() for part in (low - 1, low) if 0 <= part < len(size) - 1}):
        if gauges[k] * gauges[k + 1] < 0:
            continue
        pose, _ = _meeting(system, samples.poses[k], samples.poses[k + 1], samples.tangents[k])
        if pose is not None and (last is None or np.abs(pose - last).max() > _BORDER):
            last = pose
            yield ChangeSample(pose, k, True)


def _curvature(system: ClosureSystem, x: Reals, psi: Reals, rows: NDArray[np.int64]) -> Reals:
    """The derivative of J^T psi, by differences; its error slows Newton's method down but does not mislead it."""
    curvature, h = np.empty((len(x), len(x))), _DIFFERENCE
    for k in range(len(x)):
        for sign in (1, -1):
            moved = x.copy()
            moved[k] += sign * h
            side = system.linearised(moved)[1][rows].T @ psi
            curvature[:, k] = side if sign == 1 else (curvature[:, k] - side) / (2 * h)
    return curvature


def _quiet_changes(system: ClosureSystem, samples: TracedCurve, gauges: Reals) -> tuple[ChangeSample, ...]:
    """Change points of a redundantly constrained linkage: there is no determinant; its shortest row has a minimum 0."""
    changes = []
    for k in range(1, len(gauges) - 1):
        if gauges[k] < min(_SMALL, gauges[k - 1]) and gauges[k] <= gauges[k + 1]:
            ends = samples.poses[k - 1], samples.poses[k + 1]
            pose, several = _change_or_meeting(system, *ends, samples.tangents[k])
            if pose is None or np.linalg.svd(system.linearised(pose)[1], compute_uv=False)[system.unknowns - 2] > _ZERO:
                continue
            ahead = (pose - samples.poses[k]) @ samples.tangents[k] >= 0
            changes.append(ChangeSample(pose, k if ahead else k - 1, several))
    return tuple(changes)
