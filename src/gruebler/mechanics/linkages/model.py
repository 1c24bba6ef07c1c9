"""The linkage: a mechanism with dimensions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cached_property
from math import hypot, pi
from types import MappingProxyType
from typing import Any

from gruebler.base import notebook
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError, nearest
from gruebler.base.text import Message, message
from gruebler.mechanics.linkages.drawing import taken_apart
from gruebler.mechanics.linkages.elements import (
    CENTRED,
    INVERSE,
    CamDisc,
    Element,
    Line,
    LinkPoint,
    NonCircular,
    Pin,
    Pose2D,
    RoundElement,
    check_elements_fit,
    read_element,
)
from gruebler.mechanics.linkages.points import PointLike, points_of
from gruebler.mechanics.linkages.wheels import check_wheels, resolve_wheels
from gruebler.structure.chain.pairs import Space
from gruebler.structure.mechanism import Mechanism

NEAR_REFERENCE = 0.05
"""Sizes and radians: a closed position farther away is not the reference pose that was meant."""


class Linkage:
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
    """

    __slots__ = ("__dict__", "elements", "mechanism", "outputs", "points", "reference_pose", "unit")

    mechanism: Mechanism
    elements: Mapping[tuple[int, str], Element]
    points: Mapping[str, LinkPoint]
    unit: str
    reference_pose: Mapping[str, Pose2D] | None
    outputs: tuple[str, ...]

    @door_that_raises(LinkageError)
    def __init__(
        self,
        mechanism: Mechanism,
        elements: Mapping[str, Mapping[str | int, object]],
        points: Mapping[str, tuple[str, float, float]] | None = None,
        *,
        unit: str = "mm",
        reference_pose: Mapping[str, tuple[float, float, float]] | None = None,
        outputs: Iterable[str] = (),
    ) -> None:
        chain = mechanism.chain
        if chain.space is not Space.PLANAR:
            raise LinkageError("only planar mechanisms have dimensions; this one is {space}", space=chain.space)
        checked: dict[tuple[int, str], Element] = {}
        names = chain.joint_names()
        for link, by_joint in elements.items():
            for joint, raw in by_joint.items():
                number = chain.joint_number(joint, LinkageError)
                if link not in chain.joints[number].links:
                    raise LinkageError("{joint} is not a joint of {link!r}", joint=chain.joint_title(number), link=link)
                checked[number, link] = read_element(raw, f"{link}, {names[number]}")
        self._check_joints(mechanism, checked)
        checked = resolve_wheels(mechanism, checked)
        check_wheels(mechanism, checked)
        named = {
            name: _named(mechanism, name, *place) if len(place) == 3 else _refuse_point(name)
            for name, place in (points or {}).items()
        }
        for name in named:
            if name in chain.links or chain.find_joint(name) is not None:
                raise LinkageError("the point {name!r} has the name of a link or joint", name=name)
        for link in outputs:
            _link(mechanism, link, "outputs")
        object.__setattr__(self, "mechanism", mechanism)
        object.__setattr__(self, "elements", MappingProxyType(checked))
        object.__setattr__(self, "points", MappingProxyType(named))
        object.__setattr__(self, "unit", unit)
        object.__setattr__(
            self,
            "reference_pose",
            None if reference_pose is None else MappingProxyType(_checked_pose(mechanism, reference_pose)),
        )
        object.__setattr__(self, "outputs", tuple(outputs))

    @staticmethod
    def _check_joints(mechanism: Mechanism, elements: Mapping[tuple[int, str], Element]) -> None:
        names = mechanism.chain.joint_names()
        for number, joint in enumerate(mechanism.chain.joints):
            for link in joint.links:
                if (number, link) not in elements:
                    raise LinkageError(
                        "{joint} has no dimensions on {link!r}", joint=mechanism.chain.joint_title(number), link=link
                    )
            check_elements_fit(joint.pair, names[number], {link: elements[number, link] for link in joint.links})
        if any(isinstance(element, CENTRED) for element in elements.values()):
            return  # shafts on one axis
        for link in mechanism.chain.links:
            pins = [(n, e) for (n, owner), e in elements.items() if owner == link and isinstance(e, Pin)]
            for k, (n, pin) in enumerate(pins):
                for m, other in pins[:k]:
                    size = max(hypot(pin.x, pin.y), hypot(other.x, other.y), 1e-300)
                    if hypot(pin.x - other.x, pin.y - other.y) <= 1e-12 * size or pin == other:
                        raise LinkageError(
                            "on {link!r} the points of {joint} and {other} coincide: a link needs a length "
                            "(turning joints of several links at one place are written as one, such as R(a-b-c))",
                            link=link,
                            joint=mechanism.chain.joint_title(m),
                            other=mechanism.chain.joint_title(n),
                        )

    @classmethod
    @door_that_raises(LinkageError)
    def from_drawing(
        cls,
        mechanism: Mechanism,
        places: Mapping[str | int, object],
        points: Mapping[str, tuple[str, float, float]] | None = None,
        *,
        unit: str = "mm",
        outputs: Iterable[str] = (),
    ) -> Linkage:
        """The linkage that is drawn in one position: where each joint lies in the plane.

        A turning joint is given by ``(x, y)``, a slide by ``(x, y, angle)``. A pin in a slot is
        ``(x, y, angle, link)``, the link being the one with the slot; wheels are given for each link, as
        ``{link: Wheel(x, y, radius), ...}``. Points are given by where they lie in the
        drawing. Each link's x axis goes from its driven (else its first) joint to the next, or along its slide; the
        ways of slides are counted from pin to pin where the links have pins.

        >>> quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
        >>> drawn = Linkage.from_drawing(quad, {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (6, 4), "R(0-3)": (6, 0)})
        >>> drawn.length("1", 0, 1), drawn.reference_pose["1"].angle
        (2.0, 1.5707963267948966)
        """
        elements, seen, pose = taken_apart(mechanism, places, points or {})
        return Linkage(mechanism, elements, seen, unit=unit, reference_pose=pose, outputs=tuple(outputs))

    # --- what it is ----------------------------------------------------------------------------------

    def element(self, joint: str | int, link: str) -> Element:
        """What a joint is on one of its links."""
        number = self.mechanism.chain.joint_number(joint, LinkageError)
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
            extent = max([extent, *(abs(e.radius) for e in own_elements if isinstance(e, RoundElement))])
        return extent or 1.0

    def reference(self, drive: int) -> tuple[str, str]:
        """The two links of a drive: against the first is measured, the second is moved."""
        first, other = self.mechanism.drives[drive].between
        return (other, first) if other == self.mechanism.frame else (first, other)

    # --- other linkages ------------------------------------------------------------------------------

    def with_points(self, points: Mapping[str, tuple[str, float, float]]) -> Linkage:
        """The linkage with further named points, in coordinates of their links."""
        return self._changed(points={**{n: (p.link, p.x, p.y) for n, p in self.points.items()}, **points})

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
        )

    def scaled(self, factor: float) -> Linkage:
        """Every length times a positive factor."""
        if not 0 < factor < 1e100:
            raise LinkageError("a scale is a positive number, not {factor!r}", factor=factor)

        def element(e: Element) -> Element:
            if isinstance(e, RoundElement):
                return replace(e, x=e.x * factor, y=e.y * factor, radius=e.radius * factor)
            if isinstance(e, CamDisc):
                return replace(e, x=e.x * factor, y=e.y * factor, scale=e.scale * factor)
            return replace(e, x=e.x * factor, y=e.y * factor)

        return self._changed(
            elements=self._by_link(element),
            points={n: (p.link, p.x * factor, p.y * factor) for n, p in self.points.items()},
            reference_pose=None
            if self.reference_pose is None
            else {k: (p.x * factor, p.y * factor, p.angle) for k, p in self.reference_pose.items()},
        )

    def mirrored(self) -> Linkage:
        """The mirror image in the x axis: every y and every angle with the other sign."""

        def element(e: Element) -> Element:
            if isinstance(e, CamDisc):
                raise LinkageError("the mirror image of a cam is another cam: give its lift the other way round")
            if isinstance(e, NonCircular) and e.transfer != INVERSE and not e.transfer.lstrip().startswith("ellipse"):
                raise LinkageError("the mirror image of a non-circular wheel is another one: reverse its lift")
            return replace(e, y=-e.y) if isinstance(e, Pin | RoundElement) else replace(e, y=-e.y, angle=-e.angle)

        return self._changed(
            elements=self._by_link(element),
            points={n: (p.link, p.x, -p.y) for n, p in self.points.items()},
            reference_pose=None
            if self.reference_pose is None
            else {k: (p.x, -p.y, -p.angle) for k, p in self.reference_pose.items()},
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
        } | other
        return Linkage(**given)

    # --- a value -------------------------------------------------------------------------------------

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a linkage does not change; build another one instead of setting {name!r}")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a linkage does not change; {name!r} stays")

    def __copy__(self) -> Linkage:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Linkage:
        return self

    @cached_property
    def _key(self) -> tuple[object, ...]:
        reference = None if self.reference_pose is None else tuple(sorted(self.reference_pose.items()))
        points = tuple(sorted(self.points.items(), key=lambda named: named[0]))
        elements = tuple(sorted(self.elements.items()))
        return self.mechanism.written_form, elements, points, self.unit, reference, self.outputs

    @cached_property
    def _hash(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return self._key == other._key if isinstance(other, Linkage) else NotImplemented

    def __hash__(self) -> int:
        return self._hash

    def _repr_svg_(self) -> str | None:
        """The linkage to scale, for notebooks."""
        return notebook.svg_of(self) if notebook.svg_of else None

    def __repr__(self) -> str:
        return f"<linkage {self.mechanism.text()}>"

    def __reduce__(self) -> tuple[object, ...]:
        reference = None if self.reference_pose is None else {k: tuple(p) for k, p in self.reference_pose.items()}
        points = {n: (p.link, p.x, p.y) for n, p in self.points.items()}
        return _rebuilt, (self.mechanism, self._by_link(), points, self.unit, reference, self.outputs)


def _rebuilt(mechanism: Mechanism, elements: Any, points: Any, unit: str, reference_pose: Any, outputs: Any) -> Linkage:
    return Linkage(mechanism, elements, points, unit=unit, reference_pose=reference_pose, outputs=outputs)


def _link(mechanism: Mechanism, link: str, where: str | Message) -> str:
    if link not in mechanism.chain.links:
        known = mechanism.chain.links
        raise LinkageError(
            "{where}: there is no link {link!r}{suggestion}; links are {known}",
            where=where,
            link=link,
            suggestion=nearest(str(link), known),
            known=", ".join(known),
        )
    return link


def _named(mechanism: Mechanism, name: str, link: str, x: float, y: float) -> LinkPoint:
    pin = read_element([x, y], message("the point {name!r}", name=name))
    return LinkPoint(_link(mechanism, link, message("the point {name!r}", name=name)), pin.x, pin.y)


def _refuse_point(name: str) -> LinkPoint:
    raise LinkageError("the point {name!r} needs a link and two coordinates", name=name)


def _checked_pose(mechanism: Mechanism, poses_given: Mapping[str, tuple[float, float, float]]) -> dict[str, Pose2D]:
    poses = {}
    for link in mechanism.chain.links:
        if link not in poses_given and link != mechanism.frame:
            raise LinkageError("reference pose: the position of {link!r} is missing", link=link)
        line = read_element(tuple(poses_given.get(link, (0.0, 0.0, 0.0))), message("reference pose, {link}", link=link))
        if not isinstance(line, Line):
            raise LinkageError("reference pose, {link}: expected x, y and an angle", link=link)
        poses[link] = Pose2D(line.x, line.y, line.angle)
    for link in poses_given:
        _link(mechanism, link, message("reference pose"))
    if any(abs(v) > 1e-12 for v in (*poses[mechanism.frame][:2], poses[mechanism.frame].angle % (2 * pi))):
        raise LinkageError("reference pose: the frame lies at 0, 0, 0; its coordinates are those of the plane")
    return poses
