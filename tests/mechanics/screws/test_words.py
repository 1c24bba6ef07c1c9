"""The report in words, as plain data, and in files."""

import json
import math

import pytest

from gruebler import GrueblerError
from gruebler.base.errors import LinkageError
from gruebler.files.linkages import write_linkage
from gruebler.files.screws import read_any_linkage, screws_to_json, spatial_from_json
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.screws import Evidence, freedoms
from gruebler.mechanics.screws.mobility_report import _FINITE
from gruebler.teaching.catalog import entries
from tests.mechanics.screws import machines as m

SHAKY = m.locomotive(3, error=0.01)


def test_every_evidence_has_a_sentence():
    assert _FINITE.keys() == set(Evidence)


@pytest.mark.parametrize(
    ("linkage", "english", "german"),
    [
        (m.winch(), "with b = 2 the count gives 1", "mit b = 2 ergibt die Zählung 1"),
        (
            m.locomotive(3),
            "w0, w1, w2 are 3 equal and parallel cranks between 0 and rod",
            "gleiche und parallele Kurbeln",
        ),
        (SHAKY, "only shaky", "wackelt nur"),
        (m.hooke(), "all axes pass through one point", "alle Achsen gehen durch einen Punkt"),
        (m.friction(), "touch on the line of their centres", "berühren sich auf der Mittenlinie"),
        (m.bevel_in_space(2), "no known geometric reason", "bekannter geometrischer Grund wurde nicht erkannt"),
        (m.locomotive(2, angle=0.0), "2 branches meet in this pose", "treffen sich 2 Einbaulagen"),
        (m.geneva_dwell(), "Joints at rest: R(0-2)", "Ruhende Gelenke: D(0-2)"),
        (m.strut(0.1), "nothing moves even for an instant", "auch momentan ruht alles"),
    ],
)
def test_words(linkage, english, german):
    found = freedoms(linkage)
    assert english in found.explain()
    assert german in found.explain("de")
    assert "nan" not in found.explain()


def test_idle_freedoms_are_told():
    found = freedoms(entries()["susp_5link"].placed())
    assert (found.mobility, found.idle, found.useful) == (6, 5, 1)
    assert "without idle freedoms the mobility is 1" in found.explain()
    assert "ist der Laufgrad 1" in freedoms(entries()["susp_spatial"].placed()).explain("de")


def test_an_unknown_language():
    with pytest.raises(GrueblerError, match=r"expected a language \(en, de\), but found 'fr'"):
        freedoms(SHAKY).explain("fr")


def test_plain_data():
    document = json.loads(json.dumps(freedoms(m.winch()).to_json()))
    assert document["counted"] == -3
    assert document["instant"]["rank"] == 11
    assert len(document["instant"]["singular_values"]) == 12
    assert document["instant"]["redundant"] == {"R(frame-spindle)": 4, "H(spindle-nut)": 4, "P(frame-nut)": 4}
    assert document["finite"]["evidence"] == "followed"
    assert document["reasons"][0]["kind"] == "group_cylinder"


@pytest.mark.parametrize(
    "linkage",
    [m.winch(), m.bevel(2), m.geneva(), m.differential(1), m.cardan(), entries()["susp_5link"].placed()],
    ids=str,
)
def test_files_and_back(linkage, tmp_path):
    document = screws_to_json(linkage)
    again = spatial_from_json(json.loads(json.dumps(document)))
    assert again.mechanism == linkage.mechanism
    for one, other in zip(again.places, linkage.places, strict=True):
        assert one.at == other.at
        assert (one.x, one.y, one.z) == (other.x, other.y, other.z)
        assert one.pitch == pytest.approx(other.pitch)
        assert one.radii == (None if other.radii is None else pytest.approx(other.radii))
    if not any(math.inf in (place.radii or ()) for place in linkage.places):
        path = tmp_path / "one.json"
        path.write_text(json.dumps(document), encoding="utf-8")
        assert read_any_linkage(path).mechanism == linkage.mechanism


def test_files_of_sizes_are_read_too(tmp_path):
    path = tmp_path / "bar.toml"
    write_linkage(path, FourBar(25, 70, 40, 70).linkage())
    assert read_any_linkage(path) == FourBar(25, 70, 40, 70).linkage()


WINCH = """
joints = "spatial: R(frame-spindle) H(spindle-nut) P(frame-nut)"
[screws]
unit = "mm"
[screws.joints]
"R(frame-spindle)" = { z = [0, 0, 1] }
"H(spindle-nut)" = { z = [0, 0, 1], lead = 5 }
"P(frame-nut)" = { at = [0, 50, 0], x = [0, 0, 1] }
"""


@pytest.mark.parametrize(
    ("right", "wrong", "words"),
    [
        ("lead = 5", "laed = 5", r"unknown key 'screws\.joints\.H\(spindle-nut\)\.laed'; did you mean 'lead'"),
        ("lead = 5", 'lead = "five"', r"lead: expected a number, but found 'five'"),
        ("x = [0, 0, 1]", "x = [0, 1]", "expected 3 numbers"),
        ("x = [0, 0, 1]", "z = [0, 0, 1]", "a prismatic joint needs its x axis"),
        ('unit = "mm"', "", "the key 'unit' is missing"),
        ('"P(frame-nut)" =', '"P(frame-drum)" =', "is not one of the joints"),
        ("spatial: ", "spatial: R(a-b) ", "joints, links, frame or drives"),
        ("[screws.joints]", "[screws.joints.joints]", "is not one of the joints|unknown key"),
    ],
)
def test_mistakes_in_files(tmp_path, right, wrong, words):
    path = tmp_path / "winch.toml"
    path.write_text(WINCH, encoding="utf-8")
    assert freedoms(read_any_linkage(path)).mobility == 1
    path.write_text(WINCH.replace(right, wrong), encoding="utf-8")
    with pytest.raises(LinkageError, match=words):
        read_any_linkage(path)


def test_other_files(tmp_path):
    with pytest.raises(LinkageError, match=r"in a \.toml or \.json file"):
        read_any_linkage(tmp_path / "x.txt")
    with pytest.raises(LinkageError, match="cannot be read"):
        read_any_linkage(tmp_path / "x.toml")


def test_the_catalog_says_why():
    """Every entry whose dimensions give more than its chain has a reason that is recognised, not only claimed."""
    placed = [(record, record.placed()) for record in entries().values()]
    sized = [(record, linkage) for record, linkage in placed if linkage is not None]
    assert len(sized) > 60
    for record, linkage in sized:
        found = freedoms(linkage)
        assert found.mobility == (record.claims.mobility if record.claims.mobility is not None else found.generic)
        assert found.reasons or found.mobility == found.generic, record.id
