"""`gruebler inversions` and `gruebler variants` as a user meets them."""

import json

import pytest

from gruebler.cli import main


def run(capsys, *arguments):
    try:
        status = main(arguments)
    except SystemExit as stop:
        status = stop.code
    out, err = capsys.readouterr()
    return status, out, err


def test_inversions_of_the_slider_crank_chain_by_name(capsys):
    status, out, _ = run(capsys, "inversions", "slidercrank", "--json")
    document = json.loads(out)
    assert status == 0
    assert document["count"] == 2
    assert {item["family"] for item in document["items"]} == {
        "slider-crank (sliding lever with the block as frame)",
        "inverted slider-crank (turning or swinging block)",
    }
    _, out, _ = run(capsys, "inversions", "slidercrank", "--lang", "de", "--drives")
    assert "Kurbelschleife" in out


def test_counts(capsys):
    watt = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"
    assert run(capsys, "inversions", watt, "--count")[1] == "2\n"
    assert run(capsys, "inversions", watt, "--drives", "--count")[1] == "4\n"
    found = run(capsys, "inversions", "g6:Cr", "--drives", "--output", "--count", "--json")[1]
    assert json.loads(found) == {"count": 2}
    assert run(capsys, "variants", "--links", "6", "--prismatic", "1", "--count")[1] == "6\n"
    document = json.loads(run(capsys, "variants", "--links", "4", "--drive", "R@frame", "--json")[1])
    assert document["count"] == 1
    assert ";frame=0;drives=" in document["items"][0]["code"]
    assert "1 gefunden." in run(capsys, "variants", "--links", "4", "--lang", "de")[1]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["inversions", "nothing"], "no entry 'nothing'"),
        (["inversions", "vcomp", "--output"], "--output goes with --drives"),
        (["inversions", "vcomp", "--drives", "--number", "0"], "at least one drive"),
        (["variants"], "--links"),
        (["variants", "--links", "6", "--drive", "R@wall"], "frame, moving or any"),
        (["variants", "--links", "6", "--assortment", "four"], "--assortment 'four'"),
        (["variants", "--links", "6", "--at-frame", "P:x"], "--at-frame 'P:x'"),
    ],
)
def test_mistakes_are_one_sentence(capsys, arguments, words):
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert words in err
    assert len(err.strip().splitlines()) == 1
