"""`gruebler grashof` as a user meets it."""

import argparse
import json

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.cli import grashof


def run(capsys, *lengths, free=None, turns=None, json=False, lang="en"):
    status = grashof.run(argparse.Namespace(lengths=list(lengths), free=free, turns=turns, json=json, lang=lang))
    return status, capsys.readouterr().out


def test_one_four_bar(capsys):
    status, out = run(capsys, "2", "7", "4.5", "5.5")
    assert status == 0
    assert out.splitlines() == [
        "l_min + l_max = 2 + 7 = 9 < 10 = 5.5 + 4.5: crank-rocker. Turns fully against the frame: a (crank).",
        "crank angle: full turn",
        "swing of the output: 69.04°",
        "time ratio: 1.357",
        "smallest transmission angle: 25.21°",
    ]
    status, out = run(capsys, "40", "100", "70", "90", turns="b", lang="de")
    assert status == 1
    assert "Kurbelschwinge" in out
    assert out.endswith("b umlauffähig: nein\n")


def test_four_bars_that_stop_or_do_not_close(capsys):
    status, out = run(capsys, "4", "5", "6", "4.5", lang="de")
    assert status == 0
    assert "Totalschwinge" in out
    assert "Kurbelwinkel: 11,72°..348,3°" in out
    assert run(capsys, "1", "1", "1", "5") == (1, "l_max = 5 > 3 = 1 + 1 + 1: not assemblable.\n")


def test_exercise_9_as_a_table_and_as_json(capsys):
    status, out = run(capsys, "40", "100", "70", "90", free="d", turns="a", lang="de")
    assert status == 0
    assert [line.split()[:6] for line in out.splitlines()[2:]] == [
        ["0", "<", "d", "<=", "10", "Doppelkurbel"],
        ["70", "<=", "d", "<=", "130", "Kurbelschwinge"],
    ]
    three = run(capsys, "40", "100", "70", free="d", turns="a", lang="de")
    assert three == (status, out)
    document = json.loads(run(capsys, "40", "100", "70", free="d", json=True)[1])
    assert [item["type"] for item in document["items"]] == [
        "double_crank",
        "triple_rocker",
        "crank_rocker",
        "triple_rocker",
        "not_assemblable",
    ]
    assert document["items"][-1]["upper"] is None


def test_no_value_at_all(capsys):
    assert run(capsys, "1", "2", "9", free="c", turns="b", lang="de") == (
        1,
        "Für keinen Wert von c ist b umlauffähig.\n",
    )


def test_json_of_one(capsys):
    document = json.loads(run(capsys, "2", "5", "4", "5", json=True)[1])
    assert document["type"] == "crank_rocker"
    assert document["turning"] == ["a"]
    assert document["limits_deg"] == [[0, 360]]
    assert document["smallest_transmission_angle_deg"] == pytest.approx(36.86989764584401)


@pytest.mark.parametrize(
    ("lengths", "free", "message"),
    [
        (["1", "2", "3"], None, "four lengths A B C D are needed"),
        (["1", "2", "x", "4"], None, "expected a length, but found 'x'"),
        (["1", "2", "-3", "4"], None, "c must be positive, not -3"),
        (["1", "nan", "3", "4"], None, "b must be a finite number"),
        (["1", "2"], "d", "--free d takes the lengths a, b, c"),
        (["1", "inf", "3"], "d", "b must be a finite number"),
    ],
)
def test_wrong_usage_is_one_sentence(capsys, lengths, free, message):
    with pytest.raises(GrueblerError, match=message):
        run(capsys, *lengths, free=free)


def test_other_linkages_are_written_as_everywhere(capsys):
    assert run(capsys, "25,70,40,70") == run(capsys, "four-bar:25,70,40,70") == run(capsys, "25", "70", "40", "70")
    assert run(capsys, "25,70,40,70", free="d") == run(capsys, "25", "70", "40", free="d")
    status, out = run(capsys, "slider-crank:25,70,10", turns="a")
    assert status == 0
    assert out.splitlines() == [
        "a = 25, b = 70, e = 10: slider-crank. Turns fully against the frame: a.",
        "crank angle: full turn",
        "stroke of the output: 50.6",  # sqrt(95^2 - 10^2) - sqrt(45^2 - 10^2)
        "time ratio: 1.078",
        "smallest transmission angle: 60°",
        "a turns fully: yes",
    ]
    assert run(capsys, "slider-crank:50,70,30", turns="a") == (
        1,
        "a = 50, b = 70, e = 30: slider-rocker (no link turns fully).\ncrank angle: -53.13°..233.1°\n"
        "smallest transmission angle: 0°\na turns fully: no\n",
    )
    document = json.loads(run(capsys, "inverted-slider-crank:70,25,3", json=True)[1])
    assert (document["type"], document["turning"]) == ("turning_guide", ["a", "guide"])
    with pytest.raises(GrueblerError, match="--free goes with the lengths of a four-bar"):
        run(capsys, "slider-crank:25,70", free="b")
