"""Statics of a linkage over the rows of a motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Flags, Reals, compared_by_value, real_numbers
from gruebler.base.columns import Tabled
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.text import Message, joined, joined_by_and, message
from gruebler.base.units import moment_unit
from gruebler.mechanics.forces.acting import Wrench, loads_over_rows
from gruebler.mechanics.forces.contact_forces import pushing
from gruebler.mechanics.forces.equilibrium import (
    JointConnection,
    Reactions,
    joint_connections,
    joint_of_connection,
    link_loads,
    pressed_apart,
    reactions,
)
from gruebler.mechanics.forces.friction import Friction, FrictionForces, PerJoint, as_friction, with_friction
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.motion_rates import with_velocities
from gruebler.mechanics.forces.taking_apart import LinkLoads
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.lower_pairs import joints_left_out
from gruebler.mechanics.linkages.wheels import round_joints

_SINGULAR = message(
    "At the drive values {values} the joint forces are not determined: the links are not held there (a limit of the "
    "drive, or a change point)."
)
_UNKNOWN = message(
    "At {values} virtual work has no answer either: the drive stands at its limit, or the effort depends on the "
    "branch, which a change point alone does not determine."
)
_LOCKED = message(
    "At the drive values {values} the linkage is self-locking, it jams: with this friction no effort of the drive, "
    "however large, moves it on, mainly because of {joint}. The drive's effort is not given there; the linkage would "
    "move with coefficients of friction below {factor:n} times as large (at {value})."
)
_OTHERS = message(
    "At the drive values {values} there is more than one equilibrium with this friction; the one given grows out of "
    "that without friction."
)
_APART = message(
    "At the drive values {values} of these there are equilibria that do not grow out of that without friction: forces "
    "that could hold the linkage jammed."
)
_RESTS = message(
    "At the drive values {values} {joint} is at rest and turns back: no friction there, but just before and behind it."
)
_EFFORT = message("Effort of the drive {drive}: {low:n} to {high:n} {unit}.")
_PRESSED = message(
    "In {joints} teeth press under their pressure angle, and belts pull in one strand; what a preload of a belt adds "
    "is left out."
)
_PITCH_CIRCLES = message(
    "In {joints} no link holds the distance of the wheels: the force is that of pitch circles, without pressure angle."
)
_LIFTS = message(
    "At the drive values {values} the links of {joint}, which only push each other, would lift off: a pull would be "
    "needed to hold them. A spring presses them together; a cam with a groove is said to be closed."
)
_RUBS_NOT = message("Nothing rubs: there are no slides with a coefficient of friction, and no pins with a radius.")
_MOST_VALUES = 6
_SPINS = 1e-9  # of the loads on a roller, times the linkage's size: a moment that is more than rounding
_NO_PULL = 1e-9  # of the largest force of a joint: a smaller pull is rounding
_NONE = 1e-13  # of the loads: a smaller effort is none


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Statics(Tabled):
    """Drive efforts and joint forces of a linkage under loads, at each row of a motion.

    Torques are in force times the linkage's unit. Without inertia.

    See Also:
        `statics`, `Loads`, `Motion`

    Theory:
        docs/theory/statics.md
    """

    motion: Motion
    wrenches: tuple[Wrench, ...]
    reactions: Reactions
    work: Reals
    """(rows, drives): the drives' efforts by virtual work, that of friction included.

    NaN at a limit of the drive, and in change points if all rows are such and the motion has no velocities: the
    effort there depends on the branch. With friction NaN also where it locks, and where forces are not determined.
    """
    friction: FrictionForces | None = None
    """What rubs and where it locks; None if friction was not asked for."""

    @property
    def drive(self) -> Reals:
        """The torque of a driven joint on the link that is moved, or the force of a driven slide; (rows, drives).

        From equilibrium; NaN where the links are not held, and where friction locks. Its work plus that of the loads
        and of friction is zero.
        """
        return self.reactions.drives

    @property
    def singular(self) -> Flags:
        """Whether joint forces are not determined; (rows,)."""
        return self.reactions.singular

    @cached_property
    def disagreement(self) -> float:
        """The largest difference of the two ways to the drives' efforts, by the largest effort or load.

        NaN if no row has both.
        """
        both = np.isfinite(self.drive) & np.isfinite(self.work)
        if not both.any():
            return float("nan")
        work, drive = (np.where(both, effort, 0.0) / self.load for effort in (self.work, self.drive))
        return float(np.abs(drive - work).max() / np.abs(work).max(initial=1.0))

    @property
    def locked(self) -> Flags:
        """Whether friction locks: no effort of the drive moves the linkage on; (rows,)."""
        return np.zeros(len(self.motion), bool) if self.friction is None else self.friction.locked

    @cached_property
    def efficiency(self) -> Reals:
        """The power that leaves by the power that enters, with friction; (rows,).

        Where the drive moves the loads: its effort without friction by that with. Where the loads move the drive:
        the other way round, and 0 if they cannot. NaN without power, and where forces are not known. `LinkageError`
        for several drives.
        """
        if self.friction is None:
            return np.where(np.isnan(self.drive[:, 0]), np.nan, 1.0)
        if len(self.motion.linkage.mechanism.drives) != 1:
            raise LinkageError(
                "efficiency is that of one drive; this linkage has {count}",
                count=len(self.motion.linkage.mechanism.drives),
            )
        without, effort = self.friction.frictionless[:, 0], self.work[:, 0]
        without = np.where(np.abs(without) <= _NONE * self.load[0], np.nan, without)
        forward = without * self.friction.effort[:, 0] >= 0
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(forward, without / effort, np.maximum(effort / without, 0.0))

    @cached_property
    def load(self) -> Reals:
        """What all loads together come to at most, as an effort of each drive (a torque, or a force); (drives,)."""
        size, mechanism = self.motion.size, self.motion.linkage.mechanism
        force = (
            sum(float(np.abs(wrench.force).max() + np.abs(wrench.moment).max() / size) for wrench in self.wrenches)
            or 1.0
        )
        return np.array([force * (size if drive.turning else 1.0) for drive in mechanism.drives])

    def force(self, joint: str | int, *, link: str | None = None) -> Reals:
        """The force of a joint on one of its links (without a name: the last that is not the frame); (rows, 2).

        With friction, if it was asked for; at a driven slide without the drive's own force. It acts at the pin, or at
        the point of the later link's line.

        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> from gruebler.mechanics.kinematics import move
        >>> press = move(SliderCrank(3, 5).linkage(), np.radians([90.0]))
        >>> held = statics(press, Loads(forces={"R(coupler-slider)": (-100, 0)}))
        >>> held.force("P(frame-slider)").round(9).tolist()  # 100 tan(alpha), sin(alpha) = 3/5
        [[0.0, 75.0]]
        """
        number, link = self._of(joint, link)
        total = np.zeros(len(self.motion), np.complex128)
        for k, sign in self._signs(number, link):
            total = total + sign * self.reactions.forces[:, k]
        return np.stack([total.real, total.imag], axis=1)

    def couple(self, joint: str | int, *, link: str | None = None) -> Reals:
        """The moment by which a slide keeps one of its links from turning; of a pin that of its friction; (rows,)."""
        number, link = self._of(joint, link)
        total: Reals = np.zeros(len(self.motion))
        for k, sign in self._signs(number, link):
            total = total + sign * self.reactions.couples[:, k]
        return total

    def explain(self, lang: str = "en") -> str:
        """The range of each drive's effort and the largest joint force, then `message`; in English or German.

        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> from gruebler.mechanics.kinematics import move
        >>> press = move(SliderCrank(3, 5).linkage(), np.radians([90.0]))
        >>> print(statics(press, Loads(forces={"R(coupler-slider)": (-100, 0)})))  # 125 N along the coupler
        Positions: 1.
        Effort of the drive R(frame-crank): -300 to -300 N·mm.
        Largest force in a joint: 125 N.
        """
        mechanism = self.motion.linkage.mechanism
        lines = [message("Positions: {count}.", count=len(self.motion))]
        for k, drive in enumerate(mechanism.drives):
            known = self.work[:, k][np.isfinite(self.work[:, k])]
            if len(known):
                name = mechanism.chain.joint_title(drive.joint)
                unit = moment_unit(self.motion.linkage.unit, lang) if drive.turning else "N"
                ends = {"low": float(known.min()), "high": float(known.max())}
                lines.append(_EFFORT.filled(drive=name, unit=unit, **ends))
        forces = np.abs(self.reactions.forces)
        if np.isfinite(forces).any():
            lines.append(message("Largest force in a joint: {force:n} N.", force=float(np.nanmax(forces))))
        return "\n".join([*(line.in_language(lang) for line in lines), self.message(lang)]).rstrip()

    def message(self, lang: str = "en") -> str:
        """Where forces are not determined, where friction locks, where there are several equilibria; else empty."""
        without = self.work if self.friction is None else self.friction.frictionless
        unknown = np.asarray(np.isnan(without).any(axis=1))
        parts = ((_SINGULAR, self.singular), (_UNKNOWN, unknown))
        sentences = [text.filled(values=self._values(rows)) for text, rows in parts if rows.any()]
        contacts = [*self._of_contacts(), *self._of_lifting()]
        return joined([*sentences, *contacts, *self._of_friction()], " ").in_language(lang)

    @cached_property
    def pushes(self) -> dict[int, Reals]:
        """By number of the joint, where links can only push each other (cams, smooth circles): the push; (rows,).

        Where it is negative they would have to pull, and in truth lift off.
        """
        chain, joints = (
            self.motion.linkage.mechanism.chain,
            round_joints(self.motion.linkage.mechanism, self.motion.linkage.elements),
        )
        pairs = {joint: pushing(self.motion, joint) for joint in joints if not chain.joints[joint].pair.is_basic}
        return {
            joint: (np.conj(pair[1] / np.abs(pair[1])) * (self.force(joint, link=pair[0]) @ [1, 1j])).real
            for joint, pair in pairs.items()
            if pair is not None
        }

    def _of_lifting(self) -> list[Message]:
        """Where links that can only push each other would have to pull."""
        forces = np.abs(self.reactions.forces)
        least = -_NO_PULL * float(np.nanmax(forces, initial=0.0))
        title = self.motion.linkage.mechanism.chain.joint_title
        return [
            _LIFTS.filled(joint=title(joint), values=self._spans(push < least))
            for joint, push in self.pushes.items()
            if (push < least).any()
        ]

    def _of_contacts(self) -> list[Message]:
        """What is to be said of teeth and belts."""
        title = self.motion.linkage.mechanism.chain.joint_title
        said = zip((_PRESSED, _PITCH_CIRCLES), self._pressed, strict=True)
        return [text.filled(joints=joined_by_and([*map(title, sorted(joints))])) for text, joints in said if joints]

    @cached_property
    def _pressed(self) -> tuple[set[int], set[int]]:
        return pressed_apart(self.motion)

    def _of_friction(self) -> list[Message]:
        """What is to be said of friction."""
        rubbing, chain = self.friction, self.motion.linkage.mechanism.chain
        if rubbing is None:
            return []
        if not rubbing.contacts:
            return [_RUBS_NOT]
        sentences = []
        joints = np.array([-1 if (k := rubbing.locking_joint(row)) is None else k for row in range(len(self.motion))])
        for joint in sorted(set(joints[rubbing.locked].tolist())):
            rows = rubbing.locked & (joints == joint)
            worst = int(np.argmin(np.where(rows, rubbing.locking_factor, np.inf)))
            sentences.append(
                _LOCKED.filled(
                    values=self._values(rows),
                    joint=chain.joint_title(joint),
                    factor=float(rubbing.locking_factor[worst]),
                    value=self._value(worst),
                )
            )
        more, apart = ~rubbing.locked & (rubbing.equilibria > 1), rubbing.locked & (rubbing.equilibria > 0)
        for k, contact in enumerate(rubbing.contacts):
            rests = (rubbing.directions[:, k] == 0) & np.isfinite(self.work).all(axis=1)
            if rests.any() and not rests.all():
                joint = chain.joint_title(contact.joint)
                sentences.append(_RESTS.filled(values=self._values(rests), joint=joint))
        several = ((_OTHERS, more), (_APART, apart))
        return sentences + [text.filled(values=self._values(rows)) for text, rows in several if rows.any()]

    def _values(self, flags: Flags) -> Message:
        rows = np.flatnonzero(flags)
        written = [self._value(int(row)) for row in rows[:_MOST_VALUES]]
        return joined([*written, *(["..."] if len(rows) > _MOST_VALUES else [])])

    def _spans(self, flags: Flags) -> Message:
        """From where to where, row by row."""
        rows = np.flatnonzero(flags)
        parts = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)
        written = [
            message("{first} to {last}", first=self._value(int(part[0])), last=self._value(int(part[-1])))
            if len(part) > 1
            else self._value(int(part[0]))
            for part in parts[:_MOST_VALUES]
        ]
        return joined([*written, *(["..."] if len(parts) > _MOST_VALUES else [])])

    def _value(self, row: int) -> Message:
        value = float(self.motion.drives[row, 0])
        if self.motion.linkage.mechanism.drives[0].turning:
            return message("{value:n}°", value=float(np.degrees(value)))
        return message("{value:n}", value=value)

    def _of(self, joint: str | int, link: str | None) -> tuple[int, str]:
        mechanism = self.motion.linkage.mechanism
        number = mechanism.chain.joint_number(joint, error=LinkageError)
        links = mechanism.chain.joints[number].links
        if link is None:
            return number, next(candidate for candidate in reversed(links) if candidate != mechanism.frame)
        if link not in links:
            raise LinkageError(
                "{joint} is not a joint of {link!r}", joint=mechanism.chain.joint_title(number), link=link
            )
        return number, link

    def _signs(self, number: int, link: str) -> list[tuple[int, int]]:
        """The contacts of a joint on a link, with +1 where it is the other link.

        A joint of two freedoms stands for two lower joints, one after the other, in the linkage that is solved.
        """
        lower = [at for at, joint in enumerate(joint_of_connection(self.motion)) if joint == number]
        k = self.motion.link_index(link)
        return [
            (at, 1 if contact.second == k else -1)
            for at, contact in enumerate(self._contacts)
            if contact.joint in lower and k in (contact.first, contact.second)
        ]

    @cached_property
    def _contacts(self) -> tuple[JointConnection, ...]:
        return joint_connections(self.motion)


@door_that_raises(LinkageError)
def statics(
    motion: Motion,
    loads: Loads,
    *,
    friction: Friction | PerJoint | None = None,
    times: ArrayLike = 0.0,
) -> Statics:
    """Drive efforts and joint forces that hold the loads at every row of a motion, by two independent methods.

    Equilibrium of every link gives all forces; the drives' efforts also come from virtual work, with the velocities of
    the loads' points for each drive alone. Error: that of the poses times the condition of the pose.

    Args:
        motion: The poses; with speeds, if given, they say in which sense friction acts, else the drive goes forward.
        loads: What acts from outside, in newtons.
        friction: Coulomb friction, solved together with the joint forces: a coefficient for all slides, coefficients
            by joint, or `Friction` with radii of pins and guides. Where it locks, forces are NaN and `Statics.message`
            says so.
        times: At which loads are taken that depend on the time; (rows,) or one.

    Returns:
        `Statics`: (rows, drives) efforts of the drives (N, or N times the unit of length), (rows, 2) forces of the
        joints; where it locks they are NaN and ``message`` says so.

    Raises:
        LinkageError: loads on points that are not there, a linkage without drives, friction in joints that are not
            there.

    Cost:
        Some 1 us a row of a four-bar, with friction 0.5 ms (one slide) to 3 ms (four contacts).

    Example:
        >>> from gruebler.mechanics.kinematics import move
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> pose = move(FourBar(25, 70, 40, 70).linkage(), np.radians([55.0]))
        >>> held = statics(pose, Loads(moments={"rocker": -1000}))
        >>> held.drive.round(6).tolist(), held.work.round(6).tolist()  # the rocker turns 0.478521 times as fast
        ([[478.520528]], [[478.520528]])
        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> press = move(SliderCrank(3, 5).linkage(), np.radians([90.0, 270.0]))  # tan(alpha) = 3/4
        >>> rubbing = statics(press, Loads(forces={"R(coupler-slider)": (-100, 0)}), friction=0.5)
        >>> rubbing.drive.round(6).ravel().tolist()  # the slider goes back, then forth: 300/(1 + 3/8), 300/(1 - 3/8)
        [-218.181818, 480.0]
        >>> rubbing.friction.locking_factor.round(6).tolist()  # 4/3 of the coefficient; going back it never locks
        [inf, 2.666667]

    See Also:
        `Loads`, `Statics`, `move`

    Theory:
        docs/theory/statics.md
    """
    return equilibrium(motion, loads, friction, times)


def equilibrium(
    motion: Motion,
    loads: Loads,
    friction: Friction | PerJoint | None,
    times: ArrayLike,
    besides: tuple[Wrench, ...] = (),
) -> Statics:
    """`statics` with further forces and moments, such as those of inertia."""
    if not motion.lower_linkage.mechanism.drives:
        raise LinkageError("no joint is driven: nothing holds the loads")
    if not _are_times(times, len(motion)):
        raise LinkageError("times: expected seconds, one number or one a row, but found {times!r}", times=times)
    if motion.plan.released or joints_left_out(motion.linkage):
        raise LinkageError("the linkage is overconstrained: how its joints share the loads depends on their stiffness")
    given = loads_over_rows(motion, loads, times)
    if not len(motion):
        raise LinkageError("the motion has no rows. {reason}", reason=motion.reason)
    _check_rollers(motion, given)
    wrenches = (*given, *besides)
    loads_of_links = link_loads(motion, wrenches)
    work = _virtual_work(motion, loads_of_links)
    if friction is None:
        return Statics(motion=motion, wrenches=wrenches, reactions=reactions(motion, loads_of_links), work=work)
    forces, rubbing = with_friction(motion, wrenches, as_friction(friction), work)
    return Statics(motion=motion, wrenches=wrenches, reactions=forces, work=work + rubbing.effort, friction=rubbing)


def _check_rollers(motion: Motion, wrenches: tuple[Wrench, ...]) -> None:
    """`LinkageError` for loads that would spin a roller, whose spin nothing holds; docs/theory/wheels.md."""
    lower = motion.lower_linkage
    for drive in lower.mechanism.drives[len(motion.linkage.mechanism.drives) :]:
        name = next(link for link in lower.mechanism.chain.joints[drive.joint].links if _carries_circle(lower, link))
        its, pin = [wrench for wrench in wrenches if wrench.place.link == name], lower.elements[drive.joint, name]
        loads, k = link_loads(motion, its), motion.link_index(name)
        moment = loads.moment[k] - (np.conj(motion.turns[:, k] * complex(pin.x, pin.y)) * loads.force[k]).imag
        if np.abs(moment).max() > _SPINS * (motion.size * np.abs(loads.force[k]).max() + np.abs(loads.moment[k]).max()):
            raise LinkageError("{link!r} is free to spin: nothing holds a moment about its pin", link=name)


def _carries_circle(lower: Linkage, link: str) -> bool:
    return any(element.is_smooth for (_, owner), element in lower.elements.items() if owner == link)


def _are_times(times: ArrayLike, rows: int) -> bool:
    values = real_numbers(times)
    return values is not None and values.shape in ((), (rows,)) and bool(np.isfinite(values).all())


def _virtual_work(motion: Motion, loads: LinkLoads) -> Reals:
    """The efforts whose work on a small motion of each drive is that of the loads with the other sign."""
    drives = len(motion.linkage.mechanism.drives)
    work = np.full((len(motion), drives), np.nan)
    if drives == 1 and motion.order and motion.speeds is not None and (speed := motion.speeds[0, :, 0]).all():
        work[:, 0] = -_power(loads, motion) / speed
        return np.where(np.isfinite(work), work, np.nan)
    for k in range(drives):
        for rows, moved in with_velocities(motion, np.eye(drives)[k]):
            work[rows, k] = -_power(LinkLoads(loads.force[:, rows], loads.moment[:, rows]), moved)
    return work


def _power(loads: LinkLoads, moved: Motion) -> Reals:
    """(rows,)."""
    power: Reals = np.einsum("lr,rl->r", np.conj(loads.force), moved.places[1]).real
    power += np.einsum("lr,rl->r", loads.moment, moved.rates[0])
    return power
