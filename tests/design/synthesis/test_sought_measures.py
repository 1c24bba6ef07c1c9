"""Families sought by sensitivity and by the distance from preferred pivots, against code of our own."""

import json

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.cli import main
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    FunctionLaw,
    FunctionTask,
    PathTask,
    PositionTask,
    function_task,
    synthesise,
)
from gruebler.design.synthesis.dyad_families import guiding_dyads, sliding_sample
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import BLOCK, SLIDER
from gruebler.design.synthesis.functions import _facts
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.pair_facts import pair_facts
from gruebler.design.synthesis.start_families import sampled_by_starts
from gruebler.design.synthesis.targets import body_targets
from gruebler.files.specifications import specification_from_json
from gruebler.mechanics.fourbar import FourBar
from tests.design.synthesis.searches import made_once

THREE = PositionTask([(0, 0, 0), (0.8, 0.5, 0.4), (1.5, 0.4, 1.0)])
ANY = Demands(size_ratio=1e9)


def moving_pivot(task, fixed):
    """The centre of the circle through the places of a pivot of the frame, as the body of three positions sees it."""
    turns = np.exp(1j * (task.angles - task.angles[0]))
    seen = task.origins[0] + (fixed - task.origins) / turns
    u, v = seen[1] - seen[0], seen[2] - seen[0]
    return seen[0] + 1j * (abs(v) ** 2 * u - abs(u) ** 2 * v) / (2 * np.imag(np.conj(u) * v))


def does_it(task, crank_pivot, other_pivot, least):
    """Whether the four-bar through three positions with these pivots is acceptable, by its crank angles."""
    turns = np.exp(1j * (task.angles - task.angles[0]))
    pins, far = (
        task.origins + turns * (moving_pivot(task, pivot) - task.origins[0]) for pivot in (crank_pivot, other_pivot)
    )
    a, b = abs(pins[0] - crank_pivot), abs(far[0] - pins[0])
    c, d = abs(far[0] - other_pivot), abs(other_pivot - crank_pivot)
    sides = np.sign(np.imag(np.conj(far - pins) * (other_pivot - pins)))
    if max(a, b, c, d) > 20 * min(a, b, c, d) or abs(sides.sum()) < 3:
        return False
    phi = np.angle((pins - crank_pivot) / (other_pivot - crank_pivot))
    low, high = (a * a + d * d - (b + c) ** 2) / (2 * a * d), (a * a + d * d - (b - c) ** 2) / (2 * a * d)
    if low < -1 and high > 1:
        ways = [np.mod(sign * np.diff(phi), 2 * np.pi).sum() for sign in (1, -1)]
        if min(ways) >= 2 * np.pi:
            return False
        way = phi[0] + np.linspace(0, ways[0] if ways[0] <= ways[1] else -ways[1], 300)
    else:
        phi = np.mod(phi, 2 * np.pi) if low < -1 else phi
        if (low >= -1 and high <= 1 and abs(np.sign(phi).sum()) < 3) or np.prod(np.diff(phi)) <= 0:
            return False
        way = np.linspace(phi[0], phi[-1], 300)
    cosines = (b * b + c * c - a * a - d * d + 2 * a * d * np.cos(way)) / (2 * b * c)
    return bool(np.abs(cosines).max() <= np.cos(least))


@pytest.mark.parametrize(
    ("places", "degrees"),
    [([(0.3, -0.7), (1.2, 1.3)], 40), pytest.param([(1.1, -1.0), (-0.6, 0.2)], 30, marks=pytest.mark.slow)],
)
def test_no_four_bar_of_a_sample_has_pivots_nearer_to_preferred_ones(places, degrees):
    least, wanted = np.radians(degrees), np.array([complex(*place) for place in places])
    found = synthesise(THREE, demands=Demands(near_pivots=places, transmission=least))
    best = next(design for design in found.designs if design.form == "RR-RR")
    frame = [complex(e.x, e.y) for (_, link), e in best.linkage.elements.items() if link == "frame"]
    distances = [np.linalg.norm(np.array(some) - wanted) for some in (frame, frame[::-1])]
    assert best.verdict.pivot_distance == pytest.approx(min(distances), rel=1e-12)
    assert does_it(THREE, *frame, least - 1e-3)
    assert [each.verdict.pivot_distance for each in found.designs if each.form == "RR-RR"][1:] >= [min(distances)]
    rng = np.random.default_rng(1)
    nearer = 0
    for _ in range(4000):
        step = rng.normal(size=2 * len(wanted))
        step *= 0.97 * min(distances) * rng.uniform() ** (1 / len(step)) / np.linalg.norm(step)
        pivots = list(map(complex, wanted + step.view(np.complex128)))
        nearer += any(does_it(THREE, *some, least) for some in (pivots, pivots[::-1]))
    assert nearer == 0


