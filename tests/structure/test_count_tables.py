"""The tables of docs/tables: their checksums, and their first rows computed again."""

import csv
import io
import json
import re
from collections import Counter
from hashlib import sha256
from itertools import combinations

import numpy as np
import pytest

from benchmarks import oeis, tables
from benchmarks.real_modes import joints_of_text, points_of_text
from benchmarks.tables import FOLDER, TABLES, text_of
from gruebler.base.errors import GrueblerError
from gruebler.mechanics.kinematics.assembly_modes import conditions, search_modes
from gruebler.mechanics.kinematics.kernel_records import PIN
from gruebler.structure.count_tables import count_table, count_tables
from gruebler.structure.enumeration import count_chains
from tests.structure.assur.monodromy_oracle import Truss


def test_every_table_has_its_record():
    records = json.loads((FOLDER / "records.json").read_text(encoding="utf-8"))
    assert set(records) == set(TABLES) == {path.stem for path in FOLDER.glob("*.csv")}
    for name, record in records.items():
        assert sha256((FOLDER / f"{name}.csv").read_bytes()).hexdigest() == record["sha256"]
        assert record["command"] == f"python -m benchmarks.tables {name}"


def test_every_table_is_as_its_schema_says():
    """Columns and their order, types of all cells, keys that no two rows share; each text in both languages."""
    assert set(count_tables()) == set(TABLES)
    for name, table in count_tables().items():
        header, *lines = list(csv.reader((FOLDER / f"{name}.csv").read_text(encoding="utf-8").splitlines()))
        assert header == list(table.columns)
        types = [column.type for column in table.columns.values()]
        for row, cells in zip(table.rows, lines, strict=True):
            for value, cell, kind in zip(row, cells, types, strict=True):
                assert value == float(cell) if kind == "number" else str(value) == cell
        places = [header.index(column) for column in table.key]
        keys = [tuple(row[k] for k in places) for row in table.rows]
        assert len(set(keys)) == len(keys) > 0
        for text in (table.title, table.method, table.second_method, *(c.meaning for c in table.columns.values())):
            assert {text.en, text.de}.isdisjoint({""})
            assert text.en != text.de
    used = {column for table in count_tables().values() for column in table.columns}
    assert used == set(json.loads((FOLDER / "schema.json").read_text(encoding="utf-8"))["columns"])


def test_a_table_as_json_and_parquet():
    """Both have every row, and what says where it comes from."""
    table = count_table("truss_modes")
    assert table.to_json()["rows"][1] == {
        "links": 5,
        "joints": "0-2 2-1 0-3 3-1 0-4 4-1",
        "modes": 6,
        "spherical_modes": 8,
    }
    assert table.to_json("de")["title"].startswith("Jedes Baranov-Fachwerk")
    parquet = pytest.importorskip("pyarrow.parquet")
    for each in count_tables().values():
        stored = parquet.read_table(io.BytesIO(each.parquet()))
        assert [tuple(row.values()) for row in stored.to_pylist()] == each.rows
        assert stored.schema.metadata[b"command"].decode() == each.command
        assert stored.schema.metadata[b"second_method"].decode() == each.second_method.en
    with pytest.raises(GrueblerError, match="did you mean 'chains'"):
        count_table("chain")


@pytest.mark.parametrize(
    ("name", "most"),
    [
        ("chains", 11),
        ("fractionated", 11),
        ("multiple_joints", 9),
        ("sliding", 6),
        ("assur_groups", 12),
        ("assembly_modes", 11),
        ("truss_modes", 11),
        ("real_modes", 5),
        pytest.param("real_modes", 9, marks=pytest.mark.slow),
        ("driven_by_class", 10),
        ("epicyclic_trains", 6),
        pytest.param("sampled_chains", 8, marks=pytest.mark.slow),
        pytest.param("sampled_by_mobility", 10, marks=pytest.mark.slow),
        pytest.param("second_method", 12, marks=pytest.mark.slow),
    ],
)
def test_first_rows(name, most):
    table = list(csv.DictReader((FOLDER / f"{name}.csv").read_text(encoding="utf-8").splitlines()))
    made = list(csv.DictReader(text_of(TABLES[name](most)).splitlines()))
    assert made
    assert made == [row for row in table if int(row["links"]) <= most]


