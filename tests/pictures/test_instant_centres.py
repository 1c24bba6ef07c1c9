"""Every instant centre is in the picture: as a mark, or by an arrow on its polar ray with the distance."""

import itertools
import math
import re

import numpy as np
import pytest

from gruebler import FourBar, SliderCrank
from gruebler.mechanics.geometry import poles
from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape
from gruebler.pictures.linkage.instant_centres import instant_centres, pole_marks
from gruebler.pictures.linkage.layer_context import LayerContext
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.teaching.catalog import entry

CRANK_ROCKER = FourBar(25, 70, 40, 70)


def words(figure):
    return [shape.text for shape in figure.shapes if isinstance(shape, TextShape)]


def named(figure):
    """The poles that are named, each with what stands behind its name."""
    found = {}
    for text in words(figure):
        for part in text.split(", "):
            if match := re.match(r"P([₀-₉]{2})(?: (.*))?$", part):
                found.setdefault(match[1], set()).add(match[2] or "")
    return found


def meeting(a, b, c, d):
    """Where the lines a b and c d meet."""
    u, v = b - a, d - c
    return a + u * ((c - a).conjugate() * v).imag / (u.conjugate() * v).imag


def pins(stage):
    names = (
        ("frame", 0, 0),
        ("crank", CRANK_ROCKER.a, 0),
        ("coupler", CRANK_ROCKER.b, 0),
        ("frame", CRANK_ROCKER.d, 0),
    )
    return [complex(stage.pose.complex_point(LinkPoint(*name))[0]) for name in names]


@pytest.mark.parametrize("angle", range(0, 360, 10))
def test_all_poles_of_a_four_bar_in_every_pose(angle):
    """The six poles are named; the two that are no pins lie where crank and rocker, and frame and coupler, meet."""
    linkage, drive = CRANK_ROCKER.linkage(), math.radians(angle)
    figure, stage = draw_linkage(linkage, at=drive, show=["poles"]), posed_linkage(linkage, drive)
    assert set(named(figure)) == {"₁₂", "₁₃", "₁₄", "₂₃", "₂₄", "₃₄"}
    assert {"1  frame", "2  crank", "3  coupler", "4  rocker"} <= set(words(figure))
    a0, a, b, b0 = pins(stage)
    marks = pole_marks(LayerContext(stage, None, []))
    crosses = [
        np.mean(shape.parts[0], axis=0) for shape in marks if isinstance(shape, Polylines) and shape.style == "edge"
    ]
    crosses += [shape.at for shape in marks if isinstance(shape, CircleShape)]
    for name, pole, ends in (
        ("₁₃", meeting(a0, a, b0, b), (a0, a, b0, b)),
        ("₂₄", meeting(a0, b0, a, b), (a0, b0, a, b)),
    ):
        at, said = stage.local(pole), named(figure)[name]
        lengths = {f"{float(f'{abs(pole - end):.4g}'):.10g} mm" for end in ends}
        marked = min(math.dist(at, cross) for cross in crosses) < 1e-4
        assert said == {""} if marked else said <= lengths


@pytest.mark.parametrize(("angle", "marked"), [(40, True), (80, False), (100, False), (180, True), (290, False)])
def test_a_pole_far_away_is_told_by_its_distances(angle, marked):
    """The coupler's pole against the frame is far where crank and rocker are nearly parallel."""
    linkage, drive = CRANK_ROCKER.linkage(), math.radians(angle)
    a0, a, b, b0 = pins(posed_linkage(linkage, drive))
    pole = meeting(a0, a, b0, b)
    assert (abs(pole) < 250) == marked
    assert (named(draw_linkage(linkage, at=drive, show=["poles"]))["₁₃"] == {""}) == marked


@pytest.mark.parametrize(
    "linkage", [CRANK_ROCKER.linkage(), SliderCrank(25, 70, 5).linkage(), entry("wiper").linkage()]
)
@pytest.mark.parametrize("drive", [0.3, 1.4, 2.9, 5.0])
def test_against_the_poles_of_the_motion(linkage, drive):
    """Those of the poles in `geometry`, which knows nothing of joints; and three poles of three links on one line."""
    stage = posed_linkage(linkage, drive)
    found, other = instant_centres(stage), poles(stage.pose, linkage.mechanism.chain.links)
    for pole in found:
        if pole.direction:
            towards = complex(other.towards(*pole.links)[0])
            assert abs((towards.conjugate() * pole.direction).imag) < 1e-9
        else:
            assert complex(other.of(*pole.links)[0]) == pytest.approx(pole.at, rel=1e-6, abs=1e-6 * linkage.size)
    at = {frozenset(pole.links): pole for pole in found}
    for three in itertools.combinations(linkage.mechanism.chain.links, 3):
        pair = [at.get(frozenset(two)) for two in itertools.combinations(three, 2)]
        if None not in pair and not any(pole.direction for pole in pair):
            p, q, r = (pole.at for pole in pair)
            assert abs(((q - p).conjugate() * (r - p)).imag) < 1e-6 * max(abs(q - p), 1) * max(abs(r - p), 1)


def test_poles_at_infinity():
    """Opposite links of a parallelogram translate against each other; so does the slider against its guide."""
    assert named(draw_linkage(FourBar(25, 70, 25, 70).linkage(), at=0.9, show=["poles"])) == {
        "₁₂": {""},
        "₂₃": {""},
        "₃₄": {""},
        "₁₄": {""},
        "₁₃": {"∞"},
        "₂₄": {"∞"},
    }
    assert named(draw_linkage(SliderCrank(25, 70).linkage(), at=0.9, show=["poles"]))["₁₄"] == {"∞"}


def test_larger_linkages_show_permanent_poles_and_those_against_the_frame():
    linkage = entry("wiper").linkage()
    figure = draw_linkage(linkage, at=0.9, show=["poles"], lang="de")
    links = linkage.mechanism.chain.links
    joints = {frozenset(pair) for j in linkage.mechanism.chain.joints for pair in itertools.combinations(j.links, 2)}
    wanted = joints | {frozenset((links[0], link)) for link in links[1:]}
    assert {frozenset(links["₁₂₃₄₅₆".index(digit)] for digit in name) for name in named(figure)} == wanted


@pytest.mark.parametrize("angle", range(0, 360, 30))
def test_the_picture_stays_of_a_size(angle):
    plain = draw_linkage(CRANK_ROCKER.linkage(), at=math.radians(angle))
    with_poles = draw_linkage(CRANK_ROCKER.linkage(), at=math.radians(angle), show=["poles"])
    assert max(with_poles.width, with_poles.height) < 3.5 * max(plain.width, plain.height)
