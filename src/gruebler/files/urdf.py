"""Linkages in the plane and in space as robots in URDF: a tree of links, so that every loop of the linkage is cut.

Lengths are metres where the unit is known. In the reference position every joint is at 0 and all frames have the axes
of the frame link; that of a link lies at the joint above it. A joint with several freedoms is a row of joints with
small bodies between them, called by its freedoms: ``S(crank-rod) Rx`` and so on; a screw is a turn and a travel that
follows it (``mimic``). The value of a joint is that of its lower link against the upper one. Named points are links
without mass on fixed joints. A linkage in the plane lies in z = 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import acos, atan2, cos, pi, sin
from xml.sax.saxutils import quoteattr

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.text import Message, message
from gruebler.base.units import MILLIMETRES
from gruebler.files.body_tree import DENSITY, SLENDER, OpenTree
from gruebler.files.gltf import metres_a_unit
from gruebler.files.link_solids import bars_between
from gruebler.files.linkage_drawings import lower_linkage, placed_joint
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import JointPlace, SpatialLinkage
from gruebler.mechanics.space.bodies import motions
from gruebler.structure.chain.spaces import Space


def urdf_from_linkage(linkage: Linkage | SpatialLinkage, left_out: list[Message]) -> str:
    """The robot of a linkage; the list gets the joints at which its loops are cut, wheels among them.

    Raises `GrueblerError` for wheels and cams in the plane, and for a link that contacts alone hold.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> notes = []
    >>> robot = urdf_from_linkage(FourBar(25, 70, 40, 70).linkage(), notes)
    >>> robot.count("<link "), robot.count('type="continuous"'), str(notes[1])
    (4, 3, 'the loops: the model is cut at R(frame-rocker) and moves there as the linkage does not')
    """
    if linkage.outputs:
        left_out.append(message("which links are outputs: {links}", links=", ".join(linkage.outputs)))
    robot = _Robot(_in_plane(lower_linkage(linkage)) if isinstance(linkage, Linkage) else linkage)
    if not robot.spherical and linkage.unit and linkage.unit not in MILLIMETRES:
        left_out.append(message("the unit {unit}", unit=linkage.unit))
    cut = ", ".join(dict.fromkeys(robot.tree.names[number] for number, _, _ in robot.tree.closing))
    if cut:
        left_out.append(
            message("the loops: the model is cut at {joints} and moves there as the linkage does not", joints=cut)
        )
    left_out.append(message("drives"))
    return "\n".join(['<?xml version="1.0"?>', '<robot name="linkage">', *robot.lines(), "</robot>"]) + "\n"


def _in_plane(lower: Linkage) -> SpatialLinkage:
    """The same linkage by its places in the reference pose."""
    places = []
    for number, joint in enumerate(lower.mechanism.chain.joints):
        drawn = placed_joint(lower, number)
        along = (cos(drawn.slot), sin(drawn.slot), 0.0) if joint.pair.is_sliding and drawn.slot is not None else None
        places.append(JointPlace((drawn.x, drawn.y, 0.0), x=along))
    poses = lower.required_pose
    points = {name: (p.link, *poses[p.link].put(p.x, p.y), 0.0) for name, p in lower.points.items()}
    return SpatialLinkage(lower.mechanism, tuple(places), unit=lower.unit, points=points)


class _Robot:
    """The robot of a linkage."""

    def __init__(self, linkage: SpatialLinkage) -> None:
        self.linkage, self.tree = linkage, OpenTree(linkage.mechanism)
        self.chain = linkage.mechanism.chain
        self.spherical = self.chain.space is Space.SPHERICAL
        scale = metres_a_unit(linkage)
        size = (1.0 if self.spherical else linkage.size) * scale
        self.radius, self.reach, self.scale = size / SLENDER, 2 * size, scale
        self.at = scale * linkage.frames[:, :3, 3]
        if self.spherical:  # bearings lie on the sphere, what else turns about its centre
            turning = [joint.pair.is_turning for joint in self.chain.joints]
            self.at = scale * linkage.frames[:, :3, 2] * np.array(turning)[:, None]
        self.used: set[str] = set(self.chain.links)

    def lines(self) -> Iterator[str]:
        origins = {self.tree.frame: np.zeros(3)}
        yield from self._link(self.tree.frame, origins[self.tree.frame])
        for entry in self.tree.descent():
            if entry is not None:
                child, above, number = entry
                origins[child] = self.at[number]
                yield from self._joints(child, above, number, self.at[number] - origins[above])
                yield from self._link(child, self.at[number])
        for name, (link, place) in self.linkage.points.items():
            called = self._called(name, "point")
            yield f"  <link name={quoteattr(called)}/>"
            yield f'  <joint name={quoteattr(f"point {name}")} type="fixed">'
            yield from self._between(link, called, self.scale * np.array(place) - origins[link])
            yield "  </joint>"

    def _called(self, name: str, addition: str) -> str:
        """The name, if another has it with something behind."""
        while name in self.used:
            name += f" {addition}"
        self.used.add(name)
        return name

    def _between(self, above: str, below: str, shift: Reals) -> Iterator[str]:
        yield f"    <parent link={quoteattr(above)}/>"
        yield f"    <child link={quoteattr(below)}/>"
        yield f'    <origin xyz="{_numbers(shift)}"/>'

    def _joints(self, child: str, above: str, number: int, shift: Reals) -> Iterator[str]:
        """A joint for each freedom between two links; joints of several links have the lower link's name, too."""
        joint = self.chain.joints[number]
        base = self.tree.names[number] if joint.count == 1 else f"{self.tree.names[number]} {child}"
        pitch = self.linkage.places[number].pitch * self.scale
        steps = []  # freedom, whether it follows the one before
        for freedom in motions(joint.pair, self.chain.space):
            steps += [(freedom.turn, False), (freedom.travel, True)] if freedom.has_pitch else [(freedom, False)]
        if joint.links.index(child) < joint.links.index(above) and not joint.pair.has_pitch:
            steps.reverse()
        parent = above
        for k, (freedom, follows) in enumerate(steps):
            last = k == len(steps) - 1
            name = base if len(steps) == 1 else f"{base} {freedom}"
            body = child if last else self._called(name, child)
            if not last:
                yield from self._link(body, self.at[number], small=True)
            yield f'  <joint name={quoteattr(name)} type="{"prismatic" if freedom.travels else "continuous"}">'
            yield from self._between(parent, body, np.zeros(3) if k else shift)
            axis = self.linkage.frames[number, :3, "xyz".index(freedom.axis)]
            yield f'    <axis xyz="{_numbers(axis)}"/>'
            limits = f'lower="{-self.reach!r}" upper="{self.reach!r}" ' if freedom.travels else ""
            yield f'    <limit {limits}effort="1000" velocity="100"/>'
            if follows:
                turn = quoteattr(f"{base} {freedom.turn}")
                yield f'    <mimic joint={turn} multiplier="{pitch!r}"/>'
            yield "  </joint>"
            parent = body

    def _link(self, link: str, origin: Reals, *, small: bool = False) -> Iterator[str]:
        """A link of bars about its frame, which lies at a place of it; without any bar a ball."""
        own = [k for k, joint in enumerate(self.chain.joints) if link in joint.links and not small]
        places = [self.at[k] - origin for k in own]
        places += [self.scale * np.array(at) - origin for owner, at in self.linkage.points.values() if owner == link]
        bars = [(a, b) for a, b in bars_between(np.array(places)) if np.linalg.norm(b - a) > 1e-9 * self.reach]
        shapes = []  # mass, middle, inertia about it, text
        for a, b in bars:
            length = float(np.linalg.norm(b - a))
            direction = (b - a) / length
            mass = DENSITY * pi * self.radius**2 * length
            across, along = mass * (3 * self.radius**2 + length**2) / 12, mass * self.radius**2 / 2
            inertia = across * np.eye(3) + (along - across) * np.outer(direction, direction)
            turn = f"0 {acos(max(-1.0, min(1.0, direction[2])))!r} {atan2(direction[1], direction[0])!r}"
            text = (
                f'rpy="{turn}"/>\n      <geometry><cylinder radius="{self.radius!r}" length="{length!r}"/></geometry>'
            )
            shapes.append((mass, (a + b) / 2, inertia, text))
        if not shapes:
            mass = DENSITY * 4 / 3 * pi * self.radius**3
            text = f'/>\n      <geometry><sphere radius="{self.radius!r}"/></geometry>'
            middle = places[0] if places else np.zeros(3)
            shapes.append((mass, middle, 0.4 * mass * self.radius**2 * np.eye(3), text))
        whole = sum(mass for mass, _, _, _ in shapes)
        centre = np.sum([mass * middle for mass, middle, _, _ in shapes], axis=0) / whole
        tensor = np.zeros((3, 3))
        for mass, middle, inertia, _ in shapes:
            d = middle - centre
            tensor += inertia + mass * (d @ d * np.eye(3) - np.outer(d, d))
        moments = [f'i{"xyz"[i]}{"xyz"[j]}="{float(tensor[i, j])!r}"' for i in range(3) for j in range(i, 3)]
        yield f"  <link name={quoteattr(link)}>"
        yield "    <inertial>"
        yield f'      <origin xyz="{_numbers(centre)}"/>'
        yield f'      <mass value="{whole!r}"/>'
        yield f"      <inertia {' '.join(moments)}/>"
        yield "    </inertial>"
        for _, middle, _, text in shapes:
            yield f'    <visual>\n      <origin xyz="{_numbers(middle)}" {text}\n    </visual>'
        yield "  </link>"


def _numbers(vector: Reals) -> str:
    """Numbers as XML has them."""
    return " ".join(repr(float(x) + 0.0) for x in vector)
