"""Linkage pictures: the joints of all bodies meet, what is written is what the kinematics say, wrong calls are told."""

from __future__ import annotations

import itertools
import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import GrueblerError
from gruebler.base.errors import LinkageError
from gruebler.cli import draw
from gruebler.mechanics.analysis import drive_cycle, transmission_angle
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage, LinkPoint, Pin
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, TextShape
from gruebler.pictures.canvas.simplification import simplified
from gruebler.pictures.canvas.styles import STYLES
from gruebler.pictures.linkage.bodies import body_parts, corners_of
from gruebler.pictures.linkage.layers import coupler_curve_lines
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.pictures.linkage.slides import slides
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.commands import arguments_of
from tests.samples import CLASS_III, CYLINDER

CRANK_ROCKER = FourBar(25, 70, 40, 70)
WITH_POINT = CRANK_ROCKER.linkage({"K": (35, 20)})
FIVE_BAR = Linkage.from_drawing(
    Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); drive=R(0-1); drive=R(0-4)"),
    {"R(0-1)": (0, 0), "R(1-2)": (-1, 2), "R(2-3)": (2, 4), "R(3-4)": (5, 2), "R(0-4)": (4, 0)},
)
LAYERS = ["dead-centres", "transmission", "velocities", "poles", "scale"]


def words(figure):
    return [shape.text for shape in figure.shapes if isinstance(shape, TextShape)]


def styles(figure, name):
    return [shape for shape in figure.shapes if shape.style == name]


def drawn(capsys, chain, **options):
    assert draw.run(arguments_of("draw", chain, **options)) == 0
    return capsys.readouterr().out


# --- where things lie ----------------------------------------------------------------------------


@settings(max_examples=25, deadline=None)
@given(st.floats(0.3, 0.9), st.floats(2.0, 4.0), st.floats(0, 6.28), st.sampled_from([1e-4, 1.0, 1e5]))
def test_pins_are_where_the_links_meet(a, b, phi, unit):
    linkage = FourBar(a, b, 2.0, b).linkage().scaled(unit)
    stage = posed_linkage(linkage, phi)
    motion = move(linkage, [phi])
    circles = [shape for shape in draw_linkage(linkage, at=phi).shapes if isinstance(shape, CircleShape)]
    wanted = [complex(motion.complex_point(name)[0]) for name in linkage.mechanism.chain.joint_names()]
    gaps = [[abs(p - q) * stage.scale for p in wanted] for q in wanted]
    found = [[math.dist(p.at, q.at) for p in circles] for q in circles]
    assert np.allclose(np.sort(np.ravel(found)), np.sort(np.ravel(gaps)), atol=1e-6)


@pytest.mark.parametrize(
    "linkage",
    [WITH_POINT, CLASS_III, SliderCrank(25, 70, 5).linkage(), InvertedSliderCrank(25, 60).linkage(), CYLINDER],
)
def test_bodies_reach_all_their_joints(linkage):
    stage = posed_linkage(linkage)
    found = slides(stage)
    frame = stage.lower.mechanism.frame
    pins = [(*key, e) for key, e in stage.lower.elements.items() if key[1] != frame and isinstance(e, Pin)]
    assert len(pins) >= 3
    for number, link, e in pins:
        corners = corners_of(stage, link, found)
        at = stage.local(complex(e.x, e.y))
        closed = [*corners, corners[0]]
        near = min(_from(at, p, q) for p, q in itertools.pairwise(closed)) if len(corners) > 1 else 0.0
        assert near < 1e-3, (number, link)


def _from(p, a, b):
    ab, ap = b.minus(a), p.minus(a)
    square = ab.dot(ab)
    t = min(1.0, max(0.0, ap.dot(ab) / square)) if square > 1e-12 else 0.0
    return p.minus(a.plus(ab, t)).length


