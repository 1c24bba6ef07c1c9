"""Overconstrained linkages that move: the independent part is solved, the rest is looked at in every row."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.forces import Loads, statics
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import circuit, from_degrees, move
from gruebler.mechanics.kinematics.batch import move_many
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.screws import freedoms
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Drive, Mechanism
from gruebler.teaching.catalog import entry

LOCOMOTIVE = Mechanism.parse(
    "R(frame-crank) R(crank-rod) R(rod-second) R(frame-second) R(rod-third) R(frame-third); "
    "frame=frame; drive=R(frame-crank)"
)


def locomotive(feet=((0, 0), (50, 0), (80, 10)), crank=20.0, angle=1.0, error=0.0, mechanism=LOCOMOTIVE):
    """Three parallel cranks on a rod, the last one turned by an error."""
    arms = [crank * np.exp(1j * angle)] * 2 + [crank * np.exp(1j * (angle + error))]
    pins = [complex(*foot) + arm for foot, arm in zip(feet, arms, strict=True)]
    at = [feet[0], pins[0], pins[1], feet[1], pins[2], feet[2]]
    return Linkage.from_drawing(
        mechanism, {k: (p.real, p.imag) if isinstance(p, complex) else p for k, p in enumerate(at)}
    )


def dixon(xs, ys, off=0.0):
    """Dixon's linkage of the first kind: bars from each point of one line to each of another at right angles to it."""
    bars = [[f"b{i}{j}" for j in range(len(ys))] for i in range(len(xs))]
    joints = [f"R({'-'.join(row)})" for row in bars] + [f"R({'-'.join(column)})" for column in zip(*bars, strict=True)]
    places = {k: (x, 0.0) for k, x in enumerate(xs)} | {len(xs) + j: (0.0, y) for j, y in enumerate(ys)}
    places[len(xs) + len(ys) - 1] = (off, ys[-1])
    mechanism = Mechanism(Chain.parse(" ".join(joints)), "b00", [Drive(0, "Rz", ("b00", "b01"))])
    return Linkage.from_drawing(mechanism, places)


def kempe(a=2.0, s=1.5, d=2.2, k=1.2, h=0.8, angle=1.4, off=0.0):
    """Kempe's focal linkage: a four-bar ABCD, a joint F and bars from F to joints P, Q, R, S on its sides.

    a, s, d: AP, FS and SA; k, h: the ratios of FRCQ to APFS and of FRDS to BPFQ, which are similar as mirror images.
    angle: APF. off: by how much P is misplaced along its side.
    """
    m = k / h
    p = np.sqrt((d**2 * (k**2 + m) + s**2 * (h**-2 + m) - m * (m + 1) * a**2) / (m + 1))
    at = {"A": complex(-a), "B": complex(m * a), "P": complex(off), "F": p * np.exp(1j * (np.pi - angle))}

    def third(one, other, to_one, to_other):
        """The corner right of the way from one to the other."""
        far = abs(other - one)
        along = (far**2 + to_one**2 - to_other**2) / (2 * far)
        return one + (other - one) / far * (along - 1j * np.sqrt(to_one**2 - along**2))

    at["S"] = third(at["F"], at["A"], s, d)
    at["Q"] = third(at["B"], at["F"], s / h, k * d)
    at["C"] = at["Q"] + (at["Q"] - at["B"]) * k * h
    at["D"] = at["S"] + (at["S"] - at["A"]) * k * h
    at["R"] = (h * at["C"] + k * at["D"]) / (k + h)
    joints = {
        "A": "ab-da",
        "B": "ab-bc",
        "C": "bc-cd",
        "D": "cd-da",
        "P": "ab-fp",
        "Q": "bc-fq",
        "R": "cd-fr",
        "S": "da-fs",
    }
    places = {f"R({links})": at[name] for name, links in (joints | {"F": "fp-fq-fr-fs"}).items()}
    mechanism = Mechanism.parse(" ".join(places) + "; frame=ab; drive=R(ab-da)")
    return Linkage.from_drawing(mechanism, {joint: (z.real, z.imag) for joint, z in places.items()})


