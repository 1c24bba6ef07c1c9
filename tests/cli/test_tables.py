"""Tables and paragraphs at the width of a terminal."""

import io
import re
from argparse import Namespace

import pytest

from gruebler.cli.tables import cut_tables, print_table, print_text


class Terminal(io.StringIO):
    encoding = "utf-8"

    def isatty(self):
        return True


def printed(monkeypatch, width, function, *arguments):
    """What stands on a terminal of that width."""
    terminal = Terminal()
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setattr("sys.stdout", terminal)
    function(*arguments)
    return re.sub(r"\x1b\[[0-9;]*m", "", terminal.getvalue())


HEADERS = ["drive [°]", *(f"force of R(link{k}-link{k + 1}) on link{k} [N]" for k in range(8))]
ROWS = [[str(15 * row), *(str(1000 * row + k) for k in range(8))] for row in range(4)]


@pytest.mark.parametrize("width", [60, 80, 120, 400])
def test_a_wide_table_on_a_terminal(monkeypatch, width):
    """No line is wider than the terminal, and every value stands once, in the row of its drive."""
    out = printed(monkeypatch, width, print_table, HEADERS, ROWS, range(9))
    assert max(map(len, out.splitlines())) <= width
    values = {}
    for line in out.splitlines():
        cells = line.split()
        if len(cells) > 1 and all(cell.isdigit() for cell in cells):
            values.setdefault(cells[0], []).extend(cells[1:])
    assert values == {row[0]: row[1:] for row in ROWS}
    assert all(f"R(link{k}-link{k + 1})" in out for k in range(8))


def test_a_narrow_table_in_a_pipe_is_as_it_was(capsys):
    print_table(HEADERS[:2], [row[:2] for row in ROWS], [0, 1])
    assert capsys.readouterr().out.splitlines()[:2] == [
        "drive [°]  force of R(link0-link1) on link0 [N]",
        "        0                                     0",
    ]


def test_a_wide_table_in_a_pipe_has_headers_of_several_lines(capsys):
    print_table(HEADERS, ROWS, range(9))
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 160
    assert lines[-1].split() == ROWS[-1]


TEXT = "Title\n-----\n  1. " + "word " * 60 + "\n\nR(a-b) R(a-b)"


@pytest.mark.parametrize("width", [40, 90, 300])
def test_paragraphs_are_folded_on_a_terminal(monkeypatch, width):
    out = printed(monkeypatch, width, print_text, TEXT)
    assert max(map(len, out.splitlines())) <= min(width, 100)
    assert out.split() == TEXT.split()
    assert out.startswith("Title\n-----\n  1. word")
    assert "\n    word" in out


def test_paragraphs_in_a_pipe_are_as_they_are(capsys):
    print_text(TEXT)
    assert capsys.readouterr().out == TEXT + "\n"


def test_a_long_table_is_cut_and_says_so(capsys):
    rows = [[str(k)] for k in range(1200)]
    for arguments in ({"all": True}, {"out": "x.txt", "all": False}, {}):
        with cut_tables(Namespace(lang="de", **arguments)):
            print_table(["k"], rows)
        assert len(capsys.readouterr().out.splitlines()) == 1201
    with cut_tables(Namespace(lang="de", all=False)):
        print_table(["k"], rows)
        print_table(["k"], rows[:25])
    lines = capsys.readouterr().out.splitlines()
    assert lines[20] == "19"
    assert lines[21] == "... und 1.180 weitere Zeilen: --all gibt sie aus."
    assert lines[22:] == ["k", *map(str, range(25))]