def test_every_pose_of_a_block_lies_on_its_guide():
    linkage = SliderCrank(25, 70, 5).linkage()
    stage = posed_linkage(linkage)
    (slide,) = slides(stage)
    assert (slide.guide, slide.block, slide.sign) == ("frame", "slider", "block")
    stroke = math.sqrt(95**2 - 25) - math.sqrt(45**2 - 25)
    assert abs(slide.high - slide.low) == pytest.approx(stroke, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "between", "guide", "block", "sign"),
    [
        ("kurbelschleife", None, "slotted_lever", "block", "block"),
        ("conchoid", None, "coupler", "block", "block"),
        ("crane_cyl", (34.5, 47.0), "cylinder", "piston", "cylinder"),
        ("crane_cyl", None, "cylinder", "piston", "block"),  # 23 to 51: no rod of one piece is that long
        ("filmclaw_slot", None, "claw", "block G(frame-claw)", "slot"),
    ],
)
def test_signs_of_slides(name, between, guide, block, sign):
    (slide,) = slides(posed_linkage(entry(name).linkage(), between=between))
    assert (slide.guide, slide.block, slide.sign) == (guide, block, sign)


def test_the_rod_stays_in_its_cylinder():
    stage = posed_linkage(entry("crane_cyl").linkage(), between=(34.5, 47.0))
    rows = {part.link: part for part in body_parts(stage) if any(s.style == "block" for s in part.shapes)}
    box = rows["cylinder"].shapes[0].parts[0]
    (rod,) = (s.parts[0] for part in body_parts(stage) for s in part.shapes if s.style == "body-rod")
    length, far = rod[0].minus(rod[1]).length, max(abs(p.x) for p in box)
    ways = stage.path.drives[:, 0] * stage.scale
    assert (ways - length > 0).all()
    assert (ways - length < far).all()


@pytest.mark.parametrize("name", ["cam", "winch_plane"])
def test_a_rod_with_its_round_end_stays_on_its_side_of_the_face(name):
    shapes = draw_linkage(entry(name).linkage()).shapes
    (rod,) = (shape for shape in shapes if isinstance(shape, Polylines) and shape.style == "outline-rod")
    (start, end) = rod.parts[0]
    half = STYLES["outline-rod"].width / 2
    before = start.plus(start.minus(end).unit, half)
    faces = [shape.parts[0] for shape in shapes if isinstance(shape, Polylines) and shape.style in ("rail", "block")]
    sides = [side for face in faces for side in itertools.pairwise(face)]
    ways = [(before.minus(one).length + before.minus(two).length, two.minus(one).length) for one, two in sides]
    assert any(through == pytest.approx(direct, abs=1e-6) for through, direct in ways)


def test_a_block_stands_on_one_rail_which_its_rod_does_not_cross():
    shapes = draw_linkage(SliderCrank(25, 70).linkage(), at=1.0).shapes
    lines = [shape.parts[0] for shape in shapes if isinstance(shape, Polylines) and shape.style == "rail"]
    assert len(lines) == 2  # below the pedestal and below the block
    rail = max(lines, key=lambda line: line[0].minus(line[-1]).length)
    (block,) = (shape.parts[0] for shape in shapes if isinstance(shape, Polylines) and shape.style == "block")
    rod = [place for shape in shapes if getattr(shape, "style", "") == "body-bar" for place in shape.parts[0]]
    assert max(place.y for place in [*block, *rod]) < min(place.y for place in rail)  # y grows downward


def test_the_letter_of_the_frame_stands_between_its_pins():
    names = {"crank": "a", "coupler": "b", "rocker": "c", "frame": "d"}
    shapes = draw_linkage(FourBar(25, 70, 40, 70).linkage(), labels=True, names=names).shapes
    (text,) = (shape for shape in shapes if isinstance(shape, TextShape) and shape.text == "d")
    pins = [shape.at for shape in shapes if isinstance(shape, CircleShape) and shape.style == "joint"]
    left, right = sorted(pins, key=lambda at: at.y)[-2:]
    assert text.at.x == pytest.approx((left.x + right.x) / 2)


def test_the_name_of_a_point_is_nearer_to_it_than_to_a_pin():
    """Q of Hart's inversor lies beside a pin."""
    shapes = draw_linkage(entry("hart").linkage()).shapes
    (text,) = (shape for shape in shapes if isinstance(shape, TextShape) and shape.text == "Q")
    (dot,) = (shape for shape in shapes if isinstance(shape, CircleShape) and shape.style == "dot")
    pins = [shape.at for shape in shapes if isinstance(shape, CircleShape) and shape.style == "joint"]
    assert text.at.minus(dot.at).length < min(text.at.minus(pin).length for pin in pins)


