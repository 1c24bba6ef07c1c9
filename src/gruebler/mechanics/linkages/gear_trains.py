"""Gear trains as linkages with wheels, and back: docs/theory/wheels.md, Trains.

A train tells how the speeds of its links are joined; a linkage says where its wheels stand as well. So the way there
chooses places, with distances that fit the sizes, and the way back forgets them.
"""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable
from fractions import Fraction
from itertools import count
from math import pi, tau
from typing import Any

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import LinkageError
from gruebler.machines.gears import Mesh, Train, Unit
from gruebler.machines.gears.stages import central_links, mesh_groups
from gruebler.machines.gears.train import FRAME, exact_number
from gruebler.mechanics.linkages.contacts import contact_of
from gruebler.mechanics.linkages.elements import Element, Line, Wheel
from gruebler.mechanics.linkages.model import Linkage
from gruebler.mechanics.linkages.wheels import Carrier, carriers, round_joints
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import pair
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

_APART = 1.7  # sums of radii: the distance of the axes of a belt
_TURN = pi * (3 - 5**0.5)  # the golden angle: multiples of it are evenly spread, and never twice the same
_CLEAR = 1e-3  # of a distance: axes that are nearer to another axis are put elsewhere
_PARALLEL = 1e-9  # radians, or parts of a radius


def linkage_of_train(train: Train, drives: Iterable[str]) -> Linkage:
    """A linkage with wheels whose links turn with the speeds of a train, driven at these links.

    Each mesh has a module of its own, that which its distance gives: the sizes of a train are free up to that. What
    slides moves along the x axis; a rack that is given by its pitch moves by that for each turn, speeds in radians.

    Args:
        train: gears, friction wheels, belts, chains and racks; a link is borne by the frame or by one carrier.
        drives: links borne by the frame, as many as the train has freedoms.

    Raises `LinkageError` for bevel gears, screws and winches, for wheels that mesh and have one axis, for a planet of
    two carriers, and for a drive that is not borne by the frame.

    >>> from gruebler.machines.gears import read_train
    >>> linkage = linkage_of_train(read_train("sun:24 planet:18 ring:-60 on arm").train, ["sun", "ring"])
    >>> linkage.element("G(sun-planet)", "sun").radius, linkage.element("G(planet-ring)", "ring").radius
    (12.0, -30.0)
    """
    chosen = [train.known(link) for link in drives]
    layout = _Layout(train)
    joints, places = layout.bearings()
    for link in chosen:
        if layout.bearer.get(link, FRAME) != FRAME:
            raise LinkageError(
                "{link} is a planet of {carrier}: drive a link that the frame supports",
                link=link,
                carrier=layout.bearer[link],
            )
    driven = [next(k for k, joint in enumerate(joints) if set(joint.links) == {FRAME, link}) for link in chosen]
    for mesh in train.meshes:
        smooth = mesh.traits.touching and not mesh.traits.toothed
        joints.append(Joint(pair("rolling" if smooth else "roll_slide"), (mesh.a, mesh.b)))
        places.append(layout.contact(mesh))
    mechanism = Mechanism(Chain(joints, space=Space.PLANAR), FRAME, driven)
    return Linkage.from_drawing(mechanism, dict(enumerate(places)))


