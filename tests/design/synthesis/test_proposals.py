"""From specifications to machines of several types: what is tried, what is best, what is kept clear."""

import math
import re
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.cli.design import _type_row
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    PathTask,
    PositionTask,
    pareto,
    proposals,
    synthesise,
    synthesise_path,
)
from gruebler.design.synthesis.clearances import guided_link, stays_clear
from gruebler.design.synthesis.dyad_structures import dyad_structure, link_motions
from gruebler.design.synthesis.fitting import links_moved_by_all
from gruebler.design.synthesis.proposals import TriedType, _by_own_names, candidate_types, propose
from gruebler.design.synthesis.specification import Clearance, Specification
from gruebler.design.synthesis.structures import fit_structure, synthesise_structures
from gruebler.files.specifications import read_specification, specification_from_json
from gruebler.mechanics.analysis import transmission_angle
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.pictures.designs.picture import design_figure
from gruebler.structure.mechanism import Mechanism

SIDE_BY_SIDE = "R(0-1) R(0-2) R(2-3) R(3-1) R(0-4) R(4-5) R(5-1); frame=0; drive=R(0-1)"
SWING = DeadCentreTask(swing=math.radians(60), time_ratio=1.2)
HOOD = PositionTask([(0, 0, 0), (-1, 2, math.radians(25)), (-1, 3, math.radians(50))], unit="cm")
DEMANDS = Demands(transmission=math.radians(30), region=(-20, -25, 40, -2), size_ratio=5)


@cache
def hood_search():
    return synthesise(HOOD, demands=DEMANDS)


@pytest.fixture(scope="module")
def hinges():
    return hood_search().designs[:8]


def test_the_swing_of_alt_has_its_best_transmission_angle():
    """60 degrees in 196.36 degrees of the crank: 40.315 degrees by a search over 40,001 places of the pivot."""
    found = propose(Specification(SWING, links=4, demands=Demands(crank=True)))
    best = max(row.transmission for row in found.best)
    assert math.degrees(best) == pytest.approx(40.315, abs=0.01)
    assert [each.mechanism for each in found.tried] == [None]


def test_types_are_those_of_watt_and_stephenson():
    """Watt's chain has 2 frames, Stephenson's 3; R drives at the frame up to symmetry, an output off the drive.

    Watt's chain has two ternary links, side by side: as frame it has drives at its two kinds of joint, as has a binary
    frame: 4. Stephenson's chain has two ternary links apart: three kinds of frame, with 2, 1 and 2 kinds of drive: 5.
    Watt II whose ternary link is driven is two four-bars side by side: whatever link does the task, two are idle. Where
    only a link at the frame may be the output, so they are in Watt I (2) and Stephenson I (1), behind the four-bar.
    """
    for task, count in ((SWING, 9 - 1 - 2 - 1), (HOOD, 9 - 1), (PathTask([(0, 0), (1, 1), (2, 0)]), 9 - 1)):
        types = candidate_types(Specification(task))
        assert len(types) == count
        assert len(set(types)) == count
        assert {len(each.chain.links) for each in types} == {6}
        assert all(each.drives[0].turning and each.frame in each.drives[0].between for each in types)
    assert candidate_types(Specification(SWING, links=4)) == ()


def test_two_four_bars_side_by_side_are_no_six_bar():
    """Both dyads hang on crank and frame: the motion of each link needs one of them."""
    pair = Mechanism.parse(SIDE_BY_SIDE)
    assert links_moved_by_all(pair) == ()
    for task in (SWING, PathTask([(0, 0), (1, 1), (2, 0), (1, -1)], closed=True)):
        with pytest.raises(SynthesisError, match="a smaller mechanism does the same"):
            synthesise_structures(task, [pair])
    found = synthesise_structures(PathTask([(0, 0), (1, 1), (2, 0), (1, -1)], closed=True), [pair], starts=1, link="3")
    assert {design.linkage.points["P"].link for design in (*found.designs, *found.rejected)} == {"3"}


