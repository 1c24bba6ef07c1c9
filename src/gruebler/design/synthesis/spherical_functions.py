"""Four-bars on the sphere that coordinate two angles, with given starts or free ones.

docs/theory/synthesis-sphere.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from math import acos, atan2, cos, pi, sin

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.text import joined_by_or, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.results import SolutionCount
from gruebler.design.synthesis.spherical import (
    SphericalDesign,
    SphericalResult,
    arc_between,
    checked_demands,
    checked_orders,
    judged_four_bar,
    order_of_designs,
    result_of,
)
from gruebler.design.synthesis.spherical_dyads import (
    COMPLEX_DYADS,
    MOST_ORIENTATIONS,
    SphericalDyad,
    displacements,
    family_dyads,
    five_orientation_dyads,
)
from gruebler.design.synthesis.spherical_search import (
    APART,
    LEAST_ARC,
    improved_function_dyads,
    sphere_resolution,
    tightest_on_sphere,
)
from gruebler.mechanics.space.spherical_four_bar import SphericalFourBar

PAIRS = 4
"""Pairs of angles that a four-bar on the sphere coordinates exactly, both counted from the arc of the frame."""
_FINER = 16  # times the sample that is judged: the one from which the best are improved, by closed forms
_RANK = 1e-12  # of the largest singular value: below it conditions depend on one another


def synthesise_spherical_function(
    inputs: Iterable[float],
    outputs: Iterable[float],
    demands: Demands | None = None,
    *,
    frame: float | None = None,
    free_starts: bool = False,
    number: int = 16,
    sort: Sequence[str] = (),
) -> SphericalResult:
    """Four-bars on the sphere that coordinate pairs of angles, judged by their motion.

    Four pairs have one solution at most, three with a given frame. Counted from free starts, five pairs with a given
    frame have at most five, three and four have families.

    Args:
        inputs: crank angles in radians, from the arc of the frame as of `SphericalFourBar`, or from a free start.
        outputs: the angles of the output, likewise.
        demands: as for `synthesise_orientations`.
        frame: the arc between the fixed axes, in radians.
        free_starts: the angles are counted from starts that are sought, too; the frame must be given.
        number: of designs that are listed where there are infinitely many.
        sort: as for `synthesise_orientations`.

    Raises:
        SynthesisError: other numbers of pairs, free starts without a frame, pairs whose conditions depend on one
            another, demands for the plane.

    Cost:
        3 ms a design; 0.6 s for the families.

    >>> bar = SphericalFourBar(0.5, 1.4, 1.1, 1.2)
    >>> phi = np.array([0.2, 0.9, 1.7, 2.4])
    >>> found = synthesise_spherical_function(phi, bar.motion(phi).output.value)
    >>> [round(getattr(found.designs[0].four_bar, arc), 9) for arc in "abcd"]
    [0.5, 1.4, 1.1, 1.2]

    See Also:
        `synthesise_orientations`, `synthesise_function`

    Theory:
        docs/theory/synthesis-sphere.md
    """
    wanted, sought = checked_demands(demands), checked_orders(sort)
    phi, psi = (np.array(list(values), np.float64) for values in (inputs, outputs))
    if free_starts and frame is None:
        raise SynthesisError("on the sphere pairs with free starts need the arc of the frame")
    due = (3, 4, 5) if free_starts else (PAIRS,) if frame is None else (PAIRS - 1,)
    if phi.shape != psi.shape or phi.shape not in [(k,) for k in due] or not np.isfinite([phi, psi]).all():
        raise SynthesisError(
            "expected {due} pairs of angles, but found {inputs} inputs and {outputs} outputs",
            due=joined_by_or([str(k) for k in due]),
            inputs=phi.size,
            outputs=psi.size,
        )
    if frame is None:
        return _with_given_starts(phi, psi, None, wanted)
    if not LEAST_ARC < frame < pi - LEAST_ARC:
        raise SynthesisError(
            "{key}: expected an angle between {low} and {high} degrees, but found {angle:g} degrees",
            key="frame",
            low=0,
            high=180,
            angle=np.degrees(frame),
        )
    if free_starts:
        return _with_free_starts(phi, psi, frame, wanted, number, sought)
    return _with_given_starts(phi, psi, frame, wanted)


def _with_given_starts(phi: Reals, psi: Reals, frame: float | None, demands: Demands) -> SphericalResult:
    """k0 cos(phi) + k1 cos(psi) + k2 + k3 cos(phi) cos(psi) = -sin(phi) sin(psi), k3 = cos(frame), solved for k."""
    columns = np.stack([np.cos(phi), np.cos(psi), np.ones(len(phi)), np.cos(phi) * np.cos(psi)], axis=1)
    right = -np.sin(phi) * np.sin(psi)
    if frame is not None:
        right, columns = right - cos(frame) * columns[:, 3], columns[:, :3]
    if np.linalg.matrix_rank(columns, _RANK * np.abs(columns).max()) < len(phi):
        raise SynthesisError("the pairs do not determine a linkage: their conditions depend on one another")
    k = np.append(np.linalg.solve(columns, right), [] if frame is None else [cos(frame)])
    none = result_of([], _number_of_linkages(1, 1, 0), [message("The pairs are met by no real linkage.")])
    if not abs(k[3]) < 1:
        return none
    d = acos(k[3])
    a, c = atan2(sin(d), -k[1]), atan2(sin(d), k[0])
    cosine = cos(a) * cos(c) * cos(d) - k[2] * sin(a) * sin(c)
    if not abs(cosine) < 1:
        return none
    bar = SphericalFourBar(a, acos(cosine), c, d)
    fixed, turned = _frames(d, phi, psi)
    arm, rocker = np.array([sin(a), 0, cos(a)]), np.array([sin(c), 0, cos(c)])
    return result_of(
        [judged_four_bar(bar, _pins(fixed, turned, arm, rocker), demands)], _number_of_linkages(1, 1, 1), []
    )


def _with_free_starts(
    phi: Reals, psi: Reals, frame: float, demands: Demands, number: int, sort: Sequence[str]
) -> SphericalResult:
    """As seen from the crank the output link takes known orientations: the couplers are their dyads, less the frame."""
    cranks, links = _frames(frame, phi, psi)
    seen = np.swapaxes(cranks, 1, 2) @ links
    turns = displacements(seen)
    theorem: int | None = None
    if len(phi) == MOST_ORIENTATIONS:
        dyads, complex_dyads = five_orientation_dyads(turns)
        own = seen[0][:, 2]  # the axis B0 as the crank has it at the first pair; A0 is its z
        itself = max(range(len(dyads)), key=lambda k: abs(dyads[k].fixed[2]) + abs(dyads[k].moving @ own))
        dyads = dyads[:itself] + dyads[itself + 1 :]
        theorem, linkages = COMPLEX_DYADS - 1, complex_dyads - 1
    else:
        dyads = family_dyads(turns)
        linkages = len(dyads)

    def judged(some: Iterable[SphericalDyad]) -> list[SphericalDesign]:
        designs = []
        for dyad in some:
            arm, rocker = dyad.fixed, seen[0].T @ dyad.moving
            arm, rocker = (axis if axis[2] > 0 else -axis for axis in (arm, rocker))  # on the side of its fixed axis
            arcs = [arc_between(arm, np.array([0, 0, 1])), arc_between(cranks[0] @ arm, links[0] @ rocker)]
            arcs += [arc_between(rocker, np.array([0, 0, 1])), frame]
            if min(arcs) > LEAST_ARC and max(arcs) < pi - LEAST_ARC:
                designs.append(judged_four_bar(SphericalFourBar(*arcs), _pins(cranks, links, arm, rocker), demands))
        return designs

    sample = judged(dyads)
    result = result_of(sample, _number_of_linkages(theorem, linkages, len(dyads)), [], sort)
    if theorem is not None:
        return result
    notes = message(
        "Linkages of the family that meet all demands: {count:,} of {members:,}.",
        members=len(sample),
        count=len(result.designs),
    )
    between_pivots = SphericalDyad(fixed=np.array([0.0, 0, 1]), moving=seen[0][:, 2])
    finer = family_dyads(turns, times=_FINER)
    better = result_of(
        judged(improved_function_dyads(between_pivots, finer, turns, demands, number, sort)),
        result.count,
        [notes, sphere_resolution(len(finer), len(phi), sort, times=_FINER)],
        sort,
    )
    # Linkages of the sample stand beside those that are improved from them.
    designs, rejected = (
        _distinct(sorted([*improved, *sampled], key=partial(order_of_designs, sort)))[:number]
        for improved, sampled in ((better.designs, result.designs), (better.rejected, result.rejected))
    )
    tight = [] if designs else tightest_on_sphere([between_pivots], finer, turns, demands, given_first=True)
    return replace(better, designs=tuple(designs), rejected=tuple(rejected), notes=(*better.notes, *tight))


def _distinct(designs: Iterable[SphericalDesign]) -> list[SphericalDesign]:
    """Without any whose arcs are nearly those of one before it."""
    kept: list[SphericalDesign] = []
    for design in designs:
        arcs, others = (
            np.array([[each.four_bar.a, each.four_bar.b, each.four_bar.c] for each in some]).reshape(-1, 3)
            for some in ([design], kept)
        )
        if (np.abs(others - arcs).max(axis=1) >= APART).all():
            kept.append(design)
    return kept


def _number_of_linkages(theorem: int | None, complex_linkages: int, real: int) -> SolutionCount:
    return SolutionCount(what=message("linkages"), theorem=theorem, found=complex_linkages, real=real)


def _frames(d: float, phi: Reals, psi: Reals) -> tuple[Reals, Reals]:
    """(pairs, 3, 3) axes of the crank and of the output link at each pair; z is A0 and B0, x points along the angle."""

    def about_z(angles: Reals) -> Reals:
        c, s, zero = np.cos(angles), np.sin(angles), np.zeros(len(angles))
        rows = [[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]]
        return np.moveaxis(np.array(rows), 2, 0)

    beyond = np.array([[cos(d), 0, sin(d)], [0, 1, 0], [-sin(d), 0, cos(d)]])
    return about_z(phi), beyond @ about_z(psi)


def _pins(cranks: Reals, links: Reals, arm: Reals, rocker: Reals) -> Reals:
    """(targets, 4, 3) A0, A, B, B0, from the axes of crank and output link, A in the crank's and B in the link's."""
    return np.stack([cranks[:, :, 2], cranks @ arm, links @ rocker, links[:, :, 2]], axis=1)
