"""Transmission and pressure angle of cams, their radii and lifts: by hand, and against the cam's own closed forms."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

from gruebler.files import linkage_from_json, linkage_to_json
from gruebler.mechanics.analysis.events import Dwell
from gruebler.mechanics.analysis.measuring import Measures, measures
from gruebler.mechanics.analysis.transmission import transmission_angle
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.kinematics.contours import cam_of
from gruebler.mechanics.linkages import CamDisc, Linkage
from gruebler.pictures import draw
from gruebler.teaching.catalog import entry

CAMS = ["cam", "cam_roller", "cam_rocker", "cam_rocker_flat"]


Document = dict[str, Any]


def document_of(name: str) -> tuple[Document, Document]:
    """A cam of the catalog as a document, and its disc in that."""
    document = linkage_to_json(entry(name).linkage())
    (disc,) = (place for place in document["elements"]["cam"].values() if "cam" in place)
    return document, disc


def with_lift(name: str, lift: str) -> Linkage:
    """A cam of the catalog with another lift."""
    document, disc = document_of(name)
    disc["cam"] = lift
    return linkage_from_json(document)


def degrees_of(found: Measures) -> tuple[float, float, float]:
    """The smallest transmission angle, where it is, and the largest deviation."""
    assert found.transmission is not None
    smallest = found.transmission.smallest
    return math.degrees(smallest.mu), math.degrees(smallest.drive), math.degrees(smallest.deviation)


def test_a_harmonic_rise_by_hand() -> None:
    """Base 40 and roller 10, h = 20 in 90°: s = 10 (1 - cos x), x = 2 phi, and tan α = s' / (50 + s) (VDI 2142).

    It is 2 sin x / (6 - cos x), largest where cos x = 1/6: tan α = 2/√35. The fall is longer, so that its α is smaller.
    """
    mu, at, alpha = degrees_of(
        measures(with_lift("cam_roller", "rise 20 90 harmonic; dwell 60; fall 20 150 harmonic; dwell"))
    )
    assert alpha == pytest.approx(math.degrees(math.atan(2 / math.sqrt(35))), abs=1e-9)
    assert mu == pytest.approx(90 - alpha, abs=1e-9)
    assert at == pytest.approx(math.degrees(math.acos(1 / 6)) / 2, abs=1e-6)


def test_a_corner_of_the_velocity_by_hand() -> None:
    """Parabolic: s' rises to 2 h / β at 45°, where s = 10, and falls from there; tan α = (40 / (π/2)) / 60."""
    _, at, alpha = degrees_of(
        measures(with_lift("cam_roller", "rise 20 90 parabolic; dwell 60; fall 20 150 parabolic; dwell"))
    )
    assert alpha == pytest.approx(math.degrees(math.atan(80 / math.pi / 60)), abs=1e-9)
    assert at == pytest.approx(45, abs=1e-9)


def test_radii_of_a_flat_follower_by_hand() -> None:
    """ρ = R + s + s'': harmonic over 75°, s = 4 (1 - cos x), s'' = 4 (180/75)² cos x; least at the top."""
    found = measures(with_lift("cam", "rise 8 75 harmonic; fall 8 75 harmonic; dwell"))
    (contour,) = found.cams
    assert (contour.link, contour.base, contour.hollow) == ("cam", 40.0, None)
    assert contour.convex == pytest.approx(40 + 8 - 4 * 2.4**2, abs=1e-9)
    assert degrees_of(found)[::2] == pytest.approx((90, 0))  # the face moves along its normal
    assert "smallest radius of curvature 24.96 mm" in found.explain()


@pytest.mark.parametrize("name", CAMS)
def test_along_the_drive_and_at_the_extremes_as_the_cam_itself(name: str) -> None:
    linkage, phi = entry(name).linkage(), from_degrees(0, 360, 1)
    cam = cam_of(next(e for e in linkage.elements.values() if isinstance(e, CamDisc)))
    mu = transmission_angle(move(linkage, phi, order=2))
    assert mu == pytest.approx(np.pi / 2 - np.abs(cam.pressure_angle(phi)), abs=1e-11)
    worst = max(cam.findings().pressure, key=lambda extreme: abs(extreme.value))
    found = measures(linkage).transmission
    assert found is not None
    assert found.smallest.deviation == pytest.approx(abs(worst.value), abs=1e-12)
    assert found.smallest.drive == pytest.approx(worst.at, abs=1e-7)
    assert found.largest.mu >= mu.max() - 1e-9  # in a dwell, too


@pytest.mark.parametrize("name", CAMS)
def test_it_says_so(name: str) -> None:
    english, german = (measures(entry(name).linkage()).explain(lang) for lang in ("en", "de"))
    assert "no transmission angle" not in english
    assert "dead centre" not in english
    assert re.search(r"pressure angle (up to )?\d", english)
    assert re.search(r"Druckwinkel (bis )?\d", german)
    assert "Totlage bei" not in german
    assert re.search(r"μ = [\d.]+°", draw(entry(name).linkage(), at=[0.6], show=["transmission"]).svg())


def test_a_lift_is_counted_from_the_least_and_needs_no_dead_centre() -> None:
    """A tooth up and down without dwells: the lift of 8 is greatest at 90°, and 0 again at 0°."""
    lines = measures(with_lift("cam", "rise 8 90; fall 8 270")).explain().splitlines()
    assert "Greatest lift at 90°: 8 mm." in lines
    assert "Least lift at 0°: 0 mm." in lines


def test_the_outer_position_of_a_lever_is_where_the_roller_is_farthest_from_the_axis() -> None:
    """With its pivot on the left the lever turns the other way, counter-clockwise, while it is lifted."""
    document, disc = document_of("cam_rocker")
    disc["distance"] = -100.0
    document["elements"]["frame"]["R(frame-rocker)"] = [-100.0, 0.0]
    angle = math.degrees(math.atan2(39.620070671315055, 69.5))
    document["reference_pose"] |= {"rocker": [-100.0, 0.0, angle], "roller": [-30.5, 39.620070671315055, 0.0]}
    found = measures(linkage_from_json(document))
    assert isinstance(found.outer, Dwell)
    assert isinstance(found.inner, Dwell)
    assert found.outer.output - found.inner.output == pytest.approx(math.radians(20), abs=1e-12)
    assert math.degrees(found.outer.begin) == pytest.approx(90, abs=1e-9)
