"""Collection sheets: what is printed against what is derived; the page."""

import cmath
import math
import re
from functools import cache
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from gruebler.base.errors import CatalogError, LinkageError
from gruebler.pictures.canvas.shapes import TextShape
from gruebler.teaching.catalog import catalog_folder
from gruebler.teaching.sheets import all_sheets, sheet
from gruebler.teaching.sheets.expressions import Expression
from gruebler.teaching.sheets.layout import page
from gruebler.teaching.sheets.messages import explanation_paragraphs, typeset_number, value_lines
from gruebler.teaching.sheets.model import Sheet, StatedValue
from gruebler.teaching.sheets.page import PlacedPicture
from gruebler.teaching.sheets.picture import definition_picture
from gruebler.teaching.sheets.records import read_sheet

MZC = (catalog_folder() / "sheets" / "mzc.toml").read_text(encoding="utf-8")

drawn = cache(lambda id, lang: page(sheet(id), lang))

# Document 001, recomputed with 40 digits.
FIGURES = {
    "kappa": 15.79316904826399,
    "cos_kappa": 0.9622504486493763,
    "near": 8.16496580927726,
    "h": 0.4688903713561814,
    "cos_psi_near": 0.5773502691896258,
    "cos_psi_far": 0.34641016151377546,
    "contact": 6,
    "l1_star": 8.333333333333334,
    "l2_star": 1.9245008972987525,
    "l4_star": 7.69800358919501,
    "phi0_prime": 54.735610317245346,
    "sin_phi0": 0.816496580927726,
    "l1_prime": 5.103103630798287,
    "l2_prime": 1.1785113019775793,
    "l4_prime": 4.714045207910317,
    "k_prime": 0.6123724356957945,
    "tan_kappa": 0.28284271247461906,
    "k_star": 1,
    "phi_G": 163.32477378,
    "phi_A": 98.33761311,
    "ratio": 3.907352348,
    "scale": 3.838916653,
}


def test_figures_of_the_sheet_001():
    one = sheet("mzc")
    found = {told.id: told.derived for told in (*one.quantities, *one.example_values)}
    assert found.keys() == FIGURES.keys()
    for key, value in FIGURES.items():
        assert abs(found[key] - value) < (2e-7 if key in ("phi_G", "phi_A") else 1e-8), key
    assert abs(abs(one.place(one.motion(0), "K") - 4) - 8.633856180633442) < 1e-12
    axis = one.place(one.motion(0), "K") - one.place(one.motion(180), "K")
    assert abs(math.degrees(cmath.phase(axis)) - 105.79316904826399) < 1e-10
    assert abs(one.place(one.motion(180), "K") - (1.7777777777777777 + 7.856742013183862j)) < 1e-12
    assert abs(one.place(one.motion(0), "K") - (1.6501619827636897 + 8.30793198338872j)) < 1e-12
    assert [round(told.derived, 9) for told in one.dimensions] == [
        1,
        4.330127019,
        4.330127019,
        4,
        8.333333333,
        4.330127019,
    ]


def test_misprints_are_told():
    wrong = {told.id for told in sheet("mzc").quantities if not told.is_as_printed}
    assert wrong == {"l4_star"}
    lines = value_lines(sheet("mzc"), "en")
    assert "l₄* = 40/9·√3 = 7.698004 (the source has 40/3·√3)" in lines


@pytest.mark.parametrize("id", all_sheets())
def test_every_sheet_holds(id):
    one = sheet(id)
    assert one.wrong == ()
    for told in one.dimensions:
        assert told.exact is not None
        assert told.exact.exact is not None
    for lang in ("en", "de"):
        assert all("{" not in text for text in explanation_paragraphs(one, lang))


def test_sizing_law():
    """Twice the length and the tolerance, twice the mechanism; the exact dimensions are kept."""
    one = sheet("mzc")
    small, large = one.sized(15, 0.075), one.sized(30, 0.15)
    for (symbol, length), (other, longer), told in zip(small.lengths, large.lengths, one.dimensions, strict=True):
        assert symbol == other == told.symbol
        assert abs(longer - 2 * length) < 1e-9 * length
        assert abs(length / small.scale - told.exact.value) < 1e-9
    with pytest.raises(LinkageError, match="relative deviation of 1e-20 or less"):
        one.sized(1, 1e-20)


@pytest.mark.parametrize(
    ("printed", "derived", "as_printed"),
    [("15.79", 15.793169, True), ("15.8", 15.793169, True), ("15.7", 15.793169, False), ("40/3*sqrt(3)", 7.7, False)],
)
def test_printed_digits(printed, derived, as_printed):
    assert (
        StatedValue(id="x", symbol="x", derived=derived, exact=None, printed=Expression(printed)).is_as_printed
        is as_printed
    )


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("id", all_sheets())
def test_the_page(id, lang):
    made = drawn(id, lang)
    tree = ElementTree.fromstring(made.svg())
    assert (tree.get("width"), tree.get("height"), tree.get("lang")) == ("210mm", "297mm", lang)
    texts = ["".join(node.itertext()) for node in tree.iter("{http://www.w3.org/2000/svg}text")]
    wide, high = (float(word) for word in tree.get("viewBox").split()[2:])
    places = [(float(n.get("x")), float(n.get("y"))) for n in tree.findall("{http://www.w3.org/2000/svg}text")]
    assert all(0 < x < wide and 0 < y < high for x, y in places)
    assert any(("Zugriffsmerkmale" if lang == "de" else "Access features") in text for text in texts)
    assert made.svg() == page(sheet(id), lang).svg()
    assert "prefers-color-scheme" not in made.svg()
    html = made.html()
    assert html.startswith("<!DOCTYPE html>")
    assert "@page{size:A4;margin:0}" in html
    assert "<script" not in html


