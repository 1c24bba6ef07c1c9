"""Pictures as files: sound SVG, the same for the same structure, text that stays text, golden ones by structure."""

import json
import re
import xml.etree.ElementTree as ET
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import Chain, GrueblerError, Mechanism, chains, inversions
from gruebler.pictures.canvas import gallery_html
from gruebler.pictures.canvas.files import picture_bytes, suffix_of
from gruebler.pictures.canvas.gallery import Item, Section
from gruebler.pictures.canvas.styles import COLOURS, LINES, STYLES
from gruebler.pictures.structure import draw_contracted, draw_graph, draw_loops, draw_structure, place_joints
from gruebler.teaching.catalog import entries
from tests import strategies

GOLDEN = Path(__file__).parent / "golden.json"
VIEWS = (draw_structure, draw_graph, draw_contracted, draw_loops)
SVG = "{http://www.w3.org/2000/svg}"
FOUR_BAR = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")


def machine(id):
    entry = entries()[id]
    chain = entry.chain()
    return Mechanism(chain, entry.frame or chain.links[0], entry.drives)


def structure(figure):
    """What the elements are, how many points their paths have, and all words; not where anything is."""
    root = ET.fromstring(figure.svg())
    shapes = Counter(
        f"{e.tag.removeprefix(SVG)} {e.get('class')} {len(re.findall('[ML]', e.get('d', '')))}"
        for e in root
        if e.get("class")
    )
    words = sorted(e.text for e in root.iter() if e.tag == SVG + "text")
    return {"shapes": dict(sorted(shapes.items())), "words": words, "title": root.findtext(SVG + "title")}


def golden_pictures():
    six = list(chains(6))
    yield "four-bar", draw_structure(FOUR_BAR)
    yield "four-bar graph", draw_graph(FOUR_BAR)
    yield "watt", draw_structure(six[0], labels=True)
    yield "stephenson loops", draw_loops(six[1])
    yield "stephenson contracted", draw_contracted(six[1])
    for id in ("vcomp", "diff", "loco3", "scissor2", "filmclaw", "susp_spatial", "friction_rigid"):
        yield id, draw_structure(machine(id), labels=True)
    yield "not planar", draw_loops(list(chains(10))[-1])


def test_golden_pictures():
    assert {name: structure(figure) for name, figure in golden_pictures()} == json.loads(GOLDEN.read_text("utf-8"))


@given(strategies.chains(most_links=6), st.data())
@settings(max_examples=20)
def test_isomorphic_chains_have_one_picture(chain, data):
    other = data.draw(strategies.renumbered(chain))
    one, two = draw_structure(chain), draw_structure(other)
    assert one.shapes == two.shapes
    assert (one.width, one.height) == (two.width, two.height)


@pytest.mark.parametrize("links", [4, 6, 8])
def test_inversions_keep_the_layout(links):
    """All inversions of a chain have the layout of the chain, turned: distances between joints are the same."""

    def spans(thing):
        joints = place_joints(thing).joints
        return sorted(round(a.minus(b).length, 3) for a in joints for b in joints)

    for chain in chains(links):
        for mechanism in inversions(chain):
            assert spans(mechanism) == pytest.approx(spans(chain), abs=2e-3)


def test_the_frame_is_low():
    for mechanism in inversions(next(chains(6))):
        placed = place_joints(mechanism)
        frame = placed.outlines[mechanism.frame]
        assert max(p.y for p in frame) == pytest.approx(max(p.y for p in placed.joints), abs=1)


@pytest.mark.parametrize("view", VIEWS)
def test_pictures_are_sound_and_repeat(view):
    for thing in (FOUR_BAR, machine("vcomp"), machine("susp_spatial"), machine("drafting3")):
        text = view(thing).svg()
        assert text == view(thing).svg()
        root = ET.fromstring(text)
        assert root.tag == SVG + "svg"
        assert root[0].tag == SVG + "title"
        assert root[0].text
        assert root[1].tag == SVG + "desc"
        assert root[1].text


@pytest.mark.parametrize("id", entries())
def test_every_machine_fits_its_picture(id):
    figure = draw_structure(machine(id), labels=True, lang="de")
    numbers = [float(x) for x in re.findall(r"[MLxy]=?\"?(-?\d+\.?\d*)", figure.svg())]
    assert min(numbers) >= 0
    assert max(numbers) <= max(figure.width, figure.height)


def test_pictures_are_small():
    assert len(draw_structure(FOUR_BAR).svg()) < 2000
    assert all(len(draw_structure(mechanism, labels=True).svg()) < 5000 for mechanism in inversions(FOUR_BAR))


