"""The parser of a command: numbers, and its words in the reader's language."""

import ast
from collections import Counter
from pathlib import Path

import pytest

import gruebler.cli
from gruebler.cli import arguments, main
from gruebler.cli.arguments import rows_of
from gruebler.cli.parser import Parser


@pytest.fixture
def parser():
    parser = Parser(prog="gruebler picture")
    parser.add_out(help="a picture")
    parser.add_argument("--at")
    parser.add_argument("--links", type=int)
    parser.add_argument("--size", type=float)
    return parser


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (["--links", "four"], "argument --links: expected a whole number, but found 'four'"),
        (["--size", "1,2"], "argument --size: expected a number with a decimal point, but found '1,2'"),
        (["--size", "1,2,3"], "argument --size: expected a number, but found '1,2,3'"),
    ],
)
def test_a_value_that_is_no_number_is_called_so(parser, words, answer, capsys):
    with pytest.raises(SystemExit) as stop:
        parser.parse_args(words)
    assert stop.value.code == 2
    assert f"gruebler picture: {answer} (see gruebler picture --help)" in capsys.readouterr().err


def test_after_two_dashes_nothing_is_an_option(parser):
    parser.add_argument("words", nargs="*")
    assert parser.parse_args(["--", "--pose"]).words == ["--pose"]


@pytest.mark.parametrize(
    ("american", "british"),
    [
        (["analyze", "wiper", "--at", "30"], ["analyse", "wiper", "--at", "30"]),
        (["synthesize", "dead-centers", "--swing", "60"], ["synthesise", "dead-centres", "--swing", "60"]),
        (
            ["curve", "lambda", "C", "--straight", "--ratio", "0.01", "--center", "170"],
            ["curve", "lambda", "C", "--straight", "--ratio", "0.01", "--centre=170"],
        ),
    ],
)
def test_american_spellings_are_taken(capsys, american, british):
    status = main(british)
    wanted = capsys.readouterr()
    assert main(american) == status
    assert capsys.readouterr() == wanted


def _written(path):
    """The rows that a file of a command writes down, each once."""
    calls = [node for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call)]
    takes = [c for c in calls if getattr(c.func, "attr", getattr(c.func, "id", "")) == "take"]
    tables = [a.value for call in takes for a in call.args if isinstance(a, ast.Constant)]
    return {(row.names, repr(row.settings), row.help) for table in tables for row in rows_of(table)}


def test_a_row_that_two_commands_have_is_written_once():
    files = [path for path in Path(gruebler.cli.__file__).parent.glob("*.py") if path.name != "arguments.py"]
    rows = Counter(row for path in files for row in _written(path))
    taken = Counter(row[0][0] for row in rows.elements() if not row[2])
    assert {row: count for row, count in rows.items() if row[2] and count > 1} == {}
    assert taken.keys() == arguments._SHARED.keys()
    assert [name for name, count in taken.items() if count < 2] == []


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (["draw", "vcomp", "--label"], "--labels"),
        (["draw", "vcomp", "--sho=scale"], "--show"),
        (["exercise", "sheet", "--kin", "mobility"], "--kind"),
        (["catalog", "list", "--al"], "--all"),
    ],
)
def test_the_beginning_of_an_option_is_not_taken_for_it(words, option, capsys):
    with pytest.raises(SystemExit) as stop:
        main(words)
    assert stop.value.code == 2
    assert f"(did you mean '{option}'?)" in capsys.readouterr().err
