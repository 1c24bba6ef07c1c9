"""Circuits in space: against closed forms, both their branches, the plane, and the ends of the followed range."""

from math import cos, degrees, pi, radians, sin, tau

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics import circuits as plane
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import RSSR, SphericalFourBar, UniversalJoint, circuit, drive_range, measures
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.mechanics.screws import machines
from tests.mechanics.space.test_overconstrained_loops import trihedral

FORMS = {
    "rssr": (RSSR(a=60, b=90, c=50, d=70, crank_offset=10, rocker_offset=15, twist=0.9), 3.0),
    "spherical": (SphericalFourBar(0.9, 0.8, 0.7, 1.0), 0.5),
}
ROCKER = ("R(frame-rocker)", "Rz")


def apart(angles, others):
    """By how much angles differ at most, whole turns left out."""
    return abs(np.exp(1j * np.asarray(angles)) - np.exp(1j * np.asarray(others))).max(initial=0.0)


@pytest.mark.parametrize(("form", "start"), FORMS.values(), ids=FORMS)
def test_a_circuit_goes_through_the_limits_of_the_crank(form, start):
    found = gr.circuit(form.linkage(start))
    assert found.closed
    assert found.drive[-1] == pytest.approx(0, abs=1e-12)
    (arc,) = form.limits
    assert apart(start + np.array([limit.value for limit in found.drive_limits]), [arc.end, arc.start]) < 1e-9
    assert [limit.kind for limit in found.drive_limits] == ["maximum", "minimum"]


def test_a_circuit_has_both_branches_of_an_rssr():
    form, start = FORMS["rssr"]
    found = gr.circuit(form.linkage(start))
    output = found.samples.joint(*ROCKER) + form.motion(start).output.value
    branches = [form.motion(start + found.drive, branch=branch).output.value for branch in "+-"]
    between = abs(np.exp(1j * np.array(branches)) - np.exp(1j * output))
    inside = np.isfinite(between).all(axis=0)
    assert inside.mean() > 0.9
    # Near a limit the output goes with the root of what is left of the drive.
    assert between[:, inside].min(axis=0).max() < 1e-6
    assert {0, 1} == {*np.argmin(between[:, inside], axis=0).tolist()}


def random_forms(number, seed):
    """RSSRs with a crank angle at which they can be assembled, no dead centre nearer to the next than 3 degrees."""
    rng = np.random.default_rng(seed)
    while number:
        a, b, c, d = rng.uniform(0.3, 2.0, 4)
        form = RSSR(
            a=a,
            b=b,
            c=c,
            d=d,
            twist=rng.uniform(-1.2, 1.2),
            crank_offset=rng.normal() / 2,
            rocker_offset=rng.normal() / 2,
        )
        arcs, back = form.limits, form.reversed().limits
        ends = [end for each in (arcs, back) for arc in each if not arc.full for end in (arc.start, arc.end)]
        near = [abs((x - y + pi) % tau - pi) for k, x in enumerate(ends) for y in ends[:k]]
        if arcs and min([*near, *(arc.width for arc in (*arcs, *back))], default=1.0) > 0.05:
            number -= 1
            yield form, (arcs[0].start + 0.37 * arcs[0].width)


def rocker_stops(form, found, psi):
    """The rocker's dead centres on the circuit, as the ends of the arcs on which the reversed linkage closes."""
    values = np.array([centre.output for centre in found.dead_centres(ROCKER[0])]) + psi
    ends = [pi - end for arc in form.reversed().limits if not arc.full for end in (arc.start, arc.end)]
    own = found.samples.joint(*ROCKER) + psi
    reached = [end for end in ends if abs(np.exp(1j * own) - np.exp(1j * end)).min() < 1e-2]
    return values, reached


