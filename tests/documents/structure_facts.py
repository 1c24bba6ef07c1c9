"""Chapters 1 to 3.1: pairs, links, chains, mobility, inversions, Grashof's theorem."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Readable
from gruebler.mechanics.fourbar import FourBar
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import PAIRS, Alphabet, pair
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mobility import count_freedoms, counted, mobility_report
from gruebler.teaching.exercises import teaching_table
from tests.documents import independent as own
from tests.documents.fact import Fact

# Table 2.2: name, symbol, f; names and symbols as in docs/misprints.md where the text came through garbled.
TABLE_2_2 = (
    ("Drehgelenk", "D", 1),
    ("Schubgelenk", "S", 1),
    ("Schraubgelenk", "W", 1),
    ("Drehschubgelenk", "DS", 2),
    ("Doppelschubgelenk", "S2", 2),
    ("Kreuzgelenk", "D2", 2),
    ("Kugelgelenk", "D3", 3),
    ("Plattengelenk", "DS2", 3),
    ("Kugelrillengelenk", "D2S", 3),
    ("Kugelrohrgelenk", "D3S", 4),
    ("Zylinderflächengelenk", "D2S2", 4),
    ("Doppeldrehschubgelenk", "D2S2", 4),
    ("Kugelflächengelenk", "D3S2", 5),
)


def words(table: str, *, number: int = 0) -> list[list[str]]:
    """The rows of a teaching table as English words."""
    rows = teaching_table(table)[number].rows
    return [[cell.in_language("en") if isinstance(cell, Readable) else str(cell) for cell in row] for row in rows]


def refused(text: str) -> bool:
    """Whether a text is no chain."""
    try:
        Chain.parse(text)
    except GrueblerError:
        return True
    return False


def kind(a: float, b: float, c: float, d: float) -> str:
    """The type of a four-bar."""
    return FourBar(a, b, c, d).type.key


def _criterion(text: str) -> int:
    """The right-hand side of the criterion of constrained motion, 0 for F = 1."""
    return int(count_freedoms(Chain.parse(text)).criterion().rpartition(" = ")[2])


def _inversions(frame: int) -> list[Any]:
    """Type by Grashof, and whether crank and rocker turn, of 2, 5, 4, 5 with another link as the frame."""
    ring = [2.0, 5.0, 4.0, 5.0]  # a, b, c, d around the chain; the link after the frame is the crank
    a, b, c, d = (ring[(frame + k) % 4] for k in (1, 2, 3, 0))
    return [FourBar(a, b, c, d).type.key, own.turns(a, b, c, d), own.turns(c, b, a, d)]


def _parallel(phi: np.ndarray) -> np.ndarray:
    """Turn of the rocker against the crank, and of the coupler, in a parallelogram."""
    motion = FourBar(25, 70, 25, 70).motion(np.radians(phi))
    return np.stack([np.degrees(motion.output.value) - phi, np.degrees(motion.coupler.value)])


def mobility(text: str, space: str = "planar") -> int:
    """F by the formula."""
    return counted(Chain.parse(text, space=space))


def stated(place: str, states: str, derive: Any, value: Any, **more: Any) -> Fact:
    """A fact that is not about one entry of the catalog."""
    return Fact(place=f"000/003, {place}", states=states, derive=derive, value=value, **more)


QUAD, PENT = "R(0-1) R(1-2) R(2-3) R(3-0)", "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)"
WATT = f"{QUAD} R(1-4) R(4-5) R(5-3)"

PAIRS_AND_LINKS = [
    stated("section 2.1", "b in space", lambda: Space.SPATIAL.b, 6, printed="6"),
    stated("section 2.1", "b in the plane", lambda: Space.PLANAR.b, 3, printed="3"),
    stated("section 2.1", "f in space at most", lambda: Space.SPATIAL.greatest_freedom, 5, printed="5"),
    stated("section 2.1", "f in the plane at most", lambda: Space.PLANAR.greatest_freedom, 2, printed="2"),
    stated(
        "section 2.1",
        "f of every joint in space lies from 1 to 5, and u = 6 - f",
        lambda: {
            (1 <= (f := pair(name).f(Space.SPATIAL)) <= 5, pair(name).u(Space.SPATIAL) + f) for name, *_ in TABLE_2_2
        },
        {(True, 6)},
    ),
    stated(
        "section 2.1",
        "contact, stress and forces of lower and higher pairs",
        lambda: words("joints", number=1),
        [["lower", "surface", "small", "large"], ["higher", "line or point", "large", "small"]],
    ),
    stated(
        "section 2.1",
        "joints are held by form, force or material",
        lambda: {str(closure) for each in PAIRS for closure in each.closures},
        {"form", "force", "material"},
    ),
    *(
        stated("table 2.2", f"f of the {name}", lambda name=name: pair(name).f(Space.SPATIAL), f, printed=str(f))
        for name, _, f in TABLE_2_2
    ),
    *(
        stated("table 2.2", f"symbol of the {name}", lambda name=name: pair(name).symbol(Alphabet.GERMAN), symbol)
        for name, symbol, _ in TABLE_2_2
    ),
    *(
        stated(
            "table 2.2",
            f"f of the {name} is the sum of the indices of its symbol, a letter alone counting 1",
            lambda name=name: pair(name).f(Space.SPATIAL),
            sum(int(index or 1) for index in re.findall(r"[DSW](\d?)", symbol)),
        )
        for name, symbol, _ in TABLE_2_2
    ),
    # The table has the symbol DS for the Rollgleitgelenk too; section 2.6 writes G.
    stated("table 2.2", "f of the Gleitwälzgelenk in the plane", lambda: pair("Gleitwälzgelenk").f(Space.PLANAR), 2),
    stated(
        "section 2.6", "symbol of the Gleitwälzgelenk", lambda: pair("Gleitwälzgelenk").symbol(Alphabet.GERMAN), "G"
    ),
    stated("section 2", "a mechanism has at least three links", lambda: refused("R(0-1)"), value=True),
    stated(
        "section 2.2",
        "links with 1, 2, 3, 4 joints",
        lambda: [row[1] for row in words("links")[:4]],
        ["singular", "binary", "ternary", "quaternary"],
    ),
    stated(
        "section 2.2",
        "a link with one joint is not held: one freedom more",
        lambda: mobility_report(Chain.parse(f"{QUAD} R(1-4)")).generic - mobility_report(Chain.parse(QUAD)).generic,
        1,
    ),
    stated(
        "section 2.2",
        "a quaternary link is rigid, a four-bar is not",
        lambda: [mobility(f"{QUAD} R(0-2)"), mobility(QUAD)],
        [-1, 1],
    ),
]

CHAINS = [
    stated("section 2.3", "F of the triangle", lambda: mobility("R(0-1) R(1-2) R(2-0)"), 0, printed="0"),
    stated("section 2.3", "F of the four-bar", lambda: mobility(QUAD), 1, printed="1"),
    stated("section 2.3", "F of the five-bar", lambda: mobility(PENT), 2, printed="2"),
    *(
        stated(
            "section 2.4",
            f"row ({letter}): roles of a, b, c, d with a the shortest and c opposite to it",
            lambda k=k: words("inversions")[k][2:6],
            roles,
        )
        for k, (letter, roles) in enumerate(
            (
                ("d", ["crank", "frame", "rocker", "coupler"]),
                ("e", ["crank", "coupler", "rocker", "frame"]),
                ("f", ["frame", "crank", "coupler", "crank"]),
                ("g", ["coupler", "rocker", "frame", "rocker"]),
            )
        )
    ),
    *(
        stated(
            "section 2.4",
            f"2, 5, 4, 5 with {link} as the frame: type, and which neighbours of the frame turn",
            lambda k=k: _inversions(k),
            value,
        )
        for k, link, value in (
            (3, "d", ["crank_rocker", True, False]),
            (1, "b", ["rocker_crank", False, True]),
            (0, "a", ["double_crank", True, True]),
            (2, "c", ["grashof_double_rocker", False, False]),
        )
    ),
    stated(
        "section 2.5",
        "F = b(n - 1) - Σ(b - f) in space, brackets missing in print",
        lambda: mobility("R(0-1) S(1-2) S(2-3) R(0-3)", "spatial"),
        own.freedoms(4, {1: 2, 3: 2}, 6),
    ),
    stated(
        "section 2.5",
        "F = 3(n - 1) - 2 g1 - g2",
        lambda: mobility("R(0-1) P(0-2) G(1-2)"),
        own.freedoms(3, {1: 2, 2: 1}),
    ),
    stated(
        "section 2.5",
        "criterion 0 = 3n - 4 - 2 g1 - g2 for F = 1, else F - 1",
        lambda: [_criterion(text) for text in (QUAD, PENT, WATT, "R(0-1) R(1-2) R(2-0)")],
        [0, 1, 0, -1],
    ),
    stated(
        "section 2.6", "a double joint counts twice", lambda: Chain.parse("R(0-1-2) R(0-3) R(1-3)").joints[0].count, 2
    ),
    stated("section 2.6", "four-bar, n = 4, g1 = 4", lambda: mobility(QUAD), 1, printed="1"),
    stated(
        "section 2.6",
        "n = 5, g1 = 6 with two double joints",
        lambda: mobility("R(0-1) R(1-2-4) R(2-3) R(3-0-4)"),
        0,
        printed="0",
    ),
    stated("section 2.6", "n = 5, g1 = 6 with a strut", lambda: mobility(f"{QUAD} R(1-4) R(4-3)"), 0, printed="0"),
    stated(
        "section 2.6",
        "a coupler lowers F by one",
        lambda: mobility(f"{PENT} R(1-5) R(5-3)") - mobility(PENT),
        -1,
    ),
    stated("section 2.6", "slider-crank", lambda: mobility("R(0-1) R(1-2) R(2-3) P(3-0)"), 1, printed="1"),
    stated("section 2.6", "inverted slider-crank", lambda: mobility("R(0-1) R(1-2) P(2-3) R(3-0)"), 1, printed="1"),
    stated("section 2.6", "friction drive", lambda: mobility("R(0-1) R(0-2) W(1-2)"), 0, printed="0"),
    stated(
        "section 2.6",
        "friction drive with an arm",
        lambda: mobility("R(0-1) W(1-2) R(2-3) R(3-0)"),
        1,
        printed="1",
    ),
    stated("section 2.6", "pair of gears", lambda: mobility("R(0-1) R(0-2) G(1-2)"), 1, printed="1"),
]


def _antiparallel(phi: float) -> complex:
    return complex(*FourBar(25, 70, 25, 70).motion(np.radians(phi), branch="-").B.value)


# Lengths by hand for each case of l_min + l_max against l' + l''
GRASHOF = [
    *(
        stated(
            "section 3.1",
            f"{a:g}, {b:g}, {c:g}, {d:g}: l_min + l_max {sign} l' + l'': {type}",
            lambda a=a, b=b, c=c, d=d: kind(a, b, c, d),
            type,
        )
        for a, b, c, d, sign, type in (
            (25.0, 70.0, 40.0, 70.0, "<", "crank_rocker"),  # 25 + 70 < 40 + 70
            (40.0, 100.0, 70.0, 90.0, "<", "crank_rocker"),  # exercise 7: 40 + 100 < 70 + 90
            (40.0, 60.0, 50.0, 25.0, "<", "double_crank"),  # 25 + 60 < 40 + 50, the shortest is the frame
            (60.0, 30.0, 70.0, 65.0, "<", "grashof_double_rocker"),  # 30 + 70 < 60 + 65, the shortest is the coupler
            (50.0, 70.0, 40.0, 70.0, "<", "rocker_crank"),  # 40 + 70 < 50 + 70: no triple rocker
            (50.0, 70.0, 60.0, 100.0, ">", "triple_rocker"),  # 50 + 100 > 60 + 70
            (40.0, 60.0, 55.0, 90.0, ">", "triple_rocker"),  # 40 + 90 > 55 + 60
        )
    ),
    stated(
        "section 3.1",
        "triple rocker: no link turns",
        lambda: list(FourBar(50, 70, 60, 100).turning),
        [],
    ),
    stated(
        "section 3.1",
        "50, 70, 40, 70 is no triple rocker: its shortest link turns",
        lambda: list(FourBar(50, 70, 40, 70).turning),
        ["c"],
    ),
    stated(
        "section 3.1",
        "parallel cranks: change points, 25 + 70 = 25 + 70",
        lambda: FourBar(25, 70, 25, 70).grashof.excess,
        0.0,
    ),
    stated(
        "section 3.1",
        "parallel cranks turn alike, the coupler does not turn",
        lambda: _parallel(np.arange(10.0, 180.0, 20.0)),
        np.zeros((2, 9)),
    ),
    stated(
        "section 3.1",
        "antiparallel cranks: the coupler turns, and the second crank is where circles meet on the other side",
        lambda: _antiparallel(60.0),
        own.four_bar(25, 70, 25, 70, 60, -1)[1],
    ),
]


FACTS = [*PAIRS_AND_LINKS, *CHAINS, *GRASHOF]
