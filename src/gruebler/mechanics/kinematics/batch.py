"""Many designs of one mechanism moved at once, such as four-bars of thousands of lengths."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals, angles_of_turns, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.jets import turn_derivative
from gruebler.base.notebook import brief
from gruebler.base.text import translate
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics.branches import Unassembled, read_branch, starting_state
from gruebler.mechanics.kinematics.drive_rows import drive_path, drive_speeds, warn_of_path
from gruebler.mechanics.kinematics.kernel_records import DesignInputs, DesignPoses
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.solve import cached_plan, move_quietly, starting_configuration
from gruebler.mechanics.linkages import Linkage, with_lower_pairs
from gruebler.mechanics.linkages.branch import Branch, branch_labels


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Designs:
    """Many designs of one mechanism, as arrays. Made by `designs`, `four_bars` and the like."""

    plan: Plan
    """What is common to them; its linkage is the first design."""
    points: Complexes
    """(designs, elements): the point of each joint on each of its links, x + iy in the link's coordinates."""
    lines: Complexes
    """(designs, elements): the direction of each slide, cosine + i sine."""
    sizes: Reals
    """(designs,): a length of the order of each."""
    linkage: Callable[[int], Linkage] = field(compare=False)
    """The linkage of a number; what it makes is compared by the arrays."""

    def __len__(self) -> int:
        return len(self.points)


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Motions:
    """Poses of many designs along one path; NaN in rows that a design does not reach."""

    designs: Designs
    branch: tuple[str, ...] | None
    drives: Reals
    """(rows, drives)"""
    links: tuple[str, ...]
    """The links that were kept."""
    places: Complexes
    """(order + 1, designs, rows, links): origins of the links and their time derivatives, x + iy."""
    turns: Complexes
    """(designs, rows, links): cosine + i sine of the angles."""
    rates: Reals
    """(order, designs, rows, links): angular velocities, accelerations, jerks."""
    reached: NDArray[np.int64]
    """(designs,): how many rows each design reached."""

    def __len__(self) -> int:
        return len(self.reached)

    @property
    def complete(self) -> NDArray[np.bool_]:
        """(designs,): which followed the whole path."""
        complete: NDArray[np.bool_] = self.reached == len(self.drives)
        return complete

    def explain(self, lang: str = "en") -> str:
        """How many designs at how many positions, and how many of them came to the end."""
        return translate(
            "Motions of {designs} designs at {rows} positions; followed to the end: {whole}.",
            lang,
            designs=len(self.reached),
            rows=len(self.drives),
            whole=int(self.complete.sum()),
        )

    def angle(self, link: str) -> Reals:
        """Angles of a link's x axis against the frame's, in radians; (designs, rows).

        Without jumps as long as the link turns by less than half a turn from row to row.
        """
        angles: Reals = np.unwrap(angles_of_turns(self.turns[..., self.link_index(link)]), axis=1)
        return angles

    def angular(self, link: str, *, order: int = 1) -> Reals:
        """Angular velocities (1), accelerations (2) or jerks (3) of a link; (designs, rows)."""
        self._ordered(order, 1)
        rates: Reals = self.rates[order - 1, :, :, self.link_index(link)]
        return rates

    def point(self, joint: str, *, order: int = 0) -> Reals:
        """A joint as a point of the first of its links that was kept, or its derivative; (designs, rows, 2)."""
        z = self.complex_point(joint, order=order)
        return np.stack([z.real, z.imag], axis=-1)

    def complex_point(self, joint: str, *, order: int = 0) -> Complexes:
        """`point` as x + iy; (designs, rows)."""
        self._ordered(order, 0)
        plan = self.designs.plan
        number = plan.lower.mechanism.chain.find_joint(joint)
        for e, (owner, link) in enumerate(plan.keys):
            if owner == number and link in self.links:
                k = self.links.index(link)
                arm = self.turns[..., k] * self.designs.points[:, e, None]
                return np.asarray(self.places[order, ..., k] + turn_derivative(self.rates[..., k], order) * arm)
        raise LinkageError(
            "{joint!r} is not a joint of the links kept: {links}", joint=joint, links=", ".join(self.links)
        )

    def motion(self, number: int) -> Motion:
        """The motion of one design with everything that a `Motion` knows, such as where it stopped and why."""
        return move_quietly(self.designs.linkage(number), self.drives, branch=self.branch)

    def link_index(self, link: str) -> int:
        """Where a link is in the arrays' last axis; `LinkageError` if it was not kept."""
        if link not in self.links:
            raise LinkageError(
                "the link {link!r} was not kept; kept are {links}", link=link, links=", ".join(self.links)
            )
        return self.links.index(link)

    def _ordered(self, order: int, least: int) -> None:
        if order not in range(least, len(self.places)):
            raise LinkageError(
                "expected an order from {least} to {count}, but found {order!r}",
                least=least,
                count=len(self.rates),
                order=order,
            )


