"""What a solver returns: where every link of a linkage is at each row of drive values, and how it moves there."""

from __future__ import annotations

from cmath import rect
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gruebler.base import notebook
from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.columns import Table
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.text import Message, joined
from gruebler.mechanics.kinematics.contacts import law_at
from gruebler.mechanics.kinematics.contours import cam_law, turn_law
from gruebler.mechanics.kinematics.link_poses import LinkPoses
from gruebler.mechanics.kinematics.messages import stop_message, taken_for_exact_message, unbounded_message
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.linkages import CamDisc, Circle, GenevaDriver, Line, Linkage, NonCircular, Wheel
from gruebler.mechanics.linkages.elements import INVERSE, LeadingElement, RoundElement
from gruebler.mechanics.linkages.points import PointLike
from gruebler.mechanics.linkages.wheels import carriers, rolling_factors, round_joints


@dataclass(frozen=True)
class Stop:
    """Where a motion ended before the end of its path, and why."""

    row: float
    """The place on the path, in rows."""
    drives: tuple[float, ...]
    """The drive values there."""
    links: tuple[str, ...]
    """The group that can no longer be assembled, or no longer be followed."""
    form: str
    """The form of that group; for ``open`` the name of the joint."""
    reason: str
    """``limit`` (it can no longer be assembled), ``singular`` (it cannot be followed), ``start`` (not even begun),
    ``open`` (the redundant conditions of a joint are not met)."""


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False)
class Motion(LinkPoses):
    """Poses of a linkage along a path of its drives, with derivatives.

    Points are returned as (rows, 2), angles as (rows,) in radians without jumps. Rows after a `stop` are missing:
    ``len(motion)`` says how many are.
    """

    linkage: Linkage
    plan: Plan
    drives: Reals
    """(rows, drives) the drive values of the rows that were reached."""
    places: Complexes
    """(order + 1, rows, links): origins of the links and their time derivatives, as x + iy."""
    turns: Complexes
    """(rows, links): cosine + i sine of the angles."""
    rates: Reals
    """(order, rows, links): angular velocities, accelerations, jerks."""
    whole: NDArray[np.int32]
    """(rows, links): whole turns to add to the angle's principal value."""
    roots: Reals
    """(rows, dyads): the signed number of each dyad that is 0 where its assembly modes meet."""
    unknowns: Reals
    """(rows, 3 bodies of larger groups)."""
    stop: Stop | None
    unbounded: tuple[int, ...] = ()
    """Rows at a limit of the drive, where links would have to move infinitely fast: their rates are NaN."""
    taken_for_exact: tuple[int, ...] = ()
    """Rows so near to a change point that the linkage was taken to meet it, though its sizes miss it by a little: their
    poses and rates are those of a linkage with exact sizes."""
    speeds: Reals | None = None
    """(order, rows, drives): the rates of the drives that it was solved for; None if it could not begin."""

    def __len__(self) -> int:
        return len(self.drives)

    @property
    def complete(self) -> bool:
        """Whether the whole path was followed."""
        return self.stop is None

    @property
    def lower_linkage(self) -> Linkage:
        """The linkage as it was solved: with lower pairs, and the links that replace higher ones."""
        return self.plan.lower

    @property
    def order(self) -> int:
        """The highest derivative: 0 positions, 1 velocities, 2 accelerations, 3 jerks."""
        return len(self.rates)

    def message(self, lang: str = "en") -> str:
        """Where and why it stopped, where rates are not finite, where sizes were taken for exact; else empty."""
        return self.reason.in_language(lang)

    @property
    def reason(self) -> Message:
        """What `message` says, in any language."""
        parts = []
        if self.unbounded:
            first = tuple(float(value) for value in self.drives[self.unbounded[0]])
            parts.append(unbounded_message(self.linkage, first))
        if self.taken_for_exact:
            ends = [self.drives[row] for row in (self.taken_for_exact[0], self.taken_for_exact[-1])]
            parts.append(taken_for_exact_message(self.linkage, *(tuple(map(float, end)) for end in ends)))
        if self.stop is not None:
            stop = self.stop
            parts.append(stop_message(self.linkage, stop.reason, stop.drives, stop.links, stop.form))
        return joined(parts, " ")

    def angle(self, link: str) -> Reals:
        """The angle of a link's x axis against the frame's, in radians, continuous; (rows,)."""
        k = self.link_index(link)
        angles: Reals = np.angle(self.turns[:, k] + 0.0) + 2 * np.pi * self.whole[:, k]  # -1 - 0j is counted as pi
        return angles

    def angular(self, link: str, order: int = 1) -> Reals:
        """The angular velocity (1), acceleration (2) or jerk (3) of a link; (rows,)."""
        self.check_order(order)
        rates: Reals = self.rates[order - 1, :, self.link_index(link)] if order else self.angle(link)
        return rates

    @cached_property
    def closure_error(self) -> float:
        """The largest distance by which a joint of any pose is open, relative to the linkage's size."""
        return _closure_error(self)

    @property
    def branch(self) -> tuple[str, ...]:
        """The assembly mode at the start, as `move` understands it."""
        from gruebler.mechanics.kinematics.branches import branch_of

        return branch_of(self.plan, self.roots[0], self.unknowns[0], self.drives[0])

    def table(
        self,
        outputs: Sequence[str] | None = None,
        points: Sequence[PointLike] = (),
        *,
        transmission: str | None = None,
        lang: str = "en",
    ) -> Table:
        """Drives, outputs and points row by row, with derivatives: `gruebler.mechanics.analysis.motion_table`.

        `Table.structured`, `Table.pandas`, `Table.arrow` and `Table.csv` give it to other programs, `gruebler.write`
        writes it into a file.

        Args:
            outputs: Links or sliding joints; without them the linkage's outputs.
            points: Names of points or joints.
            transmission: The output whose transmission angle gets a column.
            lang: Language of the headers.
        """
        assert notebook.table_of is not None  # set by the front door
        table: Table = notebook.table_of(self, outputs, points, transmission=transmission, lang=lang)
        return table

    def _repr_svg_(self) -> str | None:
        """The first pose with some others thinly, for notebooks."""
        return notebook.svg_of(self) if notebook.svg_of else None

    def check_order(self, order: int) -> None:
        """`LinkageError` for an order beyond that to which the motion was solved."""
        if not 0 <= order <= self.order:
            if 0 <= order <= 3:
                raise LinkageError(
                    "this motion was solved up to order {solved}; for order {order} call move(..., order={order})",
                    solved=self.order,
                    order=order,
                )
            raise LinkageError("the order of a derivative is 0, 1, 2 or 3, not {order!r}", order=order)


