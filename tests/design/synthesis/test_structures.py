"""Any structure for any task: exact derivatives, tasks taken from mechanisms, several drives, executors."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.realisation import realise
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    FunctionLaw,
    FunctionTask,
    PathTask,
    PositionTask,
    function_task,
    pareto,
    synthesise,
    synthesise_structures,
)
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.first_states import first_state
from gruebler.design.synthesis.fitting import compared, fit_stages, fit_targets, improved
from gruebler.design.synthesis.proposals import TriedType
from gruebler.files.designs import design_to_json, result_to_json
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.kinematics import circuit, move
from gruebler.mechanics.linkages.elements import Line
from gruebler.structure.mechanism import Mechanism
from tests.core.plain.pose_gaps import pose_gaps

FOUR = "R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)"
SLIDER = "R(0-1) R(1-2) R(2-3) P(3-0); frame=0; drive=R(0-1)"
INVERTED = "R(0-1) R(1-2) P(2-3) R(3-0); frame=0; drive=R(0-1)"
STEPHENSON = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(0-1)"
WATT = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3); frame=0; drive=R(0-1)"
SLIDING_SIX = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) P(5-0); frame=0; drive=R(0-1)"
TRIAD = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(5-0)"  # a group of class III
FIVE_BAR = "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); frame=0; drive=R(0-1); drive=R(4-0)"
SLIDING_FIVE_BAR = "P(0-1) R(1-2) R(2-3) R(3-4) P(4-0); frame=0; drive=P(0-1); drive=P(4-0)"

POINTS = 2 * np.exp(0.35j * np.arange(6)) + 0.3 * np.arange(6)
PAIRS = tuple((float(z.real), float(z.imag)) for z in POINTS)
LAW = FunctionLaw("log10(x)", interval=(1, 2), input_swing=np.pi / 3, output_swing=np.pi / 3)
TASKS = {
    "positions": PositionTask([(0, 0, 0), (2.1, 0.9, 0.35), (3.2, 1.0, 0.8), (4.0, 0.2, 1.5)]),
    "points": PathTask(PAIRS),
    "mixed": PathTask(PAIRS, angles=(0, None, 0.2, None, None, 0.5)),
    "timed": PathTask(PAIRS, crank_angles=tuple(0.4 * np.arange(6))),
    "function": function_task(LAW, 5),
    "travel": function_task(
        FunctionLaw("x^2", interval=(0, 1), input_swing=np.pi / 2, output_swing=30), 5, output="travel"
    ),
    "dead centres": DeadCentreTask(swing=1, time_ratio=1.2),
    "stroke": DeadCentreTask(stroke=50, time_ratio=1.2),
}
CASES = (
    ("positions", STEPHENSON),
    ("mixed", TRIAD),
    ("timed", INVERTED),
    ("function", TRIAD),
    ("travel", SLIDING_SIX),
    ("dead centres", STEPHENSON),
    ("stroke", SLIDER),
    ("positions", FIVE_BAR),
    ("points", SLIDING_FIVE_BAR),
)


def begun(task, text, seed=1):
    closure = DesignClosure(realise(Mechanism.parse(text), seed=seed, budget=300).linkage)
    targets = fit_stages(task)[0]
    return closure, targets, first_state(closure, targets, np.random.default_rng(seed))


@pytest.mark.parametrize(("kind", "text"), CASES)
def test_errors_are_differentiated_exactly(kind, text):
    """By the pose, directly by the dimensions, and by what else is free, against differences."""
    closure, targets, state = begun(TASKS[kind], text)
    own = compared(closure, targets, state)
    step = 1e-6

    def moved(name, k, sign):
        values = getattr(state, name).copy()
        values[..., k] += sign * step
        return compared(closure, targets, type(state)(**{**vars(state), name: values})).errors

    for name, slopes in (("q", own.by_pose), ("p", own.by_sizes), ("free", own.by_free)):
        assert slopes.shape[2] == getattr(state, name).shape[-1]
        for k in range(slopes.shape[2]):
            difference = (moved(name, k, 1) - moved(name, k, -1)) / (2 * step)
            assert slopes[:, :, k] == pytest.approx(difference, abs=1e-6 * max(1.0, targets.size))


@pytest.mark.parametrize("text", [SLIDING_SIX, TRIAD, FIVE_BAR, SLIDING_FIVE_BAR])
def test_poses_of_slides_larger_groups_and_several_drives_change_as_derived(text):
    """The derivative of a pose by a dimension, against the pose of the linkage that has the other dimension."""
    linkage = realise(Mechanism.parse(text), seed=2, budget=300).linkage
    closure, size = DesignClosure(linkage), linkage.size
    q = np.array([[v for link in closure.links for v in linkage.reference_pose[link]]])
    derivatives = closure.derivatives(q, closure.sizes, size=size)
    assert derivatives.motion.shape[2] == len(linkage.mechanism.drives)
    by_sizes = derivatives.gradient(np.eye(closure.unknowns)[None])
    weights = np.tile([1 / size, 1 / size, 1], len(closure.links))
    for k in range(len(closure.sizes)):
        step = np.zeros(len(closure.sizes))
        step[k] = 1e-6 * (1 if k in lines(closure) else size)
        moved, good = closure.closed(q, closure.sizes + step, size=size)
        assert good.all()
        assert np.abs(weights * ((moved - q)[0] - by_sizes[0] @ step)).max() < 1e-8
    for freedom in range(derivatives.motion.shape[2]):
        moved = q[0] + 1e-6 * derivatives.motion[0, :, freedom]
        assert pose_gaps(closure.joints, moved, closure.sizes) == pytest.approx(0, abs=1e-9 * size)


def lines(closure):
    return {at + 2 for key, at in closure.start.items() if isinstance(closure.linkage.elements[key], Line)}


def errors(result):
    return [design.verdict.error for design in result.designs]


@pytest.mark.parametrize(("kind", "text"), [CASES[0], CASES[4], CASES[5]])
def test_structures_meet_every_kind_of_task(kind, text):
    """So few targets are met exactly; `move` has the last word, for dead centres the analysis of the motion."""
    result = synthesise(TASKS[kind], structures=[Mechanism.parse(text)], starts=2)
    design = result.designs[0]
    assert design.verdict.error < 1e-8
    if kind == "dead centres":
        found = measures(design.linkage)
        assert (found.travel, found.time_ratio) == pytest.approx((1, 1.2), abs=1e-5)


def test_the_dyad_that_carries_a_body_counts_for_the_transmission_angle():
    """Of Watt's first kind a body hangs on coupler and crank, where the force to the rocker does not go."""
    watt = Mechanism.parse("R(0-1) R(0-2) R(2-3) R(3-1) R(0-4) R(4-5) R(5-1); frame=2; drive=R(0-2)")
    result = synthesise(TASKS["positions"], structures=[watt], starts=2)
    designs = [design for design in (*result.designs, *result.rejected) if np.isfinite(design.verdict.transmission)]
    assert designs
    for design in designs:
        first, ends = design.drives[0], (min(design.drives), max(design.drives))
        for way in (np.linspace(first, end, 1001) for end in ends if end != first):
            motion = move(design.linkage, way)
            pins = [motion.complex_point(f"R({name})") for name in ("0-4", "4-5", "5-1")]
            angle = np.angle((pins[0] - pins[1]) / (pins[2] - pins[1]))
            assert np.degrees(design.verdict.transmission) <= np.degrees(np.arcsin(np.abs(np.sin(angle))).min()) + 0.01