def test_limits_of_drive_and_output_of_random_rssrs_are_those_of_the_closed_form():
    with_limits = with_stops = 0
    for form, start in random_forms(100, 7):
        linkage = form.linkage(start)
        found, reach = gr.circuit(linkage), gr.drive_range(linkage)
        assert found.closed
        arc = form.limits[0]
        assert reach.full == (arc.full)
        if not arc.full:
            with_limits += 1
            assert sorted(limit.value + start for limit in found.drive_limits) == pytest.approx(
                [arc.start, arc.end], abs=1e-8
            )
            assert [reach.lowest + start, reach.highest + start] == pytest.approx([arc.start, arc.end], abs=1e-8)
        psi = float(form.motion(start).output.value)
        values, ends = rocker_stops(form, found, psi)
        with_stops += bool(ends)
        assert len(values) == len(ends)
        assert len(ends) == 0 or max(apart(min(ends, key=lambda e: apart([e], [v])), [v]) for v in values) < 1e-8
    assert with_limits > 20
    assert with_stops > 20


def test_dead_centres_of_a_wiper_are_those_of_the_closed_form_and_of_the_measures():
    form = RSSR(a=30, b=140, c=80, d=100, twist=radians(40), rocker_offset=40)
    linkage = form.linkage(0.4)
    found, measured = gr.circuit(linkage), measures(linkage)
    psi = float(form.motion(0.4).output.value)
    wanted = sorted((centre.drive, centre.output, centre.kind) for centre in form.dead_centres())
    for each in (found.dead_centres(), measured.dead_centres):
        own = sorted(((centre.drive + 0.4) % tau, centre.output + psi, centre.kind) for centre in each)
        assert [row[2] for row in own] == [row[2] for row in wanted]
        assert [row[:2] for row in own] == [pytest.approx(row[:2], abs=1e-9) for row in wanted]
    assert "Dead centres of the output R(frame-rocker) at" in found.explain()
    assert "Totlagen des Abtriebs D(frame-rocker) bei" in found.explain("de")
    assert gr.drive_range(linkage).full


def test_dead_centres_of_a_spherical_crank_rocker_lie_where_crank_and_coupler_are_in_line():
    """There the arc from the crank's axis to the rocker's pin is b + a or b - a: law of cosines on the sphere."""
    a, b, c, d = 0.3, 1.0, 0.8, 0.9
    form = SphericalFourBar(a, b, c, d)
    found = gr.circuit(form.linkage(0.5))
    start = float(form.motion(0.5).output.value)
    inner = [np.arccos((cos(side) - cos(c) * cos(d)) / (sin(c) * sin(d))) for side in (b - a, b + a)]
    wanted = sorted(degrees(pi - angle) for angle in inner)
    own = sorted(degrees(abs((centre.output + start + pi) % tau - pi)) for centre in found.dead_centres())
    assert own == pytest.approx(wanted, abs=1e-8)


def test_a_universal_joint_turns_fully_and_its_output_never_turns_back():
    joint = UniversalJoint(radians(30))
    linkage = joint.linkage() if hasattr(joint, "linkage") else machines.hooke(radians(30)).with_drives([0])
    found = gr.circuit(linkage)
    assert found.closed
    assert found.drive_limits == found.dead_centres() == ()
    assert found.drive[-1] == pytest.approx(tau, abs=1e-12)
    ratio = found.samples.joint("R(0-out)", order=1) / found.samples.joint("R(0-in)", order=1)
    assert abs(ratio).min() == pytest.approx(cos(radians(30)), abs=1e-3)  # between samples at most
    assert abs(ratio).max() == pytest.approx(1 / cos(radians(30)), abs=1e-3)