def test_names_stay_text():
    wicked = FOUR_BAR.renamed({"0": "<script>alert(1)</script>", "1": "a & b", "2": '"]]>', "3": "&lt;"})
    for view in VIEWS:
        text = view(wicked, name="<script>").svg()
        root = ET.fromstring(text)
        assert not list(root.iter(SVG + "script"))
        assert "<script" not in text
    words = [e.text for e in ET.fromstring(draw_structure(wicked, labels=True).svg()).iter(SVG + "text")]
    assert any("<script>alert(1)</script>" in word for word in words)
    page = gallery_html("<b>", [Section("<i>", (Item(draw_structure(wicked), "<u>", "<s>"),))], note="</style>")
    assert not re.search(r"<(b|i|u|s|script)>", page)


def test_all_links_are_named_once():
    for id in ("vcomp", "excavator", "diff"):
        thing = machine(id)
        words = " ".join(e.text for e in ET.fromstring(draw_structure(thing, labels=True).svg()).iter(SVG + "text"))
        assert all(link in words for link in thing.chain.links)


def test_both_grounds_are_readable():
    """Contrast of ink and accent against paper, and of ink against links, by WCAG 2: 4.5 for text, 3 for lines."""

    def luminance(colour):
        parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))

    def contrast(one, other, ground):
        a, b = sorted((luminance(COLOURS[one][ground]), luminance(COLOURS[other][ground])), reverse=True)
        return (a + 0.05) / (b + 0.05)

    for ground in (0, 1):
        assert contrast("ink", "paper", ground) > 7
        assert contrast("ink", "body", ground) > 4.5
        assert contrast("ink", "frame", ground) > 4.5
        for colour in ("accent", "motion", "green", "purple", "faint"):
            assert contrast(colour, "paper", ground) > 3
        assert contrast("ink", "warning", ground) > 7
        assert contrast("motion", "warning", ground) > 3


def test_lines_of_a_plot_are_told_apart_without_colour():
    dashes = [STYLES[name].dash for name in LINES]
    assert len(set(dashes[:4])) == 4
    assert len({(STYLES[name].stroke, STYLES[name].dash) for name in LINES}) == len(LINES)


def test_signs_of_joints():
    circles = Counter(
        shape["class"] for shape in map(dict, _attributes(draw_structure(Chain.parse("R(0-1-2-3) R(0-1) R(2-3)"))))
    )
    assert circles["gr-joint"] == 3
    assert circles["gr-ring"] == 2
    frames = Mechanism(Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)"), "0", [3])
    classes = Counter(shape["class"] for shape in map(dict, _attributes(draw_structure(frames))))
    assert classes["gr-rail"] == classes["gr-block"] == classes["gr-head"] == 1
    assert classes["gr-hatch"] == 2
    assert classes["gr-hatch-bar"] == 1


def _attributes(figure):
    return [e.attrib.items() for e in ET.fromstring(figure.svg()) if e.get("class")]


def test_loops_are_counted():
    for chain in [*chains(6), *chains(8)]:
        words = [e.text for e in ET.fromstring(draw_loops(chain).svg()).iter(SVG + "text")]
        assert sorted(words) == [str(k + 1) for k in range(chain.loops)]


def test_contracted_graphs_have_the_binary_links_as_dots():
    for chain in chains(8):
        classes = Counter(dict(shape)["class"] for shape in _attributes(draw_contracted(chain)))
        assert classes["gr-dot"] == chain.link_kinds[2]
        assert classes["gr-block"] == 8 - chain.link_kinds[2]


def test_files_by_suffix(tmp_path):
    pytest.importorskip("matplotlib")
    figure = draw_structure(machine("vcomp"), labels=True)
    assert picture_bytes(figure, "svg").startswith(b"<svg")
    assert picture_bytes(figure, "png").startswith(b"\x89PNG")
    assert picture_bytes(figure, "pdf").startswith(b"%PDF")
    assert picture_bytes(figure, "png") == picture_bytes(figure, "png")
    with pytest.raises(GrueblerError, match=r"end it with \.svg, \.png, \.pdf or \.tex"):
        suffix_of(tmp_path / "x.gif")


def test_without_matplotlib(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(GrueblerError, match=r"need matplotlib.*gruebler\[plot\]"):
        picture_bytes(draw_structure(FOUR_BAR), "png")


if __name__ == "__main__":  # writes the golden file anew
    GOLDEN.write_text(
        json.dumps({name: structure(figure) for name, figure in golden_pictures()}, indent=1, ensure_ascii=False)
        + "\n",
        "utf-8",
    )
