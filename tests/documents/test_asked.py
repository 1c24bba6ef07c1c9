"""asked.toml: everything that the teaching documents ask is compared by facts or tests, and shown by commands."""

import ast
import shlex
import tomllib
from pathlib import Path

import pytest

from gruebler.cli import main
from gruebler.cli.commands import command as command_named
from tests.documents.test_facts import FACTS

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
ASKED = tomllib.loads((HERE / "asked.toml").read_text(encoding="utf-8"))["asked"]
COMMANDS = sorted({command for *_, commands in ASKED for command in commands})
REFUSED = {"check 'R(0-1)'"}  # a mechanism has at least three links
NOT_DONE = {"other sheets referred to"}  # 611, 105 and 612, which 001 names, are no part of these documents


def test_everything_that_is_asked_is_there_once():
    assert len(ASKED) == len({(where, english) for where, english, *_ in ASKED}) == 221


def test_everything_that_is_asked_is_compared():
    names = [fact.name for fact in FACTS]
    unknown = {words for *_, facts, _, _ in ASKED for words in facts if not any(words in name for name in names)}
    assert unknown == set()
    assert {english for _, english, _, facts, tests, _ in ASKED if not facts and not tests} == NOT_DONE


def test_every_test_that_is_named_is_there():
    tests = {
        f"{path.relative_to(ROOT).as_posix()}::{node.name}"
        for path in (ROOT / "tests").rglob("test_*.py")
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    }
    assert {each for *_, named, _ in ASKED for each in named} <= tests


def test_every_command_is_understood():
    """Parsed without being run, so that a word that no parser knows fails in the fast tests."""
    for each in COMMANDS:
        name, *arguments = shlex.split(each)
        assert vars(command_named(name).parser().parse_args(arguments))


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_succeeds(command, capsys):
    status = main(shlex.split(command))
    printed = capsys.readouterr()
    assert (status, bool(printed.err)) == ((2, True) if command in REFUSED else (0, False)), printed.err
    assert command in REFUSED or printed.out.strip()