@pytest.mark.parametrize("angle", [0.3, 1.0, 2.5])
@pytest.mark.parametrize("feet", [((0, 0), (50, 0), (80, 10)), ((0, 0), (50, 0), (120, 0))])
def test_a_third_equal_crank_goes_round(feet, angle):
    motion = move(locomotive(feet, angle=angle), from_degrees(0, 720, 1), speed=2)
    assert motion.complete
    assert motion.closure_error < 1e-9
    for link in ("second", "third"):
        assert motion.angle(link) - motion.angle(link)[0] == pytest.approx(motion.drives[:, 0], abs=1e-9)
        assert motion.angular(link) == pytest.approx(np.full(721, 2.0), abs=1e-9)
    assert np.ptp(motion.angle("rod")) < 1e-9


def test_a_path_may_start_in_a_change_point():
    for start in (0, 180):
        motion = move(locomotive(((0, 0), (50, 0), (120, 0))), from_degrees(start, start + 360, 5))
        assert motion.complete
        assert motion.closure_error < 1e-9


@given(
    st.floats(1e-3, 1e3),
    st.floats(0, 6.28),
    st.tuples(st.floats(-1, 1), st.floats(-1, 1)),
)
def test_neither_unit_nor_place_matters(scale, turn, shift):
    def put(p):
        z = scale * np.exp(1j * turn) * complex(*p) + scale * 50 * complex(*shift)
        return z.real, z.imag

    feet = [put(p) for p in ((0, 0), (50, 0), (80, 10))]
    linkage = locomotive(feet, crank=20 * scale, angle=1.0 + turn)
    made = cached_plan(linkage)
    assert made.released == cached_plan(locomotive()).released
    motion = move(linkage, linkage.reference_pose["crank"].angle + from_degrees(0, 360, 10))
    assert motion.complete
    assert motion.closure_error < 1e-9


@pytest.mark.parametrize("count", [(3, 3), (3, 4), (4, 4)])
def test_dixons_linkage_against_its_closed_form(count):
    xs, ys = [1.0, -1.7, 2.6, 3.1][: count[0]], [1.3, 2.2, -0.9, -2.5][: count[1]]
    linkage = dixon(xs, ys)
    motion = move(linkage, linkage.reference_pose["b01"].angle + np.linspace(0, 0.3, 31))
    assert motion.complete
    assert motion.closure_error < 1e-12

    def track(bar, joint):
        element = linkage.elements[joint, bar]
        return motion.complex_point(LinkPoint(bar, element.x, element.y))

    a = [track(f"b{i}0", i) for i in range(len(xs))]
    b = [track(f"b0{j}", len(xs) + j) for j in range(len(ys))]
    u, v = (a[1] - a[0]) / abs(a[1] - a[0]), (b[1] - b[0]) / abs(b[1] - b[0])
    assert np.abs((np.conj(u) * v).real).max() < 1e-12  # the lines stay at right angles
    origin = a[0] + u * (np.conj(u) * (b[0] - a[0])).real
    along = [(np.conj(u) * (p - origin)).real for p in a], [(np.conj(v) * (p - origin)).real for p in b]
    shared = along[1][0] ** 2 - ys[0] ** 2  # x^2 falls by what y^2 grows by, the same for all
    assert np.ptp(shared) > 0.1
    for x, now in zip(xs, along[0], strict=True):
        assert now**2 == pytest.approx(x**2 - shared, abs=1e-12)
    for y, now in zip(ys, along[1], strict=True):
        assert now**2 == pytest.approx(y**2 + shared, abs=1e-12)


FOCAL = [{}, {"a": 3.0, "s": 2.0, "d": 2.5, "k": 1.0, "h": 1.0}, {"a": 1.0, "s": 2.0, "d": 1.6, "k": 0.7, "h": 1.1}]


