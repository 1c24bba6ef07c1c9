"""Finite mobility: which of the velocities at a pose belong to motions.

Near a pose the positions are the zeros of a map F from the velocities k to the self-stresses (Lyapunov and Schmidt):
the constraints that the others leave open after all others have been closed with the part k of the motion held fixed.
F and its first derivatives vanish at the pose. docs/theory/freedoms.md has the theorems, and which way each answer may
err.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.notebook import brief
from gruebler.mechanics.screws.closing import RANK
from gruebler.mechanics.screws.double_roots import is_near_double_root
from gruebler.mechanics.screws.instant_mobility import InstantMobility, instant_mobility
from gruebler.mechanics.screws.obstruction import ObstructionMap
from gruebler.mechanics.screws.quadratic_forms import directions, is_definite

_RADII = (0.02, 0.08, 0.25)  # of the velocities' numbers at which F is looked at: radians and sizes
_TRIES = 4  # directions at each radius
_STARTS = 24  # directions from which zeros of F are sought if its second order says nothing
_NEAR = 0.01  # about a zero of F at the first radius: the pose itself is farther away
_APART = 0.999  # the cosine of directions that count as different
_BESIDE = 0.7  # the cosine of directions between which F is looked at as well
_ALIKE = 2  # zeros with the same mobility and redundancy whose dimension is looked at
_SHARPER = 1e-2  # joints that open by the tolerance of the rank times that, and times the way, are open
_FORM = 1e-5  # a second order that is smaller is none: ten times what `ObstructionMap.second` sets to zero
_ON_SPHERE = 1e-6  # of the radius squared: a zero so near to the sphere lies on it; its distance decides nothing
_OPEN = 3e-12  # a joint that is open by less may be so by rounding


class Evidence(StrEnum):
    """Why the finite mobility is what it is said to be."""

    RIGID = "rigid"
    """No velocity at all: a proof, up to the tolerance of the rank."""
    REGULAR = "regular"
    """No constraint is redundant: the positions are a manifold of the instant mobility. A proof, up to the rank."""
    BLURRED = "blurred"
    """The smallest singular value that counts is no larger than the pose's own error makes it: either of these two, or
    a pose in which one constraint more is redundant."""
    FOLLOWED = "followed"
    """Redundant constraints stay closed along every velocity, as far as it was followed."""
    STRESSED = "stressed"
    """A self-stress makes every velocity open the joints in second order: a proof, up to tolerances."""
    SHAKY = "shaky"
    """Along every velocity the joints open."""
    BRANCHING = "branching"
    """Some velocities belong to motions and others do not: several ways meet, or a motion is only part of them."""
    UNDECIDED = "undecided"
    """The velocities could not be followed at all: the pose is all but singular in yet another way."""


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class FiniteMobility:
    """What following the velocities gave."""

    mobility: int
    """The largest dimension of a set of positions through the pose."""
    evidence: Evidence
    reach: float = 0.0
    """How far it was followed, in radians and sizes."""
    order: int = 0
    """For a shaky linkage the power of the way by which its joints open; 2 or more."""
    open: float = 0.0
    """By how much the joints are open at the farthest point that was tried, in sizes."""
    ways: int = 1
    """How many curves of positions meet at the pose, where they are curves and more than one was found."""


def finite_mobility(instant: InstantMobility) -> FiniteMobility:
    """Follow the velocities of a pose whose joints are closed.

    Cost: some 12 solutions by Newton's method; where motions branch, some 1000 more.
    """
    if is_near_double_root(instant) and not (instant.mobility and instant.redundancy):
        return FiniteMobility(mobility=instant.mobility, evidence=Evidence.BLURRED)
    if instant.mobility == 0:
        return FiniteMobility(mobility=0, evidence=Evidence.RIGID)
    if instant.redundancy == 0:
        return FiniteMobility(mobility=instant.mobility, evidence=Evidence.REGULAR)
    excess = ObstructionMap(instant)
    random = np.random.default_rng(20_261_121)
    closed, reach, gap = _all_closed(excess, random, _RADII)
    if closed:
        return FiniteMobility(mobility=instant.mobility, evidence=Evidence.FOLLOWED, reach=reach)
    return _some_or_none(excess, random, reach, gap)


def _all_closed(
    excess: ObstructionMap, random: np.random.Generator, radii: tuple[float, ...]
) -> tuple[bool, float, float]:
    """Whether F is zero in directions taken at random; how far that was seen, and by how much it is open there."""
    reach, gap, closed = 0.0, 0.0, True
    for radius in radii:
        tried = [excess(radius * k) for k in _unit(random, excess.instant.mobility)]
        gaps = [float(abs(point.value).max(initial=0.0)) for point in tried if point is not None]
        if not gaps:
            break
        reach, gap = radius, max(gaps)
        closed = closed and gap <= max(_SHARPER * excess.instant.tolerance * radius, _OPEN)
    return closed and reach > 0, reach, gap


def _unit(random: np.random.Generator, size: int) -> Reals:
    """Directions to try, (tries, size), both signs of each."""
    half = random.normal(size=(_TRIES // 2, size)) if size > 1 else np.ones((1, 1))
    half /= np.linalg.norm(half, axis=1)[:, None]
    return np.vstack([half, -half])


def _some_or_none(excess: ObstructionMap, random: np.random.Generator, radius: float, gap: float) -> FiniteMobility:
    """F is not zero everywhere: look for the velocities along which it is."""
    instant = excess.instant
    forms = excess.second()
    if forms is None or not radius:
        return FiniteMobility(mobility=0, evidence=Evidence.UNDECIDED)
    order = _order(excess, random, _RADII[0])
    if (instant.mobility == 1 and abs(forms).max() > _FORM) or (instant.mobility > 1 and is_definite(forms)):
        return FiniteMobility(mobility=0, evidence=Evidence.STRESSED, reach=radius, order=order, open=gap)
    ends = _zeros(excess, forms, np.eye(instant.mobility), _RADII[0], random) if instant.mobility > 1 else []
    if not ends:
        return FiniteMobility(mobility=0, evidence=Evidence.SHAKY, reach=radius, order=order, open=gap)
    dimensions = _dimensions(excess, ends, random)
    best = min(max(dimensions), instant.mobility - 1)  # the zeros of an analytic map that is not zero everywhere
    return FiniteMobility(
        mobility=best, evidence=Evidence.BRANCHING, reach=_RADII[0], ways=len(dimensions) if best == 1 else 1
    )


def _zeros(
    excess: ObstructionMap, forms: Reals, basis: Reals, radius: float, random: np.random.Generator, most: int = 1000
) -> list[Reals]:
    """Zeros of F at this distance from the pose, (mobility,) each, in the space of a basis (part, mobility).

    One of each pair of opposite directions, and of each group of near ones or of such as F does not tell apart.
    """
    starts = directions(np.einsum("pi,sij,qj->spq", basis, forms, basis), random, _STARTS)
    zeros: list[Reals] = []
    # where forms have a double zero, F may have zeros beside it on one side only: a cusp
    beside = [sign * k + 0.1 * random.normal(size=len(k)) for k in starts for sign in (1, -1)]
    for start in [*starts, *(-k for k in starts), *beside]:
        k = _on_sphere(excess, basis, radius * start / np.linalg.norm(start))
        if k is not None and not any(_same(excess, k, other) for other in zeros):
            zeros.append(k)
            if len(zeros) >= most:
                break
    return zeros


def _same(excess: ObstructionMap, first: Reals, other: Reals) -> bool:
    """Whether two zeros lie in about the same direction, or F is below its threshold all the way between them."""
    radius = float(np.linalg.norm(first))
    cosine = float(first @ other) / radius**2
    if abs(cosine) >= _APART:
        return True
    if abs(cosine) < _BESIDE:
        return False
    for part in (0.25, 0.5, 0.75):
        between = (1 - part) * first + part * np.sign(cosine) * other
        point = excess(radius * between / np.linalg.norm(between))
        if point is None or abs(point.value).max() >= _closed(excess, radius):
            return False
    return True


def _closed(excess: ObstructionMap, radius: float) -> float:
    """What F may be at a zero so far from the pose."""
    return max(_OPEN, excess.instant.tolerance * radius**2)


def _dimensions(excess: ObstructionMap, ends: list[Reals], random: np.random.Generator) -> list[int]:
    """The dimension of the set of positions at each of these zeros; alike ones are looked at only a few times."""
    closing = excess.instant.closing
    known: dict[tuple[int, int], list[int]] = {}
    dimensions = []
    for k in ends:
        point = excess(k)
        assert point is not None  # k is a zero of F
        pose = closing.settled(closing.moved(excess.instant.pose, point.motion))
        there = instant_mobility(closing, pose, excess.instant.tolerance)
        seen = known.setdefault((there.mobility, there.redundancy), [])
        if len(seen) < _ALIKE:
            seen.append(_dimension(there, random))
        dimensions.append(max(seen))
    return dimensions


def _dimension(instant: InstantMobility, random: np.random.Generator) -> int:
    """The dimension of the set of positions where it is smooth, though its equations may be singular on it.

    A set of dimension d meets a space of m - d + 1 dimensions taken at random in a curve at least.
    """
    excess = ObstructionMap(instant)
    if _all_closed(excess, random, (_NEAR,))[0]:
        return instant.mobility
    forms = excess.second(_NEAR / 100)
    for dimension in range(instant.mobility - 1, 1, -1) if forms is not None else ():
        space = np.linalg.qr(random.normal(size=(instant.mobility, instant.mobility - dimension + 1)))[0].T
        if forms is not None and _zeros(excess, forms, space, _NEAR, random, most=1):
            return dimension
    return 1


def _order(excess: ObstructionMap, random: np.random.Generator, radius: float) -> int:
    """The power by which F grows in a direction taken at random."""
    k = _unit(random, excess.instant.mobility)[0]
    sizes = [0.0 if (point := excess(r * k)) is None else abs(point.value).max() for r in (radius, radius / 2)]
    return max(2, round(float(np.log2(sizes[0] / sizes[1])))) if min(sizes) > 0 else 2


def _on_sphere(excess: ObstructionMap, basis: Reals, start: Reals) -> Reals | None:
    """A zero of F as far from the pose as a start in a space, by Gauss and Newton's method; None if it finds none."""
    radius = float(np.linalg.norm(start))
    u = start
    for _ in range(40):  # a double zero costs a step for each digit of two
        point = excess(u @ basis)
        if point is None:
            return None
        open_by = abs(point.value).max()
        if open_by < _closed(excess, radius) and abs(u @ u - radius**2) < _ON_SPHERE * radius**2:
            return np.asarray(u @ basis)
        system = np.vstack([point.slope @ basis.T, 2 * u])
        step = np.linalg.lstsq(system, -np.append(point.value, u @ u - radius**2), rcond=RANK)[0]
        if not np.linalg.norm(step) < radius:
            return None
        u = u + step
    return None
