"""Four-bars on the sphere that turn a body through orientations, or coordinate two angles.

docs/theory/synthesis-sphere.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations, product
from math import acos, atan2, cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.judging import Demands, transmission_fault
from gruebler.design.synthesis.pair_search import PairClosure, motion_of_pairs
from gruebler.design.synthesis.results import TOO_SLENDER, DesignVerdict, SolutionCount
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.spherical_four_bar import SphericalFourBar
from gruebler.structure.mechanism import Mechanism

MOST_ORIENTATIONS = 5
PAIRS = 4
"""Pairs of angles that a four-bar on the sphere coordinates exactly, both counted from the arc of the frame."""
_COMPLEX = 6
"""Complex dyads of five orientations."""
_SAMPLE = {3: 150, 4: 60}
"""Dyads of three orientations, great circles cut with the curve of four."""
_ROTATION = 1e-9
_RANK = 1e-12  # of the largest singular value: below it conditions depend on one another
_REAL = 1e-7
_EXACT = 1e-12
_SOLVED = 1e-8
_LEAST_ARC = 1e-6
_APART = 0.02  # radians: axes of two designs that are listed differ by more
_ROWS = 33  # poses from one target to the next
_TEXT = "spherical: R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); drive=R(frame-crank)"


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class SphericalDyad:
    """A link with two axes through the centre: one of the frame, one of the body."""

    fixed: Reals
    """(3,) the axis on the frame, a unit vector; the opposite one is the same axis."""
    moving: Reals
    """(3,) the axis on the body, as it lies in the first orientation."""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class SphericalDesign:
    """A four-bar on the sphere, with what it really does."""

    four_bar: SphericalFourBar
    axes: Reals
    """(4, 3) of A0, A, B, B0 at the first target."""
    branch: str
    """+ or -, as of `SphericalFourBar`."""
    drives: tuple[float, ...]
    """The crank angle at each target, counted from the arc of the frame."""
    verdict: DesignVerdict

    @property
    def linkage(self) -> SpatialLinkage:
        """The linkage at its first target, for `move`, `draw` and files."""
        places: dict[str | int, object] = {k: {"z": tuple(axis)} for k, axis in enumerate(self.axes.tolist())}
        return SpatialLinkage(Mechanism.parse(_TEXT), places, outputs=["rocker"])


@dataclass(frozen=True, kw_only=True)
class SphericalResult:
    """The designs for a task on the sphere: accepted ones, the best first, and rejected ones with their reasons."""

    designs: tuple[SphericalDesign, ...]
    rejected: tuple[SphericalDesign, ...]
    count: SolutionCount
    notes: tuple[Message, ...]


def synthesise_orientations(
    orientations: ArrayLike, demands: Demands | None = None, *, number: int = 16
) -> SphericalResult:
    """Four-bars on the sphere whose coupler takes three to five orientations, judged by their motion.

    Args:
        orientations: (targets, 3, 3) rotation matrices.
        demands: a full turn, a transmission angle, a ratio of the arcs; lengths and regions belong to the plane.
        number: of designs that are listed where there are infinitely many.

    Raises:
        SynthesisError: what is no rotation, fewer than three or more than five, orientations that infinitely many
            dyads serve, demands for the plane.

    Cost:
        5 ms for five orientations, 0.2 s for the families.

    >>> def turned(x, z):
    ...     about_z = np.array([[np.cos(z), -np.sin(z), 0], [np.sin(z), np.cos(z), 0], [0, 0, 1]])
    ...     return about_z @ np.array([[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]])
    >>> task = [turned(0, 0), turned(0.3, 0.2), turned(0.5, 0.6), turned(0.6, 1.1), turned(0.3, 1.6)]
    >>> found = synthesise_orientations(task)
    >>> found.count.theorem, found.count.found, found.count.real
    (6, 6, 4)

    See Also:
        `synthesise_spherical_function`, `synthesise_positions`

    Theory:
        docs/theory/synthesis-sphere.md
    """
    wanted = _checked(demands)
    turns = _displacements(orientations)
    count = len(turns) + 1
    notes: list[Message] = []
    if count == MOST_ORIENTATIONS:
        dyads, complex_dyads = five_orientation_dyads(turns)
        theorem: int | None = _COMPLEX
        pairs = [(i, j) for i in range(len(dyads)) for j in range(len(dyads)) if i != j]
    else:
        dyads = _family(turns)
        theorem, complex_dyads = None, len(dyads)
        pairs = _best_pairs(dyads, turns, wanted, number, notes)
    designs = [_judged(_axes_of(dyads[i], dyads[j]), turns, wanted) for i, j in pairs]
    if theorem is not None:  # each linkage once, driven where it does more
        halves = {frozenset(pair): list[SphericalDesign]() for pair in pairs}
        for pair, design in zip(pairs, designs, strict=True):
            halves[frozenset(pair)].append(design)
        designs = [min(both, key=_order) for both in halves.values()]
    return _result(
        designs,
        SolutionCount(what=message("dyads"), theorem=theorem, found=complex_dyads, real=len(dyads)),
        notes,
    )


def synthesise_spherical_function(
    inputs: Iterable[float], outputs: Iterable[float], demands: Demands | None = None, *, frame: float | None = None
) -> SphericalResult:
    """The four-bar on the sphere that coordinates four pairs of angles, or three of them with a given frame.

    Args:
        inputs: crank angles from the arc of the frame, in radians, as of `SphericalFourBar`.
        outputs: the angles of the output.
        demands: as for `synthesise_orientations`.
        frame: the arc between the fixed axes, in radians.

    Raises:
        SynthesisError: other numbers of pairs, pairs whose conditions depend on one another, demands for the plane.

    >>> bar = SphericalFourBar(0.5, 1.4, 1.1, 1.2)
    >>> phi = np.array([0.2, 0.9, 1.7, 2.4])
    >>> found = synthesise_spherical_function(phi, bar.motion(phi).output.value)
    >>> [round(getattr(found.designs[0].four_bar, arc), 9) for arc in "abcd"]
    [0.5, 1.4, 1.1, 1.2]

    Theory:
        docs/theory/synthesis-sphere.md
    """
    wanted = _checked(demands)
    phi, psi = (np.array(list(values), np.float64) for values in (inputs, outputs))
    due = PAIRS if frame is None else PAIRS - 1
    if phi.shape != (due,) or psi.shape != (due,) or not np.isfinite([phi, psi]).all():
        raise SynthesisError(
            "expected {due} pairs of angles, but found {inputs} inputs and {outputs} outputs",
            due=due,
            inputs=phi.size,
            outputs=psi.size,
        )
    if frame is not None and not _LEAST_ARC < frame < pi - _LEAST_ARC:
        raise SynthesisError(
            "{key}: expected an angle between {low} and {high} degrees, but found {angle:g} degrees",
            key="frame",
            low=0,
            high=180,
            angle=np.degrees(frame),
        )
    # k0 cos(phi) + k1 cos(psi) + k2 + k3 cos(phi) cos(psi) = -sin(phi) sin(psi), k3 = cos(frame)
    columns = np.stack([np.cos(phi), np.cos(psi), np.ones(due), np.cos(phi) * np.cos(psi)], axis=1)
    right = -np.sin(phi) * np.sin(psi)
    if frame is not None:
        right, columns = right - cos(frame) * columns[:, 3], columns[:, :3]
    if np.linalg.matrix_rank(columns, _RANK * np.abs(columns).max()) < due:
        raise SynthesisError("the pairs do not determine a linkage: their conditions depend on one another")
    k = np.append(np.linalg.solve(columns, right), [] if frame is None else [cos(frame)])
    count = SolutionCount(what=message("linkages"), theorem=1, found=1, real=1)
    none = (message("The pairs are met by no real linkage."),)
    real = SphericalResult(designs=(), rejected=(), count=count, notes=none)
    if not abs(k[3]) < 1:
        return real
    d = acos(k[3])
    a, c = atan2(sin(d), -k[1]), atan2(sin(d), k[0])
    cosine = cos(a) * cos(c) * cos(d) - k[2] * sin(a) * sin(c)
    if not abs(cosine) < 1:
        return real
    bar = SphericalFourBar(a, acos(cosine), c, d)
    pins = _pins(bar, phi, psi)
    return _result([_verdict(bar, pins, wanted)], count, [])


class SphericalDyads(NamedTuple):
    """The dyads of five orientations."""

    real: tuple[SphericalDyad, ...]
    complex_count: int
    """How many complex ones, of six."""


def five_orientation_dyads(turns: Reals) -> SphericalDyads:
    """The real ones of six dyads of four rotations from the first orientation: (4, 3, 3).

    Four cubics in the axis of the body, the minors of the conditions, leave six of ten monomials; the multiplication
    by one linear form over another has the six solutions as its eigenvalues.

    Raises `SynthesisError` where there are infinitely many.
    """
    cubics = np.stack([_cubic(turns[list(rows)]) for rows in combinations(range(len(turns)), 3)])
    scale = np.abs(cubics).max(initial=0.0)
    _, values, basis = np.linalg.svd(cubics / (scale or 1.0))
    if scale < _RANK or values[-1] < _RANK * values[0]:
        raise SynthesisError(_INFINITELY_MANY)
    kernel = basis[len(values) :].T
    products = np.stack([kernel[[_CUBIC.index(_raised(q, k)) for q in _QUADRATIC]] for k in range(3)])
    first, second = np.tensordot(_FORMS, products, axes=1)
    vectors = np.linalg.eig(np.linalg.solve(second, first))[1]
    ways, exact, dyads = turns - np.eye(3), 0, []
    for k in range(_COMPLEX):
        axis = np.linalg.svd(products @ vectors[:, k])[0][:, 0]
        exact += int(np.linalg.svd(ways @ axis, compute_uv=False)[-1] < _SOLVED)  # some axis of the frame serves it
        square = complex(np.sum(axis * axis))  # of a real axis times any phase its size is 1
        if abs(abs(square) - 1) > _REAL:
            continue
        moving = np.real(axis / np.sqrt(square))
        dyads.append(_polished(turns, moving / np.linalg.norm(moving)))
    return SphericalDyads(tuple(dyads), exact)


_INFINITELY_MANY = message(
    "there are infinitely many dyads: some of the orientations are repeated, or they belong to a rotation"
)
_CUBIC = [e for e in product(range(4), repeat=3) if sum(e) == 3]
_QUADRATIC = [e for e in product(range(3), repeat=3) if sum(e) == 2]
_FORMS = np.array([[0.61, -0.37, 0.53], [0.23, 0.47, -0.67]])
"""Two linear forms in general position; their ratio tells the solutions apart."""


def _raised(exponents: tuple[int, ...], k: int) -> tuple[int, ...]:
    return tuple(e + (m == k) for m, e in enumerate(exponents))


def _cubic(turns: Reals) -> Reals:
    """The determinant of three conditions as a cubic in the axis of the body: its coefficients by `_CUBIC`."""
    a, b, c = turns - np.eye(3)
    crossed = np.cross(b.T[:, None, :], c.T[None, :, :])  # by the coordinates of the axis in b and in c
    terms = np.einsum("ni,jkn->ijk", a, crossed)
    coefficients = np.zeros(len(_CUBIC))
    for rows in product(range(3), repeat=3):
        coefficients[_CUBIC.index((rows.count(0), rows.count(1), rows.count(2)))] += terms[rows]
    return coefficients


def _fixed_axis(turns: Reals, moving: Reals) -> Reals:
    """The axis of the frame, across the ways of an axis of the body."""
    return np.asarray(np.linalg.svd((turns - np.eye(3)) @ moving)[2][-1])


def _polished(turns: Reals, moving: Reals) -> SphericalDyad:
    """Improved by Newton's method on the four conditions, both axes along their tangent planes."""
    fixed = _fixed_axis(turns, moving)
    ways = turns - np.eye(3)
    for _ in range(8):
        own, other = (np.linalg.svd(axis[None])[2][1:] for axis in (fixed, moving))
        residual = ways @ moving @ fixed
        matrix = np.hstack([ways @ moving @ own.T, np.einsum("i,nij->nj", fixed, ways) @ other.T])
        step = np.linalg.lstsq(matrix, -residual, rcond=1e-14)[0]
        fixed, moving = fixed + step[:2] @ own, moving + step[2:] @ other
        fixed, moving = fixed / np.linalg.norm(fixed), moving / np.linalg.norm(moving)
        if np.abs(step).max() < _EXACT:
            break
    return SphericalDyad(fixed=fixed, moving=moving)


