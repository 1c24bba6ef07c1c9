"""The places of the wheels of a gear train: distances from sizes, directions chosen so that wheels do not overlap.

A train defines ratios only. Connected meshes with the same carrier are a *stage*; stages are drawn side by side, and a
link that is in two of them is drawn in both. Lengths: the pitch diameter is the size, so that the module is 1.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from gruebler.machines.gears import Mesh, Train
from gruebler.machines.gears.stages import central_links, mesh_groups, wheels_of

FRAME = "frame"
_APART = 1.7  # sums of radii: the distance of the axes of a belt
_CLOSE = 1e-6
_PER_SIZE = {"rack by pitch": 1 / math.tau, "rack": 1.0, "winch": 1.0}  # radius by size; of toothed wheels a half


@dataclass(frozen=True, slots=True, kw_only=True)
class StageWheel:
    """A wheel of a stage, in the reference pose."""

    link: str
    size: float
    """Teeth or radius as given; negative: internal (for a bevel wheel: seen from the other side)."""
    radius: float
    at: complex
    phase: float
    """The angle of the middle of a tooth, or of a space of an internal wheel; radians."""
    planet: bool = False
    """Whether it revolves with the carrier."""

    @property
    def internal(self) -> bool:
        """Whether its teeth point inwards."""
        return self.size < 0


class PlacedMesh(NamedTuple):
    """A mesh with the places of its axes."""

    mesh: Mesh
    a: complex
    b: complex
    radii: tuple[float, float]


@dataclass(kw_only=True)
class GearStage:
    """Wheels with axes on one carrier; the carrier's own axis is 0."""

    carrier: str
    meshes: list[Mesh]
    copies: int = 1
    """The number of equal planets."""
    wheels: list[StageWheel] = field(default_factory=list)
    placed: list[PlacedMesh] = field(default_factory=list)
    axes: dict[str, complex] = field(default_factory=dict)
    central: set[str] = field(default_factory=set)

    @property
    def is_bevel(self) -> bool:
        """Whether it is drawn unfolded into the plane."""
        return self.meshes[0].traits.crossing


def gear_stages(train: Train, planets: Mapping[str, int]) -> list[GearStage]:
    """The stages of a train with all wheels placed, ``planets`` with the numbers of equal planets.

    >>> from gruebler.machines.gears import read_train
    >>> (stage,) = gear_stages(read_train("sun:24 planet:18 ring:-60 on arm").train, {"planet": 3})
    >>> [(wheel.link, round(wheel.radius, 9), round(abs(wheel.at), 9)) for wheel in stage.wheels][:3]
    [('sun', 12.0, 0.0), ('planet', 9.0, 21.0), ('planet', 9.0, 21.0)]
    """
    stages = [GearStage(carrier=meshes[0].carrier, meshes=meshes) for meshes in mesh_groups(train.meshes)]
    for stage in stages:
        stage.copies = max((planets.get(link, 1) for mesh in stage.meshes for link in (mesh.a, mesh.b)), default=1)
        stage.central = central_links(stage.meshes, train)
        _place(stage)
        _wheels(stage)
    return stages


def _distance(mesh: Mesh) -> float:
    a, b = (abs(size) / 2 for _, size in wheels_of(mesh))
    if mesh.traits.belt:
        return _APART * (a + b)
    return a + b if mesh.traits.crossing else abs(float(mesh.size_a + mesh.size_b)) / 2


# --- axes ------------------------------------------------------------------------------------------


def _place(stage: GearStage) -> None:
    """All axes, one after another, each beside its mesh partners."""
    axes = stage.axes
    axes |= dict.fromkeys(sorted(stage.central) or [stage.meshes[0].a], 0j)
    flat = [mesh for mesh in stage.meshes if mesh.traits.wheels == 2]
    leads = _leads(stage, flat)
    while unplaced := [mesh for mesh in stage.meshes if any(link not in axes for link, _ in wheels_of(mesh))]:
        near = next((mesh for mesh in flat if (mesh.a in axes) != (mesh.b in axes)), None)
        if near is None:
            axes[unplaced[0].a] = _beside(stage, unplaced[0])
            continue
        known, link = (near.a, near.b) if near.a in axes else (near.b, near.a)
        circles = [
            (axes[other], _distance(mesh))
            for mesh in flat
            for other in (mesh.a, mesh.b)
            if link in (mesh.a, mesh.b) and other != link and other in axes
        ]
        if stage.central:
            axes[link] = _around(circles, axes[known], leads.get(link, 0.0), near)
        else:
            axes[link] = _clear(stage, near, known, link)


def _reach(stage: GearStage) -> dict[str, float]:
    """The greatest radius of each link."""
    reach: dict[str, float] = {}
    for mesh in stage.meshes:
        for link, size in wheels_of(mesh):
            radius = abs(size) * _PER_SIZE.get(mesh.kind, 0.5)
            reach[link] = max(reach.get(link, 0.0), radius)
    return reach