@pytest.mark.parametrize("lengths", [(25, 70, 40, 70), (30, 30, 50, 60), (50, 70, 40, 70)])
def test_a_four_bar_put_into_space_has_the_circuit_of_the_plane(lengths):
    form = gr.FourBar(*lengths)
    flat = form.linkage()
    poses = gr.move(flat, [0.9])
    text = "spatial: R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); drive=R(frame-crank)"
    at = [poses.point(name)[0] for name in flat.mechanism.chain.joint_names()]
    tilt = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    tilt *= np.sign(np.linalg.det(tilt))
    places = {
        k: {"at": tuple(tilt @ (*point, 0.0) + (7, -3, 11)), "z": tuple(tilt[:, 2])} for k, point in enumerate(at)
    }
    found = gr.circuit(SpatialLinkage(Mechanism.parse(text), places))
    own = plane.circuit(flat, at=0.9)
    assert found.closed == own.closed
    limits = [limit.value + 0.9 for limit in found.drive_limits]
    assert len(limits) == len(own.drive_limits)
    assert apart(limits, [limit.value for limit in own.drive_limits]) < 1e-9
    stops = own.extremes(lambda poses, order: poses.angle("rocker", order))
    mine = found.dead_centres("R(frame-rocker)")
    assert [centre.kind for centre in mine] == [stop.kind for stop in stops]
    first = float(poses.angle("rocker")[0])
    assert apart([centre.output + first for centre in mine], [stop.value for stop in stops]) < 1e-9
    drives = own.at([stop.at for stop in stops]).drive() if stops else []
    assert apart([centre.drive + 0.9 for centre in mine], drives) < 1e-8  # there the drive is flat in the output


@pytest.mark.parametrize(
    ("linkage", "drive"),
    [(machines.bricard("line"), 1), (machines.bricard("plane"), 1), (trihedral(), 0)],
    ids=["line", "plane", "trihedral"],
)
def test_bricards_loops_turn_back_where_their_range_ends(linkage, drive):
    linkage = linkage.with_drives([drive])
    found, reach = gr.circuit(linkage), drive_range(linkage)
    assert found.closed
    assert [limit.value for limit in found.drive_limits] == pytest.approx([reach.highest, reach.lowest], abs=1e-9)
    assert "turns back at" in found.explain()
    assert drive_range(found) == reach
    assert gr.rotatability(found) == gr.rotatability(linkage)
    assert "0x" not in repr(found)


@pytest.mark.parametrize("make", [lambda: machines.bennett()[0], machines.sarrus, lambda: machines.goldberg(5)])
def test_a_drive_that_turns_fully_comes_back_after_a_turn(make):
    found = gr.circuit(make().with_drives([0]))
    assert found.closed
    assert found.drive[-1] == pytest.approx(2 * pi, abs=1e-12)
    assert found.drive_limits == ()
    assert np.diff(found.arcs).max() < 0.2
    assert "turns back at" not in found.explain()
    (piece,) = found.monotone_pieces
    assert piece.drives == pytest.approx((0, tau), abs=1e-12)


def test_places_on_a_circuit_are_exact_and_wrap_around():
    form, start = FORMS["rssr"]
    found = gr.circuit(form.linkage(start))
    arcs = np.array([0.3, 5.1, found.length - 0.2])
    there, again = found.at(arcs), found.at(arcs - found.length)
    assert there.gap < 1e-12
    assert again.drives == pytest.approx(there.drives, abs=1e-10)
    for row, (phi, psi) in enumerate(zip(there.drives[:, 0] + start, there.joint(*ROCKER), strict=True)):
        branches = [float(form.motion(phi, branch=branch).output.value) for branch in "+-"]
        assert min(apart([psi + form.motion(start).output.value], [each]) for each in branches) < 1e-9, row
    # The rates go along the curve: the crank's and the rocker's have the ratio of the closed form.
    phi, rates = there.drives[0, 0] + start, there.joint(*ROCKER, order=1)[0] / there.joint(0, order=1)[0]
    closed = [float(form.motion(phi, branch=branch).output.velocity) for branch in "+-"]
    assert min(abs(rates - each) for each in closed) < 1e-9
    with pytest.raises(LinkageError, match="expected finite positions"):
        found.at(np.nan)