def _family(turns: Reals) -> tuple[SphericalDyad, ...]:
    """A sample of the dyads of three or four orientations."""
    if np.linalg.svd(np.concatenate(turns - np.eye(3)), compute_uv=False)[-1] < _REAL:  # an axis that stays
        raise SynthesisError(_INFINITELY_MANY)
    if len(turns) == 2:
        k = np.arange(_SAMPLE[3]) + 0.5
        height, around = 1 - k / _SAMPLE[3], pi * (1 + 5**0.5) * k  # a spiral over half the sphere
        across = np.sqrt(1 - height**2)
        axes = np.stack([across * np.cos(around), across * np.sin(around), height], axis=1)
    else:
        axes = _curve(_cubic(turns))
    dyads = []
    for moving in axes:
        ways = (turns - np.eye(3)) @ moving
        if np.linalg.svd(ways, compute_uv=False)[1] > _REAL:  # else it lies on a pole, which any axis serves
            dyads.append(SphericalDyad(fixed=_fixed_axis(turns, moving), moving=moving))
    if not dyads:
        raise SynthesisError(_INFINITELY_MANY)
    return tuple(dyads)


def _curve(cubic: Reals) -> Reals:
    """(points, 3) of a cubic cone, where great circles through one point cut it."""
    if np.abs(cubic).max() < _RANK:
        raise SynthesisError(_INFINITELY_MANY)
    pole = np.array([0.48, 0.6, 0.64])
    first, second = np.linalg.svd(pole[None])[2][1:]
    t = np.array([-1.0, -1 / 3, 1 / 3, 1.0])
    points = []
    for angle in pi * (np.arange(_SAMPLE[4]) + 0.5) / _SAMPLE[4]:
        across = cos(angle) * first + sin(angle) * second
        places = pole + t[:, None] * across
        values = np.prod(places[:, None, :] ** np.array(_CUBIC), axis=2) @ cubic
        roots = np.roots(np.polyfit(t, values, 3))
        points += [pole + root * across for root in roots.real[np.abs(roots.imag) < _REAL * (1 + np.abs(roots))]]
    axes = np.array(points)
    return np.asarray(axes / np.linalg.norm(axes, axis=1, keepdims=True))


