"""Reasons are not found where they are not, however small a link, and found where they are."""

import numpy as np
import pytest

from gruebler.mechanics.screws import Closing, freedoms
from gruebler.mechanics.screws.instant_mobility import instant_mobility
from gruebler.mechanics.screws.joint_geometry import JointGeometry
from gruebler.mechanics.screws.loops import bricard, schatz
from tests.mechanics.screws import machines as m


def cranks(radius, error):
    """Three parallel cranks of a radius, spaced by 3, the last one longer by a part."""
    crank = radius * np.array([np.cos(0.7), np.sin(0.7)])
    feet = [np.array([3.0 * k, 0.0]) for k in range(3)]
    pins = [foot + crank * (1 + error * (k == 2)) for k, foot in enumerate(feet)]
    places = [place for pair in zip(feet, pins, strict=True) for place in pair]
    return m.planar(" ".join(f"R(0-w{k}) R(w{k}-rod)" for k in range(3)), dict(enumerate(places)))


@pytest.mark.parametrize("radius", [1.0, 1e-3, 1e-6])
def test_equal_cranks_are_equal_by_their_own_length(radius):
    """A crank 1 % too long is not equal, though the difference may be 1e-8 of the linkage."""
    assert [r.kind for r in freedoms(cranks(radius, 0.0)).reasons] == ["cranks"]
    assert "cranks" not in [r.kind for r in freedoms(cranks(radius, 0.01)).reasons]


@pytest.mark.parametrize("pitch", [0.3, -1.2])
def test_four_screws_of_one_pitch(pitch):
    """With parallel axes they move within a group of dimension 3: F = 3 - 2 = 1 for a loop of four."""
    places = [(0, 0, 0), (1, 0.2, 0.5), (2, 3, 0), (-1, 2, 1)]
    screws = [{"at": at, "z": (0, 0, 1), "pitch": pitch} for at in places]
    text = "spatial: H(0-1) H(1-2) H(2-3) H(0-3)"
    found = freedoms(m.planar(text, dict(enumerate(screws))))
    assert (found.counted, found.mobility) == (-2, 1)
    assert [(r.kind, r.number) for r in found.reasons] == [("group_screws", 3)]
    assert "all screws have the same pitch" in found.explain()
    screws[2]["pitch"] = pitch + 0.5
    assert "group_screws" not in [r.kind for r in freedoms(m.planar(text, dict(enumerate(screws)))).reasons]


def mirrored(upright):
    """Six axes that the mirror z = 0 takes to each other: two of them lie in it, or stand upright on it."""
    random = np.random.default_rng(3)
    points, ways = random.normal(size=(2, 6, 3))
    image = np.array([1.0, 1.0, -1.0])
    points[[0, 3], 2] = 0.0
    ways[[0, 3]] = (0, 0, 1) if upright else np.append(random.normal(size=(2, 2)), [[0], [0]], axis=1)
    points[[5, 4]], ways[[5, 4]] = points[[1, 2]] * image, ways[[1, 2]] * image
    text = "spatial: R(5-0) R(0-1) R(1-2) R(2-3) R(3-4) R(4-5)"
    return m.planar(text, {k: {"at": tuple(points[k]), "z": tuple(ways[k])} for k in range(6)})


@pytest.mark.parametrize("upright", [False, True])
def test_a_plane_symmetric_bricard_has_no_offsets_in_its_mirror(upright):
    """Axes upright on the mirror are taken to themselves too, but with offsets: such a loop is rigid."""
    closing = Closing.of(mirrored(upright))
    kinds = [r.kind for r in bricard(JointGeometry(instant_mobility(closing, closing.reference, 1e-8)))]
    assert ("plane_symmetric" in kinds) is not upright
    assert freedoms(mirrored(upright)).mobility == (not upright)


def shafts(linkage):
    """Distance of the first and last axis, and the height of their joints above each other."""
    first, last = linkage.places[0], linkage.places[5]
    across, axis = np.subtract(last.at, first.at), np.array(first.z) / np.linalg.norm(first.z)
    height = across @ axis
    return np.linalg.norm(across - height * axis), abs(height)


# xy - x - y = h²/2 and x² + y² - x²y² = h²/4 for h = 0.3: x + y = -0.114525 / 2.09 and xy = x + y + 0.045
SUM = -0.114525 / 2.09
LEVEL = np.roots([1, -SUM, SUM + 0.045])


@pytest.mark.parametrize(
    ("linkage", "distance", "height"),
    [
        (m.schatz(*LEVEL), np.sqrt(3), 0.3),
        (m.schatz(-0.4, 2 / 7 + 0.01), None, None),
        (m.schatz(-0.4, lengths=(1, 1.01, 1)), None, None),
        (m.schatz(-0.4, lengths=(1, 1, 1.01)), None, None),
        (m.schatz(-0.4, offsets=(0.01, 0)), None, None),
        (m.schatz(-0.4, offsets=(0.01, -0.01)), None, None),
    ],
    ids=["shafts not level", "shafts apart", "vessel", "fork", "offset", "two offsets"],
)
def test_almost_a_schatz_is_rigid(linkage, distance, height):
    """All axes as Schatz's, one condition of docs/theory/freedoms.md broken."""
    closing = Closing.of(linkage)
    assert list(schatz(JointGeometry(instant_mobility(closing, closing.reference, 1e-8)))) == []
    assert freedoms(linkage).mobility == 0
    if distance is not None:
        assert shafts(linkage) == pytest.approx((distance, height), abs=1e-12)


@pytest.mark.parametrize("x", [-0.9, -0.4, 0.2, 0.45])
def test_a_schatz_is_found_in_every_pose_and_by_any_point_of_its_shafts(x):
    linkage = m.schatz(x)
    assert shafts(linkage) == pytest.approx((np.sqrt(3), 0), abs=1e-12)
    places = list(linkage.places)
    axis = 0.7 * np.array(places[0].z)
    places[0] = type(places[0])(tuple(np.add(places[0].at, axis)), z=places[0].z)
    for loop in (linkage, type(linkage)(linkage.mechanism, tuple(places))):
        found = freedoms(loop)
        assert (found.mobility, [r.kind for r in found.reasons]) == (1, ["schatz"])
