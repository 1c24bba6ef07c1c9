"""Side force and friction of slides: figures of the teaching documents, and the general solution against them."""

import numpy as np
import pytest

from gruebler.errors import LinkageError
from gruebler.forces import Loads, slide_friction, slider_friction, statics
from gruebler.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.kinematics import move


@pytest.mark.parametrize(
    ("size", "worst", "alpha"),
    [
        (SliderCrank(2, 5), 90, 23.578178478201835),
        (SliderCrank(2, 10), 90, 11.536959032815489),
        (SliderCrank(3, 5, -1), 90, 53.13010235415599),  # e lies so that the crank leans a + e
        (SliderCrank(3, 5, -1), 270, -23.578178478201835),
    ],
)
def test_literature(size, worst, alpha):
    """Documents 000/003, section 3.4: alpha_max, F_N = F_K sin(alpha), F_R = mu_R F_N."""
    found = slider_friction(size, np.radians([worst]), 100.0, 0.2)
    assert np.degrees(found.alpha) == pytest.approx([alpha], rel=1e-12)
    assert found.coupler * np.cos(found.alpha) == pytest.approx([100])
    assert found.side == pytest.approx(found.coupler * np.sin(np.radians(alpha)))
    assert found.friction == pytest.approx(0.2 * np.abs(found.side))


@pytest.mark.parametrize("e", [0.0, 6.0, -6.0])
def test_rivals(e):
    """The closed form and the equilibrium of all links."""
    size, phi = SliderCrank(20, 50, e), np.linspace(0.1, 6.2, 40)
    motion = move(size.linkage(), phi)
    held = statics(motion, Loads({"R(coupler-slider)": (-100, 0)}))
    closed, general = slider_friction(size, phi, 100.0, 0.1), slide_friction(held, "P(frame-slider)", 0.1)
    assert np.allclose(general.side, np.abs(closed.side))
    assert np.allclose(general.friction, closed.friction)
    assert np.allclose(np.hypot(*held.force("R(coupler-slider)").T), closed.coupler)
    assert np.allclose(general.effort, closed.friction * np.abs(move(size.linkage(), phi, speed=1).displacement(3, 1)))
    assert np.sign(held.force("P(frame-slider)")[:, 1]).tolist() == np.sign(closed.side).tolist()


def test_a_smaller_ratio_rubs_less():
    """Document 000, 3.4: the smaller the crank-conrod ratio, the smaller the deviation angle and the friction."""
    phi = np.linspace(0, 2 * np.pi, 50)
    worst = [slider_friction(SliderCrank(2, b), phi, 1.0, 0.1).friction.max() for b in (4, 5, 10, 40)]
    assert worst == sorted(worst, reverse=True)


def test_a_block_in_a_guide():
    guide = InvertedSliderCrank(25, 60).linkage()
    held = statics(move(guide, [0.7, 0.9]), Loads(moments={guide.mechanism.chain.links[-1]: 100}))
    joints = guide.mechanism.chain
    number = next(k for k, j in enumerate(joints.joints) if j.pair.name in ("prismatic", "roll_slide"))
    found = slide_friction(held, number, 0.3)
    assert np.allclose(found.friction, 0.3 * np.hypot(*held.force(number).T))


def test_wrong_calls():
    with pytest.raises(LinkageError, match="is not negative"):
        slider_friction(SliderCrank(2, 5), 0.1, 1.0, -0.1)
    with pytest.raises(LinkageError, match=r"sin\(alpha\) = 1.2"):
        slider_friction(SliderCrank(6, 5), np.pi / 2, 1.0, 0.1)
    with pytest.raises(LinkageError, match="load"):
        slider_friction(SliderCrank(2, 5), 0.1, float("nan"), 0.1)
    held = statics(move(FourBar(25, 70, 40, 70).linkage(), [0.1]), Loads(moments={"rocker": 1}))
    with pytest.raises(LinkageError, match="does not slide"):
        slide_friction(held, "R(frame-rocker)", 0.1)
