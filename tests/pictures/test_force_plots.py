"""Plots of forces in motion: their curves carry the figures that stand beside them, by hand or by the values."""

import re

import numpy as np
import pytest

import gruebler as gr
from gruebler.mechanics.forces import Friction
from gruebler.pictures.linkage.force_plots import effort_plot, force_plot

ENGINE = gr.SliderCrank(30, 50).linkage()
PISTON = gr.Loads(bodies={"slider": gr.RigidBody(2.0)}, gravity=(0.0, 0.0))


def run(loads=PISTON, friction=None, step=5, stop=360):
    motion = gr.move(ENGINE, gr.from_degrees(0, stop, step), speed=100.0)
    return gr.inverse_dynamics(motion, loads, friction=friction)


def texts(figure):
    return re.findall(r"<text[^>]*>(.*?)</text>", figure.svg())


def test_torque_and_power():
    figure = effort_plot(run())
    assert figure.title == "slider-crank: torque and power of the drive"
    assert {"M in N·m", "P in W", "mean"} <= set(texts(figure))
    german = effort_plot(run(), lang="de")
    assert "Moment und Leistung des Antriebs" in german.title
    assert "Mittelwert" in texts(german)


def test_the_mean_is_the_work_by_the_way():
    """A brake of 8 N m on the crank: the mean is 8 N m, whatever inertia does; its line stands on the tick there."""
    braked = run(gr.Loads(moments={"crank": -8000.0}, bodies=PISTON.bodies, gravity=(0.0, 0.0)), step=1)
    figure = effort_plot(braked)
    height = float(re.search(r'class="gr-dead" d="M[\d.]+ ([\d.]+)L', figure.svg())[1])
    ticks = re.findall(r'y="([\d.]+)" text-anchor="end">(0|10)</text>', figure.svg())
    high, low = (float(next(y for y, text in ticks if text == tick)) - 4 for tick in ("10", "0"))  # 4: of the letters
    assert 10 * (low - height) / (low - high) == pytest.approx(8, abs=0.1)


def test_friction_has_both_curves():
    shown = texts(effort_plot(run(friction=Friction(0.1, pin_radius=5)), lang="de"))
    assert {"mit Reibung", "ohne Reibung"} <= set(shown)


def test_joint_forces_in_polar_form():
    """At 0° the crank's bearing carries m r w² (1 + r/l) = 960 N on the frame, away from the centre."""
    figure = gr.plot(run(), "forces").figure
    assert "R(frame-crank) on frame" in texts(figure)
    tip = run().statics.force("R(frame-crank)", link="frame")[0]
    np.testing.assert_allclose(tip, [2 * 0.03 * 100**2 * 1.6, 0.0], rtol=1e-12, atol=1e-9)
    assert {"0°", "500", "1000"} <= set(texts(figure))  # the axis goes on to the tip
    assert "R(coupler-slider) on slider" in gr.plot(run(), "forces", points=["R(coupler-slider)"]).svg()


def test_the_phase_plane_of_free_motion():
    loads = gr.Loads(bodies={"coupler": gr.RigidBody(0.5, (35, 0), 200.0)})
    fall = gr.simulate(gr.FourBar(25, 70, 40, 70), loads, until=0.1, at=1.0, tolerance=1e-6)
    for picture in (gr.plot(fall), gr.plot(fall, "phase", lang="de")):
        assert {"φ in °", "ω in rad/s"} <= set(texts(picture.figure))
    assert "Phasenebene" in gr.plot(fall, lang="de").figure.title


def test_what_has_no_diagram():
    with pytest.raises(gr.GrueblerError, match=r"there is no plot 'phase'.*there are torque, forces"):
        gr.plot(run(), "phase")
    with pytest.raises(gr.GrueblerError, match="one drive and two rows or more"):
        gr.plot(run(stop=0))
    with pytest.raises(gr.GrueblerError, match="has no option 'output'"):
        gr.plot(run(), output="slider")
    with pytest.raises(gr.GrueblerError, match="1 to 8 points or joints"):
        force_plot(run(), [])