@pytest.mark.parametrize(("sizes", "full"), list(zip(FOCAL, [False, False, True], strict=True)))
def test_kempes_focal_linkage_over_its_whole_range(sizes, full):
    linkage = kempe(**sizes)
    assert freedoms(linkage).mobility == 1
    assert circuit(linkage).closed  # all joints at once, with other equations
    span = measures(linkage, output="cd").span
    assert span.full == full
    motion = move(linkage, np.linspace(span.low, span.high, 402)[1:-1])  # poses at its limits have half their digits
    assert motion.complete
    assert motion.closure_error < 1e-9
    a, b, c, d, p, q, r, s, f = (motion.complex_point(joint) for joint in linkage.mechanism.chain.joint_names())
    sides = [float(np.abs(x - y)[0]) for x, y in ((a, d), (b, c), (c, d), (a, b))]
    assert span.width == pytest.approx(FourBar(*sides).limits[0].width, rel=1e-9)  # the focus adds no limits

    def similar(first, second, ratio):
        """Mirror images of one another in another size."""
        (z1, z2, z3), (w1, w2, w3) = first, second
        assert (w2 - w1) / (w3 - w1) == pytest.approx(np.conj((z2 - z1) / (z3 - z1)), rel=0, abs=1e-8)
        assert abs(w3 - w1) == pytest.approx(ratio * abs(z3 - z1), rel=1e-8)

    k, h = sizes.get("k", 1.2), sizes.get("h", 0.8)
    similar((a, p, f), (f, r, c), k)
    similar((a, s, f), (f, q, c), k)
    similar((b, p, f), (f, r, d), h)
    similar((b, q, f), (f, s, d), h)
    seen = (a - f) / (b - f) * (c - f) / (d - f)  # F sees AB and CD under angles whose sum is 180 degrees
    assert seen / np.abs(seen) == pytest.approx(-1, rel=0, abs=1e-8)
    assert np.ptp(np.abs(f - a)) > 0.1


def test_a_focal_linkage_with_a_misplaced_joint_is_refused():
    with pytest.raises(LinkageError, match="leave mobility 0"):
        cached_plan(kempe(off=0.01))


@pytest.mark.parametrize("id", ["loco3", "loco4", "toolbox2"])
def test_machines_of_the_catalog_move_and_are_measured(id):
    linkage = entry(id).linkage()
    found = measures(linkage)
    assert found.span.full
    assert "overconstrained" in found.transmission_note
    assert circuit(linkage).closed  # all joints at once, with other equations
    assert freedoms(linkage).mobility == 1


def test_change_points_are_those_of_the_linkage_not_of_its_part():
    assert measures(locomotive()).change_points == ()  # the rod with two of the cranks alone has two
    line = measures(locomotive(((0, 0), (50, 0), (120, 0))))
    assert np.degrees([point.drive for point in line.change_points]) == pytest.approx([0, 180], abs=1e-6)


def test_the_last_digits_beside_a_change_point_of_the_independent_part_open_no_joint():
    """Poses next to it are known to 1e-16 over the root; the third pin lies off the line of the other two by 10."""
    linkage = locomotive(((0, 0), (50, 0), (10, 40)))
    path = np.concatenate([[1.0], np.linspace(3e-7, -3e-7, 601), [-1.0]])
    motion = move(linkage, path)
    assert motion.complete
    assert np.abs(motion.roots).min() < 1e-7  # rows with lost digits are among them
    for crank in ("crank", "second", "third"):
        turned = motion.angle(crank) - motion.angle(crank)[0]
        assert turned == pytest.approx(path - 1.0, rel=0, abs=1e-7)


