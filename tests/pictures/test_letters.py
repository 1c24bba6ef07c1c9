"""The letters of joints in pictures: those of the reader's alphabet, in every picture of every machine."""

import re
import xml.etree.ElementTree as ET
from collections import Counter

import pytest

from gruebler import Chain, Mechanism
from gruebler.cli import main
from gruebler.page.structures import structure_record
from gruebler.pictures.structure import draw_graph, draw_loops, draw_structure
from gruebler.teaching.catalog import entries
from gruebler.teaching.worksheets.posters import poster

SVG = "{http://www.w3.org/2000/svg}"

# Table 2.2 and section 2.6 of the teaching documents 000 and 003, the rows whose print is damaged after the rule
# beneath it: D turns, S slides, W screws, the number is that of the motions.
GERMAN = {
    "revolute": "D",
    "prismatic": "S",
    "helical": "W",
    "rolling": "W",
    "cylindrical": "DS",
    "roll_slide": "G",
    "double_slide": "S2",
    "universal": "D2",
    "spherical": "D3",
    "planar": "DS2",
    "ball_groove": "D2S",
    "ball_cylinder": "D3S",
    "cylinder_plane": "D2S2",
    "double_cylindrical": "D2S2",
    "ball_plane": "D3S2",
}
EVERY_PAIR = [
    "spatial: R(0-1) S(1-2) S(2-3) R(3-0)",
    "spatial: C(0-1) C(1-2) C(2-3) R(3-0)",
    "spatial: H(0-1) U(1-2) E(2-3) P(3-0)",
    "spatial: double_slide(0-1) ball_groove(1-2) ball_cylinder(2-3) revolute(3-0)",
    "spatial: cylinder_plane(0-1) double_cylindrical(1-2) ball_plane(2-3) roll_slide(3-0)",
    "spherical: R(0-1) R(1-2) G(2-0)",
]
LETTERS = re.compile("[DSWGRPHCUE][DS0-9]*")


def machines():
    for id, entry in entries().items():
        chain = entry.chain()
        yield id, Mechanism(chain, entry.frame or chain.links[0], entry.drives)
    for text in EVERY_PAIR:
        yield text, Mechanism(Chain.parse(text), "0")


def words(svg):
    return Counter(e.text for e in ET.fromstring(svg).iter(SVG + "text"))


def letters_of(svg):
    return Counter({word: n for word, n in words(svg).items() if word and LETTERS.fullmatch(word)})


def german_of(joints):
    return Counter(GERMAN[joint.pair.name] for joint in joints)


MACHINES = dict(machines())


@pytest.mark.parametrize("name", MACHINES)
def test_german_pictures_have_german_letters(name):
    mechanism = MACHINES[name]
    joints = mechanism.chain.joints
    in_space = mechanism.chain.space != "planar"
    assert letters_of(draw_structure(mechanism, lang="de").svg()) == german_of(joints if in_space else ())
    assert letters_of(draw_structure(mechanism, symbols=True, lang="de").svg()) == german_of(joints)
    assert letters_of(draw_loops(mechanism, lang="de").svg()) == german_of(joints if in_space else ())
    other = [joint for joint in joints if in_space or not joint.pair.is_turning]
    assert letters_of(draw_graph(mechanism, lang="de").svg()) == german_of(other)


@pytest.mark.parametrize("name", MACHINES)
def test_the_page_has_german_letters(name):
    chain = MACHINES[name].chain
    record = structure_record(chain.text(), "de")
    in_space = chain.space != "planar"
    assert letters_of(record["picture"]) == german_of(chain.joints if in_space else ())
    named = Counter(re.split(r"[(]", joint["name"])[0] for joint in record["joints"])
    assert {symbol for symbol in named if LETTERS.fullmatch(symbol)} <= {*GERMAN.values()}
    assert all(kind["symbol"] in GERMAN.values() for joint in record["joints"] for kind in joint["types"])


def test_english_pictures_have_international_letters():
    figure = draw_structure(MACHINES["spatial: R(0-1) S(1-2) S(2-3) R(3-0)"])
    assert letters_of(figure.svg()) == {"R": 2, "S": 2}


@pytest.mark.parametrize("id", [id for id, entry in entries().items() if entry.space != "planar"])
def test_sheets_and_commands_have_german_letters(id, tmp_path):
    record = entries()[id]
    joints = record.chain().joints
    for number, command in enumerate((f"draw {id}", f"sheet draw {id}", f"gallery {id} --structure")):
        path = tmp_path / f"{number}{'.svg' if command.startswith('draw') else '.html'}"
        assert main([*command.split(), "-o", str(path), "--lang", "de"]) == 0
        found = Counter(re.findall(rf"<text[^>]*>({LETTERS.pattern})</text>", path.read_text(encoding="utf-8")))
        pictures = 2 if record.in_space and command.startswith("sheet") else 1  # to scale, and the structure
        assert found == german_of([*joints] * pictures), command


def test_the_poster_of_joints_has_german_letters():
    _, sections = poster("joints", lang="de")
    found = Counter()
    for section in sections:
        for item in section.items:
            found += letters_of(item.figure.svg())
    assert found
    assert {*found} <= {*GERMAN.values()}