# --- what is drawn with it -----------------------------------------------------------------------


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.floats(-50, 50), st.floats(-50, 50)), min_size=2, max_size=40), st.floats(0.01, 5))
def test_a_thinned_line_is_near(points, most):
    line = [Point(*p) for p in points]
    kept = simplified(line, most)
    assert kept[0] == line[0]
    assert kept[-1] == line[-1]
    segments = list(itertools.pairwise(kept))
    for p in line:
        assert min(_from(p, a, b) for a, b in segments) <= most + 1e-5


def test_a_coupler_curve_has_all_positions_of_its_point():
    stage = posed_linkage(WITH_POINT)
    (curve,) = coupler_curve_lines(stage, "K")
    (line,) = curve.parts
    assert curve.closed
    course = drive_cycle(WITH_POINT)
    for z in course.at(np.linspace(0, 6, 50), 0).complex_point("K"):
        at = stage.local(complex(z))
        closed = [*line, line[0]]
        assert min(_from(at, p, q) for p, q in itertools.pairwise(closed)) < 0.2


def test_a_straight_curve_goes_there_and_back():
    stage = posed_linkage(entry("scottrussell").linkage())
    (curve,) = coupler_curve_lines(stage, "C")
    reach = 2 * 50.0 * stage.scale  # C moves on a straight line, twice the crank to both sides
    ys = [p.y for p in curve.parts[0]]
    assert max(ys) - min(ys) == pytest.approx(2 * reach, rel=1e-2)
    assert max(abs(p.x) for p in curve.parts[0]) < 0.1


def test_watts_curve_is_a_figure_of_eight_symmetric_to_its_middle():
    linkage = entry("watt_axle").linkage()
    stage = posed_linkage(linkage, between=(math.radians(-55), math.radians(29)))
    rest, used = coupler_curve_lines(stage, "F")
    assert (rest.style, used.style) == ("curve-rest", "curve")
    assert rest.closed
    xs, ys = zip(*rest.parts[0], strict=True)
    assert min(xs) == pytest.approx(-max(xs), rel=1e-3)
    assert min(ys) == pytest.approx(-max(ys), rel=1e-3)
    assert max(abs(p.x) for p in used.parts[0]) < max(xs)


@settings(max_examples=20, deadline=None)
@given(st.floats(0, 6.28))
def test_the_transmission_angle_is_that_of_the_kinematics(phi):
    (text,) = [w for w in words(draw_linkage(WITH_POINT, at=phi, show=["transmission"])) if w.startswith("μ")]
    mu = math.degrees(transmission_angle(move(WITH_POINT, [phi], order=2))[0])
    assert float(text[4:-1]) == pytest.approx(mu, abs=0.0501)


@pytest.mark.parametrize("linkage", [SliderCrank(25, 70, 5).linkage(), InvertedSliderCrank(25, 60, 4).linkage()])
def test_the_transmission_angle_with_slides(linkage):
    (text,) = [w for w in words(draw_linkage(linkage, at=1.1, show=["transmission"])) if w.startswith("μ")]
    mu = math.degrees(transmission_angle(move(linkage, [1.1], order=2))[0])
    assert float(text[4:-1]) == pytest.approx(mu, abs=0.0501)


def test_dead_centres_are_two_stretched_positions():
    ghosts = styles(draw_linkage(CRANK_ROCKER.linkage(), at=1.0, show=["dead-centres"]), "ghost")
    assert len(ghosts) == 2
    lengths = []
    for ghost in ghosts:
        crank, coupler, rocker = sorted(ghost.parts, key=lambda part: math.dist(*part))[:3]
        assert abs(_sine(crank, rocker)) < 1e-6  # crank and coupler on one line; the longest is the coupler
        lengths.append([math.dist(*part) for part in (crank, coupler)])
    assert np.allclose([a / c for a, c in lengths], 25 / 40)


def _sine(one, other):
    u, v = one[1].minus(one[0]).unit, other[1].minus(other[0]).unit
    return u.across.dot(v)


def test_velocities_are_across_the_crank():
    figure = draw_linkage(CRANK_ROCKER.linkage(), at=1.0, show=["velocities", "scale"])
    arrows = [s.parts[0] for s in styles(figure, "velocity") if len(s.parts) == 1]
    crank = Point(math.cos(1.0), -math.sin(1.0))
    assert min(abs(b.minus(a).unit.dot(crank)) for a, b in arrows) < 1e-9
    assert [w for w in words(figure) if "mm" in w] == ["20 mm/rad", "20 mm"]


