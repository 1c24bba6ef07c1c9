"""Laws for every kind of task: moved tasks have moved designs, linkages come back, verdicts are true."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.design.synthesis import (
    DeadCentreTask,
    FunctionTask,
    PathTask,
    PositionTask,
    synthesise,
)
from gruebler.design.synthesis.dead_centres import dead_centre_family
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, Displacements, GuidingDyad, all_dyads
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import circuit, move
from gruebler.mechanics.linkages.elements import Pin
from gruebler.pictures.designs.alt_construction import alt_construction

turns, scales = st.floats(0.1, 3), st.floats(0.01, 100)


def everything(result):
    return [*result.designs, *result.rejected]


def pins(design):
    return pins_of(design.linkage)


def pins_of(linkage):
    """All distances of pins of one link, in order of size."""
    out = []
    for link in linkage.mechanism.chain.links:
        own = [complex(e.x, e.y) for (_, owner), e in linkage.elements.items() if owner == link and isinstance(e, Pin)]
        out += [abs(p - q) for k, p in enumerate(own) for q in own[:k]]
    return np.sort(out)


def same_designs(plain, moved, scale):
    """As many accepted and rejected designs, and to each its image; far ones are known to fewer digits."""
    assert len(everything(plain)) == len(everything(moved))
    images = [pins(design) for design in everything(moved)]
    for design in everything(plain):
        own = scale * pins(design)
        if own[-1] < 1e3 * own[0]:
            gaps = [np.abs(own - other).max() for other in images if len(other) == len(own)]
            assert min(gaps) < 1e-5 * own[-1]


def image(z, angle, scale, mirror):
    return scale * (np.exp(1j * angle) * (np.conj(z) if mirror else z) + 5 - 1j)


def pairs(z):
    return tuple((float(w.real), float(w.imag)) for w in z)


def random_path(seed, count):
    rng = np.random.default_rng(seed)
    at = np.sort(rng.uniform(0, 4, count))
    return 2 * np.cos(at) + 1j * np.sin(at) + 0.1 * (rng.normal(size=count) + 1j * rng.normal(size=count)), at


@settings(max_examples=3, deadline=None)
@given(st.integers(0, 10**6), turns, scales, st.booleans())
def test_moved_mixed_tasks_have_moved_designs(seed, angle, scale, mirror):
    z, at = random_path(seed, 6)
    sign = -1 if mirror else 1
    coupler = [0.3 * a if k in (0, 1, 3, 4) else None for k, a in enumerate(at)]
    turned = [None if a is None else sign * a + angle for a in coupler]
    plain = synthesise(PathTask(pairs(z), angles=tuple(coupler)))
    moved = synthesise(PathTask(pairs(image(z, angle, scale, mirror)), angles=tuple(turned)))
    assert plain.count.found == moved.count.found == 30
    same_designs(plain, moved, scale)


def moved_like(plain, moved, scale):
    """The same counts, and the same designs in another place, size and sense."""
    assert (plain.count.found, plain.count.real) == (moved.count.found, moved.count.real)
    same_designs(plain, moved, scale)


MIXED = {"(3, 4)": (7, (0, 3, 6)), "(2, 6)": (8, (0, 5)), "nine points": (9, ())}
"""How many points in all, and at which of them the coupler's angle is given."""


@pytest.mark.slow
@pytest.mark.parametrize("kind", MIXED)
@settings(max_examples=4, deadline=None)
@given(seed=st.integers(0, 10**6), angle=turns, scale=scales, mirror=st.booleans())
def test_moved_finite_tasks_have_moved_designs(kind, seed, angle, scale, mirror):
    count, oriented = MIXED[kind]
    z, at = random_path(seed, count)
    sign = -1 if mirror else 1
    plain = tuple(0.3 * a if k in oriented else None for k, a in enumerate(at)) if oriented else ()
    turned = tuple(None if a is None else sign * a + angle for a in plain)
    moved = PathTask(pairs(image(z, angle, scale, mirror)), angles=turned)
    moved_like(synthesise(PathTask(pairs(z), angles=plain)), synthesise(moved), scale)


