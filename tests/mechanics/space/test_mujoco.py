"""Loops in space against MuJoCo: its poses and Jacobians of an open tree, closed by Newton's method here."""

from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler.mechanics.space import RSSR, move
from tests.mechanics.screws import machines
from tests.mechanics.space.test_overconstrained_loops import schatz, trihedral

mujoco = pytest.importorskip("mujoco", reason="poses in space are compared with MuJoCo")

KINDS = {"R": "hinge", "P": "slide", "S": "ball"}


def opened(linkage):
    """A model of the joints as a tree, all bodies at the origin in the reference pose, and the joints that are left."""
    chain = linkage.mechanism.chain
    root = ElementTree.Element("mujoco")
    bodies = {linkage.mechanism.frame: ElementTree.SubElement(root, "worldbody")}
    left = list(range(len(chain.joints)))
    while len(bodies) < chain.n:
        number = next(k for k in left if len(bodies.keys() & {*chain.joints[k].links}) == 1)
        left.remove(number)
        joint, place = chain.joints[number], linkage.places[number]
        first, second = sorted(joint.links, key=lambda link: link not in bodies)
        body = ElementTree.SubElement(bodies[first], "body", name=second)
        ElementTree.SubElement(body, "inertial", mass="1", pos="0 0 0", diaginertia="1 1 1")
        kind = KINDS[str(joint.pair.symbol())]
        given = {"name": str(number), "type": kind, "pos": " ".join(map(repr, map(float, place.at)))}
        if kind != "ball":
            axis = np.array(place.z or place.x) * (1 if first == joint.links[0] else -1)
            given["axis"] = " ".join(map(repr, axis.tolist()))
        ElementTree.SubElement(body, "joint", given)
        bodies[second] = body
    return mujoco.MjModel.from_xml_string(ElementTree.tostring(root, "unicode")), left


def meeting_points(linkage, left):
    """Points of two links that coincide if the joints that are left are closed: (first link, second link, point)."""
    for number in left:
        place = linkage.places[number]
        for along in [0.0] if place.z is None else [0.0, linkage.size]:
            yield *linkage.mechanism.chain.joints[number].links, place.at + along * np.array(place.z or (0, 0, 0))


LOOPS = {
    "bennett": lambda: machines.bennett()[0],
    "goldberg 6R": lambda: machines.goldberg(6),
    "sarrus": machines.sarrus,
    "schatz": schatz,
    "bricard trihedral": trihedral,
    "universal joint": machines.hooke,
    "rssr": lambda: RSSR(a=0.3, b=1.4, c=0.8, d=1, twist=0.7, rocker_offset=0.4).linkage(0.3),
}


@pytest.mark.parametrize("make", LOOPS.values(), ids=LOOPS)
def test_loops_have_the_poses_of_mujoco(make):
    linkage = make().with_drives([0])
    chain = linkage.mechanism.chain
    model, left = opened(linkage)
    points = list(meeting_points(linkage, left))
    data = mujoco.MjData(model)
    first = model.joint("0")
    free = [k for k in range(model.nv) if k != first.dofadr[0]]
    numbers = {link: model.body(link).id if link != linkage.mechanism.frame else 0 for link in chain.links}
    turns = np.linspace(0, 0.9, 19)
    motion = move(linkage, turns)
    assert motion.complete
    for row, turn in enumerate(turns):
        data.qpos[first.qposadr[0]] = turn
        for _ in range(12):
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            gaps, slopes = [], []
            for one, other, point in points:
                ends, jacobians = [], []
                for link in (one, other):
                    body, jacobian = numbers[link], np.zeros((3, model.nv))
                    ends.append(data.xmat[body].reshape(3, 3) @ point + data.xpos[body])
                    mujoco.mj_jac(model, data, jacobian, None, ends[-1], body)
                    jacobians.append(jacobian)
                gaps.append(ends[1] - ends[0])
                slopes.append(jacobians[1] - jacobians[0])
            gap = np.concatenate(gaps)
            if abs(gap).max() < 1e-13 * linkage.size:
                break
            step = np.zeros(model.nv)
            step[free] = -np.linalg.lstsq(np.concatenate(slopes)[:, free], gap, rcond=1e-9)[0]
            mujoco.mj_integratePos(model, data.qpos, step, 1.0)
        assert abs(gap).max() < 1e-11 * linkage.size
        for link in {*chain.links} - {*motion.idle}:
            pose = motion.pose(link)[row]
            assert data.xmat[numbers[link]].reshape(3, 3) == pytest.approx(pose[:3, :3], abs=1e-9)
            assert data.xpos[numbers[link]] == pytest.approx(pose[:3, 3], abs=1e-9 * linkage.size)
