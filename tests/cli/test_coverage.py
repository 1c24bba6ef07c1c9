"""The table of concepts and machines: nothing of the seeds is missing, and everything in it works."""

import ast
import json
import shlex
from pathlib import Path

import pytest

from gruebler.catalog import entries
from gruebler.cli import coverage
from gruebler.cli.commands import command as command_named
from gruebler.errors import CatalogError, GrueblerError

# REFERENCE A1, row by row: where in the seeds, and a word of its name.
CONCEPTS = (
    """
1 Übertragungsfunktion|1 Getriebesynthese|1 ungleichmäßig|1 Führungsbahn|1 Schrittgetriebe|2 drei Glieder
2.1 höhere|2.1 Unfreiheit|2.1 stoffschlüssig|Bild 2.2 Gelenktabelle|2.2 quaternär|2.2 Schwinge|2.3 Kette
2.3 Gelenkfünfeck|2.4 Getriebeumkehrung|2.4 Blindwelle|2.4 Zeichenmaschine|2.5 b(n - 1)|2.5 Zwangslaufkriterium
2.5 übergeschlossen|2.6 doppeltes|2.6 Koppel|2.6 Schleifengelenk|2.6 Gleitwälzgelenk|3 Gelenkviereck|3.1 Grashof
3.1 Totalschwinge|3.1 Antiparallelkurbel|Bild 3.6 Getriebetypen|3.1 Doppellenkerkran|3.2 Totlagen|3.2.1 exzentrische
3.2.2 Zentrische Kurbelschwinge|3.2.2 Zeitverhältnis|3.3 Schubstangenverhältnis|3.4 Ablenkwinkel|3.4 Reibkraft
3.4 Übersetzung|3.5 Koppelkurve|Bild 3.7 Teigknetmaschine|3.5.3 angenähert|Bild 3.8 Entdeckern|3.5.4 Konchoidenlenker
3.5.4 Lambdalenker|3.5.4 a = b = e|3.5.4 Evans|3.6.1 Euler|3.6.1 Normalbeschleunigung|3.6.2 Geschwindigkeits
E1 Übungsbeispiele|001 Getriebebeschreibung|001 Zugriffsmerkmale|001 Gleichschenklige|001 Symmetrieachse
001 Sechspunktig|001 Q_G|001 Roberts|001 Meyer-zur-Capellen|001 Euler-Savary|001 κ
""".strip()
    .replace("\n", "|")
    .split("|")
)


@pytest.fixture
def run(capsys):
    def call(*arguments):
        status = coverage.run(command_named("coverage").parser().parse_args(arguments))
        return status, capsys.readouterr().out

    return call


def test_no_row_is_missing_and_none_is_empty():
    assert len(CONCEPTS) == 60
    for wanted in CONCEPTS:
        where, word = wanted.split(" ", 1) if not wanted.startswith("Bild") else (wanted[:8], wanted[9:])
        assert any(row.where.startswith(where) and word in row.de for row in coverage.coverage_rows()), wanted
    machines = {row.where: row for row in coverage.coverage_rows()}
    assert set(entries()) <= set(machines)
    assert [row.where for row in coverage.coverage_rows() if not row.commands and not row.functions] == []
    for id in entries():
        assert (f"catalog show {id} --full", 0) in machines[id].commands


def test_every_function_is_there():
    names = {name for row in coverage.coverage_rows() for name in row.functions}
    assert [name for name in sorted(names) if coverage.find_function(name) is None] == []
    assert coverage.find_function("gruebler.Chain.parse") is not None
    assert coverage.find_function("gruebler.Chain.no_such_thing") is None
    assert coverage.find_function("no_such_package.x") is None


def test_every_command_is_understood():
    """Parsed without being run, so that a word that no parser knows fails in the fast tests."""
    for row in coverage.coverage_rows():
        for command, wanted in row.commands:
            if wanted != 2:
                name, *arguments = shlex.split(command)
                command_named(name).parser().parse_args(arguments)


def test_every_command_has_something_to_print():
    commands = {command for row in coverage.coverage_rows() for command, _ in row.commands}
    assert commands == set(coverage._table().expected)
    assert [command for command in commands if not coverage.expected_parts(command)] == []
    assert all(part.strip() for command in commands for part in coverage.expected_parts(command))


def test_parts_of_an_output_are_compared_word_by_word():
    said = "rocker  79.84591°  R(0-1)  n = 4\nSchwinge: 79,84591°"
    for part in ("rocker 79.846°", "rocker 79.8459°", "Schwinge: 79,846", "R(0-1) n = 4"):
        assert coverage.missing_parts(said, [part]) == [], part
    for part in (
        "rocker 79.88°",
        "rocker 79°",
        "rocker R(0-1)",
        "n = 4.01",
        "n = 5",
        "Schwinge: 79,88°",
        "R(0-1) n = 4 4",
    ):
        assert coverage.missing_parts(said, [part]) == [part]


