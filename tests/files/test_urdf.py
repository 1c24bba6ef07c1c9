"""Robots in URDF: a tree that hangs where the linkage has its links, in every position."""

from math import asin, atan2
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.files import values as files
from gruebler.files.linkage_drawings import lower_linkage
from gruebler.files.urdf import urdf_from_linkage
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.screws import SpatialLinkage, exponential
from gruebler.mechanics.space import move as move_in_space
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries

FOLDER = Path(__file__).parent / "samples"
CASES = {
    "four-bar": FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}),
    "slider-crank": SliderCrank(25, 70, 5).linkage({"K": (45, 40)}),
    "jansen": files.read(FOLDER / "jansen.linkage2", left_out=[]),
    "shaper": files.read(FOLDER / "shaper.pmks", left_out=[]).with_points({"K": ("DR", 0.3, 0.2)}),
}


def number_of(chain, name):
    """Of the joint of the linkage that a joint of the robot is or belongs to."""
    return next(k for k, each in enumerate(chain.joint_names()) if name == each or name.startswith(f"{each} "))


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
    chain = lower.mechanism.chain
    made = {number_of(chain, joint.get("name")) for joint in joints if joint.get("type") != "fixed"}
    missing = [name for number, name in enumerate(chain.joint_names()) if number not in made]
    assert missing or any(joint.count > 1 for joint in chain.joints)
    assert all(joint in cut for joint in missing)


def numbers(element, key):
    return np.array([float(number) for number in element.get(key, "0 0 0").split()])


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("step", [0.0, 0.3, -0.2])
def test_links_in_the_plane_hang_where_the_linkage_has_them(name, step):
    """Down the tree with the positions of the joints, by numpy; and by MuJoCo, where it is installed."""
    linkage = CASES[name]
    lower = lower_linkage(linkage)
    scale = {"mm": 1e-3, "cm": 1e-2}[lower.unit]
    home = lower.required_pose
    start = np.subtract(*(home[link].angle for link in lower.reference(0)[::-1]))
    motion = move(lower, start + np.linspace(0, step, 20))
    pose = motion.pose(len(motion) - 1)
    text = urdf_from_linkage(linkage, [])
    root = ElementTree.fromstring(text)
    names = list(lower.mechanism.chain.joint_names())
    frames, values = {linkage.mechanism.frame: (0j, 0.0)}, {}  # place, turn since the reference pose
    starts = {linkage.mechanism.frame: 0j}  # places in the reference pose
    for joint in root.findall("joint"):
        above, child = joint.find("parent").get("link"), joint.find("child").get("link")
        place, turn = frames[above]
        x, y, _ = numbers(joint.find("origin"), "xyz")
        assert not numbers(joint.find("origin"), "rpy").any()
        starts[child] = starts[above] + complex(x, y)
        place += complex(x, y) * np.exp(1j * turn)
        value = 0.0
        if joint.get("type") == "continuous":
            value = (pose[child].angle - pose[above].angle) - (home[child].angle - home[above].angle)
            turn += value
        elif joint.get("type") == "prismatic":
            axis = complex(*numbers(joint.find("axis"), "xyz")[:2]) * np.exp(1j * turn)
            start = starts[child] / scale
            there = complex(*pose[child].put(*home[child].to_local(start.real, start.imag))) * scale
            value = ((there - place) * axis.conjugate()).real
            place += axis * value
        values[joint.get("name")] = value
        frames[child] = place, turn
        if child in pose:
            start = starts[child] / scale
            there = complex(*pose[child].put(*home[child].to_local(start.real, start.imag))) * scale
            assert place == pytest.approx(there, abs=1e-9)
            assert np.exp(1j * turn) == pytest.approx(np.exp(1j * (pose[child].angle - home[child].angle)), abs=1e-9)
            if joint.get("name") in names and joint.get("type") == "continuous":
                pin = lower.elements[names.index(joint.get("name")), child]
                assert place == pytest.approx(complex(*pose[child].put(pin.x, pin.y)) * scale, abs=1e-9)
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


# --- in space ----------------------------------------------------------------------------------------

IN_SPACE = {name: each.placed() for name, each in entries().items() if each.in_space and each.drives}


def freedoms_between(linkage, motion, number, above, child):
    """The freedoms of a joint from the upper link to the lower one with their values in the last pose."""
    chain, frame = linkage.mechanism.chain, linkage.frames[number]
    a, b = (motion.pose(link)[-1] @ frame for link in (above, child))
    seen = np.linalg.inv(a) @ b
    r, d = seen[:3, :3], seen[:3, 3]
    links = chain.joints[number].links
    if links.index(above) < links.index(child):  # shifts, then turns about x, y, z
        x, y, z = atan2(-r[1, 2], r[2, 2]), asin(min(1, max(-1, r[0, 2]))), atan2(-r[0, 1], r[0, 0])
    else:  # turns about z, y, x, then shifts
        x, y, z = atan2(r[2, 1], r[2, 2]), asin(min(1, max(-1, -r[2, 0]))), atan2(r[1, 0], r[0, 0])
        d = r.T @ d
    return dict(zip(("Rx", "Ry", "Rz", "Tx", "Ty", "Tz"), (x, y, z, *d), strict=True))


