"""Non-circular wheels as joints of linkages: against the closed form of ellipses, and against curves that roll."""

from dataclasses import replace
from math import pi, radians, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.files import linkage_from_json, linkage_to_json, read_linkage, write_linkage
from gruebler.machines.cams import read_lift
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.kinematics import circuit, from_degrees, move
from gruebler.mechanics.kinematics.noncircular import transfer_of
from gruebler.mechanics.linkages import Linkage, NonCircular, Wheel
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry

HARMONIC = "rise 20 180 harmonic; fall 20 180 harmonic"
WAVES = ";".join(["rise 10 60; fall 10 60"] * 3)
CASES = [
    ("ellipse 0.5", (0, 0)),
    ("ellipse 0.6", (1, 2)),
    ("ellipse 0", (17, 34)),
    ("rise 20 180; fall 20 180", (0, 0)),
    ("rise 10 100 cycloidal; dwell 80; fall 10 90 4-5-6-7; dwell", (15, 45)),
    ("rise 20 180 v0=5 a0=0 v1=5 a1=0; fall 20 180 v0=5 a0=0 v1=5 a1=0", (0, 0)),
    (WAVES, (30, 20)),
]


def pair(transfer, teeth=(0, 0), apart=100.0, turned=0.0, joint="G", start=0.0):
    """Two wheels in the frame; the first is drawn at ``start``, the line of centres points along ``turned``."""
    mechanism = Mechanism.parse(f"R(0-a) R(0-b) {joint}(a-b); frame=0; drive=R(0-a)")
    first, second = (
        NonCircular(0, 0, 0, transfer=transfer, teeth=teeth[0]),
        NonCircular(0, 0, 0, transfer="inverse", teeth=teeth[1]),
    )
    centre = apart * np.exp(1j * turned)
    there = turned + pi - float(transfer_of(first, second).at(start)) if start else turned + pi
    touch = {
        "a": replace(first, angle=turned + start),
        "b": replace(second, x=centre.real, y=centre.imag, angle=there),
    }
    return Linkage.from_drawing(
        mechanism, {"R(0-a)": (0, 0), "R(0-b)": (centre.real, centre.imag), f"{joint}(a-b)": touch}
    )


def transfer(linkage):
    return transfer_of(linkage.element(2, "a"), linkage.element(2, "b"))


@pytest.mark.parametrize("e", [0.1, 0.3, 0.5, 0.7, 0.8])
def test_elliptic_gears_against_their_closed_form(e):
    motion = move(pair(f"ellipse {e}"), from_degrees(-725, 1075, 6), speed=1, order=2)
    assert motion.complete
    assert motion.closure_error < 1e-11
    angle = motion.angle("a")
    steep = (1 + e) / (1 - e)
    half = -motion.angle("b") / 2
    miss = np.sin(half) * np.cos(angle / 2) - steep * np.cos(half) * np.sin(angle / 2)
    assert np.abs(miss).max() < 1e-9
    below = 1 + e**2 - 2 * e * np.cos(angle)
    assert np.abs(motion.angular("b") + (1 - e**2) / below).max() < 1e-9
    assert np.abs(motion.angular("b", order=2) - (1 - e**2) * 2 * e * np.sin(angle) / below**2).max() < 1e-7


@pytest.mark.parametrize(("text", "teeth"), [case for case in CASES if "ellipse" not in case[0]])
def test_the_turn_is_the_mean_and_the_lift(text, teeth):
    mean = teeth[0] / teeth[1] if teeth[0] else 1
    motion = move(pair(text, teeth), from_degrees(-400, 1100, 3.7), speed=1, order=2)
    assert motion.complete
    lift = read_lift(text)
    for order, tolerance in enumerate((1e-11, 1e-9, 1e-6)):
        wanted = radians(1) * lift.at(motion.drives[:, 0], order) + mean * (motion.drives[:, 0], 1, 0)[order]
        found = -(motion.angular("b", order=order) if order else motion.angle("b"))
        inside = np.ones(len(motion), bool)
        if order == 2:  # it jumps between the parts
            starts = np.array([span.start for span in lift.spans()])
            inside = np.abs(np.mod(motion.drives[:, 0][:, None] - starts + 1, 2 * pi) - 1).min(axis=1) > 1e-6
        off = found - wanted
        assert np.abs(off - (2 * pi * np.round(off / 2 / pi) if order == 0 else 0))[inside].max() < tolerance


