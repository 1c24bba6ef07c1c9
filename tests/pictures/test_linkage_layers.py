"""Layers of linkage pictures: dimensions, arrows, centrodes, inflection circle, thin positions; pictures of motions."""

from __future__ import annotations

import cmath
import functools
import json
import math
import re
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis import drive_cycle
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.geometry import centrodes, inflection_circle
from gruebler.mechanics.kinematics import circuit, from_degrees, move
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.free_space import from_segment
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, TextShape
from gruebler.pictures.linkage.curve_plots import coupler_plot, hodograph
from gruebler.pictures.linkage.motion_picture import draw_motion
from gruebler.pictures.linkage.motion_plots import transfer_plot, transmission_plot
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_along_motion, posed_linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry

GOLDEN = Path(__file__).parent / "golden_linkages.json"
SVG = "{http://www.w3.org/2000/svg}"
CRANK_ROCKER = FourBar(25, 70, 40, 70)
WITH_POINT = CRANK_ROCKER.linkage({"K": (35, 20)})
CARDAN = SliderCrank(25, 25).linkage()


def words(figure):
    return [shape.text for shape in figure.shapes if isinstance(shape, TextShape)]


def leftmost_joint(figure):
    joints = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape) and shape.style == "joint"]
    return min(joints, key=lambda at: at.x)


def styled(figure, style):
    return [shape for shape in figure.shapes if shape.style == style]


def points(figure, style):
    return np.array([complex(p.x, p.y) for shape in styled(figure, style) for part in shape.parts for p in part])


# --- dimension lines -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("linkage", "lengths"),
    [
        (CRANK_ROCKER.linkage(), ["25", "40", "70", "70"]),
        (WITH_POINT, ["25", "40", "40.31", "40.31", "70", "70"]),
        (SliderCrank(25, 70, 12).linkage(), ["12", "25", "70"]),
        (SliderCrank(25, 70).linkage(), ["25", "70"]),
        (InvertedSliderCrank(25, 60, 8).linkage(), ["25", "60", "8"]),
    ],
)
def test_every_length_is_told_once(linkage, lengths):
    figure = draw_linkage(linkage, at=1.0, show=["dimensions"])
    assert sorted(word for word in words(figure) if word[0].isdigit()) == lengths
    assert "Shown: dimensions." in figure.description
    assert len(styled(figure, "dimension-head")) == 2 * len(lengths)


def test_a_unit_other_than_millimetres_is_written():
    figure = draw_linkage(CRANK_ROCKER.linkage(unit="cm"), at=1.0, show=["dimensions"])
    assert sorted(word for word in words(figure) if word[0].isdigit()) == ["25 cm", "40 cm", "70 cm", "70 cm"]


def test_an_offset_is_measured_from_the_axis_of_the_slide():
    """A chain line at the height of the offset, which goes on beyond the foot of the dimension."""
    linkage = SliderCrank(25, 70, 12).linkage()
    figure = draw_linkage(linkage, at=1.0, show=["dimensions"])
    (axis,), scale = styled(figure, "pitch"), posed_linkage(linkage, 1.0).scale
    ((first, last),) = axis.parts
    pivot = leftmost_joint(figure)
    assert first.y == last.y == pytest.approx(pivot.y - 12 * scale)
    assert min(first.x, last.x) < pivot.x < max(first.x, last.x)
    assert not styled(draw_linkage(SliderCrank(25, 70), at=1.0, show=["dimensions"]), "pitch")


def test_the_joints_of_dead_centres_have_letters():
    """Where crank and coupler are in line, from the law of cosines by hand: A at the angle of A_0 B, from A_0."""
    linkage = CRANK_ROCKER.linkage()
    figure = draw_linkage(linkage, at=1.0, show=["dead-centres"], lang="de")
    pivot, scale = leftmost_joint(figure), posed_linkage(linkage, 1.0).scale
    texts = {shape.text: shape.at for shape in figure.shapes if isinstance(shape, TextShape)}
    a, b, c, d = 25, 70, 40, 70
    for letter, reach, crank in (("a", b + a, a), ("i", b - a, -a)):
        along = cmath.rect(1.0, math.acos((reach**2 + d**2 - c**2) / (2 * reach * d)))
        for name, place in (("A", crank * along), ("B", reach * along)):
            joint = pivot.plus(Point(place.real, -place.imag), scale)
            assert texts[f"{name}_{letter}"].minus(joint).length < 40


