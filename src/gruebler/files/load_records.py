"""What stands in the table ``[loads]`` of a linkage's file: the keys, quantities as texts with their units.

Lengths and places are in the unit of the file, angles in degrees, as everywhere in it; docs/theory/linkage-files.md.
"""

from __future__ import annotations

from typing import Any

import msgspec


class BodyRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The mass of a link: given, or of a bar, a disc or a plate."""

    mass: Any = None
    centre: Any = None
    inertia: Any = None
    about: Any = None
    bar: Any = None
    disc: float | None = None
    plate: list[Any] | None = None
    thickness: float | None = None
    density: Any = None


class LawRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A load that varies: a formula, or a curve of a variable."""

    unit: str
    formula: str | None = None
    curve: list[tuple[float, float]] | None = None
    of: str | None = None
    of_unit: str | None = None
    period: float | None = None


class GasRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A gas spring."""

    force: Any
    extended: float
    stroke: float
    growth: float = 1.3


SPRING = {"stiffness": "stiffness", "preload": "force", "damping": "damping"}
"""What the numbers of a spring are."""
TORSION_SPRING = {"stiffness": "torsional stiffness", "preload": "moment", "damping": "torsional damping"}


class SpringRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A spring or damper between two points."""

    between: tuple[str, str]
    stiffness: Any = None
    free_length: float = 0.0
    preload: Any = None
    damping: Any = None
    gas: GasRecord | None = None
    law: LawRecord | None = None


class TorsionSpringRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A torsion spring or damper between two links."""

    between: tuple[str, str]
    stiffness: Any = None
    free_angle: Any = 0.0
    preload: Any = None
    damping: Any = None
    law: LawRecord | None = None


class MotorRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A motor whose torque falls in a straight line."""

    stall: Any
    idle_speed: Any


class LoadsRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The table ``[loads]``."""

    assumed: bool = False
    """Whether its numbers are chosen, not known."""
    source: str = ""
    """Where they are printed."""
    speed: Any = None
    """At which the drive usually runs."""
    gravity: list[Any] | None = None
    bodies: dict[str, Any] = {}
    masses: dict[str, Any] = {}
    forces: dict[str, Any] = {}
    moments: dict[str, Any] = {}
    springs: list[SpringRecord] = []
    torsion_springs: list[TorsionSpringRecord] = []
    motors: dict[str, Any] = {}
