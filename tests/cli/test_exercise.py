"""`gruebler exercise` and `gruebler table` as a student meets them."""

import json

import pytest

from gruebler.cli.commands import command
from gruebler.cli.exercise import _KINDS
from gruebler.teaching.exercises import KINDS, TABLES
from tests.commands import run_main as run


def test_the_parser_knows_what_there_is():
    assert tuple(KINDS) == _KINDS
    choices = {action.dest: action.choices for action in command("table").parser("en")._actions}
    assert choices["name"] == (*TABLES, "counts")


def test_list_and_show(capsys):
    status, out, err = run(capsys, "exercise", "list", "--all", "--lang", "de")
    assert (status, err) == (0, "")
    assert "exercise-15" in out
    assert "000/003, Aufgabe 21" in out
    status, out, _ = run(capsys, "exercise", "show", "15", "3.6.2")
    assert status == 0
    assert "Asked:\n  H: stroke, the distance of the dead centres" in out
    assert "71.66" not in out  # the answer stays hidden


def test_solve(capsys):
    status, out, err = run(capsys, "exercise", "solve", "15", "--lang", "de")
    assert (status, err) == (0, "")
    assert "H = l_a - l_i = 133,51 - 61,8466 = 71,6637 mm" in out
    assert "[gedruckt 7,2 cm: stimmt]" in out
    assert "[gedruckt 18,4°: abweichend. Aus einer Zeichnung abgelesen" in out
    assert "beide Verfahren ergeben" in out
    status, out, _ = run(capsys, "exercise", "solve", "15", "16", "--json")
    fifteen, sixteen = json.loads(out)
    assert fifteen["results"]["H"]["value"] == pytest.approx(71.66371484392198)
    assert fifteen["results"]["phi_max"]["symbol"] == "φ_max"
    assert all(check["holds"] for check in fifteen["checks"])
    assert [one["agrees"] for one in fifteen["printed"]] == [True, False]
    assert len(sixteen["steps"][-1]["table"]["rows"]) == 25


def test_new_and_check(capsys):
    status, out, err = run(capsys, "exercise", "new", "--kind", "dead-centre", "--seed", "7", "--count", "2")
    assert (status, err) == (0, "")
    assert "(dead-centre-1-7)" in out
    assert "(dead-centre-1-8)" in out
    assert run(capsys, "exercise", "new", "--kind", "dead-centre", "--seed", "7", "--count", "2")[1] == out
    given = json.loads(run(capsys, "exercise", "show", "dead-centre-1-7", "--json")[1])[0]["given"]
    stroke = 2 * given["a"]
    assert run(capsys, "exercise", "check", "dead-centre-1-7", f"H={stroke}")[0] == 0
    status, out, _ = run(capsys, "exercise", "check", "dead-centre-1-7", f"H={stroke / 2}", "--lang", "de")
    assert status == 1
    assert "falsch. Der Hub ist zweimal die Kurbellänge" in out
    assert "Nicht beantwortet: l_a, l_i" in out
    solved = run(capsys, "exercise", "new", "--kind", "grashof", "--level", "2", "--solutions", "--json")[1]
    assert json.loads(solved)[0]["results"]


def test_check_as_json(capsys):
    status, out, _ = run(capsys, "exercise", "check", "6", "F=3", "n=6", "--json")
    found = json.loads(out)
    assert status == 1
    assert found["right"] is False
    assert [one["mark"] for one in found["answers"]] == ["wrong", "right"]
    assert "Doppelgelenk" in found["answers"][0]["hint"]["de"]