@pytest.mark.parametrize("lang", ["en", "de"])
def test_centrodes_are_named_below_the_picture(lang):
    figure = draw_linkage(CRANK_ROCKER, at=1.0, show=["centrodes"], lang=lang)
    named = ["p  fixed centrode", "q  moving centrode"] if lang == "en" else ["p  Rastpolbahn", "q  Gangpolbahn"]
    assert [word for word in words(figure) if word in named] == named


@settings(max_examples=10)
@given(st.floats(0.3, 0.9), st.floats(2.0, 4.0), st.floats(0, 6.28))
def test_heads_are_as_far_apart_as_what_they_measure(a, b, phi):
    linkage = FourBar(a, b, 2.0, b).linkage()
    stage = posed_linkage(linkage, phi)
    figure = draw_linkage(linkage, at=phi, show=["dimensions"])
    tips = [head.parts[0][0] for head in styled(figure, "dimension-head")]
    found = sorted(one.minus(other).length for one, other in zip(tips[::2], tips[1::2], strict=True))
    assert np.allclose(found, sorted(stage.scale * one for one in (a, b, 2.0, b)), atol=1e-6)


@pytest.mark.parametrize("name", ["wiper", "loco2", "filmclaw", "lambda", "evans", "scottrussell", "slidercrank"])
def test_dimension_lines_are_clear_of_other_joints(name):
    linkage = entry(name).linkage()
    figure = draw_linkage(linkage, show=["dimensions"])
    joints = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape) and shape.style == "joint"]
    for shape in styled(figure, "dimension"):
        for a, b in shape.parts[2:]:  # after the two extension lines
            assert min(_from(at, a, b) for at in joints) > 6.0


def _from(at, a, b):
    ab, ap = b.minus(a), at.minus(a)
    t = min(1.0, max(0.0, ap.dot(ab) / max(ab.dot(ab), 1e-12)))
    return at.minus(a.plus(ab, t)).length


# --- arrows ----------------------------------------------------------------------------------------


@settings(max_examples=20)
@given(st.floats(0, 6.28))
def test_the_crank_pin_is_accelerated_towards_its_pivot(phi):
    figure = draw_linkage(CRANK_ROCKER.linkage(), at=phi, show=["accelerations", "velocities"])
    crank = Point(math.cos(phi), -math.sin(phi))
    arrows = [s.parts[0] for s in styled(figure, "acceleration") if len(s.parts) == 1]
    assert min(b.minus(a).unit.plus(crank).length for a, b in arrows) < 1e-6
    assert {word.split()[1] for word in words(figure) if "/" in word} == {"mm/rad", "mm/rad²"}
    assert {word for word in words(figure) if "/" not in word} <= {"v_A", "v_B", "a_A", "a_B"}


def test_the_scale_of_accelerations():
    figure = draw_linkage(SliderCrank(25, 70, 5).linkage(), at=0.7, show=["accelerations"])
    motion = move(SliderCrank(25, 70, 5).linkage(), [0.7], speed=1.0, order=2)
    names = ["R(crank-coupler)", "R(coupler-slider)"]
    wanted = sorted(float(np.hypot(*motion.point(name, order=2)[0])) for name in names)
    (bar,) = [s for s in styled(figure, "acceleration") if len(s.parts) == 3]
    unit = bar.parts[0][1].minus(bar.parts[0][0]).length / float(
        next(word for word in words(figure) if "/" in word).split()[0]
    )
    found = sorted(
        s.parts[0][1].minus(s.parts[0][0]).length + 7.0 for s in styled(figure, "acceleration") if len(s.parts) == 1
    )
    assert np.allclose(np.array(found) / unit, wanted, rtol=1e-6)


# --- centrodes and the inflection circle -----------------------------------------------------------


