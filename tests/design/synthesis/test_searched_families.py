"""The best of families by what is asked for, against a differential evolution over them by another program."""

import numpy as np
import pytest
from scipy.optimize import differential_evolution

from gruebler.design.synthesis import Demands, FunctionTask, PathTask, PositionTask, synthesise
from gruebler.design.synthesis.results import ORDERS
from tests.design.synthesis.own_ways import (
    Block,
    Body,
    Crank,
    Rocker,
    Slider,
    TimedCoupler,
    circle_centre,
    concyclic,
    judged,
)

FAR = 6.0  # sizes: as far lie the pivots that the other program tries, denser near the task
NONE = 1e3
PLACES = {"near-pivots": [(0.5, -1.0)]}


def random_positions(count, seed):
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.normal(size=(count, 2)), rng.uniform(-1.5, 1.5, count)]).tolist()


def evolved(cost, bounds):
    return differential_evolution(cost, bounds, seed=0, maxiter=40, popsize=12, tol=1e-10, polish=False).fun


def value_of(found, measure, least):
    """Of what is judged: a value of the measure, larger ones where a demand is not met."""
    if found is None:
        return NONE
    fails = max(0.0, found["size-ratio"] / 20 - 1) + max(0.0, least + found["transmission"])
    return NONE / 2 + fails if fails else found[measure]


def best_of_evolution(positions, form, measure, least):
    """The best value by a differential evolution of all numbers of the family."""
    body, places = Body(positions), [complex(*place) for place in PLACES.get(measure, ())]
    two = len(positions) == 2

    def place(x, y):
        return body.origins[0] + FAR * body.size * complex(x * abs(x), y * abs(y))

    def turning(numbers):
        pivot = place(*numbers[:2])
        return pivot, body.pins(pivot, np.tan(1.5 * numbers[2]) if two else 0.0)

    def cost(numbers):
        count = 3 if two else 2
        crank = Crank(*turning(numbers))
        if form == "RR":
            other = Rocker(*turning(numbers[count:]), crank)
        else:
            rest = numbers[count:]
            if two:
                rest = [part.item() for part in np.array([place(*rest)]).view(float)]
            other = (body.slider if form == "PR" else body.block)(rest, crank)
        with np.errstate(all="ignore"):
            return value_of(judged(crank, other, body.size, places), measure, least)

    turning_bounds = [(-1, 1)] * (3 if two else 2)
    others = {"RR": turning_bounds}.get(form, [(-1, 1)] * 2 if two else [(0, np.pi)])
    return evolved(cost, [*turning_bounds, *others])


@pytest.mark.parametrize(
    ("count", "seed", "measure", "degrees"),
    [
        pytest.param(3, 0, "range-transmission", 0, marks=pytest.mark.slow),
        pytest.param(3, 0, "size", 40, marks=pytest.mark.slow),
        pytest.param(3, 1, "near-pivots", 52, marks=pytest.mark.slow),
        pytest.param(2, 0, "range-transmission", 0, marks=pytest.mark.slow),
        (2, 0, "size-ratio", 55),
    ],
)
def test_linkages_of_positions_are_the_best_by_what_is_asked_for(count, seed, measure, degrees):
    """Never worse than the other program by more than 0.001, in radians, lengths of the task or of the ratio."""
    positions, least = random_positions(count, seed), np.radians(degrees)
    demands = Demands(transmission=least, near_pivots=PLACES.get(measure, ()))
    found = synthesise(PositionTask(positions), demands=demands, sort=measure)
    for form in ("RR", "PR", "RP"):
        own = min(ORDERS[measure](design) for design in found.designs if design.form == f"RR-{form}")
        assert own <= best_of_evolution(positions, form, measure, least) + 1e-3, form
    said = [str(note) for note in found.notes]
    for linkages in ("four-bars", "linkages RR-PR", "linkages RR-RP"):
        assert any(f"random {linkages} that meet" in note and "fewer than 0.01" in note for note in said), said