@pytest.mark.parametrize(("text", "teeth"), CASES)
def test_the_curves_roll_on_each_other(text, teeth):
    """They touch in one point of the line of centres, with one tangent, and roll off equal arcs."""
    linkage = pair(text, teeth)
    one, two = (100 * curve for curve in transfer(linkage).curves())
    rows = np.arange(0, len(two), 5)
    motion = move(linkage, 2 * pi * rows / len(one))
    assert motion.complete
    first, second = linkage.element(2, "a"), linkage.element(2, "b")
    turned = motion.turns[:, motion.link_index("a")] * np.exp(1j * first.angle)
    other = motion.turns[:, motion.link_index("b")] * np.exp(1j * second.angle)
    here, there = turned * one[rows % len(one)], 100 + other * two[rows]
    np.testing.assert_allclose(here, there, atol=1e-10)
    assert np.abs(here.imag).max() < 1e-10
    assert ((here.real > 0) & (here.real < 100)).all()
    slope = [np.roll(curve, -1) - np.roll(curve, 1) for curve in (one, two)]
    along, beside = turned * slope[0][rows % len(one)], other * slope[1][rows]
    assert np.abs((along * np.conj(beside)).imag / np.abs(along * beside)).max() < 2e-3
    # Chords against arcs: the error is of third order in the step.
    arcs = [np.abs(np.diff(np.append(curve, curve[0]))) for curve in (one, two)]
    np.testing.assert_allclose(arcs[1], np.tile(arcs[0], len(two) // len(one) + 1)[: len(two)], rtol=2e-3)
    mean = teeth[0] / teeth[1] if teeth[0] else 1
    assert arcs[1].sum() * mean == pytest.approx(arcs[0].sum(), rel=1e-4)


def test_equal_ellipses_about_their_foci():
    e, major = 0.4, 100.0
    for curve, side in zip(transfer(pair(f"ellipse {e}")).curves(), (1, -1), strict=True):
        points = major * curve
        np.testing.assert_allclose(np.abs(points) + np.abs(points - side * e * major), major, rtol=1e-13)


def test_an_ellipse_on_a_wheel_of_several_lobes():
    """The sum of the distances from the foci is the same for all points of the first wheel, whatever the mean ratio."""
    e = 0.6
    for lobes in (2, 3, 5):
        curve, second = transfer(pair(f"ellipse {e}", (1, lobes))).curves()
        major = np.abs(curve).max() + np.abs(curve).min()
        np.testing.assert_allclose(np.abs(curve) + np.abs(curve - e * major), major, rtol=1e-13)
        lobe = len(second) // lobes
        np.testing.assert_allclose(second[lobe:], second[:-lobe] * np.exp(2j * pi / lobes), rtol=1e-12)


@settings(max_examples=12, deadline=None)
@given(
    st.one_of(
        st.tuples(st.floats(0, 0.8).map(lambda e: f"ellipse {e}"), st.integers(1, 4).map(lambda n: (1, n))),
        st.tuples(
            st.tuples(st.floats(1, 30), st.floats(100, 260)).map(
                lambda c: f"rise {c[0]} {c[1]} cycloidal; fall {c[0]} {360 - c[1]}"
            ),
            st.just((0, 0)),
        ),
    ),
    st.floats(-3, 3).map(lambda k: 10**k),
    st.floats(-3, 3),
    st.floats(0.1, 6),
)
def test_scale_and_rotation_change_nothing(case, factor, turned, start):
    path = from_degrees(0, 500, 12)
    plain = move(pair(*case, start=start), path, speed=1, order=2)
    other = move(pair(*case, start=start, turned=turned).scaled(factor), path, speed=1, order=2)
    assert plain.complete
    assert other.complete
    for order, tolerance in enumerate((1e-9, 1e-8, 1e-6)):
        one, two = (m.angular("b", order=order) if order else m.angle("b") for m in (plain, other))
        np.testing.assert_allclose(two - two[0], one - one[0], atol=tolerance)


@pytest.mark.parametrize(("text", "teeth"), CASES)
def test_the_circuit_finds_the_same_and_files_keep_it(text, teeth, tmp_path):
    linkage = pair(text, teeth, start=1.0)
    made = circuit(linkage)
    assert made.closed
    motion = move(linkage, made.drive)
    assert motion.complete
    np.testing.assert_allclose(np.exp(1j * motion.angle("b")), np.exp(1j * made.angle("b")), atol=1e-9)
    assert linkage_from_json(linkage_to_json(linkage)) == linkage
    for name in ("pair.toml", "pair.json"):
        write_linkage(tmp_path / name, linkage)
        assert read_linkage(tmp_path / name) == linkage


@pytest.mark.filterwarnings("ignore::gruebler.base.errors.UnitWarning")  # rows many turns apart
def test_phases_stay_exact_over_many_turns():
    linkage = pair("ellipse 0.5", (1, 3))
    motion = move(linkage, [0.5, 0.5 + 600 * pi])
    assert motion.complete
    np.testing.assert_allclose(motion.places[0, 1], motion.places[0, 0], atol=1e-9)
    np.testing.assert_allclose(motion.turns[1], motion.turns[0], atol=1e-11)
    assert measures(linkage).span.turns == 3
    assert measures(pair(WAVES, (30, 20))).span.turns == 2


def test_the_second_wheel_drives_and_the_pair_rolls():
    """A rolling pair is the same between fixed centres; from the other side the inverse function is found."""
    e = 0.5
    for joint in "GW":
        linkage = pair(f"ellipse {e}", joint=joint)
        mechanism = Mechanism.parse(f"R(0-a) R(0-b) {joint}(a-b); frame=0; drive=R(0-b)")
        motion = move(linkage.with_mechanism(mechanism), from_degrees(-170, 170, 5))
        assert motion.complete
        wanted = (1 - e) / (1 + e) * np.tan(-motion.angle("b") / 2)
        np.testing.assert_allclose(np.tan(motion.angle("a") / 2), wanted, atol=1e-9)


def test_mirror_images():
    linkage = pair("ellipse 0.5", start=0.7)
    motion, image = move(linkage, from_degrees(0, 360, 15)), move(linkage.mirrored(), from_degrees(0, -360, -15))
    np.testing.assert_allclose(
        image.angle("b") - image.angle("b")[0], motion.angle("b")[0] - motion.angle("b"), atol=1e-9
    )
    with pytest.raises(LinkageError, match="mirror image of a non-circular wheel"):
        pair(HARMONIC).mirrored()


def test_a_slider_crank_behind_elliptic_gears():
    """Rates of a linkage behind the pair are derivatives."""
    mechanism = Mechanism.parse("R(0-a) R(0-b) G(a-b) R(b-rod) R(rod-slider) P(0-slider); frame=0; drive=R(0-a)")
    touch = {"a": NonCircular(0, 0, 0, transfer="ellipse 0.4"), "b": NonCircular(100, 0, pi, transfer="inverse")}
    places = {"R(0-a)": (0, 0), "R(0-b)": (100, 0), "G(a-b)": touch, "R(b-rod)": (100, 30), "R(rod-slider)": (200, 0)}
    linkage = Linkage.from_drawing(mechanism, {**places, "P(0-slider)": (200, 0, 0)})
    h = 1e-3
    motion = move(linkage, 0.9 + h * np.arange(-4, 5), speed=1, order=3)
    weights = np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / (840 * h)
    for order, tolerance in ((0, 1e-8), (1, 1e-6), (2, 1e-3)):
        assert np.abs(weights @ motion.places[order] - motion.places[order + 1, 4]).max() < tolerance


def test_the_catalog_machine_and_its_picture():
    linkage = entry("elliptic_gears").linkage()
    motion = move(linkage, [0, pi / 2, pi], speed=1, order=1)
    np.testing.assert_allclose(motion.angular("follower"), [-3, -0.6, -1 / 3], rtol=1e-9)
    assert motion.angle("follower")[1] - motion.angle("follower")[0] == pytest.approx(-2 * np.arctan(3 * tan(pi / 4)))
    assert "<svg" in draw_linkage(linkage, at=0.8).svg()


def with_second(element=None, **changed):
    linkage = pair("ellipse 0.5")
    elements = linkage._by_link()
    elements["b"][2] = element or replace(elements["b"][2], angle=elements["b"][2].angle + changed["angle"] - pi)
    return linkage._changed(elements=elements)


def without_arm():
    mechanism = Mechanism.parse("R(0-a) P(0-c) R(b-c) G(a-b); frame=0; drive=R(0-a)")
    touch = {"a": NonCircular(0, 0, 0, transfer="ellipse 0.5"), "b": NonCircular(100, 0, pi, transfer="inverse")}
    return Linkage.from_drawing(
        mechanism, {"R(0-a)": (0, 0), "P(0-c)": (100, 0, 0), "R(b-c)": (100, 0), "G(a-b)": touch}
    )


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: pair("ellipse 0.5", apart=0.0), "the centre distance on '0' is too small"),
        (lambda: pair(HARMONIC.replace("20", "120")), "it must be positive everywhere"),
        (lambda: pair("rise 90 90; dwell 90; fall 90 90; dwell"), "it must be positive everywhere"),
        (lambda: pair("rise 20 180 linear; fall 20 180 linear"), "the ratio jumps by"),
        (lambda: pair("rise 20 180; dwell"), "must end where it began"),
        (lambda: pair("ellipse 0.5", (2, 1)), "curve does not close: with a mean ratio of 2 .* every 180°"),
        (lambda: pair(WAVES, (20, 30)), "curve does not close: with a mean ratio of 2/3"),
        (lambda: pair("ellipse 0", (101, 103)), "numbers up to 100, not 101/103"),
        (lambda: pair("ellipse 0.9"), "an eccentricity from 0 to 0.8, but found 'ellipse 0.9'"),
        (lambda: pair("ellipse nan"), "an eccentricity from 0 to 0.8"),
        (lambda: pair("elipse 0.5"), "expected rise, fall or dwell"),
        (lambda: pair(" "), "transfer: expected a text such as"),
        (lambda: pair("inverse"), "one of two non-circular wheels has a transfer function, the other 'inverse'"),
        (lambda: pair("ellipse 0.5", (20, 0)), "tooth numbers on both wheels or on none"),
        (lambda: pair("ellipse 0.5", (-20, -20)), "teeth: expected a positive number, but found -20"),
        (
            lambda: with_second(angle=pi + 0.01),
            "do not mesh in the reference pose: turn 'b', or its direction, by -0.57",
        ),
        (lambda: with_second(Wheel(0, 0, 50)), "a non-circular wheel .* on each of its links"),
        (without_arm, "need a link that carries both centres by pins"),
    ],
)
def test_what_does_not_fit_is_said(make, words):
    with pytest.raises(LinkageError, match=words):
        move(make(), [0.0])