def test_cardan_circles():
    figure = draw_linkage(CARDAN, at=1.0, show=["centrodes", "inflection"])
    scale = posed_linkage(CARDAN, 1.0).scale
    middle = complex(*next(shape.at for shape in figure.shapes if shape.style == "joint"))
    assert np.allclose(abs(points(figure, "centrode-fixed") - middle), 50 * scale, atol=0.2)
    crank_end = middle + 25 * scale * np.exp(-1j)
    for style in ("centrode-moving", "inflection"):
        assert np.allclose(abs(points(figure, style) - crank_end), 25 * scale, atol=0.2)
    assert {"p", "q", "P", "W"} <= set(words(figure))


@settings(max_examples=10)
@given(st.floats(0, 6.28))
def test_centrodes_are_those_of_the_geometry(phi):
    figure = draw_linkage(WITH_POINT, at=phi, show=["centrodes"])
    stage = posed_linkage(WITH_POINT, phi)
    motion = drive_cycle(WITH_POINT).at(np.linspace(0, 2 * np.pi, 20000), 1)
    fixed = centrodes(motion, "coupler").fixed
    joint = next(shape.at for shape in figure.shapes if shape.style == "joint")
    shift = complex(*joint) - complex(*stage.local(complex(stage.pose.complex_point("R(frame-crank)")[0])))
    wanted = np.conj(stage.scale * fixed) + shift
    for p in points(figure, "centrode-fixed")[::7]:
        assert np.nanmin(abs(wanted - p)) < 1.0


def test_the_inflection_circle_is_that_of_the_geometry_and_passes_through_the_slider():
    linkage = SliderCrank(25, 60).linkage()
    figure = draw_linkage(linkage, at=2.5, show=["inflection"])
    stage = posed_linkage(linkage, 2.5)
    circle = inflection_circle(move(linkage, [2.5], speed=1.0, order=2), "coupler")
    at = next(shape.at for shape in figure.shapes if shape.style == "joint")
    middle = complex(*at) + np.conj(stage.scale * (circle.pole[0] + circle.inflection_pole[0]) / 2)
    assert np.allclose(abs(points(figure, "inflection") - middle), stage.scale * circle.diameter[0] / 2, rtol=1e-3)
    pins = [complex(*shape.at) for shape in figure.shapes if shape.style == "joint"]
    assert min(abs(abs(pin - middle) - stage.scale * circle.diameter[0] / 2) for pin in pins) < 0.01


def test_links_without_centrodes():
    figure = draw_linkage(WITH_POINT, at=1.0, show=["centrodes", "inflection"], output="rocker")
    assert "Missing, or outside the picture: fixed centrode" in figure.description
    text = draw_linkage(entry("loco2").linkage(), at=1.0, show=["centrodes", "inflection"], lang="de").description
    assert "Nicht vorhanden oder außerhalb des Bildes: Rastpolbahn" in text


def test_an_unknown_layer_is_told_with_the_nearest():
    with pytest.raises(LinkageError, match="did you mean 'dimensions'"):
        draw_linkage(WITH_POINT, show=["dimension"])


# --- positions -------------------------------------------------------------------------------------


def test_thin_positions_are_evenly_spread():
    figure = draw_linkage(CRANK_ROCKER.linkage(), at=1.0, ghost=8)
    ghosts = styled(figure, "ghost")
    assert len(ghosts) == 8
    pivot = next(shape.at for shape in figure.shapes if shape.style == "joint")
    cranks = [next(part for part in ghost.parts if min(p.minus(pivot).length for p in part) < 1e-6) for ghost in ghosts]
    turns = sorted(
        math.atan2(*reversed(max(part, key=lambda p: p.minus(pivot).length).minus(pivot))) for part in cranks
    )
    # with the pose itself, which no body hides, they divide the turn evenly; y points down in pictures
    assert np.allclose(np.diff(sorted([*turns, -1.0])), math.tau / 9)
    assert "8 positions thinly" in figure.description