@pytest.mark.parametrize("text", ["R(frame-crank) S(crank-body)", "S(body-crank) R(crank-frame)"])
def test_a_ball_in_the_tree_is_followed_however_it_is_written(text):
    """The rods keep their lengths, which the poses alone tell; the circuit turns back where the motion ends."""
    linkage, body, frame = machines.tied_body(text)
    found = gr.circuit(linkage)
    assert found.closed
    pose, crank = found.samples.pose("body"), found.samples.pose("crank")
    for b, f in zip(body, frame, strict=True):
        rods = np.linalg.norm(pose[:, :3, :3] @ b + pose[:, :3, 3] - f, axis=1)
        assert rods == pytest.approx(np.linalg.norm(np.subtract(b, f)), abs=1e-11)
    ball = np.array([0.6, 0, 0, 1])
    assert abs(pose @ ball - crank @ ball).max() < 1e-11
    stop = gr.move(linkage, np.linspace(0, 1, 101)).stop
    assert stop.drives[0] == pytest.approx(found.drive_limits[0].value, abs=1e-9)
    assert f"turn back, while {stop.joints[0]} could go on" in stop.explain()
    assert stop.joints[0].startswith("S(")
    other, *_ = machines.tied_body("R(frame-crank) S(crank-body)")
    assert found.length == pytest.approx(gr.circuit(other).length, rel=1e-4)


@pytest.mark.parametrize("drive", [0, 2], ids=["spindle", "nut"])
def test_a_winch_never_comes_back(drive):
    """After a turn of the spindle the nut is elsewhere."""
    found = gr.circuit(machines.winch().with_drives([drive]), most=10)
    assert not found.closed
    assert 0 < found.start < found.length
    assert "longer than what was asked for" in found.explain()
    assert found.at(found.start).drives[0, 0] == pytest.approx(0, abs=1e-12)
    (piece,) = found.monotone_pieces
    assert piece.drives[0] < 0 < piece.drives[1]
    with pytest.raises(LinkageError, match="is not closed"):
        found.at(-1.0)


def test_wheels_that_come_near_their_first_position_have_not_come_back():
    """One turn of the crank leaves a wheel of 50 : 51 teeth 1/51 of a turn behind: the circuit has 51 turns."""
    mechanism = Mechanism.parse("spatial: R(0-1) R(0-2) G(1-2); drive=R(0-1)")
    contact = {"at": (1.0, 0, 0), "x": (0, 1, 0), "z": (0, 0, 1), "radii": (1.0, 1.02), "pressure": 0.35}
    linkage = SpatialLinkage(mechanism, {0: {"z": (0, 0, 1)}, 1: {"at": (2.02, 0, 0), "z": (0, 0, 1)}, 2: contact})
    assert not gr.circuit(linkage, most=20).closed
    found = gr.circuit(linkage)
    assert found.closed
    assert found.drive[-1] == pytest.approx(51 * tau, abs=1e-9)


def test_a_parallelogram_goes_straight_on_where_its_crossed_mode_crosses():
    square = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
    linkage = SpatialLinkage(square, {0: (0, 0), 1: (0, 1), 2: (3, 1), 3: (3, 0)})
    found = gr.circuit(linkage)
    assert found.closed
    assert found.samples.joint(3) == pytest.approx(found.drive, abs=1e-9)
    assert [point.drive for point in found.change_points] == pytest.approx([pi / 2, 3 * pi / 2], abs=1e-11)
    assert "Change points: 2." in found.explain()
    there = found.at([point.arc for point in found.change_points])
    assert there.drives[:, 0] == pytest.approx([pi / 2, 3 * pi / 2], abs=1e-9)
    assert abs(np.exp(1j * there.joint(3)) - np.exp(1j * there.drives[:, 0])).max() < 1e-9
    assert there.joint(3, order=1) == pytest.approx(there.joint(0, order=1), abs=1e-9)


@pytest.mark.parametrize("folded", [False, True])
def test_change_points_of_spherical_four_bars_are_those_positions_in_which_all_arcs_lie_on_one_circle(folded):
    """With a + d = b + c they do where the crank's angle is 180°, with a + c = b + d at 0: multiples of 180°."""
    a, b, d = 0.45, 0.85, 1.05
    bar = SphericalFourBar(a, b, b + d - a if folded else a + d - b, d)
    changes = gr.circuit(bar.linkage(1.0)).change_points
    assert len(changes) == 2
    for change in changes:
        assert abs(sin(1.0 + change.drive)) < 1e-11


