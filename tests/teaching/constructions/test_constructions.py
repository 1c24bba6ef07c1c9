"""Every construction gives the number of the solver: its last step is compared on 100 random linkages."""

from itertools import pairwise
from math import degrees, hypot, isclose, radians
from random import Random

import numpy as np
import pytest

from gruebler import FourBar, InvertedSliderCrank, SliderCrank, move
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.design.synthesis import DeadCentreTask, synthesise_dead_centres
from gruebler.machines.cams import Cam, Roller, read_lift
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import turning_ranges
from gruebler.mechanics.geometry import cognates, inflection_circle, path_curvature, poles
from gruebler.mechanics.geometry.meyer_zur_capellen import symmetric_rocker
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.space import RSSR, UniversalJoint
from gruebler.pictures.canvas.construction_files import construction_bytes
from gruebler.pictures.canvas.shapes import ArcShape, Polylines, TextShape, text_width
from gruebler.pictures.canvas.styles import STYLES
from gruebler.structure.assur import DYADS, decompose
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.constructions import CONSTRUCTIONS, construction, construction_forms
from gruebler.teaching.constructions.dead_centres import transmission_of_crank_rocker

MANY = 100
CLOSE = {"rel": 1e-7, "abs": 1e-7}
SCOTCH_YOKE = Mechanism.parse("R(frame-crank) R(crank-block) P(block-yoke) P(frame-yoke); drive=R(frame-crank)")
TANGENT_MECHANISM = Mechanism.parse(
    "R(frame-lever) P(lever-block) R(block-slider) P(frame-slider); drive=R(frame-lever)"
)


def crank_rockers(seed):
    random = Random(seed)
    made = 0
    while made < MANY:
        lengths = [random.uniform(10, 100) for _ in "abcd"]
        size = FourBar(*lengths)
        if size.type.key == "crank_rocker" and size.grashof.excess < -0.5:
            made += 1
            yield size, random


def slider_cranks(seed):
    random = Random(seed)
    for _ in range(MANY):
        a, b = random.uniform(10, 40), random.uniform(50, 120)
        yield SliderCrank(a, b, random.uniform(-0.9, 0.9) * (b - a)), random


def of(size):
    return {key: getattr(size, key) for key in ("a", "b", "c", "d", "e") if hasattr(size, key)}


def test_dead_centres_of_crank_rockers():
    for size, _ in crank_rockers(1):
        made, centres = construction("dead-centres", **of(size)).values, size.dead_centres
        assert made["phi_outer"] == pytest.approx(degrees(centres.outer.drive), **CLOSE)
        assert made["phi_inner"] == pytest.approx(degrees(centres.inner.drive) % 360, **CLOSE)
        assert made["phi_max"] == pytest.approx(degrees(centres.phi_max), **CLOSE)
        assert made["time_ratio"] == pytest.approx(centres.time_ratio, **CLOSE)
        assert made["swing"] == pytest.approx(degrees(size.swing), **CLOSE)


def test_dead_centres_of_slider_cranks():
    for size, _ in slider_cranks(2):
        made, centres = construction("dead-centres", "slider-crank", **of(size)).values, size.dead_centres
        assert made["l_outer"] == pytest.approx(centres.outer.output, **CLOSE)
        assert made["l_inner"] == pytest.approx(centres.inner.output, **CLOSE)
        assert made["stroke"] == pytest.approx(size.stroke, **CLOSE)
        assert made["phi_max"] == pytest.approx(degrees(centres.phi_max), **CLOSE)


def test_transmission_angles():
    for size, _ in crank_rockers(3):
        made = construction("transmission-angle", **of(size)).values
        assert made["mu_min"] == pytest.approx(degrees(size.transmission_angle.smallest.mu), **CLOSE)
    for size, _ in slider_cranks(4):
        made = construction("transmission-angle", "slider-crank", **of(size)).values
        assert made["mu_min"] == pytest.approx(degrees(size.transmission_angle.smallest.mu), **CLOSE)


