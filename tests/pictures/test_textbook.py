"""Pictures for a textbook: widths of lines, letters, TikZ."""

import re
from itertools import combinations
from math import hypot
from xml.etree import ElementTree

import pytest

import gruebler as gr
from gruebler.cli import main
from gruebler.pictures.canvas.free_space import Obstacles, complexes
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape, text_width
from gruebler.pictures.canvas.styles import STYLES, TEXTBOOK
from gruebler.pictures.linkage.letters import joint_letters
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage

MILLIMETRE = 96 / 25.4
FOUR_BAR = gr.FourBar(30, 70, 50, 80)
LETTERS = ["angles", "transmission", "lengths", "joints"]


def shapes_of(value, **options):
    return gr.draw(value, **options).textbook().figure.shapes


def test_lines_have_the_widths_of_iso_128():
    """0.35 and 0.7 mm are neighbours by the factor 2 in the series of ISO 128-2; what is white only separates."""
    rows = {name.removeprefix(TEXTBOOK): style for name, style in STYLES.items() if name.startswith(TEXTBOOK)}
    widths = {style.width / MILLIMETRE for name, style in rows.items() if style.stroke == "ink" and name != "slot-rim"}
    assert sorted(widths) == pytest.approx([0.35, 0.7])


def test_nothing_is_coloured_and_each_bar_is_one_line():
    shapes = shapes_of(FOUR_BAR, curves=[(45, 40)], show=["velocities", "centrodes"])
    used = {STYLES[shape.style] for shape in shapes}
    assert {role for style in used for role in (style.fill, style.stroke)} <= {"", "ink", "paper"}
    bars = [s for s in shapes if s.style == "textbook-outline-bar"]
    assert len(bars) == 3
    assert not any("body" in shape.style for shape in shapes)


def test_letters_of_the_four_bar_are_those_of_the_books():
    """As in Luck/Modler: the driven crank turns about A0, the rocker about B0."""
    texts = {shape.text: shape.at for shape in shapes_of(FOUR_BAR, show=LETTERS) if isinstance(shape, TextShape)}
    assert set(texts) - {"μ = 69.1°"} == {"A_0", "A", "B", "B_0", "a", "b", "c", "d", "φ", "ψ"}
    assert texts["A_0"].x < texts["B_0"].x
    assert texts["A"].y < texts["A_0"].y


@pytest.mark.parametrize(
    ("linkage", "letters"),
    [
        (gr.SliderCrank(20, 50), {"A_0", "A", "B"}),
        (gr.InvertedSliderCrank(30, 50), {"A_0", "A", "B_0"}),
        (gr.read("wiper"), {"A_0", "A", "B_0", "B", "C_0", "C", "D"}),
    ],
)
def test_letters_of_other_linkages(linkage, letters):
    whole = linkage if isinstance(linkage, gr.Linkage) else linkage.linkage()
    assert set(joint_letters(posed_linkage(whole)).values()) == letters


@pytest.mark.parametrize("value", [FOUR_BAR, gr.SliderCrank(20, 50, 5), gr.InvertedSliderCrank(30, 50)])
@pytest.mark.parametrize("at", [0.5, 1.0, 2.0, 4.0])
def test_letters_stand_beside_lines_and_apart(value, at):
    """No letter touches a link, and no two letters each other: by distances from the middles of the texts."""
    shapes = shapes_of(value, at=at, show=LETTERS)
    texts = [shape for shape in shapes if isinstance(shape, TextShape) and "=" not in shape.text]
    bars = [part for s in shapes if isinstance(s, Polylines) and s.style == "textbook-outline-bar" for part in s.parts]
    assert len(texts) >= 4
    assert min(distance(text.at, *bar) for text in texts for bar in bars) > 5.0
    assert min(p.at.minus(q.at).length for p, q in combinations(texts, 2)) > 8.0


def distance(at, p, q):
    """From a point to the line from p to q."""
    part = min(1.0, max(0.0, at.minus(p).dot(q.minus(p)) / hypot(q.x - p.x, q.y - p.y) ** 2))
    return p.plus(q.minus(p), part).minus(at).length


def test_hatching_has_one_direction():
    """The strokes of rails that are level, upright and upside down are parallel."""
    slopes = {
        round((q.y - p.y) / (q.x - p.x), 3)
        for value in (gr.SliderCrank(20, 50), gr.read("lambda"))
        for shape in shapes_of(value)
        if shape.style == "textbook-hatch"
        for p, q in shape.parts
    }
    assert slopes == {-1.0}