# --- the picture as a whole ----------------------------------------------------------------------


@pytest.mark.parametrize(
    "name", ["vcomp", "wiper", "watt_axle", "filmclaw_slot", "scissor2_cyl", "hubpodium", "kurbelschleife", "loader"]
)
def test_machines_are_drawn_within_their_boxes(name):
    record = entry(name)
    linkage = record.linkage()
    figure = draw_linkage(linkage, labels=True, curves=list(linkage.points), lang="de", name=record.name.de)
    tree = ElementTree.fromstring(figure.svg())
    assert tree[0].text == record.name.de
    assert "Maßstäblich" in tree[1].text
    points = [p for s in figure.shapes if isinstance(s, Polylines) for part in s.parts for p in part]
    assert all(0 < p.x < figure.width and 0 < p.y < figure.height for p in points)
    assert (
        figure.svg()
        == draw_linkage(linkage, labels=True, curves=list(linkage.points), lang="de", name=record.name.de).svg()
    )


def test_small():
    assert len(draw_linkage(WITH_POINT, at=1.0, curves=["K"], labels=True).svg()) < 5000


def test_names_stay_text():
    linkage = CRANK_ROCKER.linkage({"<script>": (35, 20)})
    text = draw_linkage(linkage, at=1.0, curves=["<script>"]).svg()
    assert "<script" not in text
    assert "&lt;script&gt;" in text


def test_several_drives_have_a_pose_but_no_course():
    assert len(styles(draw_linkage(FIVE_BAR, labels=True), "drive")) == 2
    assert draw_linkage(FIVE_BAR, at=[2.0, 1.2]).svg() != draw_linkage(FIVE_BAR).svg()
    for options in ({"curves": ["R(2-3)"]}, *({"show": [name]} for name in LAYERS if name != "scale")):
        with pytest.raises(LinkageError, match="one drive"):
            draw_linkage(FIVE_BAR, **options)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"at": float("nan")}, "finite drive value"),
        ({"at": "north"}, "at: expected a number"),
        ({"at": [1.0, 2.0]}, "one finite drive value"),
        ({"at": 3.0}, "no pose at 171.887 degrees"),
        ({"curves": ["Z"]}, "no point 'Z'"),
        ({"show": ["shadow"]}, "there are dead-centres"),
        ({"output": "nothing"}, "an output is a link"),
        ({"between": (2.9, 3.1)}, "nothing of it"),
        ({"branch": "x"}, "branch"),
    ],
)
def test_refusals(options, words):
    linkage = FourBar(60, 30, 40, 50).linkage()
    with pytest.raises(LinkageError, match=words):
        draw_linkage(linkage, show=options.pop("show", ["dead-centres"]), **options)


def test_no_linkage():
    with pytest.raises(LinkageError, match="expected a linkage"):
        draw_linkage("four-bar")


def test_no_drive():
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3)")
    places = {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (6, 4), "R(0-3)": (6, 0)}
    drawn = Linkage.from_drawing(mechanism, places)
    figure = draw_linkage(drawn, show=["dimensions"])
    assert "in the reference pose; nothing is driven" in figure.description
    assert sorted(word for word in words(figure)) == ["2", "4", "6", "6.325"]
    assert not styles(figure, "drive")
    with pytest.raises(LinkageError, match="no joint is driven"):
        draw_linkage(drawn.with_reference_pose(None))
    with pytest.raises(LinkageError, match="one drive only"):
        draw_linkage(drawn, show=["velocities"])


@pytest.mark.parametrize("lengths", [(1, 1, 1, 3), (1, 1, 1, 100), (1, 100, 1, 100)])
def test_what_cannot_move_shows_itself(lengths):
    linkage = FourBar(*lengths).linkage()
    assert linkage._repr_svg_().startswith("<svg")
    if lengths == (1, 1, 1, 100):
        assert "assembl" in linkage._repr_svg_()


def test_the_pose_of_a_range_is_not_its_singular_middle():
    stage = posed_linkage(SliderCrank(30, 20).linkage())
    pins = [complex(stage.pose.complex_point(name)[0]) for name in ("R(frame-crank)", "R(crank-coupler)")]
    assert abs((pins[1] - pins[0]).imag) > 3.0