def test_a_transmission_angle_agrees_with_the_solved_motion():
    size = FourBar(20, 50, 40, 50)
    solved = measures(size.linkage()).transmission.smallest.mu
    assert construction("transmission-angle", **of(size)).values["mu_min"] == pytest.approx(degrees(solved), **CLOSE)


def test_central_crank_rockers():
    random = Random(5)
    for _ in range(MANY):
        a = random.uniform(10, 30)
        b, c = random.uniform(1.2, 4) * a, random.uniform(1.2, 4) * a
        made = construction("central-crank-rocker", a=a, b=b, c=c).values
        size = FourBar(a, b, c, made["d"])
        assert size.is_central
        assert size.dead_centres.time_ratio == pytest.approx(1, abs=1e-7)
        assert made["swing"] == pytest.approx(degrees(size.swing), **CLOSE)


def test_permissible_frames():
    random = Random(6)
    for _ in range(MANY):
        a = random.uniform(10, 30)
        b, c = random.uniform(1.2, 4) * a, random.uniform(1.2, 4) * a
        made = construction("permissible-frame", a=a, b=b, c=c).values
        (wanted,) = [r for r in turning_ranges("a", a=a, b=b, c=c) if r.type.key == "crank_rocker"]
        assert (made["d_min"], made["d_max"]) == pytest.approx((wanted.lower, wanted.upper), **CLOSE)


@pytest.mark.parametrize("many", [3, pytest.param(MANY, marks=pytest.mark.slow)])
def test_alt(many):
    random = Random(7)
    for _ in range(many):  # each looks for the best member of a family
        swing, angle = random.uniform(20, 80), random.uniform(185, 220)
        made = construction("alt", swing=swing, crank_angle=angle).values
        size = FourBar(*(made[key] for key in "abcd"))
        assert degrees(size.swing) == pytest.approx(swing, abs=1e-6)
        assert degrees(size.dead_centres.phi_max) == pytest.approx(angle, abs=1e-6)
        found = synthesise_dead_centres(DeadCentreTask(swing=radians(swing), crank_angle=radians(angle)))
        assert found.designs


def test_instant_centres():
    for size, random in crank_rockers(8):
        phi = random.uniform(10, 170) + random.choice((0, 180))
        made = construction("instant-centres", **of(size), phi=phi).values
        motion = move(size.linkage(), np.radians([phi]), speed=1.0)
        solved = poles(motion)
        assert complex(made["x13"], made["y13"]) == pytest.approx(complex(solved.of("frame", "coupler")[0]), rel=1e-6)
        assert made["x24"] == pytest.approx(float(solved.of("crank", "rocker")[0].real), rel=1e-6, abs=1e-6)
        ratio = abs(turn(motion, "crank", 1) / turn(motion, "rocker", 1))
        assert made["ratio"] == pytest.approx(ratio, rel=1e-6)


def test_instant_centres_of_slider_cranks():
    for size, random in slider_cranks(9):
        phi = random.uniform(10, 80)
        made = construction("instant-centres", "slider-crank", **of(size), phi=phi).values
        motion = move(size.linkage(), np.radians([phi]), speed=1.0)
        assert complex(made["x13"], made["y13"]) == pytest.approx(
            complex(poles(motion).of("frame", "coupler")[0]), rel=1e-6
        )
        assert made["arm"] == pytest.approx(abs(motion.displacement("P(frame-slider)", order=1)[0]), rel=1e-6)


def turn(motion, link, order):
    """The angular velocity or acceleration of a link."""
    return float(motion.rates[order - 1][0, motion.link_index(link)])


def speeds(motion, joint):
    place = motion.linkage.points_named(joint)[-1]
    return [abs(complex(motion.complex_point(place, order=order)[0])) for order in (1, 2)]


def test_polygons_of_four_bars():
    for size, random in crank_rockers(10):
        phi, omega = random.uniform(10, 170) + random.choice((0, 180)), random.uniform(1, 20)
        motion = move(size.linkage(), np.radians([phi]), speed=omega)
        v_b, a_b = speeds(motion, "R(coupler-rocker)")
        made = construction("velocities", **of(size), phi=phi, omega=omega).values
        assert made["v_B"] == pytest.approx(v_b, rel=1e-7)
        assert made["v_BA"] == pytest.approx(size.b * abs(turn(motion, "coupler", 1)), rel=1e-7)
        made = construction("accelerations", **of(size), phi=phi, omega=omega).values
        assert made["a_B"] == pytest.approx(a_b, rel=1e-6)
        assert made["a_BAt"] == pytest.approx(size.b * abs(turn(motion, "coupler", 2)), rel=1e-6)