def _best_pairs(
    dyads: tuple[SphericalDyad, ...], turns: Reals, demands: Demands, number: int, notes: list[Message]
) -> list[tuple[int, int]]:
    """The pairs of a family that meet the demands, in closed form: the best that differ; those that fail least."""
    fixed, moving = (np.array([getattr(dyad, name) for dyad in dyads]) for name in ("fixed", "moving"))
    closure = _closures(fixed, moving, turns)
    with np.errstate(invalid="ignore", divide="ignore"):
        branch, moves, full, transmission = motion_of_pairs(closure)
    folded = np.minimum(closure.lengths, pi - closure.lengths)
    ratio = closure.lengths.max(axis=0) / np.maximum(closure.lengths.min(axis=0), 1e-300)
    usable = folded.min(axis=0) > _LEAST_ARC
    path = moves if demands.in_order else branch
    met = np.stack([path | (not demands.one_branch), full | (not demands.crank), ratio <= demands.size_ratio])
    good = np.concatenate([met, [transmission >= demands.transmission]]) & usable
    fails = np.where(usable, np.sum(~good, axis=0), 99)
    notes.append(
        message(
            "{dyads} dyads, each with each and driven at either: of {pairs:,} four-bars {count:,} meet all demands.",
            dyads=len(dyads),
            pairs=len(dyads) * (len(dyads) - 1),
            count=int(np.count_nonzero(fails == 0)),
        )
    )
    # An arc near 0 or half a circle folds the linkage to a point, as a large ratio does in the plane.
    ranks = np.lexsort(
        [(-folded.min(axis=0)).ravel(), -np.round(transmission, 6).ravel(), ~full.ravel(), fails.ravel()]
    )
    chosen: list[tuple[int, int]] = []
    for rank in ranks[: 200 * number]:
        i, j = divmod(int(rank), len(dyads))
        alike = any(_gap(moving[i], moving[k]) + _gap(moving[j], moving[m]) < _APART for k, m in chosen)
        if i != j and not alike and fails[i, j] == fails.ravel()[ranks[0]]:
            chosen.append((i, j))
        if len(chosen) == number:
            break
    return chosen