def test_a_swing_has_no_other_dead_centres():
    """A fit sees its output beside two positions: of these two linkages one has four dead centres."""
    watt = Mechanism.parse("R(0-1) R(0-2) R(2-3) R(3-1) R(0-4) R(4-5) R(5-1); frame=0; drive=R(0-2)")
    task = DeadCentreTask(swing=np.pi / 3, time_ratio=1.2)
    result = synthesise(task, structures=[watt], demands=Demands(crank=True), starts=2)
    counts = []
    for design in (*result.designs, *result.rejected):
        crank = design.linkage.required_pose["2"].angle + np.linspace(0, 2 * np.pi, 3601)
        output = move(design.linkage, crank).angle(design.linkage.outputs[0])
        rises = np.diff(output) > 0
        counts.append(int(np.count_nonzero(rises != np.roll(rises, 1))))
        if design.verdict.accepted:
            assert np.ptp(output) == pytest.approx(task.swing, abs=1e-5)
            assert np.count_nonzero(rises) == pytest.approx(task.angle / (2 * np.pi) * 3600, abs=1)
            assert design.verdict.error < 1e-5
    assert counts == [2, 4]
    assert "has 4 dead centres" in str(result.rejected[0].verdict.reasons[-1])


@pytest.mark.slow
@pytest.mark.parametrize("text", [FOUR, SLIDER, INVERTED, STEPHENSON, WATT, SLIDING_SIX, TRIAD])
@pytest.mark.parametrize("seed", range(3))
def test_a_task_taken_from_a_structure_is_met_by_it(text, seed):
    """Positions, crank angles and outputs of a realised mechanism: a design of its structure meets them exactly."""
    mechanism = Mechanism.parse(text)
    known = realise(mechanism, seed=20 + seed, budget=300).linkage
    link = next(
        link
        for link in mechanism.chain.links
        if not any({link, mechanism.frame} <= set(joint.links) for joint in mechanism.chain.joints)
    )
    known = known.with_points({"P": (link, 0.3 * known.size, 0.2 * known.size)})
    course = circuit(known)
    span = course.drive.max() - course.drive.min()
    drive = course.drive.min() + span * np.linspace(0.2, 0.6, 4)  # close positions would hardly tell dimensions apart
    motion = move(known, drive)
    rows = [(*p, a) for p, a in zip(motion.point("P"), motion.angle(link), strict=True)]
    tasks = [PositionTask(rows), PathTask(motion.point("P"), crank_angles=tuple(drive))]
    for task in tasks:
        assert (
            min(
                errors(synthesise(task, structures=[mechanism], demands=Demands(one_branch=False), starts=6, link=link))
            )
            < 1e-9
        )