def test_polygons_of_slider_cranks():
    for size, random in slider_cranks(11):
        phi, omega = random.uniform(10, 170) + random.choice((0, 180)), random.uniform(1, 20)
        motion = move(size.linkage(), np.radians([phi]), speed=omega)
        v_b, a_b = (abs(motion.displacement("P(frame-slider)", order=order)[0]) for order in (1, 2))
        made = construction("velocities", "slider-crank", **of(size), phi=phi, omega=omega).values
        assert made["v_B"] == pytest.approx(v_b, rel=1e-7)
        made = construction("accelerations", "slider-crank", **of(size), phi=phi, omega=omega).values
        assert made["a_B"] == pytest.approx(a_b, rel=1e-6)


def test_polygons_of_levers_with_coriolis():
    random = Random(12)
    for _ in range(MANY):
        a, d = random.uniform(10, 60), random.uniform(65, 120)
        phi, omega = random.uniform(5, 355), random.uniform(1, 20)
        motion = move(InvertedSliderCrank(a, d).linkage(), np.radians([phi]), speed=1.0)
        rates = [float(turn(motion, "block", order)) for order in (1, 2)]
        made = construction("velocities", "inverted-slider-crank", a=a, d=d, phi=phi, omega=omega).values
        assert made["omega_lever"] == pytest.approx(omega * abs(rates[0]), rel=1e-7)
        made = construction("accelerations", "inverted-slider-crank", a=a, d=d, phi=phi, omega=omega).values
        assert made["alpha_lever"] == pytest.approx(omega**2 * abs(rates[1]), rel=1e-6)


@pytest.mark.filterwarnings("ignore::gruebler.base.errors.UnitWarning")  # rows far apart
def test_polygons_of_scotch_yokes():
    random = Random(19)
    for _ in range(MANY):
        a, slot = random.uniform(10, 60), random.uniform(30, 150)
        phi, omega = random.uniform(0, 360), random.uniform(1, 20)
        whole = Linkage.from_drawing(
            SCOTCH_YOKE,
            {"R(frame-crank)": (0, 0), "R(crank-block)": (a, 0), "P(block-yoke)": (a, 0, radians(slot)), 3: (90, 0, 0)},
        )
        motion = move(whole, np.radians([0, phi]), speed=omega)
        v, acceleration = (abs(motion.displacement("P(frame-yoke)", order=order)[1]) for order in (1, 2))
        slides = [abs(motion.displacement("P(block-yoke)", order=order)[1]) for order in (1, 2)]
        made = construction("velocities", "scotch-yoke", a=a, slot=slot, phi=phi, omega=omega).values
        assert (made["v_C"], made["v_rel"]) == pytest.approx((v, slides[0]), rel=1e-7, abs=1e-9 * a * omega)
        made = construction("accelerations", "scotch-yoke", a=a, slot=slot, phi=phi, omega=omega).values
        wanted = acceleration, slides[1]
        assert (made["a_C"], made["a_rel"]) == pytest.approx(wanted, rel=1e-6, abs=1e-8 * a * omega**2)


