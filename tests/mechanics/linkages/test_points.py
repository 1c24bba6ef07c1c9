"""A point in all its forms: wherever one is taken, all are, and they are the same point."""

import numpy as np
import pytest

import gruebler as gr
from gruebler.mechanics.geometry import path_curvature, tangent_contact
from gruebler.mechanics.linkages import LinkPoint
from gruebler.mechanics.linkages.points import points_of

LENGTHS = gr.FourBar(25, 70, 40, 70)
LINKAGE = LENGTHS.linkage({"K": (45, 40)})
MOTION = gr.move(LINKAGE, gr.from_degrees(0, 360, 45), speed=1.0, order=3)
FORMS = [
    "K",
    "coupler:45,40",
    "45,40",
    ("coupler", 45, 40),
    LinkPoint("coupler", 45.0, 40.0),
    (45, 40),
    (45.0, np.float64(40)),
]
TAKERS = {
    "Motion.point": lambda point: MOTION.point(point, order=1),
    "Motion.table": lambda point: np.array([column.values for column in MOTION.table(points=[point]).columns][-6:]),
    "Circuit.point": lambda point: gr.circuit(LINKAGE).point(point),
    "coupler_curve": lambda point: np.array([turn.drive for turn in gr.coupler_curve(LINKAGE, point).turning_points()]),
    "path_curvature": lambda point: path_curvature(MOTION, point).curvature,
    "tangent_contact": lambda point: np.array([tangent_contact(MOTION, point, 2).points]),
    "statics": lambda point: gr.statics(MOTION, gr.Loads(forces={point: (3, 4)})).drive,
}


@pytest.mark.parametrize("taken", TAKERS.values(), ids=TAKERS)
def test_every_form_of_a_point_is_the_same_point(taken):
    expected = taken("K")
    assert np.isfinite(expected).any()
    for form in FORMS[1:]:
        np.testing.assert_allclose(taken(form), expected, rtol=1e-11, atol=1e-11)  # of 100: the last bits are free


@pytest.mark.parametrize("form", FORMS, ids=repr)
def test_pictures_take_every_form_of_a_point(form):
    picture = gr.draw(LINKAGE, curves=[form]).svg()
    assert picture.split("</desc>")[1] == gr.draw(LINKAGE, curves=["K"]).svg().split("</desc>")[1]
    assert len(gr.animate(LINKAGE, curves=[form]).svg()) > 1000
    for kind in ("hodograph", "curves"):
        assert gr.plot(LINKAGE, kind, points=[form]).svg().count("<path") > 2


def test_the_curve_of_two_numbers_is_that_of_the_closed_form():
    """The point (45, 40) of the coupler: A + (45 + 40i) e^(i theta), by the closed form of the four-bar."""
    phi = np.linspace(0, 2 * np.pi, 13)
    closed = LENGTHS.motion(phi).point(45, 40).value
    curve = gr.coupler_curve(LENGTHS, (45, 40))
    np.testing.assert_allclose(curve.point_path.at(phi, 0)[0], closed[:, 0] + 1j * closed[:, 1], atol=1e-12)


def test_the_coupler_is_known_by_its_name_or_by_its_place():
    assert points_of(gr.SliderCrank(20, 70).linkage(), (1, 2)) == (LinkPoint("coupler", 1.0, 2.0),)
    assert points_of(gr.InvertedSliderCrank(20, 70).linkage(), (1, 2)) == (LinkPoint("coupler", 1.0, 2.0),)
    quad = gr.Mechanism.parse("R(a-b) R(b-c) R(c-d) R(d-a); frame=a; drive=R(a-b)")
    drawn = gr.Linkage.from_drawing(quad, {0: (0, 0), 1: (0, 2), 2: (6, 4), 3: (6, 0)})
    assert points_of(drawn, (1, 2)) == (LinkPoint("c", 1.0, 2.0),)


@pytest.mark.parametrize("text", ["R(0-1) R(1-2) R(2-3) R(0-3)", "R(2-3) R(1-2) R(0-3) R(0-1)"])
def test_a_crank_and_a_rocker_turn_with_the_line_from_their_pivots(text):
    """By hand for 25, 70, 40, 70: with the crank on the frame B is at x = 25 + (45² + 70² - 40²)/90 = 84.17."""
    turned = np.radians(30)
    places = {"R(0-1)": 0, "R(1-2)": 25, "R(2-3)": 25 + 355 / 6 + 1j * np.sqrt(70**2 - (355 / 6) ** 2), "R(0-3)": 70}
    drawn = {joint: (z.real, z.imag) for joint, at in places.items() for z in [np.exp(1j * turned) * at]}
    linkage = gr.Linkage.from_drawing(gr.Mechanism.parse(f"{text}; frame=0; drive=R(0-1)"), drawn)
    motion = gr.move(linkage, [turned])
    assert motion.angle("1") - turned == pytest.approx(0, abs=1e-12)
    assert motion.angle("3") - turned == pytest.approx(np.arccos((25 + 355 / 6 - 70) / 40), abs=1e-12)  # 69.3 degrees


REFUSED = [
    ((1, 2, 3), "expected a point: its name, (link, x, y), or (x, y) on the coupler of a four-bar, not (1, 2, 3)"),
    (7, "not 7"),
    (None, "not None"),
    (("couple", 1, 2), "there is no link 'couple' (did you mean 'coupler'?)"),
    (LinkPoint("couple", 1, 2), "there is no link 'couple'"),
    ((float("nan"), 1), "a point has finite coordinates, not nan, 1"),
    ("coupler:inf,2", "a point has finite coordinates"),
    ("J", "there is no point 'J'"),
]


@pytest.mark.parametrize(("point", "words"), REFUSED, ids=[words for _, words in REFUSED])
def test_what_is_no_point_is_refused_in_a_sentence(point, words):
    for call in (
        lambda: gr.coupler_curve(LENGTHS, point),
        lambda: MOTION.point(point),
        lambda: gr.draw(LINKAGE, curves=[point]),
        lambda: gr.statics(MOTION, gr.Loads(forces={point: (1, 2)})),
    ):
        with pytest.raises(gr.GrueblerError) as caught:
            call()
        assert words in str(caught.value)


def test_two_numbers_are_no_point_of_a_linkage_of_six_links():
    six = gr.Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); drive=R(0-1)")
    places = [(0, 0), (0, 2), (5, 4), (6, 0), (4, 6), (9, 5), (9, 0)]
    with pytest.raises(gr.GrueblerError, match=r"here a point is \(link, x, y\)"):
        points_of(gr.Linkage.from_drawing(six, dict(enumerate(places))), (1, 2))