def designs(linkages: Sequence[Linkage]) -> Designs:
    """Linkages of the same mechanism as designs.

    They share one plan. Raises `LinkageError` if there are none, or if one has another mechanism than the first, joints
    in another order, or pins and slots exchanged.
    """
    if isinstance(linkages, Linkage):
        raise LinkageError("expected a list of linkages; one alone is moved by `move`")
    if not len(linkages) or not all(isinstance(linkage, Linkage) for linkage in linkages):
        raise LinkageError("expected at least one design, each a linkage")
    lower = [with_lower_pairs(linkage) for linkage in linkages]
    for number, (linkage, blocks) in enumerate(zip(linkages, lower, strict=True)):
        if linkage.mechanism != linkages[0].mechanism:
            raise LinkageError("design {number} has another mechanism than the first", number=number)
        if blocks.mechanism.written_form != lower[0].mechanism.written_form:
            raise LinkageError(
                "design {number} has its joints in another order, or pins and slots exchanged against the first",
                number=number,
            )
    plan = cached_plan(linkages[0])
    if plan.wheels and len(linkages) > 1:
        raise LinkageError("linkages with wheels are moved one by one, by move")
    if plan.released:
        raise LinkageError("overconstrained linkages are moved one by one, by move")
    arrays = [plan.element_arrays(linkage) for linkage in lower]
    points, lines = (np.array([pair[k] for pair in arrays]) for k in (0, 1))
    return Designs(
        plan=plan,
        points=points,
        lines=lines,
        sizes=np.array([linkage.size for linkage in lower]),
        linkage=tuple(linkages).__getitem__,
    )