def test_polygons_of_tangent_mechanisms_with_coriolis():
    random = Random(20)
    for _ in range(MANY):
        d, phi, omega = random.uniform(10, 80), random.uniform(15, 165), random.uniform(0.5, 10)
        whole = Linkage.from_drawing(
            TANGENT_MECHANISM,
            {
                "R(frame-lever)": (0, 0),
                "P(lever-block)": (0, d, radians(90)),
                "R(block-slider)": (0, d),
                "P(frame-slider)": (0, d, 0),
            },
        )
        motion = move(whole, np.radians([90, phi]), speed=omega)
        v, acceleration = (abs(motion.displacement("P(frame-slider)", order=order)[1]) for order in (1, 2))
        slides = [abs(motion.displacement("P(lever-block)", order=order)[1]) for order in (1, 2)]
        made = construction("velocities", "tangent-mechanism", d=d, phi=phi, omega=omega).values
        assert (made["v_B"], made["v_rel"]) == pytest.approx((v, slides[0]), rel=1e-7, abs=1e-9 * d * omega)
        made = construction("accelerations", "tangent-mechanism", d=d, phi=phi, omega=omega).values
        assert made["a_B"] == pytest.approx(acceleration, rel=1e-6, abs=1e-8 * d * omega**2)
        # The block's acceleration along the lever is the rate of its speed and the normal part of the turn.
        radius = d / abs(np.sin(radians(phi)))
        assert made["a_Cn"] == pytest.approx(radius * omega**2)
        assert made["a_Cor"] == pytest.approx(2 * omega * slides[0], rel=1e-7, abs=1e-9 * d * omega**2)
        assert made["a_rel"] == pytest.approx(slides[1], rel=1e-6, abs=1e-8 * d * omega**2)


def test_every_kind_of_dyad_has_polygons():
    driven = {
        "four-bar": FourBar(25, 70, 40, 70).linkage().mechanism,
        "slider-crank": SliderCrank(20, 50).linkage().mechanism,
        "inverted-slider-crank": InvertedSliderCrank(30, 50).linkage().mechanism,
        "scotch-yoke": SCOTCH_YOKE,
        "tangent-mechanism": TANGENT_MECHANISM,
    }
    forms = {group.form() for mechanism in driven.values() for group in decompose(mechanism).groups}
    assert forms == {*DYADS}
    for name in ("velocities", "accelerations"):
        assert {*construction_forms(name)} == {*driven}


def test_coupler_curves():
    for size, random in crank_rockers(13):
        u, v = random.uniform(-50, 150), random.uniform(-80, 80)
        made = construction("coupler-curve", **of(size), u=u, v=v).values
        at = size.motion(np.radians(np.arange(0, 360, 30))).point(u, v).value
        for k, (x, y) in enumerate(at):
            assert (made[f"x{k}"], made[f"y{k}"]) == pytest.approx((x, y), **CLOSE)


def test_curvature_by_two_constructions():
    for size, random in crank_rockers(14):
        phi, u, v = random.uniform(10, 170) + random.choice((0, 180)), random.uniform(5, 60), random.uniform(5, 60)
        motion = move(size.linkage(), np.radians([phi]), speed=1.0)
        circle = inflection_circle(motion, "coupler")
        centre = complex(path_curvature(motion, LinkPoint("coupler", u, v)).centre[0])
        first = construction("inflection-circle", **of(size), phi=phi, u=u, v=v).values
        assert first["diameter"] == pytest.approx(float(circle.diameter[0]), rel=1e-6)
        assert complex(first["x_W"], first["y_W"]) == pytest.approx(complex(circle.inflection_pole[0]), rel=1e-6)
        assert complex(first["x_K0"], first["y_K0"]) == pytest.approx(centre, rel=1e-5)
        second = construction("bobillier", **of(size), phi=phi, u=u, v=v).values
        tangent = degrees(float(np.angle(circle.tangent[0]))) % 180
        assert min(abs(second["tangent"] - tangent), 180 - abs(second["tangent"] - tangent)) < 1e-5
        assert complex(second["x_K0"], second["y_K0"]) == pytest.approx(centre, rel=1e-5)


def test_roberts():
    for size, random in crank_rockers(15):
        u, v = random.uniform(-50, 150), random.uniform(10, 80)
        made = construction("roberts", **of(size), u=u, v=v, phi=random.uniform(5, 355)).values
        _, second, third = cognates(size, u, v)
        drawn = [[made[f"{key}{k}"] for key in "abcd"] for k in (1, 2)]
        solved = [[getattr(other.size, key) for key in "abcd"] for other in (second, third)]
        for lengths in drawn:
            assert any(
                np.allclose(lengths, other) or np.allclose(lengths, [*other[2::-1], other[3]]) for other in solved
            )


