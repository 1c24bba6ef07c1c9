"""`gruebler plot`, and what `draw` and `animate` have learned, as a user meets them."""

import pytest

from gruebler.pictures.linkage import animation_frames
from tests.commands import run_command

FOUR_BAR = "four-bar:25,70,40,70"


def run(capsys, *arguments):
    return run_command(capsys, *arguments)


@pytest.mark.parametrize(
    ("arguments", "title"),
    [
        ([FOUR_BAR], "four-bar linkage: transfer functions of rocker"),
        ([FOUR_BAR, "--output", "coupler", "--lang", "de"], "Viergelenkgetriebe: Übertragungsfunktionen von Koppel"),
        ([FOUR_BAR, "--kind", "transmission"], "four-bar linkage: transmission angle of rocker"),
        (["conchoid", "--kind", "curves"], "coupler curves"),
        (
            [FOUR_BAR, "--kind", "hodograph", "--point", "R(crank-coupler)", "--speed", "60"],
            "hodograph of R(crank-coupler)",
        ),
        (
            [FOUR_BAR, "--kind", "family", "--link", "coupler", "--from=-10,5", "--to", "30,5", "--count", "3"],
            "coupler curves",
        ),
        (["mzc", "--kind", "ratio", "--ratio", "0.005"], "relative deviation of K"),
        (["compressor", "--kind", "torque"], "Piston compressor with slider-crank: torque and power of the drive"),
        (["compressor", "--kind", "forces", "--point", "P(frame-piston)", "--lang", "de"], "Gelenkkräfte"),
        (["wiper_rssr", "--lang", "de"], "Übertragungsfunktionen von D("),
        (["diff_bevel", "--output", "R(frame-sun2)"], "transfer functions of R(frame-sun2)"),
        (["susp_spatial", "--output", "R(body-upper_wishbone)"], "transfer functions of R(body-upper_wishbone)"),
    ],
)
def test_every_kind(capsys, arguments, title):
    status, out, _ = run(capsys, "plot", *arguments)
    assert status == 0
    assert title in out.split("</title>")[0]
    assert out.startswith("<svg")


def test_the_diagram_of_the_collection_sheet(capsys):
    _, out, _ = run(capsys, "plot", "mzc", "--kind", "ratio", "--ratio", "0.005")
    assert "At φ_G = 163.3°: Q_G = 0.005, L/l₁ = 3.907." in out


def test_the_speed_is_in_turns_a_minute(capsys):
    _, out, _ = run(capsys, "plot", FOUR_BAR, "--kind", "hodograph", "--point", "R(crank-coupler)", "--speed", "60")
    assert "with a speed of 6.28319 rad/s" in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([FOUR_BAR, "--point", "K"], "--point goes with --kind hodograph, curves, ratio or forces, not with transfer"),
        ([FOUR_BAR, "--kind", "curves"], "no named points; name one of its joints"),
        ([FOUR_BAR, "--kind", "family", "--from=1,2"], "--from and --to go together"),
        ([FOUR_BAR, "--kind", "family", "--from=1", "--to=2,3"], "--from: expected two numbers X,Y"),
        ([FOUR_BAR, "--kind", "family", "--count", "40"], "2 to 8 points"),
        ([FOUR_BAR, "--kind", "hodograph", "--speed", "nan"], "finite number"),
        ([FOUR_BAR, "--kind", "ratio", "--point", "R(frame-crank)"], "no windows with Q_G"),
        (["crane_cyl", "--kind", "ratio"], "a crank with two revolute joints"),
        ([FOUR_BAR, "-o", "x.gif"], "ends with .svg, .png or .pdf"),
        ([FOUR_BAR, "-o", "nowhere/x.svg"], "cannot be written"),
        (["R(0-1) R(1-2) R(2-0)"], "no dimensions"),
        (["wipper"], "wiper"),
        (["wiper"], "blade moves without turning"),
        (["mzc", "--output", "frame"], "the frame does not move"),
        (["mzc", "--kind", "family", "--link", "frame"], "'frame' is the frame"),
        (["mzc", "--kind", "hodograph", "--speed", "0"], "a speed that is not 0"),
        (["mzc", "--kind", "ratio", "--point", "K", "--point", "B"], "shows one point"),
        (["wiper_rssr", "--kind", "curves"], "--kind curves does not go with a linkage in space"),
        (["wiper_rssr", "--branch", "+"], "--branch does not go with a linkage in space"),
        ([FOUR_BAR, "--dark"], "--dark does not go with SVG"),
    ],
)
def test_one_sentence_for_what_cannot_be_plotted(capsys, arguments, words):
    status, _, error = run(capsys, "plot", *arguments)
    assert status == 2
    assert words in error
    assert "\n" not in error.rstrip()


