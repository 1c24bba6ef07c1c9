"""What `move` returns for a linkage in space: where every link is at each row, and how it moves there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import factorial
from typing import Any

import numpy as np

from gruebler.base import notebook
from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.columns import Table
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief, explained
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.linkages.points import link_number
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.rigid_motions import inverse_motion
from gruebler.mechanics.space.bodies import motions
from gruebler.mechanics.space.closure import Place
from gruebler.mechanics.space.power_series import product
from gruebler.structure.chain.spaces import Freedom

_LIMIT = message(
    "The motion ends at {drives}: there the drive stands at its limit and has to turn back, while {joints} could go on."
)
_LIMITS = message(
    "The motion ends at {drives}: there the drives stand at a limit and have to turn back, while {joints} could go on."
)
_MEET = message("The motion ends at {drives}: there two assembly modes meet in {joints}.")
_ENDLESS = message("The motion ends at {drives}: towards it the shifts in {joints} grow without end.")
_ISOLATED = message(
    "The linkage cannot move from {drives}, neither way: the position is isolated, {joints} close there and nowhere "
    "next to it."
)
_PASSED = message(
    "Before {drives} it passes a position in which two assembly modes meet, and goes straight on in its own."
)
_CHANGE = message("At {drives} two assembly modes meet; it goes straight on in its own.")
_POSITIONS = message("Positions: {count}, from {first} to {last}; derivatives up to order {order}.")
_RANK = message(
    "{rows} closing conditions of rank {rank}, constant all the way; open by {gap:.0e} of the size at most."
)
_IDLE = message("Idle: {links}; the spin is fixed by the shortest turn from the reference pose.")
_HELD = message("Other idle freedoms are fixed: a turn or shift is held in {joints}.")


@explained
@dataclass(frozen=True, kw_only=True)
class SpatialStop:
    """Where a motion in space ended before the end of its path, and why."""

    row: float
    """The place on the path, in rows."""
    drives: tuple[float, ...]
    """The drive values there: at a limit where one drive moves to rounding, else as near as the smallest step: a
    millionth of a tenth of a radian."""
    joints: tuple[str, ...]
    """The joints that move fastest there, or that shift without end; in an isolated position all but the driven."""
    reason: str
    """``limit`` (the drives can go no farther), ``endless`` (shifts grow without end), ``singular`` (two assembly modes
    meet), ``isolated`` (no motion at all)."""
    linkage: SpatialLinkage = field(repr=False)
    """The linkage that moves."""
    place: Place = field(repr=False, compare=False)
    """The last position; at a limit where one drive moves that in which it turns back."""

    @property
    def message(self) -> Message:
        """What `explain` says, in any language."""
        limit = _LIMIT if len(self.drives) == 1 else _LIMITS
        text = {"limit": limit, "endless": _ENDLESS, "isolated": _ISOLATED}.get(self.reason, _MEET)
        chain = self.linkage.mechanism.chain
        titles = joined(chain.joint_title(chain.joint_number(name)) for name in self.joints)
        return text.filled(drives=drive_values(self.linkage, self.drives), joints=titles)

    def explain(self, lang: str = "en") -> str:
        """Where and why the motion ends, a sentence in English or German (``de``)."""
        return self.message.in_language(lang)


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class SpatialMotion:
    """Poses of a linkage in space along a path of its drives, with derivatives.

    Points are returned as (rows, 3). Rows after a `stop` are missing: ``len(motion)`` says how many are.
    """

    linkage: SpatialLinkage
    drives: Reals
    """(rows, drives) the drive values of the rows that were reached."""
    poses: Reals
    """(order + 1, rows, links, 4, 4): where each link is against the reference pose, and its time derivatives."""
    unknowns: dict[tuple[int, str], Reals]
    """(order + 1, rows): the values of the freedoms (joint, direction) that were solved for, with whole turns."""
    rank: int
    """Of the closing conditions without the drives; constant along the motion."""
    derivatives: Reals
    """(rows, conditions, freedoms): of the closing conditions by the freedoms solved for, lengths in sizes."""
    gap: float
    """The largest distance by which a joint is open, of the size."""
    idle: tuple[str, ...]
    """Rods between two balls, whose spin is fixed by a rule."""
    stop: SpatialStop | None
    held: tuple[str, ...] = ()
    """Joints in which a turn or shift is held: so other idle freedoms are fixed."""
    passed: tuple[int, ...] = ()
    """Rows before which it went straight on through a position where two assembly modes meet."""
    changes: tuple[int, ...] = ()
    """Rows in which two assembly modes meet; it goes straight on there."""

    def __len__(self) -> int:
        return len(self.drives)

    @property
    def complete(self) -> bool:
        """Whether the whole path was followed."""
        return self.stop is None

    @property
    def conditions(self) -> int:
        """How many closing conditions there are."""
        return int(self.derivatives.shape[1])

    @cached_property
    def smallest(self) -> Reals:
        """(rows,): the smallest singular value of the derivatives, of the largest; 0 where assembly modes meet."""
        if not self.rank:
            return np.ones(len(self))
        values = np.linalg.svd(self.derivatives, compute_uv=False)
        return np.asarray(values[:, self.rank - 1] / values[:, 0])

    @property
    def order(self) -> int:
        """The highest derivative: 0 positions, 1 velocities, 2 accelerations, 3 jerks."""
        return len(self.poses) - 1

    @property
    def closure_error(self) -> float:
        """The largest distance by which a joint of any pose is open, relative to the linkage's size."""
        return self.gap

    def message(self, lang: str = "en") -> str:
        """Where it passed a change of mode, where and why it stopped; else empty."""
        return self.reason.in_language(lang)

    @property
    def reason(self) -> Message:
        """What `message` says, in any language."""
        return joined(self._remarks(), " ")

    def _remarks(self) -> list[Message]:
        marks = [*((row, _PASSED) for row in self.passed if row < len(self)), *((row, _CHANGE) for row in self.changes)]
        remarks = [
            text.filled(drives=drive_values(self.linkage, tuple(map(float, self.drives[row]))))
            for row, text in sorted(marks, key=lambda mark: mark[0])
        ]
        return remarks if self.stop is None else [*remarks, self.stop.message]

    def explain(self, lang: str = "en") -> str:
        """How many positions, from where to where, the rank, idle links and the end: a few lines.

        >>> from gruebler.mechanics.space import move
        >>> from gruebler.structure.mechanism import Mechanism
        >>> winch = Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut); drive=R(frame-spindle)")
        >>> z = (0, 0, 1)
        >>> joints = {0: {"z": z}, 1: {"z": z, "pitch": 2}, 2: {"x": z, "at": (0, 60, 0)}}
        >>> print(move(SpatialLinkage(winch, joints), [0.0, 1.0]))
        Positions: 2, from R(frame-spindle) = 0° to R(frame-spindle) = 57.3°; derivatives up to order 0.
        5 closing conditions of rank 1, constant all the way; open by ... of the size at most.
        The whole path was followed.
        """
        lines: list[Message] = []
        if len(self):
            first, last = (drive_values(self.linkage, tuple(map(float, self.drives[row]))) for row in (0, -1))
            lines.append(_POSITIONS.filled(count=len(self), first=first, last=last, order=self.order))
            lines.append(_RANK.filled(rows=self.conditions, rank=self.rank, gap=self.gap))
        if self.idle:
            lines.append(_IDLE.filled(links=", ".join(self.idle)))
        if self.held:
            chain = self.linkage.mechanism.chain
            titles = joined(chain.joint_title(chain.joint_number(name)) for name in self.held)
            lines.append(_HELD.filled(joints=titles))
        if self.stop is None:
            lines.append(message("The whole path was followed."))
        lines += self._remarks()
        return "\n".join(line.in_language(lang) for line in lines)

    # --- links -----------------------------------------------------------------------------------------------------

    def link_index(self, link: str) -> int:
        """Where a link is in the arrays; `LinkageError` offers the nearest name."""
        return link_number(link, self.linkage.mechanism.chain.links)

    def pose(self, link: str) -> Reals:
        """Where a link is, (rows, 4, 4), against the reference pose."""
        return np.asarray(self.poses[0, :, self.link_index(link)])

    def quaternion(self, link: str) -> Reals:
        """The turn of a link since the reference pose as unit quaternions w, x, y, z without jumps; (rows, 4)."""
        r = self.pose(link)[:, :3, :3]
        outer = np.zeros((len(r), 4, 4))  # four times the products of the quaternion's numbers
        trace = np.trace(r, axis1=1, axis2=2)
        outer[:, 0, 0] = 1 + trace
        skew = np.stack([r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1]], axis=1)
        outer[:, 0, 1:] = outer[:, 1:, 0] = skew
        outer[:, 1:, 1:] = r + np.swapaxes(r, 1, 2) + (1 - trace)[:, None, None] * np.eye(3)
        best = np.argmax(np.einsum("rii->ri", outer), axis=1)
        quaternions = outer[np.arange(len(r)), best]
        quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
        for row in range(len(r)):
            before = quaternions[row - 1] if row else np.array([1.0, 0, 0, 0])
            if quaternions[row] @ before < 0:
                quaternions[row] *= -1
        return np.asarray(quaternions)

    def angular(self, link: str, *, order: int = 1) -> Reals:
        """The angular velocity (1), acceleration (2) or jerk (3) of a link, (rows, 3), in the frame's axes."""
        self.check_order(order)
        if order == 0:
            raise LinkageError("turns in space are no vectors: quaternion(link) has them")
        turn = self._series(self.poses[:, :, self.link_index(link), :3, :3])
        rate = turn[1:] * np.arange(1, len(turn))[:, None, None, None]
        w = product(rate, np.swapaxes(turn[:-1], -1, -2), np.matmul)[order - 1] * factorial(order - 1)
        return np.stack([w[:, 2, 1] - w[:, 1, 2], w[:, 0, 2] - w[:, 2, 0], w[:, 1, 0] - w[:, 0, 1]], axis=1) / 2

    def twist(self, link: str) -> Reals:
        """Angular velocity and the velocity of the point at the origin, (rows, 6)."""
        w = self.angular(link)
        k = self.link_index(link)
        return np.concatenate([w, self.poses[1, :, k, :3, 3] - np.cross(w, self.poses[0, :, k, :3, 3])], axis=1)

    # --- points ----------------------------------------------------------------------------------------------------

    def point(self, name: str | tuple[str, float, float, float], *, order: int = 0) -> Reals:
        """A named point, a joint, or (link, x, y, z) in the reference pose, or a derivative of its place; (rows, 3)."""
        self.check_order(order)
        link, at = self.linkage.point(name)
        pose = self.poses[order, :, self.link_index(link)]
        return np.asarray(pose[:, :3, :3] @ np.array(at) + pose[:, :3, 3])

    def velocity(self, point: str | tuple[str, float, float, float]) -> Reals:
        """The velocity of a point, (rows, 3), in lengths a second."""
        return self.point(point, order=1)

    def acceleration(self, point: str | tuple[str, float, float, float]) -> Reals:
        """The acceleration of a point, (rows, 3), in lengths per second squared."""
        return self.point(point, order=2)

    # --- tables ----------------------------------------------------------------------------------------------------

    def table(self, *, outputs: Sequence[str] | None = None, points: Sequence[str] = (), lang: str = "en") -> Table:
        """Drives, outputs and points row by row, with derivatives in time.

        `Table.to_dataframe`, `Table.csv` and others give it to other programs.

        Args:
            outputs: joints, by their names; without them the linkage's output where it is a joint.
            points: names of points or joints.
            lang: language of the headers.
        """
        assert notebook.table_of is not None  # set by the front door
        table: Table = notebook.table_of(self, outputs, points, lang=lang)
        return table

    def to_dataframe(self) -> Any:
        """The `table` with all named points as a `pandas.DataFrame`, a row for each pose; needs pandas."""
        return self.table(points=tuple(self.linkage.points)).to_dataframe()

    # --- joints ----------------------------------------------------------------------------------------------------

    def joint(self, name: str | int, direction: str | None = None, order: int = 0) -> Reals:
        """The value of a freedom of a joint, of the second link against the first, or a derivative of it; (rows,).

        Args:
            name: a joint of two links.
            direction: such as ``Rz``; needed where the joint has several freedoms. A ball has no such values.
            order: 0 to 3.

        Raises:
            LinkageError: a ball, no such freedom, an order that was not solved for.
        """
        self.check_order(order)
        chain = self.linkage.mechanism.chain
        number = chain.joint_number(name, error=LinkageError)
        joint = chain.joints[number]
        known = [str(freedom) for freedom in motions(joint.pair, chain.space)]
        if direction is None and len(known) == 1:
            direction = known[0]
        if direction not in known or joint.pair.is_ball or joint.pair.has_body_between or joint.pair.has_contours:
            raise LinkageError(
                "{joint}: expected one of its freedoms {known}, of a joint that is no ball and no contact",
                joint=chain.joint_title(number),
                known=", ".join(known),
            )
        if (number, direction) in self.unknowns:
            return np.asarray(self.unknowns[number, direction][order])
        return np.asarray(self._seen(number, direction)[order])

    def _seen(self, number: int, direction: str) -> Reals:
        """The value of a freedom from the poses of its links, and its derivatives, (order + 1, rows)."""
        chain = self.linkage.mechanism.chain
        links = chain.joints[number].links
        frame = self.linkage.frames[number]
        poses = self._series(self.poses)
        first, second = (poses[:, :, chain.index(link)] @ frame for link in links[:2])
        back = inverse_of_series(first)
        e = product(back, second, np.matmul)
        freedom = Freedom(direction)
        m = "xyz".index(freedom.axis)
        if not freedom.turns:
            return np.asarray(e[..., m, 3] * self._factorials[:, None])
        turns = [f.axis for f in chain.joints[number].pair.freedoms[chain.space] if f.turns]
        if len(turns) == 2:
            n = "xyz".index(turns[1 - turns.index(freedom.axis)])
            k, sign = 3 - m - n, 1.0 if (m + 1) % 3 == n else -1.0
            first_turn = freedom.axis == turns[0]  # it alone moves the other axis; the other one alone is seen from it
            c, s = e[..., n, n], sign * e[..., k, n] if first_turn else -sign * e[..., n, k]
        else:
            a, b = (m + 1) % 3, (m + 2) % 3
            c, s = e[..., a, a], e[..., b, a]
        angle = np.zeros(c.shape)
        angle[0] = np.unwrap(np.arctan2(s[0], c[0]))
        if len(c) > 1:
            order = np.arange(1, len(c))[:, None]
            rate = product(c[:-1], s[1:] * order, np.multiply) - product(s[:-1], c[1:] * order, np.multiply)
            angle[1:] = rate / order
        return np.asarray(angle * self._factorials[:, None])

    @cached_property
    def _factorials(self) -> Reals:
        return np.array([float(factorial(k)) for k in range(self.order + 1)])

    def _series(self, derivatives: Reals) -> Reals:
        shape = (-1,) + (1,) * (derivatives.ndim - 1)
        return np.asarray(derivatives / self._factorials.reshape(shape))

    def check_order(self, order: int) -> None:
        """`LinkageError` for an order beyond that to which the motion was solved."""
        if not 0 <= order <= self.order:
            raise LinkageError(
                "this motion was solved up to order {solved}; for order {order} call move(..., order={order})",
                solved=self.order,
                order=order,
            )


def inverse_of_series(poses: Reals) -> Reals:
    """The inverse rigid motions of a series, (orders, ..., 4, 4)."""
    inverse = inverse_motion(poses)
    turn = np.swapaxes(poses[..., :3, :3], -1, -2)
    inverse[..., :3, 3] = -product(turn, poses[..., :3, 3, None], np.matmul)[..., 0]
    inverse[1:, ..., 3, 3] = 0
    return inverse