@pytest.mark.parametrize(
    ("command", "wanted"), sorted({one for row in coverage.coverage_rows() for one in row.commands}), ids=str
)
def test_every_command_does_it(command, wanted):
    outcome = coverage.execute(command, wanted)
    assert outcome.good, f"{outcome.status}: {outcome.said}; not printed: {outcome.missing}"


def test_the_table(run):
    status, out = run()
    assert status == 0
    assert out.splitlines()[-1].endswith("not covered: 0 rows.")
    status, out = run("wiper", "--json", "--lang", "de")
    assert status == 0
    assert [row["where"] for row in json.loads(out)] == ["wiper"]


def test_everything_that_is_asked_is_done():
    """Every one of the 221 things names commands whose output is compared, or tests that there are."""
    commands = {command for row in coverage.coverage_rows() for command, _ in row.commands}
    root = Path(__file__).parents[2]
    tests = {
        f"{path.relative_to(root).as_posix()}::{node.name}"
        for path in (root / "tests").rglob("test_*.py")
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    }
    asked = coverage.asked_things()
    assert len(asked) == len({each[:3] for each in asked}) == 221
    for each in asked:
        assert each.done_by, each
        assert all(name in (tests if name.startswith("tests/") else commands) for name in each.done_by), each
        for command in each.done_by:
            assert command.startswith("tests/") or coverage.expected_parts(command), f"{command}: nothing is compared"


def test_listing_what_is_asked(run):
    status, out = run("--asked", "Wendekreis", "--lang", "de")
    assert status == 0
    assert "Wendekreis, Euler-Savary" in out
    assert "gruebler construct inflection-circle" in out
    assert len(json.loads(run("--asked", "--json")[1])) == 221
    with pytest.raises(GrueblerError, match="does not go with --run"):
        run("--asked", "--run")


def test_running_a_row(run):
    status, out = run("tri", "--run", "--lang", "de")
    assert status == 0
    assert "endeten wie erwartet" in out
    _, out = run("mindestens drei", "--run", "--json")
    (row,) = json.loads(out)
    assert [(one["wanted"], one["status"]) for one in row["commands"]] == [(0, 0), (2, 2)]
    assert "at least three links" in row["commands"][1]["said"]


def test_what_is_missing_is_said(run, monkeypatch):
    rows = (
        coverage.Row("x", "empty", "leer", (), ()),
        coverage.Row("y", "wrong", "falsch", (("check no-such-machine", 0),), ("gruebler.no_such_thing",)),
    )
    monkeypatch.setattr(coverage, "coverage_rows", lambda: rows)
    status, out = run()
    assert status == 1
    assert "NOT COVERED" in out
    status, out = run("wrong", "--run")
    assert status == 1
    assert "status 2 instead of 0: gruebler check: the catalog has no entry 'no-such-machine'" in out
    assert "gruebler.no_such_thing  (missing)" in out


def test_a_wrong_value_is_said(run, monkeypatch):
    rows = (coverage.Row("x", "four-bar", "Viergelenk", (("grashof 25 70 40 70", 0),), ()),)
    monkeypatch.setattr(coverage, "coverage_rows", lambda: rows)
    assert run("--run")[0] == 0
    monkeypatch.setattr(coverage, "expected_parts", lambda _: ("time ratio: 1.12048", "time ratio: 1.13"))
    status, out = run("--run")
    assert status == 1
    assert "(does not print 'time ratio: 1.13')" in out
    assert "0 of 1 commands ended as expected" in out
    document = json.loads(run("--run", "--json")[1])
    assert document[0]["commands"][0]["missing"] == ["time ratio: 1.13"]


def test_a_strange_machine_is_refused(monkeypatch, tmp_path):
    text = '[[concepts]]\nwhere = "1"\nde = "x"\nen = "x"\n[[machines]]\nid = "unicorn"\n[expected]\n'
    (tmp_path / "coverage.toml").write_text(text, encoding="utf-8")
    monkeypatch.setattr(coverage, "catalog_folder", lambda: tmp_path)
    coverage._table.cache_clear()
    coverage.coverage_rows.cache_clear()
    with pytest.raises(CatalogError, match="no entry 'unicorn'"):
        coverage.coverage_rows()
    coverage._table.cache_clear()
    coverage.coverage_rows.cache_clear()
