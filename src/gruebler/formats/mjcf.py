"""Linkages as models of MuJoCo (MJCF): a tree of bodies, and equality constraints that close the loops.

Links lie in the plane z = 0, in metres where the unit is known; driven joints and slides are in the tree, so that a
position actuator moves each drive; the other pins are ``connect`` constraints, stiff ones. Gravity is off. In the
reference position every joint is at 0, so a control is the change of the drive since. Links are thin capsules of steel.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, hypot, sin
from xml.sax.saxutils import quoteattr

from gruebler.disjoint_sets import DisjointSets
from gruebler.errors import GrueblerError
from gruebler.formats.pin_drawings import lower_linkage
from gruebler.linkages import Linkage
from gruebler.linkages.elements import direction
from gruebler.mechanism import Drive
from gruebler.text import Message, message

__all__ = ["mjcf_from_linkage"]

_METRES = {"mm": 1e-3, "cm": 1e-2, "dm": 0.1, "m": 1.0, "in": 0.0254}
_STEEL = 7850.0  # kg/m³
_SLENDER = 50  # size over the radius of a capsule
_STIFF = 100.0  # 1/s: the drive follows its control at this rate
_STEP = 5e-4  # s


def mjcf_from_linkage(linkage: Linkage, left_out: list[Message]) -> str:
    """The model of a linkage of turning and sliding joints.

    Raises `GrueblerError` for wheels and cams, and if slides alone close a loop.

    >>> from gruebler.fourbar import FourBar
    >>> model = mjcf_from_linkage(FourBar(25, 70, 40, 70).linkage(), [])
    >>> model.count("<body "), model.count("<connect "), model.count("<position ")
    (3, 1, 1)
    """
    lower = lower_linkage(linkage)
    scale = _METRES.get(lower.unit)
    if scale is None:
        left_out.append(message("the unit {unit}", unit=lower.unit))
        scale = 1.0
    if linkage.outputs:
        left_out.append(message("which links are outputs: {links}", links=", ".join(linkage.outputs)))
    return _Model(lower, scale).text()


class _Model:
    """The tree of a linkage, and what closes its loops."""

    def __init__(self, lower: Linkage, scale: float) -> None:
        self.lower, self.scale = lower, scale
        mechanism = lower.mechanism
        self.frame, self.names = mechanism.frame, mechanism.chain.joint_names()
        driven = {drive.joint: drive.between for drive in mechanism.drives}
        edges = []  # importance, joint, two links
        for number, joint in enumerate(mechanism.chain.joints):
            centre = driven[number][0] if number in driven else joint.links[0]
            for other in joint.links:
                if other != centre:
                    first = number in driven and other == driven[number][1]
                    edges.append((0 if first else 1 if joint.pair.is_prismatic else 2, number, centre, other))
        sets = DisjointSets(mechanism.chain.links)
        self.tree: dict[str, list[tuple[int, str]]] = {link: [] for link in mechanism.chain.links}
        self.closing: list[tuple[int, str, str]] = []
        for importance, number, one, other in sorted(edges, key=lambda edge: edge[0]):
            if sets.find(one) != sets.find(other):
                sets.unite(one, other)
                self.tree[one].append((number, other))
                self.tree[other].append((number, one))
            elif importance < 2:
                raise GrueblerError("the slide {joint} closes a loop of slides and drives", joint=self.names[number])
            else:
                self.closing.append((number, one, other))
        self.signs: dict[int, int] = {}

    def text(self) -> str:
        """The whole model."""
        size = self.lower.size * self.scale
        head = [
            '<mujoco model="linkage">',
            '  <compiler angle="radian"/>',
            f'  <option timestep="{_STEP!r}" gravity="0 0 0" integrator="implicitfast" tolerance="1e-14"/>',
            "  <default>",
            f'    <geom type="capsule" size="{size / _SLENDER!r}" density="{_STEEL!r}" contype="0" conaffinity="0"/>',
            f'    <equality solref="{2 * _STEP!r} 1" solimp="0.9999 0.9999 0.001"/>',
            f'    <site size="{size / _SLENDER!r}"/>',
            "  </default>",
            "  <worldbody>",
        ]
        bodies = [*self._sites(self.frame, 2), *self._bodies()]
        closing = []
        for number, one, other in self.closing:
            body, partner = (other, one) if one == self.frame else (one, other)
            pin = self.lower.elements[number, body]
            second = "" if partner == self.frame else f" body2={quoteattr(partner)}"
            closing.append(f'    <connect body1={quoteattr(body)}{second} anchor="{self._at(pin.x, pin.y)}"/>')
        actuators = []
        for drive in self.lower.mechanism.drives:
            gain = self._inertia(drive) * _STIFF**2
            sign = self.signs[drive.joint] * (1 if drive.between[1] != self.frame else -1)
            actuators.append(
                f'    <position name={quoteattr(f"drive {self.names[drive.joint]}")} gear="{sign}" '
                f'joint={quoteattr(self.names[drive.joint])} kp="{gain!r}" kv="{2 * gain / _STIFF!r}"/>'
            )
        loops = ["  </worldbody>", "  <equality>", *closing, "  </equality>"]
        drives = ["  <actuator>", *actuators, "  </actuator>", "</mujoco>"]
        return "\n".join([*head, *bodies, *loops, *drives]) + "\n"

    def _inertia(self, drive: Drive) -> float:
        """Inertia of the motor of a drive: that of all links together, so that they hardly act back on it."""
        size = self.lower.size * self.scale
        mass = _STEEL * 3 * (size / _SLENDER) ** 2 * size * len(self.tree)
        return float(mass * size**2 if drive.turning else mass)

    def _at(self, x: float, y: float) -> str:
        return f"{x * self.scale!r} {y * self.scale!r} 0"

    def _bodies(self) -> Iterator[str]:
        """The bodies, each within the one that it hangs on."""
        stack: list[tuple[str, str, int] | str] = [
            (other, self.frame, number) for number, other in reversed(self.tree[self.frame])
        ]
        poses, indent = self.lower.required_pose, 2
        while stack:
            entry = stack.pop()
            if isinstance(entry, str):
                indent -= 1
                yield "  " * indent + entry
                continue
            child, above, number = entry
            pad = "  " * indent
            here, there = poses[child], poses[above]
            place = there.to_local(here.x, here.y)
            turn = here.angle - there.angle
            yield f'{pad}<body name={quoteattr(child)} pos="{self._at(*place)}" euler="0 0 {turn!r}">'
            yield f"{pad}  {self._joint(number, child)}"
            yield from self._shape(child, indent + 1)
            yield from self._sites(child, indent + 1)
            stack.append("</body>")
            stack += [(other, child, joint) for joint, other in reversed(self.tree[child]) if other != above]
            indent += 1

    def _joint(self, number: int, child: str) -> str:
        """The joint of a body on the one above it; its sign against the drive is noted."""
        joint, element = self.lower.mechanism.chain.joints[number], self.lower.elements[number, child]
        name = quoteattr(self.names[number] if number not in self.signs else f"{self.names[number]} {child}")
        drive = next((each for each in self.lower.mechanism.drives if each.joint == number), None)
        if number not in self.signs:
            self.signs[number] = -1 if drive is not None and drive.between[0] == child else 1
        motor = "" if drive is None else f' armature="{self._inertia(drive)!r}"'
        if joint.pair.is_revolute:
            return f'<joint name={name} type="hinge" axis="0 0 1" pos="{self._at(element.x, element.y)}"{motor}/>'
        angle = direction(element)
        return f'<joint name={name} type="slide" axis="{cos(angle)!r} {sin(angle)!r} 0"{motor}/>'

    def _shape(self, link: str, depth: int) -> Iterator[str]:
        """A capsule from the first place of a link to each other one, a ball if there is only one."""
        places = [(e.x, e.y) for (_, owner), e in self.lower.elements.items() if owner == link]
        places += [(point.x, point.y) for point in self.lower.points.values() if point.link == link]
        (x, y), *others = places
        far = [(a, b) for a, b in dict.fromkeys(others) if hypot(a - x, b - y) > 1e-9 * self.lower.size]
        pad = "  " * depth
        for a, b in far:
            yield f'{pad}<geom fromto="{self._at(x, y)} {self._at(a, b)}"/>'
        if not far:
            yield f'{pad}<geom type="sphere" pos="{self._at(x, y)}"/>'

    def _sites(self, link: str, depth: int) -> Iterator[str]:
        """The named points of a link."""
        for name, point in self.lower.points.items():
            if point.link == link:
                yield f'{"  " * depth}<site name={quoteattr(name)} pos="{self._at(point.x, point.y)}"/>'