def test_one_of_several_drives_has_a_range_while_the_others_rest():
    """The upper limit is that of the wishbones, which the suspension without a rack has too."""
    linkage = entry("susp_rack").placed()
    alone, other = drive_range(linkage, drive="R(body-lower_wishbone)"), drive_range(linkage, drive=1)
    without = drive_range(entry("susp_spatial").placed())
    assert alone.stops[0].reason == alone.stops[1].reason == "limit"
    assert alone.highest == pytest.approx(without.highest, abs=1e-9)
    assert "The drive P(body-rack) moves from" in other.explain()
    beyond = [[alone.highest + 1e-6, 0.0], [0.0, other.lowest - 1e-3]]
    inside = [[alone.highest - 1e-6, 0.0], [0.0, other.lowest + 1e-3]]
    for row in beyond:
        assert not gr.move(linkage, [row]).complete
    for row in inside:
        assert gr.move(linkage, [row]).complete
    for drive in ("R(0-1)", 2, -1):
        with pytest.raises(LinkageError, match="the drives are R"):
            drive_range(linkage, drive=drive)
    with pytest.raises(LinkageError, match="a range needs one drive, but the mechanism has 2"):
        drive_range(linkage)
    with pytest.raises(LinkageError, match="in the plane a range needs one drive"):
        drive_range(gr.FourBar(25, 70, 40, 70), drive=0)


def test_what_is_no_circuit_is_refused():
    with pytest.raises(LinkageError, match="a circuit needs one drive, but the mechanism has 2"):
        gr.circuit(machines.loop(8).with_drives([0, 1]))
    bennett = machines.bennett()[0].with_drives([0])
    for wrong, said in (
        ({"branch": "+"}, "starts at the reference pose"),
        ({"at": 1.0}, "starts at the reference pose"),
        ({"step": 0.5}, "the step lies between"),
        ({"step": float("nan")}, "step: expected a finite number"),
        ({"most": -1.0}, "the greatest length above 0"),
    ):
        with pytest.raises(LinkageError, match=said):
            circuit(bennett, **wrong)
    with pytest.raises(LinkageError, match="no assembly mode to choose"):
        drive_range(bennett, branch="+")
    with pytest.raises(LinkageError, match="cannot be moved from its start: it is shaky there"):
        circuit(entry("pumpjack_rod").placed())
    with pytest.raises(LinkageError, match="no ball"):
        gr.circuit(FORMS["rssr"][0].linkage(3.0)).dead_centres("S(crank-rod)")


@pytest.mark.parametrize("longer", [-1e-4, -1e-6, -1e-8, 1e-8, 1e-6, 1e-4])
def test_a_curve_that_comes_near_is_not_taken_for_its_own(longer):
    """A parallelogram with a longer rocker turns fully; with a shorter one its crank stands at limits where coupler and
    rocker are folded and stretched, by the law of cosines."""
    crank, rod, rocker = 1.0, 2.0, 1.0 + longer
    arm = crank * np.exp(1j) - rod
    angle = np.angle(arm) - np.arccos((abs(arm) ** 2 + rocker**2 - rod**2) / (2 * abs(arm) * rocker))
    first, second = np.exp(1j), rod + rocker * np.exp(1j * angle)
    places = [(0, 0, 0), (first.real, first.imag, 0), (second.real, second.imag, 0), (rod, 0, 0)]
    mechanism = Mechanism.parse("spatial: R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)")
    circuit = gr.circuit(SpatialLinkage(mechanism, {k: {"at": at, "z": (0, 0, 1)} for k, at in enumerate(places)}))
    limits = np.sort([limit.value for limit in circuit.drive_limits])
    cosines = [(crank**2 + rod**2 - both**2) / (2 * crank * rod) for both in (rod - rocker, rod + rocker)]
    expected = np.arccos(cosines) - 1 if longer < 0 else []
    assert (circuit.closed, circuit.change_points) == (True, ())
    assert limits == pytest.approx(expected, abs=1e-9)
