"""Instant centres and centrodes."""

from itertools import combinations

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.geometry import centrodes, poles
from gruebler.mechanics.geometry.relative import relative_motion
from gruebler.mechanics.kinematics import move

from .linkages import MOVING, moved

# A four-bar a, b, c, d = 25, 70, 40, 70 at phi = 55 degrees, velocities by a polygon: pole of the coupler against the
# frame, pole of crank and rocker; open and crossed.
LITERATURE = {
    "+": (127.80287109760924 + 182.52141561397j, -64.23347175135778),
    "-": (175.49484713997424 + 250.63261613646625j, 28.674719413311557),
}


@pytest.mark.parametrize("branch", LITERATURE)
def test_literature(branch):
    found = poles(move(FourBar(25, 70, 40, 70).linkage(), np.radians([55]), speed=10, branch=branch))
    coupler, crank_rocker = LITERATURE[branch]
    assert abs(found.of("frame", "coupler")[0] - coupler) < 1e-11
    assert abs(found.of("crank", "rocker")[0] - crank_rocker) < 1e-11


def test_slider_crank_pole():
    """E21: the pole of the connecting rod lies over the slider, on the crank's line."""
    found = poles(move(SliderCrank(25, 70).linkage(), np.radians([55]), speed=10))
    assert abs(found.of("coupler", "frame")[0] - (81.2768347104936 + 116.07534948609974j)) < 1e-11


@pytest.mark.parametrize("name", MOVING)
def test_kennedy_and_aronhold(name):
    """The three poles of any three links lie on a line."""
    motion, _, _ = moved(name)
    found = poles(motion)
    checked = 0
    for one, two, three in combinations(found.links, 3):
        first, second, third = found.of(one, two), found.of(two, three), found.of(one, three)
        area = (np.conj(second - first) * (third - first)).imag
        scale = np.maximum.reduce([abs(second - first), abs(third - first), np.full(len(motion), motion.linkage.size)])
        seen = np.isfinite(area)
        assert np.all(abs(area[seen]) <= 1e-10 * scale[seen] ** 2)
        checked += int(seen.sum())
    assert checked > len(motion)


@pytest.mark.parametrize("name", MOVING)
def test_poles_of_joined_links_are_their_joints(name):
    motion, _, _ = moved(name)
    found = poles(motion)
    mechanism = motion.linkage.mechanism
    names = dict(zip(mechanism.chain.joint_names(), mechanism.chain.joints, strict=True))
    pins = {text: joint.links for text, joint in names.items() if joint.pair.name == "revolute"}
    slides = {text: joint.links for text, joint in names.items() if joint.pair.name == "prismatic"}
    assert len(pins) >= 3
    assert len(pins) + len(slides) == len(names)
    assert bool(slides) == (name in ("slider-crank", "inverted", "cylinder"))
    for text, (one, other) in pins.items():
        assert np.allclose(found.of(one, other), motion.complex_point(text), rtol=0, atol=1e-9 * motion.linkage.size)
    for text, (one, other) in slides.items():
        line = motion.linkage.element(text, one)
        along = motion.turns[:, found.links.index(one)] * np.exp(1j * line.angle)
        assert np.isnan(found.of(one, other)).all()
        assert np.abs((np.conj(along) * found.towards(one, other)).real).max() < 1e-9


@pytest.mark.parametrize("name", MOVING)
def test_two_ways_to_one_pole(name):
    """From absolute velocities in the plane, and from the motion as the other link sees it."""
    motion, one, other = moved(name)
    k = motion.linkage.mechanism.chain.links.index(other)
    seen = relative_motion(motion, one, other)
    there = motion.places[0, :, k] + motion.turns[:, k] * seen.pole
    assert np.allclose(poles(motion).of(one, other), there, rtol=1e-9, equal_nan=True)


@pytest.mark.parametrize("name", MOVING)
@pytest.mark.parametrize("relative", [False, True])
def test_centrodes_roll_without_slip(name, relative):
    """Between rows both centrodes grow by the same way, to the order of the chords; placed, they touch at the pole."""
    motion, one, other = moved(name)
    reference = other if relative else motion.linkage.mechanism.frame
    rolling = centrodes(motion, one, reference)
    if np.isnan(rolling.fixed).any():
        pytest.skip("the links translate against one another")
    seen = relative_motion(motion, one, reference)
    fixed, moving = np.diff(rolling.fixed), np.diff(rolling.moving)
    far = 1e-9 * np.maximum(abs(rolling.fixed), motion.linkage.size)
    assert np.all(abs(seen.places[0] + seen.turn * rolling.moving - rolling.fixed) < far)
    if abs(fixed).max() < 1e-9 * motion.linkage.size:
        assert abs(moving).max() < 1e-9 * motion.linkage.size  # a joint: both are points
        return
    rolled = abs(moving) / abs(fixed)
    turn = np.abs(np.diff(np.unwrap(np.angle(seen.turn))))
    assert np.all(abs(rolled - 1) < 2 * turn**2 + 1e-4)
    middle = np.sqrt(seen.turn[1:] * seen.turn[:-1])
    middle *= np.sign((np.conj(middle) * seen.turn[1:]).real)
    assert np.all(abs(middle * moving - fixed) < 1e-3 * abs(fixed))


def test_parallelogram():
    """Crank and rocker of a parallelogram translate against one another; so does the coupler against the frame."""
    motion = move(FourBar(25, 70, 25, 70).linkage(), np.radians([40, 80]), speed=1, branch="+")
    found = poles(motion)
    assert found.at_infinity[:, found.links.index("frame"), found.links.index("coupler")].all()
    assert np.allclose(
        np.abs((found.towards("frame", "coupler") * np.exp(-1j * np.radians([40, 80]))).imag), 0, atol=1e-12
    )
    assert np.isnan(found.of("crank", "rocker")).all()


def test_links_at_rest_have_no_pole():
    motion = move(FourBar(25, 70, 40, 70).linkage(), np.radians([55]), speed=0)
    found = poles(motion)
    assert np.isnan(found.at).all()
    assert np.isnan(found.direction).all()
    assert np.isnan(centrodes(motion, "coupler").fixed).all()


def test_far_from_the_origin():
    """The place of the linkage in the plane does not matter to the digits."""
    linkage = FourBar(25, 70, 40, 70).linkage()
    away = linkage._changed(
        elements={**linkage._by_link(), "frame": {0: (1e6, 2e6), 3: (1e6 + 70, 2e6)}},
    )
    found, moved_off = (poles(move(each, np.radians([55]), speed=10, branch="+")) for each in (linkage, away))
    assert np.allclose(moved_off.at - (1e6 + 2e6j), found.at, rtol=0, atol=1e-6, equal_nan=True)


def test_wrong_calls():
    motion = move(FourBar(25, 70, 40, 70).linkage(), [0.1])
    with pytest.raises(LinkageError, match="poles need velocities"):
        poles(motion)
    with pytest.raises(LinkageError, match=r"needs velocities.*speed=\.\.\., order=1"):
        centrodes(motion, "coupler")
    moving = move(FourBar(25, 70, 40, 70).linkage(), [0.1], speed=1)
    with pytest.raises(LinkageError, match=r"no link 'cupler'.*coupler"):
        poles(moving).of("cupler", "frame")
    with pytest.raises(LinkageError, match="no link 'cupler'"):
        poles(moving, ["cupler"])
    with pytest.raises(LinkageError, match="none was named"):
        poles(moving, [])
    with pytest.raises(LinkageError, match="against itself"):
        centrodes(moving, "crank", "crank")