@pytest.mark.parametrize("name", ["k", "time_ratio"])
def test_an_answer_has_the_name_under_which_it_was_given(capsys, name):
    status, out, _ = run(capsys, "exercise", "check", "exercise-17", f"{name}=2.39")
    assert (status, out.splitlines()[0]) == (0, f"{name} = 2.39: right (2.38791)")
    answer = json.loads(run(capsys, "exercise", "check", "exercise-17", f"{name}=2.39", "--json")[1])["answers"][0]
    assert (answer["key"], answer["name"]) == ("time_ratio", name)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("solve", "99"), "there is no exercise '99'"),
        (("check", "11", "H"), "KEY=ANSWER"),
        (("check", "11", "H=forty"), "expected a number"),
        (("check", "11", "q=1"), "does not ask for 'q'"),
        (("new", "--kind", "grashof", "--seed", "-3"), "seed is a whole number"),
        (("new", "--kind", "grashof", "--count", "0"), "--count is a number"),
        (("new", "--kind", "gear"), "invalid choice"),
    ],
)
def test_wrong_usage(capsys, arguments, words):
    status, out, err = run(capsys, "exercise", *arguments)
    assert (status, out) == (2, "")
    assert words in err


@pytest.mark.parametrize("name", TABLES)
def test_tables(capsys, name):
    status, out, err = run(capsys, "table", name, "--lang", "de")
    assert (status, err) == (0, "")
    assert out.splitlines()
    assert json.loads(run(capsys, "table", name, "--json")[1])[0]["rows"]


def test_tables_of_counts(capsys, tmp_path):
    """They are listed, printed with their methods, and written byte for byte as they are stored."""
    assert run(capsys, "table", "counts")[1].splitlines()[1].split()[:2] == ["chains", "60"]
    out = run(capsys, "table", "counts", "assur_groups", "--lang", "de")[1]
    assert "Zweites Verfahren: 1, 2, 10, 173 im Druck (Peisach 2007)" in out
    printed = json.loads(run(capsys, "table", "counts", "assur_groups", "--json")[1])
    assert printed["rows"][3] == {"links": 8, "groups": 173}
    path = tmp_path / "groups.csv"
    assert run(capsys, "table", "counts", "assur_groups", "-o", str(path))[0] == 0
    assert path.read_text().startswith("links,groups\n2,1\n4,2\n6,10\n8,173\n")
    assert run(capsys, "table", "counts", "assur_groups", "--decimal-comma", "-o", str(path))[0] == 0
    assert path.read_text().startswith("links;groups\n2;1\n")
    assert "'chains'" in run(capsys, "table", "counts", "chian")[2]
    assert "only tables of counts" in run(capsys, "table", "joints", "-o", str(path))[2]
    assert "takes one table" in run(capsys, "table", "counts", "-o", str(path))[2]


def test_an_answer_is_given_once(capsys):
    status, _, err = run(capsys, "exercise", "check", "6", "F=2", "F=1")
    assert status == 2
    assert "F is given twice" in err


def test_own_values(capsys):
    status, out, _ = run(capsys, "exercise", "solve", "15", "--set", "a=40", "--set", "b=120")
    assert status == 0
    assert "H = l_a - l_i = 158.745 - 77.4597 = 81.2854 mm" in out
    assert "printed" not in out
    assert "KEY=VALUE" in run(capsys, "exercise", "solve", "15", "--set", "a")[2]
    assert "gives" not in run(capsys, "table", "inversions", "25,70,40,70")[2]
    assert "four lengths" in run(capsys, "table", "inversions", "slider-crank:20,50")[2]


def test_inversions_of_lengths(capsys, tmp_path):
    out = run(capsys, "inversions", "four-bar:2,5,4,5")[1]
    assert [line.split()[:2] for line in out.splitlines()[1:]] == [
        [frame, drive] for frame, drives in zip("abcd", ("bd", "ac", "bd", "ac"), strict=True) for drive in drives
    ]
    page = tmp_path / "inversions.html"
    assert run(capsys, "inversions", "slider-crank:20,50", "-o", str(page))[0] == 0
    text = page.read_text(encoding="utf-8")
    assert text.count("<figure>") == 8
    assert text.count("inverted slider-crank with turning guide</figcaption>") == 2
    assert "without lengths" in run(capsys, "inversions", "four-bar:2,5,4,5", "--drives")[2]
    assert "need lengths" in run(capsys, "inversions", "quad", "-o", str(page))[2]
