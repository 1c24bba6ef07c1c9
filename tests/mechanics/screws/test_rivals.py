"""Independent methods: the dimension of the set of positions from samples of it, and circuits along their length."""

from dataclasses import astuple
from math import cos, sin

import numpy as np
import pytest

from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import circuit
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import Closing, SpatialLinkage, exponential, freedoms
from gruebler.mechanics.screws.closed_poses import closed_pose
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries
from tests.mechanics.screws import machines as m

EXAMPLES = {
    "loco2": m.locomotive(2),
    "loco3": m.locomotive(3),
    "loco4": m.locomotive(4),
    "loco3 wrong": m.locomotive(3, error=0.01),
    "flat loco2": m.locomotive(2, angle=0.0),
    "flat loco3": m.locomotive(3, angle=0.0),
    "strut": m.strut(),
    "strut off": m.strut(0.1),
    "friction": m.friction(),
    "arm on the axis": m.friction_arm((0.0, 0.0)),
    "gears": m.gears(),
    "dwell": m.geneva_dwell(),
    "scissors": m.two_scissors(3.0),
    "planets": m.differential(2),
    "winch": m.winch(),
    "winch tilted": m.winch(0.1),
    "bevel": m.bevel(2),
    "bennett": m.bennett()[0],
    "bennett off": m.bennett(error=0.01)[0],
    "sarrus": m.sarrus(),
    "hooke": m.hooke(),
    "cardan": m.cardan(),
    "stretched triangle": m.planar("R(0-1) R(1-2) R(0-2)", {0: (0, 0), 1: (1, 0), 2: (3, 0)}),
    "stretched five-bar": m.planar(
        "R(0-1) R(1-2) R(2-3) R(3-4) R(0-4)", {0: (0, 0), 1: (1, 0), 2: (3, 0), 3: (2, 0), 4: (6, 0)}
    ),
}


def sampled_dimension(closing, pose):
    """Throw poses near this one, let Gauss and Newton's method close them, and count the free velocities there.

    Poses that fall back to the start, or do not close, are no other positions. Nothing of the Lyapunov-Schmidt map.
    """
    random = np.random.default_rng(11)
    dimensions = [0]
    for _ in range(25):
        start = closing.moved(pose, 0.1 * random.normal(size=closing.unknowns))
        found = closing.settled(start, tolerance=1e-14, most=80)
        if abs(closing.residual(found)).max() < 1e-12 and 5e-3 < abs(found - pose).max() < 0.5:
            values = np.linalg.svd(closing.linearised(found)[1], compute_uv=False)
            dimensions.append(closing.unknowns - int(np.sum(values > 1e-7 * values[0])))
    return max(dimensions)


@pytest.mark.parametrize("name", EXAMPLES)
def test_samples_of_the_set_of_positions(name):
    closing = Closing.of(EXAMPLES[name])
    assert freedoms(EXAMPLES[name]).mobility == sampled_dimension(closing, closing.reference)


def cranks(third):
    """Three parallel equal cranks; the axle of the third anywhere."""
    text = "R(0-1) R(0-2) R(0-3) R(1-p) R(2-p) R(3-p); drive=R(0-1)"
    feet = [(0.0, 0.0), (3.0, 0.0), third]
    names = ["R(0-1)", "R(0-2)", "R(0-3)", "R(1-p)", "R(2-p)", "R(3-p)"]
    heads = [(x + cos(0.7), y + sin(0.7)) for x, y in feet]
    return Linkage.from_drawing(Mechanism.parse(text), dict(zip(names, [*feet, *heads], strict=True)))


