"""Robots in URDF: a tree that hangs where the linkage has its links, in every position."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler.files import values as files
from gruebler.files.pin_drawings import lower_linkage
from gruebler.files.urdf import urdf_from_linkage
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move

FOLDER = Path(__file__).parent / "samples"
CASES = {
    "four-bar": FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}),
    "slider-crank": SliderCrank(25, 70, 5).linkage({"K": (45, 40)}),
    "jansen": files.read(FOLDER / "jansen.linkage2", left_out=[]),
    "shaper": files.read(FOLDER / "shaper.pmks", left_out=[]).with_points({"K": ("DR", 0.3, 0.2)}),
}


@pytest.mark.parametrize("name", CASES)
def test_a_robot_is_a_tree_of_all_links_and_says_where_it_is_cut(name, tmp_path):
    linkage, left_out = CASES[name], []
    root = ElementTree.parse(files.write(linkage, tmp_path / "a.urdf", left_out=left_out)).getroot()
    links = [link.get("name") for link in root.findall("link")]
    joints = root.findall("joint")
    lower = lower_linkage(linkage)
    assert sorted(links) == sorted([*lower.mechanism.chain.links, *linkage.points])
    children = [joint.find("child").get("link") for joint in joints]
    assert sorted([*children, linkage.mechanism.frame]) == sorted(links)
    assert len(joints) == len(links) - 1
    (cut,) = (str(note) for note in left_out if "the loops" in str(note))
    missing = set(lower.mechanism.chain.joint_names()) - {joint.get("name") for joint in joints}
    assert all(joint in cut for joint in missing)


def numbers(element, key):
    return np.array([float(number) for number in element.get(key, "0 0 0").split()])


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("step", [0.0, 0.3, -0.2])
def test_links_hang_where_the_linkage_has_them(name, step):
    """Down the tree with the positions of the joints, by numpy; and by MuJoCo, where it is installed."""
    linkage = CASES[name]
    lower = lower_linkage(linkage)
    scale = {"mm": 1e-3, "cm": 1e-2}[lower.unit]
    one, other = lower.reference(0)
    home = lower.required_pose
    motion = move(lower, home[other].angle - home[one].angle + np.linspace(0, step, 20))
    assert motion.complete
    pose = motion.pose(len(motion) - 1)
    text = urdf_from_linkage(linkage, [])
    root = ElementTree.fromstring(text)
    names = list(lower.mechanism.chain.joint_names())
    frames, values = {linkage.mechanism.frame: (0j, 0.0)}, {}
    for joint in root.findall("joint"):
        above, child = joint.find("parent").get("link"), joint.find("child").get("link")
        place, turn = frames[above]
        x, y, _ = numbers(joint.find("origin"), "xyz")
        place, turn = place + complex(x, y) * np.exp(1j * turn), turn + numbers(joint.find("origin"), "rpy")[2]
        number = names.index(joint.get("name")) if joint.get("name") in names else None
        if joint.get("type") == "continuous":
            value = (pose[child].angle - pose[above].angle) - (home[child].angle - home[above].angle)
            turn += value
        elif joint.get("type") == "prismatic":
            mine, line = lower.elements[number, child], lower.elements[number, above]
            along = np.exp(1j * line.direction)
            there = [
                complex(*at[above].to_local(*at[child].put(mine.x, mine.y))) * along.conjugate() for at in (home, pose)
            ]
            axis = complex(*numbers(joint.find("axis"), "xyz")[:2]) * np.exp(1j * turn)
            sign = (axis * np.exp(-1j * pose[above].angle) * along.conjugate()).real
            value = (there[1] - there[0]).real * sign * scale
            place += axis * value
        else:
            value = 0.0
        values[joint.get("name")] = value
        frames[child] = place, turn
        if child in pose:
            near = lower.elements[number, child] if number is not None else None
            if near is not None:
                assert place == pytest.approx(complex(*pose[child].put(near.x, near.y)) * scale, abs=1e-9)
            assert np.exp(1j * turn) == pytest.approx(np.exp(1j * pose[child].angle), abs=1e-9)
        else:
            assert place == pytest.approx(motion.complex_point(child)[-1] * scale, abs=1e-9)
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    for k in range(model.njnt):
        data.qpos[model.jnt_qposadr[k]] = values[model.joint(k).name]
    mujoco.mj_kinematics(model, data)
    for k in range(1, model.nbody):
        place, _ = frames[model.body(k).name]
        assert data.xpos[k][:2] == pytest.approx([place.real, place.imag], abs=1e-9)