def test_the_lines_of_the_page_stay_apart():
    """Base lines in one column are a line apart, and the lowest keeps clear of the foot."""
    for one in all_sheets().values():
        for lang in ("en", "de"):
            words = [item for item in drawn(one.id, lang).items if hasattr(item, "text")]
            for x in {item.x for item in words if item.anchor == "start"}:
                column = sorted(item.y for item in words if item.x == x)
                assert all(b - a > 11 for a, b in pairwise(column))


def test_the_page_on_paper():
    made = drawn("mzc", "de")
    pdf, png = made.written("pdf"), made.written("png")
    assert pdf.startswith(b"%PDF")
    assert re.search(rb"/MediaBox \[ 0 0 595\.\d+ 841\.\d+ \]", pdf)
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert made.written("svg") == made.svg().encode()


def test_a_name_stays_text(tmp_path):
    path = tmp_path / "mzc.toml"
    path.write_text(MZC.replace("Planar four-bar with", "<script>alert(1)</script> &"), encoding="utf-8")
    made = page(Sheet(read_sheet(path)), "en").html()
    assert "<script" not in made
    assert "&lt;script&gt;" in made


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('value = "25/3"', 'value = "25/x"', "dimensions k: '25/x', column 4: unknown name 'x'"),
        ('of = ["A", "B"]', 'of = ["A", "C"]', "dimensions l₂: 'C' is none of the names A0, A, B, B0, K"),
        ("contact_at = 180\n", "", "quantities contact: expected one of angle, cosine, distance, contact_at, cognate"),
        ("contact_at = 180\n", 'contact_at = 180\ndistance = ["A", "B"]\n', "but found 2"),
        ("{kappa:.2f}", "{kapa:.2f}", "explanation: '{kapa:.2f}' is not a place"),
        ("{kappa:.2f}", "{kappa.__class__}", "explanation: '{kappa.__class__}' is not a place"),
        ("{kappa:.2f}", "{kappa:.2f", "is not a place such as {id:.3f}"),
        ('axis_through = "B0"', 'axis_through = "C0"', "picture.axis_through: 'C0' is none of the names"),
        ("number = 2", "number = 4", "number"),
        ("centre = 180", "centre = 400", "expected start < centre < end"),
        ("phi_G =", "phi_X =", "'phi_X' is none of phi_G, phi_A, ratio, scale"),
        ("point =", "pount =", "unknown key 'pount'; did you mean 'point'"),
        ('printed = "0.469"', 'printed = "2**99**9"', "quantities h: '2"),
        ('printed = "0.469"', 'printed = "2**(1/0)"', "a division by zero"),
        ('printed = "0.469"', 'printed = "."', "expected a number"),
        ('point = "K"', 'point = "Z"', "point: 'Z' is none of the names"),
        ('angle = ["B", "A", "K"]', 'angle = ["B", "B", "K"]', "quantities kappa: expected different names"),
        ('scale = ["A0", "A"]', 'scale = ["A", "A"]', "scale: expected different names"),
        ('scale = ["A0", "A"]', 'scale = ["A0", "B"]', "scale: A0 and B are on no common link"),
        ("length = 15", "length = nan", "guide.length: expected a positive length, but found nan"),
        ("length = 15", "length = -1", "guide.length: expected a positive length"),
        ("tolerance = 0.075", "tolerance = inf", "guide.tolerance: expected a positive length"),
        ("at = 180", "at = nan", "quantities near: at: expected a drive value"),
        ("less_at = 180", "less_at = 1e300", "quantities h: less_at: expected a drive value"),
        ("pose = 60", "pose = inf", "picture.pose: expected a drive value"),
        ('axis_through = "B0"', 'axis_through = "K"', "picture.axis_through: K is not a joint of the frame"),
        ('of = ["A", "B"]', 'of = ["A", "B0"]', "dimensions l₂: A and B0 are on no common link"),
        ('id = "h"', 'id = "near"', "quantities near: this id is given twice"),
        ('machine = "mzc"', 'machine = "mzk"', "machine: "),
        ('K = "K"', 'K = "Q"', "names.K: 'Q' is none of R(frame-crank)"),
    ],
)
def test_records_that_do_not_fit(tmp_path, old, new, words):
    assert old in MZC
    path = tmp_path / "mzc.toml"
    path.write_text(MZC.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(CatalogError, match=re.escape(words)):
        read_sheet(path)


@pytest.mark.parametrize(
    ("old", "new", "id"),
    [
        ('value = "4"', 'value = "4.01"', "l₄"),
        ('printed = "8.165"', 'printed = "8.164"', "near"),
        ('printed = "40/3*sqrt(3)"', 'printed = "40/9*sqrt(3)"', "l4_star"),
        ('phi_G = "163.3"', 'phi_G = "163.4"', "phi_G"),
    ],
)
def test_values_that_do_not_hold_are_found(tmp_path, old, new, id):
    """A wrong dimension, a wrong print without reason, a reason where the print is right, a wrong example."""
    assert old in MZC
    path = tmp_path / "mzc.toml"
    path.write_text(MZC.replace(old, new, 1), encoding="utf-8")
    assert [told.id for told in Sheet(read_sheet(path)).wrong] == [id]


def test_a_sheet_with_a_wrong_value_gets_no_page(tmp_path):
    path = tmp_path / "mzc.toml"
    path.write_text(MZC.replace('value = "25/3"', 'value = "26/3"', 1), encoding="utf-8")
    with pytest.raises(CatalogError, match=r"sheet mzc: k is 8\.33333333, not what the record says"):
        page(Sheet(read_sheet(path)))


def test_figures_in_the_explanation_are_derived():
    assert "10/9·√3" in explanation_paragraphs(sheet("mzc"), "de")[2]
    assert "{l2_star}" in sheet("mzc").record.explanation[2].de
    assert "4 : 5 : 5 : 2" in explanation_paragraphs(sheet("lambda"), "en")[2]


def test_the_german_page_has_decimal_commas():
    texts = re.findall(r">([^<>]*)</text>", drawn("mzc", "de").svg())
    assert {"10⁻³", "10⁻²"} <= set(texts)
    assert any(re.search(r"\d,\d", text) for text in texts)
    assert any("l₂\u00a0=\u00a016,623; l₃" in text for text in texts)
    assert not [text for text in texts if re.search(r"\d\.\d", text)]
    assert any(
        "Abschnitt 3.5.4 und Aufgabe 20" in text
        for text in re.findall(r">([^<>]*)</text>", drawn("lambda", "de").svg())
    )


@pytest.mark.parametrize("lang", ["en", "de"])
def test_indices_stand_lower_on_the_page(lang):
    """Nothing with an underscore is left; each index is a piece of its own and no space is lost before an equals."""
    made = drawn("mzc", lang).svg()
    texts = ElementTree.fromstring(made).iter("{http://www.w3.org/2000/svg}text")
    words = ["".join(node.itertext()) for node in texts]
    assert not [text for text in words if "_" in text]
    assert "QG = 0,075/15 = 0,005" in words if lang == "de" else "QG = 0.075/15 = 0.005" in words
    assert 'Q<tspan dy="2.8" font-size="8.2">G</tspan> <tspan dy="-2.8">= ' in made
    assert "B₀KI = 10/3·√6" in " ".join(words)


def test_unknown_sheets():
    with pytest.raises(CatalogError, match="did you mean 'mzc'"):
        sheet("mzk")
    with pytest.raises(CatalogError, match="'Q' is none of the names"):
        sheet("mzc").place(sheet("mzc").motion(0), "Q")


def test_numbers_of_a_language():
    assert typeset_number(-1.25, "de", ".1f") == "−1,2"
    assert typeset_number(-1.25, "en", ".2f") == "−1.25"


@pytest.mark.parametrize("id", all_sheets())
def test_the_picture_of_the_definition(id):
    """Figure 2 of sheet 001: L and Δy, measured in the picture, are those of the example."""
    one = sheet(id)
    figure, factor = definition_picture(one, "de")
    texts = {shape.text for shape in figure.shapes if isinstance(shape, TextShape)}
    point = one.record.point
    assert {"g", "L", "Δy", f"{point}_A", f"{point}_E", f"{point}_I"} <= texts
    (curve,) = (shape for shape in figure.shapes if shape.style == "curve")
    begin, end, touch = (shape.at for shape in figure.shapes if shape.style == "dot")
    low, high = sorted((begin.x, end.x))
    inside = [begin, end, *(at for part in curve.parts for at in part if low <= at.x <= high)]
    band = max(at.y for at in inside) - min(at.y for at in inside)
    assert band / factor / (high - low) == pytest.approx(one.example.sizing.piece.ratio, rel=0.02)
    assert min(begin.y, end.y) == pytest.approx(min(at.y for at in inside), abs=0.5)
    assert low < touch.x < high


def test_the_diagram_has_a_scale_of_phi_a():
    texts = [item.figure for item in drawn("mzc", "en").items if isinstance(item, PlacedPicture)]
    names = [shape.text for shape in texts[-1].shapes if isinstance(shape, TextShape)]
    assert "φ_A in °" in names
    below, above = names.index("0"), names.index("180", names.index("L/l₁") - 20)
    assert [float(text) for text in names[below : below + 7]] == [0, 30, 60, 90, 120, 150, 180]
    assert [float(text) for text in names[above : above + 7]] == [180, 165, 150, 135, 120, 105, 90]