@pytest.mark.parametrize(
    ("outputs", "output", "measure", "degrees"),
    [
        ([0.1, 0.5, 1.3], "angle", "range-transmission", 0),
        ([0.1, 0.5, 1.3], "angle", "size-ratio", 45),
        ([1.0, 3.0, 8.0], "travel", "range-transmission", 0),
        ([1.0, 3.0, 8.0], "travel", "size", 45),
    ],
)
def test_linkages_of_pairs_are_the_best_by_what_is_asked_for(outputs, output, measure, degrees):
    """Never worse by more than a part of 0.002: each pin of the output has one crank, as three positions of it have."""
    inputs, least = np.array([0.2, 0.9, 1.4]), np.radians(degrees)
    task = FunctionTask(inputs, outputs=outputs, output=output, start_input=False, start_output=False)
    found = synthesise(task, demands=Demands(transmission=least), sort=measure)
    turns, moved = np.exp(1j * (inputs - inputs[0])), np.array(outputs) - outputs[0]
    size = 1.0 if output == "angle" else np.ptp(outputs)

    def cost(numbers):
        pin = FAR * size * complex(*(numbers * abs(numbers)))
        pins = 1 + (pin - 1) * np.exp(1j * moved) if output == "angle" else pin + moved
        crank = Crank(0j, circle_centre(pins / turns) * turns)
        other = Rocker(1 + 0j, pins, crank) if output == "angle" else Slider(1 + 0j, pins, crank)
        with np.errstate(all="ignore"):
            return value_of(judged(crank, other, size), measure, least)

    best = evolved(cost, [(-1, 1)] * 2)
    assert best < NONE / 2
    assert ORDERS[measure](found.designs[0]) <= best + 0.002 * abs(best)


POINTS, TIMES = [(0, 0), (1, 0.4), (2, 0.2), (2.5, -0.5)], np.radians([0, 40, 90, 120]).tolist()


@pytest.mark.parametrize(
    ("count", "measure", "degrees"),
    [
        (3, "transmission", 0),
        pytest.param(3, "near-pivots", 40, marks=pytest.mark.slow),
        pytest.param(4, "range-transmission", 0, marks=pytest.mark.slow),
        (4, "near-pivots", 40),
        pytest.param(4, "size", 40, marks=pytest.mark.slow),
    ],
)
def test_linkages_of_timed_points_are_the_best_by_what_is_asked_for(count, measure, degrees):
    """Never worse by more than 0.002; before, of a few linkages the best were 59 degrees, where 88.9 are had."""
    task, least = PathTask(POINTS[:count], crank_angles=TIMES[:count]), np.radians(degrees)
    places = PLACES.get(measure, ())
    found = synthesise(task, demands=Demands(transmission=least, near_pivots=places), sort=measure)
    coupler, wanted = TimedCoupler(POINTS[:count], TIMES[:count]), [complex(*place) for place in places]

    def value(crank, other):
        return value_of(judged(crank, other, coupler.size, wanted), measure, least)

    def cost(numbers):
        with np.errstate(all="ignore"):
            if count == 3:
                first, *rest = FAR * coupler.size * (numbers * abs(numbers)).reshape(-1, 2) @ [1, 1j]
                crank, turned = coupler.crank(first)
                return value(crank, coupler.rocker(rest[0], crank, turned))
            about, values = coupler.points.mean(), [NONE]
            for pivot in concyclic(coupler.points, coupler.turns, about, np.exp(1j * numbers[0])):
                crank, turned = coupler.crank(pivot)
                others = concyclic(crank.pins - turned * crank.pins[0], turned, about, np.exp(1j * numbers[1]))
                for far in others:
                    if abs(far - pivot) > 1e-6:
                        values.append(value(crank, coupler.rocker(far, crank, turned)))
            return min(values)

    best = evolved(cost, [(-1, 1)] * 4 if count == 3 else [(0, np.pi)] * 2)
    assert best < NONE / 2
    assert min(ORDERS[measure](each) for each in found.designs if each.form == "RR-RR") <= best + 0.002
    said = " ".join(map(str, found.notes))
    assert ("256 random four-bars" if count == 3 else "steps down to 0.0001 sizes") in said
    assert all(each.verdict.error < 1e-9 for each in found.designs)
    assert {each.form for each in found.designs} == {"RR-RR", "RR-PR", "RR-RP"}


def test_sliders_of_timed_points_are_the_best_by_what_is_asked_for():
    found = synthesise(PathTask(POINTS[:3], crank_angles=TIMES[:3]), sort="range-transmission")
    coupler = TimedCoupler(POINTS[:3], TIMES[:3])

    def cost(numbers):
        with np.errstate(all="ignore"):
            x, y, angle = numbers
            crank, turned = coupler.crank(FAR * coupler.size * complex(x * abs(x), y * abs(y)))
            other = coupler.slider(np.pi * angle, crank, turned)
            return value_of(judged(crank, other, coupler.size), "range-transmission", 0.0)

    best = evolved(cost, [(-1, 1)] * 3)
    assert best < -1.0
    assert min(-each.transmission_over_range for each in found.designs if each.form == "RR-PR") <= best + 0.002


