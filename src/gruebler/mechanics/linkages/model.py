"""The linkage: a mechanism with dimensions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import hypot
from types import MappingProxyType
from typing import Any

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.immutable import Immutable, settle
from gruebler.base.notebook import Drawn, explained
from gruebler.mechanics.linkages.description import linkage_lines, sizes_in_a_line
from gruebler.mechanics.linkages.drawing import taken_apart
from gruebler.mechanics.linkages.elements import Element, LinkPoint, Outline, Pose2D
from gruebler.mechanics.linkages.points import PointLike, points_of
from gruebler.mechanics.linkages.soundness import (
    checked_elements,
    checked_link,
    checked_outlines,
    checked_points,
    checked_pose,
)
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

NEAR_REFERENCE = 0.05
"""Sizes and radians: a closed position farther away is not the reference pose that was meant."""


@explained
@dataclass(frozen=True, init=False, eq=False, repr=False)
class Linkage(Immutable, Drawn):
    """A planar mechanism with the dimensions of its links. Immutable, and checked when it is constructed.

    Every link has coordinates of its own; those of the frame are the coordinates of the plane. The drive value of a
    turning joint is the angle of the second link's x axis against the first's, that of a slide the distance from the
    first line's point to the second's; "first" is the frame, or the link named first in the joint. Two linkages are
    equal if they are written alike, since the sense of a drive and the columns of a motion depend on the order.

    Args:
        mechanism: a planar mechanism.
        elements: for each link and each of its joints (by number or text) ``(x, y)`` for a pin, ``(x, y, angle)`` for a
            line, `Wheel` or `Circle`, in the link's coordinates; angles in radians.
        points: further points by name: ``(link, x, y)``.
        unit: the unit of all lengths; a name only.
        reference_pose: where the links lie in one position, ``(x, y, angle)`` for each link, if the assembly mode is
            to be that of a drawing.
        outputs: the links that a user looks at.
        outlines: what links look like besides their joints, for pictures alone: by link, in its coordinates.

    Raises:
        LinkageError: a joint without dimensions, numbers that are not finite, pins of one link that coincide, a link or
            joint that the mechanism does not have.

    >>> from gruebler.structure.mechanism import Mechanism
    >>> quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
    >>> linkage = Linkage(quad, {
    ...     "0": {"R(0-1)": (0, 0), "R(0-3)": (70, 0)}, "1": {"R(0-1)": (0, 0), "R(1-2)": (25, 0)},
    ...     "2": {"R(1-2)": (0, 0), "R(2-3)": (70, 0)}, "3": {"R(0-3)": (0, 0), "R(2-3)": (40, 0)}})
    >>> linkage.length("2", "R(1-2)", "R(2-3)")
    70.0

    See Also:
        `Mechanism`, `FourBar`, `SpatialLinkage`, `move`, `realise`

    Theory:
        docs/theory/kinematics.md
    """

    mechanism: Mechanism
    elements: Mapping[tuple[int, str], Element]
    points: Mapping[str, LinkPoint]
    unit: str
    reference_pose: Mapping[str, Pose2D] | None
    outputs: tuple[str, ...]
    outlines: Mapping[str, tuple[Outline, ...]]

    @door_that_raises(LinkageError)
    def __init__(
        self,
        mechanism: Mechanism,
        elements: Mapping[str, Mapping[str | int, object]],
        *,
        points: Mapping[str, tuple[str, float, float]] | None = None,
        unit: str = "mm",
        reference_pose: Mapping[str, tuple[float, float, float]] | None = None,
        outputs: Iterable[str] = (),
        outlines: Mapping[str, Iterable[Outline]] | None = None,
    ) -> None:
        if mechanism.chain.space is not Space.PLANAR:
            raise LinkageError(
                "only planar mechanisms have dimensions; this one is {space}", space=mechanism.chain.space
            )
        pose = None if reference_pose is None else MappingProxyType(checked_pose(mechanism, reference_pose))
        settle(
            self,
            mechanism=mechanism,
            elements=MappingProxyType(checked_elements(mechanism, elements)),
            points=MappingProxyType(checked_points(mechanism, points or {})),
            unit=unit,
            reference_pose=pose,
            outputs=tuple(checked_link(mechanism, link, "outputs") for link in outputs),
            outlines=MappingProxyType(checked_outlines(mechanism, outlines or {})),
        )

    @classmethod
    @door_that_raises(LinkageError)
    def from_drawing(
        cls,
        mechanism: Mechanism,
        places: Mapping[str | int, object],
        *,
        points: Mapping[str, tuple[str, float, float]] | None = None,
        unit: str = "mm",
        outputs: Iterable[str] = (),
    ) -> Linkage:
        """The linkage that is drawn in one position: where each joint lies in the plane.

        A turning joint is given by ``(x, y)``, a slide by ``(x, y, angle)``. A pin in a slot is
        ``(x, y, angle, link)``, the link being the one with the slot; wheels are given for each link, as
        ``{link: Wheel(x, y, radius), ...}``. Points are given by where they lie in the
        drawing. The coordinates of a link begin at its driven joint, else at its joint with the frame, else at its
        first one; the x axis goes to its next joint, or along its slide. So the angle of a crank or rocker is that
        from its pivot to its moving joint. The ways of slides are counted from pin to pin where the links have pins.

        >>> quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
        >>> drawn = Linkage.from_drawing(quad, {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (6, 4), "R(0-3)": (6, 0)})
        >>> drawn.length("1", 0, 1), drawn.reference_pose["1"].angle
        (2.0, 1.5707963267948966)
        """
        elements, seen, pose = taken_apart(mechanism, places, points or {})
        return cls(mechanism, elements, points=seen, unit=unit, reference_pose=pose, outputs=outputs)

    # --- what it is ----------------------------------------------------------------------------------

    def element(self, joint: str | int, link: str) -> Element:
        """What a joint is on one of its links."""
        number = self.mechanism.chain.joint_number(joint, error=LinkageError)
        if (number, link) not in self.elements:
            raise LinkageError(
                "{joint} is not a joint of {link!r}",
                joint=self.mechanism.chain.joint_title(number),
                link=link,
            )
        return self.elements[number, link]

    def length(self, link: str, first: str | int, second: str | int) -> float:
        """The distance of the points of two joints of a link, in the linkage's unit."""
        a, b = self.element(first, link), self.element(second, link)
        return hypot(a.x - b.x, a.y - b.y)

    @property
    def required_pose(self) -> Mapping[str, Pose2D]:
        """The reference pose; `LinkageError` if the linkage has none."""
        if self.reference_pose is None:
            raise LinkageError("the linkage has no reference pose: give the place of every link in one position")
        return self.reference_pose

    def points_named(self, point: PointLike) -> tuple[LinkPoint, ...]:
        """The point of that name, of the joint of that name (on each of its links, the frame's first), or a place.

        A place is ``(link, x, y)`` or ``"LINK:X,Y"``, on the coupler of a four-bar also ``(x, y)`` or ``"X,Y"``. Every
        function that takes a point takes all these forms.

        Raises `LinkageError` for what is none of them, with the nearest name that is.

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> FourBar(25, 70, 40, 70).linkage().points_named((45, 40))
        (LinkPoint(link='coupler', x=45.0, y=40.0),)
        """
        return points_of(self, point)

    @cached_property
    def size(self) -> float:
        """A length of the order of the linkage: the largest distance of joints on one link."""
        extent = 0.0
        for link in self.mechanism.chain.links:
            own_elements = [e for (_, owner), e in self.elements.items() if owner == link]
            extent = max([extent, *(hypot(a.x - b.x, a.y - b.y) for a in own_elements for b in own_elements)])
            extent = max([extent, *(e.rim for e in own_elements)])
        return extent or 1.0

    def reference(self, drive: int) -> tuple[str, str]:
        """The two links of a drive: against the first is measured, the second is moved."""
        first, other = self.mechanism.drives[drive].between
        return (other, first) if other == self.mechanism.frame else (first, other)

    # --- other linkages ------------------------------------------------------------------------------

    def with_points(self, points: Mapping[str, tuple[str, float, float]]) -> Linkage:
        """The linkage with further named points, in coordinates of their links."""
        return self._changed(points={**{n: (p.link, p.x, p.y) for n, p in self.points.items()}, **points})

    def with_outlines(self, outlines: Mapping[str, Iterable[Outline]]) -> Linkage:
        """The same linkage with these outlines of links, in coordinates of the links, in its pictures."""
        return self._changed(outlines=outlines)

    def with_outputs(self, outputs: Iterable[str]) -> Linkage:
        """The same linkage with these links looked at."""
        return self._changed(outputs=outputs)

    def with_mechanism(self, mechanism: Mechanism) -> Linkage:
        """The same sizes with other drives; the mechanism must have the same chain, written alike, and frame."""
        if mechanism.written_form[:-1] != self.mechanism.written_form[:-1]:
            raise LinkageError("the same sizes need the same chain, joints in the same order, and the same frame")
        return self._changed(mechanism=mechanism)

    def with_frame(self, frame: str, drive: str) -> Linkage:
        """The same sizes on another frame, with a link driven there; the reference pose is seen from the new frame.

        Raises `LinkageError` for a link that is not jointed to the frame.

        >>> quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
        >>> drawn = Linkage.from_drawing(quad, {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (6, 4), "R(0-3)": (6, 0)})
        >>> drawn.with_frame("1", "2").mechanism.text()
        'R(0-1) R(1-2) R(2-3) R(0-3); frame=1; drive=R(1-2)'
        """
        chain = self.mechanism.chain
        between = [k for k, joint in enumerate(chain.joints) if {frame, drive} <= {*joint.links}]
        if not between:
            raise LinkageError("{drive} is not jointed to {frame}", drive=drive, frame=frame)
        mechanism = Mechanism(chain, frame, [chain.joint_names()[between[0]]])
        pose = self.reference_pose
        if pose is not None:
            held = pose[frame]
            pose = {
                link: Pose2D(*held.to_local(place.x, place.y), place.angle - held.angle) for link, place in pose.items()
            }
        return self._changed(mechanism=mechanism, reference_pose=pose, outputs=())

    def with_reference_pose(self, reference_pose: Mapping[str, tuple[float, float, float]] | None) -> Linkage:
        """The same sizes with another reference pose: x, y and angle of every link, in radians; or without one."""
        return self._changed(reference_pose=reference_pose)

    def renamed(self, names: Mapping[str, str]) -> Linkage:
        """The same linkage with other link names; names that the mapping leaves out stay.

        >>> quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
        >>> drawn = Linkage.from_drawing(quad, {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (6, 4), "R(0-3)": (6, 0)})
        >>> drawn.renamed({"1": "crank"}).length("crank", "R(0-crank)", "R(crank-2)")
        2.0
        """
        new = {link: names.get(link, link) for link in self.mechanism.chain.links}
        pose = self.reference_pose
        return self._changed(
            mechanism=self.mechanism.renamed(names),
            elements={new[link]: elements for link, elements in self._by_link().items()},
            points={n: (new[p.link], p.x, p.y) for n, p in self.points.items()},
            reference_pose=None if pose is None else {new[link]: place for link, place in pose.items()},
            outputs=[new[link] for link in self.outputs],
            outlines={new[link]: outlines for link, outlines in self.outlines.items()},
        )

    def scaled(self, factor: float) -> Linkage:
        """Every length times a positive factor."""
        if not 0 < factor < 1e100:
            raise LinkageError("a scale is a positive number, not {factor!r}", factor=factor)
        return self._mapped(lambda shape: shape.scaled(factor), lambda x, y: (x * factor, y * factor), 1.0)

    def shifted(self, x: float, y: float) -> Linkage:
        """The same linkage at another place of the plane.

        >>> quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
        >>> drawn = Linkage.from_drawing(quad, {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (6, 4), "R(0-3)": (6, 0)})
        >>> drawn.shifted(10, 1).element("R(0-3)", "0")
        Pin(x=16.0, y=1.0)
        """
        frame, there, elements = self.mechanism.frame, Pose2D(-x, -y, 0.0), self._by_link()
        for (number, link), e in self.elements.items():
            if link == frame:
                elements[link][number] = e.placed(e.x + x, e.y + y, e.direction)
        pose = self.reference_pose
        return self._changed(
            elements=elements,
            points={
                n: (p.link, *((p.x + x, p.y + y) if p.link == frame else (p.x, p.y))) for n, p in self.points.items()
            },
            reference_pose=None
            if pose is None
            else {k: p if k == frame else (p.x + x, p.y + y, p.angle) for k, p in pose.items()},
            outlines={k: [o.seen_from(there) if k == frame else o for o in of] for k, of in self.outlines.items()},
        )

    def mirrored(self) -> Linkage:
        """The mirror image in the x axis: every y and every angle with the other sign."""
        return self._mapped(lambda shape: shape.mirrored(), lambda x, y: (x, -y), -1.0)

    def _mapped(
        self, shape: Callable[[Any], Any], place: Callable[[float, float], tuple[float, float]], turn: float
    ) -> Linkage:
        """All elements and outlines, places, and angles changed, in the frame and on all links alike."""
        pose = self.reference_pose
        return self._changed(
            elements=self._by_link(shape),
            points={n: (p.link, *place(p.x, p.y)) for n, p in self.points.items()},
            reference_pose=None if pose is None else {k: (*place(p.x, p.y), turn * p.angle) for k, p in pose.items()},
            outlines={link: list(map(shape, of)) for link, of in self.outlines.items()},
        )

    def _by_link(self, change: Callable[[Element], Element] = lambda e: e) -> dict[str, dict[str | int, object]]:
        by_link: dict[str, dict[str | int, object]] = {link: {} for link in self.mechanism.chain.links}
        for (number, link), e in self.elements.items():
            by_link[link][number] = change(e)
        return by_link

    def _changed(self, **other: Any) -> Linkage:
        given: dict[str, Any] = {
            "mechanism": self.mechanism,
            "elements": self._by_link(),
            "points": {n: (p.link, p.x, p.y) for n, p in self.points.items()},
            "unit": self.unit,
            "reference_pose": self.reference_pose,
            "outputs": self.outputs,
            "outlines": self.outlines,
        } | other
        return Linkage(**given)

    # --- a value -------------------------------------------------------------------------------------

    def _identity(self) -> tuple[object, ...]:
        reference = None if self.reference_pose is None else tuple(sorted(self.reference_pose.items()))
        points = tuple(sorted(self.points.items(), key=lambda named: named[0]))
        elements = tuple(sorted(self.elements.items()))
        outlines = tuple(sorted((link, *((o.places, o.radius) for o in of)) for link, of in self.outlines.items()))
        return self.mechanism.written_form, elements, points, self.unit, reference, self.outputs, outlines

    def explain(self, lang: str = "en") -> str:
        """The mechanism and the size of each link, in English or German (``de``); coordinates are those of the link.

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> print(FourBar(25, 70, 40, 70).linkage({"K": (30, 20)}))
        R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); frame=frame; drive=R(frame-crank)
        frame: 70 mm from R(frame-crank) to R(frame-rocker)
        crank: 25 mm from R(frame-crank) to R(crank-coupler)
        coupler: R(crank-coupler) at (0, 0), R(coupler-rocker) at (70, 0), K at (30, 20)
        rocker: 40 mm from R(coupler-rocker) to R(frame-rocker)
        """
        pose = self.reference_pose
        lines = linkage_lines(self.mechanism, self.elements, self.points, unit=self.unit, reference_pose=pose)
        return "\n".join(line.in_language(lang) for line in lines)

    def __repr__(self) -> str:
        sizes = sizes_in_a_line(self.elements, self.points, self.reference_pose)
        return f"<linkage {self.mechanism.text()}; {sizes}; {self.unit}>"
