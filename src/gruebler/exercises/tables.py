"""Teaching tables, derived from the library: joints, links, inversions, Grashof's types, transfer functions."""

from __future__ import annotations

from collections.abc import Callable
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
from gruebler.text import Text

__all__ = ["TABLES", "teaching_table"]


def _both(word: str) -> Text:
    return Text(word, word)


def joints() -> tuple[Table, ...]:
    """The kinds of joints by their freedoms (table 2.2 of the seeds), from the table of pairs."""
    headers = (
        _both("f"),
        Text("u = 6 - f", "u = 6 - f"),
        Text("f planar", "f eben"),
        Text("symbol", "Symbol"),
        Text("name", "Name"),
        Text("contact", "Elementenpaar"),
        Text("held by", "Schluss"),
    )
    ranked = sorted(PAIRS, key=lambda p: (len(_freedoms(p)), list(Contact).index(p.contact)))
    title = Text("Joints by their degree of freedom f", "Gelenke nach ihrem Freiheitsgrad f")
    return (Table(title, headers, tuple(_joint_row(p) for p in ranked)),)


def _freedoms(kind: Pair) -> tuple[str, ...]:
    return kind.freedoms.get(Space.SPATIAL) or kind.freedoms[Space.PLANAR]


_CONTACTS = {
    Contact.LOWER: Text("lower", "niederes (NEP)"),
    Contact.HIGHER: Text("higher", "höheres (HEP)"),
    Contact.COMPOUND: Text("compound", "zusammengesetzt"),
}
_CLOSURES = {"form": Text("form", "Form"), "force": Text("force", "Kraft"), "material": Text("material", "Stoff")}


def _joint_row(kind: Pair) -> tuple[Value, ...]:
    spatial, planar = (kind.freedoms.get(space) for space in (Space.SPATIAL, Space.PLANAR))
    closures = [_CLOSURES[closure.value] for closure in kind.closures]
    return (
        str(len(spatial)) if spatial else "-",
        str(6 - len(spatial)) if spatial else "-",
        str(len(planar)) if planar else "-",
        Text(kind.symbols.get(Alphabet.INTERNATIONAL, "-"), kind.symbols[Alphabet.GERMAN]),
        Text(kind.name.replace("_", " "), kind.german),
        _CONTACTS[kind.contact],
        Text(", ".join(c.en for c in closures), ", ".join(c.de for c in closures)),
    )


_KINDS = {
    1: Text("singular", "singulär"),
    2: Text("binary", "binär"),
    3: Text("ternary", "ternär"),
    4: Text("quaternary", "quaternär"),
    5: Text("quinary", "quinär"),
}


