"""What turns for itself alone: rams between balls, Stewart platforms, rods in series; Hooke's joints made of links."""

from math import cos, pi, sin

import numpy as np
import pytest

from gruebler import Chain, mobility_report
from gruebler.mechanics.screws import SpatialLinkage, freedoms
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.screws import machines as m


def stewart(pair, aside=0.0):
    """Six legs S-P-S or S-C-S, the slide's axis beside the line of the balls if wanted."""
    text, places = [], []
    for i in range(6):
        a, b = 2 * pi * (i // 2) / 3 + 0.2 * (-1) ** i, 2 * pi * ((i + 1) // 2) / 3 - pi / 3 - 0.2 * (-1) ** i
        foot, head = np.array([2 * cos(a), 2 * sin(a), 0]), np.array([cos(b) + 0.1, sin(b) - 0.07, 1.5])
        middle = tuple((foot + head) / 2 + (aside, 0, 0))
        text.append(f"S(base-barrel{i}) {pair}(barrel{i}-rod{i}) S(rod{i}-plate)")
        places += [
            {"at": tuple(foot)},
            {"at": middle, "x" if pair == "P" else "z": tuple(head - foot)},
            {"at": tuple(head)},
        ]
    return SpatialLinkage(Mechanism.parse("spatial: " + " ".join(text)), dict(enumerate(places)))


def unseen(found, *outside):
    """The dimension of the velocities at which these links stand still: what the others do for themselves."""
    closing = found.instant.closing
    twists = np.array([closing.twists(motion) for motion in found.instant.motions])
    seen = twists[:, [found.report.chain.index(link) for link in outside]].reshape(len(twists), -1)
    return len(twists) - np.linalg.matrix_rank(seen, tol=1e-9)


@pytest.mark.parametrize(("pair", "aside", "idle"), [("P", 0, 6), ("P", 0.1, 6), ("C", 0, 12)])
def test_the_legs_of_a_stewart_platform(pair, aside, idle):
    found = freedoms(stewart(pair, aside))
    assert (found.counted, found.mobility) == (6 + idle, 6 + idle)
    assert (found.idle, found.useful) == (idle, 6)
    assert unseen(found, "base", "plate") == idle
    assert found.to_json()["finite"]["useful"] == 6


def test_a_rod_that_cannot_turn_alone():
    """With the axis of the cylindrical joint beside the balls only the whole leg turns."""
    found = freedoms(stewart("C", 0.1))
    assert [idle.links for idle in found.idle_parts] == [(f"barrel{i}", f"rod{i}") for i in range(6)]


@pytest.mark.parametrize(
    ("text", "idle"),
    [
        ("R(0-a) S(a-r) P(r-b) S(b-c) R(c-0)", {("r", "b"): 1}),
        ("R(0-a) S(a-r) C(r-b) S(b-c) R(c-0)", {("r", "b"): 1}),
        ("R(0-a) S(a-r) R(r-q) P(q-b) S(b-c) R(c-0)", {("r", "q", "b"): 1}),
        ("R(0-a) S(a-r) S(r-b) R(b-0)", {("r",): 1}),
        ("R(0-a) S(a-r) S(r-q) S(q-b) R(b-0)", {("r",): 1, ("q",): 1}),  # rods in series
        ("R(0-a) S(a-r) P(r-q) S(q-t) P(t-u) S(u-b) R(b-0)", {("r", "q"): 1, ("t", "u"): 1}),
        ("R(0-a) S(a-r) P(r-b) S(b-c) R(c-0) R(b-0)", {}),  # the barrel is held elsewhere
        ("S(0-r) P(r-b) S(b-0)", {}),  # a hinge
        ("R(0-a) U(a-r) P(r-b) S(b-c) R(c-0)", {}),
    ],
)
def test_structure(text, idle):
    report = mobility_report(Chain.parse("spatial: " + text))
    assert {one.links: one.freedoms for one in report.idle_freedoms} == idle
    for lang, word in (("en", "as one body"), ("de", "als ein Körper")):
        assert (word in report.explain(lang)) == any(len(links) > 1 for links in idle)


def test_idle_freedoms_are_motions_at_random_places():
    """The dimension of all motions with both arms held, at random dimensions, against the structure's number."""
    random = np.random.default_rng(5)
    text = "spatial: R(0-a) S(a-r) R(r-q) P(q-b) S(b-c) R(c-0)"
    places = [
        {"at": tuple(random.normal(size=3))} | ({} if pair == "S" else {axis: tuple(random.normal(size=3))})
        for pair, axis in (("R", "z"), ("S", ""), ("R", "z"), ("P", "x"), ("S", ""), ("R", "z"))
    ]
    found = freedoms(SpatialLinkage(Mechanism.parse(text), dict(enumerate(places))))
    assert found.idle == 1
    assert unseen(found, "a", "c", "0") == 2  # the leg as a whole, and its elbow, which is not idle by itself


def cardan_of_links(bend=0.5, other=0.5, aside=0.0):
    """The double Hooke's joint of `machines.cardan` with its crosses as links."""
    ends = (cos(bend), sin(bend), 0), (cos(other), -sin(other), 0)
    across = (-sin(bend), cos(bend), 0), (sin(other), cos(other), 0)
    far = (4, 0, 0)
    places = [
        {"at": (0, 0, aside), "z": ends[0]},
        {"z": across[0]},
        {"z": m.Z},
        {"at": far, "z": m.Z},
        {"at": far, "z": across[1]},
        {"at": far, "z": ends[1]},
    ]
    text = "spatial: R(0-in) R(in-one) R(one-shaft) R(shaft-two) R(two-out) R(0-out); drive=R(0-in)"
    return SpatialLinkage(Mechanism.parse(text), dict(enumerate(places)))


def test_crosses_as_links_have_the_reason_of_cross_joints():
    joints, links = freedoms(m.cardan()), freedoms(cardan_of_links())
    assert joints.mobility == links.mobility == 1
    assert (
        [(r.kind, r.links) for r in joints.reasons]
        == [(r.kind, r.links) for r in links.reasons]
        == [("cardan", ("shaft",))]
    )
    assert links.reasons[0].joints == (0, 1, 2, 3, 4, 5)
    off = freedoms(cardan_of_links(aside=0.1))
    assert (off.mobility, off.reasons) == (0, ())
