"""What is printed in an altered exercise does not pass in silence."""

import pytest

from gruebler.base.text import message
from gruebler.teaching.exercises import all_exercises, exercise, faults, solve
from gruebler.teaching.exercises.solution import Check, Solution
from gruebler.teaching.worksheets.files import document_bytes
from gruebler.teaching.worksheets.tasks import solution_document
from tests.commands import run_command
from tests.documents.altered import altered_catalog

# exercise 12: sqrt(75^2 + 60^2 - 30^2) = 91.2414; exercise 13: arccos(15/75) = 78.463 degrees, printed 78.2
D_OF_12 = ("solved/exercise-12.toml", ('"91.2"', '"92.2"'))
RIGHT_13 = ("solved/exercise-13.toml", ('printed = "78.2"', 'printed = "78.5"'))


def test_no_exercise_is_at_fault():
    assert [str(fault) for task in all_exercises().values() for fault in faults(task, solve(task))] == []


@pytest.mark.parametrize(
    ("lang", "sentence"),
    [
        ("en", "exercise-12: d: the source prints 92.2 mm, the solution gives 91.2414 mm"),
        ("de", "exercise-12: d: Die Quelle druckt 92,2 mm, die Lösung ergibt 91,2414 mm"),
    ],
)
@pytest.mark.parametrize("options", [(), ("--json",), ("-o", "12.md")], ids=["text", "json", "document"])
def test_an_altered_print_ends_with_1_and_a_sentence(tmp_path, monkeypatch, capsys, lang, sentence, options):
    monkeypatch.chdir(tmp_path)
    with altered_catalog(tmp_path, *D_OF_12):
        status, _, err = run_command(capsys, "exercise", "solve", "12", "--lang", lang, *options)
    assert status == 1
    assert sentence in err
    assert run_command(capsys, "exercise", "solve", "12", "--lang", lang)[::2] == (0, "")


def test_a_reason_for_a_difference_that_is_none_is_said(tmp_path, capsys):
    with altered_catalog(tmp_path, *RIGHT_13):
        status, _, err = run_command(capsys, "exercise", "solve", "13")
    assert status == 1
    assert "mu_min2: the source prints 78.5° and the solution gives 78.463°; they agree, but" in err


def test_methods_that_differ_are_said():
    task = exercise("12")
    right = solve(task)
    wrong = Solution(
        right.parts, right.results, (*right.checks, Check(text=message("d by drawing"), first=91.2, second=91.3))
    )
    assert [str(fault) for fault in faults(task, wrong)] == ["exercise-12: d by drawing: 91.2 and 91.3 DIFFER"]


def test_the_written_solution_says_what_is_printed():
    page = document_bytes(solution_document([exercise("13")]), "md").decode("utf-8")
    assert "| 66.4218° | printed 66.4°: agrees |" in page
    assert "| 78.463° | printed 78.2°: differs. Misprint: arccos 0.2 is 78.46°" in page
    assert "Check by a second method:" in page
    german = document_bytes(solution_document([exercise("16")], lang="de"), "md").decode("utf-8")
    assert "Bemerkung: Auf der Koppel liegen die Punkte bei (u; v)" in german
    assert "± 78.463°" in document_bytes(solution_document([exercise("11")]), "md").decode("utf-8")
