"""The linkage given by the screws of its joints in one position."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.immutable import Immutable, settle
from gruebler.mechanics.screws.joint_places import JointPlace, Vector, joint_axes, read_place
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

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

    Raises:
        LinkageError: a joint without a place, an axis that its pair needs and that is missing, numbers that are not
            finite.

    >>> winch = Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut)")
    >>> axis = {"z": (0, 0, 1)}
    >>> SpatialLinkage(winch, {0: axis, 1: axis | {"pitch": 0.8}, 2: {"x": (0, 0, 1), "at": (0, 5, 0)}}).size
    3.33...
    """

    mechanism: Mechanism
    places: tuple[JointPlace, ...]
    """The joints in the reference pose, in the order of the chain."""
    unit: str

    @door_that_raises(LinkageError)
    def __init__(
        self,
        mechanism: Mechanism,
        joints: Mapping[str | int, object] | tuple[JointPlace, ...],
        unit: str = "mm",
    ) -> None:
        chain = mechanism.chain
        names = chain.joint_names()
        given = joints if isinstance(joints, Mapping) else dict(enumerate(joints))
        raw: dict[int, object] = {}
        for key, value in given.items():
            raw[chain.joint_number(key, LinkageError)] = value
        for number, name in enumerate(names):
            if number not in raw:
                raise LinkageError("{name} has no place", name=name)
        places = tuple(read_place(raw[k], joint.pair, chain.space, names[k]) for k, joint in enumerate(chain.joints))
        settle(self, mechanism=mechanism, places=places, unit=unit)

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
        return SpatialLinkage(self.mechanism, tuple(places), self.unit)

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
        return SpatialLinkage(self.mechanism, tuple(places), self.unit)

    def _identity(self) -> tuple[object, ...]:
        return self.mechanism, self.places, self.unit

    def __repr__(self) -> str:
        places = ("(" + ", ".join(f"{number:.6g}" for number in place.at) + ")" for place in self.places)
        return f"<{self.mechanism.chain.space} linkage {self.mechanism.text()}; {' '.join(places)}>"


def _vector(v: Reals) -> Vector:
    x, y, z = v.tolist()
    return x, y, z