def test_angles_begin_with_the_principal_value_in_a_change_point_too():
    """The way there from the reference pose, at 57 degrees, goes over 180 degrees; it is no part of the motion."""
    in_line = locomotive(((0, 0), (50, 0), (120, 0)))
    for beside in (1e-8, 1e-2):
        motion = move(in_line, [np.pi + beside, np.pi + 0.3])
        assert motion.angle("crank") == pytest.approx([beside - np.pi, 0.3 - np.pi], rel=0, abs=1e-12)
        assert not motion.whole[0].any()


def test_two_sides_that_repeat_each_other():
    places = {
        "R(base-a1)": (0, 0),
        "G(base-a2)": (80, 0, 0, "base"),
        "R(a1-a2)": (40, 30),
        "G(a1-top)": (80, 60, 0, "top"),
        "R(a2-top)": (0, 60),
        "R(base-a3)": (120, 0),
        "G(base-a4)": (200, 0, 0, "base"),
        "R(a3-a4)": (160, 30),
        "G(a3-top)": (200, 60, 0, "top"),
        "R(a4-top)": (120, 60),
    }
    mechanism = Mechanism.parse(" ".join(places) + "; frame=base; drive=R(base-a1)")
    linkage = Linkage.from_drawing(mechanism, places)
    made = cached_plan(linkage)
    assert made.decomposition.class_number == 2  # both sides are solved by dyads
    motion = move(linkage, from_degrees(10, 80, 1))
    assert motion.complete
    assert motion.closure_error < 1e-12
    assert motion.point("R(a4-top)")[:, 1] == pytest.approx(100 * np.sin(motion.drives[:, 0]), abs=1e-10)


def test_a_crank_that_stands_askew_is_refused_at_once():
    words = r"leave mobility 0.*blocked by .*R\(rod-third\).*gruebler check"
    with pytest.raises(LinkageError, match=words):
        move(locomotive(error=0.05), [1.0])
    with pytest.raises(LinkageError, match="leave mobility 0"):
        cached_plan(dixon([1.0, -1.7, 2.6], [1.3, 2.2, -0.9], off=0.01))


def test_a_shaky_linkage_ends_where_a_joint_opens():
    feet, scales = ((0, 0), (50, 0), (80, 10)), (1.0, 1.8, 2.4)
    arm = 20 * np.exp(1j)
    pins = [complex(*foot) + s * arm for foot, s in zip(feet, scales, strict=True)]
    places = {0: feet[0], 3: feet[1], 5: feet[2]} | {k: (p.real, p.imag) for k, p in zip((1, 2, 4), pins, strict=True)}
    linkage = Linkage.from_drawing(LOCOMOTIVE, places)
    motion = move(linkage, 1 + np.array([0.0, 1e-6, 1e-3, 1e-2]))
    assert (len(motion), motion.stop.reason) == (2, "open")
    assert "R(frame-crank) = 57.3" in motion.message()
    assert f"{motion.stop.form} is open" in motion.message()
    assert "gruebler check" in motion.message("de")
    with pytest.raises(LinkageError, match="is open"):
        measures(linkage)
    assert freedoms(linkage).mobility == 0


def test_what_is_missing_is_said():
    with pytest.raises(LinkageError, match=r"position in which its joints close \(\[reference_pose\] or \[places\]\)"):
        move(locomotive().with_reference_pose(None), [1.0])
    with pytest.raises(LinkageError, match="reference pose is a change point"):
        move(locomotive(((0, 0), (50, 0), (120, 0)), angle=0.0), [0.0])
    drives = Mechanism(LOCOMOTIVE.chain, "frame", [0, 3])
    with pytest.raises(LinkageError, match=r"leave mobility 1, less than the number of drives \(2\)"):
        move(locomotive(mechanism=drives), [(1.0, 1.0)])
    with pytest.raises(LinkageError, match="depends on their stiffness"):
        statics(move(locomotive(), [1.0]), Loads(moments={"third": 1.0}))
    with pytest.raises(LinkageError, match="one by one"):
        move_many([locomotive(), locomotive()], [1.0])