@pytest.mark.parametrize(
    ("measure", "degrees"), [pytest.param("range-transmission", 0, marks=pytest.mark.slow), ("near-pivots", 40)]
)
def test_four_bars_through_three_points_are_the_best_by_what_is_asked_for(measure, degrees):
    """The crank turns as it likes; the six best of eight choices of its turns, improved, had pivots 1 size too far."""
    places, least = PLACES.get(measure, ()), np.radians(degrees)
    found = synthesise(PathTask(POINTS[:3]), demands=Demands(transmission=least, near_pivots=places), sort=measure)

    def cost(numbers):
        with np.errstate(all="ignore"):
            coupler = TimedCoupler(POINTS[:3], [0, *(np.pi * numbers[4:])])
            first, second = FAR * coupler.size * (numbers[:4] * abs(numbers[:4])).reshape(2, 2) @ [1, 1j]
            crank, turned = coupler.crank(first)
            done = judged(crank, coupler.rocker(second, crank, turned), coupler.size, [complex(*p) for p in places])
            return value_of(done, measure, least)

    best = evolved(cost, [(-1, 1)] * 6)
    assert best < NONE / 2
    own = [each for each in found.designs if each.form in ("RR-RR", "four-bar")]
    assert min(map(ORDERS[measure], own)) <= best + 0.002
    assert all(each.verdict.error < 1e-9 for each in found.designs)
    assert any("256 random four-bars" in str(note) for note in found.notes)


def test_linkages_with_a_slide_through_points_are_improved_where_a_measure_is_asked_for():
    """Four points in eight choices of crank turns: the best RR-PR had 76.7 degrees, the best RR-RP 55.5."""
    found = synthesise(PathTask(POINTS), sort="transmission")
    best = {each.form: -each.verdict.transmission for each in reversed(found.designs)}
    assert np.degrees(-best["RR-PR"]) > 80
    assert np.degrees(-best["RR-RP"]) > 70


@pytest.mark.parametrize("count", [pytest.param(3, marks=pytest.mark.slow), 4])
def test_timed_points_without_a_design_name_the_tightest_demand(count):
    task = PathTask(POINTS[:count], crank_angles=TIMES[:count])
    found = synthesise(task, demands=Demands(crank=True, size_ratio=1.0001, transmission=np.radians(89.9)))
    assert not found.designs
    assert any("all but the demand of" in str(note) for note in found.notes)
    limited = synthesise(task, demands=Demands(region=(-3, -3, 3, 3), transmission=np.radians(30)))
    assert limited.designs


def test_the_other_program_judges_designs_as_they_are_judged_by_their_motion():
    positions = random_positions(3, 2)
    body = Body(positions)
    found = synthesise(PositionTask(positions), sort="size", number=8)
    assert {design.form for design in found.designs} == {"RR-RR", "RR-PR", "RR-RP"}
    for design in found.designs:
        pose = design.linkage.required_pose
        places = {}
        for (joint, link), element in design.linkage.elements.items():
            links = frozenset(design.linkage.mechanism.chain.joints[joint].links)
            if hasattr(element, "x"):
                places[links] = complex(*pose[link].put(element.x, element.y))
        crank = Crank(places[frozenset({"frame", "crank"})], body.places(places[frozenset({"crank", "coupler"})]))
        assert np.ptp(abs(crank.pins - crank.pivot)) < 1e-9
        if design.form == "RR-RR":
            other = Rocker(
                places[frozenset({"frame", "rocker"})], body.places(places[frozenset({"rocker", "coupler"})]), crank
            )
        elif design.form == "RR-PR":
            pins = body.places(places[frozenset({"slider", "coupler"})])
            direction = (pins[1] - pins[0]) / abs(pins[1] - pins[0])
            assert abs(np.imag(np.conj(direction) * (pins[2] - pins[0]))) < 1e-9
            other = Slider(direction, pins, crank)
        else:
            pivot = places[frozenset({"frame", "block"})]
            seen = body.origins[0] + (pivot - body.origins) / body.turns
            direction = (seen[1] - seen[0]) / abs(seen[1] - seen[0])
            other = Block(pivot, direction * body.turns, crank)
        own = judged(crank, other, body.size)
        assert own["transmission"] == pytest.approx(-design.verdict.transmission, abs=2e-4)
        assert own["range-transmission"] == pytest.approx(-design.transmission_over_range, abs=2e-4)
        assert own["size"] == pytest.approx(design.linkage.size, rel=1e-9)
        assert own["size-ratio"] == pytest.approx(design.verdict.size_ratio, rel=1e-9)
