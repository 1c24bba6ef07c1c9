"""Taylor series of a whole linkage in its drive, to any order, by exact arithmetic with power series."""

from __future__ import annotations

from cmath import rect
from dataclasses import dataclass
from typing import Any

import numpy as np

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.points import PointLike, place_of

_HIGHEST = 40
_SINGULAR = 1e-9  # a smaller root: the drive stands at a limit, or assembly modes meet


@compared_by_value
@dataclass(frozen=True, eq=False)
class TaylorSeries:
    """Taylor coefficients by powers of the drive's increase (radians, or the unit), at each row of a motion."""

    motion: Motion
    places: Complexes
    """(order + 1, rows, links): of the links' origins."""
    turns: Complexes
    """(order + 1, rows, links): of cosine + i sine of the links' angles."""

    @property
    def order(self) -> int:
        """The highest power."""
        return len(self.places) - 1

    def complex_point(self, name: PointLike) -> Complexes:
        """The coefficients of a named point or joint, as x + iy; (order + 1, rows)."""
        place = place_of(self.motion.linkage, name)
        k = self.motion.link_index(place.link)
        coefficients: Complexes = self.places[..., k] + self.turns[..., k] * complex(place.x, place.y)
        return coefficients


@dataclass(frozen=True, slots=True, kw_only=True)
class _Condition:
    """A scalar closing condition, or two of them for a pin, between two links by number."""

    kind: str
    first: int
    second: int
    near: complex
    far: complex
    line: complex


def taylor_series(motion: Motion, order: int) -> TaylorSeries:
    """The Taylor coefficients of all links in the drive of a linkage with one drive.

    Powers are found one after another: the closing conditions are linear in the highest, with the Jacobian of the pose.
    Error: that of the pose times the condition of the Jacobian, in units of size/r^k, r being the convergence radius.
    Cost: order^2 times the number of joints, and one linear system, for each row.

    Raises `LinkageError` at a limit of the drive or a change point, where there is no such series.

    >>> from gruebler.mechanics.kinematics import move
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> found = taylor_series(move(SliderCrank(1, 1).linkage(), [0.0]), 6)  # the slider at 2 cos(phi)
    >>> (found.complex_point("R(coupler-slider)")[:, 0].real.round(12) + 0.0).tolist()
    [2.0, 0.0, -1.0, 0.0, 0.083333333333, 0.0, -0.002777777778]
    """
    if isinstance(order, bool) or not isinstance(order, int) or not 1 <= order <= _HIGHEST:
        raise LinkageError(
            "the order of a series is a whole number from 1 to {highest}, not {order!r}", highest=_HIGHEST, order=order
        )
    lower = motion.lower_linkage
    if len(lower.mechanism.drives) != 1:
        raise LinkageError("a series needs one drive, but this linkage has {count}", count=len(lower.mechanism.drives))
    roots = np.abs(motion.roots[:, motion.plan.branching])
    if roots.size and roots.min() < _SINGULAR:
        row = int(np.argmin(roots.min(axis=1)))
        raise LinkageError(
            "at the drive value {drives:.9g} assembly modes meet: there is no series in the drive",
            drives=motion.drives[row, 0],
        )
    conditions = _conditions(lower)
    z: Complexes = np.zeros((*motion.turns.shape, order + 1), np.complex128)
    turn = np.zeros_like(z)
    z[..., 0], turn[..., 0] = motion.places[0] / lower.size, motion.turns
    angle = np.zeros(z.shape)
    frame = lower.mechanism.chain.links.index(lower.mechanism.frame)
    bodies = [k for k in range(z.shape[1]) if k != frame]
    jacobian = _rows(conditions, z, turn, bodies)
    for k in range(1, order + 1):
        powers = np.arange(1, k)
        turn[..., k] = 1j / k * (powers * angle[..., 1:k] * turn[..., k - 1 : 0 : -1]).sum(axis=-1)
        right: Reals = -_residual(conditions, z, turn, angle, k)
        if k == 1:
            turning = lower.mechanism.drives[0].turning
            right[:, -1] += 1.0 if turning else 1 / lower.size
        solution = _solved(jacobian, right).reshape(len(right), -1, 3)
        z[:, bodies, k] = solution[..., 0] + 1j * solution[..., 1]
        angle[:, bodies, k] = solution[..., 2]
        turn[:, bodies, k] += 1j * solution[..., 2] * turn[:, bodies, 0]
    return TaylorSeries(motion, np.moveaxis(z * lower.size, -1, 0), np.moveaxis(turn, -1, 0))


