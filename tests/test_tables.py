"""The tables of docs/tables: their checksums, and their first rows computed again."""

import csv
import json
from hashlib import sha256

import pytest

from benchmarks import oeis, tables
from benchmarks.tables import FOLDER, TABLES, text_of
from gruebler.structure.enumeration import count_simple_chains


def test_every_table_has_its_record():
    records = json.loads((FOLDER / "records.json").read_text(encoding="utf-8"))
    assert set(records) == set(TABLES) == {path.stem for path in FOLDER.glob("*.csv")}
    for name, record in records.items():
        assert sha256((FOLDER / f"{name}.csv").read_bytes()).hexdigest() == record["sha256"]
        assert record["command"] == f"python -m benchmarks.tables {name}"


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
        ("driven_by_class", 10),
        ("epicyclic_trains", 6),
        pytest.param("second_method", 12, marks=pytest.mark.slow),
    ],
)
def test_first_rows(name, most):
    table = list(csv.DictReader((FOLDER / f"{name}.csv").read_text(encoding="utf-8").splitlines()))
    made = list(csv.DictReader(text_of(TABLES[name](most)).splitlines()))
    assert made
    assert made == [row for row in table if int(row["links"]) <= most]


def test_the_b_file():
    terms = dict(
        [int(word) for word in line.split()]
        for line in (FOLDER / "b233288.txt").read_text(encoding="utf-8").splitlines()
    )
    assert list(terms) == list(range(1, 10))
    for k in range(1, 7):
        assert terms[k] == count_simple_chains(2 * k + 2).chains


def test_the_entries_for_the_oeis_are_those_of_the_tables():
    assert {path.name: path.read_text(encoding="utf-8") for path in oeis.OEIS.iterdir()} == oeis.files()


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
