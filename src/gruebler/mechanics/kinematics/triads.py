"""All assembly modes of groups of four bodies, exactly: one trigonometric polynomial in the angle of one body.

Five bodies, what is known being one of them, are joined in one way only (docs/theory/assembly-modes.md): two of them,
the base and the hub, by three legs. The equations are seen from the base, whatever is known.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.assembly_modes import (
    AssemblyModes,
    GroupConditions,
    GroupSolver,
    Method,
    conditions,
    ordered_modes,
    search_modes,
)
from gruebler.mechanics.kinematics.kernel_records import PIN, SLIDE

BOUNDS = {
    ("RR", "RR", "RR"): 6,
    ("PR", "RR", "RR"): 6,
    ("RP", "RR", "RR"): 6,
    ("PR", "RP", "RR"): 6,
    ("PR", "PR", "RR"): 4,
    ("RP", "RP", "RR"): 4,
    ("PR", "PR", "RP"): 4,
    ("PR", "RP", "RP"): 4,
    ("PR", "PR", "PR"): 2,
    ("RP", "RP", "RP"): 2,
    ("PP", "RR", "RR"): 2,
    ("PP", "PR", "RR"): 2,
    ("PP", "RP", "RR"): 2,
    ("PP", "PR", "PR"): 1,
    ("PP", "PR", "RP"): 1,
    ("PP", "RP", "RP"): 1,
}
"""The number of modes, complex ones included, by the legs from the base (outer joint first) to the hub."""

_SAMPLES = 8  # more than twice the degree 3
_ASKEW = complex(0.8, 0.6)  # a direction that no joint is likely to have
_NOISE = 1e-13  # of the largest: coefficients below are none
_VANISHING = 1e-12  # of its terms: a determinant below is none
_ON_CIRCLE = 2e-3  # roots of modulus so near to 1 are tried
_OPEN = 1e-2  # a trial that misses a leg equation by more is dropped
_FLAT = 1e-3  # sine of the angle below which two lines do not determine a point well

Z = TypeVar("Z", complex, NDArray[np.complex128])


_LETTERS = {PIN: "R", SLIDE: "P"}


class _End(NamedTuple):
    """A joint element: a point and a direction in its body."""

    point: complex
    line: complex


@dataclass(frozen=True, slots=True, kw_only=True)
class _Leg:
    """A body between base and hub, with its four joint elements."""

    body: int
    kinds: tuple[int, int]
    """Of its joint at the base and of that at the hub: PIN or SLIDE."""
    base: _End
    outer: _End
    inner: _End
    hub: _End

    @property
    def form(self) -> str:
        """Its joints in letters, such as RP."""
        return "".join(_LETTERS[kind] for kind in self.kinds)

    @property
    def slides(self) -> tuple[bool, bool]:
        """Whether its joint at the base slides, and that at the hub."""
        return self.kinds[0] == SLIDE, self.kinds[1] == SLIDE


class _Truss(NamedTuple):
    """The group as two bodies and the legs between them."""

    base: int
    """Its number; -1 if it is what is known."""
    hub: int
    legs: tuple[_Leg, ...]
    """Sorted by form, so that one of form RR, if there is any, is the last."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Locus:
    """What a leg asks of the hub's origin X when the hub's turn is z: round |X|^2 + 2 Re(conj(g) X) + c = 0.

    g = g0 + g1 z, c = c0 + Re(c1 z).
    """

    round: bool
    g0: complex
    g1: complex
    c0: float
    c1: complex

    def at(self, z: Z) -> tuple[Z, Any]:
        """The coefficients g and c at a turn or turns."""
        return self.g0 + self.g1 * z, self.c0 + (self.c1 * z).real


def is_triad(group: GroupConditions) -> bool:
    """Whether `triad_modes` answers for a group: four bodies and what is known, two joined by three legs."""
    return _truss(group) is not None


def all_modes(group: GroupConditions, *, seed: int = 0) -> AssemblyModes:
    """All assembly modes: exactly for groups of four bodies, by `search_modes` for all others."""
    return triad_modes(group) if is_triad(group) else search_modes(group, seed=seed)


