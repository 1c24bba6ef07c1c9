"""Models for MuJoCo: the tree, the loops; where MuJoCo is installed, its points are where those of the linkage are."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.base.units import MILLIMETRES
from gruebler.files import values as files
from gruebler.files.mjcf import mjcf_from_linkage
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.teaching.catalog import entries

FOLDER = Path(__file__).parent / "samples"
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
    from gruebler.files.linkage_drawings import lower_linkage

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


LINKAGES = {path.name: files.read(path, left_out=[]) for path in sorted(FOLDER.iterdir()) if path.suffix != ".md"} | {
    name: each.linkage() for name, each in entries().items() if each.dimensions is not None
}
ROLLING = {
    "belt",
    "cam",
    "cam_rocker",
    "cam_rocker_flat",
    "cam_roller",
    "diff",
    "diff2p",
    "elliptic_gears",
    "friction_forced",
    "friction_rigid",
    "geartrain",
    "geneva",
    "winch_plane",
}
"""With wheels, cams, a star wheel."""


@pytest.mark.parametrize("name", sorted(LINKAGES))
def test_mujoco_takes_every_linkage_of_pins_and_slides(name):
    """Where it stands all loops are closed, and each drive has an actuator and a joint of its own."""
    mujoco = pytest.importorskip("mujoco")
    linkage = LINKAGES[name]
    if name in ROLLING:
        with pytest.raises(GrueblerError, match="turning and sliding joints only"):
            mjcf_from_linkage(linkage, [])
        return
    model = mujoco.MjModel.from_xml_string(mjcf_from_linkage(linkage, []))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scale = MILLIMETRES.get(linkage.unit, 1000) / 1000  # metres, if the unit is none
    assert np.abs(data.efc_pos[: data.ne]).max(initial=0) < 1e-9 * linkage.size * scale
    moved = model.actuator_trnid[:, 0].tolist()
    assert len(moved) == len(set(moved)) == len(linkage.mechanism.drives)


def test_two_drives_at_one_pin_move_two_links():
    """Both against the frame, as in an arm of Pyslvs; the pin carries three links and has two joints of the model."""
    mujoco = pytest.importorskip("mujoco")
    arm = LINKAGES["arm.pyslvs"]
    model = mujoco.MjModel.from_xml_string(mjcf_from_linkage(arm, []))
    data = mujoco.MjData(model)
    home = arm.required_pose
    begin = np.array([home[b].angle - home[a].angle for a, b in map(arm.reference, range(2))])
    to, steps = np.array([0.1, -0.15]), 2000
    for k in range(steps + 500):
        data.ctrl[:] = to * min(1, k / steps)
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    motion = move(arm, begin + np.linspace(0, 1, 50)[:, None] * to)
    for point in arm.points:
        there = data.site(point).xpos[:2] * 1000
        np.testing.assert_allclose(there, motion.point(point)[-1], atol=1e-3 * arm.size)


@pytest.mark.parametrize("size", [1e-3, 0.1, 1.0, 100.0])
def test_small_models_are_heavier_which_is_said(size):
    mujoco = pytest.importorskip("mujoco")
    left_out = []
    text = mjcf_from_linkage(FourBar(0.25, 0.7, 0.4, 0.7).linkage(unit="cm").scaled(size), left_out)
    model = mujoco.MjModel.from_xml_string(text)
    assert any("density of steel" in str(note) for note in left_out) == (size <= 1)  # 7 mm
    assert model.body_inertia[1:].min() > 1e-15
    with pytest.raises(GrueblerError, match="too small for a model of MuJoCo"):
        mjcf_from_linkage(FourBar(0.25, 0.7, 0.4, 0.7).linkage(unit="mm").scaled(1e-9), [])


def test_a_link_may_be_called_world():
    """MuJoCo calls the frame so; and names of the file's language are other names, too."""
    mujoco = pytest.importorskip("mujoco")
    linkage: Linkage = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}).renamed({"coupler": "world", "crank": "<a&b>"})
    model = mujoco.MjModel.from_xml_string(mjcf_from_linkage(linkage, []))
    assert {model.body(k).name for k in range(model.nbody)} == {"world", "world (link)", "<a&b>", "rocker"}