@pytest.mark.slow
@pytest.mark.parametrize("kind", MIXED)
@pytest.mark.parametrize("seed", range(4))
def test_finite_tasks_give_a_random_four_bar_back(kind, seed):
    """From points, and angles of the coupler at some of them, of a four-bar drawn at random.

    No two points are near each other, since then other solutions lie so far out that some are not resolved.
    """
    count, oriented = MIXED[kind]
    rng = np.random.default_rng(seed)
    lengths, known, low, span = random_four_bar(rng)
    values = low + span * (np.arange(count) + rng.uniform(0, 0.8, count)) / count
    result = synthesise(path_of(known, values, oriented))
    assert result.count.found == result.count.theorem
    assert given_back(result, lengths)


def random_four_bar(rng):
    """Its lengths, itself, where its drive begins and how far it goes without a dead centre."""
    while True:
        lengths = rng.uniform(1, 4, 4)
        if 2 * lengths.max() < 0.95 * lengths.sum() and np.diff(np.sort(lengths)).min() > 0.1:
            break
    known = FourBar(*lengths).linkage({"P": tuple(rng.uniform(0.4, 2, 2))})
    drive = circuit(known, step=0.05).drive
    span = 0.6 * np.ptp(drive) if np.ptp(drive) < 6 else 4.5
    return lengths, known, drive.min() + 0.2 * np.ptp(drive), span


def path_of(known, drives, oriented):
    motion = move(known, drives)
    assert motion.complete
    angles = tuple(a if k in oriented else None for k, a in enumerate(motion.angle("coupler"))) if oriented else ()
    return PathTask(motion.point("P"), angles=angles)


def given_back(result, lengths):
    gaps = [np.abs(own - np.sort(lengths)).max() for d in everything(result) if len(own := pins(d)) == 4]
    return min(gaps) < 1e-5


@pytest.mark.slow
def test_points_near_each_other_give_a_four_bar_back():
    """Solutions lie up to 3e4 sizes away; what is not resolved is counted."""
    rng = np.random.default_rng(0)
    lengths, known, low, span = random_four_bar(rng)
    drives = low + span * np.sort(rng.uniform(0, 1, 8))
    assert np.diff(drives).min() < 0.01
    result = synthesise(path_of(known, drives, (0, 5)))
    assert given_back(result, lengths)
    assert 1100 <= result.count.found <= result.count.theorem


@settings(max_examples=3, deadline=None)
@given(st.integers(0, 10**6), turns, scales, st.booleans(), st.sampled_from([3, 4]))
def test_moved_positions_with_chosen_pivots_have_moved_designs(seed, angle, scale, mirror, count):
    """Three positions with pivots that are moved along; four with pivots of Burmester's curves."""
    rng = np.random.default_rng(seed)
    z, a = rng.normal(size=count) + 1j * rng.normal(size=count), np.cumsum(rng.uniform(0.2, 0.7, count))
    sign = -1 if mirror else 1
    places = z.mean() + rng.normal(size=3) + 1j * rng.normal(size=3)
    plain = PositionTask([(w.real, w.imag, t) for w, t in zip(z, a, strict=True)], moving_pivots=pairs(places))
    rows = [(w.real, w.imag, sign * t + angle) for w, t in zip(image(z, angle, scale, mirror), a, strict=True)]
    moved = PositionTask(rows, moving_pivots=pairs(image(places, angle, scale, mirror)))
    moved_like(synthesise(plain), synthesise(moved), scale)