def _closure_error(motion: Motion) -> float:
    """See `Motion.closure_error`."""
    lower = motion.plan.lower
    wheels = round_joints(lower.mechanism, lower.elements)
    largest = max(
        (_open_contact(motion, k) for k in round_joints(motion.linkage.mechanism, motion.linkage.elements)), default=0.0
    )
    gaps = [
        joint_openings(motion, linkage, number)
        for linkage, numbers in (
            (lower, set(range(len(lower.mechanism.chain.joints))) - set(wheels)),
            (motion.linkage, motion.plan.released),
        )
        for number in numbers
    ]
    return max([largest, *(float(gap.max(initial=0.0)) for gap in gaps)])


def _open_contact(motion: Motion, number: int) -> float:
    """How far wheels or circles leave each other, or turn against each other since the first row, in sizes."""
    linkage = motion.linkage
    chain, elements = linkage.mechanism.chain, linkage.elements
    a, b = chain.joints[number].links
    if isinstance(elements[number, b], Line):
        a, b = b, a
    element, other_element = elements[number, a], elements[number, b]
    if isinstance(element, LeadingElement) or isinstance(other_element, LeadingElement):
        return _open_curve(motion, number) / linkage.size
    assert isinstance(other_element, RoundElement)
    gap = _point_at(motion, b, other_element.x, other_element.y) - _point_at(motion, a, element.x, element.y)
    touching = chain.joints[number].pair.rolls or isinstance(other_element, Circle)
    if isinstance(element, Line):
        gap *= np.conj(motion.turns[:, motion.link_index(a)] * rect(1, element.angle))
        radius = np.copysign(other_element.radius, gap.imag)
        far, rolled = np.abs(gap.imag - radius), radius * (motion.angle(b) - motion.angle(a)) + gap.real
    else:
        assert isinstance(element, RoundElement)
        far = np.abs(np.abs(gap) - abs(element.radius + other_element.radius))
        arm = carriers(linkage.mechanism, elements).get(number)
        along = np.unwrap(np.angle(gap)) if arm is None else motion.angle(arm.link)
        if isinstance(element, Wheel) and isinstance(other_element, Wheel):
            first, second = rolling_factors(element, other_element)
            rolled = first * (motion.angle(a) - along) + second * (motion.angle(b) - along)
    largest = float(far.max()) if touching else 0.0
    if isinstance(other_element, Wheel):
        largest = max(largest, float(np.abs(rolled - rolled[0]).max()))
    return largest / linkage.size


