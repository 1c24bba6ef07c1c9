"""The links of a linkage as plates over its whole motion: where they have holes and slots, and which pins join them."""

from __future__ import annotations

from cmath import rect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

_ROWS = 721
_SPREAD = 15  # the size of the linkage over the distance of the two pins that keep a slide from turning


@dataclass(frozen=True, slots=True)
class Plate:
    """A link as a flat body, in its own coordinates."""

    places: tuple[complex, ...]
    """What the plate surrounds: holes, ends of slots, named points."""
    holes: tuple[complex, ...]
    """The middles of the holes for pins."""
    slots: tuple[tuple[complex, complex], ...]
    """The places of a pin in a slot at both ends of its way."""


@dataclass(frozen=True, slots=True)
class Peg:
    """A pin through links: of a turning joint, or one that slides in a slot."""

    links: tuple[str, ...]
    carrier: str
    """The link that it is fixed to."""
    place: complex
    """Where, in coordinates of that link."""


@dataclass(frozen=True, slots=True)
class Plates:
    """A linkage of plates and pins in a motion."""

    motion: Motion
    plates: dict[str, Plate]
    """By links; a block that only slides and turns is a pin, not a plate."""
    pegs: tuple[Peg, ...]

    @property
    def linkage(self) -> Linkage:
        """The linkage, with turning and sliding joints only."""
        return self.motion.lower_linkage

    def track(self, link: str, place: complex) -> Complexes:
        """Where a place of a link lies; (rows,)."""
        k = self.motion.link_index(link)
        return np.asarray(self.motion.places[0, :, k] + self.motion.turns[:, k] * place)


def whole_motion(linkage: LinkageLike, between: tuple[float, float] | None = None) -> Motion:
    """The motion of a linkage with one drive through its whole range, in 721 poses a turn.

    Over whole turns the last pose is the first one again; towards the ends of a range the poses are dense, since links
    may move fast there.

    Args:
        linkage: with one drive.
        between: two drive values of a smaller range.

    Raises `LinkageError` for another number of drives, and if nothing can move.
    """
    cycle = drive_cycle(as_linkage(linkage))
    low, high = between or (cycle.span.low, cycle.span.high)
    if cycle.span.full and between is None:
        return cycle.at(np.linspace(low, high, (_ROWS - 1) * cycle.span.turns + 1), 0)
    return cycle.at(low + (high - low) * np.sin(np.linspace(0, np.pi / 2, _ROWS)) ** 2, 0)


def plates_of(motion: Motion) -> Plates:
    """The plates and pins of a linkage; slots are as long as the motion needs them.

    Raises `LinkageError` for wheels and cams.

    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> found = plates_of(whole_motion(SliderCrank(20, 50)))
    >>> list(found.plates), [peg.links for peg in found.pegs][-1]
    (['frame', 'crank', 'coupler'], ('frame', 'coupler'))
    >>> [round(abs(b - a), 6) for a, b in found.plates["frame"].slots]
    [40.0]
    """
    lower = motion.lower_linkage
    chain = lower.mechanism.chain
    for joint in chain.joints:
        if not joint.pair.is_basic:
            raise LinkageError("plates turn or slide against each other; {joint} cannot join them", joint=joint)
    blocks = _blocks(lower, motion.linkage.mechanism.chain.links)
    links = [link for link in chain.links if link not in blocks]
    pegs: list[Peg] = []
    holes: dict[str, list[complex]] = {link: [] for link in links}
    slots: dict[str, list[tuple[complex, complex]]] = {link: [] for link in links}

    def add(places: Mapping[str, complex], slide: int | None = None) -> None:
        """A pin through places of links, and if there is a slide through the slot of its base."""
        carrier = next(iter(places))
        for link, place in places.items():
            holes[link].append(place)
        base = []
        if slide is not None:
            base = [_base(lower, slide, blocks)]
            slots[base[0]].append(_slot(lower, motion, slide, base[0], (carrier, places[carrier])))
        pegs.append(Peg((*base, *places), carrier, places[carrier]))

    for number, joint in enumerate(chain.joints):
        elements = {link: lower.elements[number, link] for link in joint.links if link not in blocks}
        if joint.pair.is_turning:
            slide = next((blocks[link] for link in joint.links if link in blocks), None)
            add({link: complex(pin.x, pin.y) for link, pin in elements.items()}, slide)
        elif number not in blocks.values():
            other = next(link for link in joint.links if link != _base(lower, number, blocks))
            line = elements[other]
            along = rect(lower.size / _SPREAD, line.direction)
            for at in (complex(line.x, line.y), complex(line.x, line.y) + along):
                add({other: at}, number)
    plates = {}
    for link in links:
        points = [complex(point.x, point.y) for point in lower.points.values() if point.link == link]
        ends = [end for slot in slots[link] for end in slot]
        places = dict.fromkeys([*holes[link], *ends, *points])
        plates[link] = Plate(tuple(places), tuple(dict.fromkeys(holes[link])), tuple(slots[link]))
    return Plates(motion, plates, tuple(pegs))


def _blocks(lower: Linkage, named: Sequence[str]) -> dict[str, int]:
    """The slides of links that only slide and turn about one pin, as a pin in a slot does; one for each slide.

    Such a link does not turn against the other link of its slide, so the pin runs on a straight line there. Of two such
    links on one slide that is the block which is no link of the linkage itself.
    """
    mechanism = lower.mechanism
    blocks: dict[str, int] = {}
    busy = {mechanism.frame, *(point.link for point in lower.points.values())}
    busy |= {link for drive in mechanism.drives if drive.turning for link in drive.between}
    joints = mechanism.chain.joints
    for link in sorted(mechanism.chain.links, key=lambda link: link in named):
        numbers = [number for number, joint in enumerate(joints) if link in joint.links]
        slides = [number for number in numbers if joints[number].pair.is_sliding]
        if len(numbers) != 2 or len(slides) != 1 or link in busy or slides[0] in blocks.values():
            continue
        blocks[link] = slides[0]
    return blocks


def _base(lower: Linkage, slide: int, blocks: Mapping[str, int]) -> str:
    """The link with the slot: not a block, then the frame, then the one that the joint names first."""
    links, frame = lower.mechanism.chain.joints[slide].links, lower.mechanism.frame
    return min((link for link in links if link not in blocks or blocks[link] != slide), key=lambda link: link != frame)


def _slot(lower: Linkage, motion: Motion, slide: int, base: str, pin: tuple[str, complex]) -> tuple[complex, complex]:
    """The ends of the way of a pin, a place of a link, in the slot of a slide, in coordinates of its base."""
    k, m = motion.link_index(base), motion.link_index(pin[0])
    track = motion.places[0, :, m] + motion.turns[:, m] * pin[1]
    seen = np.conj(motion.turns[:, k]) * (track - motion.places[0, :, k])
    along = rect(1, lower.elements[slide, base].direction)
    ways = (seen * along.conjugate()).real
    first = complex(seen[0]) - ways[0] * along
    return complex(first + ways.min() * along), complex(first + ways.max() * along)