def test_links_that_fewer_links_move_carry_no_point():
    """A dyad is idle if the link moves as before wherever the joint in the middle of the dyad lies."""
    rng, moved = np.random.default_rng(2), []
    for mechanism in (*candidate_types(Specification(HOOD)), Mechanism.parse(SIDE_BY_SIDE)):
        structure = dyad_structure(mechanism)
        if structure is None:
            continue
        drawn, turn = rng.normal(size=(7, 1)) + 1j * rng.normal(size=(7, 1)), np.array([1e-3])
        for link in structure.coupler_links:
            idle = []
            for dyad in structure.dyads:
                other = drawn.copy()
                other[dyad.inner] += 0.01
                turns = [link_motions(structure, each, turn)[link][0] for each in (drawn, other)]
                idle.append(turns[0] == pytest.approx(turns[1], abs=1e-12))
            moved.append(link in links_moved_by_all(mechanism))
            assert moved[-1] == (not any(idle)), (mechanism, link)
    assert sorted(moved) == [False] * 7 + [True] * 8


def test_what_has_no_transmission_angle_is_not_fitted():
    """All links but crank and frame of Stephenson's second kind, driven beside its frame, make one group."""
    (mechanism,) = (each for each in candidate_types(Specification(SWING)) if each.text().endswith("drive=R(4-5)"))
    path = PathTask([(0, 0), (1, 1), (2, 0), (1, -1), (0.5, -1)], closed=True)
    design = fit_structure(path, mechanism, Demands(transmission=0.3))
    assert not design.verdict.accepted
    assert "there is no transmission angle" in str(design.verdict.reasons[0])


def test_lengths_of_crank_and_frame_are_those_of_every_type():
    specification = Specification(SWING, demands=Demands(lengths={"crank": 2, "frame": 5}))
    for mechanism in candidate_types(specification):
        (crank, short), (frame, long) = _by_own_names(specification.demands, mechanism).lengths
        driven = mechanism.chain.joints[mechanism.drives[0].joint].links
        assert (set(driven), frame, short, long) == ({crank, frame}, mechanism.frame, 2, 5)


def test_a_travel_has_a_slide():
    stroke = Specification(DeadCentreTask(stroke=50, time_ratio=1.2))
    types = candidate_types(stroke)
    assert types
    for each in types:
        (slide,) = (joint for joint in each.chain.joints if joint.pair.is_sliding)
        assert each.frame in slide.links


def test_a_six_bar_is_judged_as_a_four_bar_is():
    """Over the whole turn, and Watt's six-bar as a chain of two four-bars at both of them."""
    watt = candidate_types(Specification(SWING))[0]
    found = synthesise_structures(SWING, [watt], Demands(crank=True), starts=2)
    design = found.designs[0]
    turn = np.linspace(0, 2 * math.pi, 2001) + design.drives[0] if design.drives else None
    motion = move_quietly(design.linkage, turn, order=2)
    swing = motion.angle(design.linkage.outputs[0])
    assert motion.complete
    assert np.degrees(np.ptp(np.unwrap(swing))) == pytest.approx(60, abs=0.01)
    # there and back, as that of a four-bar
    assert transmission_angle(motion).min() == pytest.approx(design.verdict.transmission, abs=1e-3)


def test_sizes_do_not_count_where_the_task_has_angles_alone():
    found = propose(Specification(SWING, links=4)).result
    small = replace(found, designs=tuple(replace(d, linkage=d.linkage.scaled(0.01)) for d in found.designs))
    assert [row.size for row in pareto(found)] == pytest.approx([row.size for row in pareto(small)])
    assert all(row.size == row.design.verdict.size_ratio for row in pareto(found))


def test_rounding_orders_no_exact_designs():
    found = propose(Specification(SWING, links=4)).result

    def exact(error, transmission, size_ratio):
        verdict = replace(found.designs[0].verdict, error=error, transmission=transmission, size_ratio=size_ratio)
        return replace(found.designs[0], verdict=verdict)

    table = pareto(replace(found, designs=(exact(0.0, 0.7, 2.4), exact(2e-16, 0.9, 2.6), exact(1e-16, 0.8, 2.5))))
    assert [row.transmission for row in table] == [0.9, 0.8, 0.7]


def test_types_with_a_name_are_told_by_it():
    found = propose(Specification(SWING, links=4)).result
    watt = TriedType(mechanism=candidate_types(Specification(SWING))[0], result=found)
    assert _type_row(watt, "en")[0].startswith("Watt II: R(0-1) ")
    assert _type_row(watt, "de")[1] == "6"


