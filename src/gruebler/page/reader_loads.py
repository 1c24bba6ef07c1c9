"""What acts on a linkage of the page: loads of its document or catalog entry, and what the reader changed of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import log, pi
from typing import Any, NamedTuple

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, joined, joined_by_and, message
from gruebler.base.units import metres_of
from gruebler.files import linkage_from_json
from gruebler.files.catalog_records import renamed_loads
from gruebler.files.load_reading import loads_from_json
from gruebler.files.load_writing import loads_to_json
from gruebler.mechanics.forces import Curve, LoadFormula, Loads, RigidBody, Spring, TorsionSpring
from gruebler.mechanics.forces.springs import check_between_links
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.page.known_loads import RATES, all_springs, loads_at_hand, spring_ends
from gruebler.page.model import link_names
from gruebler.page.params import LoadedLinkage, OuterLoad, OwnSpring
from gruebler.structure.chain.pairs import Alphabet

_POINT_MASSES = message("There are further masses at {places}.")
_FROM_CATALOG = message("Masses as in the catalog.")
_ASSUMED = message(
    "Assumed masses: steel, bars {wide:n} mm × {thick:n} mm to each joint, sliders {wide:n} mm long, "
    "wheels {thick:n} mm thick, in proportion to the longest link."
)
_BY_FORMULA = message("changes by a formula of {names}")
_BY_CURVE = message("changes by a curve over {names}")
_QUANTITIES = {
    **dict.fromkeys(("x", "y"), message("position")),
    **dict.fromkeys(("vx", "vy"), message("velocity")),
    "time": message("time"),
    "drive": message("drive"),
    "speed": message("drive speed"),
    "angle": message("angle"),
    "omega": message("angular velocity"),
}
_STEEL_DENSITY = 7850  # kg/m3
_WIDTHS = [k * power for power in (10, 100, 1000, 10000) for k in (1, 2, 5)][1:]  # of assumed bars, mm
_SLENDER = 25  # how much longer than its bar is wide the longest link is
_FLAT = 4  # how much wider than thick a bar is


class WithLoads(NamedTuple):
    """A linkage with what acts on it, its links by their names in the reader's language."""

    linkage: Linkage
    loads: Loads
    speed: float | None
    kept: dict[str, Any]
    """What the document is to keep of them, links by their names there: ``loads``, and the ``bars`` of the page."""


def with_loads(asked: LoadedLinkage, lang: str) -> WithLoads:
    """Loads of the document, or of the catalog entry while its links are there; in their place what the reader gave."""
    plain = linkage_from_json(asked.document)
    names = link_names(plain, asked.source, lang)
    loads, speed = loads_at_hand(asked.document, asked.source, plain)
    bodies, bars = _bodies(plain, loads, asked)
    loads = replace(loads, bodies=bodies)
    if asked.gravity is not None and asked.gravity != any(loads.gravity):
        loads = replace(loads, gravity=Loads().gravity if asked.gravity else (0.0, 0.0))
    if asked.loads is not None:
        loads = _own_loads(plain, loads, asked.loads)
    if asked.springs is not None:
        loads = _own_springs(plain, loads, asked.springs)
    if asked.speed and len(plain.mechanism.drives) == 1:
        speed = asked.speed
    table = loads_to_json(loads, plain, speed)
    linkage = plain.renamed(names)
    named = loads_from_json(renamed_loads(table, names), linkage)
    return WithLoads(linkage, named, speed, {"loads": table, "bars": bars})


def _bodies(linkage: Linkage, loads: Loads, asked: LoadedLinkage) -> tuple[dict[str, RigidBody], list[int] | str]:
    """The bodies of the links, and which of them lie along their bars."""
    links, bodies = linkage.mechanism.chain.links, dict(loads.bodies)
    steel = asked.bars == "steel" and not asked.masses
    given: Sequence[float | None] = _assumed(linkage) if steel else asked.masses
    bars = {*range(len(links))} if asked.bars == "steel" else {*asked.bars}
    for number, link in enumerate(links):
        known = bodies.get(link, RigidBody(0.0))
        mass = known.mass if number >= len(given) or given[number] is None else given[number]
        if number not in bars and mass == known.mass:
            continue
        if not mass:
            bodies.pop(link, None)
        elif known.mass and number not in bars:
            bodies[link] = RigidBody(mass, known.centre, known.inertia * mass / known.mass)
        else:
            bodies[link] = _spread(mass, linkage, link)
            bars.add(number)
    return bodies, "steel" if steel else sorted(number for number in bars if links[number] in bodies)


def amounts(loads: Loads) -> list[Any]:
    """Those of all forces, then of all moments."""
    return [*loads.forces.values(), *loads.moments.values()]


