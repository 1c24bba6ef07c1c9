"""Universal joints as bodies: a cross in two forks, found by where the axes lie, whatever its links are called."""

import numpy as np
import pytest

from gruebler.files.link_solids import link_solids
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.crosses import crosses_of
from gruebler.mechanics.space import move
from gruebler.pictures.space.scene import scene_of
from gruebler.pictures.space.views import VIEWS
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry


def own_joint() -> SpatialLinkage:
    """In space, away from the origin, its joints placed anywhere on their axes: shafts at 40°."""
    mechanism = Mechanism.parse("spatial: R(a-b) R(b-c) R(c-d) R(a-d); frame=a")
    middle, turn = np.array([10.0, 20.0, 30.0]), np.radians(40)
    axes = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (np.cos(turn), np.sin(turn), 0)]
    places = {
        k: {"at": tuple(middle + off * np.array(z)), "z": z}
        for k, (z, off) in enumerate(zip(axes, (50, 7, -3, 60), strict=True))
    }
    return SpatialLinkage(mechanism, places).with_drives(["R(a-b)"])


LINKAGES = {id: entry(id).placed() for id in ("universal_joint", "cardan_shaft", "gough")} | {"own": own_joint()}


@pytest.mark.parametrize("id", LINKAGES)
def test_arms_stay_at_right_angles_and_meet(id):
    """Each arm moves with the link that holds it; a cross has both at right angles in every position."""
    linkage = LINKAGES[id]
    chain = linkage.mechanism.chain
    drives = np.zeros((2, len(linkage.mechanism.drives)))
    drives[1] = 0.6 if linkage.mechanism.drives[0].turning else np.linspace(5, 25, drives.shape[1])
    motion = move(linkage, drives)
    crosses = crosses_of(linkage)
    assert len(crosses) == {"universal_joint": 1, "own": 1, "cardan_shaft": 2, "gough": 6}[id]
    for cross in crosses:
        poses = [motion.poses[0, -1, chain.index(link)] for link in cross.arms]
        first, second = (pose[:3, :3] @ arm for pose, (_, arm) in zip(poses, cross.arms.values(), strict=True))
        assert first @ second == pytest.approx(0, abs=1e-9)
        places = [pose[:3, :3] @ cross.at + pose[:3, 3] for pose in poses]
        assert places[0] == pytest.approx(places[1], abs=1e-6 * linkage.size)


@pytest.mark.parametrize(("id", "cross", "holders"), [("universal_joint", "cross", 2), ("own", "c", 2)])
def test_a_link_whose_axes_meet_at_a_right_angle_is_a_cross_in_two_forks(id, cross, holders):
    linkage = LINKAGES[id]
    (found,) = crosses_of(linkage)
    assert (found.body, len(found.arms)) == (cross, holders)
    solids = link_solids(linkage)
    places = {link: np.concatenate([s.vertices for s in each]) - found.at for link, each in solids.items()}
    spans = []
    for link, (_, arm) in found.arms.items():
        along = places[link] @ arm  # a fork has an eye at either side
        assert along.max() == pytest.approx(-along.min(), rel=1e-6)
        out = places[cross] @ arm  # through which the arm goes
        assert out.max() == pytest.approx(-out.min(), rel=1e-6)
        assert out.max() > 0.8 * along.max()
        spans.append(out.max())
    assert spans[0] == pytest.approx(spans[1])
    normal = np.cross(*(arm for _, arm in found.arms.values()))
    assert abs(places[cross] @ normal).max() < 0.5 * spans[0]  # flat, other than a bar between the ends
    middles = [places[link].mean(axis=0) for link in found.arms]
    assert middles[0] @ middles[1] < 0  # the shafts lie on both sides


def test_a_fork_of_the_frame_stands_on_its_post():
    """Also where the arm that it holds does not lie level: the post goes up to the middle of its ring."""
    base = link_solids(LINKAGES["gough"])["base"]
    rings = [solid.vertices for solid in base if len(solid.vertices) > 100]
    posts = [base[k - 1].vertices for k, solid in enumerate(base) if len(solid.vertices) == 8]  # before its plate
    gaps = [min(np.linalg.norm(ring[:, None] - post, axis=2).min() for ring in rings) for post in posts]
    assert (len(rings), len(posts)) == (6, 6)
    assert max(gaps) < LINKAGES["gough"].size / 45  # the radius of a bar


@pytest.mark.parametrize(("id", "cross"), [("universal_joint", "cross"), ("own", "c")])
def test_pictures_show_two_forks_on_a_cross(id, cross):
    """Two bars of the cross at right angles through its middle; each holder has an eye at either side of one."""
    scene = scene_of(LINKAGES[id], VIEWS["isometric"])
    (found,) = crosses_of(LINKAGES[id])
    middle = scene.scale * (found.at - scene.middle)
    spines = [part.points[:2] - middle for part in scene.parts if part.link == cross and part.look == "bar"]
    assert len(spines) == 2
    ways = [spine[1] - spine[0] for spine in spines]
    assert [spine.mean(axis=0) for spine in spines] == [pytest.approx(np.zeros(3), abs=1e-6)] * 2
    assert ways[0] @ ways[1] == pytest.approx(0, abs=1e-6)
    for link, (_, arm) in found.arms.items():
        eyes = [
            part.points[:2].mean(axis=0) - middle for part in scene.parts if part.link == link and part.look == "sleeve"
        ]
        along = sorted(eye @ arm for eye in eyes if np.linalg.norm(eye - (eye @ arm) * arm) < 1e-6)
        assert along[0] == pytest.approx(-along[-1])
        assert along[-1] > 10


def test_links_that_are_no_crosses():
    """Axes at 90° that do not meet (Bennett), a link at the frame (Schatz), parallel axes (Sarrus)."""
    for id in ("bennett", "schatz", "sarrus", "wiper_rssr"):
        assert crosses_of(entry(id).placed()) == []