@settings(max_examples=3, deadline=None)
@given(st.floats(20, 120), st.floats(0.2, 0.8))
def test_swings_of_the_other_sense_have_mirrored_designs(swing, share):
    """Seen in a mirror the crank goes the other way round: slow and quick travel are exchanged with 360 degrees."""
    angle = np.radians(90 + swing / 2 + 180 * share)
    assume(abs(angle - np.pi) > 0.02)
    family = dead_centre_family(DeadCentreTask(swing=np.radians(swing), crank_angle=angle))
    for member in family.members[::180]:
        own = member.linkage.linkage()
        for linkage in (own, own.mirrored()):
            found = measures(linkage)
            assert found.travel == pytest.approx(np.radians(swing), abs=1e-8)
            assert sorted((found.phi_forward, found.phi_back)) == pytest.approx(sorted((angle, 2 * np.pi - angle)))


@settings(max_examples=5, deadline=None)
@given(st.integers(0, 10**6), turns, scales, st.booleans())
def test_moved_timed_tasks_have_moved_designs(seed, angle, scale, mirror):
    z, _ = random_path(seed, 5)
    timing = np.sort(np.random.default_rng(seed + 1).uniform(0, 5, 5))
    assume(np.diff(timing).min() > 0.2)
    sign = -1 if mirror else 1
    plain = synthesise(PathTask(pairs(z), crank_angles=tuple(timing)))
    moved = synthesise(PathTask(pairs(image(z, angle, scale, mirror)), crank_angles=tuple(sign * timing + angle)))
    same_designs(plain, moved, scale)


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 10**6), scales, st.booleans(), st.sampled_from(["angle", "travel"]), st.booleans())
def test_mirrored_and_scaled_functions_have_such_designs(seed, scale, mirror, output, free):
    rng = np.random.default_rng(seed)
    count = 4 if free else 3
    inputs, outputs = np.cumsum(rng.uniform(0.2, 0.5, (2, count)), axis=1)
    starts = {"start_input": True, "start_output": not free}
    other = scale * outputs if output == "travel" else outputs
    # In the x axis angles change their sign; the travel, along x, does not.
    sign = -1 if mirror else 1
    moved = FunctionTask(
        tuple(sign * inputs), outputs=tuple(other if output == "travel" else sign * other), output=output, **starts
    )
    plain = synthesise(FunctionTask(tuple(inputs), outputs=tuple(outputs), output=output, **starts))
    same_designs(plain, synthesise(moved), scale if output == "travel" else 1.0)


@settings(max_examples=5, deadline=None)
@given(st.floats(0.55, 0.95), scales)
def test_scaled_and_mirrored_dead_centres_have_such_designs(share, scale):
    angle = 2 * np.pi * share * 0.75
    assume(abs(angle - np.pi) > 0.01 and np.pi / 2 < angle < 1.5 * np.pi)
    plain = synthesise(DeadCentreTask(stroke=1, crank_angle=angle), number=4)
    for other in (angle, 2 * np.pi - angle):
        same_designs(plain, synthesise(DeadCentreTask(stroke=scale, crank_angle=other), number=4), scale)


@settings(max_examples=10, deadline=None)
@given(st.floats(20, 120), st.floats(0.1, 0.9))
def test_alts_construction_is_true_of_every_member(swing, share):
    """A0 lies on one circle through B1 and B2, sees them under delta, and the lengths are those that are cut off."""
    angle = np.radians(90 + swing / 2 + 180 * share)
    assume(abs(angle - np.pi) > 0.02)
    task = DeadCentreTask(swing=np.radians(swing), crank_angle=angle)
    family = dead_centre_family(task)
    drawn = [alt_construction(task, member) for member in family.members[::90]]
    for one in drawn:
        assert abs(one.outer - drawn[0].outer) + abs(one.inner - drawn[0].inner) < 1e-9
        assert abs(one.centre - drawn[0].centre) < 1e-8
        far, near = one.outer - one.crank_pivot, one.inner - one.crank_pivot
        assert abs(one.crank_pivot - one.centre) == pytest.approx(abs(one.outer - one.centre), rel=1e-8)
        assert np.angle(near / far) == pytest.approx(one.delta, abs=1e-8)
        assert ((abs(far) - abs(near)) / 2, (abs(far) + abs(near)) / 2) == pytest.approx((one.crank, one.coupler))
        for pin in one.pins:
            assert abs(pin - one.crank_pivot) == pytest.approx(one.crank)
        assert [abs(a - b) for a, b in zip(one.pins, (one.outer, one.inner), strict=True)] == pytest.approx(
            [one.coupler] * 2
        )


