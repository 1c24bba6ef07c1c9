"""How far targets move when lengths change: exact derivatives at fixed drive values. docs/theory/synthesis.md."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.targets import Probe
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage

LENGTH_ERROR = 1e-3
"""Of each length."""
_NONE = 1e-9  # of the size of the linkage: so short is no length
_ROWS = 16  # poses from one target to the next


@dataclass(frozen=True, kw_only=True)
class LinkLength:
    """A length of a link, from its first pin to another pin, to a point or to a slide."""

    link: str
    first: str
    """The joint of the first pin, by its number."""
    other: str
    """The joint by its number, or the name of the point."""
    across: bool
    """Whether the pin or point moves across the length, not along it."""
    length: float


@dataclass(frozen=True, kw_only=True)
class SlideOffset:
    """How far the first pins of the two links of a slide lie apart across it.

    Both links have a line there, which may lie anywhere beside their pins, as long as it does so on both.
    """

    joint: int
    link: str
    """To which the offset is ascribed: the frame, if the slide is there, else the first of the two."""
    pin: int
    """The joint of its first pin."""
    offset: float
    """From this pin to the left of the line of the link."""
    moved: str
    """One of the two links, the line of which is that of no third link."""
    arm: complex
    """By so much its line is moved where the offset grows by itself."""


def slide_offsets(linkage: Linkage) -> tuple[SlideOffset, ...]:
    """The offset of each slide between two links that have pins; a link without any is guided by its lines alone.

    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> [(each.link, each.offset) for each in slide_offsets(SliderCrank(3, 5, 1).linkage())]
    [('frame', 1.0)]
    """
    mechanism, posed = linkage.mechanism, linkage.reference_pose
    pins: dict[str, int] = {}
    for number, owner in sorted(linkage.elements):
        if linkage.elements[number, owner].is_pin:
            pins.setdefault(owner, number)
    offsets = []
    for number, joint in enumerate(mechanism.chain.joints):
        for moved in joint.links[1:] if joint.pair.is_sliding else ():
            ends = (joint.links[0], moved)
            if not pins.keys() >= {*ends}:
                continue
            lines = [linkage.elements[number, link].place for link in ends]
            origins = [linkage.elements[pins[link], link].place for link in ends]
            turns = [
                line[2] + (0.0 if posed is None else posed[link][2]) for link, line in zip(ends, lines, strict=True)
            ]
            along = [complex(np.exp(1j * line[2])) for line in lines]
            own = [
                ((complex(*line[:2]) - complex(*pin[:2])) * direction.conjugate()).imag
                for line, pin, direction in zip(lines, origins, along, strict=True)
            ]
            k = int(moved == mechanism.frame)
            alike = 1.0 if np.cos(turns[0] - turns[1]) > 0 else -1.0
            offset = own[k] - alike * own[1 - k]
            arm = 1j * along[1] * (offset if k else -alike * offset)
            offsets.append(
                SlideOffset(joint=number, link=ends[k], pin=pins[ends[k]], offset=offset, moved=moved, arm=arm)
            )
    return tuple(offsets)


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class Sensitivity:
    """How far each target moves when each length grows by 0.1 %, to first order."""

    lengths: tuple[LinkLength, ...]
    moves: Complexes
    """(targets, probes, lengths), in the units of the probes: a place as x + iy, a direction by its length."""
    plays: Complexes
    """(targets, probes, joints, 2) for a pin that lies one unit of length beside its hole along x or y of a link; a
    slide lies beside its guide only, its second entry is 0."""

    def of_errors(self, error: float = LENGTH_ERROR, clearance: float = 0.0) -> Reals:
        """(targets, probes) a bound of how far at most, with lengths wrong by a part and joints that have play.

        Args:
            error: by which part of itself every length may be wrong.
            clearance: how far a pin may lie beside the middle of its hole, a slide beside its guide: half the play.

        To first order: the worst case of the lengths and, of every joint, the worst direction are added.
        """
        parts = np.stack([self.plays.real, self.plays.imag], axis=-1)
        along = np.linalg.svd(parts, compute_uv=False)[..., 0].sum(axis=2) if parts.size else 0.0
        return np.asarray(self.worst * (error / LENGTH_ERROR) + clearance * along)

    def sampled(
        self, error: float = LENGTH_ERROR, clearance: float = 0.0, *, samples: int = 10_000, seed: int = 0
    ) -> Reals:
        """(samples, targets, probes) how far, in random linkages: a Monte Carlo study to first order.

        Every length is wrong by up to a part of itself, evenly distributed; every pin lies on the rim of its play, as a
        loaded one does, in one direction of its link for all targets: the same pose is always missed alike.

        Args:
            error: by which part of itself every length may be wrong.
            clearance: as of `of_errors`.
            samples: how many linkages.
            seed: of the random numbers.
        """
        rng = np.random.default_rng(seed)
        wrong = rng.uniform(-error / LENGTH_ERROR, error / LENGTH_ERROR, (samples, len(self.lengths)))
        moved = np.einsum("tpl,sl->stp", self.moves, wrong)
        turns = rng.uniform(0, 2 * np.pi, (samples, self.plays.shape[2]))
        for k, share in enumerate((np.cos(turns), np.sin(turns))):
            moved = moved + clearance * np.einsum("tpj,sj->stp", self.plays[..., k], share)
        return np.asarray(np.abs(moved))

    @property
    def worst(self) -> Reals:
        """(targets, probes) how far at most if every length is wrong by up to 0.1 %."""
        return farthest_sum(self.moves)

    @property
    def statistical(self) -> Reals:
        """(targets, probes) the root of the sum of squares: independent errors of 0.1 % as standard deviations."""
        return np.asarray(np.sqrt(np.sum(np.abs(self.moves) ** 2, axis=2)))


def farthest_sum(moves: Complexes) -> Reals:
    """How far the sum of moves of the last axis leads at most, each taken forwards or backwards.

    The farthest is a corner of a polygon whose sides are the moves, each taken twice, in the order of their directions.
    Parallel moves may come in either order: the corner between them is then a place on a side.

    >>> float(farthest_sum(np.array([3, 4j, -1])))
    5.65...
    """
    upward = np.where(moves.imag < 0, -moves, moves)
    with np.errstate(divide="ignore", invalid="ignore"):  # a move of 0 is a side of no length: anywhere
        order = np.argsort(-upward.real / np.abs(upward.imag), axis=-1)
    sides = 2 * np.take_along_axis(upward, order, axis=-1)
    corners = upward.sum(axis=-1, keepdims=True) - np.cumsum(sides, axis=-1)
    return np.asarray(np.abs(corners).max(axis=-1, initial=0.0))


def length_sensitivity(linkage: Linkage, probes: tuple[Probe, ...], drives: Reals) -> Sensitivity:
    """How far quantities of a linkage move when its lengths change and its drives keep their values.

    Args:
        linkage: with a reference pose, from which `move` leads through all drive values.
        probes: the quantities.
        drives: (targets, drives) the values of the drives in radians, or in the unit of length.

    Raises `SynthesisError` where the drives do not lead through the targets, or do not fix the pose.

    Cost: a motion, and some 20 us a target.

    With its crank, 3 long, at a right angle the pin of a centric slider-crank with a coupler of 5 is 4 away from the
    frame pivot: 0.1 % more of the coupler moves it by 0.001 * 5 * 5 / 4.

    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> found = length_sensitivity(SliderCrank(3, 5).linkage(), (Probe(joint=3),), np.array([[np.pi / 2]]))
    >>> [(row.link, round(float(abs(move)), 5)) for row, move in zip(found.lengths, found.moves[0, 0], strict=True)]
    [('crank', 0.00225), ('coupler', 0.00625)]
    """
    closure = DesignClosure(linkage)
    count, freedoms = drives.shape
    if closure.unknowns - closure.equations != freedoms:
        raise SynthesisError("the drives do not fix the pose of this linkage")
    q = reached_poses(closure, drives)
    lengths, changes, shifts = changed_lengths(closure, probes)
    play = joint_plays(closure)
    points: dict[str, Complexes] = {
        name: np.concatenate([shift, np.zeros(play.shape[1], np.complex128)]) for name, shift in shifts.items()
    }
    changes = np.concatenate([changes, play], axis=1)
    by_pose, direct = _of_probes(closure, q, probes, changes, points)
    held, held_direct = drive_rates(closure, q, changes)
    pose = closure.derivatives(q, closure.sizes, size=linkage.size)
    parts = np.concatenate([by_pose.real, by_pose.imag, held], axis=1)
    # The joints stay closed, and then the drives are brought back to their values along the freedoms.
    still, along = pose.gradient(parts) @ changes, parts @ pose.motion
    n = len(probes)
    rates = still[:, :n] + 1j * still[:, n : 2 * n] + direct
    back = np.linalg.solve(along[:, 2 * n :], still[:, 2 * n :] + held_direct)
    moves = rates - (along[:, :n] + 1j * along[:, n : 2 * n]) @ back
    known = len(lengths)
    plays = moves[:, :, known:].reshape(count, n, -1, 2)
    return Sensitivity(lengths=lengths, moves=LENGTH_ERROR * moves[:, :, :known], plays=plays)


def reached_poses(closure: DesignClosure, drives: Reals) -> Reals:
    """(targets, unknowns) the poses to which `move` leads through the values of the drives.

    Raises `SynthesisError` where it does not.
    """
    try:
        motion = move_quietly(closure.linkage, _between(drives))
    except LinkageError as error:
        raise SynthesisError("it cannot be followed through the targets: {error}", error=error) from None
    if not motion.complete:
        raise SynthesisError("`move` does not lead through all targets")
    poses = [motion.pose(k * _ROWS) for k in range(len(drives))]
    return np.array([[value for link in closure.links for value in pose[link]] for pose in poses], np.float64)


def joint_plays(closure: DesignClosure) -> Reals:
    """(dimensions, 2 joints) a pin moved by one along x and y of its first link; a slide across itself."""
    joints = closure.linkage.mechanism.chain.joints
    changes = np.zeros((len(closure.sizes), 2 * len(joints)))
    for k, joint in enumerate(joints):
        at = closure.start[k, joint.links[0]]
        if joint.pair.is_sliding:
            direction = closure.sizes[at + 2]
            changes[at : at + 2, 2 * k] = -np.sin(direction), np.cos(direction)
        else:
            changes[at, 2 * k] = changes[at + 1, 2 * k + 1] = 1
    return changes


def _between(drives: Reals) -> Reals:
    """Drive values with steps between those of the targets."""
    at = np.linspace(0, len(drives) - 1, _ROWS * (len(drives) - 1) + 1)
    return np.stack([np.interp(at, np.arange(len(drives)), column) for column in drives.T], axis=1)


def changed_lengths(
    closure: DesignClosure, probes: tuple[Probe, ...]
) -> tuple[tuple[LinkLength, ...], Reals, dict[str, Complexes]]:
    """The lengths; (dimensions, lengths) and for each point (lengths,) their changes, when each grows by itself."""
    linkage = closure.linkage
    least = _NONE * linkage.size
    rows: list[LinkLength] = []
    columns: list[tuple[int | str, complex]] = []
    points = {probe.point for probe in probes if probe.point}
    for link in linkage.mechanism.chain.links:
        own = [(key[0], linkage.elements[key]) for key in closure.keys if key[1] == link]
        pins = [(number, complex(each.x, each.y)) for number, each in own if each.is_pin]
        if not pins:
            continue
        first, origin = pins[0]
        ends: list[tuple[int | str, str, complex, bool]] = [
            (closure.start[number, link], str(number), z - origin, k > 0) for k, (number, z) in enumerate(pins[1:])
        ]
        for name in sorted(points):
            point = linkage.points[name]
            if point.link == link:
                ends.append((name, name, complex(point.x, point.y) - origin, True))
        for at, other, arm, both in ends:
            for across in (False, True)[: 1 + both] if abs(arm) > least else ():
                rows.append(LinkLength(link=link, first=str(first), other=other, across=across, length=float(abs(arm))))
                columns.append((at, complex(1j * arm if across else arm)))
    for slide in slide_offsets(linkage):
        if abs(slide.offset) > least:
            pin, slot, length = str(slide.pin), str(slide.joint), abs(slide.offset)
            rows.append(LinkLength(link=slide.link, first=pin, other=slot, across=False, length=length))
            columns.append((closure.start[slide.joint, slide.moved], slide.arm))
    changes = np.zeros((len(closure.sizes), len(rows)))
    shifts = {name: np.zeros(len(rows), np.complex128) for name in points}
    for k, (at, arm) in enumerate(columns):
        if isinstance(at, str):
            shifts[at][k] = arm
        else:
            changes[at, k], changes[at + 1, k] = arm.real, arm.imag
    return tuple(rows), changes, shifts


def _of_probes(
    closure: DesignClosure, q: Reals, probes: tuple[Probe, ...], changes: Reals, shifts: dict[str, Complexes]
) -> tuple[Complexes, Complexes]:
    """(targets, probes, unknowns) derivatives by the pose, and (targets, probes, lengths) with the pose at rest."""
    by_pose = np.zeros((len(q), len(probes), closure.unknowns), np.complex128)
    direct = np.zeros((len(q), len(probes), changes.shape[1]), np.complex128)
    for k, probe in enumerate(probes):
        if probe.point:
            point = closure.linkage.points[probe.point]
            turn = _point_by_pose(closure, q, point.link, complex(point.x, point.y), by_pose[:, k])
            direct[:, k] = turn[:, None] * shifts[probe.point]
        elif probe.joint >= 0:
            by_pose[:, k], direct[:, k] = travel_rates(closure, q, probe.joint, changes)
        elif probe.link in closure.column:
            c = closure.column[probe.link] + 2
            by_pose[:, k, c] = 1j * probe.length * np.exp(1j * q[:, c])
    return by_pose, direct


def drive_rates(closure: DesignClosure, q: Reals, changes: Reals) -> tuple[Reals, Reals]:
    """The same of the values of the drives."""
    mechanism = closure.linkage.mechanism
    by_pose = np.zeros((len(q), len(mechanism.drives), closure.unknowns))
    direct = np.zeros((len(q), len(mechanism.drives), changes.shape[1]))
    for k, drive in enumerate(mechanism.drives):
        if not drive.turning:
            by_pose[:, k], direct[:, k] = travel_rates(closure, q, drive.joint, changes)
            continue
        for link, sign in zip(closure.linkage.reference(k), (-1.0, 1.0), strict=True):
            if link in closure.column:
                by_pose[:, k, closure.column[link] + 2] += sign
    return by_pose, direct


def travel_rates(closure: DesignClosure, q: Reals, joint: int, changes: Reals) -> tuple[Reals, Reals]:
    """Of the travel of a slide on closed poses, where the gap lies along it: its turn changes nothing."""
    first, other = closure.linkage.mechanism.chain.joints[joint].links
    at = closure.start[joint, first]
    turned = q[:, closure.column[first] + 2] if first in closure.column else np.zeros(len(q))
    along = np.exp(-1j * (turned + closure.sizes[at + 2]))[:, None]
    by_pose = np.zeros((len(q), closure.unknowns), np.complex128)
    direct = np.zeros((len(q), changes.shape[1]), np.complex128)
    for link, sign in ((first, -1.0), (other, 1.0)):
        at = closure.start[joint, link]
        own = np.zeros_like(by_pose)
        turn = _point_by_pose(closure, q, link, complex(*closure.sizes[at : at + 2]), own)
        by_pose += sign * own
        direct += sign * turn[:, None] * (changes[at] + 1j * changes[at + 1])
    return np.real(along * by_pose), np.real(along * direct)


def _point_by_pose(closure: DesignClosure, q: Reals, link: str, point: complex, slopes: Complexes) -> Complexes:
    """Fill in how a point of a link moves with the pose; (targets,) the direction of the link."""
    if link not in closure.column:
        return np.ones(len(q), np.complex128)
    c = closure.column[link]
    turn = np.exp(1j * q[:, c + 2])
    slopes[:, c], slopes[:, c + 1], slopes[:, c + 2] = 1, 1j, 1j * turn * point
    return np.asarray(turn)
