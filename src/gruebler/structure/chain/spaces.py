"""The spaces in which links move, and the freedoms of joints in them.

A space has ``b`` motion directions. What a freedom of a joint is there follows from the space: on a sphere a travel is
a turn about another axis.
"""

from __future__ import annotations

from enum import StrEnum

from gruebler.base.text import Message, message


class Freedom(StrEnum):
    """One freedom of a joint: a turn about an axis of the joint, a travel along one, or a screw."""

    TURN_X = "Rx"
    TURN_Y = "Ry"
    TURN_Z = "Rz"
    TRAVEL_X = "Tx"
    TRAVEL_Y = "Ty"
    TRAVEL_Z = "Tz"
    SCREW_X = "Hx"
    SCREW_Y = "Hy"
    SCREW_Z = "Hz"

    @property
    def axis(self) -> str:
        """The axis about which it turns or along which it travels: ``x``, ``y`` or ``z``."""
        return self[1]

    @property
    def turns(self) -> bool:
        """Whether it turns the links against each other, so that its value is an angle: a turn or a screw."""
        return not self.travels

    @property
    def travels(self) -> bool:
        """Whether it shifts the links without turning them, so that its value is a length."""
        return self[0] == "T"

    @property
    def has_pitch(self) -> bool:
        """Whether it couples a turn with a travel along the same axis."""
        return self[0] == "H"

    @property
    def turn(self) -> Freedom:
        """The turn about its axis."""
        return Freedom("R" + self.axis)

    @property
    def travel(self) -> Freedom:
        """The travel along its axis."""
        return Freedom("T" + self.axis)

    def twist(self, pitch: float = 0.0) -> tuple[float, ...]:
        """Its screw as a twist: three components of the turn, three of the shift, in the joint's axes.

        >>> Freedom.SCREW_Z.twist(0.5)
        (0.0, 0.0, 1.0, 0.0, 0.0, 0.5)
        """
        along = 1.0 if self.travels else pitch if self.has_pitch else 0.0
        return tuple(
            value if axis == self.axis else 0.0 for value in (float(self.turns), along) for axis in ("x", "y", "z")
        )

    def __repr__(self) -> str:
        return repr(str(self))


class Space(StrEnum):
    """The space in which the links move: a plane, a sphere about a fixed point, or three-dimensional space."""

    PLANAR = "planar"
    SPHERICAL = "spherical"
    SPATIAL = "spatial"

    @property
    def b(self) -> int:
        """The number of motion directions of a free link: 3, 3 or 6."""
        return len(self.directions)

    @property
    def directions(self) -> tuple[Freedom, ...]:
        """The motion directions of a free link, in the order used for twists everywhere."""
        return _DIRECTIONS[self]

    def seen(self, freedom: Freedom) -> Freedom:
        """What a freedom of a joint is in this space.

        On a sphere the joint's z axis points away from the centre, so that the travel along x is a turn about y.

        >>> Space.SPHERICAL.seen(Freedom.TRAVEL_X)
        'Ry'
        """
        return _ON_SPHERE.get(freedom, freedom) if self is Space.SPHERICAL else freedom

    @property
    def adjective(self) -> Message:
        """The adjective for a chain in this space, for messages."""
        return _ADJECTIVES[self]

    @property
    def greatest_freedom(self) -> int:
        """The most freedoms that still make a joint: b - 1."""
        return self.b - 1


_DIRECTIONS = {
    Space.PLANAR: (Freedom.TURN_Z, Freedom.TRAVEL_X, Freedom.TRAVEL_Y),
    Space.SPHERICAL: (Freedom.TURN_X, Freedom.TURN_Y, Freedom.TURN_Z),
    Space.SPATIAL: (
        *(Freedom.TURN_X, Freedom.TURN_Y, Freedom.TURN_Z),
        *(Freedom.TRAVEL_X, Freedom.TRAVEL_Y, Freedom.TRAVEL_Z),
    ),
}
_ON_SPHERE = {Freedom.TRAVEL_X: Freedom.TURN_Y, Freedom.TRAVEL_Y: Freedom.TURN_X}


_ADJECTIVES = {
    Space.PLANAR: message("planar"),
    Space.SPHERICAL: message("spherical"),
    Space.SPATIAL: message("spatial"),
}