def _open_curve(motion: Motion, number: int) -> float:
    """How far a follower leaves its cam, or a Geneva or non-circular wheel its angle, times a length."""
    elements = motion.linkage.elements
    a, b = motion.linkage.mechanism.chain.joints[number].links
    last = elements[number, b]
    if isinstance(last, CamDisc | GenevaDriver) or (isinstance(last, NonCircular) and last.transfer != INVERSE):
        a, b = b, a
    first, second = elements[number, a], elements[number, b]
    assert isinstance(first, LeadingElement)
    gap = _point_at(motion, b, second.x, second.y) - _point_at(motion, a, first.x, first.y)
    along = motion.turns[:, motion.link_index(a)] * rect(1, first.angle)
    if isinstance(first, GenevaDriver | NonCircular):
        law = turn_law(first, second)
        bearing = np.unwrap(np.angle(gap))
        turned = motion.angle(a) + first.angle - bearing
        turned += np.angle(along[0] / gap[0] * abs(gap[0])) - turned[0]
        wheel = motion.angle(b) - bearing
        off = np.array([law_at(law, float(t)) for t in turned]) - wheel
        return float(np.abs(off - off[0]).max()) * motion.linkage.size
    law = cam_law(first)
    if isinstance(second, Line):
        normal = 1j * motion.turns[:, motion.link_index(b)] * rect(1, second.angle)
        height = (np.conj(normal) * gap).real
        normal, height = normal * np.sign(height), np.abs(height)
        wanted = np.array([law_at(law, float(t)) for t in np.angle(normal / along)])
    else:
        wanted = np.exp([law_at(law, float(t)) for t in np.angle(gap / along)])
        height = np.abs(gap)
    return float(np.abs(height - wanted).max())


def joint_openings(motion: Motion, linkage: Linkage, number: int) -> Reals:
    """By how much a joint of pins and lines is open in each row, in sizes and radians; (rows,).

    The linkage is that of the motion, or the one with lower pairs.
    """
    joint = linkage.mechanism.chain.joints[number]
    openings = np.zeros(len(motion))
    for first, other in ((joint.links[0], other) for other in joint.links[1:]):
        if not isinstance(linkage.elements[number, first], Line):
            first, other = other, first  # noqa: PLW2901
        element, other_element = linkage.elements[number, first], linkage.elements[number, other]
        gap = (
            _point_at(motion, other, other_element.x, other_element.y) - _point_at(motion, first, element.x, element.y)
        ) / linkage.size
        if isinstance(element, Line):
            line = motion.turns[:, motion.link_index(first)] * rect(1, element.angle)
            if not joint.pair.slides_two_ways:
                openings = np.maximum(openings, np.abs((np.conj(line) * gap).imag))
            if isinstance(other_element, Line):
                openings = np.maximum(
                    openings, np.abs(motion.turns[:, motion.link_index(other)] * rect(1, other_element.angle) - line)
                )
        else:
            openings = np.maximum(openings, np.abs(gap))
    return openings


def _point_at(motion: Motion, link: str, x: float, y: float) -> Complexes:
    k = motion.link_index(link)
    return motion.places[0, :, k] + motion.turns[:, k] * complex(x, y)