@pytest.mark.parametrize("most", [7, pytest.param(9, marks=pytest.mark.slow)])
def test_real_modes_by_random_starts(most):
    """As many as Newton's method finds from random starts; each is proved to be there, alone within a small ball."""
    modes = {(row[0], row[1]): row[2] for row in count_table("truss_modes").rows}
    stored = [row for row in count_table("real_modes").rows if row[0] <= most]
    for links, joints, possible, real, points in stored:
        pairs = joints_of_text(joints)
        places = points_of_text(pairs, points)
        places /= np.abs(places).mean()
        rows = [(PIN, a - 1, b - 1, complex(p), 1, complex(q), 1) for (a, b), (p, q) in zip(pairs, places, strict=True)]
        found = search_modes(conditions(rows))
        assert len(found) == real <= possible == modes[links, joints]
        assert real == possible or links == 9
        balls = [kantorovich(Truss(links, pairs).closing(places), angles) for angles in found.poses[:, :, 2]]
        for (a, reach), (b, other) in combinations(balls, 2):
            assert np.linalg.norm(a - b) > reach + other


def kantorovich(closing, angles):
    """Cosines and sines of all links but the first, and a radius in which there is exactly one real mode.

    The loops are linear, the circles c² + s² = 1 quadratic with a second derivative of norm 2 at most: one real
    solution lies within 2 |step| if 2 |inverse slope| |step| <= 1/2 (Kantorovich 1948); rounding is far below
    what is left.
    """
    x = np.concatenate([np.cos(angles), np.sin(angles)])
    turning, n = closing[:, 1:], len(angles)
    loops = np.block([[turning.real, -turning.imag], [turning.imag, turning.real]])
    slope = np.concatenate([loops, np.hstack([2 * np.diag(x[:n]), 2 * np.diag(x[n:])])])
    fixed = np.concatenate([closing[:, 0].real, closing[:, 0].imag])
    miss = np.concatenate([loops @ x + fixed, x[:n] ** 2 + x[n:] ** 2 - 1])
    inverse = np.linalg.inv(slope)
    step = np.linalg.norm(inverse @ miss)
    assert 2 * np.linalg.norm(inverse, 2) * step < 1e-6
    return x, 2 * step + 1e-12


def test_driven_mechanisms_of_all_classes_are_those_of_the_chains():
    """Listed by the atlas, and counted by Burnside's lemma."""
    sums = Counter()
    for links, _, number in count_table("driven_by_class").rows:
        sums[links] += number
    drives = {row[1]: row[4] for row in count_table("chains").rows if row[0] == 1}
    assert sums == {links: drives[links] for links in (4, 6, 8, 10)}


def test_the_estimates_are_near_what_was_counted():
    """Six to 20 links, each within three standard deviations; the relative ones are small where it matters."""
    counted = {row[1]: row[2] for row in count_table("chains").rows if row[0] == 1}
    for links, found, deviation, _ in count_table("sampled_chains").rows:
        if links in counted:
            assert abs(found - counted[links]) <= 3 * deviation
    assert counted[20] == 141_954_670_341


def test_the_estimates_of_other_mobilities_are_near_what_was_counted():
    """All of F = 2 to 7 with two loops or more: none is farther off than four standard deviations, and their squares
    are as large on the mean as chance has it."""
    counted = {row[:2]: row[2] for row in count_table("chains").rows}
    rows = count_table("sampled_by_mobility").rows
    assert {row[:2] for row in rows} == {(f, n) for f, n in counted if f > 1 and n > f + 3}
    off = np.array([(found - counted[f, n]) / deviation for f, n, found, deviation, _ in rows if n > f + 7])
    assert np.abs(off).max() < 4
    assert 0.4 < np.mean(off**2) < 1.8