complexes = st.builds(complex, st.floats(-2, 2), st.floats(-2, 2))


@st.composite
def dyads(draw, kind):
    direction = np.exp(1j * draw(st.floats(0, 3)))
    fixed, moving = draw(complexes), draw(complexes)
    return GuidingDyad(kind, moving, fixed if kind is CRANK else moving, complex(direction))


@settings(max_examples=10, deadline=None)
@given(
    st.sampled_from([(CRANK, CRANK), (CRANK, BLOCK), (CRANK, SLIDER), (SLIDER, BLOCK)]),
    st.data(),
    st.floats(0.15, 0.35),
)
def test_every_pair_of_dyads_comes_back_from_five_of_its_positions(kinds, data, step):
    """Of dyads drawn at random; sliders on the frame are in `test_positions`."""
    one, two = (data.draw(dyads(kind)) for kind in kinds)
    try:
        linkage = linkage_of_dyads(one, two, 0.3 + 0.4j, "mm")
        assume(pins_of(linkage).min(initial=1) > 0.3)
        drive = circuit(linkage, step=0.05).drive
        motion = move(linkage, drive[len(drive) // 2] + step * np.arange(5))  # a slide comes from far away
    except LinkageError:
        assume(False)
    assume(motion.complete)
    rows = [(*p, a) for p, a in zip(motion.point("P"), motion.angle("coupler"), strict=True)]
    task = PositionTask(tuple(rows))
    assume(task.size > 0.2)
    try:
        result = synthesise(task)
    except SynthesisError:
        assume(False)  # a motion that infinitely many dyads guide
    wanted = pins_of(linkage)
    forms = [kind.form for kind in kinds]
    names = {"-".join(forms), "-".join(reversed(forms))}
    alike = [pins(d) for d in everything(result) if d.form in names and len(pins(d)) == len(wanted)]
    gaps = [np.abs(own - wanted).max(initial=0.0) for own in alike]
    assert min(gaps, default=np.inf) < 1e-4 * (1 + wanted.max(initial=0.0))


def carried_on_a_line_and_a_circle(rng):
    """Four displacements of a body with a point on a line and one on a circle, and the first point; None if none."""
    on_line, on_circle, centre = (complex(*rng.normal(size=2)) for _ in range(3))
    along, radius = np.exp(1j * rng.uniform(-3, 3)), abs(on_circle - centre)
    turns = np.exp(1j * np.linspace(0, rng.uniform(0.3, 1.2), 5)[1:])
    arms = on_line + turns * (on_circle - on_line) - centre
    across = (arms * np.conj(along)).real
    square = across**2 - abs(arms) ** 2 + radius**2
    if (square < 0).any():
        return None
    ways = np.array([-across - np.sqrt(square), -across + np.sqrt(square)])
    nearest = np.take_along_axis(ways, abs(ways).argmin(axis=0)[None], 0)[0]
    return Displacements(turns, on_line + nearest * along - turns * on_line), on_line


@pytest.mark.parametrize("kind", [SLIDER, BLOCK], ids=lambda kind: kind.form)
def test_a_slide_is_told_from_a_far_pivot(kind):
    """The pivot of a slide lies at infinity; with rounding it is found at some 1e4 to 1e8 sizes."""
    rng, tried = np.random.default_rng(3), 0
    for _ in range(700):
        drawn = carried_on_a_line_and_a_circle(rng)
        if drawn is None:
            continue
        displacements, pivot = drawn
        found = all_dyads(displacements if kind is SLIDER else displacements.inverse).real
        assert [d for d in found if d.kind == kind and abs(d.moving - pivot) < 1e-6 * (1 + abs(pivot))]
        tried += 1
    assert tried > 400
