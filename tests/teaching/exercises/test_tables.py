"""Teaching tables are true: every row is derived, and derived again here by another way."""

import numpy as np
import pytest

from gruebler import Chain, FourBar, GrueblerError, InvertedSliderCrank, SliderCrank, move, rotatability
from gruebler.mechanics.fourbar import FOUR_BAR_TYPES, sized_inversions
from gruebler.structure.chain.pairs import PAIRS
from gruebler.teaching.catalog import entries
from gruebler.teaching.exercises import TABLES, forms_of_chain, lines_of_table, teaching_table

# Table 2.2 of the seeds, reconstructed: f, German symbol, German name.
JOINTS = [
    (1, "D", "Drehgelenk"),
    (1, "S", "Schubgelenk"),
    (1, "W", "Schraubgelenk"),
    (2, "DS", "Drehschubgelenk"),
    (2, "S2", "Doppelschubgelenk"),
    (2, "D2", "Kreuzgelenk"),
    (3, "D3", "Kugelgelenk"),
    (3, "DS2", "Plattengelenk"),
    (3, "D2S", "Kugelrillengelenk"),
    (4, "D3S", "Kugelrohrgelenk"),
    (4, "D2S2", "Zylinderflächengelenk"),
    (4, "D2S2", "Doppeldrehschubgelenk"),
    (5, "D3S2", "Kugelflächengelenk"),
]


def test_joints():
    table, contacts, connections = teaching_table("joints")
    assert len(table.rows) == len(PAIRS)
    told = {
        (int(row[0]), row[3].in_language("de"), row[4].in_language("de").partition(",")[0])
        for row in table.rows
        if row[0] != "-"
    }
    assert set(JOINTS) <= told
    for f, u, *_ in (row for row in table.rows if row[0] != "-"):
        assert int(f) + int(u) == 6
    ordered = [int(row[0]) for row in table.rows if row[0] != "-"]
    assert ordered == sorted(ordered)
    # Section 2.1: surface contact means small stress and large forces, contact in a line or point the opposite.
    assert [[str(cell) for cell in row[1:]] for row in contacts.rows] == [
        ["surface", "small", "large"],
        ["line or point", "large", "small"],
    ]
    assert [row[2:] for row in connections.rows[:3]] == [("6", "0"), ("1 … 5", "1 … 5"), ("0", "6")]
    assert [row[2:] for row in connections.rows[3:]] == [("3", "0"), ("1 … 2", "1 … 2"), ("0", "3")]


def test_names_of_figures_2_2_and_2_6():
    names = [row[4].in_language("de") for row in teaching_table("joints")[0].rows]
    assert "Gleitwälzgelenk, Rollgleitgelenk" in names
    assert "Schubgelenk, Schleifengelenk" in names
    chain = Chain.parse("Rollgleitgelenk(0-1) Drehgelenk(1-2) Schleifengelenk(2-0)")
    assert [joint.pair.name for joint in chain.joints] == ["roll_slide", "revolute", "prismatic"]


def test_links():
    kinds, identity, roles = teaching_table("links")
    chains = [e.chain() for e in entries().values() if e.space == "planar"]
    assert [row[2] for row in kinds.rows] == [
        sum(sum(1 for d in chain.degrees.values() if d == k) for chain in chains) for k in range(1, 6)
    ]
    for row in identity.rows:
        assert row[3].endswith(f" = {row[2]}")
    assert roles.rows[0][1].in_language("de") == "Gestell, Kurbel, Koppel, Schwinge"


def test_inversions():
    (table,) = teaching_table("inversions")
    # Section 2.4: rows (d) to (g), what a, b, c, d are.
    printed = [
        ("Kurbelschwinge", "Kurbel Gestell Schwinge Koppel"),
        ("Kurbelschwinge", "Kurbel Koppel Schwinge Gestell"),
        ("Doppelkurbel", "Gestell Kurbel Koppel Kurbel"),
        ("Doppelschwinge", "Koppel Schwinge Gestell Schwinge"),
    ]
    for row, (name, roles) in zip(table.rows, printed, strict=True):
        assert row[-1].in_language("de").startswith(name)
        assert " ".join(cell.in_language("de") for cell in row[2:6]) == roles