def test_a_five_bar_carries_a_body_through_positions_by_both_drives():
    task = TASKS["positions"]
    design = synthesise(task, structures=[Mechanism.parse(FIVE_BAR)], starts=1).designs[0]
    motion = move(design.linkage, np.array(design.drive_rows))
    assert np.abs(motion.complex_point("P") - task.origins).max() < 1e-8 * task.size
    carrier = design.linkage.points["P"].link
    turned = motion.angle(carrier) - task.angles
    assert np.abs(np.exp(1j * (turned - turned[0])) - 1).max() < 1e-8
    refused = synthesise(task, structures=[Mechanism.parse(FIVE_BAR)], demands=Demands(crank=True), starts=1)
    assert "none has to turn fully" in str(refused.rejected[0].verdict.reasons[-1])


def shared_by(pool):
    chains = [Mechanism.parse(text) for text in (FOUR, SLIDER)]
    calls = []
    with pool(2) as executor:
        shared = synthesise_structures(
            TASKS["positions"], chains, starts=1, executor=executor, progress=lambda *done: calls.append(done)
        )
    alone = synthesise_structures(TASKS["positions"], chains, starts=1)
    assert calls == [(1, 2), (2, 2)]
    for there, here in ((shared.designs, alone.designs), (shared.rejected, alone.rejected)):
        rows, wanted = [design_to_json(d) for d in there], [design_to_json(d) for d in here]
        errors = [[row.pop("error") for row in side] for side in (rows, wanted)]
        assert rows == wanted
        np.testing.assert_array_equal(*errors)  # to the bit; NaN where nothing was found


