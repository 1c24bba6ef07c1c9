"""Which links of a linkage turn fully, and what its links are called for the way they really move."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from math import degrees, pi

import numpy as np

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import explained
from gruebler.base.text import message
from gruebler.mechanics.analysis.measure_units import drive_units
from gruebler.mechanics.kinematics.circuits import Circuit, Quantity, circuit
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike
from gruebler.mechanics.linkages.wheels import round_joints
from gruebler.structure.chain.spaces import Freedom, Space
from gruebler.structure.mechanism.link_roles import Role

_FREEDOMS = {Freedom.TURN_Z: "turn", Freedom.TRAVEL_X: "slide", Freedom.TRAVEL_Y: "across"}
"""What two links can do against each other in a joint."""

_FULL = message("{joint}: {second} turns fully against {first}.")
_TURNS = message("{joint}: {second} turns against {first} from {low:.4g}° to {high:.4g}°.")
_SLIDES = message("{joint}: {second} slides along {first} from {low:.4g} to {high:.4g}.")
_ROUND = 1e-9  # a relative angle whose range is 2 pi but for this turns fully
_STEADY = 1e-6  # radians: rounding turns a slide by some 1e-14, a motion by far more


@explained
@dataclass(frozen=True, slots=True, kw_only=True)
class Rotatability:
    """How two neighbouring links move against each other over the whole circuit."""

    joint: str
    links: tuple[str, str]
    freedom: str
    """``turn`` or ``slide``; ``across`` for the second direction of a double slide."""
    full: bool
    """Whether they turn fully against each other; False for slides."""
    turns: int
    """Whole turns of the second link against the first over a closed circuit."""
    lowest: float
    """The smallest relative angle (of the x axes, second against first), or the smallest way."""
    highest: float

    @property
    def range(self) -> float:
        """How far they turn or slide against each other."""
        return self.highest - self.lowest

    def explain(self, lang: str = "en") -> str:
        """One sentence in English or German (``de``)."""
        turning = self.freedom == "turn"
        low, high = (degrees(value) if turning else value for value in (self.lowest, self.highest))
        text = _FULL if self.full else _TURNS if turning else _SLIDES
        first, second = self.links
        return text.filled(joint=self.joint, first=first, second=second, low=low, high=high).in_language(lang)


@explained
@dataclass(frozen=True, slots=True)
class DriveRange:
    """How far a drive can be moved from the position in which the circuit starts."""

    full: bool
    """Whether it turns fully and never has to turn back."""
    lowest: float
    highest: float
    linkage: Linkage = field(repr=False)
    """The linkage that is driven."""

    def explain(self, lang: str = "en") -> str:
        """One sentence in English or German (``de``).

        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> print(drive_range(SliderCrank(50, 40)))
        The drive turns from -53.13° to 53.13°.
        """
        return drive_units(self.linkage).range(self.full, self.lowest, self.highest).in_language(lang)


@door_that_raises(LinkageError)
def rotatability(linkage: LinkageLike | Circuit, *, branch: Branch = None) -> tuple[Rotatability, ...]:
    """As `gruebler.rotatability` in the plane: each pair of neighbouring links, on one circuit."""
    traced = _circuit(linkage, branch)
    return tuple(_row(traced, *which) for which in _pairs(traced.linkage))


def _circuit(linkage: LinkageLike | Circuit, branch: Branch) -> Circuit:
    if not isinstance(linkage, Circuit):
        return circuit(linkage, branch=branch)
    if branch is not None:
        raise LinkageError("a circuit already has a branch")
    return linkage


def _pairs(linkage: Linkage) -> Iterator[tuple[int, tuple[str, str], str]]:
    """Joints, links and freedoms; wheels and circles that touch are no neighbours."""
    mechanism = linkage.mechanism
    wheels = round_joints(mechanism, linkage.elements)
    for number, joint in enumerate(mechanism.chain.joints):
        if number in wheels:
            continue
        for first, second in itertools.combinations(joint.links, 2):
            for freedom in joint.pair.freedoms[Space.PLANAR]:
                links = (second, first) if second == mechanism.frame else (first, second)
                yield number, links, _FREEDOMS[freedom]


@lru_cache(maxsize=32)
def _row(circuit: Circuit, joint: int, links: tuple[str, str], freedom: str) -> Rotatability:
    lowest, highest = circuit.range(
        _quantity(joint, links, freedom), natural=1.0 if freedom == "turn" else circuit.system.lower.size
    )
    turns, full = 0, False
    if freedom == "turn":
        ends = circuit.angle(links[1])[[0, -1]] - circuit.angle(links[0])[[0, -1]]
        turns = round(float(ends[1] - ends[0]) / (2 * pi)) if circuit.closed else 0
        full = turns != 0 or highest - lowest >= 2 * pi - _ROUND
    name = circuit.linkage.mechanism.chain.joint_names()[joint]
    return Rotatability(
        joint=name, links=links, freedom=freedom, full=full, turns=turns, lowest=lowest, highest=highest
    )


def _quantity(joint: int, links: tuple[str, str], freedom: str) -> Quantity:
    first, other = links
    if freedom == "turn":
        return lambda poses, order: poses.angle(other, order) - poses.angle(first, order)
    return lambda poses, order: poses.displacement(joint, order=order, across=freedom == "across")


@door_that_raises(LinkageError)
def motion_roles(linkage: LinkageLike | Circuit, *, branch: Branch = None) -> dict[str, Role]:
    """The role of each link from its real motion; `gruebler.structure.mechanism.roles` knows the structure only.

    At the frame a link with a turning joint is a crank if it turns fully, else a rocker; one with a slide is a slider;
    a link that is not joined to the frame is a coupler.

    Args:
        linkage: with one drive, or a `FourBar`, `SliderCrank`, `InvertedSliderCrank`, or its `Circuit`.
        branch: the assembly mode, as for `move`; not with a circuit.

    Returns:
        A dict from link to `Role`: frame, crank, rocker, slider or coupler.

    Raises:
        LinkageError: a linkage that cannot be assembled, several drives, a circuit together with a branch.

    Cost:
        That of the circuit, 10 to 200 ms.

    Example:
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> [role.in_language("de") for role in motion_roles(FourBar(40, 25, 40, 60).linkage()).values()]
        ['Gestell', 'Schwinge', 'Koppel', 'Schwinge']

    See Also:
        `rotatability`, `drive_range`, `measures`

    Theory:
        docs/theory/circuits.md
    """
    traced = _circuit(linkage, branch)
    mechanism = traced.linkage.mechanism
    roles = dict.fromkeys(mechanism.chain.links, Role.COUPLER)
    roles[mechanism.frame] = Role.FRAME
    for number, links, freedom in _pairs(traced.linkage):
        pair = mechanism.chain.joints[number].pair
        if mechanism.frame not in links or pair.rolls_and_slides:
            continue
        link = links[1]
        if not pair.is_turning:
            roles[link] = Role.SLIDER
        elif roles[link] is not Role.SLIDER:
            roles[link] = Role.CRANK if _row(traced, number, links, freedom).full else Role.ROCKER
    return roles


def slide_directions(linkage: LinkageLike | Circuit, *, branch: Branch = None) -> dict[str, bool]:
    """Each slide by its name: whether its direction turns against the frame (German: *Schleifengelenk*).

    >>> from gruebler.mechanics.fourbar import InvertedSliderCrank, SliderCrank
    >>> slide_directions(SliderCrank(20, 50).linkage()), slide_directions(InvertedSliderCrank(30, 50).linkage())
    ({'P(frame-slider)': False}, {'P(coupler-block)': True})
    """
    traced = _circuit(linkage, branch)
    chain = traced.linkage.mechanism.chain
    return {
        name: float(np.ptp(traced.angle(joint.links[0]))) > _STEADY
        for name, joint in zip(chain.joint_names(), chain.joints, strict=True)
        if joint.pair.is_sliding
    }


@door_that_raises(LinkageError)
def drive_range(linkage: LinkageLike | Circuit, *, branch: Branch = None) -> DriveRange:
    """As `gruebler.drive_range` in the plane."""
    traced = _circuit(linkage, branch)
    if not traced.drive_limits:
        low, high = sorted(traced.drive[[0, -1]].tolist())
        full = traced.closed and round((high - low) / (2 * pi)) != 0
        return DriveRange(full or high - low >= 2 * pi - _ROUND, low, high, traced.linkage)
    piece = next(s for s in traced.monotone_pieces if s.start <= traced.start <= s.end)
    return DriveRange(False, min(piece.drives), max(piece.drives), traced.linkage)
