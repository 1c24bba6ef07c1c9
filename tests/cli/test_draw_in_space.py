"""`gruebler draw` and `animate` of linkages in space: from files and from the catalog."""

import pytest

from gruebler.files.screws import write_screws
from gruebler.mechanics.space import Bennett
from tests.commands import run_command


@pytest.fixture
def bennett(tmp_path):
    path = tmp_path / "bennett.toml"
    write_screws(path, Bennett(3.0, 0.6, 1.0).linkage())
    return str(path)


def test_a_file_is_drawn_in_both_views(capsys, bennett):
    status, isometric, _ = run_command(capsys, "draw", bennett)
    assert status == 0
    assert "Isometric view, z upwards." in isometric
    status, oblique, _ = run_command(capsys, "draw", bennett, "--view", "oblique", "--at", "40", "--labels")
    assert status == 0
    assert "Oblique view" in oblique
    assert "gr-hatch" in oblique


def test_entries_in_space_are_drawn_in_space(capsys):
    status, text, _ = run_command(capsys, "draw", "diff_bevel", "--labels", "--lang", "de")
    assert status == 0
    assert "Schrägansicht" in text  # bevel wheels, their axes in the plane of the paper
    assert "Isometrische Ansicht" in run_command(capsys, "draw", "diff_bevel", "--view", "isometric", "--lang", "de")[1]
    assert "Kegelraddifferential" in text
    _, structure, _ = run_command(capsys, "draw", "diff_bevel", "--structure")
    assert "Oblique" not in structure
    _, geneva, _ = run_command(capsys, "draw", "geneva")
    assert "Isometric" not in geneva


def test_a_file_moves(capsys, bennett, tmp_path):
    page = tmp_path / "bennett.html"
    status, _, _ = run_command(capsys, "animate", bennett, "-o", str(page), "--seconds", "0.4")
    assert status == 0
    assert page.read_text(encoding="utf-8").count("<animate ") == 6
    status, text, _ = run_command(capsys, "animate", bennett, "--range", "0:90:45", "--seconds", "0.4")
    assert status == 0
    assert text.count("<animate ") == 6


def test_several_drives_need_their_ranges_which_is_said(capsys):
    status, _, said = run_command(capsys, "animate", "diff_bevel2p")
    assert status == 2
    assert "the linkage has 2 drives: give --range FROM:TO:STEP once for each" in said
    status, text, _ = run_command(
        capsys, "animate", "diff_bevel2p", "--range", "0:90:45", "--range", "0:30:15", "--seconds", "0.2"
    )
    assert status == 0
    assert text.startswith("<svg")


@pytest.mark.parametrize(
    ("command", "words", "said"),
    [
        ("draw", ["--show", "poles"], "--show does not go with a linkage in space"),
        ("draw", ["--names", "A0,A"], "--names does not go with a linkage in space"),
        ("draw", ["--ghosts", "3"], "--ghosts does not go with a linkage in space"),
        ("draw", ["--at", "nan"], "--at: expected one finite number below 1e9"),
        ("draw", ["--curve", "K"], "there is no point 'K'; known are R(0-1)"),
        ("animate", ["--branch", "+"], "--branch does not go with a linkage in space"),
        ("animate", ["--seconds", "0"], "the time is a number of seconds up to 3600, not 0.0"),
    ],
)
def test_what_does_not_go_is_said(capsys, bennett, command, words, said):
    status, _, refused = run_command(capsys, command, bennett, *words)
    assert status == 2
    assert said in refused


def test_the_first_of_several_drives_moves(capsys):
    status, text, _ = run_command(capsys, "animate", "delta", "--seconds", "0.2")
    assert status == 0
    assert text.count("<animate ") > 1


def test_views_are_for_space(capsys):
    for command in ("draw", "animate"):
        status, _, refused = run_command(capsys, command, "wiper", "--view", "oblique")
        assert status == 2
        assert "--view needs a linkage in space" in refused
