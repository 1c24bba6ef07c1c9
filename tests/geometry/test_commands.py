"""`gruebler cognates` and `gruebler straight`, below the parser."""

import json
from argparse import Namespace

import pytest

from gruebler.cli import cognates, straight
from gruebler.cli.coupler_inputs import coupler_point, sizes
from gruebler.errors import GrueblerError

LENKER = "1,4.330127018922193,4.330127018922193,4"
K = "8.018753738744802,2.268046058132576"
NOTHING = {"branch": 1, "json": False, "lang": "en", "ratio": None, "band": None, "window": None}


def arguments(lengths, point, **given):
    return Namespace(
        **{**NOTHING, "at": None, "centre": 180.0, "direction": None, **given}, lengths=lengths, point=point
    )


def test_cognates_are_told(capsys):
    assert cognates.run(arguments(LENKER, K)) == 0
    told = capsys.readouterr().out
    assert "8.333333  1.924501  8.333333  7.698004" in told
    assert "Third pivot C0 at 7.40741, 2.09513, 7.69800359 from A0." in told
    assert "Cognate 3: crank turns with the given coupler, coupler turns with the given rocker, rocker turns" in told
    assert cognates.run(arguments("slider-crank:25,70,10", "35,40", lang="de")) == 0
    told = capsys.readouterr().out
    assert "53.150729" in told
    assert "im Unendlichen" in told
    assert "Kurbel dreht sich wie die gegebene Koppel" in told


def test_cognates_as_json(capsys):
    assert cognates.run(arguments(LENKER, K, json=True, at=180.0)) == 0
    found = json.loads(capsys.readouterr().out)["cognates"]
    assert [round(one["d"], 6) for one in found] == [4, 7.698004, 4]
    assert found[1]["type"] == "grashof_double_rocker"
    assert found[0]["pins"][1] == pytest.approx([-1, 0])
    points = [one["point"] for one in found]
    assert points[1] == pytest.approx(points[0])
    assert points[2] == pytest.approx(points[0])


def test_straight(capsys):
    assert straight.run(arguments(LENKER, K, ratio=0.005)) == 0
    told = capsys.readouterr().out
    assert "crank angle: 98.337613° to 261.662387° (163.324774°)" in told
    assert "direction of the line: 15.793169°" in told
    assert straight.run(arguments("20,50,50,40", "100,0", window=[90.0, 270.0], direction=0.0, lang="de")) == 0
    assert "Länge längs der Geraden: 80\n" in capsys.readouterr().out
    assert straight.run(arguments("20,50,50,40", "100,0", band=0.2, json=True)) == 0
    assert json.loads(capsys.readouterr().out)["length"] == pytest.approx(88.9, abs=0.2)


def test_a_crank_that_does_not_turn_fully(capsys):
    """The whole range of the crank is searched, and no more."""
    assert straight.run(arguments("60,30,30,70", "5,5", band=1.0, json=True)) == 0
    found = json.loads(capsys.readouterr().out)
    assert -54.6 < found["start_deg"] < found["end_deg"] < 54.6
    assert 0 < found["band"] <= 1
    with pytest.raises(GrueblerError, match="cannot be assembled in any position"):
        straight.run(arguments("1,1,1,9", "5,5", band=1.0))


def test_every_window_is_straighter(capsys):
    assert straight.run(arguments(LENKER, K, ratio=100.0)) == 1
    assert "straighter than Q_G = 100" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("lengths", "message"),
    [
        ("1,2,3", "expected the lengths A,B,C,D, but found 3 numbers"),
        ("1,2,x,4", "expected numbers A,B,C,D, but found '1,2,x,4'"),
        ("slidercrank:1,2", "expected one of four-bar"),
        ("1,2,3,-4", "d must be positive"),
        (":1,2,3,4", "expected one of four-bar"),
    ],
)
def test_wrong_lengths(lengths, message):
    with pytest.raises(GrueblerError, match=message):
        sizes(lengths)


def test_wrong_calls():
    with pytest.raises(GrueblerError, match="coupler point U,V, but found 1"):
        coupler_point("1")
    with pytest.raises(GrueblerError, match="not of its inversion"):
        cognates.run(arguments("inverted-slider-crank:30,50", "90,0"))
    with pytest.raises(GrueblerError, match="ask for one of --ratio"):
        straight.run(arguments(LENKER, K))
    with pytest.raises(GrueblerError, match="does not go with --band"):
        straight.run(arguments(LENKER, K, band=0.1, direction=3.0))


def test_windows_that_are_none():
    for window in ([0.0, 1e9], [90.0, 90.0], [0.0, float("nan")]):
        with pytest.raises(GrueblerError, match="two crank angles at most a full turn apart"):
            straight.run(arguments("20,50,50,40", "100,0", window=window))


def test_cognates_of_a_parallelogram():
    with pytest.raises(GrueblerError, match="the coupler only translates"):
        cognates.run(arguments("2,5,2,5", "2,1"))
