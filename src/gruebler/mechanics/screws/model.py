"""The linkage given by the screws of its joints in one position."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import isfinite
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError, unknown
from gruebler.base.immutable import Immutable, settle
from gruebler.mechanics.linkages.points import link_number
from gruebler.mechanics.screws.joint_places import JointPlace, Vector, joint_axes, read_place
from gruebler.mechanics.screws.rigid_motions import exponential
from gruebler.mechanics.screws.round_bodies import TurnedBody, read_bodies
from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

_LEAST = 1e-300
_ORTHOGONAL = 1e-9  # by how much a rotation matrix may miss its transpose as inverse: nine digits were written


@dataclass(frozen=True, init=False, eq=False, repr=False)
class SpatialLinkage(Immutable):
    """A mechanism and where its joints lie in one position, its reference pose; planar, spherical or spatial.

    The links need no coordinates of their own: in the reference pose all of them have those of the frame. The joints
    are closed there by construction.

    Args:
        mechanism: any mechanism.
        joints: for each joint, by number or text, a `JointPlace`, a mapping with its keys, or a point alone where that
            is enough.
        unit: the unit of lengths; a name only.
        points: named points (link, x, y, z), their coordinates in the reference pose.
        outputs: the links whose motion is wanted.
        round_bodies: cylinders on links that pictures show, such as the wheel of a car: a `TurnedBody` each, or a
            mapping with its keys.

    Raises:
        LinkageError: a joint without a place, an axis that its pair needs and that is missing, numbers that are not
            finite, a point or output on no link.

    >>> winch = Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut)")
    >>> axis = {"z": (0, 0, 1)}
    >>> SpatialLinkage(winch, {0: axis, 1: axis | {"pitch": 0.8}, 2: {"x": (0, 0, 1), "at": (0, 5, 0)}}).size
    3.33...

    See Also:
        `Linkage`, `freedoms`, `move`, `measures`

    Theory:
        docs/theory/space.md
    """

    mechanism: Mechanism
    places: tuple[JointPlace, ...]
    """The joints in the reference pose, in the order of the chain."""
    unit: str
    points: Mapping[str, tuple[str, Vector]]
    """The link of each named point and its coordinates in the reference pose."""
    outputs: tuple[str, ...]
    round_bodies: Mapping[str, TurnedBody]

    @door_that_raises(LinkageError)
    def __init__(
        self,
        mechanism: Mechanism,
        joints: Mapping[str | int, object] | tuple[JointPlace, ...],
        *,
        unit: str = "mm",
        points: Mapping[str, Sequence[object]] | None = None,
        outputs: Iterable[str] = (),
        round_bodies: Mapping[str, TurnedBody | Mapping[str, Any]] | None = None,
    ) -> None:
        chain = mechanism.chain
        names = chain.joint_names()
        given = joints if isinstance(joints, Mapping) else dict(enumerate(joints))
        raw: dict[int, object] = {}
        for key, value in given.items():
            raw[chain.joint_number(key, error=LinkageError)] = value
        for number, name in enumerate(names):
            if number not in raw:
                raise LinkageError("{name} has no place", name=name)
        places = tuple(read_place(raw[k], joint.pair, chain.space, names[k]) for k, joint in enumerate(chain.joints))
        named = {name: _point(mechanism, name, point) for name, point in (points or {}).items()}
        wanted = tuple(outputs)
        for link in wanted:
            link_number(link, mechanism.chain.links)
        bodies = MappingProxyType(read_bodies(round_bodies or {}, chain.links))
        points_read = MappingProxyType(named)
        settle(
            self,
            mechanism=mechanism,
            places=places,
            unit=unit,
            points=points_read,
            outputs=wanted,
            round_bodies=bodies,
        )

    @classmethod
    @door_that_raises(LinkageError)
    def from_dh(
        cls, rows: Sequence[Sequence[float]], *, links: Sequence[str] = (), drive: int = 0, unit: str = "mm"
    ) -> SpatialLinkage:
        """The loop of turning joints of Denavit-Hartenberg rows (θ, d, a, α) in a closed position.

        Joint k turns link k against the one before about its z axis by θ; d along z, then a along x and α about x lead
        to the next joint. The frame is link 0, named ``0`` unless there are other names.

        Raises `LinkageError` if the loop is open there, with the gap.

        >>> quarter = np.pi / 2
        >>> SpatialLinkage.from_dh([(quarter, 0, 1, 0)] * 4)  # a square
        <spatial linkage spatial: R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1); (0, 0, 0) (...>
        """
        whole = len(rows) >= 3 and all(len(row) == 4 for row in rows)
        numbers = np.array(rows, float) if whole else np.zeros((0, 4))
        if not len(numbers) or not np.isfinite(numbers).all():
            raise LinkageError("expected rows of four numbers θ, d, a, α, at least three, but found {rows}", rows=rows)
        names = tuple(links) or tuple(map(str, range(len(numbers))))
        if len(names) != len(numbers):
            raise LinkageError("expected {count} links, but found {found}", count=len(numbers), found=", ".join(names))
        frame, places = np.eye(4), []
        for theta, d, a, alpha in numbers:
            places.append(JointPlace(_vector(frame[:3, 3]), z=_vector(frame[:3, 2])))
            turn = exponential([0, 0, theta, 0, 0, d]) @ exponential([alpha, 0, 0, a, 0, 0])
            frame = frame @ turn
        scale = max(float(abs(numbers[:, 1:3]).max()), _LEAST)
        gap = float(max(abs(frame[:3, :3] - np.eye(3)).max(), abs(frame[:3, 3]).max() / scale))
        if gap > _ORTHOGONAL:
            raise LinkageError("the loop is open by {gap:.1e} of its size", gap=gap)
        text = " ".join(f"R({first}-{second})" for first, second in zip(names, (*names[1:], names[0]), strict=True))
        mechanism = Mechanism(Chain.parse(f"spatial: {text}"), names[0], [drive])
        return cls(mechanism, tuple(places), unit=unit)

    def point(self, name: str | tuple[str, float, float, float]) -> tuple[str, Vector]:
        """Link and place, in the reference pose, of a named point, of a joint, or of (link, x, y, z).

        A joint is a point of its first link that is not the frame.

        Raises `LinkageError` for what names no point, with the nearest name.
        """
        chain = self.mechanism.chain
        if not isinstance(name, str):
            return _point(self.mechanism, str(name), name)
        if name in self.points:
            return self.points[name]
        number = chain.find_joint(name)
        if number is None:
            known = [*self.points, *chain.joint_names()]
            raise LinkageError("there is no point {word!r}{suggestion}; known are {known}", **unknown(name, known))
        link = next(link for link in chain.joints[number].links if link != self.mechanism.frame)
        return link, self.places[number].at

    @cached_property
    def centre(self) -> Reals:
        """The mean of the joints' points, (3,); on a sphere its centre."""
        return np.asarray(np.mean([place.at for place in self.places], axis=0))

    @cached_property
    def size(self) -> float:
        """A length of the order of the linkage: the largest distance of a joint from the centre, 1 if there is none."""
        largest = max(float(np.linalg.norm(place.at - self.centre)) for place in self.places)
        return largest or 1.0

    @cached_property
    def frames(self) -> Reals:
        """Point and axes of each joint in the reference pose, (joints, 4, 4)."""
        frames = np.tile(np.eye(4), (len(self.places), 1, 1))
        for k, place in enumerate(self.places):
            frames[k, :3, :3] = joint_axes(place, self.mechanism.chain.space)
            frames[k, :3, 3] = place.at
        return frames

    def moved(self, motion: ArrayLike) -> SpatialLinkage:
        """The same linkage elsewhere: every point and axis taken along with a rigid motion (4, 4)."""
        m = np.asarray(motion, float)
        if (
            m.shape != (4, 4)
            or abs(m[:3, :3] @ m[:3, :3].T - np.eye(3)).max() > _ORTHOGONAL
            or np.linalg.det(m[:3, :3]) < 0
        ):
            raise LinkageError("expected a rigid motion, a 4 x 4 matrix with a rotation in it")

        def turned(v: Vector | None) -> Vector | None:
            return None if v is None else _vector(m[:3, :3] @ v)

        shift = np.zeros(3) if self.mechanism.chain.space is Space.SPHERICAL else m[:3, 3]
        places = [
            replace(p, at=_vector(m[:3, :3] @ p.at + shift), x=turned(p.x), y=turned(p.y), z=turned(p.z))
            for p in self.places
        ]
        points = {n: (link, *(m[:3, :3] @ at + shift).tolist()) for n, (link, at) in self.points.items()}
        bodies = {
            name: replace(body, at=_vector(m[:3, :3] @ body.at + shift), z=_vector(m[:3, :3] @ body.z))
            for name, body in self.round_bodies.items()
        }
        return self._changed(tuple(places), points, bodies)

    def scaled(self, factor: float) -> SpatialLinkage:
        """Every length times a positive factor."""
        if not 0 < factor < 1e100:
            raise LinkageError("a scale is a positive number, not {factor!r}", factor=factor)
        angles = self.mechanism.chain.space is Space.SPHERICAL

        def radii(p: JointPlace) -> tuple[float, float] | None:
            return p.radii if p.radii is None or angles else (factor * p.radii[0], factor * p.radii[1])

        places = [
            replace(p, at=_vector(factor * np.array(p.at)), pitch=factor * p.pitch, radii=radii(p)) for p in self.places
        ]
        points = {n: (link, *(factor * np.array(at)).tolist()) for n, (link, at) in self.points.items()}
        bodies = {
            name: replace(
                body,
                at=_vector(factor * np.array(body.at)),
                radius=factor * body.radius,
                length=factor * body.length,
            )
            for name, body in self.round_bodies.items()
        }
        return self._changed(tuple(places), points, bodies)

    def with_points(self, points: Mapping[str, Sequence[object]]) -> SpatialLinkage:
        """The same linkage with these named points (link, x, y, z) besides its own."""
        own = {name: (link, *at) for name, (link, at) in self.points.items()}
        return self._changed(self.places, own | dict(points), self.round_bodies)

    def with_drives(self, drives: Iterable[int | str]) -> SpatialLinkage:
        """The same linkage with other drives."""
        mechanism = Mechanism(self.mechanism.chain, self.mechanism.frame, drives)
        own = {name: (link, *at) for name, (link, at) in self.points.items()}
        return SpatialLinkage(
            mechanism, self.places, unit=self.unit, points=own, outputs=self.outputs, round_bodies=self.round_bodies
        )

    def _changed(
        self,
        places: tuple[JointPlace, ...],
        points: Mapping[str, Sequence[object]],
        bodies: Mapping[str, TurnedBody],
    ) -> SpatialLinkage:
        return SpatialLinkage(
            self.mechanism, places, unit=self.unit, points=points, outputs=self.outputs, round_bodies=bodies
        )

    def _identity(self) -> tuple[object, ...]:
        points = tuple(sorted(self.points.items()))
        bodies = tuple(sorted(self.round_bodies.items()))
        return self.mechanism.written_form, self.places, self.unit, points, self.outputs, bodies

    def __repr__(self) -> str:
        places = ("(" + ", ".join(f"{number:.6g}" for number in place.at) + ")" for place in self.places)
        return f"<{self.mechanism.chain.space} linkage {self.mechanism.text()}; {' '.join(places)}>"


def _point(mechanism: Mechanism, name: str, raw: Sequence[object]) -> tuple[str, Vector]:
    given = list(raw) if isinstance(raw, Sequence) and not isinstance(raw, str) else [None]
    link, *at = given
    if not isinstance(link, str) or len(at) != 3:
        raise LinkageError("{name}: expected a link and three coordinates, but found {raw!r}", name=name, raw=raw)
    link_number(link, mechanism.chain.links)
    numbers = [float(x) for x in at if isinstance(x, int | float | np.number) and isfinite(x)]
    if len(numbers) != 3:
        raise LinkageError("{name}: a point has finite coordinates, not {raw!r}", name=name, raw=raw)
    return link, (numbers[0], numbers[1], numbers[2])


def _vector(v: Reals) -> Vector:
    x, y, z = v.tolist()
    return x, y, z
