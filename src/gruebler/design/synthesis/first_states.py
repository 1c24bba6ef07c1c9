"""Where a fit begins: poses of a realised mechanism that are most like the targets, with everything moved onto them.

docs/theory/synthesis-any.md. Rows of poses are proposed, one for each target; of each proposal the best similarity and
the best point of a link follow from linear least squares, and the best proposal is taken.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, permutations, product
from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.curve_matching import resampled
from gruebler.design.synthesis.fitting import FitState, FitTargets, links_moved_by_all, output_links
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.mechanics.kinematics import circuit

_SAMPLES = 96  # poses along a circuit
_WALKERS, _WALKS, _STRIDE = 10, 30, 0.25  # walks at random of several drives, of so many steps (radians or sizes)
_PROPOSALS = 600
_DEPENDENT = 1e-9  # of a determinant: below it two columns are one
_SWEEPS = 4  # over all targets, exchanging poses
_FEW = 12  # targets: the poses of fewer are proposed at random, too
_FARTHEST = 2.0  # sizes: a point of a link lies no farther from it
_SMALLEST, _LARGEST = 0.05, 30.0  # the linkage by the task

Integers = NDArray[np.int64]


class _Course(NamedTuple):
    """Poses of a mechanism: in their order along a circuit, or without order."""

    q: Reals
    """(poses, unknowns)"""
    drive: Reals
    """(poses,) the first drive; empty with several."""
    closed: bool
    ordered: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class _Proposal:
    rows: Integers
    """(targets,)"""
    cost: float
    turn: complex
    shift: complex
    point: complex
    mirrored: bool
    link: str
    output: str
    given: Sequence[_Given]


class _Given(NamedTuple):
    """A pin of the frame that has a given place."""

    at: int
    """The number of its x among the dimensions."""
    own: complex
    """Where it lies in the realised mechanism."""
    place: complex


def first_state(
    closure: DesignClosure,
    targets: FitTargets,
    rng: np.random.Generator,
    link: str = "",
    pivots: Sequence[complex] = (),
) -> FitState | None:
    """The state from which a mechanism is fitted; None if it cannot be moved, or nowhere meets the given angles.

    Args:
        closure: of the realised mechanism, in its own size.
        targets: of the task.
        rng: for poses that are proposed at random.
        link: that is guided, or whose motion is the output; the best one without it.
        pivots: one or two places of pins of the frame; which pins, is tried in all ways.
    """
    try:
        course = _course(closure, rng)
    except LinkageError:
        return None
    if targets.z is None:
        return _of_function(closure, course, targets, link)
    best: _Proposal | None = None
    carriers = links_moved_by_all(closure.linkage.mechanism)
    frame = closure.linkage.mechanism.frame
    pins = [closure.start[key] for key in closure.keys if key[1] == frame and closure.linkage.elements[key].is_pin]
    for mirrored, held in product((False, True), permutations(pins, len(pivots))):
        shown = targets.mirrored() if mirrored else targets
        given = [
            _Given(at, complex(*closure.sizes[at : at + 2]), p.conjugate() if mirrored else p)
            for at, p in zip(held, pivots, strict=True)
        ]
        rows = np.unique(np.array([*_proposed(course, shown, rng)], np.int64), axis=0)
        if not len(rows):
            continue
        for carrier in (link,) if link else carriers:
            proposal = _best(closure, course, shown, rows, carrier, given, mirrored=mirrored)
            if proposal is not None and (best is None or proposal.cost < best.cost):
                best = proposal
    return None if best is None else _placed(closure, course, targets, best)


def _course(closure: DesignClosure, rng: np.random.Generator) -> _Course:
    """Poses along the circuit; with several drives a random walk."""
    linkage = closure.linkage
    if len(linkage.mechanism.drives) < 2:
        course = circuit(linkage)
        arcs = np.linspace(0, course.length, _SAMPLES + 1)[: -1 if course.closed else None]
        poses = course.at(arcs)
        return _Course(closure.poses(poses), poses.drive(), course.closed, ordered=True)
    pose = linkage.required_pose
    home = np.array([value for link in closure.links for value in pose[link]])
    q = np.repeat(home[None], _WALKERS, axis=0)
    rows = [home[None]]
    for _ in range(_WALKS):
        motion = closure.derivatives(q, closure.sizes, size=linkage.size).motion
        step = motion @ (_STRIDE * rng.normal(size=(_WALKERS, motion.shape[2], 1)))
        moved, good = closure.closed(q + step[:, :, 0], closure.sizes, size=linkage.size)
        good &= np.abs(moved - q)[:, 2::3].max(axis=1) < 1.0  # no jump to another assembly mode
        q = np.where(good[:, None], moved, q)
        rows.append(q[good])
    return _Course(np.concatenate(rows), np.zeros(0), closed=False, ordered=False)


def _proposed(course: _Course, targets: FitTargets, rng: np.random.Generator) -> Iterator[Integers]:
    """Rows of poses, one for each target."""
    count, poses = len(targets), len(course.q)
    if targets.inputs is not None and np.count_nonzero(~np.isnan(targets.inputs)) > 1:  # one alone says nothing
        yield from _at_inputs(course, filled(targets.inputs))
        return
    if not course.ordered:
        for _ in range(_PROPOSALS):
            yield rng.integers(0, poses, count)
        return
    assert targets.z is not None
    if count <= min(_FEW, poses):
        for k in range(_PROPOSALS):
            rows = np.sort(rng.choice(poses, count, replace=False))
            if course.closed:
                rows = np.roll(rows, int(rng.integers(count)))
            if targets.ranks:
                rows[TargetOrder.of(targets.ranks, count).drawn(rng)] = rows.copy()
            yield rows[::-1] if k % 2 else rows
    if count < 3 or targets.ranks or np.isnan(targets.z).any():
        return
    lengths = [poses] if targets.closed else [poses // 6, poses // 4, poses // 3, poses // 2]
    for length in lengths:
        _, parts = resampled(targets.z, max(length, 2), closed=targets.closed)
        steps = np.round(parts * (length if targets.closed else length - 1)).astype(np.int64)
        for begin in range(0, poses if course.closed else poses - length, 4):
            for along in (steps, -steps if targets.closed else length - 1 - steps):
                yield (begin + along) % poses


def filled(values: Reals) -> Reals:
    """Numbers of targets, evenly between those that are given where one is free."""
    given = ~np.isnan(values)
    return np.interp(np.arange(len(values)), np.flatnonzero(given), values[given])


def _at_inputs(course: _Course, inputs: Reals) -> Iterator[Integers]:
    """Poses whose drive values differ as the inputs do, as far as the drive does not turn back between them."""
    drive = course.drive
    poses = len(drive)
    rising = np.diff(drive) > 0
    if course.closed and (rising.all() or not rising.any()):
        step = drive[1:] - drive[:-1]
        period = 2 * pi * round((drive[-1] - drive[0] + float(step.mean())) / (2 * pi))
        whole = np.concatenate([drive - period, drive, drive + period])
        yield from _matched(whole, np.tile(np.arange(poses), 3), inputs, range(poses, 2 * poses))
        return
    turns = [0, *(np.flatnonzero(rising[1:] != rising[:-1]) + 1), poses - 1]
    for low, high in pairwise(turns):
        rows = np.arange(low, high + 1)
        if len(rows) > 2:
            yield from _matched(drive[rows], rows, inputs, range(len(rows)))


def _matched(drive: Reals, rows: Integers, inputs: Reals, begins: Iterable[int]) -> Iterator[Integers]:
    order = np.argsort(drive)
    width = float(np.abs(np.diff(drive)).max())
    for begin in begins:
        wanted = drive[begin] + inputs - inputs[0]
        at = np.clip(np.searchsorted(drive[order], wanted), 1, len(order) - 1)
        near = np.where(np.abs(drive[order[at - 1]] - wanted) < np.abs(drive[order[at]] - wanted), at - 1, at)
        if np.abs(drive[order[near]] - wanted).max() <= width:
            yield rows[order[near]]


class _Placements(NamedTuple):
    """How proposals of one link fit best: (proposals,) each."""

    cost: Reals
    turn: Complexes
    point: Complexes
    shift: Complexes


def _best(
    closure: DesignClosure,
    course: _Course,
    targets: FitTargets,
    rows: Integers,
    link: str,
    given: Sequence[_Given] = (),
    *,
    mirrored: bool,
) -> _Proposal | None:
    """The best of proposals for a link; of few targets with each pose in turn exchanged for a better one in order."""
    q, order = course.q, TargetOrder.of(targets.ranks, len(targets))
    tried = _placements(closure, q, targets, rows, link, given)
    chosen = rows[int(np.argmin(tried.cost))]
    if len(targets) <= _FEW and targets.inputs is None:
        for _ in range(_SWEEPS):
            before = chosen
            for k in range(len(targets)):
                others = np.repeat(chosen[None], len(q), axis=0)
                others[:, k] = np.arange(len(q))
                if course.ordered:
                    others = others[order.kept_along(others, len(q) if course.closed else np.inf)]
                chosen = others[int(np.argmin(_placements(closure, q, targets, others, link, given).cost))]
            if (chosen == before).all():
                break
    placed = _placements(closure, q, targets, chosen[None], link, given)
    if not np.isfinite(placed.cost[0]):
        return None
    turn, shift, point = (complex(values[0]) for values in (placed.turn, placed.shift, placed.point))
    apart = {} if targets.outputs is None else _outputs_apart(closure, q, targets, chosen[None])
    return _Proposal(
        rows=chosen,
        cost=float(placed.cost[0]),
        turn=turn,
        shift=shift,
        point=point,
        mirrored=mirrored,
        link=link,
        output=min(apart, key=lambda each: float(apart[each][0]), default=""),
        given=given,
    )


def _outputs_apart(closure: DesignClosure, q: Reals, targets: FitTargets, rows: Integers) -> dict[str, Reals]:
    """Of each link that may be the output beside a point, (proposals,) how far its angles are from those wanted."""
    assert targets.outputs is not None
    links = output_links(closure.linkage.mechanism, travel=False)
    angles = {link: q[:, closure.column[link] + 2][rows] for link in links}
    return {link: _turned_apart(np.exp(1j * own), targets.outputs) for link, own in angles.items()}


def _placements(
    closure: DesignClosure,
    q: Reals,
    targets: FitTargets,
    rows: Integers,
    link: str,
    given: Sequence[_Given] = (),
) -> _Placements:
    """The similarity and the point of a link that leave least, by linear least squares.

    With the origin O and the direction e of the link in its poses the targets are z = T O + U e + s; the point is U/T.
    A pin with a given place is the origin of both planes; a second one gives T.
    """
    assert targets.z is not None
    c = closure.column[link]
    origin, turn = (q[:, c] + 1j * q[:, c + 1])[rows], np.exp(1j * q[:, c + 2])[rows]
    placed = ~np.isnan(targets.z)
    own, each = origin[:, placed], turn[:, placed]
    from_, about = own.mean(axis=1, keepdims=True), each.mean(axis=1, keepdims=True)
    middle = targets.z[placed].mean()
    if given:
        from_, about, middle = np.full_like(from_, given[0].own), np.zeros_like(about), given[0].place
    o, e, z = own - from_, each - about, targets.z[placed] - middle

    def inner(u: Complexes, v: Complexes) -> Complexes:
        return np.asarray(np.sum(np.conj(u) * v, axis=1))

    oo, ee, oe, oz, ez = inner(o, o).real, inner(e, e).real, inner(o, e), inner(o, z[None]), inner(e, z[None])
    det = oo * ee - np.abs(oe) ** 2
    both = det > _DEPENDENT * oo * ee  # else the link turns about a fixed point, or does not turn: the point is no help
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.where(both, (ee * oz - oe * ez) / det, oz / oo)
        arm = np.where(both, (oo * ez - np.conj(oe) * oz) / det, 0)
        if len(given) > 1:
            along = np.full_like(along, (given[1].place - given[0].place) / (given[1].own - given[0].own))
            arm = np.where(both, (ez - along * np.conj(oe)) / ee, 0)
        point = arm / along
        cost = np.sum(np.abs(along[:, None] * o + arm[:, None] * e - z) ** 2, axis=1)
    shift = middle - along * from_[:, 0] - arm * about[:, 0]
    if targets.angles is not None:
        cost = cost + targets.size**2 * _turned_apart(turn, targets.angles)
    if targets.outputs is not None:
        cost = cost + targets.size**2 * np.min([*_outputs_apart(closure, q, targets, rows).values()], axis=0)
    reach = closure.linkage.size
    # A linkage that is far larger or smaller than the task fits anything by its rounding.
    bad = ~np.isfinite(cost) | ~(np.abs(point) <= _FARTHEST * reach)
    bad |= (np.abs(along) * reach < _SMALLEST * targets.size) | (np.abs(along) * reach > _LARGEST * targets.size)
    return _Placements(np.where(bad, np.inf, cost), along, np.asarray(point, np.complex128), shift)


def _turned_apart(turn: Complexes, wanted: Reals) -> Reals:
    """(proposals,) the sum of the squares by which directions differ from angles, up to a constant."""
    given = ~np.isnan(wanted)
    gaps = turn[:, given] * np.exp(-1j * wanted[given])
    return np.asarray(np.sum(np.angle(gaps * np.conj(gaps.mean(axis=1, keepdims=True))) ** 2, axis=1))


def _similar(closure: DesignClosure, q: Reals, turn: complex, shift: complex, *, mirrored: bool) -> tuple[Reals, Reals]:
    """Dimensions and poses of the mechanism turned, scaled and shifted, then mirrored if asked for."""
    p, q = closure.sizes.copy(), q.copy()
    scale, angle = abs(turn), float(np.angle(turn))
    for key in closure.keys:
        at = closure.start[key]
        slides = closure.linkage.elements[key].is_line
        if key[1] in closure.column:
            p[at : at + 2] *= scale
        else:
            place = turn * complex(p[at], p[at + 1]) + shift
            p[at], p[at + 1] = place.real, place.imag
            if slides:
                p[at + 2] += angle
        if mirrored:
            p[at + 1] *= -1
            if slides:
                p[at + 2] *= -1
    for c in closure.column.values():
        places = turn * (q[:, c] + 1j * q[:, c + 1]) + shift
        q[:, c], q[:, c + 1], q[:, c + 2] = places.real, places.imag, q[:, c + 2] + angle
        if mirrored:
            q[:, c + 1 : c + 3] *= -1
    return p, q


def _crank(closure: DesignClosure) -> str:
    drive = closure.linkage.mechanism.drives[0]
    return next((link for link in drive.between if link in closure.column), "")


def _placed(closure: DesignClosure, course: _Course, targets: FitTargets, chosen: _Proposal) -> FitState:
    p, q = _similar(closure, course.q[chosen.rows], chosen.turn, chosen.shift, mirrored=chosen.mirrored)
    point = abs(chosen.turn) * (chosen.point.conjugate() if chosen.mirrored else chosen.point)
    crank = _crank(closure) if targets.inputs is not None else ""
    free = [point.real, point.imag]
    free += [_constant(q[:, closure.column[chosen.link] + 2], targets.angles)] if targets.angles is not None else []
    free += [_constant(q[:, closure.column[crank] + 2], targets.inputs)] if targets.inputs is not None else []
    if targets.outputs is not None:
        free.append(_constant(q[:, closure.column[chosen.output] + 2], targets.outputs))
    held = frozenset(each.at + k for each in chosen.given for k in range(2))
    for each in chosen.given:
        place = each.place.conjugate() if chosen.mirrored else each.place
        p[each.at : each.at + 2] = place.real, place.imag
    return FitState(p, q=q, link=chosen.link, crank=crank, output=chosen.output, held=held, free=np.array(free))


def _constant(angles: Reals, wanted: Reals) -> float:
    """By what angles exceed those wanted, in the mean."""
    return float(np.angle(np.nansum(np.exp(1j * (angles - wanted)))))


def _of_function(closure: DesignClosure, course: _Course, targets: FitTargets, link: str) -> FitState | None:
    """The output link, the begin and the sense whose outputs are most like those wanted; a travel may be scaled."""
    assert targets.inputs is not None
    assert targets.outputs is not None
    mechanism = closure.linkage.mechanism
    whole = links_moved_by_all(mechanism)
    outputs = (link,) if link else [each for each in output_links(mechanism, targets.travel) if each in whole]
    best: tuple[float, Integers, bool, str, float] | None = None
    for mirrored in (False, True):
        shown = targets.mirrored() if mirrored else targets
        assert shown.inputs is not None
        assert shown.outputs is not None
        rows = np.array([*_at_inputs(course, shown.inputs)], np.int64)
        if not len(rows):
            continue
        for output in outputs:
            values = _outputs(closure, course, output, travel=targets.travel)[rows]
            values = values if targets.travel else np.unwrap(values, axis=1)
            own = values - values.mean(axis=1, keepdims=True)
            wanted = shown.outputs - shown.outputs.mean()
            scales = np.ones(len(own))
            if targets.travel:
                power = np.sum(own**2, axis=1)
                scales = np.clip(own @ wanted, 0, None) / np.maximum(power, 1e-12 * power.max())
            cost = np.sum((scales[:, None] * own - wanted) ** 2, axis=1)
            cost[scales <= 0] = np.inf
            k = int(np.argmin(cost))
            if np.isfinite(cost[k]) and (best is None or cost[k] < best[0]):
                best = float(cost[k]), rows[k], mirrored, output, float(scales[k])
    if best is None:
        return None
    _, rows, mirrored, output, scale = best
    p, q = _similar(closure, course.q[rows], complex(scale), 0j, mirrored=mirrored)
    crank = _crank(closure)
    slide = _slide(closure, output) if targets.travel else (-1, "")
    state = FitState(p, q=q, link="", crank=crank, output=output, slide=slide)
    constants = [_constant(q[:, closure.column[crank] + 2], targets.inputs)]
    if targets.travel:
        c, angle = closure.column[output], p[closure.start[slide] + 2]
        along = np.real(np.exp(-1j * angle) * (q[:, c] + 1j * q[:, c + 1]))
        constants.append(float((along - targets.outputs).mean()))
    else:
        constants.append(_constant(q[:, closure.column[output] + 2], targets.outputs))
    state.free = np.array(constants)
    return state


def _slide(closure: DesignClosure, output: str) -> tuple[int, str]:
    """The slide of a link along the frame, and the frame."""
    mechanism = closure.linkage.mechanism
    number = next(
        n
        for n, joint in enumerate(mechanism.chain.joints)
        if joint.pair.is_sliding and {output, mechanism.frame} <= set(joint.links)
    )
    return number, mechanism.frame


def _outputs(closure: DesignClosure, course: _Course, output: str, *, travel: bool) -> Reals:
    c = closure.column[output]
    if not travel:
        return course.q[:, c + 2]
    angle = float(closure.sizes[closure.start[_slide(closure, output)] + 2])
    return np.asarray(np.real(np.exp(-1j * angle) * (course.q[:, c] + 1j * course.q[:, c + 1])))