def test_circuits_of_cranks():
    moving = cranks((6.0, 1.0))
    assert freedoms(moving).mobility == 1
    assert circuit(moving).closed
    home = {name: tuple(place) for name, place in moving.reference_pose.items()}
    elements = {link: {n: astuple(e) for (n, owner), e in moving.elements.items() if owner == link} for link in "0123p"}
    foot, head = elements["0"][2], elements["3"][5]
    stretched = 1.01 * head[0]  # the crank 1 % longer, its axle so far back that it lies parallel to the others
    elements["3"][5] = (stretched, 0.0)
    back = 0.01 * head[0]
    elements["0"][2] = (foot[0] - back * cos(0.7), foot[1] - back * sin(0.7))
    home["3"] = (*elements["0"][2], home["3"][2])
    shaky = Linkage(moving.mechanism, elements, reference_pose=home)
    found = freedoms(shaky)
    assert (found.instant.mobility, found.mobility) == (1, 0)
    stuck = circuit(shaky)  # it creeps as far as its tolerance lets it
    assert not stuck.closed
    assert stuck.length < 1e-3


@pytest.mark.parametrize("lengths", [(25, 70, 40, 70), (3, 3, 3, 4), (2, 5, 2, 5)])
def test_circuits_of_four_bars(lengths):
    bar = FourBar(*lengths).linkage()
    made = circuit(bar, at=1.0)
    for value in made.samples.drive()[::40]:
        assert freedoms(bar, at=float(value)).mobility == 1
    closing, pose = closed_pose(bar, [1.0])
    assert sampled_dimension(closing, pose) == 1


def plucker(linkage, joint):
    """The screws of a joint from its place alone: (axis, point × axis), or (0, axis) for a shift."""
    place, pair = linkage.places[joint], linkage.mechanism.chain.joints[joint].pair.name
    at = np.array(place.at)

    def turn(axis, pitch=0.0):
        u = np.array(axis) / np.linalg.norm(axis)
        return np.array([*u, *(np.cross(at, u) + pitch * u)])

    def shift(axis):
        return np.array([0, 0, 0, *(np.array(axis) / np.linalg.norm(axis))])

    if pair == "revolute":
        return [turn(place.z or (0, 0, 1))]
    if pair == "helical":
        return [turn(place.z, place.pitch)]
    if pair == "prismatic":
        return [shift(place.x)]
    return [turn(place.x), turn(place.y)]  # universal


LOOPS = ["loco2", "flat loco2", "winch", "winch tilted", "bennett", "bennett off", "sarrus", "hooke", "cardan"]


@pytest.mark.parametrize("name", LOOPS)
def test_a_single_loop_by_the_screws_of_its_joints(name):
    """The velocities of a loop are the linear dependencies of its joints' screws: freedoms less rank."""
    linkage = EXAMPLES[name]
    screws = np.array([s for k in range(len(linkage.places)) for s in plucker(linkage, k)])
    dependencies = len(screws) - np.linalg.matrix_rank(screws, tol=1e-9)
    assert freedoms(linkage).instant.mobility == dependencies


@pytest.mark.parametrize("record", list(entries().values()), ids=lambda e: e.id)
def test_every_chain_of_the_catalog_at_a_random_place(record):
    """REFERENCE A3: the twist rank with random joint positions gives max(F, 0) for all chains."""
    chain = record.chain()
    random = np.random.default_rng(5)
    joints = {}
    for k, joint in enumerate(chain.joints):
        frame = exponential([*random.normal(size=3), 0, 0, 0])[:3, :3]
        if chain.space == "planar":
            joints[k] = {"at": tuple(random.normal(size=2)), "x": (*random.normal(size=2), 0)}
        else:
            at = (0, 0, 0) if chain.space == "spherical" else tuple(random.normal(size=3))
            joints[k] = {"at": at} | {axis: tuple(frame[:, i]) for i, axis in enumerate("xyz")}
        if joint.pair.name in ("roll_slide", "rolling"):
            joints[k]["radii"] = tuple(random.uniform(0.3, 1.0, 2))
        if joint.pair.name == "helical":
            joints[k]["pitch"] = 0.7
    found = freedoms(SpatialLinkage(Mechanism(chain, chain.links[0]), joints))
    assert found.instant.mobility == found.mobility == found.generic == max(found.counted, 0)
