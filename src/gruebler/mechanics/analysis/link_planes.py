"""Which links lie in which plane, so that no plates and pins collide over the whole motion.

docs/theory/link-planes.md has the rules and the proof that as many planes as links are enough if any number is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from math import inf

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.convex_hull import convex_hull
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import explained
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.analysis.plates import Plates, plates_of, whole_motion
from gruebler.mechanics.linkages.conversion import LinkageLike

_HOLES = 30  # the size of the linkage over the diameter of a hole
_ARC = 1.05  # an arc between two poses over its chord; poses are half a degree apart
_MOST_STEPS = 50_000  # planes of a link that are tried


@dataclass(frozen=True, kw_only=True)
class Collisions:
    """What cannot be in one plane: plates that meet, and pins that plates run into."""

    links: tuple[str, ...]
    pegs: tuple[tuple[str, ...], ...]
    """The links that each pin goes through."""
    plates: frozenset[frozenset[str]]
    """Pairs of links whose plates meet in some pose if they lie in one plane."""
    hits: frozenset[tuple[int, str]]
    """Pins, by their numbers, and links whose plates would hit them."""
    touching: frozenset[frozenset[int]] = field(default=frozenset())
    """Pairs of pins that would hit each other."""

    def among(self, links: Sequence[str]) -> Collisions:
        """The same without the other links; pins through fewer than two of these links join nothing."""
        kept = {k for k, through in enumerate(self.pegs) if len(set(through) & set(links)) > 1}
        return Collisions(
            links=tuple(links),
            pegs=tuple(tuple(link for link in through if link in links) for through in self.pegs),
            plates=frozenset(pair for pair in self.plates if pair <= set(links)),
            hits=frozenset((k, link) for k, link in self.hits if k in kept and link in links),
            touching=frozenset(pair for pair in self.touching if pair <= kept),
        )

    def length(self, planes: Mapping[str, int]) -> int:
        """From how many planes to the next all pins reach, taken together."""
        return sum(int(high - low) for low, high in (_span(through, planes) for through in self.pegs) if low < inf)

    def allow(self, planes: Mapping[str, int]) -> bool:
        """Whether nothing collides if these links lie in these planes; other links are not looked at.

        1. Links whose plates meet lie in different planes.
        2. No plate that a pin would run into lies strictly between the outermost links of the pin.
        3. Pins that would hit each other have no plane in common that lies strictly inside both.
        """
        if any(
            first in planes and second in planes and planes[first] == planes[second]
            for first, second in map(tuple, self.plates)
        ):
            return False
        spans = [_span(through, planes) for through in self.pegs]
        if any(low < planes[link] < high for k, link in self.hits if link in planes for low, high in [spans[k]]):
            return False
        for first, second in map(tuple, self.touching):
            if max(spans[first][0], spans[second][0]) + 1 <= min(spans[first][1], spans[second][1]) - 1:
                return False
        return True


@explained
@dataclass(frozen=True, kw_only=True)
class LinkPlanes:
    """The planes of the links of a linkage, or why there are none."""

    planes: dict[str, int] | None
    """The plane of each link, 1 the lowest; None if there is no assignment, or none was found."""
    least: bool
    """Whether it is certain that fewer planes, or as many with shorter pins, are impossible; or that all are."""
    stuck: tuple[str, ...]
    """Without an assignment: the fewest links, none of which can be left out, that have none."""
    collisions: Collisions
    hole: float
    """The diameter of pins and holes."""
    margin: float
    """From the middle of a hole to the edge of the plate."""

    @property
    def count(self) -> int:
        """How many planes there are; 0 without an assignment."""
        return max(self.planes.values(), default=0) if self.planes else 0

    def explain(self, lang: str = "en") -> str:
        """The planes from below, or why there are none."""
        return self.message.in_language(lang)

    @property
    def message(self) -> Message:
        """What `explain` says, in any language."""
        if self.planes is None:
            return self._refusal
        rows = []
        for plane in range(1, self.count + 1):
            links = ", ".join(link for link, its in self.planes.items() if its == plane)
            rows.append(message("{plane}: {links}", plane=plane, links=links))
        return message("Planes of the links, from below: {planes}.", planes=joined(rows, "; "))

    @property
    def _refusal(self) -> Message:
        if not self.least:
            return message("No planes of the links were found in which nothing collides; some may exist.")
        few = self.collisions.among(self.stuck)
        hits = dict.fromkeys(sorted(("-".join(self.collisions.pegs[k]), link) for k, link in few.hits))
        sentences = [
            message(
                "The links cannot lie in planes so that nothing collides: {links} are in each other's way.",
                links=", ".join(self.stuck),
            ),
            *(message("{link} runs into the pin {pin}.", link=link, pin=pin) for pin, link in hits),
        ]
        return joined(sentences, " ")


def link_planes(
    linkage: LinkageLike,
    *,
    between: tuple[float, float] | None = None,
    hole: float | None = None,
    margin: float | None = None,
) -> LinkPlanes:
    """The fewest planes for the links in which nothing ever collides; of several such, those with the shortest pins.

    Each link is a plate around its joints and named points; a pin reaches from the lowest to the highest of its links.
    Plates that come nearer than half a step between two of 721 poses are taken to meet.

    Args:
        linkage: of turning and sliding joints, with one drive.
        between: two drive values of a smaller range, radians or lengths.
        hole: diameter of pins and holes, in the linkage's unit; a thirtieth of its size if not given.
        margin: from the middle of a hole to the edge of the plate; the diameter of a hole if not given.

    Cost: 0.1 s for eight links. Raises `LinkageError` for wheels and cams, several drives, and a margin too small.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> print(link_planes(FourBar(25, 70, 40, 70).linkage()).explain())
    Planes of the links, from below: 1: frame; 2: crank, rocker; 3: coupler.
    """
    plates = plates_of(whole_motion(linkage, between))
    hole, margin = plate_sizes(plates.linkage.size, hole, margin)
    collisions = collisions_of(plates, hole, margin)
    planes, least = search_planes(collisions)
    stuck: tuple[str, ...] = ()
    if planes is None and least:
        stuck = collisions.links
        for link in collisions.links:
            fewer = tuple(other for other in stuck if other != link)
            if search_planes(collisions.among(fewer)) == (None, True):
                stuck = fewer
    elif planes is not None and planes[plates.linkage.mechanism.frame] > (max(planes.values()) + 1) / 2:
        planes = {link: max(planes.values()) + 1 - plane for link, plane in planes.items()}
    return LinkPlanes(planes=planes, least=least, stuck=stuck, collisions=collisions, hole=hole, margin=margin)


def plate_sizes(size: float, hole: float | None, margin: float | None) -> tuple[float, float]:
    """Diameter of the holes and margin around them, chosen by the size of the linkage where they are not given.

    Raises `LinkageError` for a margin that is not larger than the radius of the holes.
    """
    hole = size / _HOLES if hole is None else hole
    margin = hole if margin is None else margin
    if not 0 < hole / 2 < margin < inf:
        raise LinkageError(
            "a hole of {hole:g} needs a margin of more than its radius, not {margin:g}", hole=hole, margin=margin
        )
    return hole, margin


def collisions_of(plates: Plates, hole: float, margin: float) -> Collisions:
    """What collides if it lies in one plane, over the whole motion.

    Args:
        plates: of a linkage.
        hole: diameter of the pins.
        margin: from the middle of a hole to the edge of a plate.
    """
    links = tuple(plates.plates)
    areas = {
        link: np.stack([plates.track(link, place) for place in convex_hull(plate.places)], axis=1)
        for link, plate in plates.plates.items()
    }
    pins = [plates.track(peg.carrier, peg.place)[:, None] for peg in plates.pegs]
    pairs = list(combinations(range(len(pins)), 2))
    return Collisions(
        links=links,
        pegs=tuple(peg.links for peg in plates.pegs),
        plates=frozenset(
            frozenset((first, second))
            for first, second in combinations(links, 2)
            if _meet(areas[first], areas[second], 2 * margin)
        ),
        hits=frozenset(
            (k, link)
            for k, peg in enumerate(plates.pegs)
            for link in links
            if link not in peg.links and _meet(pins[k], areas[link], margin + hole / 2)
        ),
        touching=frozenset(
            frozenset((k, m))
            for k, m in pairs
            if not set(plates.pegs[k].links) & set(plates.pegs[m].links) and _meet(pins[k], pins[m], hole)
        ),
    )


def _meet(first: Complexes, second: Complexes, clearance: float) -> bool:
    """Whether the hulls of moving places, (rows, places) each, come nearer than a clearance.

    The distance of two hulls is that of 0 from the hull of all differences. From pose to pose it changes by no more
    than the largest way of a difference, which bounds it between them.
    """
    apart = (first[:, :, None] - second[:, None, :]).reshape(len(first), -1)
    gaps = gaps_to_hull(apart)
    ways = np.abs(np.diff(apart, axis=0)).max(axis=1) * _ARC
    nearest = min(gaps.min(), ((gaps[1:] + gaps[:-1] - ways) / 2).min())
    return bool(nearest < clearance * (1 - 1e-9))  # plates that just touch do not meet, whatever the last digit says


def gaps_to_hull(places: Complexes) -> Reals:
    """The distance of 0 from the convex hull of places, (rows, places), in each row; 0 inside. Cost: places² per row.

    >>> gaps_to_hull(np.array([[1 + 1j, 1 - 1j], [1 + 1j, -2 + 0j]])).round(6).tolist()
    [1.0, 0.632456]
    >>> gaps_to_hull(np.array([[1, 1j, -1 - 1j]])).tolist()
    [0.0]
    """
    gaps: Reals = np.abs(places).min(axis=1)
    if places.shape[1] > 2:
        angles = np.sort(np.angle(places), axis=1)
        steps = np.diff(angles, axis=1, append=angles[:, :1] + 2 * np.pi)
        gaps[steps.max(axis=1) < np.pi] = 0.0
    for k in range(places.shape[1] - 1):
        start, side = places[:, k, None], places[:, k + 1 :] - places[:, k, None]
        long = np.maximum(np.abs(side) ** 2, np.finfo(float).tiny)
        part = np.clip(-(start * side.conj()).real / long, 0.0, 1.0)
        np.minimum(gaps, np.abs(start + part * side).min(axis=1), out=gaps)
    return gaps


def search_planes(collisions: Collisions) -> tuple[dict[str, int] | None, bool]:
    """Planes from 1 that `Collisions.allow` allows, or None; and whether the answer is certain.

    They are as few as possible, then with the shortest pins. The search goes through all assignments but those that
    cannot lead to a better one; it ends after 50,000 trials of a link in a plane, then the answer is not certain.
    """
    meets = {link: sum(link in pair for pair in collisions.plates) for link in collisions.links}
    links = sorted(collisions.links, key=lambda link: -meets[link])
    steps, shortest = _MOST_STEPS, inf
    best: dict[str, int] | None = None
    planes: dict[str, int] = {}

    def place(number: int, count: int) -> None:
        """Give the links from this number on a plane each; all others have theirs."""
        nonlocal steps, shortest, best
        if number == len(links):
            best, shortest = dict(planes), collisions.length(planes)
            return
        upto = (count + 1) // 2 if number == 0 else count  # the others are the same turned over
        for plane in range(1, upto + 1):
            steps -= 1
            if steps < 0:
                return
            planes[links[number]] = plane
            if collisions.allow(planes) and collisions.length(planes) < shortest:
                place(number + 1, count)
            del planes[links[number]]

    for count in range(1, len(links) + 1):
        place(0, count)
        if best is not None or steps < 0:
            return best and {link: best[link] for link in collisions.links}, steps >= 0
    return None, True


def _span(through: tuple[str, ...], planes: Mapping[str, int]) -> tuple[float, float]:
    """The lowest and the highest plane of the links of a pin; without two of them no plane."""
    there = [planes[link] for link in through if link in planes]
    return (min(there), max(there)) if len(there) > 1 else (inf, -inf)