def test_tikz_is_balanced_and_sets_signs_as_mathematics(tmp_path):
    path = gr.draw(FOUR_BAR, show=LETTERS).textbook().save(tmp_path / "bar.tex")
    text = path.read_text(encoding="utf-8")
    assert text.count("{") == text.count("}")
    assert text.count("\\begin{tikzpicture}") == text.count("\\end{tikzpicture}") == 1
    assert text.isascii()
    assert r"A\textsubscript{0}" in text
    assert r"$\varphi$" in text
    assert all(line.endswith(";") for line in text.splitlines() if line.startswith((r"\path", r"\node")))
    assert set(re.findall(r"line width=([\d.]+)bp", text)) == {"0.99", "1.98"}


def test_command(tmp_path, capsys):
    """Entries with dimensions are machines, with --structure chains."""
    machine, chain = tmp_path / "machine.svg", tmp_path / "chain.svg"
    assert main(["draw", "wiper", "--style", "textbook", "--names", "joints", "-o", str(machine)]) == 0
    assert main(["draw", "wiper", "--structure", "-o", str(chain)]) == 0
    assert "To scale" in machine.read_text(encoding="utf-8")
    assert "To scale" not in chain.read_text(encoding="utf-8")
    assert 'stroke-width="2.64567"' in machine.read_text(encoding="utf-8")
    capsys.readouterr()


@pytest.mark.parametrize("lengths", ["lengths", "dimensions"])
def test_letters_of_joints_stay_beside_them(lengths):
    """An arc about a joint has room within its circle, and a letter stands on no line drawn later."""
    show = ["angles", "transmission", "joints", lengths]
    figure = draw_linkage(gr.FourBar(25, 70, 40, 70).linkage(), show=show)
    pins = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape)]
    texts = [shape for shape in figure.shapes if isinstance(shape, TextShape)]
    letters = {text.text: text for text in texts if text.text in {"A", "B", "A_0", "B_0"}}
    assert len(letters) == len(pins) == 4
    far = {letter: min(text.at.minus(pin).length for pin in pins) for letter, text in letters.items()}
    assert max(far.values()) < 36, far  # B stood 60 pixels off its joint
    lines = Obstacles([shape for shape in figure.shapes if not isinstance(shape, TextShape)])
    assert [name for name, text in letters.items() if lines.free(complexes([text.at]), text_width(name))[0] < 0] == []


def test_own_names_of_joints(capsys):
    """O2 and O4 are the fixed pivots in Norton's books."""
    figure = gr.draw(FOUR_BAR, show=["joints"], letters=["O2", "A", "B", "O4"]).figure
    own = {shape.text: shape.at for shape in figure.shapes if isinstance(shape, TextShape)}
    usual = {shape.text: shape.at for shape in shapes_of(FOUR_BAR, show=["joints"]) if isinstance(shape, TextShape)}
    assert set(own) == {"O_2", "A", "B", "O_4"}
    for name, known in (("O_2", "A_0"), ("A", "A"), ("B", "B"), ("O_4", "B_0")):
        assert abs(own[name].x - usual[known].x) + abs(own[name].y - usual[known].y) < 20
    assert main(["draw", "four-bar:30,70,50,80", "--names", "O2,A"]) == 2
    assert "expected 4 names of joints, in the order R(frame-crank), R(crank-coupler), " in capsys.readouterr().err


def test_svg_for_word_has_attributes_and_no_style_rules():
    """Every fill and width is where a reader of SVG 1.1 without style sheets finds it."""
    picture = gr.draw(FOUR_BAR, show=LETTERS).textbook().figure
    root = ElementTree.fromstring(picture.svg())
    elements = [element for element in root.iter() if element.tag.endswith(("path", "circle", "rect", "text"))]
    assert len(elements) > len(picture.shapes)
    assert all(element.get("fill") for element in elements)
    assert all(element.get("font-size") for element in elements if element.tag.endswith("text"))
    widths = {float(width) / MILLIMETRE for element in elements if (width := element.get("stroke-width"))}
    assert sorted(widths) == pytest.approx([0.35, 0.7], rel=1e-5)
    assert not [element for element in root.iter() if element.get("class") or element.tag.endswith("style")]


def test_links_of_lengths_have_the_names_of_the_language():
    """Kurbel, Koppel, Schwinge, Gestell as in Luck/Modler; names that are given win."""
    german = shapes_of(FOUR_BAR, labels=True, lang="de")
    assert {s.text for s in german if isinstance(s, TextShape)} == {"Gestell", "Kurbel", "Koppel", "Schwinge"}
    own = shapes_of(FOUR_BAR, labels=True, lang="de", names={"crank": "drive"})
    assert {s.text for s in own if isinstance(s, TextShape)} == {"frame", "drive", "coupler", "rocker"}