class _Layout:
    """Which link bears each other one, and where the axes lie."""

    def __init__(self, train: Train) -> None:
        for mesh in train.meshes:
            if not (mesh.traits.parallel or mesh.traits.rack):
                raise LinkageError("'{mesh}' has no linkage in the plane", mesh=mesh)
        self.train, self.sliding = train, {link for link, unit in train.units().items() if unit != Unit.TURNING}
        self.bearer: dict[str, str] = {}
        self.axes: dict[str, complex] = {}
        groups = mesh_groups(mesh for mesh in train.meshes if mesh.b not in self.sliding and mesh.traits.parallel)
        moving = [group for group in groups if group[0].carrier != FRAME]
        central = [central_links(group, train) for group in moving]
        for group, hubs in zip(moving, central, strict=True):
            for link in dict.fromkeys(link for mesh in group for link in (mesh.a, mesh.b)):
                if link not in hubs:
                    self._bear(link, group[0].carrier)
        for mesh in train.meshes:
            if mesh.traits.rack and mesh.carrier != FRAME:
                self._bear(mesh.a, mesh.carrier)
        coaxial = DisjointSets(link for link in train.links if link not in self.bearer and link not in self.sliding)
        for group, hubs in zip(moving, central, strict=True):
            for link in sorted(hubs - {FRAME}):
                coaxial.unite(group[0].carrier, link)
        self._place(coaxial, [mesh for group in groups if group[0].carrier == FRAME for mesh in group])
        for mesh in (mesh for group in moving for mesh in group):
            self._place_planets(mesh)
        for link in self.bearer:
            self.axes.setdefault(link, 0j)

    def _bear(self, link: str, carrier: str) -> None:
        if self.bearer.setdefault(link, carrier) != carrier:
            raise LinkageError(
                "{link} is a planet of {first} and of {second}", link=link, first=self.bearer[link], second=carrier
            )

    def _place(self, coaxial: DisjointSets[str], meshes: list[Mesh]) -> None:
        """The axes on the frame: each beside the first that it meshes with."""
        ends = {mesh: (coaxial.find(mesh.a), coaxial.find(mesh.b)) for mesh in meshes if FRAME not in (mesh.a, mesh.b)}
        if len(ends) < len(meshes) or any(a == b for a, b in ends.values()):
            mesh = next(mesh for mesh in meshes if mesh not in ends or len(set(ends[mesh])) == 1)
            raise LinkageError("'{mesh}': both wheels have one axis", mesh=mesh)
        at: dict[str, complex] = {}
        while left := [mesh for mesh in ends if not {*ends[mesh]} <= at.keys()]:
            beside = next((mesh for mesh in left if at.keys() & {*ends[mesh]}), None)
            if beside is None:
                at[ends[left[0]][0]] = self._right_of(at, _distance(left[0]))
                continue
            known, new = ends[beside] if ends[beside][0] in at else ends[beside][::-1]
            at[new] = _beside(at[known], _distance(beside), at.values())
        for axis in coaxial.classes():
            at.setdefault(coaxial.find(axis[0]), self._right_of(at, 1.0))
            self.axes |= dict.fromkeys(axis, at[coaxial.find(axis[0])])

    @staticmethod
    def _right_of(at: dict[str, complex], distance: float) -> complex:
        return complex(max(z.real for z in at.values()) + distance) if at else 0j

    def _place_planets(self, mesh: Mesh) -> None:
        """The axes of a planet, beside the partner that has a place; of the carrier's axis if none has."""
        hub = self.axes[mesh.carrier]
        known = [link for link in (mesh.a, mesh.b) if self._known(link)]
        for link in (mesh.a, mesh.b):
            if link in self.bearer and link not in self.axes:
                partner = self.at(known[0], mesh) if known else hub
                held = [at for other, at in self.axes.items() if self.bearer.get(other) == mesh.carrier]
                self.axes[link] = _beside(partner, _distance(mesh), [hub, *held])
                known.append(link)

    def _known(self, link: str) -> bool:
        return link == FRAME or link in self.axes

    def at(self, link: str, mesh: Mesh) -> complex:
        """The axis of a link's wheel in a mesh; a wheel fixed to the frame has that of the carrier."""
        return self.axes[mesh.carrier] if link == FRAME else self.axes[link]

    def bearings(self) -> tuple[list[Joint], list[object]]:
        """A joint for each link with what bears it, and its place."""
        joints: list[Joint] = []
        places: list[object] = []
        for link in self.train.links:
            if link in self.sliding:
                joints.append(Joint(pair("prismatic"), (FRAME, link)))
                places.append((0.0, 0.0, 0.0))
            else:
                joints.append(Joint(pair("revolute"), (self.bearer.get(link, FRAME), link)))
                places.append((self.axes[link].real, self.axes[link].imag))
        return joints, places

    def contact(self, mesh: Mesh) -> dict[str, object]:
        """The wheels of a mesh, or wheel and line, by link."""
        if mesh.traits.rack:
            radius = float(mesh.size_a) / (tau if mesh.traits.unit is Unit.PER_TURN else 1)
            z = self.axes[mesh.a]
            return {mesh.a: Wheel(z.real, z.imag, abs(radius)), mesh.b: (z.real, z.imag - radius, 0.0)}
        ends = {link: self.at(link, mesh) for link in (mesh.a, mesh.b)}
        sizes = {mesh.a: mesh.size_a, mesh.b: mesh.size_b}
        belt = mesh.traits.belt
        scale = 0.5 if belt else abs(ends[mesh.a] - ends[mesh.b]) / abs(float(mesh.size_a + mesh.size_b))
        toothed = mesh.traits.toothed and all(size.denominator == 1 for size in sizes.values())
        return {
            link: Wheel(z.real, z.imag, scale * float(sizes[link]), teeth=int(sizes[link]) if toothed else 0, belt=belt)
            for link, z in ends.items()
        }


def _distance(mesh: Mesh) -> float:
    """Of the axes, for a module of 1."""
    if mesh.traits.belt:
        return _APART * float(mesh.size_a + mesh.size_b) / 2
    return abs(float(mesh.size_a + mesh.size_b)) / 2


def _beside(known: complex, distance: float, others: Iterable[complex]) -> complex:
    """A place at a distance from a known one, in the first direction in which it is clear of the others."""
    taken = list(others)
    places = (known + rect(distance, k * _TURN) for k in count())
    return next(z for z in places if all(abs(z - other) > _CLEAR * distance for other in taken))