def _gap(first: Reals, second: Reals) -> float:
    """The angle of two axes."""
    return float(np.arccos(min(1.0, abs(float(first @ second)))))


def _closures(fixed: Reals, moving: Reals, turns: Reals) -> PairClosure:
    """Where the crank of each pair of dyads can be assembled: cos(A B0) = cos a cos d + sin a sin d cos(phi)."""
    pins = np.concatenate([moving[None], np.einsum("kij,nj->kni", turns, moving)])  # (targets, dyads, 3)
    cosines = [np.einsum("ni,ni->n", fixed, moving), moving @ moving.T, fixed @ fixed.T]
    own, b, d = (np.arccos(np.clip(each, -1, 1)) for each in cosines)
    a, c = np.broadcast_to(own[:, None], b.shape), np.broadcast_to(own[None, :], b.shape)
    with np.errstate(invalid="ignore", divide="ignore"):
        low, high = ((np.cos(arc) - np.cos(a) * np.cos(d)) / (np.sin(a) * np.sin(d)) for arc in (b + c, b - c))
        normals = np.cross(fixed[:, None], fixed[None])
        across = np.einsum("ijx,kix->ijk", normals, pins) / np.sin(d)[..., None]
        ahead = np.einsum("jx,kix->ijk", fixed, pins) - np.cos(d)[..., None] * np.cos(a)[..., None]
        angle = np.arctan2(across, ahead / np.sin(d)[..., None])
        arms = np.cross(pins[:, :, None], fixed[None, None])  # (targets, i, j, 3): A x B0
        side = np.sign(np.einsum("kijx,kjx->ijk", arms, pins))
    return PairClosure(
        lengths=np.array([a, b, c, d]),
        low=low,
        high=high,
        angle=angle,
        side=side,
        cosine=lambda x: (
            (np.cos(a) * np.cos(d) + np.sin(a) * np.sin(d) * x - np.cos(b) * np.cos(c)) / (np.sin(b) * np.sin(c))
        ),
    )