@pytest.mark.parametrize("count", [*(pytest.param(count, marks=pytest.mark.slow) for count in (2, 3)), 4])
def test_pivots_of_a_known_linkage_are_found_again(count):
    bar = FourBar(2, 6, 5, 7).linkage({"P": (3.0, 2.5)})
    from gruebler.mechanics.kinematics import move

    motion = move(bar, np.linspace(0.4, 2.2, count))
    points, angles = motion.complex_point("P"), motion.angle("coupler")
    task = PositionTask([(z.real, z.imag, float(a)) for z, a in zip(points, angles, strict=True)])
    found = synthesise(task, demands=Demands(near_pivots=[(7, 0), (0, 0)]))
    assert found.designs[0].verdict.pivot_distance < 2e-3
    far = Demands(near_pivots=[(7 + 1e4, 3e3), (1e4, 3e3)])
    away = synthesise(task.shifted(1e4, 3e3), demands=far)
    assert away.designs[0].verdict.pivot_distance < 2e-3


@pytest.mark.parametrize("count", [2, 3, 4])
@pytest.mark.parametrize("kind", [None, SLIDER, BLOCK])
def test_shifts_of_pairs_are_those_of_their_linkages(count, kind):
    rng = np.random.default_rng({4: 7}.get(count, count))
    along = np.arange(count)[:, None] * [1, 0.3]
    rows = np.column_stack([rng.normal(size=(count, 2)) * 0.2 + along, 0.4 * np.arange(count)])
    task = PositionTask(rows.tolist())
    turning = [dyad for dyad in guiding_dyads(task, 49) if not dyad.slides]
    others = turning if kind is None else sliding_sample(task, kind, ANY, 25) if count < 4 else guiding_dyads(task, 300)
    others = [dyad for dyad in others if dyad.kind == (kind or turning[0].kind)]
    facts = pair_facts(task, turning, others, ANY)
    shifts = facts.shifts(facts.moves)
    some = np.argwhere(facts.moves)
    checked = 0
    for i, j in some[rng.permutation(len(some))[:12]]:
        linkage = linkage_of_dyads(turning[i], others[j], complex(task.origins[0]), "mm")
        design = judge_design(linkage, body_targets(task, linkage), ANY, "")
        checked += bool(design.drives)
        if design.drives:
            assert shifts[i, j] == pytest.approx(design.relative_sensitivity, rel=1e-7)
    assert checked >= 3


@pytest.mark.parametrize(
    "task",
    [
        FunctionTask([0.2, 0.9, 1.4], outputs=[0.1, 0.5, 1.3], start_input=False, start_output=False),
        FunctionTask([0.2, 0.9, 1.4], outputs=[1, 3, 8], output="travel", start_input=False, start_output=False),
    ],
    ids=["angle", "travel"],
)
def test_the_least_sensitive_pairs_are_sought(task):
    """No linkage of the whole sample is less sensitive, by the derivatives of its closing conditions."""
    found = synthesise(task, demands=Demands(transmission=np.radians(40)), sort="sensitivity")
    own = [design for design in found.designs if design.form in ("four-bar", "slider-crank")]
    dyads = sampled_by_starts(task)
    facts = _facts(task, dyads)
    good = facts.moves & (facts.transmission >= np.radians(40)) & (facts.size_ratio <= 20)
    closed = facts.shifts(good)
    usual = synthesise(task, demands=Demands(transmission=np.radians(40)))
    assert own[0].relative_sensitivity < min(each.relative_sensitivity for each in usual.designs)
    assert own[0].relative_sensitivity <= closed.min() * (1 + 1e-9)
    assert [each.relative_sensitivity for each in own] == sorted(each.relative_sensitivity for each in own)


