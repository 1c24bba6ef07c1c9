"""Teaching tables are true: every row is derived, and derived again here by another way."""

import numpy as np
import pytest

from gruebler import FourBar, GrueblerError, rotatability
from gruebler.catalog import entries
from gruebler.chain.pairs import PAIRS
from gruebler.exercises import TABLES, lines_of_table, teaching_table
from gruebler.fourbar import FOUR_BAR_TYPES

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
    (table,) = teaching_table("joints")
    assert len(table.rows) == len(PAIRS)
    told = {(int(row[0]), row[3].in_language("de"), row[4].in_language("de")) for row in table.rows if row[0] != "-"}
    assert set(JOINTS) <= told
    for f, u, *_ in (row for row in table.rows if row[0] != "-"):
        assert int(f) + int(u) == 6
    ordered = [int(row[0]) for row in table.rows if row[0] != "-"]
    assert ordered == sorted(ordered)


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
    (table,) = teaching_table("grashof")
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


def test_transfer():
    values, kinds = teaching_table("transfer")
    rows = np.array(values.rows, float)
    assert rows[:, 1] == pytest.approx(rows[:, 0] / 2)
    assert rows[[0, -1], 2] == pytest.approx(rows[0, 2])  # the rocker comes back
    assert rows[6, 3] == pytest.approx(40)  # the stroke of 2a
    assert rows[-1, 5] == pytest.approx(90)  # one step of a cross with four slots
    assert [str(row[1]).split(",")[0] for row in kinds.rows] == ["uniform"] + 4 * ["non-uniform"]
    assert [row[3] for row in kinds.rows] == ["0%", "0%", "0%", "50%", "75%"]
    assert [str(row[2]) for row in kinds.rows] == ["one sense", "to and fro", "to and fro", "to and fro", "one sense"]


@pytest.mark.parametrize("name", TABLES)
def test_tables_in_both_languages(name):
    for table in teaching_table(name):
        english, german = (lines_of_table(table, lang) for lang in ("en", "de"))
        assert len(english) == len(german) == len(table.rows) + 2
        assert english[0] != german[0] or name == "x"


def test_unknown_table():
    with pytest.raises(GrueblerError, match="did you mean 'joints'"):
        teaching_table("joint")