def test_threads_share_the_starts():
    shared_by(ThreadPoolExecutor)


@pytest.mark.slow
def test_processes_share_the_starts():
    shared_by(ProcessPoolExecutor)


def test_the_pareto_table_holds_what_nothing_beats():
    result = synthesise(
        TASKS["positions"], structures=[Mechanism.parse(text) for text in (SLIDER, STEPHENSON)], starts=2
    )
    table = pareto(result)

    def costs(design):
        mu = design.verdict.transmission
        return (
            0.0 if design.verdict.error < 1e-9 else design.verdict.error,
            0.0 if np.isnan(mu) else -mu,
            design.linkage.size,
            design.links,
        )

    every = [costs(design) for design in result.designs]
    best = [c for c in every if not any(o != c and all(a <= b for a, b in zip(o, c, strict=True)) for o in every)]
    assert sorted(costs(row.design) for row in table) == sorted(best)
    rows = result_to_json(result)["pareto"]
    assert [result.designs[row["design"]].linkage.size for row in rows] == [row["size"] for row in rows]


def watt_output(a, b, c, d, second, phi):
    """The angle of link 5 of a Watt six-bar, which does not touch the frame, by intersecting circles; pins by hand."""

    def met(centre, radius, other, reach, side):
        gap = other - centre
        along = (radius**2 - reach**2 + np.abs(gap) ** 2) / (2 * np.abs(gap))
        return centre + gap / np.abs(gap) * (along + side * 1j * np.sqrt(radius**2 - along**2))

    on_coupler, on_rocker, rod, output = second
    pin = a * np.exp(1j * phi)
    rocker_pin = met(pin, b, d, c, 1)
    first = pin + on_coupler * (rocker_pin - pin)
    other = d + on_rocker * (rocker_pin - d)
    end = met(first, rod, other, output, 1)
    return np.unwrap(np.angle(end - other))


def test_an_output_that_does_not_touch_the_frame():
    """Nine pairs of a Watt six-bar's link 5, and the motion of the design between its first and last pair."""
    phi = np.linspace(0.3, 2.2, 9)
    angle = watt_output(1.0, 3.1, 2.4, 3.3, (0.5 + 0.6j, 0.6 - 0.4j, 2.6, 2.2), phi)
    task = FunctionTask(tuple(phi), outputs=tuple(angle), start_input=False, start_output=False)
    found = synthesise_structures(task, [Mechanism.parse(WATT)], Demands(size_ratio=100), starts=6, link="5")
    assert found.designs
    best = found.designs[0]
    assert best.linkage.outputs == ("5",)
    turned = move(best.linkage, best.drives).angle("5")
    assert np.abs(np.diff(turned) - np.diff(angle)).max() < 1e-4 * np.ptp(angle)


@pytest.mark.parametrize(
    ("kind", "text", "link", "sentence"),
    [
        ("function", FIVE_BAR, "", "have one drive, but .* has 2"),
        ("function", SLIDER, "", "no link of .* but the driven one turns at the frame"),
        ("travel", FOUR, "", "slides along the frame: there is no travel"),
        ("timed", SLIDING_FIVE_BAR.replace("; drive=P(4-0)", ""), "", "need a drive that turns at the frame"),
        ("positions", FOUR, "7", "the link that carries the point is one of 1, 2, 3, not '7'"),
        ("function", STEPHENSON, "1", "the output is one of 2, 3, 4, 5, not '1'"),
        ("positions", "R(0-1) R(1-2) R(2-0); frame=0; drive=R(0-1)", "", "has no mobility: there is nothing to drive"),
        ("positions", FIVE_BAR.replace("; drive=R(4-0)", ""), "", "Mobility 2, drives: 1"),
    ],
)
def test_what_a_structure_cannot_do_is_refused(kind, text, link, sentence):
    with pytest.raises(SynthesisError, match=sentence):
        synthesise(TASKS[kind], structures=[Mechanism.parse(text)], link=link)


