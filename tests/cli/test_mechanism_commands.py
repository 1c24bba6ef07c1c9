"""`gruebler inversions` and `gruebler variants` as a user meets them."""

import io
import json

import pytest

from gruebler.files.linkages import read_linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.inversion import DrivenMechanism
from tests.commands import run_main as run


def test_inversions_of_the_slider_crank_chain_by_name(capsys):
    status, out, _ = run(capsys, "inversions", "slidercrank", "--json")
    document = json.loads(out)
    assert status == 0
    assert document["count"] == 2
    assert {item["family"] for item in document["items"]} == {
        "slider-crank",
        "inverted slider-crank (turning or swinging block)",
    }
    _, out, _ = run(capsys, "inversions", "slidercrank", "--lang", "de", "--drives")
    assert "Kurbelschleife" in out


def test_counts(capsys):
    watt = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"
    assert run(capsys, "inversions", watt, "--count")[1] == "2\n"
    assert run(capsys, "inversions", watt, "--drives", "--count")[1] == "4\n"
    found = run(capsys, "inversions", "g6:Cr", "--drives", "--with-output", "--count", "--json")[1]
    assert json.loads(found) == {"count": 2}
    assert run(capsys, "variants", "--links", "6", "--prismatic", "1", "--count")[1] == "6\n"
    document = json.loads(run(capsys, "variants", "--links", "4", "--drive-joint", "R@frame", "--json")[1])
    assert document["count"] == 1
    assert ";frame=0;drives=" in document["items"][0]["code"]
    assert run(capsys, "variants", "--links", "4", "--lang", "de") == (
        0,
        "R(0-1) R(1-2) R(2-3) R(3-0)\n",
        "1 gefunden.\n",
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["inversions", "nothing"], "no entry 'nothing'"),
        (["inversions", "vcomp", "--with-output"], "--with-output needs --drives"),
        (["inversions", "vcomp", "--drives", "--number", "0"], "at least one drive"),
        (["variants"], "--links"),
        (["variants", "--links", "6", "--drive-joint", "R@wall"], "frame, moving or any"),
        (["variants", "--links", "6", "--assortment", "four"], "--assortment 'four'"),
        (["variants", "--links", "6", "--at-frame", "P:x"], "--at-frame: expected a pair"),
    ],
)
def test_mistakes_are_one_sentence(capsys, arguments, words):
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert words in err
    assert len(err.strip().splitlines()) == 1


@pytest.mark.parametrize(
    ("arguments", "number"),
    [
        (
            ("variants", "--links", "6", "--prismatic", "1", "--drive-joint", "P@moving", "--output-joint", "R@frame"),
            34,
        ),
        (("variants", "--links", "6", "--prismatic", "1"), 6),
        (("inversions", "slidercrank", "--drives", "--with-output", "--text"), 8),
        (("inversions", "vcomp", "--drives", "--anywhere", "--text"), 26),
    ],
)
def test_printed_lines_are_read_again(capsys, monkeypatch, tmp_path, arguments, number):
    """By `check` from standard input and as arguments, and by `gallery` from a file and from standard input."""
    status, printed, _ = run(capsys, *arguments)
    lines = printed.splitlines()
    assert (status, len(lines)) == (0, number)
    if ";" in lines[0]:
        assert [DrivenMechanism.parse(line).text() for line in lines] == lines
    monkeypatch.setattr("sys.stdin", io.StringIO(printed))
    status, out, _ = run(capsys, "check", "-", "--json")
    assert (status, [one["name"] for one in json.loads(out)]) == (0, lines)
    assert run(capsys, "check", *lines[:2])[0] == 0
    file, page = tmp_path / "lines.txt", tmp_path / "page.html"
    file.write_text("# found\n" + printed, encoding="utf-8")
    assert run(capsys, "gallery", str(file), "-o", str(page))[0] == 0
    text = page.read_text(encoding="utf-8")
    assert text.count("<svg") == number
    monkeypatch.setattr("sys.stdin", io.StringIO(printed))
    assert run(capsys, "gallery", "-", "-o", str(page))[0] == 0
    assert page.read_text(encoding="utf-8") == text


def test_every_driven_mechanism_has_a_code(capsys):
    """Also with drives on two links of a multiple joint."""
    items = json.loads(run(capsys, "inversions", "vcomp", "--drives", "--anywhere", "--json")[1])["items"]
    codes = [one["code"] for one in items]
    assert len(set(codes)) == len(codes)
    assert any(code.rpartition(":")[2].count("-") == 1 and ";drives=" in code for code in codes)
    assert [Mechanism.parse(code).code() for code in codes] == codes


def test_no_column_is_empty(capsys):
    header, *rows = run(capsys, "inversions", "slidercrank", "--drives")[1].splitlines()
    assert header.split() == ["frame", "drive", "family"]
    assert len(rows) == 4
    assert "output" in run(capsys, "inversions", "slidercrank", "--drives", "--with-output")[1].splitlines()[0]


def test_an_output_goes_into_a_realised_linkage(capsys, tmp_path):
    file = tmp_path / "four_bar.toml"
    text = "R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1); output=2"
    assert run(capsys, "realise", text, "-o", str(file))[0] == 0
    assert read_linkage(file).outputs == ("2",)


def test_the_limit_of_a_gallery_is_that_of_the_assortment(capsys, tmp_path):
    page = tmp_path / "page.html"
    assert run(capsys, "gallery", "--links", "12", "--assortment", "9,0,1,2", "-o", str(page))[0] == 0
    number = json.loads(run(capsys, "enumerate", "--links", "12", "--assortment", "9,0,1,2", "--count", "--json")[1])[
        "chains"
    ]
    assert page.read_text(encoding="utf-8").count("<svg") == number > 0
    status, _, err = run(capsys, "gallery", "--links", "12", "-o", str(page))
    assert (status, "6,856 chains are too many for one page" in err) == (2, True)
    status, _, err = run(capsys, "gallery", "--links", "12", "--assortment", "6,6", "-o", str(page))
    assert (status, "there are no such chains" in err) == (2, True)


def test_a_search_without_tries_is_refused_by_the_name_of_the_option(capsys):
    status, _, error = run(capsys, "realise", "quad", "--tries", "0")
    assert (status, error) == (2, "gruebler realise: --tries: expected a whole number of at least 1, but found 0\n")