def _conditions(lower: Linkage) -> list[_Condition]:
    """Those of the joints, and last that of the drive; lengths in sizes."""
    chain = lower.mechanism.chain
    conditions = []
    for number, joint in enumerate(chain.joints):
        if not joint.pair.is_basic:
            raise LinkageError(
                "a series needs turning and sliding joints; {joint} is neither",
                joint=chain.joint_title(number),
            )
        for other in joint.links[1:]:
            kinds = ("pin",) if joint.pair.is_turning else ("angle", "across")
            conditions += [_condition(lower, kind, number, joint.links[0], other) for kind in kinds]
    drive = lower.mechanism.drives[0]
    first, second = lower.reference(0)
    kind = "angle" if drive.turning else "along"
    return [*conditions, _condition(lower, kind, drive.joint, first, second)]


def _solved(jacobian: Reals, right: Reals) -> Reals:
    try:
        return np.asarray(np.linalg.solve(jacobian, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        raise LinkageError("the linkage is in a singular pose: there is no series in the drive") from None


def _condition(lower: Linkage, kind: str, joint: int, first: str, second: str) -> _Condition:
    near, far = lower.elements[joint, first], lower.elements[joint, second]
    return _Condition(
        kind=kind,
        first=lower.mechanism.chain.links.index(first),
        second=lower.mechanism.chain.links.index(second),
        near=complex(near.x, near.y) / lower.size,
        far=complex(far.x, far.y) / lower.size,
        line=rect(1, near.direction),
    )


def _residual(conditions: list[_Condition], z: Complexes, turn: Complexes, angle: Reals, k: int) -> Reals:
    """The k-th coefficients of the conditions; (rows, equations)."""
    coefficients = []
    for c in conditions:
        if c.kind == "angle":
            coefficients.append(angle[:, c.second, k] - angle[:, c.first, k])
            continue
        gap = z[:, c.second] + turn[:, c.second] * c.far - z[:, c.first] - turn[:, c.first] * c.near
        if c.kind == "pin":
            coefficients += [gap[:, k].real, gap[:, k].imag]
            continue
        seen = (np.conj(turn[:, c.first, : k + 1] * c.line) * gap[:, k::-1]).sum(axis=1)
        coefficients.append(seen.imag if c.kind == "across" else seen.real)
    return np.stack(coefficients, axis=1)


def _rows(conditions: list[_Condition], z: Complexes, turn: Complexes, bodies: list[int]) -> Reals:
    """The Jacobian of the conditions by x, y and angle of each body; (rows, equations, unknowns)."""
    rows = []
    for c in conditions:
        arms = {c.first: turn[:, c.first, 0] * c.near, c.second: turn[:, c.second, 0] * c.far}
        gap = z[:, c.second, 0] + arms[c.second] - z[:, c.first, 0] - arms[c.first]
        line = turn[:, c.first, 0] * c.line
        measures: tuple[Any, ...] = {"pin": (1, 1j), "across": (1j * line,), "along": (line,), "angle": (0 * line,)}[
            c.kind
        ]
        for measure in measures:
            row = np.zeros((len(z), 3 * z.shape[1]))
            for body, sign in ((c.first, -1), (c.second, 1)):
                row[:, 3 * body] = sign * np.real(measure)
                row[:, 3 * body + 1] = sign * np.imag(measure)
                row[:, 3 * body + 2] = sign * (np.conj(measure) * 1j * arms[body]).real
                if c.kind == "angle":
                    row[:, 3 * body + 2] = sign
            if c.kind in ("across", "along"):
                row[:, 3 * c.first + 2] += (np.conj(1j * measure) * gap).real
            rows.append(row)
    columns = [3 * body + part for body in bodies for part in range(3)]
    return np.stack(rows, axis=1)[..., columns]