def test_the_b_file():
    terms = dict(
        [int(word) for word in line.split()]
        for line in (FOLDER / "b233288.txt").read_text(encoding="utf-8").splitlines()
    )
    assert list(terms) == list(range(1, 10))
    for k in range(1, 7):
        assert terms[k] == count_chains(2 * k + 2).chains


def test_the_entries_for_the_oeis_are_those_of_the_tables():
    assert {path.name: path.read_text(encoding="utf-8") for path in oeis.OEIS.iterdir()} == oeis.files()


def test_the_b_files_are_as_the_oeis_wants_them():
    """Each line an index and a term, indices one by one from the OFFSET of the draft, terms those of its DATA; no claim
    that a sequence is new, but for what the head of the drafts says was searched."""
    head, *drafts = (oeis.OEIS / "drafts.txt").read_text(encoding="utf-8").split("\n\n")
    assert "None is sent" in " ".join(head.split())
    files = []
    for draft in drafts:
        fields = dict(line.split(": ", 1) for line in draft.replace("\n  ", " ").strip().splitlines())
        assert list(fields) == ["NAME", "DATA", "OFFSET", "COMMENTS", "LINKS", "KEYWORD"]
        name = fields["LINKS"].split(",")[0]
        content = (oeis.OEIS / name).read_bytes()
        assert re.fullmatch(rb"(\d+ \d+\n)+", content)
        indices, terms = zip(*(line.split() for line in content.decode("ascii").splitlines()), strict=True)
        first = int(fields["OFFSET"])
        assert list(map(int, indices)) == list(range(first, first + len(terms)))
        assert ", ".join(terms) == fields["DATA"]
        assert not re.search(r"not in the OEIS|new sequence|unknown", draft)
        files.append(name)
    assert sorted([*files, "drafts.txt"]) == sorted(path.name for path in oeis.OEIS.iterdir())


def test_terms_that_stand_in_print():
    """A233288, Peisach 2007, J. Mech. Des. 141(4) 043301; of multiple joints and F = 0 an unfiltered generator."""
    entries = {entry.file: entry for entry in oeis.sequences()}
    assert entries["b_chains_1.txt"].b_file().startswith("1 1\n2 2\n3 16\n4 230\n5 6856\n6 318162\n7 19819281\n")
    assert entries["b_assur_groups.txt"].b_file().startswith("1 1\n2 2\n3 10\n4 173\n")
    assert entries["b_chains_0.txt"].b_file().startswith("1 1\n2 1\n3 3\n4 28\n")
    assert entries["b_multiple_joints_1.txt"].b_file().startswith("1 1\n2 4\n3 60\n")
    assert entries["b_trains_displacement_1.txt"].b_file().startswith("3 1\n4 3\n5 13\n6 81\n")
    assert [entries[f"b_{name}.txt"].index() for name in ("chains_2", "assur_groups", "trains_rotation_1")] == [
        "2n + 3 links",
        "2n links",
        "n links",
    ]


def test_evidence_finds_what_is_other(monkeypatch):
    """One row is not that of the file; what takes longer is named with its command."""
    wrong = [("links", "highest_class", "driven_mechanisms"), (4, 2, 2)]
    monkeypatch.setitem(TABLES, "driven_by_class", lambda _: iter(wrong))
    verdicts = dict(tables.compared(6))
    assert verdicts.pop("driven_by_class") == "OTHER THAN the file"
    assert verdicts.pop("truss_modes") == "the same"
    assert len(verdicts) == len(TABLES) - 2
    assert all(verdict.endswith(f"python -m benchmarks.tables {name}") for name, verdict in verdicts.items())
