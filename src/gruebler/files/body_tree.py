"""A linkage as a tree of bodies, as simulators and robots have it; the joints that are left close its loops."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.base.units import MILLIMETRES
from gruebler.files.linkage_drawings import lower_linkage
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

DENSITY = 7850.0
"""kg/m³, of steel."""
SLENDER = 50
"""The size of a linkage over the radius of its bars."""


class OpenTree:
    """A mechanism cut open: drives stay joints of the tree, then those with few freedoms, slides before pins."""

    def __init__(self, mechanism: Mechanism) -> None:
        """`GrueblerError` if rolling or sliding contours alone hold a link."""
        chain, self.frame = mechanism.chain, mechanism.frame
        self.names = chain.joint_names()
        edges = []  # rank, joint, two links
        for number, joint in enumerate(chain.joints):
            driven = [drive.between for drive in mechanism.drives if drive.joint == number]
            held = DisjointSets(joint.links)
            for near, far in driven:
                held.unite(near, far)
                edges.append(((0, 0, 0), number, near, far))
            centre = driven[0][0] if driven else joint.links[0]
            for far in joint.links:
                if held.find(far) != held.find(centre):
                    held.unite(centre, far)
                    rank = (1, joint.pair.f(chain.space), 0 if joint.pair.is_sliding or joint.pair.has_pitch else 1)
                    edges.append((rank, number, centre, far))
        sets = DisjointSets(chain.links)
        self.tree: dict[str, list[tuple[int, str]]] = {link: [] for link in chain.links}
        self.closing: list[tuple[int, str, str]] = []
        """Joint and two links of what is cut, drives first, then slides."""
        for _, number, near, far in sorted(edges, key=lambda edge: edge[0]):
            if chain.joints[number].pair.has_contours or sets.find(near) == sets.find(far):
                self.closing.append((number, near, far))
            else:
                sets.unite(near, far)
                self.tree[near].append((number, far))
                self.tree[far].append((number, near))
        for link in chain.links:
            if sets.find(link) != sets.find(self.frame):
                raise GrueblerError("{link} is held by contacts alone, and a tree has none", link=link)

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


class BodyTree:
    """The tree of a linkage in the plane, and the pins that close its loops."""

    def __init__(self, linkage: Linkage, left_out: list[Message]) -> None:
        """Of a linkage of turning and sliding joints; `GrueblerError` for others, and if slides alone close a loop."""
        self.lower = lower = lower_linkage(linkage)
        if lower.unit and lower.unit not in MILLIMETRES:
            left_out.append(message("the unit {unit}", unit=lower.unit))
        if linkage.outputs:
            left_out.append(message("which links are outputs: {links}", links=", ".join(linkage.outputs)))
        self.scale = MILLIMETRES.get(lower.unit, 1000.0) / 1000  # metres
        mechanism = lower.mechanism
        self.frame, self.names = mechanism.frame, mechanism.chain.joint_names()
        self.open = OpenTree(mechanism)
        driven = {(drive.joint, frozenset(drive.between)) for drive in mechanism.drives}
        for number, near, far in self.open.closing:
            if mechanism.chain.joints[number].pair.is_sliding or (number, frozenset((near, far))) in driven:
                raise GrueblerError("the slide {joint} closes a loop of slides and drives", joint=self.names[number])

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
