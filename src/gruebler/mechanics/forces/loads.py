"""Loads on a linkage: forces at points, moments on links, masses with their weights, springs and dampers, motors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import Any

from numpy.typing import ArrayLike

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.immutable import settle
from gruebler.mechanics.forces.bodies import RigidBody
from gruebler.mechanics.forces.laws import Law, LoadFormula
from gruebler.mechanics.forces.springs import Spring, TorsionSpring
from gruebler.mechanics.linkages.points import PointLike

STANDARD_GRAVITY = 9.80665

Amount = ArrayLike | Law
"""A number, one for each row, a text that is an `LoadFormula`, or a `Law`."""


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class Loads:
    """What acts on a linkage, in coordinates of the plane, and the masses that it moves.

    A force at a joint acts on the link of that joint that `Motion.point` looks at; to choose the link give a
    `LinkPoint`. Lengths are in the linkage's unit; forces in newtons, masses in kilograms, times in seconds, angles in
    radians.

    >>> Loads(forces={"K": (0, -100)}, moments={"rocker": 5}).moments
    {'rocker': 5}
    >>> Loads(forces={"K": ("-200*where(vx < 0, 1, 0)", 0)}, bodies={"crank": RigidBody(2.0, (30, 0), 600.0)}).gravity
    (0.0, -9.80665)

    See Also:
        `RigidBody`, `Spring`, `Motor`, `statics`, `inverse_dynamics`, `simulate`

    Theory:
        docs/theory/statics.md
    """

    forces: Mapping[PointLike, Any] = field(default_factory=dict)
    """By point or joint: (x, y), or one for each row, (rows, 2); each of both may be a text or a `Law`."""
    _: KW_ONLY
    moments: Mapping[str, Any] = field(default_factory=dict)
    """By link, counter-clockwise, in force times the linkage's unit: a number, or (rows,), a text, a `Law`."""
    masses: Mapping[PointLike, ArrayLike] = field(default_factory=dict)
    """By point or joint: each weighs its mass times ``gravity``."""
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    """Force for each unit of mass: metres a second squared for kilograms and newtons."""
    bodies: Mapping[str, RigidBody] = field(default_factory=dict)
    """By link: its mass, which weighs, and in `dynamics` is moved."""
    springs: tuple[Spring, ...] = ()
    torsion_springs: tuple[TorsionSpring, ...] = ()
    motors: Mapping[str, Any] = field(default_factory=dict)
    """By driven joint: its torque as a `Law` of the speed; only free motion asks it."""

    def __post_init__(self) -> None:
        pairs = [part for pair in self.forces.values() if isinstance(pair, tuple | list) for part in pair]
        for text in (*pairs, *self.moments.values(), *self.motors.values()):
            if isinstance(text, str):
                LoadFormula(text)
        settle(self, springs=tuple(self.springs), torsion_springs=tuple(self.torsion_springs))

    def switched(self) -> Loads:
        """The same with every text a `SwitchedLaw`."""

        def held(given: Any) -> Any:
            if isinstance(given, tuple | list):
                return tuple(map(held, given))
            law = LoadFormula(given) if isinstance(given, str) else given
            return law.switched() if isinstance(law, LoadFormula) else law

        forces = {
            name: held(given) if isinstance(given, tuple | list) else given for name, given in self.forces.items()
        }
        moments, motors = ({name: held(law) for name, law in part.items()} for part in (self.moments, self.motors))
        return replace(self, forces=forces, moments=moments, motors=motors)