def train_of(linkage: Linkage) -> Train:
    """The train of the wheels of a linkage: what their tooth numbers or radii say of the speeds of the links.

    Joints without wheels are not looked at. A mesh needs a link that holds both axes; a rack and the axis of its wheel
    are held by the frame or by slides along the rack.

    Raises `LinkageError` for other contacts, such as cams and Geneva drives, and for a linkage without wheels.

    >>> from gruebler.machines.gears import read_train, ratio
    >>> train = read_train("sun:24 planet:18 ring:-60 on arm").train
    >>> again = train_of(linkage_of_train(train, ["sun", "ring"]))
    >>> again == train, str(ratio(again, "sun", "arm", held=["ring"]))
    (True, '7/2')
    """
    mechanism, elements = linkage.mechanism, linkage.elements
    held = carriers(mechanism, elements)
    names = {link: link for link in mechanism.chain.links} | {mechanism.frame: FRAME}
    if len(set(names.values())) < len(names):
        raise LinkageError("in a train the frame is called 'frame', and no other link is")
    meshes = []
    for number, (a, b) in round_joints(mechanism, elements).items():
        contact = contact_of(elements[number, a], elements[number, b])
        if contact.kinds not in _MESHES:
            joint = mechanism.chain.joint_title(number)
            raise LinkageError("{joint}: a train has wheels, belts and racks only", joint=joint)
        meshes.append(_MESHES[contact.kinds](linkage, number, names, held.get(number)))
    if not meshes:
        raise LinkageError("the linkage has no wheels")
    return Train(meshes)


def _size(wheel: Any) -> Fraction:
    return Fraction(wheel.teeth) if wheel.teeth else exact_number(wheel.radius, "radius")


def _wheels(linkage: Linkage, number: int, names: dict[str, str], arm: Carrier | None) -> Mesh:
    """Two wheels on a link that holds their axes."""
    chain = linkage.mechanism.chain
    a, b = chain.joints[number].links
    first: Any = linkage.elements[number, a]
    if arm is None:
        raise LinkageError("{joint}: no link holds the axes of both wheels", joint=chain.joint_title(number))
    kind = {"open": "belt", "crossed": "crossed"}.get(
        first.belt, "friction" if chain.joints[number].pair.rolls else "gear"
    )
    return Mesh(
        a=names[a],
        b=names[b],
        size_a=_size(first),
        size_b=_size(linkage.elements[number, b]),
        carrier=names[arm.link],
        kind=kind,
    )


def _rack(linkage: Linkage, number: int, names: dict[str, str], _: Carrier | None) -> Mesh:
    """A rack on the frame or on a slide, with a wheel whose axis is on the frame or on a slide."""
    chain, frame, pose = linkage.mechanism.chain, linkage.mechanism.frame, linkage.required_pose
    joint = chain.joint_title(number)
    a, b = chain.joints[number].links
    if linkage.elements[number, a].is_line:
        a, b = b, a
    wheel: Any = linkage.elements[number, a]
    line = linkage.elements[number, b]
    guides = {
        link: element.direction
        for k, other in enumerate(chain.joints)
        if other.pair.is_sliding and frame in other.links
        for link in other.links
        for element in [linkage.elements[k, frame]]
        if link != frame and element.is_line
    }
    bearer = next(
        (
            link
            for k, other in enumerate(chain.joints)
            if other.pair.is_turning and a in other.links and _same_place(linkage.elements[k, a], wheel)
            for link in other.links
            if link == frame or link in guides
        ),
        None,
    )
    ways = [rect(1, guides[link]) for link in (b, bearer) if link in guides]
    direction = rect(1, pose[b].angle + line.direction)
    parallel = ways and max(abs(ways[0] - ways[-1]), abs((ways[0] / direction).imag)) <= _PARALLEL
    if bearer is None or not (b == frame or b in guides) or not parallel:
        raise LinkageError("{joint}: rack and axis are not held by the frame or by slides along the rack", joint=joint)
    centre, point = (complex(*pose[link].put(e.x, e.y)) for link, e in ((a, wheel), (b, line)))
    below = ((centre - point) / ways[0]).imag > 0  # the rack then moves as its wheel turns, otherwise against it
    size = exact_number(wheel.radius, "radius")
    return Mesh(a=names[a], b=names[b], size_a=size if below else -size, carrier=names[bearer], kind="rack")


def _same_place(pin: Element, wheel: Wheel) -> bool:
    return pin.is_pin and abs(complex(pin.x - wheel.x, pin.y - wheel.y)) <= _PARALLEL * wheel.radius


_MESHES = {(Wheel, Wheel): _wheels, (Wheel, Line): _rack}
"""What makes a mesh of two kinds of elements that touch."""
