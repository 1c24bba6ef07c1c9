"""What the commands write: valid on every output, said when it goes into a file, safe in a spreadsheet."""

import csv
import io
import json
import os
import subprocess
import sys
from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler.base.columns import Column, as_csv
from gruebler.cli import main

CHAIN = "R(Kürbel-b) R(b-c) R(c-d) R(d-Kürbel)"
FOUR_BAR = "four-bar:25,70,40,70"


def run(encoding, *arguments):
    """What a process of its own writes to its output."""
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    command = [sys.executable, "-m", "gruebler", *arguments]
    return subprocess.run(command, capture_output=True, check=True, env=environment).stdout


@pytest.fixture
def run_here(monkeypatch):
    """The same in this process, which need not load everything anew."""

    def run(encoding, *arguments):
        written = io.BytesIO()
        monkeypatch.setattr("sys.stdout", io.TextIOWrapper(written, encoding=encoding, write_through=True))
        assert main(arguments) == 0
        sys.stdout.flush()
        return written.getvalue()

    return run


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252", "utf-8"])
def test_json_is_valid_on_every_output(encoding):
    found = json.loads(run(encoding, "check", CHAIN, "R(a-😀) R(😀-c) R(c-d) R(d-a)", "--json").decode("utf-8"))
    assert [one["name"] for one in found] == [CHAIN, "R(a-😀) R(😀-c) R(c-d) R(d-a)"]


@pytest.mark.parametrize(
    "arguments",
    [
        ("draw", CHAIN, "--labels", "--lang", "de"),
        ("plot", FOUR_BAR, "--kind", "transmission", "--lang", "de"),
        ("animate", FOUR_BAR, "--lang", "de"),
        ("sheet", "draw", "mzc", "--lang", "de"),
    ],
    ids=lambda arguments: arguments[0],
)
def test_pictures_are_valid_on_every_output(arguments, run_here):
    """The same picture, letter for letter, as XML reads it."""
    expected = ElementTree.fromstring(run("utf-8", *arguments))
    for encoding in ("ascii", "latin-1"):
        found = ElementTree.fromstring(run_here(encoding, *arguments))
        assert "".join(found.itertext()) == "".join(expected.itertext())
        assert [one.attrib for one in found.iter()] == [one.attrib for one in expected.iter()]
    assert any(not letter.isascii() for letter in "".join(expected.itertext()))


@pytest.mark.parametrize("start", ["=cmd|1", "+1", "-1", "@sum", "\tx", "\rx", "\nx"])
def test_names_are_no_formulas_in_a_spreadsheet(start):
    values = np.array([-1.5, 2.0])
    head, *rows = csv.reader(
        as_csv([Column(f"{start} x", unit="mm", values=values), Column("C y", unit="mm", values=values)]).splitlines(
            True
        )
    )
    assert head == [f"'{start} x [mm]", "C y [mm]"]
    assert rows == [["-1.5", "-1.5"], ["2.0", "2.0"]]


WRITING = {
    "draw": (["draw", "vcomp"], ".svg"),
    "animate": (["animate", FOUR_BAR], ".svg"),
    "plot": (["plot", FOUR_BAR, "--kind", "transmission"], ".svg"),
    "sheet": (["sheet", "draw", "mzc"], ".svg"),
    "gallery": (["gallery", "--links", "4"], ".html"),
    "analyse": (["analyse", FOUR_BAR, "--range", "0:90:30"], ".csv"),
    "enumerate": (["enumerate", "--links", "6", "--count"], ".json"),
    "realise": (["realise", "R(0-1) R(1-2) R(2-3) R(3-0)"], ".toml"),
    "gears": (["gears", "a:20 b:40; a=1"], ".svg"),
}


