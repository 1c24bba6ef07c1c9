"""The circuit of a linkage in space: all positions that it reaches from its reference pose, as one curve.

The curve is followed by its length, as in the plane (docs/theory/circuits.md): the drive is an unknown like the others,
so that positions in which it turns back are points like any others.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import tau

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief, explained
from gruebler.base.text import joined, message
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.closure import Place
from gruebler.mechanics.space.following import RANK, Setting, setting

_STEP = 0.05  # radians and sizes: the longest
_LEAST = 1e-6
_STEPS = 5_000
_TURNS = 8  # of Newton's method
_CLOSED = 1e-12
_APART = 0.2  # of a step: a larger correction may lead to another curve
_BENT = 0.9  # the cosine of the angle by which a step may bend

_COMES_BACK = message("The circuit is closed; it was followed in {steps} steps.")
_ENDS = message("The circuit was followed in {steps} steps to where another crosses it.")
_LIMITS = message("The drive turns back at {limits}.")


@compared_by_value
@explained
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class SpatialCircuit:
    """All positions of a linkage in space with one drive on one curve, from its reference pose on."""

    linkage: SpatialLinkage
    drives: Reals
    """(samples,) the drive's values, with whole turns."""
    unknowns: dict[tuple[int, str], Reals]
    """(samples,): the values of the freedoms (joint, direction) that were solved for, with whole turns."""
    arcs: Reals
    """(samples,) where the samples lie on the curve: its length in radians and sizes of all unknowns."""
    closed: bool
    """Whether it comes back to the reference pose, which is then the last sample again."""
    limits: tuple[float, ...]
    """The drive's values where it turns back, in order along the curve."""

    def __len__(self) -> int:
        return len(self.drives)

    def explain(self, lang: str = "en") -> str:
        """Whether it is closed, and where the drive turns back: lines in English or German (``de``)."""
        lines = [(_COMES_BACK if self.closed else _ENDS).filled(steps=len(self) - 1)]
        if self.limits:
            limits = joined([drive_values(self.linkage, (value,)) for value in self.limits])
            lines.append(_LIMITS.filled(limits=limits))
        return "\n".join(line.in_language(lang) for line in lines)


def spatial_circuit(linkage: SpatialLinkage) -> SpatialCircuit:
    """The circuit of a linkage in space with one drive, followed by its length from the reference pose.

    Returns:
        Samples of the curve, whether it is closed, and where the drive turns back. A curve that meets another one ends
        there, and is not closed.

    Raises:
        LinkageError: not one drive, or one that does not fix the motion; loops with balls that are no rods' ends; a
            curve that does not come back in 5,000 steps, such as that of a slide without end.

    Cost:
        Some 0.2 ms a step of at most 0.05 radians or sizes.

    Example:
        >>> from gruebler.mechanics.space import RSSR
        >>> rssr = RSSR(a=60, b=90, c=50, d=70, crank_offset=10, rocker_offset=15, twist=0.9)
        >>> print(spatial_circuit(rssr.linkage(3.0)))
        The circuit is closed; it was followed in ... steps.
        The drive turns back at R(frame-crank) = 139.9°, R(frame-crank) = -140°.

    See Also:
        `gruebler.mechanics.kinematics.circuit`, `gruebler.mechanics.space.move`

    Theory:
        docs/theory/circuits.md
    """
    set_up = setting(linkage)
    tree = set_up.closure.tree
    if len(set_up.drives) != 1:
        raise LinkageError(
            "a circuit needs one drive, but the mechanism has {count}: {drives}",
            count=len(set_up.drives),
            drives=", ".join(linkage.mechanism.drive_names()),
        )
    if tree.folds:
        raise LinkageError("the circuit is followed in linkages whose balls are the ends of rods only")
    curve = _Curve(set_up)
    values, closed = curve.followed()
    columns = {number: k for k, number in enumerate(curve.columns)}
    units = set_up.closure.units
    scale = float(tree.signs[0] * units[set_up.drives[0]])
    lap = np.array([*values, values[1] + values[-1] - values[0]]) if closed else values
    return SpatialCircuit(
        linkage=linkage,
        drives=values[:, 0] * scale,
        unknowns={key: values[:, columns[k]] * units[k] for key, k in tree.unknown.items() if k in columns},
        arcs=np.append(0.0, np.cumsum(np.linalg.norm(np.diff(values, axis=0), axis=1))),
        closed=closed,
        limits=tuple(scale * value for value in curve.turning_points(lap)),
    )


