"""Dead centres: the family, its range, its best member."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import DeadCentreTask, Demands, synthesise_dead_centres
from gruebler.design.synthesis.dead_centres import _member, dead_centre_family
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import FourBar, SliderCrank


@settings(max_examples=15, deadline=None)
@given(st.floats(10, 150), st.floats(0.1, 0.9))
def test_every_member_has_the_dead_centres(swing, share):
    angle = np.radians(90 + swing / 2 + 180 * share)
    family = dead_centre_family(DeadCentreTask(swing=np.radians(swing), crank_angle=angle))
    for member in family.members[::40]:
        assert member.linkage.swing == pytest.approx(np.radians(swing), abs=1e-9)
        assert member.linkage.dead_centres.phi_back == pytest.approx(angle, abs=1e-9)
        assert member.linkage.type.name if hasattr(member.linkage.type, "name") else str(member.linkage.type)
        assert member.transmission <= family.best.transmission + 1e-9


@settings(max_examples=40, deadline=None)
@given(st.floats(0.1, 0.6), st.floats(0.5, 3), st.floats(0.5, 3))
def test_every_crank_rocker_belongs_to_its_family(a, b, d):
    """Completeness, by another hand: any crank-rocker is found as the member of its own crank length."""
    linkage = FourBar(a, b, 1.0, d)
    assume(str(linkage.type) == "crank-rocker")
    centres = linkage.dead_centres
    task = DeadCentreTask(swing=centres.travel, crank_angle=centres.phi_back)
    assume(abs(task.angle - np.pi) > 1e-3)
    member = _member(task, a)
    assert member is not None
    assert (member.linkage.b, member.linkage.d) == pytest.approx((b, d), rel=1e-6)


@settings(max_examples=30, deadline=None)
@given(st.floats(0.1, 1), st.floats(1.3, 5), st.floats(0, 0.25))
def test_every_slider_crank_belongs_to_its_family(a, b, e):
    linkage = SliderCrank(a, b, e)
    stroke, centres = linkage.stroke, linkage.dead_centres
    assume(abs(centres.phi_max - np.pi) > 1e-3)
    member = _member(DeadCentreTask(stroke=stroke, crank_angle=centres.phi_max), a / stroke)
    assert member is not None
    assert (member.linkage.b, abs(member.linkage.e)) == pytest.approx((b / stroke, e / stroke), rel=1e-6)


def test_the_best_member_against_brute_force():
    """Second method: all crank-rockers of a grid of lengths with nearly this swing and angle are no better."""
    swing, angle = np.radians(60), np.radians(200)
    best = dead_centre_family(DeadCentreTask(swing=swing, crank_angle=angle)).best
    rng = np.random.default_rng(1)
    seen = 0
    for a, b, d in rng.uniform([0.3, 0.5, 0.5], [0.5, 2.5, 2.5], (60000, 3)):
        if a + max(b, d, 1) > b + d + 1 - max(b, d, 1) or a > min(b, d, 1):
            continue
        linkage = FourBar(a, b, 1.0, d)
        centres = linkage.dead_centres
        if centres is None or abs(centres.travel - swing) > 0.02 or abs(centres.phi_back - angle) > 0.02:
            continue
        seen += 1
        assert linkage.transmission_angle.smallest.mu < best.transmission + 0.06
    assert seen > 3


def test_the_design_really_moves_so():
    found = synthesise_dead_centres(DeadCentreTask(swing=np.radians(50), time_ratio=1.2))
    design = found.designs[0]
    made = measures(design.linkage)
    assert made.time_ratio == pytest.approx(1.2, abs=1e-6)
    assert "infinitely many" in str(found.notes[0])
    assert [d.verdict.transmission for d in found.designs] == sorted(
        (d.verdict.transmission for d in found.designs), reverse=True
    )


@pytest.mark.parametrize("angle", [119, 301])
def test_what_is_not_possible_says_what_is(angle):
    with pytest.raises(SynthesisError, match="more than 120° and less than 300°"):
        dead_centre_family(DeadCentreTask(swing=np.radians(60), crank_angle=np.radians(angle)))
    assert dead_centre_family(DeadCentreTask(swing=np.radians(60), crank_angle=np.radians(121 + (angle > 200) * 178)))


@pytest.mark.parametrize("number", [1, 2, 3, 12])
def test_so_many_members_stand_for_the_family(number):
    """The best among them, and none at the limits of the family, where the transmission angle is nearly 0."""
    found = synthesise_dead_centres(DeadCentreTask(swing=np.radians(60), crank_angle=np.radians(200)), number=number)
    angles = [design.verdict.transmission for design in found.designs]
    assert len(angles) == number
    assert np.degrees(angles[0]) == pytest.approx(38.04, abs=0.01)
    assert min(angles) > np.radians(1)


def test_the_best_is_sought_within_the_demands():
    """By hand: of crank-rockers with 60 and 200 degrees the best has 38.04 degrees, at some size ratio above 3.

    With a smaller ratio demanded the best lies where the ratio is reached; a grid of all crank lengths agrees.
    """
    task = DeadCentreTask(swing=np.radians(60), crank_angle=np.radians(200))
    free = synthesise_dead_centres(task).designs[0].verdict
    limit = 0.9 * free.size_ratio
    best = synthesise_dead_centres(task, Demands(size_ratio=limit)).designs[0].verdict
    assert best.size_ratio == pytest.approx(limit, rel=1e-6)
    grid = [m for p in np.linspace(0.01, 0.6, 5000) if (m := _member(task, float(p))) is not None]
    lengths = np.array([(m.linkage.a, m.linkage.b, 1, m.linkage.d) for m in grid])
    within = lengths.max(axis=1) <= limit * lengths.min(axis=1)
    angles = np.array([m.transmission for m in grid])
    assert best.transmission == pytest.approx(angles[within].max(), abs=2e-3)
    assert best.transmission >= angles[within].max() - 1e-9


def test_dead_centres_without_a_member_name_the_tightest_demand():
    task = DeadCentreTask(swing=np.radians(60), crank_angle=np.radians(200))
    found = synthesise_dead_centres(task, Demands(transmission=np.radians(39)))
    assert not found.designs
    tried = len(dead_centre_family(task).members) + 1  # and the best
    assert f"Designs that meet all but the demand of a transmission angle of 39°: {tried}." in map(str, found.notes)
    assert synthesise_dead_centres(task, Demands(transmission=np.radians(38.03))).designs


@settings(max_examples=15, deadline=None)
@given(st.floats(0.1, 0.6), st.floats(0.5, 3), st.floats(0.5, 3))
def test_given_lengths_fix_scale_and_member(a, b, d):
    """Any crank-rocker comes back from its dead centres, its coupler and its crank."""
    linkage = FourBar(a, b, 1.0, d)
    assume(str(linkage.type) == "crank-rocker")
    centres = linkage.dead_centres
    task = DeadCentreTask(swing=centres.travel, crank_angle=centres.phi_back)
    assume(abs(task.angle - np.pi) > 1e-2)
    found = synthesise_dead_centres(task, Demands(lengths={"coupler": 70 * b, "crank": 70 * a}))
    rows = [[design.linkage.length("crank", 0, 1), design.linkage.length("rocker", 2, 3)] for design in found.designs]
    assert any(row == pytest.approx([70 * a, 70], rel=1e-6) for row in rows)


def test_the_smallest_is_found_where_it_is_asked_for():
    task = DeadCentreTask(stroke=50, time_ratio=1.2)
    demands = Demands(transmission=np.radians(40))
    small = synthesise_dead_centres(task, demands, sort=["size"]).designs[0]
    other = synthesise_dead_centres(task, demands, number=60).designs
    assert small.linkage.size <= min(design.linkage.size for design in other)
    assert np.degrees(small.verdict.transmission) == pytest.approx(40, abs=1e-6)  # as far as the demand lets it


def test_the_other_sense_of_a_crank_angle_is_told():
    """A swing of 38.5 degrees: 24.6 and 37.5 degrees by a sweep of all pivots on the circle of equal angles."""
    task = DeadCentreTask(swing=np.radians(38.5), crank_angle=np.radians(152.5))
    notes = " ".join(map(str, synthesise_dead_centres(task).notes))
    assert "(crank angle 207.5°), the best minimum transmission angle is" in notes
    told = float(notes.split("angle is ")[-1].split("°")[0])
    assert told == pytest.approx(np.degrees(swept(np.radians(38.5), np.radians(207.5))), abs=0.1)
    half = synthesise_dead_centres(DeadCentreTask(swing=np.radians(38.5), crank_angle=np.pi))
    assert not any("opposite way" in str(note) for note in half.notes)


def swept(swing, angle):
    """The largest least transmission angle of crank-rockers: A0 sees both ends of a rocker of length 1 under the angle.

    B1 and B2 lie on the circle about B0. In one of them the coupler is folded back over the crank, which points the
    other way there: |A0 B1| and |A0 B2| are b + a and b - a, or the other way round.
    """
    ends = np.exp(1j * np.array([0.0, swing]))
    x, y = np.meshgrid(*2 * (np.linspace(-1.9999, 2.0003, 1601),))
    best = 0.0
    for place in x + 1j * y:
        far = ends[:, None] - place
        fits = np.abs(np.angle(-far[1] / far[0]) % (2 * np.pi) - angle) < 1e-3
        a, b, d = np.abs(np.diff(np.abs(far), axis=0))[0] / 2, np.abs(far).sum(axis=0) / 2, np.abs(place)
        cosines = np.array([(b * b + 1 - (d + sign * a) ** 2) / (2 * b) for sign in (1, -1)])
        least = np.pi / 2 - np.abs(np.pi / 2 - np.arccos(np.clip(cosines, -1, 1))).max(axis=0)
        best = max(best, least[fits].max(initial=0.0))
    return best


def by_hand(task, ratios):
    """Lengths (members, 4) of crank, coupler, rocker, frame and least transmission angles, for coupler by crank.

    By the law of cosines in the triangles A0 B1 B2 and A0 B1 B0; members fold over when a rocker passes the frame line.
    """
    delta, swing = task.angle - np.pi, task.swing
    chord = 2 * np.sin(swing / 2)
    a = chord / np.sqrt((ratios + 1) ** 2 + (ratios - 1) ** 2 - 2 * (ratios**2 - 1) * np.cos(delta))
    b = ratios * a
    first, second = b + a, (b - a) * np.exp(1j * delta)
    pivot = (second - np.exp(1j * swing) * first) / (1 - np.exp(1j * swing))
    same_side = np.sign((np.conj(pivot) * first).imag) == np.sign((np.conj(pivot) * second).imag)
    d = np.abs(pivot)
    cosines = np.array([(b * b + 1 - (d + sign * a) ** 2) / (2 * b) for sign in (1, -1)])
    angles = np.arccos(np.clip(np.abs(cosines).max(axis=0), 0, 1))
    return np.stack([a, b, np.ones_like(a), d], axis=1)[same_side], angles[same_side]


@pytest.mark.parametrize("seed", range(12))
def test_no_member_of_a_dense_sample_is_better_with_or_without_demands(seed):
    rng = np.random.default_rng(seed)
    swing = rng.uniform(10, 150)
    task = DeadCentreTask(
        swing=np.radians(swing), crank_angle=np.radians(90 + swing / 2 + 180 * rng.uniform(0.02, 0.98))
    )
    lengths, angles = by_hand(task, 1 + np.exp(np.linspace(-8, 8, 20_001)))
    assert dead_centre_family(task).best.transmission >= angles.max() - 1e-12
    ratios = lengths.max(axis=1) / lengths.min(axis=1)
    limit, least = np.quantile(ratios, rng.uniform(0.05, 0.9)), np.quantile(angles, rng.uniform(0.05, 0.9))
    good = (ratios < limit) & (angles > least)
    found = synthesise_dead_centres(task, Demands(size_ratio=limit, transmission=least), sort=["size"])
    assert bool(found.designs) == good.any()
    if not good.any():
        assert "Proved: no member meets all demands." in map(str, found.notes)
        return
    best = found.designs[0]
    assert best.verdict.size_ratio <= limit
    assert best.verdict.transmission >= least
    assert best.linkage.size <= lengths[good].max(axis=1).min() + 1e-9
    (said,) = [str(note) for note in found.notes if "Crank lengths" in str(note)]
    low, high = float(said.split("from ")[1].split(" to")[0]), float(said.split(" to ")[-1].split(";")[0])
    assert (low, high) == pytest.approx((lengths[good, 0].min(), lengths[good, 0].max()), rel=3e-3)


@pytest.mark.parametrize("position", [0.31, 0.57, 0.83])
def test_demands_that_hardly_any_member_meets_are_met(position):
    """Ratio and angle of one member, of which the one is better on one side of it and the other on the other side."""
    task = DeadCentreTask(swing=np.radians(40), crank_angle=np.radians(195))
    lengths, angles = by_hand(task, 1 + np.exp(np.linspace(-8, 8, 20_001)))
    ratios, best = lengths.max(axis=1) / lengths.min(axis=1), int(angles.argmax())
    k = int(np.argmin(np.abs(ratios[:best] - ratios[best] * (1 + position)))) if ratios[0] > ratios[best] else None
    k = int(best * position) if k is None else k
    demands = Demands(size_ratio=ratios[k] * (1 + 1e-7), transmission=angles[k] - 1e-7)
    (design, *_) = synthesise_dead_centres(task, demands).designs
    assert design.linkage.length("crank", 0, 1) == pytest.approx(lengths[k, 0], rel=1e-5)


def test_the_angle_grows_with_the_coupler_where_the_dead_centres_are_half_a_turn_apart():
    """a² + d² = b² + c²: cos(mu) = a d / (b c) tends to a / c = sin(swing / 2)."""
    task = DeadCentreTask(swing=np.radians(50), crank_angle=np.pi)
    found = synthesise_dead_centres(task, Demands(transmission=np.radians(64.9), size_ratio=100.0))
    assert "always stays below 65°" in str(found.notes[0])
    lengths = sorted(design.linkage.length("coupler", 1, 2) for design in found.designs)
    a = np.sin(np.radians(25))
    # cos(mu)² b² = a² (b² + 1 - a²)
    least = a * np.sqrt(1 - a * a) / np.sqrt(np.cos(np.radians(64.9)) ** 2 - a * a)
    assert lengths[0] >= least - 1e-9
    assert f"from {least:.4g} to" in next(str(note) for note in found.notes if "Coupler lengths" in str(note))
    none = synthesise_dead_centres(task, Demands(transmission=np.radians(65.1)))
    assert any("Proved: no member with a coupler of up to" in str(note) for note in none.notes)