def _gap(design, clearance, count=1001):
    """The least distance of the corners of each line from points of the other, by a fine walk: another method."""
    drives = np.interp(np.linspace(0, 1, count), np.linspace(0, 1, len(design.drives)), design.drives)
    motion = move_quietly(design.linkage, drives)
    at = motion.angle(guided_link(design))
    body, obstacle = (_dense(line) for line in clearance.outlines)
    place = motion.complex_point("P")
    moved = place[:, None] + np.exp(1j * (at - at[0]))[:, None] * (body - place[0])
    return min(float(np.abs(row[:, None] - obstacle).min()) for row in moved[::4])


def _dense(line, count=60):
    parts = [np.linspace(a, b, count) for a, b in pairwise(line)]
    return np.concatenate(parts)


@pytest.mark.parametrize("distance", [0.2, 1.0, 2.0])
def test_what_stays_clear_is_that_by_a_fine_walk(hinges, distance):
    clearance = Clearance([(-3, 0.5), (0, 1), (30, 4)], obstacle=[(-3, -2), (-5, 0), (-25, 15)], distance=distance)
    gaps = [_gap(design, clearance) for design in hinges]
    sure = [k for k, gap in enumerate(gaps) if abs(gap - distance) > 0.05]  # points of the walk are so far apart
    assert len(sure) > len(hinges) // 2
    assert [stays_clear(hinges[k], clearance) for k in sure] == [gaps[k] > distance for k in sure]


def _coupler_point(phi, lengths=(30, 80, 75, 90), place=40 + 30j):
    """By hand: where two circles meet."""
    a, b, c, d = lengths
    pin = a * np.exp(1j * phi)
    to_pivot = d - pin
    distance = abs(to_pivot)
    along = (b**2 - c**2 + distance**2) / (2 * distance)
    coupler = (along + 1j * math.sqrt(b**2 - along**2)) * to_pivot / distance
    return pin + place * coupler / b


def test_a_body_on_a_closed_path_keeps_clear_between_the_last_target_and_the_first():
    points = [_coupler_point(math.radians(angle)) for angle in range(0, 300, 30)]
    task = PathTask([(z.real, z.imag) for z in points], closed=True)
    exact = synthesise_path(task, Demands(crank=True), number=1).designs[0]
    assert exact.verdict.error < 1e-9
    body = [(points[0].real, points[0].imag), (points[0].real, points[0].imag + 0.1)]
    for angle, clear in ((285, False), (315, False), (345, False), (135, False), (315.0 + 15j, True)):
        at = _coupler_point(math.radians(angle.real)) + angle.imag
        post = Clearance(body, obstacle=[(at.real - 1, at.imag), (at.real + 1, at.imag)], distance=0.5)
        assert stays_clear(exact, post) == clear


def test_an_obstacle_on_the_way_rejects_what_it_touches(monkeypatch):
    asked = []
    monkeypatch.setattr(
        proposals, "synthesise", lambda task, *, demands: asked.append((task, demands)) or hood_search()
    )
    post = Clearance([(0, 0), (30, 0)], obstacle=[(15, 3), (15, 30)])
    free = propose(Specification(HOOD, demands=DEMANDS, links=4))
    blocked = propose(Specification(HOOD, demands=DEMANDS, links=4, clear=(post,)))
    assert asked == [(HOOD, DEMANDS)] * 2  # what they ask for is one search
    assert free.best
    assert not blocked.best
    reason = blocked.tried[0].reason
    assert reason is not None
    assert str(reason) == "the body comes too near to obstacle 1"
    assert reason.in_language("de") == "der Körper kommt dem Hindernis 1 zu nahe"
    assert not blocked.result.designs


def test_files_have_all_keys(tmp_path):
    path = tmp_path / "hood.toml"
    path.write_text(
        "positions = [[0, 0, 0], [-1, 2, 25], [-1, 3, 50]]\nunit = 'cm'\nlinks = 4\n[demands]\ntransmission = 30\n"
        "region = [-20, -25, 40, -2]\nsize_ratio = 5\n[[clear]]\nbody = [[0, 0], [1, 0]]\nobstacle = [[0, 2], [1, 2]]\n"
    )
    clear = (Clearance([(0, 0), (1, 0)], obstacle=[(0, 2), (1, 2)]),)
    assert read_specification(path) == Specification(HOOD, demands=DEMANDS, links=4, clear=clear)
    assert specification_from_json({"stroke": 50, "time_ratio": 1.2}).demands.size_ratio == 20


