"""The moment of all masses of a linkage as a sum of turning vectors of its links, and what binds these vectors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.forces.acting import ActingLoads
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.lower_pairs import with_lower_pairs

_RANK = 1e-9  # of the largest singular value: a relation that says nothing new


@dataclass(frozen=True, eq=False, kw_only=True)
class MassMoments:
    """Sum of m z = constant + sum of C_k t_k over the links that move, and relations sum of A_k t_k = constant."""

    lower: Linkage
    """The linkage with turning and sliding joints and wheels alone."""
    links: tuple[str, ...]
    """That move, in the order of all rows below."""
    total: Complexes
    """C; (links,)."""
    relations: Complexes
    """A, independent; (relations, links). None says anything of a link that no turning joints join to the frame."""
    paths: dict[str, Complexes]
    """By link that hangs on the frame by turning joints: its inner pin = constant + sum over links."""
    pins: dict[str, complex]
    """That inner pin on the link itself."""
    blocked: tuple[str, ...]
    """Links with mass that do not hang so."""
    regions: dict[str, str]
    """By link: one link of those that turning joints join to it."""
    given: int
    """How many links the linkage has; those behind them stand for pins in slots."""
    scale: float
    """Mass times length: what is large."""

    @cached_property
    def carriers(self) -> tuple[str, ...]:
        """As few links as can carry counterweights for whatever masses: the others' vectors follow from the relations.

        Links far from the frame are freed first, before them the blocks that stand for pins in slots.
        """
        given = self.lower.mechanism.chain.links[: self.given]
        depth = {link: (link in given, -k) for k, link in enumerate(self.pins)}
        free: list[int] = [k for k, link in enumerate(self.links) if link not in self.pins]
        for link in sorted(depth, key=lambda each: depth[each]):
            tried = [*free, self.links.index(link)]
            hung = [k for k in tried if self.links[k] in self.pins]
            if np.linalg.matrix_rank(self.relations[:, hung], tol=_RANK) == len(hung):
                free = tried
        return tuple(link for link in given if link in self.pins and self.links.index(link) not in free)

    @cached_property
    def reaches(self) -> dict[str, float]:
        """By link that hangs on the frame: how far it reaches from its inner pin, at least a tenth of the linkage."""
        least = 0.1 * self.lower.size
        return {
            link: max(
                (abs(complex(e.x, e.y) - pin) for (_, of), e in self.lower.elements.items() if of == link), default=0.0
            )
            or least
            for link, pin in self.pins.items()
        }

    def with_weights(self, carriers: Sequence[str], masses: Reals) -> Complexes:
        """C with masses added at the inner pins of some links."""
        total = self.total.copy()
        for link, mass in zip(carriers, masses, strict=True):
            total += mass * self.paths[link]
        return total

    def ways_from(self, link: str) -> tuple[int, ...]:
        """The joints over which all ways from a link's region lead that turning joints make."""
        region = self.regions[link]
        chain = self.lower.mechanism.chain
        return tuple(
            number
            for number, joint in enumerate(chain.joints)
            if len({self.regions[each] == region for each in joint.links}) == 2
        )


def mass_moments(linkage: Linkage, loads: Loads) -> MassMoments:
    """The moments of the masses, by paths of turning joints from the frame."""
    lower = with_lower_pairs(linkage)
    chain, frame = lower.mechanism.chain, lower.mechanism.frame
    links = tuple(link for link in chain.links if link != frame)
    acting = ActingLoads(lower, chain.links, loads)
    spots, masses = acting.spots[acting.heavy], acting.masses(1)[0]
    if not masses.any():
        raise LinkageError("nothing has mass, so that nothing is to be balanced")
    paths, pins, regions, relations = _walked(lower, links)
    total, blocked = np.zeros(len(links), np.complex128), []
    for spot, mass in zip(spots, masses, strict=True):
        if spot.link == frame or not mass:
            continue
        if spot.link not in pins:
            blocked.append(spot.link)
            continue
        total += mass * (paths[spot.link] + (complex(spot.x, spot.y) - pins[spot.link]) * _unit(links, spot.link))
    return MassMoments(
        lower=lower,
        links=links,
        total=total,
        relations=_independent(relations, len(links), [k for k, link in enumerate(links) if link not in pins]),
        paths=paths,
        pins=pins,
        blocked=tuple(dict.fromkeys(blocked)),
        regions=regions,
        given=len(linkage.mechanism.chain.links),
        scale=float(masses.sum()) * lower.size,
    )


