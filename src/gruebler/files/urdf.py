"""Linkages as robots in URDF: a tree of links, so that every loop of the linkage is cut.

Links lie in the plane z = 0, in metres where the unit is known. A link's frame is at the joint above it; in the
reference position every joint is at 0. Named points are links without mass on fixed joints.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, cos, hypot, pi, sin
from xml.sax.saxutils import quoteattr

from gruebler.base.text import Message, message
from gruebler.files.body_tree import DENSITY, SLENDER, BodyTree
from gruebler.mechanics.linkages import Linkage


def urdf_from_linkage(linkage: Linkage, left_out: list[Message]) -> str:
    """The robot of a linkage of turning and sliding joints; the list gets the joints at which its loops are cut.

    Raises `GrueblerError` for wheels and cams, and if slides alone close a loop.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> notes = []
    >>> robot = urdf_from_linkage(FourBar(25, 70, 40, 70).linkage(), notes)
    >>> robot.count("<link "), robot.count('type="continuous"'), str(notes[1])
    (4, 3, 'the loops: the model is cut at R(frame-rocker) and moves there as the linkage does not')
    """
    return _Robot(linkage, left_out).text(left_out)


class _Robot:
    """The robot of a linkage."""

    def __init__(self, linkage: Linkage, left_out: list[Message]) -> None:
        self.bodies = BodyTree(linkage, left_out)

    def text(self, left_out: list[Message]) -> str:
        """The whole file."""
        cut = ", ".join(dict.fromkeys(self.bodies.names[number] for number, _, _ in self.bodies.closing))
        if cut:
            left_out.append(
                message("the loops: the model is cut at {joints} and moves there as the linkage does not", joints=cut)
            )
        left_out.append(message("drives"))
        lines = ['<?xml version="1.0"?>', '<robot name="linkage">', *self._link(self.bodies.frame, 0.0, 0.0)]
        origins = {self.bodies.frame: (0.0, 0.0)}
        used: set[int] = set()
        for entry in self.bodies.descent():
            if entry is None:
                continue
            child, above, number = entry
            element = self.bodies.lower.elements[number, child]
            origins[child] = (element.x, element.y)
            lines += self._joint(child, above, number, origins, again=number in used)
            lines += self._link(child, element.x, element.y)
            used.add(number)
        for name, point in self.bodies.lower.points.items():
            x, y = origins[point.link]
            lines += [
                f"  <link name={quoteattr(name)}/>",
                f'  <joint name={quoteattr(f"point {name}")} type="fixed">',
                f"    <parent link={quoteattr(point.link)}/>",
                f"    <child link={quoteattr(name)}/>",
                f'    <origin xyz="{self.bodies.position(point.x - x, point.y - y)}"/>',
                "  </joint>",
            ]
        return "\n".join([*lines, "</robot>"]) + "\n"

    def _joint(
        self, child: str, above: str, number: int, origins: dict[str, tuple[float, float]], *, again: bool
    ) -> Iterator[str]:
        """The joint of a link; of a joint of several links the second and later ones have the link's name behind."""
        joint, element = self.bodies.lower.mechanism.chain.joints[number], self.bodies.lower.elements[number, child]
        poses = self.bodies.lower.required_pose
        x, y = poses[above].to_local(*poses[child].put(element.x, element.y))
        turn = poses[child].angle - poses[above].angle
        turning = joint.pair.is_turning
        name = f"{self.bodies.names[number]} {child}" if again else self.bodies.names[number]
        angle = 0.0 if turning else element.direction
        axis = "0 0 1" if turning else f"{cos(angle)!r} {sin(angle)!r} 0"
        yield f'  <joint name={quoteattr(name)} type="{"continuous" if turning else "prismatic"}">'
        yield f"    <parent link={quoteattr(above)}/>"
        yield f"    <child link={quoteattr(child)}/>"
        origin = self.bodies.position(x - origins[above][0], y - origins[above][1])
        yield f'    <origin xyz="{origin}" rpy="0 0 {turn!r}"/>'
        yield f'    <axis xyz="{axis}"/>'
        reach = 2 * self.bodies.lower.size * self.bodies.scale
        limits = "" if turning else f'lower="{-reach!r}" upper="{reach!r}" '
        yield f'    <limit {limits}effort="1000" velocity="100"/>'
        yield "  </joint>"

    def _link(self, link: str, x: float, y: float) -> Iterator[str]:
        """A link of bars about its frame, which lies at a place of it."""
        scale = self.bodies.scale
        radius = self.bodies.lower.size / SLENDER * scale
        yield f"  <link name={quoteattr(link)}>"
        bars = [
            ((a - x) * scale, (b - y) * scale, (c - x) * scale, (d - y) * scale)
            for (a, b), (c, d) in self.bodies.bars(link)
        ]
        masses = [DENSITY * pi * radius**2 * (hypot(c - a, d - b) + radius) for a, b, c, d in bars]
        mass = sum(masses)
        middle_x = sum(m * (a + c) / 2 for m, (a, _, c, _) in zip(masses, bars, strict=True)) / mass
        middle_y = sum(m * (b + d) / 2 for m, (_, b, _, d) in zip(masses, bars, strict=True)) / mass
        about = sum(
            m * (((c - a) ** 2 + (d - b) ** 2) / 12 + ((a + c) / 2 - middle_x) ** 2 + ((b + d) / 2 - middle_y) ** 2)
            for m, (a, b, c, d) in zip(masses, bars, strict=True)
        )
        inertia = about + mass * radius**2 / 2
        yield "    <inertial>"
        yield f'      <origin xyz="{middle_x!r} {middle_y!r} 0"/>'
        yield f'      <mass value="{mass!r}"/>'
        yield f'      <inertia ixx="{inertia!r}" ixy="0" ixz="0" iyy="{inertia!r}" iyz="0" izz="{inertia!r}"/>'
        yield "    </inertial>"
        for a, b, c, d in bars:
            long = hypot(c - a, d - b)
            yield "    <visual>"
            yield f'      <origin xyz="{(a + c) / 2!r} {(b + d) / 2!r} 0" rpy="0 {pi / 2!r} {atan2(d - b, c - a)!r}"/>'
            yield f'      <geometry><cylinder radius="{radius!r}" length="{long + radius!r}"/></geometry>'
            yield "    </visual>"
        yield "  </link>"