@pytest.mark.parametrize(("name", "lang"), [*((name, "en") for name in WRITING), ("draw", "de")])
def test_every_command_says_what_it_wrote(tmp_path, capsys, name, lang):
    arguments, ending = WRITING[name]
    path = tmp_path / f"out{ending}"
    assert main([*arguments, "-o", str(path), "--lang", lang]) == 0
    out, err = capsys.readouterr()
    assert err == f"{'Written' if lang == 'en' else 'Geschrieben'}: {path}\n"
    assert str(path) not in out
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("command", ["check", "draw", "inversions", "assur", "analyse", "gears"])
def test_files_of_an_unknown_kind_are_refused_by_name(tmp_path, capsys, command):
    path = tmp_path / "chains.parquet"
    path.write_bytes(b"PAR1" + bytes(range(256)))
    assert main([command, str(path)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert "chains.parquet" in err


def test_wrong_usage_is_quoted_in_short(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["enumerate", "--links", "1" + "x" * 100_000])
    assert stop.value.code == 2
    assert len(capsys.readouterr().err) < 1000


def test_too_little_memory_is_one_sentence(monkeypatch, capsys):
    def exhausted(_):
        raise MemoryError

    monkeypatch.setattr("gruebler.cli.table.run", exhausted)
    assert main(["table", "grashof"]) == 2
    assert capsys.readouterr().err == "gruebler table: not enough memory\n"


def test_json_of_what_cannot_be_assembled(capsys):
    assert main(["analyse", "four-bar:25,70,40,150", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["complete"], found["rows"]) == (False, [])
    assert "cannot be assembled" in found["message"]


WRITING_TOO = WRITING | {
    "synthesise": (["synthesise", "dead-centres", "--swing", "60", "--time-ratio", "1.2"], ".toml"),
    "synthesise --json": (["synthesise", "dead-centres", "--swing", "60", "--time-ratio", "1.2", "--json"], ".json"),
    "curve": (["curve", FOUR_BAR, "coupler:45,40"], ".csv"),
    "statics": (["statics", FOUR_BAR, "--load", "R(crank-coupler)=0,-10", "--json"], ".csv"),
    "cam": (["cam", "rise 20 90; fall 20 90; dwell", "--base", "40", "--roller", "10"], ".svg"),
    "geneva": (["geneva", "4", "--distance", "100"], ".svg"),
}


@pytest.mark.parametrize("name", WRITING_TOO)
def test_a_file_is_written_though_nobody_reads_the_output(tmp_path, monkeypatch, name):
    """As after ``| head -1``: the output refuses everything."""

    class Closed(io.StringIO):
        def write(self, _):
            raise BrokenPipeError

        def fileno(self):
            return other.fileno()

    arguments, ending = WRITING_TOO[name]
    path = tmp_path / f"out{ending}"
    with (tmp_path / "other").open("w") as other:
        monkeypatch.setattr(sys, "stdout", Closed())
        assert main([*arguments, "-o", str(path)]) == 0
    assert path.stat().st_size > 0


PRINTING = [
    ["check", "vcomp"],
    ["inversions", "vcomp"],
    ["assur", "wiper"],
    ["extend", "quad", "--dyad"],
    ["extend", "quad", "--derivation"],
    ["enumerate", "--links", "8", "--assortments"],
    ["catalog", "show", "vcomp"],
    ["catalog", "search", "--links", "4", "--drives", "1"],
    ["exercise", "show", "15"],
    ["analyse", FOUR_BAR, "--at", "30"],
]


@pytest.mark.parametrize("arguments", PRINTING, ids=lambda arguments: " ".join(arguments[:2]))
def test_what_is_printed_goes_into_files_too(tmp_path, capsys, arguments):
    printed = {}
    for ending, options in ((".txt", []), (".json", ["--json"])):
        whole = ["--all"] if arguments[:2] == ["catalog", "search"] else []
        assert main([*arguments, *options, *whole]) == 0
        printed[ending] = capsys.readouterr().out
        path = tmp_path / f"out{ending}"
        assert main([*arguments, "-o", str(path)]) == 0
        assert capsys.readouterr() == ("", f"Written: {path}\n")
        assert path.read_text(encoding="utf-8") == printed[ending]
    assert printed[".txt"] != printed[".json"]
    json.loads(printed[".json"])


def test_a_file_that_does_not_fit_is_refused_and_none_is_left(tmp_path, capsys):
    for arguments, words in (
        (["check", "vcomp", "-o", str(tmp_path / "x.csv")], "expected a name that ends with .txt or .json"),
        (["check", "vcomp", "--json", "-o", str(tmp_path / "x.txt")], "expected a name that ends with .json"),
        (["check", "no-such-machine", "-o", str(tmp_path / "x.txt")], "no entry 'no-such-machine'"),
    ):
        assert main(arguments) == 2
        assert words in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