def test_an_unknown_link_is_not_taken_for_another():
    for key in ("centrodes", "inflection"):
        with pytest.raises(LinkageError, match="'copler' is none of"):
            draw_linkage(WITH_POINT, show=[key], output="copler")


def test_what_is_said_of_poles_is_seen():
    figure = draw_linkage(entry("mzc").linkage(), show=["inflection"])
    for letter, name in (("P", "pole P"), ("W", "inflection pole W")):
        assert (letter in words(figure)) == (name in figure.description)


def test_poses_are_taken_modulo_a_turn():
    linkage = FourBar(60, 30, 40, 50).linkage()
    assert draw_linkage(linkage, at=0.2).svg() == draw_linkage(linkage, at=0.2 + 2 * math.pi).svg()
    point = posed_linkage(linkage, 0.2).place(LinkPoint("crank", 60.0, 0.0))
    assert math.atan2(-point.y, point.x) == pytest.approx(0.2)


# --- the command ---------------------------------------------------------------------------------


def test_lengths_are_drawn_to_scale(capsys):
    text = drawn(capsys, "four-bar:25,70,40,70", at="55", show=["transmission"])
    assert "Drive at 55°" in text
    assert "μ = " in text
    assert drawn(capsys, "four-bar:25,70,40,70") != text
    assert "Drive at -" in drawn(capsys, "four-bar:60,30,40,50", branch="-")
    assert "To scale" not in drawn(capsys, "four-bar:25,70,40,70", graph=True)


def test_what_is_not_there_is_said(capsys):
    assert draw.run(arguments_of("draw", "wiper", show=["dead-centres", "scale"])) == 0
    text, said = capsys.readouterr()  # the blade moves without turning
    assert "Shown: scale. Missing, or outside the picture: dead centres." in text
    assert said == "Missing, or outside the picture: dead centres.\n"
    assert "Shown: dead centres." in drawn(capsys, "wiper", show=["dead-centres"], output="rocker1")


def test_entries_are_drawn_to_scale(capsys):
    assert "To scale" in drawn(capsys, "watt_axle")
    assert "To scale" not in drawn(capsys, "watt_axle", structure=True)
    assert "To scale" not in drawn(capsys, "susp_5link")  # screws alone are no sizes of a picture
    text = drawn(capsys, "watt_axle", curve=["F"], lang="de", labels=True)
    assert "Bahnkurve von F" in text
    assert "Karosserie (Gestell)" in text
    assert "To scale" in drawn(capsys, "vcomp", at="")


def test_a_file_is_drawn_to_scale(capsys, tmp_path):
    from gruebler.files.linkages import write_linkage

    write_linkage(tmp_path / "x.json", WITH_POINT)
    assert re.search("Drive at 30°", drawn(capsys, str(tmp_path / "x.json"), at="30", curve=["K"]))


@pytest.mark.parametrize(
    ("chain", "options", "words"),
    [
        ("four-bar:25,70,40,70", {"at": "55,60"}, "expected one finite number"),
        ("four-bar:25,70,40,70", {"at": "north"}, "expected one finite number"),
        ("four-bar:25,70,40,70", {"at": "inf"}, "expected one finite number"),
        ("four-bar:25,70,40", {}, "a,b,c,d"),
        ("four-baar:25,70,40,70", {}, "did you mean 'four-bar'"),
        ("four-bar:25,70,40,70", {"frame": "crank"}, "leave out --frame"),
        ("vcomp", {"at": "3", "graph": True}, "--at needs a drawing to scale"),
        (
            "vcomp",
            {"loads": True, "structure": True},
            "--loads needs a drawing to scale and does not go with --structure",
        ),
        ("R(0-1) R(1-2) R(2-0)", {"at": "3"}, "no dimensions"),
        ("nowhere/x.toml", {}, "cannot be read"),
        ("mzc", {"at": "", "output": "nix"}, "--output needs --show dead-centres"),
        ("mzc", {"at": "", "output": "nix", "show": ["centrodes"]}, "'nix' is none of"),
        ("mzc", {"ghosts": 0}, "1 to 60"),
        ("vcomp", {"labels": True, "graph": True}, "--labels does not go with --graph"),
        ("vcomp", {"dark": True}, "--dark does not go with SVG"),
    ],
)
def test_wrong_commands(chain, options, words):
    with pytest.raises(GrueblerError, match=words):
        draw.run(arguments_of("draw", chain, **options))
