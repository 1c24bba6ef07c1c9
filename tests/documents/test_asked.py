"""asked.toml: everything that the teaching documents ask is done by commands that there are, or by tests."""

import ast
import shlex
import tomllib
from pathlib import Path

import pytest

from gruebler.cli import main
from gruebler.cli.commands import command as command_named

HERE = Path(__file__).parent
TESTS = HERE.parent
ASKED = tomllib.loads((HERE / "asked.toml").read_text(encoding="utf-8"))["asked"]
COMMANDS = sorted({each for *_, done_by in ASKED for each in done_by if not each.startswith("tests/")})
REFUSED = {"check 'R(0-1)'"}  # a mechanism has at least three links


def test_everything_that_is_asked_is_there_once():
    assert len(ASKED) == len({tuple(names) for *names, _ in ASKED}) == 221
    assert all(done_by for *_, done_by in ASKED)


def test_every_test_that_is_named_is_there():
    tests = {
        f"{path.relative_to(TESTS.parent).as_posix()}::{node.name}"
        for path in TESTS.rglob("test_*.py")
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    }
    assert {each for *_, done_by in ASKED for each in done_by if each.startswith("tests/")} <= tests


def test_every_command_is_understood():
    """Parsed without being run, so that a word that no parser knows fails in the fast tests."""
    for each in COMMANDS:
        name, *arguments = shlex.split(each)
        command_named(name).parser().parse_args(arguments)


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_succeeds(command, capsys):
    status = main(shlex.split(command))
    printed = capsys.readouterr()
    assert (status, bool(printed.err)) == ((2, True) if command in REFUSED else (0, False)), printed.err
    assert command in REFUSED or printed.out.strip()
