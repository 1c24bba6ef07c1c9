"""A slide between two pins in a drawing: aimed at a joint, or at an angle of enough digits."""

from math import atan2, cos, degrees, hypot, radians, sin

import pytest

from gruebler.base.errors import LinkageError
from gruebler.files.linkages import linkage_from_json
from gruebler.mechanics.linkages import Line, Pin

FOOT, HEAD = (100, -20), (30, 60)
ANGLE = degrees(atan2(HEAD[1] - FOOT[1], HEAD[0] - FOOT[0]))


def cylinder(angle, at=FOOT):
    return {
        "unit": "mm",
        "joints": "R(frame-arm) R(frame-barrel) P(barrel-rod) R(rod-arm)",
        "drives": ["P(barrel-rod)"],
        "places": {
            "R(frame-arm)": [0, 0],
            "R(frame-barrel)": list(FOOT),
            "R(rod-arm)": list(HEAD),
            "P(barrel-rod)": [*at, angle],
        },
    }


def offset(linkage):
    """The distance of the two pins across the slide: the sum of what each link has between its pin and its line."""
    total = 0.0
    for link, sign in (("barrel", 1), ("rod", -1)):
        mine = [element for (_, owner), element in linkage.elements.items() if owner == link]
        (line,), (pin,) = ([one for one in mine if isinstance(one, kind)] for kind in (Line, Pin))
        total += sign * (cos(line.angle) * (line.y - pin.y) - sin(line.angle) * (line.x - pin.x))
    return total


@pytest.mark.parametrize("digits", [1, 2, 3, 4, 5, 6])
def test_an_angle_of_few_digits_is_refused(digits):
    with pytest.raises(LinkageError, match=r'places\.P\(barrel-rod\): .* write "R\(rod-arm\)" instead of the angle'):
        linkage_from_json(cylinder(round(ANGLE, digits)))


@pytest.mark.parametrize("angle", [ANGLE, round(ANGLE, 10), "R(rod-arm)", "R(arm-rod)"])
def test_the_slide_passes_through_both_pins(angle):
    assert abs(offset(linkage_from_json(cylinder(angle)))) < 1e-9 * hypot(70, 80)


def test_from_the_other_end():
    assert abs(offset(linkage_from_json(cylinder("R(frame-barrel)", HEAD)))) < 1e-12


@pytest.mark.parametrize("angle", [120, 90.5, ANGLE + 0.2])
def test_an_offset_that_is_meant_stays(angle):
    across = abs(cos(radians(angle)) * 80 + sin(radians(angle)) * 70)
    assert abs(offset(linkage_from_json(cylinder(angle)))) == pytest.approx(across, rel=1e-9)


@pytest.mark.parametrize("word", ["R(frame-rod)", "P(barrel-rod)", "R(frame-barrel)"])
def test_a_joint_that_gives_no_direction(word):
    with pytest.raises(LinkageError, match=r"places\.P\(barrel-rod\): .*(no place|own point)"):
        linkage_from_json(cylinder(word))
