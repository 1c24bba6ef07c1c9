"""What the page shows of forces: torque and joint forces over the range of a drive, and how the linkage falls."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, pi
from typing import Any, NamedTuple

import msgspec
import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, joined, message
from gruebler.base.units import metres_of
from gruebler.files import linkage_from_json
from gruebler.files.catalog_records import renamed_loads
from gruebler.files.load_reading import loads_of_document
from gruebler.mechanics.dynamics import inverse_dynamics, simulate
from gruebler.mechanics.forces import Loads, RigidBody, Spring, TorsionSpring
from gruebler.mechanics.forces.springs import check_between_links
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.page.model import link_names
from gruebler.page.params import LoadedLinkage, OuterLoad, OwnSpring
from gruebler.structure.chain.pairs import Alphabet
from gruebler.teaching.catalog import entries

_BESIDES = message("From the file or the catalog, loads or masses act on {places}.")
_FREE = message("Free motion: in {seconds:n} s the drive goes from {start} to {end}.")
_BALANCE = message("The energy balance is off by {part:n} % at most.")
_NOTHING = message("Nothing acts yet: type masses or loads.")
_FROM_FILE = message("Masses as in the file or the catalog.")
_STEEL = message("Steel, bars 20 mm × 5 mm to each joint, sliders 20 mm long")
_ASSUMED = message("Assumed masses: steel, bars 20 mm × 5 mm to each joint, sliders 20 mm long")
_STEEL_BAR = 7850 * 0.020 * 0.005  # kg/m: a cross-section of 20 mm by 5 mm
_RATES = ("stiffness", "preload", "damping")
_BLOCK = 0.020  # m: what a slider and other short links are long
_ROWS = 720  # of a turn, so that what is read between two has four digits
_MOST_ROWS = 2160
_NO_ENDS = 0.02  # of a range, at either end: no drive keeps its speed up to where it turns back
_USUAL = 2 * pi  # of a drive, rad/s or sizes a second: one turn
_A_SECOND = 60  # poses of a free motion
_ENOUGH = 1e-6  # of each of its steps: for the eye


class _Laden(NamedTuple):
    """A linkage with what acts on it, its links by their names in the reader's language."""

    linkage: Linkage
    loads: Loads
    speed: float | None
    besides: tuple[str, ...]
    """On what loads and masses act that the reader has not given, and the form does not show."""