def test_files(capsys, tmp_path):
    pytest.importorskip("matplotlib")
    for suffix, start in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
        path = tmp_path / f"x.{suffix}"
        dark = [] if suffix == "svg" else ["--dark"]
        assert run(capsys, "plot", FOUR_BAR, "-o", str(path), *dark)[0] == 0
        assert path.read_bytes().startswith(start)


def test_draw_has_ghosts_and_dimensions(capsys):
    _, out, _ = run(capsys, "draw", FOUR_BAR, "--ghosts", "5", "--show", "dimensions")
    assert "5 positions thinly. Shown: dimensions." in out
    assert "--ghosts" in run(capsys, "draw", "vcomp", "--graph", "--ghosts", "3")[2]
    assert "1 to 60" in run(capsys, "draw", FOUR_BAR, "--ghosts", "100")[2]
    assert "1 to 60" in run(capsys, "draw", "mzc", "--ghosts", "0")[2]


@pytest.mark.parametrize("suffix", ["svg", "html"])
def test_what_is_on_the_ground_of_its_reader_is_not_dark(capsys, tmp_path, suffix):
    path = tmp_path / f"x.{suffix}"
    assert "--dark does not go with" in run(capsys, "animate", FOUR_BAR, "-o", str(path), "--dark")[2]


def test_german_plots_have_german_links_and_numbers(capsys):
    _, out, _ = run(capsys, "plot", "slidercrank", "--lang", "de")
    assert "Abtrieb slider" not in out
    assert ">0,5<" in run(capsys, "plot", "crankrocker", "--lang", "de")[1]


@pytest.mark.parametrize(
    ("suffix", "start"), [("html", b"<!doctype"), ("gif", b"GIF89a"), ("webp", b"RIFF"), ("png", b"\x89PNG")]
)
def test_animations_by_suffix(capsys, tmp_path, monkeypatch, suffix, start):
    if suffix != "html":
        pytest.importorskip("matplotlib")
    monkeypatch.setattr(animation_frames, "_MOST", 3)
    path = tmp_path / f"x.{suffix}"
    assert run(capsys, "animate", FOUR_BAR, "-o", str(path), "--seconds", "1")[0] == 0
    assert path.read_bytes().startswith(start)
    assert "cannot be written" in run(capsys, "animate", FOUR_BAR, "-o", str(tmp_path / "no" / "x.html"))[2]


def test_on_a_terminal_a_picture_goes_into_a_new_file(capsys, monkeypatch, tmp_path):
    """What is there already is not written over; elsewhere the SVG is printed."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    words = {"draw": [FOUR_BAR], "animate": [FOUR_BAR], "plot": [FOUR_BAR, "--kind", "transmission"]}
    for command in ("draw", "draw", "plot", "animate"):
        status, out, err = run(capsys, command, *words[command])
        assert (status, out) == (0, "")
        assert err.startswith("Written: four-bar-25-70-40-70")
    assert {path.name for path in tmp_path.iterdir()} == {
        "four-bar-25-70-40-70.svg",
        "four-bar-25-70-40-70-2.svg",
        "four-bar-25-70-40-70-transmission.svg",
        "four-bar-25-70-40-70-moving.svg",
    }
