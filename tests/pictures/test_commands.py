"""`gruebler draw` and `gruebler gallery`, run with their arguments."""

import pytest

from gruebler import GrueblerError
from gruebler.base.text import error_in_language
from gruebler.cli import draw, gallery
from tests.commands import arguments_of


def drawn(capsys, chain, **options):
    assert draw.run(arguments_of("draw", chain, **options)) == 0
    return capsys.readouterr().out


def paged(path, **options):
    assert gallery.run(arguments_of("gallery", "-o", str(path), **options)) == 0
    return path.read_bytes()


def test_a_chain_on_standard_output(capsys):
    text = drawn(capsys, "R(0-1) R(1-2) R(2-3) R(3-0)")
    assert "<title>four-bar chain</title>" in text
    assert "gr-hatch" not in text
    assert "gr-hatch" in drawn(capsys, "R(0-1) R(1-2) R(2-3) R(3-0)", frame="2")
    assert "gr-drive" in drawn(capsys, "g6:Cr", drive=["R(0-1)"])


def test_an_entry_in_german(capsys):
    text = drawn(capsys, "vcomp", lang="de", labels=True)
    assert "<title>Zweizylinder-V-Verdichter (V-Kompressor)</title>" in text
    assert "Gestell mit Zylindern" in text
    assert "<desc>Glieder: 6" in text


@pytest.mark.parametrize("view", ["graph", "contracted", "loops"])
def test_views_differ(capsys, view):
    assert drawn(capsys, "vcomp", **{view: True}) != drawn(capsys, "vcomp")


def test_files(tmp_path):
    assert draw.run(arguments_of("draw", "diff", out=tmp_path / "x.svg")) == 0
    assert (tmp_path / "x.svg").read_text("utf-8").startswith("<svg")
    for name, words in (("x.gif", "end it with"), ("no/x.svg", "cannot be written")):
        with pytest.raises(GrueblerError, match=words):
            draw.run(arguments_of("draw", "diff", out=tmp_path / name))


def test_the_sixteen_chains_on_one_page(tmp_path):
    page = paged(tmp_path / "eight.html", links=8).decode()
    assert page.count("<svg") == 16
    assert "16 chains" in page
    assert [page.count(f"{a} ({n})") for a, n in (("4, 4", 9), ("5, 2, 1", 5), ("6, 0, 2", 2))] == [1, 1, 1]
    assert page.count("<style>") == 1


def test_inversions_are_named(tmp_path):
    page = paged(tmp_path / "six.html", links=6, inversions=True, lang="de").decode()
    assert page.count("<svg") == 5
    assert "(5 aus 2 Ketten)" in page
    assert all(
        f"  {name}<" in page for name in ("Watt I", "Watt II", "Stephenson I", "Stephenson II", "Stephenson III")
    )


def test_machines_on_a_page(tmp_path):
    pytest.importorskip("matplotlib")
    assert paged(tmp_path / "machines.pdf", ids=["vcomp", "diff"], labels=True).startswith(b"%PDF")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, "give --links N"),
        ({"links": 8, "ids": ["vcomp"]}, "either the given items or"),
        ({"links": 14}, "too many for one page"),
        ({"links": 2}, "at least three links"),
        ({"ids": ["vcmp"]}, "did you mean vcomp"),
        ({"ids": ["vcomp"], "inversions": True}, "--inversions goes only with --links"),
        ({"ids": ["vcomp"], "mobility": 2}, "--mobility goes only with --links"),
        ({"links": 5}, "no such chains with 5 links and F = 1"),
    ],
)
def test_refusals(options, words):
    with pytest.raises(GrueblerError, match=words):
        gallery.run(arguments_of("gallery", "-o", "x.html", **options))


def test_pictures_of_a_printed_gallery_stay_legible():
    pytest.importorskip("matplotlib")
    from gruebler.pictures.canvas.gallery import Section
    from gruebler.pictures.canvas.matplotlib_files import _columns

    small, large = (
        gallery._machine(id, arguments_of("gallery", "--structure", "-o", "x.html", labels=True))
        for id in ("mzc", "excavator")
    )
    assert _columns(Section("", (small,))) == 5
    assert _columns(Section("", (small, large))) < 4


def test_refusals_in_german():
    with pytest.raises(GrueblerError) as refused:
        gallery.run(arguments_of("gallery", "-o", "x.html", links=5))
    assert error_in_language(refused.value, "de").startswith("solche Ketten mit 5 Gliedern")
    with pytest.raises(GrueblerError) as refused:
        draw.run(arguments_of("draw", "four-bar:60,30,40,50", at="171"))
    assert "der Antrieb geht in dieser Einbaulage" in error_in_language(refused.value, "de")


def test_a_gallery_tells_higher_pairs_apart(tmp_path):
    """Gears, a belt, a cam and a Geneva drive of one structure have pictures of their own."""
    pictures = set()
    for id in ("geartrain", "belt", "geneva"):
        path = tmp_path / "page.html"
        assert gallery.run(arguments_of("gallery", id, "--structure", "-o", str(path))) == 0
        figure = path.read_text(encoding="utf-8").partition("<svg")[2].partition("</svg>")[0]
        pictures.add(figure.partition('<rect class="gr-ground"')[2])
    assert len(pictures) == 3


def test_a_gallery_shows_machines_and_with_structure_their_mechanisms(tmp_path):
    """Of entries with dimensions, of those that only have a picture, and of those in space."""
    for id, only_to_scale in (("lambda", "To scale."), ("scissor_lr", "To scale"), ("bennett", "Isometric view")):
        page = tmp_path / f"{id}.html"
        assert gallery.run(arguments_of("gallery", id, "-o", str(page))) == 0
        assert only_to_scale in page.read_text(encoding="utf-8"), id
        assert gallery.run(arguments_of("gallery", id, "--structure", "-o", str(page))) == 0
        assert only_to_scale not in page.read_text(encoding="utf-8"), id
