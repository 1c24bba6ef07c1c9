"""Teaching tables, derived from the library: joints, links, inversions, Grashof's types, transfer functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import product
from math import degrees, pi, radians, tau

import numpy as np

from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import Message, Text, arity, in_every_language, joined, message
from gruebler.machines.cams import read_lift
from gruebler.machines.gears import read_train, speeds
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.analysis import motion_roles
from gruebler.mechanics.fourbar import (
    FOUR_BAR_TYPES,
    INVERTED_SLIDER_CRANK_TYPES,
    SLIDER_CRANK_TYPES,
    FourBar,
    InvertedSliderCrank,
    LinkageType,
    SliderCrank,
)
from gruebler.mechanics.fourbar.length_texts import ClosedForm
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import PAIRS, Alphabet, Contact, Pair
from gruebler.structure.chain.spaces import Space
from gruebler.teaching.catalog import entries
from gruebler.teaching.exercises.solution import TeachingTable, Value


def joints() -> tuple[TeachingTable, ...]:
    """The kinds of joints by their freedoms (table 2.2 of the teaching documents), from the table of pairs."""
    headers = (
        "f",
        "u = 6 - f",
        message("f planar"),
        message("symbol"),
        message("name"),
        message("contact"),
        message("held by"),
    )
    ranked = sorted(PAIRS, key=lambda p: (len(_freedoms(p)), list(Contact).index(p.contact)))
    title = message("Joints by their degree of freedom f")
    return TeachingTable(title, headers, tuple(_joint_row(p) for p in ranked)), _lower_and_higher(), _connections()


def _freedoms(kind: Pair) -> tuple[str, ...]:
    return kind.freedoms.get(Space.SPATIAL) or kind.freedoms[Space.PLANAR]


_CONTACTS = {Contact.LOWER: message("lower"), Contact.HIGHER: message("higher"), Contact.COMPOUND: message("compound")}
_CLOSURES = {"form": message("form"), "force": message("force"), "material": message("material")}


def _lower_and_higher() -> TeachingTable:
    """What the contact of the elements means for stress and force (section 2.1)."""
    rows = (
        (_CONTACTS[Contact.LOWER], message("surface"), message("small"), message("large")),
        (_CONTACTS[Contact.HIGHER], message("line or point"), message("large"), message("small")),
    )
    headers = (
        message("pair"),
        message("contact in a"),
        message("stress in the material"),
        message("forces it can transmit"),
    )
    return TeachingTable(message("Lower and higher pairs"), headers, rows)


def _connections() -> TeachingTable:
    """The motions that no joint, any joint and a rigid connection leave two links."""
    rows: list[tuple[Value, ...]] = []
    for space in (Space.SPATIAL, Space.PLANAR):
        b, most = space.b, space.greatest_freedom
        rows.append((space.adjective, message("none"), str(b), "0"))
        rows.append((space.adjective, message("joint"), f"1 … {most}", f"{b - most} … {b - 1}"))
        rows.append((space.adjective, message("rigid"), "0", str(b)))
    title = message("Freedoms f that a connection leaves, u = b - f that it takes away")
    return TeachingTable(title, (message("space"), message("connection"), "f", "u"), tuple(rows))


def _joint_row(kind: Pair) -> tuple[Value, ...]:
    spatial, planar = (kind.freedoms.get(space) for space in (Space.SPATIAL, Space.PLANAR))
    return (
        str(len(spatial)) if spatial else "-",
        str(6 - len(spatial)) if spatial else "-",
        str(len(planar)) if planar else "-",
        in_every_language(lambda lang: kind.symbols.get(Alphabet.of_language(lang), "-")),
        Text(kind.name.replace("_", " "), ", ".join((kind.german, *kind.other_names))),
        _CONTACTS[kind.contact],
        joined(_CLOSURES[closure.value] for closure in kind.closures),
    )


def links() -> tuple[TeachingTable, ...]:
    """Links by the number of their joints, counted in the machines of the catalog, and by their motion."""
    planar = {id: e.chain() for id, e in entries().items() if e.space == "planar"}
    rows: list[tuple[Value, ...]] = []
    for k in range(1, 6):
        having = {id: chain.link_kinds[k] for id, chain in planar.items() if chain.link_kinds.get(k)}
        shown = ", ".join(f"{id} ({number})" for id, number in sorted(having.items(), key=lambda item: -item[1])[:3])
        rows.append((str(k), in_every_language(partial(arity, k)), sum(having.values()), shown or "-"))
    kinds = TeachingTable(
        message("Links by their number of joints"),
        (message("joints"), message("name"), message("in the catalog"), message("most in")),
        tuple(rows),
    )
    return kinds, _identity(planar), _roles()


def _identity(planar: dict[str, Chain]) -> TeachingTable:
    """2 g = n1·1 + n2·2 + ... of chains with simple joints."""
    chosen = ("quad", "pent", "e3_watt", "wiper", "drafting")
    rows = []
    for id in chosen:
        chain = planar[id]
        kinds = chain.link_kinds
        shown = " + ".join(f"{k}·{number}" for k, number in kinds.items())
        rows.append((id, len(chain.links), str(2 * chain.g), f"{shown} = {sum(k * v for k, v in kinds.items())}"))
    title = message("Every simple joint joins two links: 2g = Σ i·n_i")
    return TeachingTable(title, (message("chain"), "n", "2g", "Σ i·n_i"), tuple(rows))


def _roles() -> TeachingTable:
    examples: tuple[tuple[Message, Linkage], ...] = (
        (message("crank-rocker"), FourBar(2, 5, 4, 5).linkage()),
        (message("slider-crank"), SliderCrank(2, 5).linkage()),
        (message("inverted slider-crank"), InvertedSliderCrank(3, 5).linkage()),
        (message("double crank"), FourBar(5, 4, 5, 2).linkage()),
    )
    rows: list[tuple[Value, ...]] = []
    for name, linkage in examples:
        rows.append((name, joined(motion_roles(linkage).values())))
    title = message("Links by their motion (computed from it)")
    return TeachingTable(title, (message("mechanism"), message("its links in turn")), tuple(rows))


_SIDES = (("d", "b"), ("e", "d"), ("f", "a"), ("g", "c"))


def inversion_table(a: float = 2, b: float = 5, c: float = 4, d: float = 5) -> tuple[TeachingTable, ...]:
    """The four mechanisms of one four-bar chain (table 2.3), roles from motion; printed with a shortest, c opposite."""
    chain = {"a": a, "b": b, "c": c, "d": d}
    ring = "abcd"
    rows: list[tuple[Value, ...]] = []
    for row, frame in _SIDES:
        start = ring.index(frame)
        crank, coupler, rocker = (ring[(start + k) % 4] for k in (1, 2, 3))
        if chain[rocker] < chain[crank]:
            crank, rocker = rocker, crank
        size = FourBar(*(chain[name] for name in (crank, coupler, rocker, frame)))
        roles = dict(zip((frame, crank, coupler, rocker), motion_roles(size.linkage()).values(), strict=True))
        cells = [roles[name] for name in ring]
        rows.append((f"({row})", frame, *cells, in_every_language(size.type.name)))
    title = message("One chain, four mechanisms: a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g}", **chain)
    headers = ("", message("frame"), *ring, message("mechanism"))
    return (TeachingTable(title, headers, tuple(rows)),)


def smallest_lengths(kind: type[ClosedForm]) -> dict[str, ClosedForm]:
    """Every type of four-bar, slider-crank or inverted slider-crank with the smallest whole lengths that have it.

    >>> {key: (size.a, size.b, size.e) for key, size in smallest_lengths(SliderCrank).items()}["slider_rocker"]
    (1.0, 1.0, 1.0)
    """
    types, names, *_ = _FORMS[kind]
    least = [0 if name == "e" else 1 for name in names]
    smallest: dict[str, ClosedForm] = {}
    for lengths in sorted(product(*(range(k, 7) for k in least)), key=lambda x: (sum(x), max(x), x)):
        size = kind(*lengths)
        smallest.setdefault(size.type.key, size)
        if len(smallest) == len(types):
            break
    return smallest


_FORMS: dict[type[ClosedForm], tuple[Mapping[tuple[str, str], LinkageType], str, str, Message]] = {
    FourBar: (
        FOUR_BAR_TYPES,
        "abcd",
        "l_min + l_max {relation} l' + l''",
        message(
            "Four-bars by Grashof's condition and the place of the shortest link "
            "(a crank, b coupler, c rocker, d frame)"
        ),
    ),
    SliderCrank: (
        SLIDER_CRANK_TYPES,
        "abe",
        "l_min + |e| {relation} l_max",
        message("Slider-cranks by the same condition (a crank, b coupler, e eccentricity)"),
    ),
    InvertedSliderCrank: (
        INVERTED_SLIDER_CRANK_TYPES,
        "ade",
        "l_min + |e| {relation} l_max",
        message("Inverted slider-cranks by the same condition (a crank, d frame, e eccentricity)"),
    ),
}
"""Types, letters of the lengths, condition and title of each kind."""


def grashof_types() -> tuple[TeachingTable, ...]:
    """Every type of four-bar (table 3.6) and of slider-crank with its smallest whole lengths and its turning links."""
    return tuple(map(_types_table, _FORMS))


def _types_table(kind: type[ClosedForm]) -> TeachingTable:
    types, names, condition, title = _FORMS[kind]
    examples = smallest_lengths(kind)
    rows: list[tuple[Value, ...]] = []
    for (relation, place), type_ in types.items():
        if relation not in "<=>":
            continue
        size = examples[type_.key]
        lengths = (f"{getattr(size, name):g}" for name in names)
        turning = ", ".join(size.turning) or "-"
        shortest = " = ".join(place) or "-"
        rows.append((condition.format(relation=relation), shortest, *lengths, turning, in_every_language(type_.name)))
    headers = (message("condition"), message("shortest"), *names, message("turning"), message("type"))
    return TeachingTable(title, headers, tuple(rows))


def forms_of_chain(chain: Chain) -> tuple[TeachingTable, ...]:
    """Which forms the mechanisms of a chain have, and for which lengths; none for chains without names for them.

    >>> len(forms_of_chain(Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)")))
    2
    """
    kinds = [joint.pair.name for joint in chain.joints]
    if chain.space != Space.PLANAR or chain.link_kinds != {2: 4}:
        return ()
    four_bar, *sliders = grashof_types()
    if kinds.count("revolute") + kinds.count("prismatic") < 4:
        return ()
    return {0: (four_bar,), 1: tuple(sliders)}.get(kinds.count("prismatic"), ())


_Column = tuple[Message, str, Callable[[np.ndarray], np.ndarray]]
"""A mechanism, the quantity of its output, and the transfer function."""


def transfer() -> tuple[TeachingTable, ...]:
    """Wheels, belts, linkages, cams and Geneva drives by their transfer functions over one turn of the drive.

    Angles are positive in the sense of the drive.
    """
    phi = np.radians(np.arange(0, 361, 30))
    slider = SliderCrank(20, 50)
    rocker = FourBar(25, 70, 40, 70)
    lift = read_lift("rise 20 90; dwell 90; fall 20 90; dwell")
    cross = Geneva(4)
    first = float(slider.motion(0.0).output.value)
    columns: list[_Column] = [
        (message("gears 20:40"), "ψ [°]", lambda x: np.degrees(x) * _ratio("gear", 20, 40)),
        (message("friction wheels 20:30"), "ψ [°]", lambda x: np.degrees(x) * _ratio("friction", 20, 30)),
        (message("belt 20:40"), "ψ [°]", lambda x: np.degrees(x) * _ratio("belt", 20, 40)),
        (message("crank-rocker"), "ψ [°]", lambda x: np.degrees(rocker.motion(x).output.value)),
        (message("slider-crank"), "s [mm]", lambda x: first - slider.motion(x).output.value),
        (message("cam"), "s [mm]", lambda x: lift.at(x % tau)),
        (
            message("Geneva"),
            "ψ [°]",
            lambda x: np.degrees(cross.move(x - pi).angle) - np.degrees(cross.move(-pi).angle),
        ),
    ]
    values = [function(phi) for _, _, function in columns]
    rows = [(round(degrees(x), 6), *(float(v[k]) for v in values)) for k, x in enumerate(phi)]
    title = message("Transfer functions over one turn of the drive")
    headers = [joined([mechanism, quantity], ": ") for mechanism, quantity, _ in columns]
    table = TeachingTable(title, ("φ [°]", *headers), tuple(rows), decimals=2)
    return table, _kinds_of_transfer(columns)


def _ratio(kind: str, drive: int, wheel: int) -> float:
    """The speed of a wheel for that of the wheel that drives it."""
    speed = speeds(read_train(f"{kind} drive:{drive} wheel:{wheel}; drive=1").train, {"drive": 1}).values["wheel"]
    assert speed is not None
    return float(speed)


def _kinds_of_transfer(columns: list[_Column]) -> TeachingTable:
    fine = np.radians(np.arange(0, 360, 0.25) + 0.125)
    step = radians(0.05)
    rows: list[tuple[Value, ...]] = []
    for mechanism, quantity, function in columns:
        slope = (function(fine + step) - function(fine - step)) / (2 * step)
        steady = float(np.ptp(slope)) <= 1e-6 * float(np.abs(slope).max())
        still = float(np.mean(np.abs(slope) < 1e-9 * np.abs(slope).max()))
        back = float(slope.min()) < -1e-9 * np.abs(slope).max() < 1e-9 * np.abs(slope).max() < float(slope.max())
        kind = message("uniform, linear") if steady else message("non-uniform")
        if back:
            sense = message("to and fro")
        else:
            forward = float(slope.max()) > -float(slope.min())
            sense = message("always with the drive") if forward else message("always against the drive")
        turns = quantity.startswith("ψ")
        motions = message("rotation to rotation") if turns else message("rotation to translation")
        rows.append((mechanism, kind, sense, f"{still:.0%}", motions))
    title = message("Properties of the transfer function")
    headers = (message("mechanism"), message("transmission"), message("output"), message("dwell"), message("motions"))
    return TeachingTable(title, headers, tuple(rows))


TABLES: dict[str, Callable[[], tuple[TeachingTable, ...]]] = {
    "joints": joints,
    "links": links,
    "inversions": inversion_table,
    "grashof": grashof_types,
    "transfer": transfer,
}
"""The tables by their names in the command line."""


def teaching_table(name: str, lengths: Sequence[float] = ()) -> tuple[TeachingTable, ...]:
    """The tables of a name: joints, links, inversions (of four lengths, if they are given), grashof, transfer.

    >>> [row[-1].in_language("de") for row in teaching_table("inversions")[0].rows]
    ['Kurbelschwinge', 'Kurbelschwinge', 'Doppelkurbel', 'Doppelschwinge mit umlaufender Koppel']
    """
    if name not in TABLES:
        raise GrueblerError("the teaching tables are {known}, not {word!r}{suggestion}", **unknown(name, TABLES))
    if not lengths:
        return TABLES[name]()
    if name != "inversions" or len(lengths) != len(_SIDES):
        raise GrueblerError("only the table inversions takes lengths: a, b, c, d of a four-bar")
    return inversion_table(*lengths)
