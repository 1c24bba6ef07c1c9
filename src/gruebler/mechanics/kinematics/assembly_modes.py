"""All assembly modes of any planar group, as far as a stated search finds them: Newton's method from random starts.

What the answer is worth is said in docs/theory/assembly-modes.md. A group comes as bare data, see `GroupConditions`;
`gruebler.mechanics.kinematics.triads` answers exactly for groups of four bodies.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from numbers import Integral, Number
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.kernel_records import PIN, SLIDE, Conditions
from gruebler.structure.assur.modes import MOST_JOINTS, MOST_LINKS, modes_of_trusses

Row = tuple[int, int, int, complex, complex, complex, complex]
Method = Literal["exact", "degenerate", "search"]

_CLOSED = 1e-12  # of size or distance: an assembled group is open by less
_BEYOND_PI = 1e-9  # radians: so that rounding does not turn pi into -pi
_SAME = 1e-6  # of size or distance, and radians: poses nearer than that are one mode
_NEAR = 1e-3  # poses nearer than that may be one singular mode
_STEPS = 40  # of Newton's method; in a singular pose each only halves the error
_STEP = 1e-2  # of the size, and radians: how far a singular pose must be able to move to be called movable
_SINGULAR = 1e-7  # ratio of the Jacobian's singular values below which a mode counts at least twice


class GroupConditions(NamedTuple):
    """The closing conditions of a group: c joints, each between the bodies of slots 2c and 2c + 1.

    A PIN holds two points together. A SLIDE lays two lines on one another, their directions agreeing. A multiple joint
    of k bodies is k - 1 conditions.
    """

    kinds: NDArray[np.int64]
    """(c,) PIN or SLIDE."""
    owners: NDArray[np.int64]
    """(2c,) the body of each slot, -1 for what is known."""
    points: NDArray[np.complex128]
    """(2c,) its point, in the coordinates of the body; of the plane where the body is -1."""
    lines: NDArray[np.complex128]
    """(2c,) its direction, of modulus 1, in the same coordinates; without meaning for a PIN."""

    @property
    def bodies(self) -> int:
        """How many bodies are wanted."""
        return int(self.owners.max()) + 1

    @property
    def size(self) -> float:
        """A length of the order of the group: the widest body; 1 if no body has two points."""
        widths = [
            np.ptp(own.real) + np.ptp(own.imag) for own in map(self._points_of, range(-1, self.bodies)) if len(own)
        ]
        return float(max(widths)) or 1.0

    @property
    def centre(self) -> complex:
        """The mean of the known points; 0 if none is known."""
        known = self._points_of(-1)
        return complex(known.mean()) if len(known) else 0j

    def _points_of(self, body: int) -> NDArray[np.complex128]:
        own: NDArray[np.complex128] = self.points[self.owners == body]
        return own


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class AssemblyModes:
    """Assembly modes: all ways to put the bodies of a group together, what is known being held."""

    poses: Reals
    """(modes, bodies, 3): x, y and angle in (-pi, pi] of each body; sorted by the angles, then the places."""
    multiplicities: tuple[int, ...]
    """1, or 2 in a singular pose, where two modes or more fall together."""
    method: Method
    """``exact``: these are all. ``search``: these were found. ``degenerate``: with these dimensions the conditions are
    dependent, or infinitely many poses satisfy them; the isolated ones found are listed."""
    bound: int | None = None
    """No group of this kind has more isolated ones, complex ones included; None if that is not known."""
    starts: int = 0
    """How often a search started."""
    hits: tuple[int, ...] = ()
    """How often it arrived at each mode."""

    def __len__(self) -> int:
        return len(self.poses)

    @property
    def exact(self) -> bool:
        """Whether these are proved to be all."""
        return self.method == "exact"

    @property
    def risk(self) -> float:
        """The probability that a search overlooks a given mode, if that is hit as often as the others on average."""
        if self.method != "search":
            return 0.0
        return float((len(self) / (len(self) + 1)) ** sum(self.hits)) if len(self) else 1.0


def conditions(rows: Iterable[Row]) -> GroupConditions:
    """Check rows of kind, body a, body b, point a, direction a, point b, direction b, and turn them into arrays.

    Raises:
        LinkageError: for an unknown kind, a number that is not finite, a direction 0, bodies that are not numbered
            0, 1, ... without gaps, or a number of joints that cannot determine the bodies (2 joints count for 3 links).

    >>> dyad = conditions([(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 2 + 0j, 1, 0j, 1), (PIN, 1, -1, 2 + 0j, 1, 2j, 1)])
    >>> dyad.bodies, dyad.owners.tolist()
    (2, [-1, 0, 0, 1, 1, -1])
    """
    rows = list(rows)
    for row in rows:
        _check(row)
    owners = np.array([body for row in rows for body in row[1:3]], np.int64)
    bodies = sorted(set(owners.tolist()) - {-1})
    if not bodies or bodies != list(range(len(bodies))):
        raise LinkageError(
            "the bodies of a group are numbered 0, 1, ... without gaps, and there is one; found {bodies}", bodies=bodies
        )
    if 2 * len(rows) != 3 * len(bodies):
        raise LinkageError(
            "{bodies} bodies are determined by {wanted:g} joints of one freedom, not {joints}",
            bodies=len(bodies),
            wanted=1.5 * len(bodies),
            joints=len(rows),
        )
    points = np.array([z for row in rows for z in (row[3], row[5])], np.complex128)
    lines = np.array([z for row in rows for z in (row[4], row[6])], np.complex128)
    return GroupConditions(np.array([row[0] for row in rows], np.int64), owners, points, lines / np.abs(lines))


def _check(row: Row) -> None:
    if len(row) != 7:
        raise LinkageError(
            "a closing condition has a kind, two bodies, and for each a point and a direction, not {row}", row=row
        )
    kind, a, b, *numbers = row
    if kind not in (PIN, SLIDE):
        raise LinkageError(
            "a closing condition is PIN ({pin}) or SLIDE ({slide}), not {kind!r}", pin=PIN, slide=SLIDE, kind=kind
        )
    if not isinstance(a, Integral) or not isinstance(b, Integral) or a == b or min(a, b) < -1:
        raise LinkageError(
            "a joint is between two bodies 0, 1, ... or a body and what is known (-1), not {a} and {b}", a=a, b=b
        )
    if not all(isinstance(z, Number) for z in numbers) or not np.isfinite(np.array(numbers, np.complex128)).all():
        raise LinkageError("points and directions of a joint are finite numbers, not {numbers}", numbers=numbers)
    if numbers[1] == 0 or numbers[3] == 0:
        raise LinkageError("a direction is a complex number other than 0")


class GroupSolver:
    """Newton's method on the conditions of one group, with its working arrays. Poses are flat: x, y, angle, x, ..."""

    def __init__(self, group: GroupConditions) -> None:
        self.size, n = group.size, 3 * group.bodies
        self._group = group
        self._conditions = Conditions(
            kinds=group.kinds,
            values=np.zeros((len(group.kinds), 8)),
            pieces=np.zeros((0, 14)),
            owners=group.owners,
            points=group.points.reshape(-1, 1),
            lines=group.lines,
            spins=np.zeros((0, 3)),
            size=group.size,
        )
        self._residual, self._jacobian = np.zeros(n), np.zeros((n, n))
        self._widest = max(self.size, float(np.abs(group.points).max()))
        self._leaders, self._offsets = _parallel_bodies(group)

    def align(self, pose: Reals) -> None:
        """Turn bodies, in place, until the lines of all slides point the same way; Newton's method then keeps that."""
        angles = np.append(pose[2::3], 0.0)
        pose[2::3] = (angles[self._leaders] + self._offsets)[:-1]

    def settle(self, pose: Reals) -> bool:
        """Improve a pose, in place, by Newton's method; whether it then satisfies the conditions."""
        _core.newton(self._conditions, pose, _STEPS)
        return self._is_closed(pose)

    def settle_singular(self, pose: Reals) -> bool:
        """The same by shortest steps, which also arrive where poses are singular or movable. Slower."""
        for _ in range(_STEPS):
            slope, unit = self._slope(pose)
            pose -= np.linalg.lstsq(slope, self._residual / self.size, rcond=_SINGULAR)[0] * unit
        return self._is_closed(pose)

    def _is_closed(self, pose: Reals) -> bool:
        gap = _core.closing(self._conditions, pose, self._residual, self._jacobian)
        if not gap <= _CLOSED * max(self._widest, _farthest(pose)):
            return False
        turns = np.exp(1j * np.append(pose[2::3], 0.0))
        first, second = (turns[self._group.owners] * self._group.lines).reshape(-1, 2).T
        return bool(((first.conj() * second).real > 0)[self._group.kinds == SLIDE].all())

    def index_of_known(self, known_poses: Sequence[Reals], pose: Reals) -> int:
        """The number of the mode among those found that a pose is, -1 if it is new.

        Copies of a singular mode are known by the pose half way between them: it is closed, too.
        """
        for k, known in enumerate(known_poses):
            step = pose - known
            step[2::3] = np.mod(step[2::3] + np.pi, 2 * np.pi) - np.pi
            gap = np.abs(step)
            gap[0::3] /= (reach := max(self.size, _farthest(known)))
            gap[1::3] /= reach
            if gap.max() < _SAME or (gap.max() < _NEAR and self._is_closed(known + step / 2)):
                return k
        return -1

    def is_singular(self, pose: Reals) -> bool:
        """Whether the Jacobian has lost rank at a pose."""
        values = np.linalg.svd(self._slope(pose)[0], compute_uv=False)
        return bool(values[-1] < _SINGULAR * values[0])

    def moves(self, pose: Reals) -> bool:
        """Whether a singular pose is one of a curve of poses: a step along the null vector is corrected across it."""
        slope, unit = self._slope(pose)
        null = np.linalg.svd(slope)[2][-1]
        at = pose + _STEP * null * unit
        for _ in range(20):
            rows = np.vstack([self._slope(at)[0], null])
            miss = [*self._residual / self.size, null @ ((at - pose) / unit) - _STEP]
            at -= np.linalg.lstsq(rows, miss)[0] * unit
        return self._is_closed(at)

    def _slope(self, pose: Reals) -> tuple[Reals, Reals]:
        """The Jacobian, without unit, and the units of the pose; the residual is left behind."""
        _core.closing(self._conditions, pose, self._residual, self._jacobian)
        reach = max(self.size, _farthest(pose))
        unit = np.tile([reach, reach, 1.0], len(pose) // 3)
        return self._jacobian * (unit / self.size), unit


def _parallel_bodies(group: GroupConditions) -> tuple[NDArray[np.int64], Reals]:
    """Slides keep angles: for each body, what is known last, whose angle it follows, and by what difference."""
    leaders, offsets = np.arange(group.bodies + 1), np.zeros(group.bodies + 1)
    for c in np.flatnonzero(group.kinds == SLIDE):
        (a, b), (here, there) = group.owners[2 * c : 2 * c + 2], group.lines[2 * c : 2 * c + 2]
        if leaders[b] == group.bodies:
            a, b, here, there = b, a, there, here
        follow = leaders == leaders[b]
        offsets[follow] += offsets[a] - offsets[b] + np.angle(here / there)
        leaders[follow] = leaders[a]
    return leaders, offsets


def _farthest(pose: Reals) -> float:
    return float(np.abs(pose.reshape(-1, 3)[:, :2]).max())


def ordered_modes(distinct: Sequence[Reals], size: float, bodies: int) -> tuple[Reals, list[int]]:
    """Poses as (modes, bodies, 3), angles in (-pi, pi], in an order that small errors do not change; and that order."""
    if not distinct:
        return np.empty((0, bodies, 3)), []
    poses = np.array(distinct).reshape(-1, bodies, 3)
    top = np.pi + _BEYOND_PI
    poses[:, :, 2] = top - np.mod(top - poses[:, :, 2], 2 * np.pi)
    keys = np.concatenate([poses[:, :, 2], poses[:, :, 0] / size, poses[:, :, 1] / size], axis=1).round(5)
    order = [int(k) for k in np.lexsort(keys.T[::-1])]
    return poses[order], order


def search_modes(group: GroupConditions, *, seed: int = 0, patience: int = 30, most: int = 100_000) -> AssemblyModes:
    """Assembly modes found from random starts.

    The search ends when ``patience`` x (found + 1) arrivals brought nothing new; with none found, or if it hardly ever
    arrives, after 50 times as many starts; in any case after ``most`` starts. Same seed, same answer.

    Cost: some 10 to 100 microseconds a start, starts of the order of patience x modes.

    >>> dyad = [(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 2 + 0j, 1, 0j, 1), (PIN, 1, -1, 2 + 0j, 1, 2j, 1)]
    >>> modes = search_modes(conditions(dyad))
    >>> modes.exact, modes.poses[:, 0, 2].round(4).tolist()
    (False, [0.5236, 2.618])
    """
    if patience < 1 or most < 1:
        raise LinkageError(
            "patience and the number of starts are at least 1, not {patience} and {most}", patience=patience, most=most
        )
    rng = np.random.default_rng(seed)
    solver, bodies, size, centre = GroupSolver(group), group.bodies, group.size, group.centre

    def start() -> Reals:
        pose = rng.uniform(-1, 1, (bodies, 3)) * (size, size, np.pi) + (centre.real, centre.imag, 0)
        solver.align(flat := pose.reshape(-1))
        return flat

    degenerate = all(solver.is_singular(start()) for _ in range(3))
    distinct: list[Reals] = []
    hits: list[int] = []
    starts = arrivals = idle = 0
    while starts < most and arrivals < patience * (len(distinct) + 1) and idle < 50 * patience * (len(distinct) + 1):
        starts, idle = starts + 1, idle + 1
        unknowns = start()
        if not solver.settle(unknowns):
            continue
        arrivals += 1
        number = solver.index_of_known(distinct, unknowns)
        if number < 0 and solver.is_singular(unknowns) and solver.moves(unknowns):
            degenerate = True
            break
        if number < 0:
            distinct.append(unknowns)
            hits.append(0)
            arrivals = idle = 0
        hits[number] += 1
    poses, order = ordered_modes(distinct, size, bodies)
    multiplicities = tuple(2 if solver.is_singular(distinct[k]) else 1 for k in order)
    method: Method = "degenerate" if degenerate else "search"
    return AssemblyModes(
        poses=poses,
        multiplicities=multiplicities,
        method=method,
        bound=_bound(group),
        starts=starts,
        hits=tuple(hits[k] for k in order),
    )


def _bound(group: GroupConditions) -> int | None:
    """The complex modes that almost all groups of these pins have; special ones have no more that are isolated."""
    if (group.kinds == SLIDE).any():
        return None
    joints = (np.int64(1) << (group.owners + 1)).reshape(1, -1, 2).sum(axis=2)
    if group.bodies >= MOST_LINKS or joints.size > MOST_JOINTS:
        return None
    return int(modes_of_trusses(group.bodies + 1, joints)[0]) or None
