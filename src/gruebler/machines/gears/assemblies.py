"""Assembly of planets: coaxial wheels, equal spacing, neighbours that do not touch; docs/theory/gears.md."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from gruebler.machines.gears.train import FRAME, GearError, Mesh, Train


@dataclass(frozen=True, slots=True, kw_only=True)
class Assembly:
    """Equal planets (all wheels of one module, without profile shift) on one carrier."""

    carrier: str
    planet: str
    number: int
    coaxial: bool
    """Whether all central wheels have their axes at the same distance from the planets: z_ring = z_sun + 2 z_planet."""
    spacing: Fraction
    """The least angle between places of planets, in turns; any multiple is possible. 0: any angle is possible."""
    clear: bool
    """Whether the tip circles of neighbours (addendum one module) stay apart at equal spacing."""

    @property
    def evenly(self) -> bool:
        """Whether equal spacing is possible: (z_sun + z_ring) / number whole for simple planets."""
        return not self.spacing or (Fraction(1, self.number) / self.spacing).denominator == 1

    @property
    def possible(self) -> bool:
        """Whether all three conditions hold."""
        return self.coaxial and self.evenly and self.clear


def assembly(train: Train, planet: str, number: int) -> Assembly:
    """The conditions of assembly for a number of equal planets at equal angles.

    The planet must mesh with two central wheels on one moving carrier, with whole tooth numbers; its two wheels may
    differ (stepped planets), with the same relative position of their teeth on every planet.

    >>> from gruebler.machines.gears import read_train
    >>> train = read_train("sun:24 planet:18 ring:-60 on arm").train
    >>> assembly(train, "planet", 3).possible, assembly(train, "planet", 5).evenly, assembly(train, "planet", 7).clear
    (True, False, False)
    """
    if not isinstance(number, int) or isinstance(number, bool) or number < 1:
        raise GearError("planets: expected a whole number, at least 1, not {number!r}", number=number)
    train.known(planet)
    meshes = [_from(mesh, planet) for mesh in train.meshes if planet in (mesh.a, mesh.b) and mesh.carrier != FRAME]
    meshes = [mesh for mesh in meshes if mesh.traits.spur]
    carriers = {mesh.carrier for mesh in meshes}
    if len(meshes) != 2 or len(carriers) != 1:
        raise GearError(
            "{planet} is not a planet between two gears on one moving carrier: no conditions of assembly are known",
            planet=planet,
        )
    if any(mesh.size_a.denominator != 1 or mesh.size_b.denominator != 1 for mesh in meshes):
        raise GearError(
            "the conditions of assembly need whole tooth numbers on {planet} and its partners", planet=planet
        )
    distances = {abs(mesh.size_a + mesh.size_b) for mesh in meshes}
    tip = max(mesh.size_a for mesh in meshes) + 2
    apart = min(distances) * math.sin(math.pi / number) > tip if number > 1 else True
    return Assembly(
        carrier=carriers.pop(),
        planet=planet,
        number=number,
        coaxial=len(distances) == 1,
        spacing=_spacing(*meshes),
        clear=bool(apart),
    )


def _from(mesh: Mesh, planet: str) -> Mesh:
    """The mesh with the planet as its first link."""
    if mesh.a == planet:
        return mesh
    return Mesh(a=mesh.b, b=mesh.a, size_a=mesh.size_b, size_b=mesh.size_a, carrier=mesh.carrier, kind=mesh.kind)


def _spacing(mesh: Mesh, other_mesh: Mesh) -> Fraction:
    """In turns: centrals a, b and planet teeth p, q fit again after gcd(p, q) / |a q - b p| of a turn."""
    p, a, q, b = (int(size) for size in (mesh.size_a, mesh.size_b, other_mesh.size_a, other_mesh.size_b))
    return Fraction(math.gcd(p, q), abs(a * q - b * p)) if a * q != b * p else Fraction(0)


@dataclass(frozen=True, slots=True)
class Axes:
    """The centre distances of a planet's wheels and their partners: equal if the partners are coaxial."""

    carrier: str
    planet: str
    meshes: tuple[Mesh, ...]
    """Its meshes with the central wheels, the planet first."""

    @property
    def distances(self) -> tuple[Fraction, ...]:
        """Of each partner's axis from the planet's, in half modules."""
        return tuple(abs(mesh.size_a + mesh.size_b) for mesh in self.meshes)

    @property
    def coaxial(self) -> bool:
        """Whether the partners can have one axis, for wheels of one module without profile shift."""
        return len(set(self.distances)) == 1


def axes(train: Train) -> tuple[Axes, ...]:
    """The planets between central wheels, with the centre distances from the tooth numbers.

    A wheel counts as a planet where the gear meshes on a moving carrier are unambiguous: a wheel all of whose
    partners have no other mesh there, or wheels that all mesh with the same two others.

    >>> from gruebler.machines.gears import read_train
    >>> [(planet.planet, planet.coaxial) for planet in axes(read_train("sun:24 planet:17 ring:-60 on arm").train)]
    [('planet', False)]
    """
    planet_axes = []
    for carrier in dict.fromkeys(mesh.carrier for mesh in train.meshes if mesh.carrier != FRAME):
        meshes = [mesh for mesh in train.meshes if mesh.carrier == carrier and mesh.traits.spur]
        partners: dict[str, set[str]] = {}
        for mesh in meshes:
            partners.setdefault(mesh.a, set()).add(mesh.b)
            partners.setdefault(mesh.b, set()).add(mesh.a)
        by_centres: dict[frozenset[str], set[str]] = {}
        for planet, centres in partners.items():
            by_centres.setdefault(frozenset(centres), set()).add(planet)
        for planet, centres in partners.items():
            alike = by_centres[frozenset(centres)]
            star = len(alike) == 1 and all(partners[centre] == {planet} for centre in centres)
            ring = len(alike) > 1 and len(centres) == 2 and all(partners[centre] == alike for centre in centres)
            if len(centres) > 1 and (star or ring):
                planet_meshes = (_from(mesh, planet) for mesh in meshes if planet in (mesh.a, mesh.b))
                planet_axes.append(Axes(carrier, planet, tuple(planet_meshes)))
    return tuple(planet_axes)


def even_numbers(train: Train, planet: str, most: int = 12) -> tuple[int, ...]:
    """The possible numbers of equal planets at equal angles, from 2 to ``most``; empty if they are not known.

    >>> from gruebler.machines.gears import read_train
    >>> even_numbers(read_train("sun:24 planet:18 ring:-60 on arm").train, "planet")
    (2, 3, 4, 6)
    """
    try:
        return tuple(number for number in range(2, most + 1) if assembly(train, planet, number).possible)
    except GearError:
        return ()
