"""What one command prints another one reads: entries, reports, lists of mechanisms."""

import io
import json

import pytest

from gruebler import Chain, mobility_report
from gruebler.cli import main
from gruebler.files.screws import screws_to_json, spatial_from_json
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.teaching.catalog import entries, exercises
from tests.commands import run_main as run


def no_constant(word):
    raise AssertionError(f"{word} is not JSON")


def strict(text):
    return json.loads(text, parse_constant=no_constant)


def test_all_entries_as_json(capsys):
    status, out, err = run(capsys, "catalog", "list", "--json")
    assert (status, err) == (0, "")
    assert [one["id"] for one in strict(out)] == [*entries(), *exercises()]
    status, shown, _ = run(capsys, "catalog", "show", *entries(), *exercises(), "--json")
    assert status == 0
    assert strict(shown) == strict(out)


def test_entries_as_json_are_read_again(capsys, tmp_path):
    """The machine of the data is that of the file: same chain, same claims, same freedoms by its screws."""
    file = tmp_path / "entries.json"
    file.write_text(run(capsys, "catalog", "show", "geneva", "scissor_lr", "scissor_tandem", "vcomp", "--json")[1])
    status, out, err = run(capsys, "check", str(file), "--json")
    assert (status, err) == (0, "")
    again = strict(out)
    assert again == strict(run(capsys, "check", "geneva", "scissor_lr", "scissor_tandem", "vcomp", "--json")[1])


def test_an_infinite_radius_goes_through_json():
    record = entries()["geneva"]
    spatial = record.placed()
    assert isinstance(spatial, SpatialLinkage)
    text = json.dumps(screws_to_json(spatial), allow_nan=False)
    assert '"inf"' in text
    assert spatial_from_json(strict(text)).places == spatial.places


def test_reports_are_read_again(capsys, tmp_path):
    """Every machine's report, multiple and repeated joints and all spaces among them."""
    file = tmp_path / "reports.json"
    out = run(capsys, "check", *entries(), "R(a-b) R(a-b) P(b-c) R(c-a)", "--json")[1]
    file.write_text(out, encoding="utf-8")
    status, again, _ = run(capsys, "check", str(file), "--json")
    derived = ("links", "joints", "space", "counted", "generic", "verdict", "idle_freedoms")
    assert status == 0
    assert [[one[key] for key in derived] for one in strict(again)] == [
        [one[key] for key in derived] for one in strict(out)
    ]


@pytest.mark.parametrize("id", entries())
def test_a_report_holds_its_chain(id):
    chain = entries()[id].chain()
    assert Chain.from_json(mobility_report(chain).to_json()) == chain


def test_a_name_with_a_number_sign():
    chain = Chain([("revolute", ("a)#2", "b")), ("revolute", ("a)#2", "b")), ("revolute", ("b", "c"))])
    assert Chain.from_json(mobility_report(chain).to_json()) == chain


def test_exercises_stand_apart(capsys):
    """The list names them under a heading of their own, and a command for machines says what they are."""
    out = run(capsys, "catalog", "list")[1]
    machines, _, tasks = out.partition("\n\n")
    assert "exercise-" not in machines
    assert all(f"\n{id} " in tasks for id in exercises())
    status, _, err = run(capsys, "draw", "exercise-3")
    assert status == 2
    assert "'exercise-3' is an exercise; the machines in it are quad, e3_watt, e3_steph" in err


def test_json_of_a_report_is_read_from_standard_input(capsys, monkeypatch):
    assert main(["check", "crankrocker", "--json"]) == 0
    document = capsys.readouterr().out
    monkeypatch.setattr("sys.stdin", io.StringIO(document))
    assert main(["check", "-", "--json"]) == 0
    again = json.loads(capsys.readouterr().out)
    assert again[0]["generic"] == json.loads(document)[0]["generic"] == 1