def test_meyer_zur_capellen():
    random = Random(16)
    for _ in range(MANY):
        ratio, diameter = random.uniform(0.55, 1.45), random.uniform(1, 20)
        made = construction("meyer-zur-capellen", ratio=ratio, D=diameter).values
        solved = symmetric_rocker(ratio, diameter=diameter)
        lever = solved.lever
        assert (made["l1"], made["l2"], made["l4"]) == pytest.approx(
            (lever.size.a, lever.size.b, lever.size.d), rel=1e-7
        )
        assert made["k"] == pytest.approx(lever.k)
        assert made["kappa"] == pytest.approx(abs(degrees(lever.kappa)), abs=1e-6)
        assert made["phi0"] == pytest.approx(degrees(solved.phi0), abs=1e-6)


def reaches(values, length, positions):
    """Whether the four-bar of a construction holds the segment in every position, in one of its assemblies."""
    a0, b0 = complex(values["x_A0"], values["y_A0"]), complex(values["x_B0"], values["y_B0"])
    size = FourBar(values["a"], length, values["c"], values["d"])
    for x, y, angle in positions:
        pin = complex(x, y)
        phi = np.angle((pin - a0) / (b0 - a0))
        ends = []
        for branch in "+-":
            joint = complex(*size.motion(float(phi), branch=branch).B.value)
            ends.append(a0 + joint * (b0 - a0) / abs(b0 - a0))
        wanted = pin + length * np.exp(1j * radians(angle))
        if not any(abs(end - wanted) < 1e-6 * (length + abs(wanted) + values["d"]) for end in ends):
            return False
    return True


def test_positions():
    random = Random(17)
    for _ in range(MANY):
        second = (random.uniform(20, 80), random.uniform(-60, 60), random.uniform(20, 150))
        third = (random.uniform(90, 160), random.uniform(-60, 60), random.uniform(160, 250))
        x2, y2, angle2 = second
        made = construction("two-positions", x2=x2, y2=y2, angle2=angle2, base=-70.0).values
        assert reaches(made, 40, [(0, 0, 0), second])
        turn = np.exp(1j * radians(angle2))
        pole = complex(made["x_P"], made["y_P"])
        assert abs(pole + turn * (0 - pole) - complex(x2, y2)) < 1e-7 * (1 + abs(pole))
        x3, y3, angle3 = third
        made = construction("three-positions", x2=x2, y2=y2, angle2=angle2, x3=x3, y3=y3, angle3=angle3).values
        assert reaches(made, 40, [(0, 0, 0), second, third])


def test_geneva_drives():
    for slots in range(3, 20):
        for distance in (0.7, 12.5, 50, 100.0, 133.3, 480):
            made, drive = construction("geneva", slots=slots, distance=distance).values, Geneva(slots)
            sizes = drive.sizes(distance)
            assert made["crank"] == pytest.approx(sizes.crank)
            assert made["wheel"] == pytest.approx(sizes.wheel)
            assert made["slot_end"] == pytest.approx(sizes.slot_end)
            assert made["engaged"] == pytest.approx(360 * drive.motion_fraction)


def test_cam_profiles():
    random = Random(18)
    for _ in range(MANY):
        rise, high = random.randint(60, 150), random.uniform(5, 30)
        law = random.choice(("3-4-5", "cycloidal", "harmonic"))
        lift = f"rise {high} {rise} {law}; dwell 30; fall {high} 120 {law}; dwell"
        base, roller = random.uniform(30, 60), random.uniform(4, 12)
        made = construction("cam", lift=lift, base=base, roller=roller).values
        cam = Cam(read_lift(lift), base, Roller(roller))
        angles = np.radians(np.arange(0, 360, 15))
        pitch, profile = cam.pitch(angles), cam.profile(angles)
        for k in range(24):
            assert made[f"r{k}"] == pytest.approx(hypot(*pitch[k]))
            assert hypot(made[f"x{k}"], made[f"y{k}"]) == pytest.approx(hypot(*profile[k]), rel=1e-6)
        turned = {
            round(degrees(np.arctan2(made[f"y{k}"], made[f"x{k}"]) - np.arctan2(profile[k][1], profile[k][0])) % 360, 4)
            for k in range(24)
        }
        assert turned <= {0.0, 360.0}