def test_grashof():
    table, *sliders = teaching_table("grashof")
    assert {row[-1].in_language("de") for row in table.rows} == {
        kind.name("de") for (relation, _), kind in FOUR_BAR_TYPES.items() if relation in "<=>"
    }
    for row in table.rows:
        lengths = [float(x) for x in row[2:6]]
        low, first, second, high = sorted(lengths)
        relation = {
            "<": low + high < first + second,
            "=": low + high == first + second,
            ">": low + high > first + second,
        }
        assert [sign for sign, holds in relation.items() if holds] == [row[0].split()[3]]
        if row[0].split()[3] == "=":
            continue  # a change point: what turns depends on how it is passed
        size = FourBar(*lengths)
        full = {
            name
            for name, joint in (("a", "R(frame-crank)"), ("c", "R(frame-rocker)"))
            for one in rotatability(size.linkage())
            if one.joint == joint and one.full
        }
        assert full == set(str(row[6]).split(", ")) & {"a", "c"}
    # A slide is a turning joint infinitely far away: the same inequality is left.
    for kind, table in zip((SliderCrank, InvertedSliderCrank), sliders, strict=True):
        assert len(table.rows) == 6
        for row in table.rows:
            first, second, e = (float(x) for x in row[2:5])
            relation = "<=>"[1 + int(np.sign(min(first, second) + e - max(first, second)))]
            assert row[0].split()[3] == relation
            if relation == "=":
                continue
            names = {"a": "R(frame-crank)", "guide": "R(frame-block)"}
            turned = rotatability(kind(first, second, e).linkage())
            full = {name for name, joint in names.items() for one in turned if one.joint == joint and one.full}
            assert full == set(str(row[5]).split(", ")) & set(names), row


def test_forms_of_a_chain_are_those_of_its_lengths():
    names = [
        [str(table.rows[0][-1]) for table in forms_of_chain(Chain.parse(text))]
        for text in (
            "R(0-1) R(1-2) R(2-3) R(3-0)",
            "R(0-1) P(1-2) R(2-3) R(3-0)",
            "P(0-1) P(1-2) R(2-3) R(3-0)",
            "R(0-1) R(1-2) R(2-0) R(2-3)",
            "spherical: R(0-1) R(1-2) R(2-3) R(3-0)",
        )
    ]
    assert names == [["crank-rocker"], ["slider-crank", "inverted slider-crank with swinging guide"], [], [], []]


def test_transfer():
    values, kinds = teaching_table("transfer")
    rows = np.array(values.rows, float)
    assert rows[:, 1] == pytest.approx(-rows[:, 0] / 2)  # external wheels turn against each other
    assert rows[:, 2] == pytest.approx(-rows[:, 0] * 2 / 3)
    assert rows[:, 3] == pytest.approx(rows[:, 0] / 2)
    assert rows[[0, -1], 4] == pytest.approx(rows[0, 4])  # the rocker comes back
    assert rows[6, 5] == pytest.approx(40)  # the stroke of 2a
    assert rows[-1, 7] == pytest.approx(-90)  # one step of a cross with four slots
    turned = move(entries()["geneva"].linkage(), np.radians([-180, 0, 180])).angle("cross")
    assert np.degrees(turned[-1] - turned[0]) == pytest.approx(rows[-1, 7])  # the sense of the general solver
    assert [str(row[1]).split(",")[0] for row in kinds.rows] == 3 * ["uniform"] + 4 * ["non-uniform"]
    assert [row[3] for row in kinds.rows] == ["0%", "0%", "0%", "0%", "0%", "50%", "75%"]
    to_rotation, to_translation = "rotation to rotation", "rotation to translation"
    assert [str(row[4]) for row in kinds.rows] == [*4 * [to_rotation], *2 * [to_translation], to_rotation]
    against, with_drive = "always against the drive", "always with the drive"
    assert [str(row[2]) for row in kinds.rows] == [against, against, with_drive, *3 * ["to and fro"], against]


def test_inversions_of_own_lengths():
    """25 is the shortest length, and 25 + 70 < 50 + 60: the frame b, its neighbours, the one opposite."""
    (table,) = teaching_table("inversions", (50, 25, 60, 70))
    types = {row[1]: str(row[-1]).partition(" (")[0] for row in table.rows}
    assert types == {"a": "crank-rocker", "b": "double crank", "c": "crank-rocker", "d": "Grashof double rocker"}
    sized = sized_inversions(FourBar(50, 25, 60, 70))
    first = {each.frame: str(each.type).partition(" (")[0] for each in reversed(sized)}
    assert first == types
    with pytest.raises(GrueblerError, match="only the table inversions takes lengths"):
        teaching_table("joints", (1, 2, 3, 4))


@pytest.mark.parametrize("name", TABLES)
def test_tables_in_both_languages(name):
    for table in teaching_table(name):
        english, german = (lines_of_table(table, lang) for lang in ("en", "de"))
        assert len(english) == len(german) == len(table.rows) + 2
        assert english[0] != german[0] or name == "x"


def test_unknown_table():
    with pytest.raises(GrueblerError, match="did you mean 'joints'"):
        teaching_table("joint")