def triad_modes(group: GroupConditions) -> AssemblyModes:
    """All assembly modes of a group of four bodies (class III or IV).

    Errors: poses to some roundings of the group's size, in a singular pose to their square root. Two modes nearer than
    1e-6 of the size are given as one with multiplicity 2. ``method`` is ``degenerate`` where infinitely many poses
    satisfy the conditions.

    Cost: about a millisecond.

    Raises:
        LinkageError: if the group is not of that structure, or has two PP legs, which hold the hub's angle twice.

    >>> from gruebler.mechanics.kinematics.assembly_modes import conditions
    >>> base, hub = (0j, 15.91 + 0j, 10j), (0j, 17.04 + 0j, 13.2122 + 16.1161j)
    >>> rows = []
    >>> for k, length in enumerate((14.98, 15.38, 12.0), start=1):
    ...     rows += [(PIN, -1, k, base[k - 1], 1, 0j, 1), (PIN, k, 0, length + 0j, 1, hub[k - 1], 1)]
    >>> modes = triad_modes(conditions(rows))
    >>> len(modes), modes.exact, modes.bound
    (6, True, 6)
    """
    truss = _truss(group)
    if truss is None:
        raise LinkageError(
            "not a group of four bodies in which two, or one and what is known, are joined by three legs"
        )
    forms = tuple(sorted(leg.form for leg in truss.legs))
    if forms not in BOUNDS:
        raise LinkageError("two legs that slide at both ends hold the angle of the hub twice: this is no group")
    size = group.size
    legs = _centred(truss.legs, size)
    turns = None if any(map(_is_loose, legs)) else _turns(legs)
    distinct, counts, movable = _settled(legs, turns or [])
    poses, order = ordered_modes([_seen_from_known(pose, truss, size) for pose in distinct], size, 4)
    method: Method = "degenerate" if turns is None or movable else "exact"
    return AssemblyModes(
        poses=poses, multiplicities=tuple(counts[k] for k in order), method=method, bound=BOUNDS[forms]
    )


def _settled(legs: Sequence[_Leg], turns: Sequence[complex]) -> tuple[list[Reals], list[int], bool]:
    """The isolated poses that belong to turns of the hub, their multiplicities; and whether there are movable ones."""
    solver = GroupSolver(_conditions(legs))
    distinct: list[Reals] = []
    for turn in turns:
        for trial in _trials(legs, turn):
            pose = trial.copy()
            if not solver.settle(pose):
                pose = trial
                if not solver.settle_singular(pose):
                    continue
            if solver.index_of_known(distinct, pose) < 0:
                distinct.append(pose)
    counts = [2 if solver.is_singular(pose) else 1 for pose in distinct]
    still = [k for k, pose in enumerate(distinct) if counts[k] == 1 or not solver.moves(pose)]
    return [distinct[k] for k in still], [counts[k] for k in still], len(still) < len(distinct)


def _truss(group: GroupConditions) -> _Truss | None:
    """Base and hub: what is known if it has three joints, else the lowest body with three, and the other one."""
    if group.bodies != 4:
        return None
    degrees = [int((group.owners == body).sum()) for body in range(-1, 4)]
    ends = [body for body in range(-1, 4) if degrees[body + 1] == 3]
    if len(ends) != 2:
        return None
    base, hub = ends
    legs = []
    for body in set(range(-1, 4)) - set(ends):
        outer, inner = _joint(group, base, body), _joint(group, body, hub)
        if outer is None or inner is None:
            return None
        legs.append(
            _Leg(body=body, kinds=(outer[0], inner[0]), base=outer[1], outer=outer[2], inner=inner[1], hub=inner[2])
        )
    return _Truss(base, hub, tuple(sorted(legs, key=lambda leg: (leg.form, leg.body))))


def _joint(group: GroupConditions, first: int, second: int) -> tuple[int, _End, _End] | None:
    """The only joint between two bodies: its kind and its elements; None if there is not one."""
    joints = []
    for c, kind in enumerate(group.kinds):
        slots = {int(group.owners[2 * c]): 2 * c, int(group.owners[2 * c + 1]): 2 * c + 1}
        if set(slots) == {first, second}:
            ends = [_End(complex(group.points[slots[b]]), complex(group.lines[slots[b]])) for b in (first, second)]
            joints.append((int(kind), ends[0], ends[1]))
    return joints[0] if len(joints) == 1 else None


def _origins(legs: Sequence[_Leg]) -> tuple[complex, complex]:
    """The means of the base's and of the hub's points."""
    return sum(leg.base.point for leg in legs) / 3, sum(leg.hub.point for leg in legs) / 3