@pytest.mark.parametrize("pose", [0.5, -0.9, -0.9 + 1.4 / 4, 0.1])
def test_no_thin_position_is_that_of_the_bodies(pose):
    """Also where the pose lies at the end of a range, or at a place where one would be."""
    from gruebler.pictures.linkage.layers import ghost, ghosts

    posed = posed_linkage(entry("watt_axle").linkage(), pose, between=(-0.9, 0.5))

    def corners(shapes):
        return [
            np.array([(p.x, p.y) for part in s.parts for p in part])
            for s in shapes
            if isinstance(s, Polylines) and s.style == "ghost"
        ]

    (shown,) = corners(ghost(posed, posed.driven().at([pose], 0), 0))
    thin = corners(ghosts(posed, 4))
    assert len(thin) == 4
    assert min(np.abs(one - shown).max() for one in thin) > 5  # pixels


@pytest.mark.parametrize("count", [-1, 61])
def test_so_many_positions_are_not_drawn(count):
    with pytest.raises(LinkageError, match="1 to 60"):
        draw_linkage(WITH_POINT, ghost=count)


def test_a_motion_has_a_picture():
    motion = move(WITH_POINT, from_degrees(0, 90, 5))
    figure = draw_motion(motion)
    assert figure.description.endswith("A motion of 19 poses; 5 of them in thin lines.")
    path = np.conj(posed_along_motion(motion).scale * motion.complex_point("K"))
    found = points(figure, "curve")
    assert abs(found[-1] - found[0]) == pytest.approx(abs(path[-1] - path[0]))
    assert len(draw_motion(move(WITH_POINT, [0.3])).svg()) < len(figure.svg())


def test_a_motion_that_ends_says_so_and_one_without_poses_shows_its_structure():
    rocker = FourBar(60, 30, 40, 50).linkage()
    assert "Die Bewegung endet" in draw_motion(move(rocker, from_degrees(0, 120, 5)), lang="de").description
    nothing = draw_motion(move(rocker, from_degrees(100, 120, 5)))
    assert "At the start" in nothing.description
    assert styled(nothing, "hatch-bar")


def test_a_motion_shows_itself_in_notebooks():
    motion = move(WITH_POINT, from_degrees(0, 90, 5))
    assert motion._repr_svg_() == draw_motion(motion).svg()


# --- golden pictures, by structure -----------------------------------------------------------------


def structure(figure):
    """What the elements are and all words; not where anything is."""
    root = ET.fromstring(figure.svg())
    shapes = Counter(f"{e.tag.removeprefix(SVG)} {e.get('class')}" for e in root if e.get("class"))
    return {
        "shapes": dict(sorted(shapes.items())),
        "words": sorted("".join(e.itertext()) for e in root.iter() if e.tag == SVG + "text"),
        "title": root.findtext(SVG + "title"),
        "description": root.findtext(SVG + "desc"),
    }


@functools.cache
def golden_pictures():
    return tuple(_golden_pictures())


def _golden_pictures():
    yield "dimensions", draw_linkage(WITH_POINT, at=1.0, show=["dimensions", "scale"])
    yield "arrows", draw_linkage(WITH_POINT, at=1.0, show=["velocities", "accelerations", "poles"], lang="de")
    yield "centrodes", draw_linkage(CARDAN, at=1.0, show=["centrodes", "inflection"])
    yield "ghosts", draw_linkage(entry("watt_axle").linkage(), between=(-0.9, 0.5), curves=["F"], ghost=4)
    yield "transfer", transfer_plot(SliderCrank(25, 70, 5).linkage())
    yield "transmission", transmission_plot(CRANK_ROCKER.linkage(), lang="de")
    yield "hodograph", hodograph(WITH_POINT, ["K"], speed=2.0)
    yield "conchoid", coupler_plot(entry("conchoid").linkage(), ["C"])
    for name in ("wiper", "loco2", "scissor2", "filmclaw_slot"):
        yield name, draw_linkage(entry(name).linkage(), show=["dimensions"], labels=True)


def test_golden_pictures():
    assert {name: structure(figure) for name, figure in golden_pictures()} == json.loads(GOLDEN.read_text("utf-8"))


def test_pictures_are_small_and_lie_on_their_page():
    for name, figure in golden_pictures():
        text = figure.svg()
        numbers = [float(x) for x in re.findall(r"[ML](-?\d+\.?\d*) (-?\d+\.?\d*)", text) for x in x]
        assert min(numbers) >= 0, name
        assert max(numbers) <= max(figure.width, figure.height) + 0.1, name
        assert len(text) < 13_000, name


