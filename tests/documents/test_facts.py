"""The facts of the teaching documents: every one holds, none is missing, and what is altered is noticed."""

import ast
from pathlib import Path

import pytest

from gruebler.teaching.catalog import entries
from gruebler.teaching.exercises import all_exercises
from gruebler.teaching.sheets import sheet
from tests.documents import exercise_facts, machine_facts, sheet_facts, structure_facts
from tests.documents.altered import altered_catalog
from tests.documents.fact import Fact, alike

FACTS = [*structure_facts.FACTS, *machine_facts.FACTS, *exercise_facts.FACTS, *sheet_facts.FACTS]


@pytest.mark.parametrize("fact", FACTS, ids=lambda fact: fact.name)
def test_fact(fact):
    assert fact.fault() is None


def test_each_fact_stands_there_once():
    assert len({fact.name for fact in FACTS}) == len(FACTS) > 500


def test_the_own_computations_use_nothing_of_the_library():
    text = (Path(__file__).parent / "independent.py").read_text(encoding="utf-8")
    nodes = ast.walk(ast.parse(text))
    modules = {name.name for node in nodes if isinstance(node, ast.Import) for name in node.names}
    modules |= {node.module for node in ast.walk(ast.parse(text)) if isinstance(node, ast.ImportFrom)}
    assert modules == {"__future__", "cmath", "collections.abc", "math"}


# --- nothing is missing ------------------------------------------------------------------------------


def test_every_exercise_and_each_of_its_questions_has_a_fact():
    """What the catalog has as printed, and no digit more or less."""
    assert {f"exercise-{number}" for number in (*range(1, 22), "5b")} <= {*all_exercises()}
    printed = {(fact.subject, fact.key, fact.printed or fact.word) for fact in exercise_facts.FACTS if fact.key}
    asked = {
        (id, question.key, question.printed or "") for id, task in all_exercises().items() for question in task.asked
    }
    assert printed == asked
    assert {*all_exercises()} <= {fact.subject for fact in FACTS}


def test_every_number_of_the_sheet_has_a_fact():
    page = sheet("mzc")
    rows = (*page.dimensions, *page.quantities, *page.example_values)
    assert {row.id for row in rows} == {fact.key for fact in sheet_facts.FACTS if fact.key}


def test_every_machine_has_facts():
    assert [row.id for row in machine_facts.STRUCTURES] == sorted(entries())
    assert {*entries()} <= {fact.subject for fact in machine_facts.FACTS} <= {*entries(), ""}


MISPRINTS = {
    "000/003, section 3.2.2: time of the shorter stroke in ms, labelled T_max": "48.8",
    "000/003, section 3.2.2: difference of the times in ms": "30.4",
    "000/003, section 3.4: μ_II": "101",
    "000/003, section 3.4: μ_II folded": "79",
    "000/003, section 3.4: α_II": "11",
    "000/003, section 3.4: λ of a = 2, b = 10": "0.4",
    "000/003, exercise 13: μ_min of 15, 75": "78.2",
    "000/003, exercise 15: difference of the crank angles of both strokes": "18.4",
    "001: first cognate: l4* is printed as 40/3 √3": "23.094",
}


def test_misprints_have_a_reason_and_a_right_value():
    assert {fact.name: fact.printed for fact in FACTS if fact.misprint} == MISPRINTS
    assert all(fact.value is not None for fact in FACTS if fact.misprint)


# --- what a fact notices -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("fact", "fault"),
    [
        ({"derive": lambda: 91.2414, "printed": "91.2"}, None),
        ({"derive": lambda: 91.2501, "printed": "91.2"}, "derived 91.2501, printed 91.2"),
        ({"derive": lambda: 61.6, "printed": "62", "value": 61.6}, None),
        ({"derive": lambda: 61.6, "printed": "62", "value": 61.7}, "derived 61.6, should be 61.7"),
        ({"derive": lambda: 78.463, "printed": "78.2", "value": 78.463, "misprint": "x"}, None),
        (
            {"derive": lambda: 78.21, "printed": "78.2", "value": 78.21, "misprint": "x"},
            "derived 78.21 agrees with the print 78.2, which is marked wrong",
        ),
        ({"derive": lambda: "crank", "value": "rocker"}, "derived 'crank', should be 'rocker'"),
        ({"derive": lambda: True, "value": 1}, "derived True, should be 1"),
        ({"derive": lambda: [1.0, 2.0], "value": [1.0]}, "derived [1.0, 2.0], should be [1.0]"),
        ({"derive": lambda: float("nan"), "value": 1.0}, "derived nan, should be 1.0"),
        ({"derive": lambda: 1.0}, "nothing is stated"),
    ],
)
def test_what_a_fact_says(fact, fault):
    assert Fact(place="x", states="y", **fact).fault() == fault