def links() -> tuple[Table, ...]:
    """Links by the number of their joints, counted in the machines of the catalog, and by their motion."""
    planar = {id: e.chain() for id, e in entries().items() if e.space == "planar"}
    rows: list[tuple[Value, ...]] = []
    for k, name in _KINDS.items():
        having = {id: chain.link_kinds[k] for id, chain in planar.items() if chain.link_kinds.get(k)}
        shown = ", ".join(f"{id} ({number})" for id, number in sorted(having.items(), key=lambda item: -item[1])[:3])
        rows.append((str(k), name, sum(having.values()), shown or "-"))
    kinds = Table(
        Text("Links by their number of joints", "Glieder nach der Zahl ihrer Gelenke"),
        (
            Text("joints", "Gelenke"),
            Text("name", "Name"),
            Text("in the catalog", "im Katalog"),
            Text("most in", "vor allem in"),
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
    title = Text(
        "Every simple joint joins two links: 2g = Σ i·n_i", "Jedes einfache Gelenk verbindet zwei Glieder: 2g = Σ i·n_i"
    )
    return Table(title, (Text("chain", "Kette"), _both("n"), _both("2g"), _both("Σ i·n_i")), tuple(rows))


def _roles() -> Table:
    examples: tuple[tuple[Text, Linkage], ...] = (
        (Text("crank-rocker", "Kurbelschwinge"), FourBar(2, 5, 4, 5).linkage()),
        (Text("slider-crank", "Schubkurbel"), SliderCrank(2, 5).linkage()),
        (Text("inverted slider-crank", "Kurbelschleife"), InvertedSliderCrank(3, 5).linkage()),
        (Text("double crank", "Doppelkurbel"), FourBar(5, 4, 5, 2).linkage()),
    )
    rows: list[tuple[Value, ...]] = []
    for name, linkage in examples:
        found = [(str(link), role) for link, role in motion_roles(linkage).items()]
        en, de = (", ".join(role.in_language(lang) for _, role in found) for lang in ("en", "de"))
        rows.append((name, Text(en, de)))
    title = Text("Links by their motion (computed from it)", "Glieder nach ihrer Bewegung (aus ihr berechnet)")
    return Table(
        title, (Text("mechanism", "Getriebe"), Text("its links in turn", "seine Glieder der Reihe nach")), tuple(rows)
    )


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
        cells = [Text(roles[name].in_language("en"), roles[name].in_language("de")) for name in ring]
        rows.append((f"({row})", frame, *cells, Text(size.type.name("en"), size.type.name("de"))))
    title = Text(
        "One chain, four mechanisms: a = 2, b = 5, c = 4, d = 5",
        "Eine Kette, vier Getriebe: a = 2, b = 5, c = 4, d = 5",
    )
    headers = (_both(""), Text("frame", "Gestell"), *map(_both, ring), Text("mechanism", "Getriebe"))
    return (Table(title, headers, tuple(rows)),)


_CONDITIONS = {"<": "l_min + l_max < l' + l''", "=": "l_min + l_max = l' + l''", ">": "l_min + l_max > l' + l''"}


def grashof_types() -> tuple[Table, ...]:
    """Every type of four-bar (table 3.6) with the smallest whole lengths that make it, and which links turn."""
    found: dict[str, tuple[int, ...]] = {}
    wanted = {(kind.key): place for place, kind in FOUR_BAR_TYPES.items()}
    for lengths in sorted(product(range(1, 7), repeat=4), key=lambda x: (sum(x), max(x), x)):
        found.setdefault(grashof(*lengths).type.key, lengths)
        if len(found) == len(wanted):
            break
    rows: list[tuple[Value, ...]] = []
    for (condition, place), kind in FOUR_BAR_TYPES.items():
        if condition not in _CONDITIONS:
            continue
        lengths = found[kind.key]
        turning = ", ".join(grashof(*lengths).turning) or "-"
        shortest = " = ".join(place) or "-"
        name = Text(kind.name("en"), kind.name("de"))
        rows.append((_CONDITIONS[condition], shortest, *map(str, lengths), turning, name))
    title = Text(
        "Four-bars by Grashof's condition and the place of the shortest link (a crank, b coupler, c rocker, d frame)",
        "Viergelenkgetriebe nach der Bedingung von Grashof und der Stelle des kürzesten Gliedes (a Kurbel, b Koppel, "
        "c Schwinge, d Gestell)",
    )
    headers = (
        Text("condition", "Bedingung"),
        Text("shortest", "kürzestes"),
        *map(_both, "abcd"),
        Text("turning", "umlauffähig"),
        Text("type", "Typ"),
    )
    return (Table(title, headers, tuple(rows)),)


def transfer() -> tuple[Table, ...]:
    """Gears, linkages, cams and Geneva drives by their transfer functions over one turn of the drive."""
    phi = np.radians(np.arange(0, 361, 30))
    slider = SliderCrank(20, 50)
    rocker = FourBar(25, 70, 40, 70)
    lift = read_lift("rise 20 90; dwell 90; fall 20 90; dwell")
    cross = Geneva(4)
    first = float(slider.motion(0.0).output.value)
    columns: dict[Text, Callable[[np.ndarray], np.ndarray]] = {
        Text("gears i = 2: ψ [°]", "Zahnräder i = 2: ψ [°]"): lambda x: np.degrees(x / 2),
        Text("crank-rocker: ψ [°]", "Kurbelschwinge: ψ [°]"): lambda x: np.degrees(rocker.motion(x).output.value),
        Text("slider-crank: s [mm]", "Schubkurbel: s [mm]"): lambda x: first - slider.motion(x).output.value,
        Text("cam: s [mm]", "Kurve: s [mm]"): lambda x: lift.at(x % tau),
        Text("Geneva: ψ [°]", "Malteserkreuz: ψ [°]"): lambda x: (
            -np.degrees(cross.move(x - pi).angle) + np.degrees(cross.move(-pi).angle)
        ),
    }
    values = {name: function(phi) for name, function in columns.items()}
    rows = [(round(degrees(x), 6), *(float(v[k]) for v in values.values())) for k, x in enumerate(phi)]
    title = Text(
        "Transfer functions over one turn of the drive", "Übertragungsfunktionen über eine Umdrehung des Antriebs"
    )
    table = Table(title, (_both("φ [°]"), *values), tuple(rows), decimals=2)
    return table, _kinds_of_transfer(columns)


def _kinds_of_transfer(columns: dict[Text, Callable[[np.ndarray], np.ndarray]]) -> Table:
    fine = np.radians(np.arange(0, 360, 0.25) + 0.125)
    step = radians(0.05)
    rows: list[tuple[Value, ...]] = []
    for name, function in columns.items():
        slope = (function(fine + step) - function(fine - step)) / (2 * step)
        steady = float(np.ptp(slope)) <= 1e-6 * float(np.abs(slope).max())
        still = float(np.mean(np.abs(slope) < 1e-9 * np.abs(slope).max()))
        back = float(slope.min()) < -1e-9 * np.abs(slope).max() < 1e-9 * np.abs(slope).max() < float(slope.max())
        kind = Text("uniform, linear", "gleichmäßig, linear") if steady else Text("non-uniform", "ungleichmäßig")
        way = Text("to and fro", "hin und her") if back else Text("one sense", "gleichsinnig")
        rows.append((Text(name.en.partition(":")[0], name.de.partition(":")[0]), kind, way, f"{still:.0%}"))
    title = Text("What the transfer function says", "Was die Übertragungsfunktion sagt")
    headers = (
        Text("mechanism", "Getriebe"),
        Text("transmission", "Übersetzung"),
        Text("output", "Abtrieb"),
        Text("dwell", "Rast"),
    )
    return Table(title, headers, tuple(rows))


TABLES: dict[str, Callable[[], tuple[Table, ...]]] = {
    "joints": joints,
    "links": links,
    "inversions": inversion_table,
    "grashof": grashof_types,
    "transfer": transfer,
}
"""By the names of the command line."""


def teaching_table(name: str) -> tuple[Table, ...]:
    """The tables of a name: joints, links, inversions, grashof, transfer.

    >>> [row[-1].de for row in teaching_table("inversions")[0].rows]
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