def _beside(stage: GearStage, mesh: Mesh) -> complex:
    """To the right of all others, its lowest point level with that of the first: a rack may lie below both."""
    reach, radius = _reach(stage), abs(float(mesh.size_a))
    first = next(iter(stage.axes))
    rightmost = max(at.real + reach.get(link, 0.0) for link, at in stage.axes.items())
    return complex(rightmost + 1.5 * radius, stage.axes[first].imag - reach.get(first, 0.0) + radius)


def _leads(stage: GearStage, flat: Sequence[Mesh]) -> dict[str, float]:
    """The directions of the planets that mesh with a central wheel: evenly, with space for their copies."""
    direct = dict.fromkeys(
        link for mesh in flat for link, partner in ((mesh.a, mesh.b), (mesh.b, mesh.a)) if partner in stage.central
    )
    lone = [link for link in direct if link not in stage.central]
    return {link: math.pi / 2 + math.tau * k / len(lone) / stage.copies for k, link in enumerate(lone)}


def _around(circles: list[tuple[complex, float]], known: complex, lead: float, mesh: Mesh) -> complex:
    """A planet's place on its circle about the hub, and at its distance from a placed planet."""
    hub = next((d for centre, d in circles if centre == 0), None)
    beside = next(((centre, d) for centre, d in circles if centre != 0), None)
    if hub is None:
        outward = known / abs(known) if known else 1 + 0j
        return known + outward * _distance(mesh)
    if beside is None:
        return cmath.rect(hub, lead)
    centre, d = beside
    cosine = (abs(centre) ** 2 + hub**2 - d**2) / (2 * abs(centre) * hub)
    turn = math.acos(cosine) if abs(cosine) < 1 else math.radians(50)
    return cmath.rect(hub, cmath.phase(centre) - turn)


def _clear(stage: GearStage, near: Mesh, known: str, link: str) -> complex:
    """Beside the known axis, to the right if that is free."""
    reach = _reach(stage)
    start, d = stage.axes[known], _distance(near)
    for direction in (1, -1j, 1j, -1):
        place = start + d * direction
        others = [link for link in stage.axes if link != known and link in reach]
        if all(abs(stage.axes[neighbour] - place) > reach[neighbour] + reach[link] - _CLOSE for neighbour in others):
            return place
    return start + d


# --- wheels ----------------------------------------------------------------------------------------


def _wheels(stage: GearStage) -> None:
    """A wheel for every side of a mesh, each once, its teeth in the spaces of its partner."""
    wheels: dict[tuple[str, float, complex], StageWheel] = {}
    for mesh in stage.meshes:
        sides = wheels_of(mesh)
        for copy in range(stage.copies if stage.central else 1):
            turn = cmath.exp(2j * math.pi * copy / stage.copies)
            places = [
                stage.axes[link] * (turn if stage.central and link not in stage.central else 1) for link, _ in sides
            ]
            distance, nominal = abs(places[-1] - places[0]), _distance(mesh) if len(sides) > 1 else 0.0
            unit = distance / nominal if nominal > _CLOSE and distance > _CLOSE else 1.0
            radii = [abs(size) * _PER_SIZE.get(mesh.kind, 0.5) * unit for _, size in sides]
            keys = [
                (link, round(radius, 6), complex(round(at.real, 6), round(at.imag, 6)))
                for (link, _), radius, at in zip(sides, radii, places, strict=True)
            ]
            known = [wheels.get(key) for key in keys]
            for k, ((link, size), radius, at) in enumerate(zip(sides, radii, places, strict=True)):
                if known[k] is None and mesh.traits.wheels:
                    mate = known[1 - k] if len(sides) > 1 else None
                    phase = _phase(mate, size, at) if mate and mesh.traits.spur else 0.0
                    planet = bool(stage.central) and link not in stage.central
                    known[k] = wheels[keys[k]] = StageWheel(
                        link=link, size=size, radius=radius, at=at, phase=phase, planet=planet
                    )
            stage.placed.append(PlacedMesh(mesh, places[0], places[-1], (radii[0], radii[-1])))
    stage.wheels = list(wheels.values())


def _phase(mate: StageWheel, size: float, at: complex) -> float:
    """The angle of a tooth, so that it lies in a space of its mate.

    External: the teeth counted from the line of centres sum to a half; internal: they are the same.
    """
    towards = cmath.phase(at - mate.at) if at != mate.at else 0.0
    a, b = abs(mate.size), abs(size)
    if mate.size < 0 or size < 0:
        line = towards if mate.size < 0 else cmath.phase(mate.at - at) if at != mate.at else 0.0
        return line - a * (line - mate.phase) / b
    other = towards + math.pi
    return other - math.tau / b * (0.5 - a * (towards - mate.phase) / math.tau)