def test_numbers_words_and_lists_are_compared_as_what_they_are():
    assert alike([1.0, 2.0 + 1e-10], [1.0, 2.0], 1e-9)
    assert not alike([1.0, 2.0 + 1e-8], [1.0, 2.0], 1e-9)
    assert alike([3, {1: 4}], [3, {1: 4}], 1e-9)
    assert not alike([3, {1: 4}], [3, {1: 5}], 1e-9)
    assert not alike(None, 1.0, 1e-9)


# --- what is altered turns the table red -------------------------------------------------------------

BREAKS = [
    # file of the catalog, what stands there, what is put there, a fact that must fail
    ("machines/vcomp.toml", "[0, 0, 135]", "[0, 0, 120]", "second cylinder at 135°"),
    ("machines/vcomp.toml", "n = 6", "n = 7", "vcomp: n = 6"),
    ("machines/vcomp.toml", "counted = 1", "counted = 2", "vcomp: n = 6"),
    (
        "machines/vcomp.toml",
        '"R(conrod1-piston1)" = [110, 0]',
        '"R(conrod1-piston1)" = [111, 0]',
        "first cylinder at 45°",
    ),
    ("machines/vcomp.toml", "[135, 315]", "[120, 300]", "every claim holds"),
    ("machines/wiper.toml", 'blade = "parallel"', 'blade = "swings"', "wiper: claims on its motion"),
    ("machines/crankrocker.toml", "c = 40", "c = 41", "crankrocker: c"),
    ("machines/lambda.toml", "b = 50", "b = 51", "lambda: b"),
    ("machines/conchoid.toml", "at = [90, 0]", "at = [91, 0]", "conchoid: b = AC"),
    ("machines/watt_axle.toml", "[-60, 15]", "[-61, 15]", "watt_axle: a"),
    ("machines/crane.toml", "= [80, 0]", "= [81, 0]", "crane: a = 30"),
    ("machines/mzc.toml", "d = 4 ", "d = 4.01 ", "mzc: l4"),
    ("machines/kneader.toml", "c = 90", "c = 92", "kneader: the path of K"),
    ("machines/wiper.toml", "[300, 120]", "[301, 120]", "blade keeps its direction"),
    ("machines/loco2.toml", "c = 300", "c = 301", "loco2"),
    ("solved/exercise-12.toml", "91.2", "92.2", "exercise 12: frame of the central crank-rocker"),
    ("solved/exercise-12.toml", "b = 75", "b = 76", "exercise 12: frame of the central crank-rocker"),
    ("solved/exercise-13.toml", '"78.2"', '"78.4"', "exercise 13: μ_min of 15, 75"),
    ("solved/example-3.2.2-eccentric.toml", '"48.8"', '"84.8"', "time of the shorter stroke"),
    ("solved/exercise-20.toml", "e = 50", "e = 51", "exercise 20: h"),
    ("exercises/exercise-5.toml", 'machine = "wiper"', 'machine = "loader"', "F of wiper"),
    ("sheets/mzc.toml", 'printed = "8.165"', 'printed = "8.156"', "B0 K_I"),
    ("sheets/mzc.toml", 'printed = "25/3"', 'printed = "26/3"', "l1*"),
    ("sheets/mzc.toml", "40/3*sqrt(3)", "40/9*sqrt(3)", "l4*"),
]


@pytest.mark.parametrize(("file", "old", "new", "noticed"), BREAKS, ids=[f"{row[0]} {row[2]}" for row in BREAKS])
def test_what_is_altered_is_noticed(tmp_path, file, old, new, noticed):
    subject = Path(file).stem
    about = [fact for fact in FACTS if fact.subject == subject]
    with altered_catalog(tmp_path, file, (old, new)):
        failing = {}
        for fact in about:
            try:
                fault = fact.fault()
            except Exception as error:  # an altered machine may not close any more
                fault = str(error)
            if fault is not None:
                failing[fact.name] = fault
    assert [name for name in failing if noticed in name], failing


def test_an_altered_catalog_is_forgotten_afterwards(tmp_path):
    (fact,) = (fact for fact in FACTS if fact.name.endswith("vcomp: n = 6, joints by f {1: 7}, F = 1"))
    with altered_catalog(tmp_path, "machines/vcomp.toml", ("n = 6", "n = 7")):
        assert fact.fault() == "derived [6, {1: 7}, 7, {1: 7}, 1], should be [6, {1: 7}, 6, {1: 7}, 1]"
    assert fact.fault() is None