def test_a_bearing_that_a_body_would_hide_stands_before_it():
    """A frame pin below the plate of a coupler: its pedestal is drawn after the plate, the others before all bodies."""
    from gruebler.pictures.linkage.bodies import BODIES, FRAME, body_parts

    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3) R(2-4) R(4-5) R(0-5); frame=0; drive=R(0-1)")
    places = {0: (0, 0), 1: (2, 1), 2: (9, 6), 3: (12, 0), 4: (10, -6), 5: (12, -9), 6: (7, 0)}
    found = body_parts(posed_linkage(Linkage.from_drawing(mechanism, places)))
    layers = [part.layer for part in found if part.link == "0" and part.layer in (FRAME, BODIES)]
    assert layers == [FRAME, BODIES]


if __name__ == "__main__":  # writes the golden file anew
    GOLDEN.write_text(
        json.dumps({name: structure(figure) for name, figure in golden_pictures()}, indent=1, ensure_ascii=False)
        + "\n",
        "utf-8",
    )


def test_of_a_large_inflection_circle_the_arc_next_to_the_linkage_is_drawn_with_its_radius():
    figure = draw_linkage(CRANK_ROCKER.linkage(), at=np.radians(60), show=["inflection"])
    motion = move(CRANK_ROCKER.linkage(), [np.radians(60)], speed=1.0, order=2)
    radius = inflection_circle(motion, "coupler").diameter[0] / 2
    (text,) = [shape.text for shape in figure.shapes if isinstance(shape, TextShape) and "r = " in shape.text]
    assert float(text.split("r = ")[1].split()[0]) == pytest.approx(radius, rel=5e-3)
    joints = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape)]
    reach = max(np.ptp([p.x for p in joints]), np.ptp([p.y for p in joints]))
    ends = points(figure, "inflection")[[0, -1]]
    assert 0.5 * reach < abs(ends[1] - ends[0]) < 1.5 * reach


def test_the_inflection_circle_is_whole_with_tangent_and_normal():
    figure = draw_linkage(CRANK_ROCKER.linkage(), at=np.radians(200), show=["inflection"])
    motion = move(CRANK_ROCKER.linkage(), np.radians([200]), speed=1.0, order=2)
    circle = inflection_circle(motion, "coupler")
    texts = {shape.text for shape in figure.shapes if isinstance(shape, TextShape)}
    assert {"P", "W", "t", "n"} <= texts
    drawn = points(figure, "inflection")
    assert np.ptp(drawn.real) == pytest.approx(np.ptp(drawn.imag), rel=1e-3)  # closed, not clipped
    tangent, normal = [s.parts[0] for s in figure.shapes if isinstance(s, Polylines) and s.style == "dead"]
    way = complex(tangent[-1].x - tangent[0].x, tangent[0].y - tangent[-1].y)
    assert abs((way / abs(way) * np.conj(circle.tangent[0])).imag) < 1e-3
    way = complex(normal[-1].x - normal[0].x, normal[0].y - normal[-1].y)
    assert abs((way / abs(way) * np.conj(circle.tangent[0])).real) < 1e-3


def test_a_curve_is_smooth_where_the_linkage_snaps_over():
    """Near a change point a point runs over a third of its curve within half a degree of the crank."""
    linkage = FourBar(0.999, 3, 3, 1).linkage({"K": (1.5, 2)})
    (curve,) = (s for s in draw_linkage(linkage, at=0.3, curves=["K"]).shapes if getattr(s, "style", "") == "curve")
    drawn = np.array([complex(*p) for p in curve.parts[0]])
    course = circuit(linkage, step=1e-3).samples.complex_point("K")
    scale = np.ptp(drawn.real) / np.ptp(course.real)
    z = np.conj(course) * scale
    z += complex(drawn.real.min() - z.real.min(), drawn.imag.min() - z.imag.min())
    closed = np.append(drawn, drawn[0])
    gaps = from_segment(z[:, None], closed[None, :-1], closed[None, 1:]).min(axis=1)
    assert gaps.max() < 0.5  # pixels