# --- pictures ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "form"), [(name, form) for name in CONSTRUCTIONS for form in construction_forms(name)]
)
def test_every_step_shows_more(name, form):
    whole = construction(name, form)
    figures = whole.figures("de")
    assert len(figures) == len(whole.steps) > 3
    assert len({(round(figure.width), round(figure.height)) for figure in figures}) == 1
    for figure in figures:  # nothing lies outside
        text = [shape for shape in figure.shapes if type(shape).__name__ == "TextShape"]
        assert text
        assert all(0 <= shape.at.x <= figure.width and 0 <= shape.at.y <= figure.height for shape in text)
    drawn = [len(figure.shapes) for figure in figures]
    assert all(step.drawn or k == len(drawn) - 1 for k, step in enumerate(whole.steps))
    assert max(drawn) == drawn[-1] or drawn[-1] >= drawn[-2] - 2
    names = {shape.text for shape in figures[-1].shapes if type(shape).__name__ == "TextShape"}
    given = {item.name for item in whole.steps[0].drawn if type(item).__name__ == "Dot" and item.name}
    assert given <= names


def test_files():
    whole = construction("geneva")
    page = construction_bytes(whole, "html", "de").decode("utf-8")
    assert page.count("<svg") == page.count("<figcaption>") == len(whole.steps)
    assert 'type="range"' in page
    assert f'max="{len(whole.steps)}"' in page
    assert "http://" not in page.replace("http://www.w3.org/2000/svg", "")
    assert "https://" not in page
    assert construction_bytes(whole, "svg").decode("utf-8").count("step 1 of 5") == 1
    assert "step 3 of 5" in construction_bytes(whole, "svg", step=3).decode("utf-8")
    pdf = construction_bytes(whole, "pdf")
    assert pdf.count(b"/Type /Page\n") + pdf.count(b"/Type /Page ") == len(whole.steps)
    with pytest.raises(GrueblerError, match="expected a step from 1 to 5"):
        construction_bytes(whole, "svg", step=6)


@pytest.mark.parametrize(
    ("name", "values", "says"),
    [
        ("dead-centre", {}, "did you mean 'dead-centres'"),
        ("dead-centres", {"q": 1}, "no quantity 'q'"),
        ("dead-centres", {"a": "long"}, "a: expected a number"),
        ("dead-centres", {"a": 70}, "not a crank-rocker"),
        ("central-crank-rocker", {"a": 80}, "a < b"),
        ("coupler-curve", {"step": 7}, "step must divide"),
        ("meyer-zur-capellen", {"ratio": 2}, "lambda must lie"),
        ("geneva", {"slots": 3.5}, "whole number of slots"),
        ("cam", {"base": -1}, "positive"),
        ("inflection-circle", {"phi": 0}, "at infinity"),
    ],
)
def test_what_is_impossible_is_said(name, values, says):
    with pytest.raises(GrueblerError, match=says):
        construction(name, **values)


def test_forms():
    with pytest.raises(GrueblerError, match="the form is four-bar or slider-crank"):
        construction("dead-centres", "lever")
    with pytest.raises(LinkageError, match="does not turn"):
        construction("dead-centres", "slider-crank", a=50, b=20)
    assert isclose(construction("velocities", "slider-crank", phi=90).values["v_B"], 200)


def drawn_points(shape):
    """Points on the lines and arcs of a shape, half a pixel apart."""
    if isinstance(shape, ArcShape):
        return [shape.place(k / 100) for k in range(101)]
    if not isinstance(shape, Polylines):
        return []
    return [p.plus(q.minus(p), k / 100) for part in shape.parts for p, q in pairwise(part) for k in range(101)]


