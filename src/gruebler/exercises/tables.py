"""Teaching tables, derived from the library: joints, links, inversions, Grashof's types, transfer functions."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import product
from math import degrees, pi, radians, tau

import numpy as np

from gruebler.analysis import motion_roles
from gruebler.cams import read_lift
from gruebler.catalog import entries
from gruebler.chain import Chain
from gruebler.chain.pairs import PAIRS, Alphabet, Contact, Pair, Space
from gruebler.errors import GrueblerError, nearest
from gruebler.exercises.solution import Table, Value
from gruebler.fourbar import FOUR_BAR_TYPES, FourBar, InvertedSliderCrank, SliderCrank, grashof
from gruebler.geneva import Geneva
from gruebler.linkages import Linkage
from gruebler.text import Message, Text, arity, in_every_language, joined, message

__all__ = ["TABLES", "teaching_table"]


def joints() -> tuple[Table, ...]:
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
    return (Table(title, headers, tuple(_joint_row(p) for p in ranked)),)


def _freedoms(kind: Pair) -> tuple[str, ...]:
    return kind.freedoms.get(Space.SPATIAL) or kind.freedoms[Space.PLANAR]


_CONTACTS = {
    Contact.LOWER: message("lower"),
    Contact.HIGHER: message("higher"),
    Contact.COMPOUND: message("compound"),
}
_CLOSURES = {"form": message("form"), "force": message("force"), "material": message("material")}


def _joint_row(kind: Pair) -> tuple[Value, ...]:
    spatial, planar = (kind.freedoms.get(space) for space in (Space.SPATIAL, Space.PLANAR))
    return (
        str(len(spatial)) if spatial else "-",
        str(6 - len(spatial)) if spatial else "-",
        str(len(planar)) if planar else "-",
        in_every_language(lambda lang: kind.symbols.get(Alphabet.of_language(lang), "-")),
        Text(kind.name.replace("_", " "), kind.german),
        _CONTACTS[kind.contact],
        joined(_CLOSURES[closure.value] for closure in kind.closures),
    )


def links() -> tuple[Table, ...]:
    """Links by the number of their joints, counted in the machines of the catalog, and by their motion."""
    planar = {id: e.chain() for id, e in entries().items() if e.space == "planar"}
    rows: list[tuple[Value, ...]] = []
    for k in range(1, 6):
        having = {id: chain.link_kinds[k] for id, chain in planar.items() if chain.link_kinds.get(k)}
        shown = ", ".join(f"{id} ({number})" for id, number in sorted(having.items(), key=lambda item: -item[1])[:3])
        rows.append((str(k), in_every_language(partial(arity, k)), sum(having.values()), shown or "-"))
    kinds = Table(
        message("Links by their number of joints"),
        (
            message("joints"),
            message("name"),
            message("in the catalog"),
            message("most in"),
        ),
        tuple(rows),
    )
    return kinds, _identity(planar), _roles()


def _identity(planar: dict[str, Chain]) -> Table:
    """2 g = n1·1 + n2·2 + ... of chains with simple joints."""
    chosen = ("quad", "pent", "e3_watt", "wiper", "drafting")
    rows = []
    for id in chosen:
        chain = planar[id]
        kinds = chain.link_kinds
        shown = " + ".join(f"{k}·{number}" for k, number in kinds.items())
        rows.append((id, len(chain.links), str(2 * chain.g), f"{shown} = {sum(k * v for k, v in kinds.items())}"))
    title = message("Every simple joint joins two links: 2g = Σ i·n_i")
    return Table(title, (message("chain"), "n", "2g", "Σ i·n_i"), tuple(rows))


def _roles() -> Table:
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
    return Table(title, (message("mechanism"), message("its links in turn")), tuple(rows))


_SIDES = (("d", "b"), ("e", "d"), ("f", "a"), ("g", "c"))


def inversion_table() -> tuple[Table, ...]:
    """The four mechanisms of one four-bar chain (table 2.3), roles from motion: a shortest, c opposite to it."""
    chain = {"a": 2.0, "b": 5.0, "c": 4.0, "d": 5.0}
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
    title = message("One chain, four mechanisms: a = 2, b = 5, c = 4, d = 5")
    headers = ("", message("frame"), *ring, message("mechanism"))
    return (Table(title, headers, tuple(rows)),)


_CONDITIONS = {"<": "l_min + l_max < l' + l''", "=": "l_min + l_max = l' + l''", ">": "l_min + l_max > l' + l''"}


def grashof_types() -> tuple[Table, ...]:
    """Every type of four-bar (table 3.6) with its smallest whole lengths and its turning links."""
    examples: dict[str, tuple[int, ...]] = {}
    places = {(kind.key): place for place, kind in FOUR_BAR_TYPES.items()}
    for lengths in sorted(product(range(1, 7), repeat=4), key=lambda x: (sum(x), max(x), x)):
        examples.setdefault(grashof(*lengths).type.key, lengths)
        if len(examples) == len(places):
            break
    rows: list[tuple[Value, ...]] = []
    for (condition, place), kind in FOUR_BAR_TYPES.items():
        if condition not in _CONDITIONS:
            continue
        lengths = examples[kind.key]
        turning = ", ".join(grashof(*lengths).turning) or "-"
        shortest = " = ".join(place) or "-"
        rows.append((_CONDITIONS[condition], shortest, *map(str, lengths), turning, in_every_language(kind.name)))
    title = message(
        "Four-bars by Grashof's condition and the place of the shortest link (a crank, b coupler, c rocker, d frame)"
    )
    headers = (
        message("condition"),
        message("shortest"),
        *"abcd",
        message("turning"),
        message("type"),
    )
    return (Table(title, headers, tuple(rows)),)


_Column = tuple[Message, str, Callable[[np.ndarray], np.ndarray]]
"""A mechanism, the quantity of its output, and the transfer function."""


def transfer() -> tuple[Table, ...]:
    """Gears, linkages, cams and Geneva drives by their transfer functions over one turn of the drive."""
    phi = np.radians(np.arange(0, 361, 30))
    slider = SliderCrank(20, 50)
    rocker = FourBar(25, 70, 40, 70)
    lift = read_lift("rise 20 90; dwell 90; fall 20 90; dwell")
    cross = Geneva(4)
    first = float(slider.motion(0.0).output.value)
    columns: list[_Column] = [
        (message("gears i = 2"), "ψ [°]", lambda x: np.degrees(x / 2)),
        (message("crank-rocker"), "ψ [°]", lambda x: np.degrees(rocker.motion(x).output.value)),
        (message("slider-crank"), "s [mm]", lambda x: first - slider.motion(x).output.value),
        (message("cam"), "s [mm]", lambda x: lift.at(x % tau)),
        (
            message("Geneva"),
            "ψ [°]",
            lambda x: -np.degrees(cross.move(x - pi).angle) + np.degrees(cross.move(-pi).angle),
        ),
    ]
    values = [function(phi) for _, _, function in columns]
    rows = [(round(degrees(x), 6), *(float(v[k]) for v in values)) for k, x in enumerate(phi)]
    title = message("Transfer functions over one turn of the drive")
    headers = [joined([mechanism, quantity], ": ") for mechanism, quantity, _ in columns]
    table = Table(title, ("φ [°]", *headers), tuple(rows), decimals=2)
    return table, _kinds_of_transfer(columns)


def _kinds_of_transfer(columns: list[_Column]) -> Table:
    fine = np.radians(np.arange(0, 360, 0.25) + 0.125)
    step = radians(0.05)
    rows: list[tuple[Value, ...]] = []
    for mechanism, _, function in columns:
        slope = (function(fine + step) - function(fine - step)) / (2 * step)
        steady = float(np.ptp(slope)) <= 1e-6 * float(np.abs(slope).max())
        still = float(np.mean(np.abs(slope) < 1e-9 * np.abs(slope).max()))
        back = float(slope.min()) < -1e-9 * np.abs(slope).max() < 1e-9 * np.abs(slope).max() < float(slope.max())
        kind = message("uniform, linear") if steady else message("non-uniform")
        sense = message("to and fro") if back else message("one sense")
        rows.append((mechanism, kind, sense, f"{still:.0%}"))
    title = message("Properties of the transfer function")
    headers = (
        message("mechanism"),
        message("transmission"),
        message("output"),
        message("dwell"),
    )
    return Table(title, headers, tuple(rows))


TABLES: dict[str, Callable[[], tuple[Table, ...]]] = {
    "joints": joints,
    "links": links,
    "inversions": inversion_table,
    "grashof": grashof_types,
    "transfer": transfer,
}
"""The tables by their names in the command line."""


def teaching_table(name: str) -> tuple[Table, ...]:
    """The tables of a name: joints, links, inversions, grashof, transfer.

    >>> [row[-1].in_language("de") for row in teaching_table("inversions")[0].rows]
    ['Kurbelschwinge', 'Kurbelschwinge', 'Doppelkurbel', 'Doppelschwinge mit umlaufender Koppel']
    """
    if name not in TABLES:
        raise GrueblerError(
            "the teaching tables are {tables}, not {name!r}{suggestion}",
            tables=", ".join(TABLES),
            name=name,
            suggestion=nearest(name, TABLES),
        )
    return TABLES[name]()