class _Curve:
    """The curve of the drive and the passive unknowns."""

    def __init__(self, set_up: Setting) -> None:
        self.set_up, self.closure = set_up, set_up.closure
        self.columns = [int(set_up.drives[0]), *set_up.passive.tolist()]
        self.turns = np.array([self.closure.tree.nodes[1 + k].turn > 0 for k in self.columns])

    def linearised(self, values: Reals) -> tuple[Reals, Reals, Reals, Reals]:
        """By how much it is open, and the singular value decomposition of the derivatives."""
        q = np.zeros(self.closure.tree.unknowns)
        q[self.columns] = values
        gap, by_unknown = self.closure.linearised(Place(q, self.closure.reference.turns))
        return gap, *np.linalg.svd(by_unknown[:, self.columns])

    def closed_next_to(self, values: Reals) -> tuple[Reals, Reals] | None:
        """The position next to values, across the curve, and its tangent; None if there is none."""
        rank = self.set_up.rank
        for _ in range(_TURNS):
            gap, left, sizes, right = self.linearised(values)
            if sizes[rank - 1] < RANK * sizes[0]:
                return None
            if abs(gap).max(initial=0.0) < _CLOSED:
                return values, right[-1]
            values = values - (right[:rank].T / sizes[:rank]) @ (left[:, :rank].T @ gap)
        return None

    def followed(self) -> tuple[Reals, bool]:
        """The samples, and whether the last is the first again, up to whole turns."""
        start = np.zeros(len(self.columns))
        first = self.closed_next_to(start)
        assert first is not None  # the drive fixes the motion there
        values, tangent = start, first[1] * (1.0 if first[1][0] > 0 else -1.0)
        samples, begin, step = [start], tangent, _STEP
        for _ in range(_STEPS):
            while True:
                guess = values + step * tangent
                near = self.closed_next_to(guess)
                if near is not None:
                    new, slope = near
                    slope = slope if slope @ tangent > 0 else -slope
                    if np.linalg.norm(new - guess) < _APART * step and slope @ tangent > _BENT:
                        break
                step /= 2
                if step < _LEAST:
                    return np.array(samples), False
            whole = np.where(self.turns, tau * np.round(new / tau), 0.0)
            before, after = (values - whole) @ begin, (new - whole) @ begin
            if len(samples) > 3 and before < 0 <= after and np.linalg.norm(new - whole) < 2 * step:
                return np.array([*samples, whole]), True
            samples.append(new)
            values, tangent, step = new, slope, min(1.5 * step, _STEP)
        raise LinkageError("the circuit does not come back within {steps} steps", steps=_STEPS)

    def turning_points(self, samples: Reals) -> list[float]:
        """The drive's values where it is largest or smallest, from the samples on both sides."""
        points = []
        drives = np.diff(samples[:, 0])
        for k in np.flatnonzero(drives[:-1] * drives[1:] < 0).tolist():
            low, high = samples[k], samples[k + 2]
            sign = float(np.sign(drives[k]))
            for _ in range(60):  # bisection on the tangent's share in the drive
                between = self.closed_next_to((low + high) / 2)
                if between is None:
                    break
                middle, slope = between
                slope = slope if slope @ (high - low) > 0 else -slope
                low, high = (middle, high) if slope[0] * sign > 0 else (low, middle)
                if np.linalg.norm(high - low) < _CLOSED:
                    break
            points.append(float(low[0]))
        return points
