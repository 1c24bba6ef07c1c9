"""The layout of a mechanism: its joints to be drawn, and a drawing as input of the kernel.

A drawing is an array (joints, 3): x, y and angle of each joint in one position (the angle counts for slides only).
Every link has the coordinates of the plane in that position, so that all drives, places and angles are 0 there.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import joined
from gruebler.mechanics.kinematics.kernel_records import RPR, RRP, RRR
from gruebler.mechanics.kinematics.plan import Plan, plan
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import PAIRS
from gruebler.structure.chain.spaces import Freedom, Space
from gruebler.structure.mechanism import Mechanism

if TYPE_CHECKING:
    from gruebler.mechanics.kinematics.kernel_records import Program

_DRAWN = [p for p in PAIRS if Space.PLANAR in p.freedoms and p.lower_pairs]


class KernelLayout(NamedTuple):
    """A drawing as the kernel takes it."""

    program: Program
    signs: Reals
    """Of the dyads, in the drawn position."""
    unknowns: Reals
    """Of the larger groups there: all 0."""


@dataclass(frozen=True, kw_only=True)
class LayoutProgram:
    """The joints of a mechanism, to be drawn."""

    mechanism: Mechanism
    slots: tuple[tuple[int, str], ...]
    """Which link has the slot of each pin in a slot."""
    plan: Plan
    """The order of solving; its dimensions are ignored."""
    joints: NDArray[np.int64]
    """The drawn joint of each element of the plan."""
    askew: Complexes
    """The direction of each element's line relative to its drawn joint: 1, or i for the second direction of a double
    slide."""

    @cached_property
    def pins(self) -> tuple[tuple[int, ...], ...]:
        """For each link the joints that are points of it."""
        slots = dict(self.slots)
        return tuple(
            tuple(
                k
                for k, joint in enumerate(self.mechanism.chain.joints)
                if link in joint.links and (joint.pair.is_turning or slots.get(k, link) != link)
            )
            for link in self.mechanism.chain.links
        )

    @cached_property
    def slides(self) -> tuple[int, ...]:
        """The joints that have a direction."""
        return tuple(k for k, j in enumerate(self.mechanism.chain.joints) if not j.pair.is_turning)

    @cached_property
    def blocks(self) -> dict[int, tuple[int, ...]]:
        """For each slide the pins (one or two) that its line goes through: those of links with one pin besides it."""
        chain, blocks = self.mechanism.chain, {}
        for k in self.slides:
            if not chain.joints[k].pair.is_sliding:
                continue
            pins = []
            for link in chain.joints[k].links:
                others = [m for m, joint in enumerate(chain.joints) if link in joint.links and m != k]
                if link != self.mechanism.frame and len(others) == 1 and others[0] not in self.slides:
                    pins += others
            if pins:
                blocks[k] = tuple(pins)
        return blocks

    @cached_property
    def pairs(self) -> NDArray[np.int64]:
        """The two joints of each length: pins of one link; (pairs, 2)."""
        pairs = {pair for link_pins in self.pins for pair in combinations(link_pins, 2)}
        return np.array(sorted(pairs), np.int64).reshape(-1, 2)

    @cached_property
    def spans(self) -> NDArray[np.int64]:
        """The pairs of all joints of one link, slides included; (pairs, 2)."""
        links, joints = self.mechanism.chain.links, self.mechanism.chain.joints
        pairs = {pair for a in links for pair in combinations([k for k, j in enumerate(joints) if a in j.links], 2)}
        return np.array(sorted(pairs), np.int64).reshape(-1, 2)

    @cached_property
    def apart(self) -> NDArray[np.bool_]:
        """Pairs of joints that are to be drawn apart: all but slides and the pins of their blocks; (joints, joints)."""
        count = len(self.mechanism.chain.joints)
        separate: NDArray[np.bool_] = np.triu(np.ones((count, count), bool), 1)
        for slide in self.slides:
            separate[slide, :] = separate[:, slide] = False
        return separate

    @cached_property
    def crossings(self) -> NDArray[np.int64]:
        """Pairs of lengths of different moving links without a common joint: (pairs, 4)."""
        links = self.mechanism.chain.links
        rods = [
            (link, pair)
            for link, link_pins in zip(links, self.pins, strict=True)
            if link != self.mechanism.frame
            for pair in combinations(link_pins, 2)
        ]
        crossings = [
            (*rod, *other_rod)
            for (a, rod), (b, other_rod) in combinations(rods, 2)
            if a != b and not set(rod) & set(other_rod)
        ]
        return np.array(crossings, np.int64).reshape(-1, 4)

    def tied(self, drawing: Reals) -> Reals:
        """The drawing with the lines of slides through the pins of their blocks."""
        tied = drawing.copy()
        for slide, pins in self.blocks.items():
            tied[slide, :2] = tied[pins[0], :2]
            if len(pins) == 2:
                x, y = tied[pins[1], :2] - tied[pins[0], :2]
                tied[slide, 2] = np.arctan2(y, x)
        return tied

    def size(self, drawing: Reals) -> float:
        """The largest distance of joints on one link, as `Linkage.size`."""
        gaps = drawing[self.spans[:, 0], :2] - drawing[self.spans[:, 1], :2]
        return float(np.hypot(gaps[:, 0], gaps[:, 1]).max(initial=0.0)) or 1.0

    def frame_width(self, drawing: Reals) -> float:
        """The largest distance of joints of the frame; infinite if it has one only."""
        chain, frame = self.mechanism.chain, self.mechanism.frame
        frame_joints = [k for k, joint in enumerate(chain.joints) if frame in joint.links]
        z = drawing[frame_joints, 0] + 1j * drawing[frame_joints, 1]
        return float(np.abs(z[:, None] - z).max()) if len(frame_joints) > 1 else np.inf

    def setting(self, drawing: Reals) -> KernelLayout:
        """The input of the kernel."""
        places = drawing[self.joints]
        points = places[:, 0] + 1j * places[:, 1]
        lines = np.exp(1j * places[:, 2]) * self.askew
        size, program = self.size(drawing), self.plan.program
        turning = [d.turning for d in self.mechanism.drives]
        most = np.where(turning, self.plan.longest_steps, self.plan.longest_steps * (size / self.plan.lower.size))
        kernel_program = program._replace(points=points, lines=lines, size=size, most=most)
        signs = np.ones(len(self.plan.dyads))
        for row in self.plan.operations:
            if row[0] in (RRR, RRP, RPR):
                signs[row[9]] = 1.0 if _side(row, points, lines) >= 0 else -1.0
        return KernelLayout(kernel_program, signs, np.zeros(3 * len(program.roots)))


def _side(row: tuple[int, ...], points: Complexes, lines: Complexes) -> float:
    """The number whose sign is the label of a dyad (`gruebler.mechanics.kinematics.branches`)."""
    kind, outer, inner, other = row[0], row[1], row[3], row[6]
    if kind == RRR:
        return float(((points[other] - points[outer]).conjugate() * (points[inner] - points[outer])).imag)
    if kind == RRP:
        return float((lines[other].conjugate() * (points[inner] - points[outer])).real)
    return float((lines[inner].conjugate() * (points[other] - points[outer])).real)


def layout_program(mechanism: Mechanism) -> LayoutProgram:
    """The layout program of a mechanism.

    Raises `LinkageError` for joints without dimensions and for drives that do not fix the motion.
    """
    chain = mechanism.chain
    check_drawable(chain)
    slots = tuple((k, _slotted(mechanism, k)) for k, j in enumerate(chain.joints) if j.pair.rolls_and_slides)
    solving_plan = plan(Linkage.from_drawing(mechanism, joint_places(mechanism, slots, _anywhere(len(chain.joints)))))
    split = []
    for number, joint in enumerate(chain.joints):
        split += [(number, 1j if freedom is Freedom.TRAVEL_Y else 1) for freedom in joint.pair.motion]
    return LayoutProgram(
        mechanism=mechanism,
        slots=slots,
        plan=solving_plan,
        joints=np.array([split[joint][0] for joint, _ in solving_plan.keys], np.int64),
        askew=np.array([split[joint][1] for joint, _ in solving_plan.keys], np.complex128),
    )


def check_drawable(chain: Chain) -> None:
    """Raise `LinkageError` for joints whose dimensions are not known."""
    if chain.space is not Space.PLANAR:
        raise LinkageError("dimensions are found for planar mechanisms; this one is {space}", space=chain.space)
    for name, joint in zip(chain.joint_names(), chain.joints, strict=True):
        if joint.pair not in _DRAWN:
            raise LinkageError(
                "{name}: dimensions of {pair} joints are not found yet; known are {drawn}",
                name=name,
                pair=joint.pair.title,
                drawn=joined(pair.title for pair in _DRAWN),
            )


def joint_places(
    mechanism: Mechanism, slots: tuple[tuple[int, str], ...], drawing: Reals
) -> dict[str | int, tuple[object, ...]]:
    """A drawing as `Linkage.from_drawing` takes it."""
    places: dict[str | int, tuple[object, ...]] = {}
    owner = dict(slots)
    for number, joint in enumerate(mechanism.chain.joints):
        x, y, angle = (float(v) for v in drawing[number])
        line = () if joint.pair.is_turning else (angle,)
        places[number] = (x, y, *line, *([owner[number]] if number in owner else []))
    return places


def _anywhere(joints: int) -> Reals:
    return np.random.default_rng(0).uniform(0.0, 1.0, (joints, 3))


def _slotted(mechanism: Mechanism, number: int) -> str:
    """The link with the slot: not a driven one, rather one with few joints; else the second."""
    driven = {link for drive in mechanism.drives for link in drive.between} - {mechanism.frame}
    first, second = mechanism.chain.joints[number].links
    return first if second in driven and first not in driven else second