def test_the_least_sensitive_positions_are_sought():
    demands = Demands(transmission=np.radians(40))
    usual, sought = (synthesise(THREE, demands=demands, sort=sort) for sort in ((), "sensitivity"))
    best = [
        min(each.relative_sensitivity for each in found.designs if each.form == "RR-RR") for found in (usual, sought)
    ]
    assert best[1] < 0.8 * best[0]
    said = [str(note) for note in sought.notes]
    assert any("2e-05 sizes" in note for note in said)


@pytest.mark.parametrize("places", [[(0, 0)] * 3, [(0, float("nan"))], [(0, 1e300)], [(1,)], "ab", 5])
def test_what_is_no_place_is_refused(places):
    with pytest.raises(SynthesisError, match="near_pivots"):
        Demands(near_pivots=places)


@pytest.mark.parametrize(
    "task", [FunctionTask([0.2, 0.9, 1.4], outputs=[0.1, 0.5, 1.3]), DeadCentreTask(swing=1, time_ratio=1.2)]
)
@pytest.mark.parametrize("demands", [Demands(near_pivots=[(0, 0)]), Demands(region=(0, 0, 1, 1))])
def test_places_of_pivots_need_a_place_in_the_plane(task, demands):
    """Linkages that can be put anywhere were all rejected for a region, and none was said to be proved."""
    with pytest.raises(SynthesisError, match="any other linkage can be put there"):
        synthesise(task, demands=demands)


def test_preferred_pivots_need_a_place_in_the_plane():
    demands = Demands(near_pivots=[(0, 0)])
    with pytest.raises(SynthesisError, match="near_pivots"):
        synthesise(THREE, sort="near-pivots")
    document = {"points": [[0, 0], [1, 0], [2, 1]], "demands": {"near_pivots": [[0, 0], [6, 1]]}}
    assert specification_from_json(document).demands.near_pivots == ((0.0, 0.0), (6.0, 1.0))
    found = synthesise(PathTask([(0, 0), (1, 0.4), (2, 0.2)]), demands=demands)
    away = [design.verdict.pivot_distance for design in found.designs]
    assert away == sorted(away)
    assert synthesise(THREE, demands=demands).designs[0].verdict.pivot_distance < 1e-9


def test_the_table_names_the_distance(tmp_path, capsys, monkeypatch):
    searches = made_once(monkeypatch, "synthesise_positions")
    rows = "\n".join(",".join(map(str, (x, y, np.degrees(a)))) for x, y, a in THREE.positions)
    (tmp_path / "three.csv").write_text(f"x,y,angle\n{rows}\n")
    command = ["synthesise", "positions", str(tmp_path / "three.csv"), "--near-pivot", "0.3", "-0.7", "--number", "4"]
    assert main(command) == 0
    assert "from preferred pivots" in capsys.readouterr().out
    assert main([*command, "--json"]) == 0
    first = json.loads(capsys.readouterr().out)["designs"][0]
    assert first["pivot_distance"] < 1e-6
    assert len(searches) == 1


@pytest.mark.parametrize("pairs", [pytest.param(5, marks=pytest.mark.slow), 8])
def test_what_a_slider_travels_counts_as_a_length_of_linkages_that_follow_a_function(pairs):
    """Of optima and of least squares, too: one ten times as long as its way is not said to have a ratio of 1.2."""
    law = FunctionLaw("log10(x)", interval=(1, 2), input_swing=np.radians(60), output_swing=10.0)
    task = function_task(law, 5, output="travel")
    if pairs > 5:
        x = np.linspace(1, 2, pairs)
        inputs, outputs = np.radians(60) * (x - 1), 10 * np.log10(x) / np.log10(2)
        task = FunctionTask(inputs, outputs=outputs, output="travel", start_input=False, start_output=False)
    found = synthesise(task, minimax=pairs == 5)
    assert found.designs
    for design in found.designs:
        linkage = design.linkage
        lengths = [linkage.length("crank", 0, 1), linkage.length("coupler", 1, 2)]
        assert design.verdict.size_ratio == pytest.approx(max(lengths) / min(*lengths, 10.0), rel=1e-9)
    limited = synthesise(task, minimax=pairs == 5, demands=Demands(size_ratio=5))
    assert not any(max(each.linkage.length("crank", 0, 1), 0) > 50 for each in limited.designs)