def _centred(legs: Sequence[_Leg], size: float) -> tuple[_Leg, ...]:
    """The legs in units of the size; origins are the means of base's and hub's points, and the legs' outer joints."""
    base, hub = _origins(legs)

    def moved(end: _End, origin: complex) -> _End:
        return _End((end.point - origin) / size, end.line)

    return tuple(
        _Leg(
            body=leg.body,
            kinds=leg.kinds,
            base=moved(leg.base, base),
            outer=moved(leg.outer, leg.outer.point),
            inner=moved(leg.inner, leg.outer.point),
            hub=moved(leg.hub, hub),
        )
        for leg in legs
    )


def _conditions(legs: Sequence[_Leg]) -> GroupConditions:
    """The same group seen from its base: body 0 is the hub, 1 to 3 are the legs."""
    rows = []
    for k, leg in enumerate(legs, start=1):
        rows.append((leg.kinds[0], -1, k, *leg.base, *leg.outer))
        rows.append((leg.kinds[1], k, 0, *leg.inner, *leg.hub))
    return conditions((a, b, c, p, q, r, s) for a, b, c, p, q, r, s in rows)


def _seen_from_known(pose: Reals, truss: _Truss, size: float) -> Reals:
    """Undo `_centred`, and see the bodies from what is known, in their own order."""
    legs = truss.legs
    base, hub = _origins(legs)
    origins = [hub, *(leg.outer.point for leg in legs)]
    turns = dict(zip([truss.hub, *(leg.body for leg in legs)], np.exp(1j * pose[2::3]), strict=True))
    places = {
        body: size * complex(x, y) + base - turn * origin
        for (body, turn), x, y, origin in zip(turns.items(), pose[0::3], pose[1::3], origins, strict=True)
    }
    turns[truss.base], places[truss.base] = 1, 0j
    known, seat = turns[-1], places[-1]
    seen = []
    for body in range(4):
        z = (places[body] - seat) * known.conjugate()
        seen += [z.real, z.imag, float(np.angle(turns[body] * known.conjugate()))]
    return np.array(seen)


def _is_loose(leg: _Leg) -> bool:
    """Whether the leg itself can move when base and hub are held: pins in one place, or slides that are parallel."""
    if not any(leg.slides):
        return abs(leg.inner.point - leg.outer.point) < _VANISHING
    return all(leg.slides) and abs(_cross(leg.outer.line, leg.inner.line)) < _VANISHING


def _locus(leg: _Leg) -> _Locus:
    a, h, arm = leg.base.point, leg.hub.point, leg.inner.point - leg.outer.point
    if not any(leg.slides):
        return _Locus(round=True, g0=-a, g1=h, c0=abs(h) ** 2 + abs(a) ** 2 - abs(arm) ** 2, c1=-2 * h * a.conjugate())
    if leg.slides[0]:
        u = leg.base.line
        start = a + u * leg.outer.line.conjugate() * arm
        return _Locus(round=False, g0=0.5j * u, g1=0j, c0=-_cross(u, start), c1=-1j * u.conjugate() * h)
    m = leg.hub.line
    return _Locus(
        round=False, g0=0j, g1=0.5j * m, c0=_cross(m, h) - _cross(leg.inner.line, arm), c1=-1j * m * a.conjugate()
    )


def _turns(legs: Sequence[_Leg]) -> list[complex] | None:
    """The turns of the hub that may belong to modes; None if all do."""
    for leg in legs:
        if all(leg.slides):
            return [leg.base.line * leg.outer.line.conjugate() * leg.inner.line * leg.hub.line.conjugate()]
    samples = _condition([_locus(leg) for leg in legs], np.exp(2j * np.pi * np.arange(_SAMPLES) / _SAMPLES))
    if samples is None:
        return None
    coefficients = np.roll(np.fft.fft(samples), 3)[6::-1]
    coefficients[np.abs(coefficients) < _NOISE * np.abs(coefficients).max()] = 0
    return [complex(z / abs(z)) for z in np.roots(coefficients) if abs(abs(z) - 1) < _ON_CIRCLE]


