"""Linkages as models of MuJoCo (MJCF): a tree of bodies, and equality constraints that close the loops.

Links lie in the plane z = 0, in metres where the unit is known; driven joints and slides are in the tree, so that a
position actuator moves each drive; the other pins are ``connect`` constraints, stiff ones. Gravity is off. In the
reference position every joint is at 0, so a control is the change of the drive since. Links are thin capsules of
steel; those of a linkage of less than 13 mm are heavier, since MuJoCo takes no inertia below 1e-15 kg m².
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, sin
from xml.sax.saxutils import quoteattr

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.files.body_tree import DENSITY, SLENDER, BodyTree
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Drive

_STIFF = 100.0  # 1/s: the drive follows its control at this rate
_STEP = 5e-4  # s
_LEAST_INERTIA = 1e-9  # kg m², of a bar as long as the linkage: the smallest ball has 1e-5 of it, mjMINVAL is 1e-15
_SMALLEST = 1e-6  # m
_WORLD = "world"  # the body that MuJoCo makes of the frame


def mjcf_from_linkage(linkage: Linkage, left_out: list[Message]) -> str:
    """The model of a linkage of turning and sliding joints.

    Raises `GrueblerError` for wheels and cams, below a thousandth of a millimetre, and if slides alone close a loop.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> model = mjcf_from_linkage(FourBar(25, 70, 40, 70).linkage(), [])
    >>> model.count("<body "), model.count("<connect "), model.count("<position ")
    (3, 1, 1)
    """
    return _Model(linkage, left_out).text()


class _Model:
    """The model of a linkage."""

    def __init__(self, linkage: Linkage, left_out: list[Message]) -> None:
        self.bodies = BodyTree(linkage, left_out)
        self.used: set[int] = set()
        self.driven: dict[int, tuple[str, int]] = {}
        size = self.bodies.lower.size * self.bodies.scale
        if size < _SMALLEST:
            raise GrueblerError("a linkage of {size:.2g} m is too small for a model of MuJoCo", size=size)
        lightest = _LEAST_INERTIA * SLENDER**2 / size**5
        self.density = max(DENSITY, lightest)
        if lightest > DENSITY:
            left_out.append(
                message(
                    "the density of steel: the links are {factor:.3g} times as heavy, as MuJoCo takes no small masses",
                    factor=lightest / DENSITY,
                )
            )

    def text(self) -> str:
        """The whole model."""
        size = self.bodies.lower.size * self.bodies.scale
        head = [
            '<mujoco model="linkage">',
            '  <compiler angle="radian"/>',
            f'  <option timestep="{_STEP!r}" gravity="0 0 0" integrator="implicitfast" tolerance="1e-14"/>',
            "  <default>",
            f'    <geom type="capsule" size="{size / SLENDER!r}" density="{self.density!r}" contype="0" '
            'conaffinity="0"/>',
            f'    <equality solref="{2 * _STEP!r} 1" solimp="0.9999 0.9999 0.001"/>',
            f'    <site size="{size / SLENDER!r}"/>',
            "  </default>",
            "  <worldbody>",
        ]
        bodies = [*self._sites(self.bodies.frame, 2), *self._bodies()]
        closing = []
        for number, base, follower in self.bodies.open.closing:
            body, partner = (follower, base) if base == self.bodies.frame else (base, follower)
            pin = self.bodies.lower.elements[number, body]
            second = "" if partner == self.bodies.frame else f" body2={_body(partner)}"
            closing.append(f'    <connect body1={_body(body)}{second} anchor="{self.bodies.position(pin.x, pin.y)}"/>')
        actuators = []
        for number, drive in enumerate(self.bodies.lower.mechanism.drives):
            gain = self._inertia(drive) * _STIFF**2
            joint, sign = self.driven[number]
            actuators.append(
                f'    <position name={quoteattr(f"drive {joint}")} gear="{sign}" '
                f'joint={quoteattr(joint)} kp="{gain!r}" kv="{2 * gain / _STIFF!r}"/>'
            )
        loops = ["  </worldbody>", "  <equality>", *closing, "  </equality>"]
        drives = ["  <actuator>", *actuators, "  </actuator>", "</mujoco>"]
        return "\n".join([*head, *bodies, *loops, *drives]) + "\n"

    def _inertia(self, drive: Drive) -> float:
        """Inertia of the motor of a drive: that of all links together, so that they hardly act back on it."""
        size = self.bodies.lower.size * self.bodies.scale
        mass = self.density * 3 * (size / SLENDER) ** 2 * size * len(self.bodies.open.tree)
        return float(mass * size**2 if drive.turning else mass)

    def _bodies(self) -> Iterator[str]:
        """The bodies, each within the one that it hangs on."""
        poses, indent = self.bodies.lower.required_pose, 2
        for entry in self.bodies.open.descent():
            if entry is None:
                indent -= 1
                yield "  " * indent + "</body>"
                continue
            child, above, number = entry
            pad = "  " * indent
            here, there = poses[child], poses[above]
            place = there.to_local(here.x, here.y)
            turn = here.angle - there.angle
            yield f'{pad}<body name={_body(child)} pos="{self.bodies.position(*place)}" euler="0 0 {turn!r}">'
            yield f"{pad}  {self._joint(number, child, above)}"
            yield from self._shape(child, indent + 1)
            yield from self._sites(child, indent + 1)
            indent += 1

    def _joint(self, number: int, child: str, above: str) -> str:
        """The joint of a body on the one above it; the sign of a driven one against its drive is noted."""
        joint, element = self.bodies.lower.mechanism.chain.joints[number], self.bodies.lower.elements[number, child]
        plain = self.bodies.names[number] if number not in self.used else f"{self.bodies.names[number]} {child}"
        self.used.add(number)
        name, motor = quoteattr(plain), ""
        for k, drive in enumerate(self.bodies.lower.mechanism.drives):
            if drive.joint == number and {child, above} == set(drive.between):
                self.driven[k] = (plain, 1 if child == self.bodies.lower.reference(k)[1] else -1)
                motor = f' armature="{self._inertia(drive)!r}"'
        if joint.pair.is_turning:
            pos = self.bodies.position(element.x, element.y)
            return f'<joint name={name} type="hinge" axis="0 0 1" pos="{pos}"{motor}/>'
        angle = element.direction
        return f'<joint name={name} type="slide" axis="{cos(angle)!r} {sin(angle)!r} 0"{motor}/>'

    def _shape(self, link: str, depth: int) -> Iterator[str]:
        """A capsule from the first place of a link to each other one, a ball if there is only one."""
        pad = "  " * depth
        for first, second in self.bodies.bars(link):
            if first == second:
                yield f'{pad}<geom type="sphere" pos="{self.bodies.position(*first)}"/>'
            else:
                yield f'{pad}<geom fromto="{self.bodies.position(*first)} {self.bodies.position(*second)}"/>'

    def _sites(self, link: str, depth: int) -> Iterator[str]:
        """The named points of a link."""
        for name, point in self.bodies.lower.points.items():
            if point.link == link:
                yield f'{"  " * depth}<site name={quoteattr(name)} pos="{self.bodies.position(point.x, point.y)}"/>'


def _body(link: str) -> str:
    """The name of a body; that of the frame is taken."""
    return quoteattr(link if link != _WORLD else f"{link} (link)")
