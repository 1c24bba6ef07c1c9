"""What a file says does not steer the terminal: its control characters are shown as escapes."""

import re
from pathlib import Path

import pytest

from gruebler.cli import main

STEERING = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")

FILES = {
    "a quoted name": ("chain.txt", 'R(0-"\033]0;title\007a") R(a-2)\n'),
    "a name": ("name.txt", "R(0-a\x1b[31m) R(a\x1b[31m-2) R(2-0)\n"),
    "a token of GML": ("graph.gml", "graph [\n node [ id 0 \033[31mx ]\n]"),
    "a key of TOML": ("linkage.toml", '"\\u001b[31m" = 3\n'),
    "a text of JSON": ("linkage.json", '{"unit": "\\u001b]0;x\\u0007mm", "joints": "R(0-1)"}'),
    "a catalog entry": (
        "entry.toml",
        'id = "x"\nname = "\\u001b[31mred"\nsource = "s"\njoints = "R(0-1) R(1-2) R(2-3) R(3-0)"\n',
    ),
    "the header of a task": ("task.csv", "x,y\033[31m\n1,2\n"),
    "a point of another program": ("a.pyslvs", "M[J[R, color[\033[31m], P[0.0, 0.0], L[ground, L1]]]"),
    "the direction of writing": ("chain.txt", "R(0-\u202ea) R(a-2)\n"),
}


@pytest.mark.parametrize("kind", FILES)
@pytest.mark.parametrize("command", ["check", "analyse", "synthesise path", "inversions"])
def test_control_characters_of_files_are_not_printed(kind, command, tmp_path, capsys):
    name, text = FILES[kind]
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    main([*command.split(), str(path)])
    printed = capsys.readouterr()
    assert printed.err + printed.out
    assert not STEERING.search(printed.out + printed.err)


@pytest.mark.parametrize("name", ["\033[31mred.toml", "\u202elmot.txt", "bell\007.csv"])
@pytest.mark.parametrize("command", ["check", "analyse", "convert", "draw four-bar:25,70,40,70 -o"])
def test_control_characters_of_file_names_are_not_printed(name, command, tmp_path, capsys):
    more = [str(tmp_path / "out.toml")] if command == "convert" else []
    status = main([*command.split(), str(tmp_path / name), *more])
    assert status == 2
    assert not STEERING.search(capsys.readouterr().err)


def test_written_files_are_named_without_their_control_characters(tmp_path, capsys):
    path = tmp_path / "\033[31mred.svg"
    assert main(["draw", "four-bar:25,70,40,70", "-o", str(path)]) == 0
    assert path.exists()
    assert r"\x1b[31mred.svg" in capsys.readouterr().err


def test_a_refused_file_is_one_line(tmp_path, capsys):
    """What of it was left out is not said before it is refused."""
    source = str(Path(__file__).parents[1] / "files" / "samples" / "six-bar-version-1.pmks")
    assert main(["statics", source, "--load", "nowhere=1,0"]) == 2
    refused = capsys.readouterr().err
    assert refused.count("\n") == 1, refused
    assert main(["inversions", source, "--count"]) == 0
    assert "Left out: " in capsys.readouterr().err