def _axes_of(first: SphericalDyad, second: SphericalDyad) -> Reals:
    """(4, 3) A0, A, B, B0, each on the side of the sphere that is nearer to the one before."""
    axes = [first.fixed]
    for axis in (first.moving, second.moving, second.fixed):
        axes.append(axis if axes[-1] @ axis >= 0 else -axis)
    return np.array(axes)


def _judged(axes: Reals, turns: Reals, demands: Demands) -> SphericalDesign:
    """The design of four axes in the first orientation, by the motion of its four-bar."""
    arcs = [
        float(np.arctan2(np.linalg.norm(np.cross(p, q)), p @ q)) for p, q in zip(axes, axes[[1, 2, 3, 0]], strict=True)
    ]
    moved = np.concatenate([axes[None, 1:3], np.einsum("kij,nj->kni", turns, axes[1:3])])
    ends = np.broadcast_to(axes[[0, 3]], (len(moved), 2, 3))
    pins = np.stack([ends[:, 0], moved[:, 0], moved[:, 1], ends[:, 1]], axis=1)
    return _verdict(SphericalFourBar(*arcs), pins, demands)


def _pins(bar: SphericalFourBar, phi: Reals, psi: Reals) -> Reals:
    """(targets, 4, 3) A0, A, B, B0 where the frame lies as `SphericalFourBar` has it."""
    a, c, d = bar.a, bar.c, bar.d
    b0, along, across = np.array([sin(d), 0, cos(d)]), np.array([cos(d), 0, -sin(d)]), np.array([0.0, 1, 0])
    pins = np.zeros((len(phi), 4, 3))
    pins[:, 0], pins[:, 3] = [0, 0, 1], b0
    pins[:, 1] = np.stack([sin(a) * np.cos(phi), sin(a) * np.sin(phi), np.full(len(phi), cos(a))], axis=1)
    pins[:, 2] = cos(c) * b0 + sin(c) * (np.cos(psi)[:, None] * along + np.sin(psi)[:, None] * across)
    return pins


