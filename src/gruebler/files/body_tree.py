"""A linkage as a tree of bodies, as simulators have it: with drives and slides; other pins close its loops."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.base.units import MILLIMETRES
from gruebler.files.pin_drawings import lower_linkage
from gruebler.mechanics.linkages import Linkage

DENSITY = 7850.0
"""kg/m³, of steel."""
SLENDER = 50
"""The size of a linkage over the radius of its bars."""


class BodyTree:
    """The tree of a linkage, and what closes its loops."""

    def __init__(self, linkage: Linkage, left_out: list[Message]) -> None:
        """Of a linkage of turning and sliding joints; `GrueblerError` for others, and if slides alone close a loop."""
        self.lower = lower = lower_linkage(linkage)
        if lower.unit not in MILLIMETRES:
            left_out.append(message("the unit {unit}", unit=lower.unit))
        if linkage.outputs:
            left_out.append(message("which links are outputs: {links}", links=", ".join(linkage.outputs)))
        self.scale = MILLIMETRES.get(lower.unit, 1000.0) / 1000  # metres
        mechanism = lower.mechanism
        self.frame, self.names = mechanism.frame, mechanism.chain.joint_names()
        edges = []  # importance, joint, two links
        for number, joint in enumerate(mechanism.chain.joints):
            driven = [drive.between for drive in mechanism.drives if drive.joint == number]
            held = DisjointSets(joint.links)
            for near, far in driven:
                held.unite(near, far)
                edges.append((0, number, near, far))
            centre = driven[0][0] if driven else joint.links[0]
            for far in joint.links:
                if held.find(far) != held.find(centre):
                    held.unite(centre, far)
                    edges.append((1 if joint.pair.is_sliding else 2, number, centre, far))
        sets = DisjointSets(mechanism.chain.links)
        self.tree: dict[str, list[tuple[int, str]]] = {link: [] for link in mechanism.chain.links}
        self.closing: list[tuple[int, str, str]] = []
        for importance, number, near, far in sorted(edges, key=lambda edge: edge[0]):
            if sets.find(near) != sets.find(far):
                sets.unite(near, far)
                self.tree[near].append((number, far))
                self.tree[far].append((number, near))
            elif importance < 2:
                raise GrueblerError("the slide {joint} closes a loop of slides and drives", joint=self.names[number])
            else:
                self.closing.append((number, near, far))

    def descent(self) -> Iterator[tuple[str, str, int] | None]:
        """Every link but the frame, with the one above it and their joint, before those below it; None behind these."""
        stack: list[tuple[str, str, int] | None] = [
            (other, self.frame, number) for number, other in reversed(self.tree[self.frame])
        ]
        while stack:
            entry = stack.pop()
            yield entry
            if entry is not None:
                child, above, _ = entry
                stack.append(None)
                stack += [(other, child, joint) for joint, other in reversed(self.tree[child]) if other != above]

    def bars(self, link: str) -> list[tuple[tuple[float, float], tuple[float, float]]]:
        """From the first place of a link to each other one; one of no length if there is none."""
        places = [(e.x, e.y) for (_, owner), e in self.lower.elements.items() if owner == link]
        places += [(point.x, point.y) for point in self.lower.points.values() if point.link == link]
        (x, y), *others = places
        far = [(a, b) for a, b in dict.fromkeys(others) if hypot(a - x, b - y) > 1e-9 * self.lower.size]
        return [((x, y), place) for place in far] or [((x, y), (x, y))]

    def position(self, x: float, y: float) -> str:
        """A point of the plane in metres, as XML files write it."""
        return f"{x * self.scale!r} {y * self.scale!r} 0"