@pytest.mark.parametrize("lengths", [(20, 50, 40, 50), (25, 70, 40, 70), (20, 70, 45, 55)])
def test_the_text_of_a_transmission_angle_crosses_no_line(lengths):
    """It was written across its own arc, and the name of the pin across the circles that meet in it."""
    figure = transmission_of_crank_rocker(*lengths).figure(-1)
    texts = [shape for shape in figure.shapes if isinstance(shape, TextShape) and shape.text[:2] in ("B_", "μ_")]
    texts = [text for text in texts if "," not in text.text]  # not the caption
    assert len(texts) == 4
    for text in texts:
        half = text_width(text.text, STYLES[text.style].size) / 2 - 1
        for shape in figure.shapes:
            for p in drawn_points(shape):
                assert abs(p.x - text.at.x) > half or abs(p.y - text.at.y) > 5, (text.text, shape.style)


@pytest.mark.parametrize(
    ("name", "form", "key"),
    [
        (name, form, key)
        for name in CONSTRUCTIONS
        for form, known in construction_forms(name).items()
        for key in "abcd"
        if key in known
    ],
)
def test_a_length_that_is_not_positive_is_refused(name, form, key):
    """It was drawn: circles of the radii b and -b are the same."""
    with pytest.raises(GrueblerError, match=f"{key} must be positive, not -71"):
        construction(name, form, **{key: -71.0})


def test_universal_joints_in_two_views():
    random = Random(31)
    for _ in range(MANY):
        beta, phi = random.uniform(5, 70), random.uniform(5, 85)
        made = construction("universal-joint", beta=beta, phi=phi).values
        psi = degrees(float(UniversalJoint(radians(beta)).motion(radians(phi)).output.value))
        assert made["psi"] == pytest.approx(psi, **CLOSE)
        assert made["lead"] == pytest.approx(psi - phi, **CLOSE)


def assembled_rssr(seed):
    """Random dimensions and a crank angle, in degrees, with the rocker's angle by the closed form."""
    random, made = Random(seed), 0
    while made < MANY:
        given = {key: random.uniform(30, 120) for key in "abcd"}
        given |= {key: random.uniform(-40, 40) for key in ("crank_offset", "rocker_offset")}
        twist, phi = random.uniform(-150, 150), random.uniform(-180, 180)
        size = RSSR(**given, twist=radians(twist))
        psi = size.motion(radians(phi)).output.value if size.limits else np.nan
        if np.isfinite(psi):
            made += 1
            yield given | {"twist": twist, "phi": phi}, float(psi)


def rssr_in_a_plane_through_the_axis(seed, many):
    """Random crank-rockers whose rocker's plane holds the crank's axis."""
    random, made = Random(seed), 0
    while made < many:
        a, b, c = random.uniform(10, 40), random.uniform(60, 160), random.uniform(30, 90)
        given = {"a": a, "b": b, "c": c, "d": random.uniform(0, 90), "crank_offset": random.uniform(20, 150)}
        size = RSSR(**given, twist=np.pi / 2)
        if size.type.key == "crank_rocker":
            made += 1
            yield given, size


def test_positions_of_rssr_in_two_views():
    for given, psi in assembled_rssr(32):
        made = construction("rssr", **given).values
        assert np.exp(1j * radians(made["psi"])) == pytest.approx(np.exp(1j * psi), abs=1e-6)


def test_dead_centres_of_rssr_in_two_views():
    for given, size in rssr_in_a_plane_through_the_axis(33, 30):
        made = construction("rssr-dead-centres", **given).values
        at = {round(degrees(centre.drive)) % 360: centre.output for centre in size.dead_centres()}
        assert set(at) == {0, 180}
        for key, drive in (("psi_0", 0), ("psi_180", 180)):
            assert np.exp(1j * radians(made[key])) == pytest.approx(np.exp(1j * at[drive]), abs=1e-6)
        assert made["swing"] == pytest.approx(degrees(size.swing()), **CLOSE)


@pytest.mark.parametrize(
    ("name", "values", "words"),
    [
        ("universal-joint", {"beta": 90}, "between 0 and 90"),
        ("rssr-dead-centres", {"b": 60}, "no crank-rocker"),
    ],
)
def test_what_two_views_do_not_show(name, values, words):
    with pytest.raises(LinkageError, match=words):
        construction(name, **values)