def forces_record(asked: LoadedLinkage, lang: str) -> dict[str, Any]:
    """Effort of the drive and forces of the joints over a range of the drive that runs at constant speed.

    Without anything that acts only masses are there.
    """
    linkage, loads, usual, besides = _laden(asked, lang)
    record: dict[str, Any] = {"masses": _masses(linkage, loads)}
    own = asked.springs
    record["springs"] = _springs(linkage, loads) if own is None else msgspec.to_builtins(own)
    record["speed"] = asked.speed or usual
    record["origin"] = _origin(asked, record["masses"]).in_language(lang)
    record["besides"] = _BESIDES.filled(places=joined(besides)).in_language(lang) if besides else ""
    pulling = any(each.law or each.stiffness or each.preload or each.damping for each in _all_springs(loads))
    if not (loads.bodies or loads.masses or loads.forces or loads.moments or pulling):
        return record | {"lines": [_NOTHING.in_language(lang)]}
    active, (low, high) = asked.active, asked.range
    turning = linkage.mechanism.drives[active].turning
    speed = record["speed"] or (_USUAL if turning else _USUAL * linkage.size)
    if not asked.full:
        low, high = low + _NO_ENDS * (high - low), high - _NO_ENDS * (high - low)
    turns = abs(high - low) / (2 * pi) if turning else 1.0
    values = np.linspace(low, high, 1 + min(_MOST_ROWS, max(_ROWS // 2, round(_ROWS * turns))))
    rows, speeds = np.tile(np.array(asked.drives), (len(values), 1)), np.zeros(len(asked.drives))
    rows[:, active], speeds[active] = values, speed
    motion = move_quietly(linkage, rows, speed=speeds, order=2)
    if not len(motion):
        raise GrueblerError("{message}", message=motion.message(lang))
    run = inverse_dynamics(motion, loads, times=(motion.drives[:, active] - values[0]) / speed)
    chain = linkage.mechanism.chain
    forces = [
        {"joint": number, "link": chain.index(link), "force": _short(run.statics.force(number, link=link)).T.tolist()}
        for number, each in enumerate(chain.joints)
        for link in (each.links if len(each.links) > 2 else each.links[1:])
    ]
    lines = [*run.remarks(lang)]
    scale = _moment_scale(linkage) if turning else 1.0
    power = _short(metres_of(linkage.unit) * np.append(run.power[:, active], run.mean_power[active]))
    return record | {
        "speed": speed,
        "drives": motion.drives[:, active].tolist(),
        "effort": _short(scale * run.drive[:, active]).tolist(),
        "effective": float(scale * run.root_mean_square[active]),
        "power": [float(max(power[:-1], key=abs)), float(power[-1])],
        "forces": forces,
        "lines": lines,
    }


def fall_record(asked: LoadedLinkage, lang: str) -> dict[str, Any]:
    """Poses of all links and values of the drives, sixty a second, when only weights and springs act.

    And why they end if they do too soon.
    """
    linkage, loads, *_ = _laden(asked, lang)
    free = replace(loads, forces={}, moments={}, motors={})
    times = np.arange(round(asked.until * _A_SECOND) + 1) / _A_SECOND
    run = simulate(linkage, free, at=asked.drives, until=asked.until, times=times, tolerance=_ENOUGH)
    start, end = (_drive_texts(linkage, run.drives[row]) for row in (0, -1))
    said = [
        _FREE.filled(seconds=float(run.times[-1]), start=start, end=end),
        _BALANCE.filled(part=float(f"{100 * run.defect:.2g}")),
    ]
    places = np.stack([run.places[0].real, run.places[0].imag], axis=-1)
    turns = np.stack([run.turns.real, run.turns.imag], axis=-1)
    return {
        "rate": _A_SECOND,
        "places": _short(places).reshape(len(run), -1).tolist(),
        "turns": _short(turns).reshape(len(run), -1).tolist(),
        "drives": _short(run.drives).tolist(),
        "lines": [*(line.in_language(lang) for line in said), *filter(None, [run.message(lang)])],
    }


def _drive_texts(linkage: Linkage, values: Reals) -> Message:
    """Drive values without the names of their joints, turning ones in degrees."""
    turned, shifted = message("{value:n}°"), message("{value:n} {unit}")
    drives = zip(linkage.mechanism.drives, values.tolist(), strict=True)
    return joined(
        turned.filled(value=degrees(value)) if drive.turning else shifted.filled(value=value, unit=linkage.unit)
        for drive, value in drives
    )


def _laden(asked: LoadedLinkage, lang: str) -> _Laden:
    """Loads of the document, or of the catalog entry while its links are there; in their place what the reader gave."""
    plain = linkage_from_json(asked.document)
    names_in = link_names(plain, asked.source, lang)
    linkage = plain.renamed(names_in)
    links, loads, speed = linkage.mechanism.chain.links, Loads(), None
    entry = entries().get(asked.source)
    if table := asked.document.get("loads"):
        loads, speed = loads_of_document({"loads": renamed_loads(table, names_in)}, linkage)
    elif entry is not None and entry.loads is not None and entry.chain().links == plain.mechanism.chain.links:
        _, loads, speed = entry.in_language(lang).loaded()
    bodies = dict(loads.bodies)
    for link, mass in zip(links, _assumed(linkage) if asked.steel else asked.masses, strict=False):
        if mass is None:
            continue
        known = bodies.pop(link, None)
        if mass and known is not None and known.mass:
            bodies[link] = RigidBody(mass, known.centre, known.inertia * mass / known.mass)
        elif mass:
            bodies[link] = _spread(mass, linkage, link)
    forces, moments, weights = dict(loads.forces), dict(loads.moments), loads.masses
    names = {"point": [*linkage.points], "joint": linkage.mechanism.chain.joint_names(), "link": links}
    placed: dict[str, list[OuterLoad]] = {}
    for own in asked.loads:
        if own.number >= len(names[own.on]):
            raise GrueblerError("load: there is no {what} {number}", what=own.on, number=own.number)
        placed.setdefault(names[own.on][own.number], []).append(own)
    chain = linkage.mechanism.chain
    called = dict(zip(chain.joint_names(), chain.joint_names(Alphabet.of_language(lang)), strict=True))
    others = [each for each in dict.fromkeys((*forces, *moments, *weights)) if each not in placed]
    besides = tuple(called.get(str(each), str(each)) for each in others)
    for name, together in placed.items():
        if together[0].on == "link":
            moments[name] = sum(own.x for own in together) / _moment_scale(linkage)
        else:
            forces[name] = (sum(own.x for own in together), sum(own.y for own in together))
    gravity = loads.gravity if asked.gravity else (0.0, 0.0)
    if asked.springs is not None:
        loads = _own_springs(linkage, loads, asked.springs)
    forces = {name: force for name, force in forces.items() if force != (0.0, 0.0)}
    moments = {name: moment for name, moment in moments.items() if moment != 0.0}
    acting = replace(loads, forces=forces, moments=moments, gravity=gravity, bodies=bodies)
    return _Laden(linkage, acting, speed, besides)


def _moment_scale(linkage: Linkage) -> float:
    """How many of the moments of the page one of the linkage is: N·mm beside millimetres, beside other units N·m."""
    return 1.0 if linkage.unit in ("", "mm") else metres_of(linkage.unit)


def _all_springs(loads: Loads) -> tuple[Spring | TorsionSpring, ...]:
    return (*loads.springs, *loads.torsion_springs)


def _springs(linkage: Linkage, loads: Loads) -> list[dict[str, Any]]:
    """The springs, straight ones first, as the page sends them back."""
    chain = linkage.mechanism.chain
    records: list[dict[str, Any]] = []
    for known, spring in enumerate(_all_springs(loads)):
        turning = isinstance(spring, TorsionSpring)
        if isinstance(spring, TorsionSpring):
            free, ends = spring.free_angle, [(chain.index(link), 0.0, 0.0) for link in spring.between]
        else:
            free, places = spring.free_length, [linkage.points_named(end) for end in spring.between]
            pairs = ((near, far) for near in places[0] for far in places[1] if near.link != far.link)
            ends = [(chain.index(place.link), place.x, place.y) for place in next(pairs)]
        scale = _moment_scale(linkage) if turning else 1.0
        rates = {rate: scale * getattr(spring, rate) for rate in _RATES} | {"free": free}
        records.append({"turning": turning, "ends": ends, "known": None if spring.law is None else known, **rates})
    return records


def _own_springs(linkage: Linkage, loads: Loads, own: list[OwnSpring]) -> Loads:
    links = linkage.mechanism.chain.links
    known = _all_springs(loads)
    springs, torsion_springs = [], []
    for number, each in enumerate(own):
        for what, wanted, there_are in (
            ("link", max(end[0] for end in each.ends), links),
            ("spring", each.known, known),
        ):
            if wanted is not None and wanted >= len(there_are):
                raise GrueblerError("load: there is no {what} {number}", what=what, number=wanted)
        scale = _moment_scale(linkage) if each.turning else 1.0
        rates = {rate: getattr(each, rate) / scale for rate in _RATES}
        law = None if each.known is None else known[each.known].law
        (first, *here), (second, *there) = each.ends
        if each.turning:
            torsion = TorsionSpring((links[first], links[second]), free_angle=each.free, law=law, **rates)
            torsion_springs.append(torsion)
        else:
            ends = LinkPoint(links[first], *here), LinkPoint(links[second], *there)
            springs.append(Spring(ends, free_length=each.free, law=law, **rates))
            check_between_links(linkage, springs[-1], f"springs[{number}]")
    return replace(loads, springs=tuple(springs), torsion_springs=tuple(torsion_springs))


def _origin(asked: LoadedLinkage, masses: list[float]) -> Message:
    """Where the masses come from, or without any how they would be assumed."""
    if asked.steel or not any(masses):
        return _ASSUMED if asked.steel else _STEEL
    return message("") if asked.masses else _FROM_FILE


def _masses(linkage: Linkage, loads: Loads) -> list[float]:
    return [loads.bodies[link].mass if link in loads.bodies else 0.0 for link in linkage.mechanism.chain.links]


def _places(linkage: Linkage, link: str) -> list[complex]:
    """Where a link has its joints, each place once; of a bar its ends, also where only a point lies on one.

    Of a link with one joint the first points count. Points beside a bar are no part of it: they only draw curves.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> _places(FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}), "coupler")
    [0j, (70+0j)]
    >>> _places(FourBar(25, 70, 40, 70).linkage({"K": (140, 0)}), "coupler")
    [0j, (140+0j)]
    """
    near = 1e-9 * linkage.size
    places: list[complex] = []
    joints = [complex(e.x, e.y) for (_, owner), e in sorted(linkage.elements.items()) if owner == link]
    points = [complex(point.x, point.y) for point in linkage.points.values() if point.link == link]
    for place in [*joints, *points]:
        if (place in joints or len(places) < 2) and all(abs(place - other) > near for other in places):
            places.append(place)
    if len(places) < 2:
        return places
    along = (places[1] - places[0]) / abs(places[1] - places[0])
    seen = [(place - places[0]) / along for place in places + points]
    if any(abs(place.imag) > near for place in seen[: len(places)]):
        return places
    on_it = [place.real for place in seen if abs(place.imag) <= near]
    return [places[0] + along * end for end in (min(on_it), max(on_it))]


def _assumed(linkage: Linkage) -> list[float]:
    """The masses of links that are bars of steel from the middle of their joints to each of them; short ones blocks.

    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> _assumed(SliderCrank(40, 100).linkage())  # the slider: 7850 kg/m3, 20 mm by 20 mm by 5 mm
    [0.0, 0.0314, 0.0785, 0.0157]
    """
    metre = metres_of(linkage.unit)
    moving = [link for link in linkage.mechanism.chain.links if link != linkage.mechanism.frame]
    lengths = {link: metre * sum(abs(arm) for _, arm in _arms(linkage, link)) for link in moving}
    return [
        float(f"{_STEEL_BAR * max(lengths[link], _BLOCK):.3g}") if link in lengths else 0.0
        for link in linkage.mechanism.chain.links
    ]


def _arms(linkage: Linkage, link: str) -> list[tuple[complex, complex]]:
    """The middle of a link's places, and the way from there to each."""
    places = _places(linkage, link)
    middle = sum(places) / len(places)
    return [(middle, place - middle) for place in places]


def _spread(mass: float, linkage: Linkage, link: str) -> RigidBody:
    """A mass on thin rods from the middle of a link's places to each, by their lengths; with one place a point.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> _spread(1.2, FourBar(25, 70, 40, 70).linkage(), "coupler")  # a rod: m l²/12
    RigidBody(mass=1.2, centre=(35.0, 0.0), inertia=490.0)
    """
    arms = _arms(linkage, link)
    total = sum(abs(arm) for _, arm in arms)
    middle = (arms[0][0].real, arms[0][0].imag)
    if not total > 0:
        return RigidBody(mass, middle)
    rods = [
        RigidBody.bar(mass * abs(arm) / total, middle, (middle[0] + arm.real, middle[1] + arm.imag)) for _, arm in arms
    ]
    whole = rods[0]
    for rod in rods[1:]:
        whole = whole + rod
    return whole


def _short(values: Reals) -> Reals:
    """Seven digits of the largest: what is plotted and drawn."""
    largest = float(np.nanmax(np.abs(values), initial=0.0)) or 1.0
    digits = int(7 - np.floor(np.log10(largest)))
    return np.asarray(np.round(values, digits))