@pytest.mark.parametrize("kind", ["positions", "points", "function", "dead centres"])
def test_lengths_of_links_that_there_are_not_are_refused_with_those_that_there_are(kind):
    """A demand that no design can meet was laid to their size."""
    wanted = Demands(lengths={"foo": 2})
    with pytest.raises(SynthesisError, match="'foo' is given, but only crank, coupler, rocker and frame have one"):
        synthesise(TASKS[kind], demands=wanted)
    with pytest.raises(SynthesisError, match="'foo' is given, but only 0, 1, 2 and 3 have one"):
        synthesise(TASKS[kind], demands=wanted, structures=[Mechanism.parse(FOUR)])
    free = FunctionTask(np.linspace(0, 1, 9), outputs=np.linspace(0, 2, 9), start_input=False, start_output=False)
    with pytest.raises(SynthesisError, match="only frame, crank, coupler, ternary, link and rocker have one"):
        synthesise(free, demands=wanted, six_bars=True)


def test_pivots_that_no_fit_would_hold_are_refused_and_leave_types_out():
    """They were given up without a word: six-bars had their pivots anywhere."""
    task = replace(TASKS["positions"], fixed_pivots=((0, 3), (2, 3)), moving_pivots=((1, 1),))
    with pytest.raises(SynthesisError, match="moving_pivots: only four-bars"):
        synthesise(task, structures=[Mechanism.parse(FOUR)])
    with pytest.raises(SynthesisError, match=r"fixed_pivots: 2 are given, but .* has 1"):
        synthesise(replace(task, moving_pivots=()), structures=[Mechanism.parse(SLIDER)])


def test_the_tightest_demand_is_named_with_what_there_is_without_it():
    """The number is that of a search in which this demand is not made."""
    four, loose = Mechanism.parse(FOUR), Demands(size_ratio=np.inf)
    without = len(synthesise(TASKS["positions"], structures=[four], demands=loose, starts=4).designs)
    assert without
    steep = replace(loose, transmission=1.56)
    found = synthesise(TASKS["positions"], structures=[four], demands=steep, starts=4)
    assert not found.designs
    again = "No design meets all demands. A second search left them out; these are the numbers of its designs:"
    said = f"Designs that meet all but the demand of a transmission angle of 89.3814°: {without}."
    assert str(TriedType(mechanism=four, result=found).reason) == said
    none = synthesise(TASKS["positions"], structures=[four], demands=replace(steep, region=(50, 50, 51, 51)), starts=4)
    both = "a transmission angle of 89.3814° and the region of the fixed pivots"
    assert [*map(str, none.notes[-2:])] == [again, f"Designs that meet all but the demand of {both}: {without}."]


def test_a_fit_does_not_depend_on_the_unit():
    """Steps are damped by the task's size: scaled targets have scaled dimensions."""
    for scale in (1e-3, 1e4):
        plain, scaled = (
            PositionTask([(s * x, s * y, a) for x, y, a in TASKS["positions"].positions]) for s in (1.0, scale)
        )
        sizes = []
        for task in (plain, scaled):
            closure, targets, state = begun(task, FOUR, seed=2)
            sizes.append(improved(closure, state, targets, steps=5).p)
        assert sizes[1] == pytest.approx(scale * sizes[0], rel=1e-6, abs=1e-6 * scale)


def test_targets_of_functions_count_differences_only():
    moved = FunctionTask(
        [v + 0.4 for v in TASKS["function"].inputs], outputs=[v - 1 for v in TASKS["function"].outputs]
    )
    assert compared_shift(moved) == pytest.approx(compared_shift(TASKS["function"]), abs=1e-9)


def compared_shift(task):
    closure, targets, state = begun(task, FOUR)
    return np.sum(compared(closure, fit_targets(task), improved(closure, state, targets, steps=3)).errors ** 2)