def four_bars(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> Designs:
    """Four-bars with arrays of lengths (numbers stand for all designs).

    >>> len(four_bars(25, [60, 70, 80], 40, 70))
    3
    """
    return _of_lengths(FourBar, a=a, b=b, c=c, d=d)


def slider_cranks(a: ArrayLike, b: ArrayLike, e: ArrayLike = 0.0) -> Designs:
    """Slider-cranks with arrays of lengths and eccentricities."""
    return _of_lengths(SliderCrank, a=a, b=b, e=e)


def inverted_slider_cranks(a: ArrayLike, d: ArrayLike, e: ArrayLike = 0.0) -> Designs:
    """Inverted slider-cranks with arrays of lengths and eccentricities."""
    return _of_lengths(InvertedSliderCrank, a=a, d=d, e=e)


def _of_lengths(kind: Callable[..., FourBar | SliderCrank | InvertedSliderCrank], **given: ArrayLike) -> Designs:
    """Coordinates of elements are linear in the lengths: what each length adds is found from linkages of the kind."""
    lengths = _lengths(given)
    first = kind(**{name: float(values[0]) for name, values in lengths.items()}).linkage()
    plan = cached_plan(first)
    base = dict(zip(lengths, (2.0, 3.0, 4.0, 5.0), strict=False))
    zero, lines = plan.element_arrays(kind(**base).linkage())
    steps = {n: plan.element_arrays(kind(**{**base, n: base[n] + 1}).linkage())[0] - zero for n in base}
    rest = zero - sum(base[name] * steps[name] for name in base)
    points = rest + sum(lengths[name][:, None] * steps[name] for name in base)
    count = len(points)
    sizes = np.max([np.abs(values) for values in lengths.values()], axis=0)
    design = partial(_design, kind, lengths)
    return Designs(
        plan=plan, points=np.ascontiguousarray(points), lines=np.tile(lines, (count, 1)), sizes=sizes, linkage=design
    )


def _design(
    kind: Callable[..., FourBar | SliderCrank | InvertedSliderCrank], lengths: dict[str, Reals], n: int
) -> Linkage:
    return kind(**{name: float(values[n]) for name, values in lengths.items()}).linkage()


def _lengths(given: dict[str, ArrayLike]) -> dict[str, Reals]:
    arrays: dict[str, Reals] = {}
    for name, values in given.items():
        try:
            arrays[name] = np.asarray(values, np.float64)
        except (TypeError, ValueError):
            raise LinkageError("{name}: expected numbers, but found {values!r}", name=name, values=values) from None
        wrong = ~np.isfinite(arrays[name]) if name == "e" else ~((arrays[name] > 0) & (arrays[name] < np.inf))
        if wrong.any():
            raise LinkageError(
                "{name}: expected finite numbers, but found {number:g}"
                if name == "e"
                else "{name}: expected positive numbers, but found {number:g}",
                name=name,
                number=arrays[name][wrong].flat[0],
            )
    try:
        together = np.broadcast_arrays(*arrays.values())
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise LinkageError("expected arrays of one length, but found {shapes}", shapes=shapes) from None
    if together[0].ndim > 1 or not together[0].size:
        raise LinkageError(
            "expected one-dimensional arrays, not empty, but found the shape {shape}", shape=together[0].shape
        )
    return dict(zip(arrays, (np.atleast_1d(array).astype(np.float64) for array in together), strict=True))


@door_that_raises(LinkageError)
def move_many(
    many: Designs | Sequence[Linkage],
    drives: ArrayLike,
    *,
    branch: Branch = None,
    speed: ArrayLike | None = None,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
    order: int | None = None,
    links: Sequence[str] | None = None,
    threads: int | None = None,
) -> Motions:
    """Move many designs of one mechanism along the same path of the drives; every check is that of `move`.

    Args:
        many: designs, or linkages of one mechanism.
        drives: as in `move`, likewise what follows.
        branch: the assembly mode at the first row.
        speed: the drives' velocity.
        acceleration: the drives' acceleration.
        jerk: the drives' jerk.
        order: the highest derivative.
        links: the links whose motion is kept; all that move if None. One link takes 32 bytes a pose, and 40 more for
            each order.
        threads: how many threads share the designs; as many as there are processors if None.

    Returns:
        `Motions`: (designs, rows) angles in radians, (designs, rows, 2) places; ``complete`` says which designs reached
        the end. Rates in a row that is exactly a change point are not finite or inexact: call `Motions.motion`.

    Raises:
        LinkageError: as for `move`; linkages of different mechanisms, unknown links.

    Cost:
        20 to 50 ns a pose of a four-bar.

    Example:
        >>> many = four_bars(25, np.linspace(60, 80, 5), 40, 70)
        >>> motions = move_many(many, np.linspace(0, 6, 100), links=["rocker"])
        >>> motions.angle("rocker").shape, motions.complete.all()
        ((5, 100), np.True_)

    See Also:
        `move`, `Motion`

    Theory:
        docs/theory/kinematics.md
    """
    batch = many if isinstance(many, Designs) else designs(many)
    plan, count = batch.plan, len(batch)
    path = drive_path(plan, drives)
    warn_of_path(plan, path)
    speeds = drive_speeds(path, speed, acceleration, jerk, order)
    chain, frame = plan.lower.mechanism.chain, plan.lower.mechanism.frame
    kept = tuple(link for link in chain.links if link != frame) if links is None else tuple(links)
    if not kept:
        raise LinkageError("links: expected at least one whose motion is kept")
    for link in kept:
        if link not in chain.links:
            raise LinkageError(
                "there is no link {link!r}; the links are {links}", link=link, links=", ".join(chain.links)
            )
    labels = branch_labels(branch)
    shape = (count, len(kept), len(path))
    poses = DesignPoses(
        np.empty((len(speeds) + 1, *shape), np.complex128),
        np.empty(shape, np.complex128),
        np.empty((len(speeds), *shape)),
        np.empty(count, np.int64),
    )
    _run(batch, path, speeds, _starts(batch, path, labels), np.array([chain.index(k) for k in kept]), poses, threads)
    places, turns, rates = poses.places.swapaxes(2, 3), poses.turns.swapaxes(1, 2), poses.rates.swapaxes(2, 3)
    return Motions(
        designs=batch,
        branch=labels,
        drives=path,
        links=kept,
        places=places,
        turns=turns,
        rates=rates,
        reached=poses.reached,
    )


def _starts(designs: Designs, path: Reals, branch: Branch) -> tuple[Reals, Reals]:
    """Signs and unknowns at the first row; NaN for a design that cannot be assembled there."""
    plan, count = designs.plan, len(designs)
    labels = read_branch(plan, branch)
    if not plan.higher_groups and (branch is not None or plan.lower.reference_pose is None):
        signs, unknowns = starting_state(plan, labels, path[0])
        return np.tile(signs, (count, 1)), np.tile(unknowns, (count, 1))
    signs = np.ones((count, len(plan.dyads)))
    unknowns = np.full((count, plan.unknowns), np.nan)
    for n in range(count):
        try:
            signs[n], unknowns[n] = starting_configuration(cached_plan(designs.linkage(n)), path[0], branch)
        except Unassembled:
            signs[n] = np.nan
    return signs, unknowns


def _run(
    designs: Designs,
    path: Reals,
    speeds: Reals,
    starts: tuple[Reals, Reals],
    kept: NDArray[np.int64],
    poses: DesignPoses,
    threads: int | None,
) -> None:
    program = designs.plan.program
    longest = designs.sizes[:, None] / program.size * program.most
    turning = [d.turning for d in designs.plan.lower.mechanism.drives]
    longest[:, turning] = program.most[turning]

    points, lines = np.ascontiguousarray(designs.points), np.ascontiguousarray(designs.lines)
    reals = (longest, designs.sizes, *starts, path, speeds)
    longest, sizes, signs, unknowns, path, speeds = (np.ascontiguousarray(array) for array in reals)
    inputs = DesignInputs(points, lines, longest, sizes, signs, unknowns)
    workers = max(1, min(threads or os.cpu_count() or 1, len(designs)))
    cuts = [len(designs) * k // workers for k in range(workers + 1)]
    with ThreadPoolExecutor(workers) as pool:
        jobs = [
            pool.submit(_core.run_designs, program, inputs, path, speeds, kept, poses, part) for part in pairwise(cuts)
        ]
    for job in jobs:
        job.result()