def _parts(amount: Any) -> tuple[Any, ...]:
    return tuple(amount) if isinstance(amount, tuple | list) else (amount,)


def by_law(amount: Any) -> bool:
    """Whether a load changes, in one of its parts."""
    return not all(isinstance(part, float | int) for part in _parts(amount))


def load_acts(amount: Any) -> bool:
    """Whether a load is none of nothing."""
    return by_law(amount) or any(_parts(amount))


def law_text(amount: Any) -> Message:
    """What a load depends on, if it is none that stays as it is."""
    laws = [part for part in _parts(amount) if not isinstance(part, float | int)]
    if not laws:
        return message("")
    formulas = [law for law in laws if isinstance(law, LoadFormula)]
    names = [name for law in formulas for name in law.names] or [law.of for law in laws if isinstance(law, Curve)]
    said = [_QUANTITIES[name] for name in names if name in _QUANTITIES]
    different = [each for k, each in enumerate(said) if each not in said[:k]]
    return (_BY_FORMULA if formulas else _BY_CURVE).filled(names=joined_by_and(different))


def outer_loads(linkage: Linkage, loads: Loads) -> list[OuterLoad]:
    """Forces, then moments, as the page sends them back."""
    chain, points = linkage.mechanism.chain, [*linkage.points]
    rows: list[OuterLoad] = []
    for number, (name, amount) in enumerate(zip([*loads.forces, *loads.moments], amounts(loads), strict=True)):
        known, (x, *rest) = (number, (0.0, 0.0)) if by_law(amount) else (None, _parts(amount))
        if number >= len(loads.forces):
            rows.append(OuterLoad("link", chain.index(str(name)), x * metres_of(linkage.unit), 0.0, known))
            continue
        joint = chain.find_joint(name) if isinstance(name, str) else None
        if name in points:
            rows.append(OuterLoad("point", points.index(name), x, rest[0], known))
        elif joint is None:
            rows.append(OuterLoad("place", number, x, rest[0], known))
        else:
            rows.append(OuterLoad("joint", joint, x, rest[0], known))
    return rows


def _own_loads(linkage: Linkage, loads: Loads, own: list[OuterLoad]) -> Loads:
    chain, given = linkage.mechanism.chain, amounts(loads)
    names: dict[str, Sequence[Any]] = {
        "point": [*linkage.points],
        "joint": chain.joint_names(),
        "link": chain.links,
        "place": [*loads.forces],
    }
    forces: dict[Any, Any] = {}
    moments: dict[str, Any] = {}
    for each in own:
        _check_number(each.on, each.number, names[each.on])
        _check_number("load", each.known, given)
        name, turns = names[each.on][each.number], each.on == "link"
        table: dict[Any, Any] = moments if turns else forces
        amount = None if each.known is None else given[each.known]
        if amount is None or isinstance(amount, tuple | list) == turns:
            own_parts = (each.x / metres_of(linkage.unit),) if turns else (each.x, each.y)
            before = table.get(name, 0.0 if turns else (0.0, 0.0))
            parts = own_parts if by_law(before) else tuple(map(sum, zip(_parts(before), own_parts, strict=True)))
            amount = parts[0] if turns else parts
        table[name] = amount
    return replace(loads, forces=forces, moments=moments)


def _check_number(what: str, number: int | None, there_are: Sequence[Any]) -> None:
    if number is not None and number >= len(there_are):
        raise GrueblerError("load: there is no {what} {number}", what=what, number=number)


def point_masses(linkage: Linkage, loads: Loads, lang: str) -> str:
    """That there are masses at points, which have no rows of their own."""
    chain = linkage.mechanism.chain
    called = dict(zip(chain.joint_names(), chain.joint_names(Alphabet.of_language(lang)), strict=True))
    places = joined([called.get(str(each), str(each)) for each in loads.masses])
    return _POINT_MASSES.filled(places=places).in_language(lang)


def _own_springs(linkage: Linkage, loads: Loads, own: list[OwnSpring]) -> Loads:
    links = linkage.mechanism.chain.links
    known = all_springs(loads)
    named = {spring_ends(linkage, each): each.between for each in loads.springs}  # ends that go with a point or a joint
    springs, torsion_springs = [], []
    for number, each in enumerate(own):
        _check_number("link", max(end[0] for end in each.ends), links)
        _check_number("spring", each.known, known)
        scale = metres_of(linkage.unit) if each.turning else 1.0
        rates = {rate: getattr(each, rate) / scale for rate in RATES}
        law = None if each.known is None else known[each.known].law
        (first, *here), (second, *there) = each.ends
        if each.turning:
            torsion = TorsionSpring((links[first], links[second]), free_angle=each.free, law=law, **rates)
            torsion_springs.append(torsion)
        else:
            places = LinkPoint(links[first], *here), LinkPoint(links[second], *there)
            ends = named.get(tuple(each.ends), places)
            springs.append(Spring(ends, free_length=each.free, law=law, **rates))
            check_between_links(linkage, springs[-1], f"springs[{number}]")
    return replace(loads, springs=tuple(springs), torsion_springs=tuple(torsion_springs))


