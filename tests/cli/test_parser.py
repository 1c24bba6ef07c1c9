"""The parser of a command: numbers, and its words in the reader's language."""

import pytest

from gruebler.cli import main
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