def _verdict(bar: SphericalFourBar, pins: Reals, demands: Demands) -> SphericalDesign:
    """What a four-bar does whose axes lie so at the targets, (targets, 4, 3): by `SphericalFourBar.motion`."""
    a0, first, b0 = pins[0, 0], pins[:, 1], pins[0, 3]
    x = (b0 - (a0 @ b0) * a0) / np.linalg.norm(np.cross(a0, b0))
    y = np.cross(a0, x)
    along = np.cross(y, b0)
    phi = np.arctan2(first @ y, first @ x)
    psi = np.arctan2(pins[:, 2] @ y, pins[:, 2] @ along)
    sides = np.sign(np.einsum("nx,nx->n", np.cross(first, b0), pins[:, 2]))
    reasons: list[Message] = []
    ranges = [arc for arc in bar.limits if all(float(angle) in arc for angle in phi)]
    one_branch = bool(ranges) and bool((sides == sides[0]).all() and sides[0] != 0)
    full = bool(bar.limits) and bar.limits[0].full
    path = phi
    in_order, error, transmission = False, np.inf, np.nan
    if one_branch:
        start = 0.0 if full else ranges[0].start
        path = start + (phi - start) % (2 * pi)
        steps = np.diff(path)
        onward, back = (steps % (2 * pi)).sum(), ((-steps) % (2 * pi)).sum()
        in_order = bool(min(onward, back) < 2 * pi if full else (steps > 0).all() or (steps < 0).all())
        if full and in_order:
            turned = np.cumsum(steps % (2 * pi)) if onward <= back else -np.cumsum((-steps) % (2 * pi))
            path = path[0] + np.append(0.0, turned)
        low, high = path.min(), path.max()
        dead = [k * pi for k in range(int(np.ceil(low / pi)), int(np.floor(high / pi)) + 1)]
        motion = bar.motion(path, branch="+" if sides[0] > 0 else "-")
        error = float(np.abs(np.angle(np.exp(1j * (motion.output.value - psi)))).max())
        rows = np.append(np.linspace(low, high, _ROWS * len(path)), [*path, *dead])
        between = bar.motion(rows, branch="+" if sides[0] > 0 else "-")
        if not np.isfinite(between.output.value).all():
            one_branch = False
        transmission = float(np.min(between.transmission_angle))
    if not one_branch:
        reasons.append(message("not all targets lie on one branch"))
    elif not error <= demands.tolerance:
        reasons.append(message("a target is missed by {error:.3g} of the size", error=error))
    if one_branch and not in_order and demands.in_order:
        reasons.append(message("the targets are met in another order"))
    if demands.crank and not full:
        reasons.append(message("the drive does not turn fully"))
    if one_branch and demands.transmission > 0 and not transmission >= demands.transmission:
        reasons.append(transmission_fault(transmission))
    arcs = [bar.a, bar.b, bar.c, bar.d]
    ratio = max(arcs) / min(arcs)
    if ratio > demands.size_ratio:
        reasons.append(TOO_SLENDER.filled(ratio=ratio))
    return SphericalDesign(
        four_bar=bar,
        axes=pins[0],
        branch="+" if sides[0] > 0 else "-",
        drives=tuple(map(float, path)),
        verdict=DesignVerdict(
            assembles=True,
            one_circuit=one_branch,
            one_branch=one_branch,
            in_order=in_order,
            turns_fully=full,
            transmission=transmission,
            size_ratio=ratio,
            error=error if one_branch else np.nan,
            reasons=tuple(reasons),
        ),
    )


def _order(design: SphericalDesign) -> tuple[int, bool, float]:
    verdict = design.verdict
    return len(verdict.reasons), not verdict.turns_fully, -np.nan_to_num(verdict.transmission)


def _result(designs: Iterable[SphericalDesign], count: SolutionCount, notes: Iterable[Message]) -> SphericalResult:
    ranked = sorted(designs, key=_order)
    return SphericalResult(
        designs=tuple(design for design in ranked if design.verdict.accepted),
        rejected=tuple(design for design in ranked if not design.verdict.accepted),
        count=count,
        notes=tuple(notes),
    )


def _checked(demands: Demands | None) -> Demands:
    wanted = demands or Demands()
    if wanted.lengths or wanted.region is not None:
        raise SynthesisError("lengths and region: demands for the plane; on the sphere arcs have no unit")
    return wanted


def _displacements(orientations: ArrayLike) -> Reals:
    """(targets - 1, 3, 3) the rotations from the first orientation to each of the others, in the frame."""
    try:
        given = np.asarray(orientations, np.float64)
    except (TypeError, ValueError):
        given = np.zeros(0)
    if given.ndim != 3 or given.shape[1:] != (3, 3) or not 3 <= len(given) <= MOST_ORIENTATIONS:
        raise SynthesisError(
            "orientations: expected three to five matrices of 3 x 3 numbers, but found {shape}", shape=given.shape
        )
    for k, matrix in enumerate(given):
        square = matrix @ matrix.T
        if not (np.abs(square - np.eye(3)).max() < _ROTATION and np.linalg.det(matrix) > 0):
            raise SynthesisError("orientation {number} is no rotation", number=k + 1)
    for k, m in combinations(range(len(given)), 2):
        if np.abs(given[k] - given[m]).max() < _ROTATION:
            raise SynthesisError("orientations {first} and {second} are equal", first=k + 1, second=m + 1)
    return np.asarray(given[1:] @ given[0].T)