def _condition(loci: Sequence[_Locus], z: Complexes) -> Reals | None:
    """The trigonometric polynomial whose zeros are the turns with a common point; None if it vanishes identically."""
    round_, (g, c) = loci[-1].round, loci[-1].at(z)
    (g1, c1), (g2, c2) = _lines(loci[:-1], z, (g, c))
    d, n = _cross(g1, g2), 1j * (c1 * g2 - c2 * g1)
    n_terms = np.abs(c1 * g2) + np.abs(c2 * g1)
    if not round_:
        f = c * d + c1 * _cross(g2, g) + c2 * _cross(g, g1)
        terms = np.abs(c * g1 * g2) + n_terms * np.abs(g)
    elif np.abs(d).max() <= _VANISHING * np.abs(g1 * g2).max():
        f, terms = (_ASKEW * n).real, n_terms
    else:
        f = np.abs(n) ** 2 / 4 + d * (g.conj() * n).real + c * d**2
        terms = n_terms**2 + np.abs(g * g1 * g2) * n_terms + np.abs(c) * np.abs(g1 * g2) ** 2
    return None if np.abs(f).max() <= _VANISHING * terms.max() else f


def _lines(loci: Sequence[_Locus], z: Z, last: tuple[Z, Any]) -> list[tuple[Z, Any]]:
    """Loci as lines: from circles the last one is subtracted."""
    lines = []
    for locus in loci:
        g, c = locus.at(z)
        lines.append((g - last[0], c - last[1]) if locus.round else (g, c))
    return lines


def _cross(a: Any, b: Any) -> Any:
    return (np.conjugate(a) * b).imag


def _trials(legs: Sequence[_Leg], turn: complex) -> Iterator[Reals]:
    """Poses of all bodies, flat, from which Newton's method finds those with about this turn of the hub."""
    loci = [_locus(leg) for leg in legs if not all(leg.slides)]
    values = [(locus.round, *locus.at(turn)) for locus in loci]
    for x in _places(loci, turn):
        gaps = [round_ * abs(x) ** 2 + 2 * (g.conjugate() * x).real + c for round_, g, c in values]
        if max(map(abs, gaps)) < _OPEN * (1 + abs(x) ** 2):
            yield _pose(legs, turn, x)


def _places(loci: Sequence[_Locus], z: complex) -> Iterator[complex]:
    """Where the origin of the hub can be when its turn is z; more than enough."""
    round_, (g, c) = loci[-1].round, loci[-1].at(z)
    lines = _lines(loci[:-1], z, (g, c)) + ([] if round_ else [(g, c)])
    sine = 0.0
    for (g1, c1), (g2, c2) in combinations(lines, 2):
        d = _cross(g1, g2)
        new = abs(d) / (abs(g1 * g2) or 1)
        if new > sine:
            sine, x = new, 0.5j * (c1 * g2 - c2 * g1) / d
    if sine > (_FLAT if round_ else _VANISHING):
        yield x
    normal, offset = max(lines, key=lambda line: abs(line[0]))
    width, least = abs(normal), min(abs(line[0]) for line in lines)
    if round_ and (sine <= _FLAT or least < _OPEN) and width > _VANISHING:
        depth = ((normal.conjugate() * -g).real + offset / 2) / width
        chord = np.sqrt(max(0.0, abs(g) ** 2 - c - depth**2))
        yield from (-g + normal / width * complex(-depth, side) for side in (chord, -chord))
    if round_ and width < _OPEN:  # all circles concentric
        yield -g + np.sqrt(max(0.0, abs(g) ** 2 - c))
    if not round_ and sine < _OPEN:  # parallel lines
        yield -offset * normal / (2 * width**2)


def _pose(legs: Sequence[_Leg], turn: complex, place: complex) -> Reals:
    """All bodies, when the hub is known."""
    pose = [place.real, place.imag, np.angle(turn)]
    for leg in legs:
        a, u = leg.base
        pin, slide = place + turn * leg.hub.point, turn * leg.hub.line
        outside, inside = leg.slides
        if not (outside or inside):
            own = (pin - a) / (leg.inner.point - leg.outer.point)
            own = own / abs(own) if own else 1
        else:
            own = u * leg.outer.line.conjugate() if outside else slide * leg.inner.line.conjugate()
        at = pin - own * leg.inner.point if outside and not inside else a - own * leg.outer.point
        if outside and inside:
            at += u * _cross(slide, pin - at - own * leg.inner.point) / _cross(slide, u)
        pose += [at.real, at.imag, np.angle(own)]
    return np.array(pose)