def origin_of_masses(linkage: Linkage, asked: LoadedLinkage, masses: list[float]) -> Message:
    """Where the masses come from, or without any how they would be assumed."""
    assumed = asked.bars == "steel" and not asked.masses
    if assumed or not any(masses):
        wide = _assumed_width(linkage)
        return _ASSUMED.filled(wide=wide, thick=wide / _FLAT)
    return message("") if asked.masses or asked.document.get("loads") else _FROM_CATALOG


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


def _lengths(linkage: Linkage) -> dict[str, float]:
    """How long the bars of each moving link are together, in metres."""
    metre, mechanism = metres_of(linkage.unit), linkage.mechanism
    moving = [link for link in mechanism.chain.links if link != mechanism.frame]
    return {link: metre * sum(abs(arm) for _, arm in _arms(linkage, link)) for link in moving}


def _radius(linkage: Linkage, link: str) -> float:
    """Of a link with one place the radius of its wheel, its roller or the base circle of its cam, else 0.

    >>> from gruebler.teaching.catalog import entry
    >>> valve = entry("cam").linkage()  # base circle 40 mm
    >>> [_radius(each, "cam") for each in (valve, valve.scaled(2))]
    [40.0, 80.0]
    """
    if len(_places(linkage, link)) != 1:
        return 0.0
    return max((each.disc_radius for (_, owner), each in linkage.elements.items() if owner == link), default=0.0)


def _assumed_width(linkage: Linkage) -> float:
    """How wide assumed bars are, in millimetres.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> [_assumed_width(FourBar(25 * k, 70 * k, 40 * k, 70 * k).linkage()) for k in (0.1, 1, 70)]
    [20, 20, 200]
    """
    wanted = 1000 * max(_lengths(linkage).values(), default=0.0) / _SLENDER
    return min(_WIDTHS, key=lambda width: abs(log(width / max(wanted, _WIDTHS[0]))))


def _assumed(linkage: Linkage) -> list[float]:
    """The masses of links of steel: bars from the middle of their joints to each, short ones blocks, wheels discs.

    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> _assumed(SliderCrank(40, 100).linkage())  # the slider: 7850 kg/m3, 20 mm by 20 mm by 5 mm
    [0.0, 0.0314, 0.0785, 0.0157]
    """
    metre = metres_of(linkage.unit)
    width, lengths = _assumed_width(linkage) / 1000, _lengths(linkage)
    bar = _STEEL_DENSITY * width * width / _FLAT  # kg/m
    discs = {link: pi * (metre * _radius(linkage, link)) ** 2 / width for link in lengths}  # bars with as much steel
    return [
        float(f"{bar * (discs[link] or max(lengths[link], width)):.3g}") if link in lengths else 0.0
        for link in linkage.mechanism.chain.links
    ]


def _arms(linkage: Linkage, link: str) -> list[tuple[complex, complex]]:
    """The middle of a link's places, and the way from there to each."""
    places, middle = _places(linkage, link), middle_of(linkage, link)
    return [(middle, place - middle) for place in places]


def middle_of(linkage: Linkage, link: str) -> complex:
    """The middle of a link's places."""
    places = _places(linkage, link)
    return sum(places) / (len(places) or 1)


def _spread(mass: float, linkage: Linkage, link: str) -> RigidBody:
    """A mass on thin rods from the middle of a link's places to each, by their lengths; with one place a disc.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> _spread(1.2, FourBar(25, 70, 40, 70).linkage(), "coupler")  # a rod: m l²/12
    RigidBody(mass=1.2, centre=(35.0, 0.0), inertia=490.0)
    """
    arms = _arms(linkage, link)
    total = sum(abs(arm) for _, arm in arms)
    middle = (arms[0][0].real, arms[0][0].imag)
    if not total > 0:
        return RigidBody.disc(mass, _radius(linkage, link), centre=middle)
    rods = [
        RigidBody.bar(mass * abs(arm) / total, middle, (middle[0] + arm.real, middle[1] + arm.imag)) for _, arm in arms
    ]
    whole = rods[0]
    for rod in rods[1:]:
        whole = whole + rod
    return whole
