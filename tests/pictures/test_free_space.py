"""Names, numbers and dimension lines: outside of the figure, off foreign bodies, off each other; sizes as they are."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import chains
from gruebler.base.convex_hull import convex_hull
from gruebler.base.errors import LinkageError
from gruebler.cli.draw import linkage_and_range
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.axes import as_text
from gruebler.pictures.canvas.figure import Figure, svg
from gruebler.pictures.canvas.free_space import Obstacles, complexes, distance_between, from_segment, is_inside
from gruebler.pictures.canvas.shapes import Point, TextShape, bounds, split_subscripts
from gruebler.pictures.linkage.animation import animated_svg
from gruebler.pictures.linkage.bodies import body_parts
from gruebler.pictures.linkage.curve_plots import hodograph
from gruebler.pictures.linkage.motion_plots import transfer_plot
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.pictures.structure import draw_structure, place_joints
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, entry

PLACES = st.complex_numbers(max_magnitude=100, allow_nan=False, allow_infinity=False)
NUMBERED = ("excavator", "pumpjack", "e3_watt")


def texts(figure, style="name"):
    return [shape for shape in figure.shapes if isinstance(shape, TextShape) and shape.style == style]


def overlapping(found):
    """Pairs of texts that touch."""
    for one, other in combinations(found, 2):
        room = Obstacles([one])
        wide = Obstacles([other]).texts
        if room.texts.gaps(wide.a, wide.b)[0, 0] - 7.0 < 0:
            yield one.text, other.text


# --- the geometry ----------------------------------------------------------------------------------


@settings(max_examples=60)
@given(PLACES, PLACES, PLACES, PLACES)
def test_the_distance_of_segments_is_the_least_between_their_points(a, b, c, d):
    part = np.linspace(0, 1, 301)
    slow = np.abs((a + part * (b - a))[:, None] - (c + part * (d - c))[None, :]).min()
    fast = float(distance_between(*(np.array([z]) for z in (a, b, c, d)))[0])
    assert fast <= slow + 1e-9
    assert slow - fast <= (abs(b - a) + abs(d - c)) / 300 + 1e-9


@settings(max_examples=60)
@given(PLACES, st.integers(3, 9), st.floats(1, 50))
def test_a_place_is_inside_a_regular_polygon_where_all_its_sides_say_so(z, corners, radius):
    rim = radius * np.exp(2j * np.pi * np.arange(corners) / corners)
    sides = [((np.roll(rim, -1)[k] - rim[k]).conjugate() * (z - rim[k])).imag for k in range(corners)]
    if min(abs(side) for side in sides) > 1e-6:
        assert bool(is_inside(np.array([z]), rim)[0]) == (min(sides) > 0)
    assert from_segment(np.array([z]), rim[:1], rim[:1])[0] == pytest.approx(abs(z - rim[0]))


# --- names -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("links", [6, 8])
def test_what_has_a_side_at_the_rim_is_named_outside(links):
    for chain in chains(links):
        figure, placed = draw_structure(chain, labels=True), place_joints(chain)
        rim = np.array(convex_hull(complexes(placed.joints), 1e-6))
        circles = [shape.at for shape in figure.shapes if shape.style == "joint"]
        shift = min(circles).minus(min(placed.joints))
        outer = {link for link in chain.links if chain.degrees[link] > 1 and _sides(placed.outlines[link], rim)}
        for text in texts(figure):
            at = complex(*text.at.minus(shift))
            assert not (text.text in outer and is_inside(np.array([at]), rim)[0]), (text.text, chain.text())


def _sides(outline, rim):
    """Whether an edge of an outline lies on the convex hull."""
    a = complexes(outline)
    middles = (a + np.roll(a, -1)) / 2
    return bool((from_segment(middles[:, None], rim[None, :], np.roll(rim, -1)[None, :]).min(axis=1) < 1e-3).any())


@pytest.mark.parametrize("name", NUMBERED)
def test_numbers_are_on_no_body_and_off_each_other(name):
    linkage, between = linkage_and_range(name)
    figure = draw_linkage(linkage, between=between, labels=True)
    numbers = [text for text in texts(figure) if text.anchor == "middle"]
    bare = Obstacles([shape for shape in figure.shapes if not isinstance(shape, TextShape)])
    assert not bare.covered(complexes([text.at for text in numbers])).any()
    assert not list(overlapping(texts(figure)))


def test_no_two_texts_of_any_structure_picture_touch():
    for record in entries().values():
        chain = record.chain()
        figure = draw_structure(Mechanism(chain, record.frame or chain.links[0], record.drives), labels=True)
        assert not list(overlapping(texts(figure))), record.id


def test_short_names_are_not_listed_as_themselves():
    record = entry("quad_double")
    words = [text.text for text in texts(draw_structure(Mechanism(record.chain(), "1"), labels=True))]
    assert [word for word in words if "  " in word] == ["5  diagonal"]


# --- dimensions ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["excavator", "e3_watt", "scissor2", "hubpodium", "wiper"])
def test_dimensions_and_names_do_not_touch(name):
    linkage, between = linkage_and_range(name)
    figure = draw_linkage(linkage, between=between, labels=True, show=["dimensions"])
    found = texts(figure, "value") + texts(figure)
    assert len(list(overlapping(found))) <= (1 if name == "excavator" else 0)


def test_pins_within_a_body_and_cylinders_have_dimensions():
    boom = [text.text for text in texts(draw_linkage(entry("excavator").linkage(), show=["dimensions"]), "value")]
    assert len(boom) > 16
    linkage, between = linkage_and_range("crane_cyl")
    figure = draw_linkage(linkage, at=40.0, between=between, show=["dimensions"])
    assert "40" in [text.text for text in texts(figure, "value")]
    corners = {"R(0-1)": (0, 0), "R(1-2)": (3, 4), "R(2-3)": (9, 4), "R(0-3)": (9, 0)}
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
    triangle = Linkage.from_drawing(mechanism, corners).with_points({"A": ("2", 3.0, 6.0), "B": ("2", 3.0, 1.0)})
    values = [text.text for text in texts(draw_linkage(triangle, show=["dimensions"]), "value")]
    assert {"3.162"} <= set(values)  # from B, within 0, 6 and A, to the nearest corner


@pytest.mark.parametrize(("factor", "word"), [(1e-8, "2.5×10⁻⁷"), (1e6, "2.5×10⁷"), (0.1, "2.5")])
def test_sizes_are_written_with_powers_of_ten(factor, word):
    figure = draw_linkage(FourBar(25, 70, 40, 70).linkage().scaled(factor), at=1.0, show=["dimensions", "scale"])
    values = [text.text for text in texts(figure, "value")]
    assert word in values
    assert not [value for value in values if "e-" in value or "e+" in value]


def test_german_sizes_have_commas():
    assert as_text(1.25, "cm", "de") == "1,25 cm"
    figure = draw_linkage(FourBar(2.5, 7, 4, 7).linkage(), at=1.0, show=["dimensions", "transmission"], lang="de")
    assert not [text.text for text in texts(figure, "value") if "." in text.text]


# --- what is drawn besides -------------------------------------------------------------------------


def test_bars_and_lists_begin_at_one_edge_close_below():
    linkage = entry("kurbelschleife").linkage()
    figure = draw_linkage(linkage, show=["velocities", "scale"], labels=True)
    bars = [shape for shape in figure.shapes if shape.style in ("velocity", "measure") and len(shape.parts) == 3]
    lefts = {round(bar.parts[0][0].x, 6) for bar in bars}
    assert len(bars) == 2
    assert lefts == {16.0}
    corner, size = bounds([shape for shape in figure.shapes if shape not in bars and shape.style != "value"], 0.0)
    assert min(bar.parts[0][0].y for bar in bars) - corner.y - size.y == pytest.approx(20.0)


def test_a_bent_coupler_has_no_knob():
    stage = posed_linkage(InvertedSliderCrank(30, 60, 10).linkage())
    (coupler,) = [part for part in body_parts(stage) if part.link == "coupler" and part.layer == 1]
    lines = [shape.parts[0] for shape in coupler.shapes if shape.style == "body-bar"]
    assert len(lines) == 2
    assert min(a.minus(b).length for a in lines[0] for b in lines[1]) < 1e-3


@pytest.mark.parametrize("name", ["crane_cyl", "loader", "hubpodium_blocks"])
def test_sliding_drives_are_marked_while_they_move(name):
    linkage, between = linkage_and_range(name)
    assert "gr-drive" in animated_svg(linkage, between=between)


def test_hodographs_tell_round_values_and_keep_their_dots():
    linkage, between = linkage_and_range("crane_cyl")
    figure = hodograph(linkage, ["C"], between=between)
    told = [text.text for text in texts(figure, "value") if text.text.endswith(" mm")]
    assert told
    assert all(float(word.split()[0]) % 1 == 0 for word in told)
    dots = [shape for shape in figure.shapes if shape.style == "dot"]
    assert len(dots) >= len(told) + 1


def test_rounding_noise_is_no_curve():
    linkage, between = linkage_and_range("wiper")
    with pytest.raises(LinkageError, match="blade moves without turning"):
        transfer_plot(linkage, between=between)
    figure = transfer_plot(linkage, "blade", between=between)
    lines = [shape for shape in figure.shapes if shape.style == "line-1"]
    assert find_output(linkage).name == "blade"
    assert all(len({round(p.y, 6) for part in line.parts for p in part}) == 1 for line in lines)


def test_letters_stand_lower_only_after_one_letter():
    assert split_subscripts("left_arm R(a-b)") == [("left_arm R(a-b)", False)]
    figure = Figure(
        (TextShape(Point(5.0, 5.0), "μ_min <", "value"),), width=10.0, height=10.0, title="", description=""
    )
    assert '>μ<tspan dy="3" font-size="9">min</tspan> <tspan dy="-3">&lt;</tspan></text>' in svg(figure, styled=False)
