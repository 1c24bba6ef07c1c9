"""Neither the place of the whole, nor its size, nor the names and order of links and joints change the answer."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.screws import Closing, Freedoms, SpatialLinkage, exponential, freedoms
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mobility import generic_mobility
from tests.mechanics.screws import machines as m

MACHINES = {
    "loco3": m.locomotive(3),
    "shaky": m.locomotive(3, error=0.01),
    "flat": m.locomotive(2, angle=0.0),
    "friction": m.friction(),
    "scissors": m.two_scissors(3.0),
    "differential": m.differential(2),
    "dwell": m.geneva_dwell(),
    "winch": m.winch(),
    "bennett": m.bennett()[0],
    "sarrus": m.sarrus(),
    "bricard": m.bricard("line"),
    "hooke": m.hooke(),
    "cardan": m.cardan(),
    "bevel": m.bevel(2),
    "7R": m.loop(7),
}


def answer(found: Freedoms) -> tuple[object, ...]:
    kinds = sorted(reason.kind for reason in found.reasons)
    return found.instant.mobility, found.instant.rank, found.mobility, found.finite.evidence, found.finite.ways, kinds


@pytest.mark.parametrize("name", MACHINES)
def test_the_whole_elsewhere(name):
    linkage = MACHINES[name]
    here, there = freedoms(linkage), freedoms(m.elsewhere(linkage))
    assert answer(here) == answer(there)
    assert here.instant.values == pytest.approx(there.instant.values, abs=1e-9)
    assert here.instant.redundant == there.instant.redundant


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize("factor", [1e-3, 40.0])
def test_another_size(name, factor):
    linkage = MACHINES[name]
    here, there = freedoms(linkage), freedoms(linkage.scaled(factor))
    assert answer(here) == answer(there)
    assert here.instant.values == pytest.approx(there.instant.values, abs=1e-9)


@pytest.mark.parametrize("name", MACHINES)
def test_another_frame_and_another_order(name):
    linkage = MACHINES[name]
    chain = linkage.mechanism.chain
    here = freedoms(linkage)
    for frame in chain.links[1:3]:
        other = SpatialLinkage(Mechanism(chain, frame), linkage.places)
        found = freedoms(other)
        assert (found.instant.mobility, found.mobility) == (here.instant.mobility, here.mobility)
        assert found.instant.redundant == here.instant.redundant
    order = np.random.default_rng(3).permutation(len(chain.joints)).tolist()
    mixed = Chain([chain.joints[k] for k in order], links=chain.links[::-1], space=chain.space)
    made = SpatialLinkage(Mechanism(mixed, linkage.mechanism.frame), tuple(linkage.places[k] for k in order))
    assert answer(freedoms(made))[:5] == answer(here)[:5]


@pytest.mark.parametrize("name", ["loco3", "winch", "bennett", "hooke", "cardan", "differential"])
def test_the_same_answer_all_along_the_motion(name):
    """The pose moves on: what is finite at home is finite there."""
    linkage = MACHINES[name]
    closing = Closing.of(linkage)
    from gruebler.mechanics.screws.finite_mobility import finite_mobility
    from gruebler.mechanics.screws.instant_mobility import instant_mobility

    instant = instant_mobility(closing, closing.reference, 1e-8)
    for step in (0.1, -0.3):
        pose = closing.settled(closing.moved(closing.reference, step * instant.motions[0]))
        there = instant_mobility(closing, pose, 1e-8)
        assert there.rank == instant.rank
        assert finite_mobility(there).mobility == finite_mobility(instant).mobility


def test_mobility_is_never_less_than_generic_nor_instant_less_than_finite():
    for linkage in MACHINES.values():
        found = freedoms(linkage)
        assert found.generic <= found.instant.mobility
        assert found.mobility <= found.instant.mobility
        assert found.instant.mobility - found.instant.redundancy == found.counted


numbers = st.floats(-1, 1).map(lambda x: round(x, 3))
TEXTS = [
    "spatial: R(0-1) S(1-2) S(2-3) R(0-3)",
    "spatial: R(0-1) C(1-2) C(2-3) C(0-3)",
    "spatial: R(0-1) U(1-2) E(2-3) R(0-3) P(3-4) S(0-4)",
    "spatial: H(0-1) ball_plane(1-2) C(0-2)",
    "R(0-1) R(1-2) R(2-3) R(0-3) R(1-4) R(4-5) P(0-5)",
    "R(0-1) P(1-2) P(2-3) R(0-3)",
    "spherical: R(0-1) R(1-2) R(2-3) R(0-3)",
]


@settings(max_examples=40)
@given(st.sampled_from(TEXTS), st.integers(0, 10**6))
def test_at_random_places_it_is_generic(text, seed):
    """Almost all dimensions: the rank in floating point against the rank modulo a prime."""
    random = np.random.default_rng(seed)
    mechanism = Mechanism.parse(text)
    space = mechanism.chain.space
    joints = {}
    for k, joint in enumerate(mechanism.chain.joints):
        frame = exponential([*random.normal(size=3), 0, 0, 0])[:3, :3]
        if space == "planar":
            joints[k] = {"at": tuple(random.normal(size=2)), "x": (*random.normal(size=2), 0)}
        else:
            at = (0, 0, 0) if space == "spherical" else tuple(random.normal(size=3))
            joints[k] = {"at": at} | {axis: tuple(frame[:, i]) for i, axis in enumerate("xyz")}
            if joint.pair.name == "helical":
                joints[k]["pitch"] = random.normal()
    found = freedoms(SpatialLinkage(mechanism, joints))
    assert found.instant.mobility == found.mobility == generic_mobility(mechanism.chain)


@settings(max_examples=30)
@given(st.floats(1, 5), st.floats(1, 5), st.floats(1, 5), st.floats(0.1, 6))
def test_four_bars_have_one_freedom_wherever_they_close(b, c, d, at):
    from gruebler.base.errors import LinkageError

    try:
        found = freedoms(FourBar(1.0, b, c, d).linkage(), at=at)
    except LinkageError:
        assume(False)
    assert found.mobility == 1
