"""`gruebler curve --cognates` and `--straight`."""

import json
import math

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.cli.coupler_inputs import coupler_point
from gruebler.cli.linkage_inputs import linkage_of_word
from gruebler.files.linkages import write_linkage
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.geometry.straight import coupler_path, path_piece
from tests.commands import run_command

LENKER = "1,4.330127018922193,4.330127018922193,4"
K = "8.018753738744802,2.268046058132576"


def run(capsys, lengths, point, *options):
    """The exit status of `gruebler curve`, and what it printed or refused."""
    status, out, err = run_command(capsys, "curve", lengths, point, *options)
    return status, out or err


def test_cognates(capsys):
    status, out = run(capsys, LENKER, K, "--cognates")
    assert status == 0
    assert "8.333  1.925  8.333  7.698" in out
    assert "Third pivot C0 at 7.407, 2.095, distance 7.698 from A0." in out
    assert "Cognate 3: crank turns with the given coupler, coupler turns with the given rocker, rocker turns" in out
    status, out = run(capsys, "slider-crank:25,70,10", "35,40", "--cognates", "--lang", "de")
    assert status == 0
    assert "53,15" in out
    assert "im Unendlichen" in out
    assert "Kurbel dreht sich wie die gegebene Koppel" in out


def test_cognates_as_json(capsys):
    found = json.loads(run(capsys, LENKER, K, "--cognates", "--json", "--at", "180")[1])["cognates"]
    assert [round(cognate["d"], 6) for cognate in found] == [4, 7.698004, 4]
    assert found[1]["type"] == "grashof_double_rocker"
    assert found[0]["pins"][1] == pytest.approx([-1, 0])
    points = [cognate["point"] for cognate in found]
    assert points[1] == pytest.approx(points[0])
    assert points[2] == pytest.approx(points[0])


@pytest.mark.parametrize("label", ["+", "-"])
def test_cognates_of_a_file_are_those_of_its_lengths(capsys, tmp_path, label):
    path = tmp_path / "four_bar.toml"
    write_linkage(path, FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}))
    at = ("--cognates", "--at", "50", f"--branch={label}", "--json")
    by_lengths, by_file = (
        json.loads(run(capsys, *words, *at)[1])["cognates"] for words in (("25,70,40,70", "45,40"), (str(path), "K"))
    )
    for one, other in zip(by_lengths, by_file, strict=True):
        assert one["type"] == other["type"]
        assert one["branch"] == other["branch"]
        for key in ("a", "b", "c", "d", "u", "v", "point"):
            assert one[key] == pytest.approx(other[key]), key


def test_cognates_of_an_entry_trace_its_curve(capsys):
    found = json.loads(run(capsys, "lambda", "C", "--cognates", "--json")[1])["cognates"]
    assert [round(found[0][name] / found[0]["a"], 9) for name in "abcd"] == [1, 2.5, 2.5, 2]
    assert found[1]["point"] == pytest.approx(found[0]["point"])
    assert found[2]["point"] == pytest.approx(found[0]["point"])
    assert run(capsys, "watt_axle", "F", "--cognates")[0] == 0
    for entry in ("wiper", "slidercrank"):
        assert (
            "expected a four-bar or an inverted slider-crank" in run(capsys, entry, "R(frame-crank)", "--cognates")[1]
        )


def test_straight(capsys):
    status, out = run(capsys, LENKER, K, "--straight", "--ratio", "0.005")
    assert status == 0
    assert "crank angle: 98.34° to 261.7° (163.3°)" in out
    assert "direction of the line: 15.79°" in out
    window = ("--straight", "--window", "90", "270", "--direction", "0")
    assert "Länge längs der Geraden: 80\n" in run(capsys, "20,50,50,40", "100,0", *window, "--lang", "de")[1]
    status, out = run(capsys, "20,50,50,40", "100,0", "--straight", "--band", "0.2", "--json")
    assert status == 0
    assert json.loads(out)["length"] == pytest.approx(88.9, abs=0.2)


@pytest.mark.parametrize("question", [["--ratio", "0.005"], ["--band", "0.2"], ["--window", "90", "270"]])
def test_a_file_of_the_same_linkage_gives_the_same_piece(capsys, tmp_path, question):
    """Lengths move in closed form, a file by the solver."""
    path = tmp_path / "lambda.toml"
    write_linkage(path, FourBar(20, 50, 50, 40).linkage({"C": (100, 0)}))
    by_lengths, by_file = (
        json.loads(run(capsys, *words, "--straight", *question, "--json")[1])
        for words in (("20,50,50,40", "100,0"), (str(path), "C"))
    )
    assert by_file == pytest.approx(by_lengths, abs=1e-6)


def test_a_crank_that_does_not_turn_fully(capsys):
    """The whole range of the crank is searched, and no more."""
    found = json.loads(run(capsys, "60,30,30,70", "5,5", "--straight", "--band", "1", "--json")[1])
    assert -54.6 < found["start_deg"] < found["end_deg"] < 54.6
    assert 0 < found["band"] <= 1
    assert "cannot be assembled in any position" in run(capsys, "1,1,1,9", "5,5", "--straight", "--band", "1")[1]


def test_every_window_is_straighter(capsys):
    status, out = run(capsys, LENKER, K, "--straight", "--ratio", "100")
    assert status == 1
    assert "straighter than Q_G = 100" in out


@pytest.mark.parametrize(
    ("lengths", "message"),
    [
        ("four-bar:1,2,3", "expected a,b,c,d, but found 3 numbers"),
        ("four-bar:1,2,x,4", "expected numbers a,b,c,d, but found '1,2,x,4'"),
        ("slidercrank:1,2", "did you mean 'slider-crank'"),
        ("1,2,3,-4", "d must be positive"),
    ],
)
def test_wrong_lengths(lengths, message):
    with pytest.raises(GrueblerError, match=message):
        linkage_of_word(lengths)


@pytest.mark.parametrize(
    ("lengths", "point", "options", "message"),
    [
        (LENKER, "1", ["--cognates"], "there is no point '1'"),
        (LENKER, "crank:1,2", ["--cognates"], "expected a point of the coupler"),
        ("inverted-slider-crank:30,50", "90,0", ["--cognates"], "not for its inversion"),
        (LENKER, K, ["--straight"], "give one of --ratio Q"),
        (LENKER, K, ["--straight", "--band", "0.1", "--direction", "3"], "does not go with --band"),
        (LENKER, K, ["--cognates", "--branch", "++"], "branch: expected + or -"),
        ("2,5,2,5", "2,1", ["--cognates"], "the coupler only translates"),
        *(
            ("20,50,50,40", "100,0", ["--straight", "--window", *window], "two crank angles at most a full turn apart")
            for window in (("0", "1e9"), ("90", "90"), ("0", "nan"))
        ),
    ],
)
def test_refusals(capsys, lengths, point, options, message):
    status, said = run(capsys, lengths, point, *options)
    assert status == 2
    assert message in said


@pytest.mark.parametrize("label", ["+", "-"])
def test_both_branches_have_a_path(capsys, label):
    size = FourBar(25, 70, 40, 70)
    window = ("--straight", "--window", "30", "60", f"--branch={label}", "--json")
    found = json.loads(run(capsys, "25,70,40,70", "45,40", *window)[1])
    piece = path_piece(coupler_path(size, *coupler_point(size, "45,40"), branch=label), math.pi / 6, math.pi / 3)
    assert found["length"] == pytest.approx(piece.length)