def _unit(links: Sequence[str], link: str) -> Complexes:
    return np.asarray(np.array(links) == link, np.complex128)


def _walked(
    lower: Linkage, links: tuple[str, ...]
) -> tuple[dict[str, Complexes], dict[str, complex], dict[str, str], list[Complexes]]:
    """Paths to inner pins and these pins, for what hangs on the frame; regions; relations of all closed ways."""
    chain, frame = lower.mechanism.chain, lower.mechanism.frame
    origins: dict[str, Complexes] = {}
    paths: dict[str, Complexes] = {}
    pins: dict[str, complex] = {}
    regions: dict[str, str] = {}
    relations: list[Complexes] = []
    turning = [(number, joint.links) for number, joint in enumerate(chain.joints) if joint.pair.is_turning]
    for root in (frame, *links):
        if root in regions:
            continue
        regions[root], origins[root] = root, np.zeros(len(links), np.complex128)
        waiting, used = [root], set()
        for link in waiting:
            for number, ends in turning:
                if link not in ends or number in used:
                    continue
                used.add(number)
                at = origins[link] + _place(lower, number, link) * _unit(links, link)
                for other in ends:
                    if other == link:  # rounding alone would be a relation
                        continue
                    arm = _place(lower, number, other)
                    if other in regions:
                        relations.append(at - origins[other] - arm * _unit(links, other))
                        continue
                    regions[other], origins[other] = root, at - arm * _unit(links, other)
                    waiting.append(other)
                    if root == frame:
                        paths[other], pins[other] = at, arm
    for number, joint in enumerate(chain.joints):
        if joint.pair.is_sliding:
            first, *others = joint.links
            along = np.exp(1j * lower.elements[number, first].direction)
            for other in others:
                other_way = np.exp(1j * lower.elements[number, other].direction)
                relations.append(along * _unit(links, first) - other_way * _unit(links, other))
    return paths, pins, regions, relations


def _place(lower: Linkage, joint: int, link: str) -> complex:
    element = lower.elements[joint, link]
    return complex(element.x, element.y)


def _independent(relations: list[Complexes], width: int, without: list[int]) -> Complexes:
    """A basis of the relations that say nothing of some links, each of size 1; an open chain has none."""
    rows = np.array([row / size for row in relations if (size := np.abs(row).max(initial=0.0)) > 0], np.complex128)
    rows = rows.reshape(-1, width)
    if without and len(rows):
        left, values, _ = np.linalg.svd(rows[:, without])
        rank = int((values > _RANK * values.max(initial=0.0)).sum())
        rows = np.conj(left[:, rank:]).T @ rows
        rows[:, without] = 0
    if not len(rows):
        return rows
    _, values, right = np.linalg.svd(rows)
    return np.asarray(right[: int((values > _RANK).sum())])


def frame_pin(lower: Linkage, link: str) -> tuple[complex, complex]:
    """The pin of a link on the frame, in the coordinates of both; `LinkageError` if it has none."""
    frame = lower.mechanism.frame
    for number, joint in enumerate(lower.mechanism.chain.joints):
        if joint.pair.is_turning and link != frame and {link, frame} <= set(joint.links):
            return _place(lower, number, frame), _place(lower, number, link)
    raise LinkageError("{link!r} is not pinned to the frame", link=link)
