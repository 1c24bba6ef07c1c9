"""Round parts of linkages: pitch circles touch, belts are tangents, cams touch their followers."""

import cmath
import math

import numpy as np
import pytest

from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape
from gruebler.pictures.linkage.element_pictures import round_parts
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.teaching.catalog import entries, entry


def placed(name):
    """The round parts of a machine where they lie in its picture: link, shapes with their points as numbers."""
    linkage = entry(name).linkage()
    stage = posed_linkage(linkage)
    for part in round_parts(stage):
        at = stage.pose.complex_point(LinkPoint(part.link, 0.0, 0.0))[0]
        turn = cmath.exp(1j * stage.pose.angle(part.link)[0])

        def there(p, at=at, turn=turn):
            return at + turn * complex(p.x, -p.y) / stage.scale

        for shape in part.shapes:
            if isinstance(shape, CircleShape):
                yield part.link, shape.style, there(shape.at), shape.radius / stage.scale
            elif isinstance(shape, Polylines):
                yield part.link, shape.style, [np.array([there(p) for p in points]) for points in shape.parts], None


def circles(name):
    return {link: (at, r) for link, style, at, r in placed(name) if r is not None and style in ("area", "block-frame")}


@pytest.mark.parametrize(
    ("name", "one", "two"), [("geartrain", "gear1", "gear2"), ("friction_forced", "wheel1", "wheel2")]
)
def test_pitch_circles_touch(name, one, two):
    (a, r), (b, s) = (circles(name)[link] for link in (one, two))
    assert abs(b - a) == pytest.approx(r + s, rel=1e-9)


def test_a_ring_is_hollow_and_holds_its_planet():
    (rings,) = (shape for link, style, shape, _ in placed("diff") if (link, style) == ("ring_gear", "area"))
    outer, inner = (abs(ring).max() for ring in rings)
    planet, radius = circles("diff")["planet"]
    assert inner == pytest.approx(60, rel=1e-9)
    assert abs(planet) + radius == pytest.approx(inner, rel=1e-9)
    assert outer > inner
    (lines,) = (shape for link, style, shape, _ in placed("diff") if (link, style) == ("ring_gear", "hatch"))
    assert len(lines) == 8  # they show that it turns
    for line in lines:
        assert abs(line) == pytest.approx([inner, outer], rel=1e-3)


def test_a_belt_touches_both_pulleys():
    (runs,) = (shape for _, style, shape, _ in placed("belt") if style == "rail")
    for link, (at, radius) in circles("belt").items():
        for start, end in runs:
            along = (end - start) / abs(end - start)
            assert abs(((at - start) * along.conjugate()).imag) == pytest.approx(radius, rel=1e-9), link


@pytest.mark.parametrize(("name", "follower"), [("cam", "valve"), ("cam_rocker_flat", "rocker")])
def test_a_cam_touches_a_face_that_is_as_long_as_it_needs(name, follower):
    shapes = list(placed(name))
    (contour,) = (shape[0] for link, style, shape, r in shapes if link == "cam" and style == "area")
    (plate,) = (shape[0] for link, style, shape, r in shapes if link == follower and style == "block")
    middle = plate.mean()
    sides = zip(plate, np.roll(plate, -1), strict=True)
    start, end = max(sides, key=lambda side: (abs(side[1] - side[0]) > 20, abs(middle) - abs(sum(side) / 2)))
    along = (end - start) / abs(end - start)
    beyond = ((contour - start) * along.conjugate()).imag
    assert beyond.max() == pytest.approx(0, abs=2e-3) or beyond.min() == pytest.approx(0, abs=2e-3)
    touching = ((contour[np.argmin(abs(beyond))] - start) * along.conjugate()).real
    assert 0 < touching < abs(end - start)


def test_a_geneva_wheel_has_its_slots():
    wheel = next(shape[0] for link, _, shape, r in placed("geneva") if link == "cross" and r is None)
    about = wheel - 100
    quarter = about * 1j
    assert len(wheel) % 4 == 0
    assert np.abs(np.sort_complex(np.round(quarter, 6)) - np.sort_complex(np.round(about, 6))).max() < 1e-5
    assert abs(about).max() == pytest.approx(100 * math.cos(math.pi / 4), rel=1e-6)


@pytest.mark.parametrize("id", ["geartrain", "diff", "diff2p", "friction_forced", "belt"])
def test_wheels_fit_a_picture_whose_texts_can_be_read(id):
    """On paper a picture is at most some 600 pixels wide: larger ones are reduced, their texts too."""
    figure = draw_linkage(entry(id).linkage(), labels=True)
    assert max(figure.width, figure.height) < 620


@pytest.mark.parametrize("id", [id for id, each in entries().items() if each.dimensions and each.space == "planar"])
def test_links_are_named_or_numbered_all_alike(id):
    linkage = entry(id).linkage()
    links = linkage.mechanism.chain.links
    texts = [
        s.text for s in draw_linkage(linkage, labels=True).shapes if isinstance(s, TextShape) and s.style == "name"
    ]
    named = [link for link in links if link in texts and not link.isdigit()]
    numbered = [text for text in texts if text.isdigit() and text not in links]
    assert not (named and numbered), (named, numbered)
