"""What a solver returns: where every link of a linkage is at each row of drive values, and how it moves there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base import notebook
from gruebler.base.arrays import Complexes, Reals, angles_of_turns, compared_by_value
from gruebler.base.columns import Table
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import Drawn, brief, explained
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.kinematics.link_poses import LinkPoses
from gruebler.mechanics.kinematics.messages import (
    drive_values,
    stop_message,
    taken_for_exact_message,
    unbounded_message,
)
from gruebler.mechanics.kinematics.openings import closure_error
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.points import PointLike


@explained
@dataclass(frozen=True, kw_only=True)
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
    linkage: Linkage = field(repr=False)
    """The linkage that moves."""

    @property
    def message(self) -> Message:
        """What `explain` says, in any language."""
        return stop_message(self.linkage, self.reason, self.drives, self.links, self.form)

    def explain(self, lang: str = "en") -> str:
        """Where and why the motion ends, a sentence in English or German (``de``).

        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> from gruebler.mechanics.kinematics import move
        >>> print(move(SliderCrank(50, 40), [0.0, 1.5]).stop)
        The motion ends at R(frame-crank) = 53.13°: there RRP {coupler, slider} can no longer be assembled.
        """
        return self.message.in_language(lang)


_POSITIONS = message("Positions: {count}, from {first} to {last}; derivatives up to order {order}.")


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Motion(LinkPoses, Drawn):
    """Poses of a linkage along a path of its drives, with derivatives.

    Points are returned as (rows, 2), angles as (rows,) in radians without jumps. Rows after a `stop` are missing:
    ``len(motion)`` says how many are.

    See Also:
        `move`, `move_many`, `Circuit`, `Measures`

    Theory:
        docs/theory/kinematics.md
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
            parts.append(self.stop.message)
        return joined(parts, " ")

    def explain(self, lang: str = "en") -> str:
        """How many positions, from where to where, and why it stopped: a few lines in English or German (``de``).

        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> from gruebler.mechanics.kinematics import move
        >>> print(move(SliderCrank(3, 5), [0.0, 0.5]))
        Positions: 2, from R(frame-crank) = 0° to R(frame-crank) = 28.65°; derivatives up to order 0.
        The whole path was followed.
        """
        lines = []
        if len(self):
            first, last = (drive_values(self.linkage, tuple(map(float, self.drives[row]))) for row in (0, -1))
            lines.append(_POSITIONS.filled(count=len(self), first=first, last=last, order=self.order))
        if self.complete:
            lines.append(message("The whole path was followed."))
        return "\n".join(line.in_language(lang) for line in [*lines, self.reason]).rstrip()

    def angle(self, link: str) -> Reals:
        """The angle of a link's x axis against the frame's, in radians, continuous; (rows,)."""
        k = self.link_index(link)
        return angles_of_turns(self.turns[:, k], self.whole[:, k])

    def angular(self, link: str, *, order: int = 1) -> Reals:
        """The angular velocity (1), acceleration (2) or jerk (3) of a link; (rows,)."""
        self.check_order(order)
        rates: Reals = self.rates[order - 1, :, self.link_index(link)] if order else self.angle(link)
        return rates

    def velocity(self, point: PointLike) -> Reals:
        """The velocity of a point or joint, (rows, 2), in lengths a second; `angular` gives that of a link.

        Raises `LinkageError` for an unknown point, and unless the motion was solved with velocities.
        """
        return self.point(point, order=1)

    def acceleration(self, point: PointLike) -> Reals:
        """The acceleration of a point or joint, (rows, 2), in lengths per second squared.

        Raises `LinkageError` for an unknown point, and unless the motion was solved with accelerations.
        """
        return self.point(point, order=2)

    def to_dataframe(self) -> Any:
        """The `table` with all named points as a `pandas.DataFrame`, a row for each pose; needs pandas."""
        return self.table(points=tuple(self.linkage.points)).to_dataframe()

    @cached_property
    def closure_error(self) -> float:
        """The largest distance by which a joint of any pose is open, relative to the linkage's size."""
        return closure_error(self, self.plan.released)

    @property
    def branch(self) -> tuple[str, ...]:
        """The assembly mode at the start, as `move` understands it."""
        from gruebler.mechanics.kinematics.branches import branch_of

        return branch_of(self.plan, self.roots[0], self.unknowns[0], self.drives[0])

    def table(
        self,
        *,
        outputs: Sequence[str] | None = None,
        points: Sequence[PointLike] = (),
        transmission: str | None = None,
        lang: str = "en",
    ) -> Table:
        """Drives, outputs and points row by row, with derivatives: `gruebler.mechanics.analysis.motion_table`.

        `Table.structured`, `Table.to_dataframe`, `Table.arrow` and `Table.csv` give it to other programs,
        `gruebler.write` writes it into a file.

        Args:
            outputs: Links or sliding joints; without them the linkage's outputs.
            points: Names of points or joints.
            transmission: The output whose transmission angle gets a column.
            lang: Language of the headers.
        """
        assert notebook.table_of is not None  # set by the front door
        table: Table = notebook.table_of(self, outputs, points, transmission=transmission, lang=lang)
        return table

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
