"""The parser of a command: former spellings, numbers, and its words in the reader's language."""

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.cli.commands import FORMER, command, command_names
from gruebler.cli.parser import Parser


@pytest.fixture
def parser():
    parser = Parser(prog="gruebler picture")
    parser.add_out(help="a picture")
    parser.add_argument("--at")
    parser.add_argument("--links", type=int)
    parser.add_argument("--size", type=float)
    parser.replaced("--pose", "--at")
    return parser


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (["--pose", "30"], "--pose 30 is now --at 30"),
        (["--pose=-30,20"], "--pose=-30,20 is now --at=-30,20"),
        (["--pose"], "--pose is now --at"),
        (["--pose", "--links", "4"], "--pose is now --at"),
        (["--output", "x.svg"], "--output x.svg is now --out x.svg"),
        (["--links", "four"], "argument --links: expected a whole number, but found 'four'"),
        (["--size", "1,2"], "argument --size: expected a number with a decimal point, but found '1,2'"),
        (["--size", "1,2,3"], "argument --size: expected a number, but found '1,2,3'"),
    ],
)
def test_a_former_spelling_is_answered_by_the_present_one(parser, words, answer, capsys):
    with pytest.raises(SystemExit) as stop:
        parser.parse_args(words)
    assert stop.value.code == 2
    assert f"gruebler picture: {answer} (see gruebler picture --help)" in capsys.readouterr().err


def test_an_option_with_a_new_meaning_answers_only_its_former_values(parser, capsys):
    parser.add_argument("--output", metavar="LINK")
    assert parser.parse_args(["--output", "crank"]).output == "crank"
    with pytest.raises(SystemExit):
        parser.parse_args(["--output", "crank.svg"])
    assert "--output crank.svg is now --out crank.svg" in capsys.readouterr().err


def test_a_value_of_another_kind_is_not_answered_by_the_present_name(capsys):
    with pytest.raises(SystemExit):
        main(["analyse", "four-bar:2,5,4,5", "--drive", "0:360:30"])
    assert "--drive 0:360:30 is now --range 0:360:30" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["analyse", "four-bar:2,5,4,5", "--drive", "coupler"])
    answer = capsys.readouterr().err
    assert "is now" not in answer
    assert "unknown arguments: --drive (see" in answer


def test_after_two_dashes_nothing_is_an_option(parser):
    parser.add_argument("words", nargs="*")
    assert parser.parse_args(["--", "--pose"]).words == ["--pose"]


@pytest.mark.parametrize("name", [name for name in FORMER if name not in command_names()])
def test_a_former_command_is_answered_by_the_present_one(name):
    with pytest.raises(GrueblerError, match=rf"`gruebler {name} 4` is now `gruebler \w+ .*\b4\b"):
        command(name, ["4"])
