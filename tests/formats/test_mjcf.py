"""Models for MuJoCo: the tree, the loops; where MuJoCo is installed, its points are where those of the linkage are."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler import files
from gruebler.formats.mjcf import mjcf_from_linkage
from gruebler.fourbar import FourBar, SliderCrank
from gruebler.kinematics import move

FOLDER = Path(__file__).parent / "files"
CASES = {
    "four-bar": FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}),
    "slider-crank": SliderCrank(25, 70, 5).linkage({"K": (45, 40)}),
    "jansen": files.read(FOLDER / "jansen.linkage2", left_out=[]),
    "klann": files.read(FOLDER / "klann.linkage2", left_out=[]),
    "shaper": files.read(FOLDER / "shaper.pmks", left_out=[]).with_points({"K": ("DR", 0.3, 0.2)}),
}


@pytest.mark.parametrize("name", CASES)
def test_a_model_has_every_link_once_and_closes_every_loop(name):
    linkage = CASES[name]
    chain = linkage.mechanism.chain
    root = ElementTree.fromstring(mjcf_from_linkage(linkage, []))
    bodies = [body.get("name") for body in root.iter("body")]
    assert sorted(bodies) == sorted(set(bodies))
    assert set(bodies) >= set(chain.links) - {linkage.mechanism.frame}
    assert len(list(root.iter("joint"))) == len(bodies)
    assert len(root.findall("equality/connect")) == chain.loops
    assert {site.get("name") for site in root.iter("site") if site.get("name")} == set(linkage.points)


@pytest.mark.parametrize("name", CASES)
def test_a_model_runs_a_whole_turn_as_the_linkage_does(name):
    mujoco = pytest.importorskip("mujoco")
    linkage = CASES[name]
    model = mujoco.MjModel.from_xml_string(mjcf_from_linkage(linkage, []))
    data = mujoco.MjData(model)
    drive = linkage.mechanism.drive_names()[0]
    joint = model.joint(drive)
    from gruebler.formats.pin_drawings import lower_linkage

    lower = lower_linkage(linkage)
    first, other = lower.reference(0)
    begin = lower.required_pose[other].angle - lower.required_pose[first].angle
    sign = model.actuator_gear[0, 0]
    steps = 4000
    worst, checked = 0.0, 0
    for k in range(steps + 1):
        data.ctrl[0] = 2 * np.pi * k / steps
        mujoco.mj_step(model, data)
        if k % 200 == 0:
            mujoco.mj_kinematics(model, data)  # places of the joints as they are after the step
            turned = sign * data.qpos[joint.qposadr[0]]
            path = begin + np.linspace(0, turned, 50)
            motion = move(lower, path)
            assert motion.complete
            for point in linkage.points:
                mine = motion.point(point)[-1]
                scale = {"mm": 1e-3, "cm": 1e-2}[linkage.unit]
                there = data.site(point).xpos[:2] / scale
                worst, checked = max(worst, np.abs(there - mine).max() / linkage.size), checked + 1
    assert worst < 1e-3
    assert abs(turned) > 6
    assert checked or not linkage.points