@pytest.mark.parametrize(
    ("document", "words"),
    [
        ({"swing": 60, "time_ratio": 1.2, "links": 5}, "links: expected 4 or 6, but found 5"),
        (
            {"stroke": 6, "time_ratio": 1.2, "sliding_joints": 0},
            "sliding_joints: expected a whole number of at least 1",
        ),
        ({"swing": 60, "time_ratio": 1.2, "demands": {"lengths": {"coupler": 1}}}, "links = 4"),
        ({"swing": 60, "time_ratio": 1.2, "demands": {"angle": 1}}, "angle"),
        (
            {"swing": 60, "time_ratio": 1.2, "clear": [{"body": [[0, 0], [1, 1]], "obstacle": [[0, 2], [1, 2]]}]},
            "only a body on positions or a path",
        ),
        (
            {"points": [[0, 0], [1, 1]], "clear": [{"body": [[0, 0]], "obstacle": [[0, 2], [1, 2]]}]},
            "at least two points",
        ),
        (
            {
                "points": [[0, 0], [1, 1]],
                "clear": [{"body": [[0, 0], [1, 0]], "obstacle": [[0, 2], [1, 2]], "distance": -1}],
            },
            "distance: expected a length, at least 0, but found -1",
        ),
        (
            {"points": [[0, 0], [1, 1]], "clear": [{"body": [[0, 0], [1, "x"]], "obstacle": [[0, 2], [1, 2]]}]},
            "clear 1, body 2: expected a number, but found 'x'",
        ),
    ],
)
def test_mistakes_name_their_key(document, words):
    with pytest.raises(SynthesisError, match=words):
        specification_from_json(document)


TUTORIAL = Path(__file__).parents[3] / "docs/tutorials/several-types.md"


def _wish(name, tmp_path):
    """The specification of the tutorial with that name."""
    found = re.search(rf":::{{file}} {name}\n(.*?):::", TUTORIAL.read_text(encoding="utf-8"), re.DOTALL)
    path = tmp_path / name
    path.write_text(found[1], encoding="utf-8")
    return replace(read_specification(path), links=4)


@pytest.mark.slow
def test_a_foot_with_a_flat_step(tmp_path):
    """The path by intersecting circles: flat along the ground between the points too, in the air above it."""
    wish = _wish("foot.toml", tmp_path)
    best = propose(wish).best[0].design
    assert best.verdict.turns_fully
    assert best.verdict.transmission >= math.radians(25)
    pins = {key: complex(element.x, element.y) for key, element in best.linkage.elements.items()}
    point = best.linkage.points["P"]
    own, far = pins[0, "frame"], pins[3, "frame"]
    a, b, c = (
        abs(pins[k, link] - pins[m, link]) for k, m, link in ((0, 1, "crank"), (1, 2, "coupler"), (2, 3, "rocker"))
    )
    pin = own + a * np.exp(1j * np.linspace(0, 2 * math.pi, 2000))
    gap = far - pin
    along = (b * b - c * c + np.abs(gap) ** 2) / (2 * np.abs(gap))
    seen = (complex(point.x, point.y) - pins[1, "coupler"]) / (pins[2, "coupler"] - pins[1, "coupler"])
    sides = (1, -1)
    turned = [gap / np.abs(gap) * (along + 1j * side * np.sqrt(b * b - along**2)) for side in sides]
    paths = [pin + seen * each for each in turned]
    z = min(paths, key=lambda path: np.abs(path[:, None] - wish.task.z).min(axis=0).max())
    step = np.abs(z[(np.abs(z.real) < 50) & (z.imag < 8)].imag)
    assert len(step) > 100
    assert step.max() < 0.006 * 120
    assert z.imag.max() == pytest.approx(25, abs=1)


@pytest.mark.parametrize(("name", "transmission"), [("swing.toml", 40.3), ("hood-clear.toml", 30)])
def test_wishes_of_the_tutorial_have_designs_with_pictures(name, transmission, tmp_path):
    """A swing of 60 degrees with the time ratio 1.2; a hood that opens clear of the windscreen."""
    wish = _wish(name, tmp_path)
    best = propose(wish).best
    assert all(row.transmission >= wish.demands.transmission for row in best)
    assert max(row.transmission for row in best) >= math.radians(transmission - 0.05)
    assert all(stays_clear(row.design, each) for row in best for each in wish.clear)
    assert "<svg" in design_figure(wish.task, best[0].design, clear=wish.clear).svg()