def values_of_joints(root, linkage, motion, scale):
    """The value of every joint of a robot in the last pose of a motion, by its name."""
    chain = linkage.mechanism.chain
    above = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
    values = {}
    for link in {*chain.links} - {linkage.mechanism.frame}:
        row = [above[link]]
        while (upper := row[0].find("parent").get("link")) not in chain.links:
            row.insert(0, above[upper])
        number = number_of(chain, row[0].get("name"))
        found = freedoms_between(linkage, motion, number, upper, link)
        pair = chain.joints[number].pair
        for joint in row:
            freedom = joint.get("name").rsplit(" ", 1)[1] if len(row) > 1 else str(pair.freedoms[chain.space][0])
            values[joint.get("name")] = found[freedom] * (scale if freedom[0] == "T" else 1)
    return values


@pytest.mark.parametrize("name", IN_SPACE)
def test_links_in_space_hang_where_the_linkage_has_them(name, tmp_path):
    """Down the tree by numpy, and by yourdfpy where it is installed; lengths in metres, a sphere of 100 mm."""
    linkage, left_out = IN_SPACE[name], []
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    path = files.write(linkage, tmp_path / "robot.urdf", left_out=left_out)
    root = ElementTree.parse(path).getroot()
    spherical = str(chain.space) == "spherical"
    scale = 0.1 if spherical else {"mm": 1e-3}[linkage.unit]
    steps = [0.3 if drive.turning else 0.1 * linkage.size for drive in linkage.mechanism.drives]
    motion = move_in_space(linkage, np.linspace(0, 1, 10)[:, None] * np.array(steps))
    assert motion.complete
    values = values_of_joints(root, linkage, motion, scale)
    starts, frames = {frame: np.zeros(3)}, {frame: np.eye(4)}
    for joint in root.findall("joint"):
        above, child = joint.find("parent").get("link"), joint.find("child").get("link")
        origin, value = numbers(joint.find("origin"), "xyz"), values.get(joint.get("name"), 0.0)
        starts[child] = starts[above] + origin
        twist = np.zeros(6)
        if joint.get("type") != "fixed":
            twist[3 * (joint.get("type") == "prismatic") :][:3] = value * numbers(joint.find("axis"), "xyz")
        frames[child] = frames[above] @ exponential([0, 0, 0, *origin]) @ exponential(twist)
        follows = joint.find("mimic")
        if follows is not None:
            assert value == pytest.approx(float(follows.get("multiplier")) * values[follows.get("joint")], abs=1e-12)
    assert set(chain.links) <= set(frames)
    for link in chain.links:
        home = np.eye(4)
        home[:3, 3] = starts[link]
        pose = motion.pose(link)[-1].copy()
        pose[:3, 3] *= scale
        assert frames[link] == pytest.approx(pose @ home, abs=1e-9)
    for point, (link, place) in linkage.points.items():
        at = motion.pose(link)[-1] @ (*place, 1)
        assert frames[point][:3, 3] == pytest.approx(at[:3] * scale, abs=1e-9)
    (cut,) = (str(note) for note in left_out if "the loops" in str(note))
    joined = {number_of(chain, each) for each in values}
    assert len(joined) == chain.n - 1
    assert all(each in cut for number, each in enumerate(chain.joint_names()) if number not in joined)
    yourdfpy = pytest.importorskip("yourdfpy", reason="robots are read by a reader of URDF")
    robot = yourdfpy.URDF.load(str(path), load_meshes=False)
    assert robot.validate()
    robot.update_cfg({each: values[each] for each in robot.actuated_joint_names})
    for link, pose in frames.items():
        assert robot.get_transform(link, frame) == pytest.approx(pose, abs=1e-9)


def test_masses_of_links_are_those_of_their_bars():
    """A rocker of one bar: a cylinder of steel with the inertia of a rod about its middle, by hand."""
    linkage = IN_SPACE["wiper_rssr"]
    root = ElementTree.fromstring(urdf_from_linkage(linkage, []))
    (crank,) = (link for link in root.findall("link") if link.get("name") == "crank")
    shape = crank.find("visual/geometry/cylinder")
    radius, length = float(shape.get("radius")), float(shape.get("length"))
    names = linkage.mechanism.chain.joint_names()
    ends = [linkage.places[names.index(each)].at for each in ("R(body-crank)", "S(crank-rod)")]
    assert length == pytest.approx(np.linalg.norm(np.subtract(*ends)) / 1000)
    mass = 7850 * np.pi * radius**2 * length
    assert float(crank.find("inertial/mass").get("value")) == pytest.approx(mass)
    tensor = crank.find("inertial/inertia")
    trace = sum(float(tensor.get(each)) for each in ("ixx", "iyy", "izz"))
    assert trace == pytest.approx(mass * (length**2 / 6 + radius**2))


def test_a_link_that_only_contacts_hold_is_refused():
    wheel = {"at": (1, 0, 0), "y": (1, 0, 0), "radii": (1, 1)}
    rolling = Mechanism.parse("R(0-1) W(1-2) W(0-2)")
    linkage = SpatialLinkage(rolling, {0: (0, 0), 1: wheel, 2: wheel | {"at": (3, 0), "radii": (-3, -1)}})
    with pytest.raises(GrueblerError, match="2 is held by contacts alone"):
        urdf_from_linkage(linkage, [])
