"""All measures of a linkage: the worked examples, prose, data, wrong calls."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.drive_cycles import drive_cycle, part_of_cycle
from gruebler.mechanics.analysis.events import transfer_function
from gruebler.mechanics.analysis.measure_units import angle_message
from gruebler.mechanics.analysis.measuring import measures, measures_of
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.transmission import transmission_angle
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics.drive_rows import rpm
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching import catalog
from tests.samples import CLASS_III, CYLINDER, parallel_legs

DEGREE = math.pi / 180

# Script on coupler linkages, section 3.2 and exercises 11 to 15: size, travel, crank angles of the outer and of the
# inner dead centre, time ratio; angles in degrees. Figures recomputed independently to all digits.
STROKES = [
    (SliderCrank(2, 4.5), 4.0, 0.0, 180.0, 1.0),
    (SliderCrank(1.7, 6, 1.5), 3.5225946994777058, 11.23334384288665, 200.41621012891448, 1.1075169227626105),
    (SliderCrank(20, 50), 40.0, 0.0, 180.0, 1.0),
    (SliderCrank(20, 85, -20), 41.23105625617661, 349.019424572387841, 162.07978686060771, 1.080199042923794),
    (SliderCrank(35, 100, -20), 71.66371484392198, 351.480375745856955, 162.07978686060771, 1.1102065807123578),
    (FourBar(2, 7, 4.5, 5.5), 69.04395699399074, 23.19176951002788, 230.47880364135784, 1.3573636852131632),
    (FourBar.central(a=2, b=7, c=4.5), 52.775599922485995, None, None, 1.0),
    (FourBar.central(a=30, b=75, c=60), 60.00000000000001, None, None, 1.0),
    (InvertedSliderCrank(30, 50), 73.73979529168804, 53.13010235415598, 306.86989764584402, 2.387910),
]


@pytest.mark.parametrize(("size", "travel", "outer", "inner", "ratio"), STROKES)
@pytest.mark.parametrize("branch", "+-")
def test_strokes(size: FourBar, travel: float, outer: float, inner: float, ratio: float, branch: str) -> None:
    found = measures(size.linkage(), branch=branch)
    assert found.travel is not None
    scale = DEGREE if found.output.turning else 1.0
    assert found.travel == pytest.approx(travel * scale, rel=1e-8)
    assert found.time_ratio == pytest.approx(ratio, rel=1e-8 if ratio != 2.387910 else 1e-6)
    if outer is not None and branch == "+":
        assert abs(np.exp(1j * found.outer.drive) - np.exp(1j * outer * DEGREE)) < 1e-8
        assert abs(np.exp(1j * found.inner.drive) - np.exp(1j * inner * DEGREE)) < 1e-8


def test_times_at_a_speed() -> None:
    found = measures(FourBar(2, 7, 4.5, 5.5).linkage(), speed=rpm(300))
    assert found.times.longest * 1000 == pytest.approx(115.15946340629442, rel=1e-8)
    assert found.times.shortest * 1000 == pytest.approx(84.84053659370558, rel=1e-8)
    assert found.times.difference * 1000 == pytest.approx(30.318926812588842, rel=1e-8)
    back = measures(FourBar(2, 7, 4.5, 5.5).linkage(), speed=rpm(-300))
    assert (back.times.forward, back.times.back) == pytest.approx((found.times.back, found.times.forward))
    assert found.delta_phi == pytest.approx(27.28703413132995 * DEGREE, rel=1e-8)


# Section 3.4 and exercises 12 to 14: the smallest transmission angle in degrees.
ANGLES = [
    (FourBar(2, 5, 4, 5), 36.86989764584401),
    (SliderCrank(2, 5), 66.42182152179817),
    (SliderCrank(2, 10), 78.46304096718453),
    (SliderCrank(3, 5, 1), 36.86989764584401),
    (FourBar(30, 75, 60, 91.2414379544733), 52.5350310724444),
    (SliderCrank(15, 37.5), 66.42182152179817),
    (SliderCrank(15, 75), 78.46304096718453),
    (SliderCrank(20, 85, -20), 61.92751306414704),
]


@pytest.mark.parametrize(("size", "mu"), ANGLES)
@pytest.mark.parametrize("branch", "+-")
def test_transmission_angles(size: FourBar | SliderCrank, mu: float, branch: str) -> None:
    found = measures(size.linkage(), branch=branch).transmission
    assert found is not None
    assert found.smallest.mu == pytest.approx(mu * DEGREE, rel=1e-8)
    assert found.smallest.deviation == pytest.approx((90 - mu) * DEGREE, rel=1e-8)
    assert found.good == (mu > 40)


# Section 3.6.2.1, a = 25, b = 70, c = 40, d = 70 at 55 degrees, both branches: psi', psi'', mu in degrees; exercise 21,
# the slider-crank 25, 70; exercise 11, mu where the slider is halfway; section 3.3, the way at 90 degrees.
def test_transfer_functions_of_the_worked_example() -> None:
    for branch, first, second in (
        ("+", 0.4785205278035138, 0.45135747093926994),
        ("-", -0.6938783961347902, 0.53925729838085616),
    ):
        course = drive_cycle(FourBar(25, 70, 40, 70).linkage(), branch=branch)
        output, at = find_output(course.linkage), np.array([55 * DEGREE])
        assert transfer_function(course, output, at, 1)[0] == pytest.approx(first, rel=1e-8)
        assert transfer_function(course, output, at, 2)[0] == pytest.approx(second, rel=1e-8)
        assert transmission_angle(course.at(at))[0] == pytest.approx(57.819218178233285 * DEGREE, rel=1e-8)


def test_transfer_functions_of_slider_cranks() -> None:
    course = drive_cycle(SliderCrank(25, 70).linkage())
    output, at = find_output(course.linkage), np.array([55 * DEGREE])
    assert transfer_function(course, output, at, 1)[0] == pytest.approx(-24.865793126300107, rel=1e-8)
    assert transfer_function(course, output, at, 2)[0] == pytest.approx(-11.433459655269419, rel=1e-8)
    assert transmission_angle(course.at(at))[0] == pytest.approx(72.9890596257168 * DEGREE, rel=1e-8)
    half = drive_cycle(SliderCrank(20, 50).linkage()).at(np.array([78.46304096718453 * DEGREE]))
    assert half.displacement("P(frame-slider)")[0] == pytest.approx(50, rel=1e-8)
    assert transmission_angle(half)[0] == pytest.approx(66.92608193436902 * DEGREE, rel=1e-8)
    third = drive_cycle(SliderCrank(2, 5).linkage()).at(np.array([math.pi / 2]))
    assert third.displacement("P(frame-slider)")[0] == pytest.approx(4.58257569495584, rel=1e-8)


def test_uniform_and_still_outputs() -> None:
    parallel = measures(FourBar(25, 70, 25, 70).linkage())
    assert parallel.transfer.uniform
    assert parallel.transfer.ratio == pytest.approx(1, abs=1e-9)
    assert parallel.output_turns == 1
    assert parallel.travel is None
    assert len(parallel.change_points) == 2
    coupler = measures(FourBar(25, 70, 25, 70).linkage(), output="coupler")
    assert coupler.transfer.still
    assert not coupler.dead_centres
    crossed = measures(FourBar(25, 70, 25, 70).linkage(), branch="-")
    assert not crossed.transfer.uniform
    assert crossed.output_turns == -1
    assert not measures(FourBar(25, 70, 40, 70).linkage()).transfer.uniform


def test_a_kite_repeats_after_two_turns() -> None:
    """The double crank of Galloway: two turns of the crank are one of the output."""
    found = measures(FourBar(25, 70, 70, 25).linkage())
    assert (found.span.full, found.span.turns, found.output_turns) == (True, 2, 1)
    assert [point.drive for point in found.change_points] == pytest.approx([0, 2 * math.pi], abs=1e-10)
    assert "2 turns" in found.explain()


def test_a_transmission_angle_that_does_not_vary() -> None:
    found = measures(InvertedSliderCrank(30, 50).linkage())
    assert "90° throughout" in found.explain()
    assert "durchweg 90°" in found.explain("de")


def test_a_drive_of_limited_range() -> None:
    found = measures(CYLINDER, output="4")
    assert (found.span.low, found.span.high) == pytest.approx(
        (4 - math.sqrt(5), 4 + math.sqrt(5)), abs=1e-9
    )  # the triangle over A0 B0 = 4 with the lever sqrt(5)
    assert found.travel == pytest.approx(math.pi, abs=1e-8)
    assert found.ends == pytest.approx((math.pi, 0), abs=1e-8)
    assert found.time_ratio is None
    assert not found.turning_drive


PLAIN = [
    (FourBar(2, 7, 4.5, 5.5).linkage(), "crank"),
    (FourBar(25, 70, 25, 70).linkage(), None),
    (SliderCrank(70, 25).linkage(), None),
    (InvertedSliderCrank(30, 50, 7).linkage(), "P(coupler-block)"),
    (CLASS_III, None),
    (CYLINDER, "1"),
]


@pytest.mark.parametrize(("linkage", "output"), PLAIN)
def test_prose_and_data(linkage: Linkage, output: str | None) -> None:
    found = measures(linkage, output=output)
    english, german = found.explain(), found.explain("de")
    assert len(english.splitlines()) == len(german.splitlines()) >= 3
    assert "nan" not in english.lower()
    assert not set(english.splitlines()) & set(german.splitlines())
    data = json.loads(json.dumps(found.to_json(), allow_nan=False))
    assert (data["transmission"] is None) == bool(data["transmission_note"])
    assert data["travel"] is None or data["travel"] >= 0


def test_a_link_that_floats_turns_back_and_has_no_dead_centres() -> None:
    """At 90 degrees the crank of the lambda linkage is parallel to its rocker, neither stretched with the coupler nor
    over it; the rocker's dead centres are where it is."""
    linkage = FourBar(20, 50, 50, 40).linkage()
    words = measures(linkage, output="coupler", speed=rpm(60)).explain()
    assert "The output turns back at 90°: 36.87°." in words  # the coupler as the hypotenuse of 30, 40, 50
    assert "dead centre" not in words
    assert "outer" not in words
    assert "s while the output goes from" in words
    assert "Outer dead centre" in measures(linkage, output="rocker").explain()


def test_dead_centres_are_those_of_crank_and_coupler_in_line() -> None:
    """Inner and outer: crank and coupler overlap or are stretched (docs/glossary.md). The slotted lever of an inverted
    slider-crank turns back where the crank is normal to it, a second dyad where its own bars say so."""
    piston = measures(catalog.entry("vcomp").linkage())  # of two loops, each with its own rod
    assert piston.in_line
    assert "Outer dead centre at 45°: 140 mm." in piston.explain()
    lever = measures(InvertedSliderCrank(30, 60).linkage())
    assert not lever.in_line
    assert "dead centre" not in lever.explain()
    # sin of half the swing is 30/60, the crank normal to the lever 60 degrees from the frame: 240 degrees to 120
    assert "time ratio 2." in lever.explain()
    for name in ("whitworth", "e3_steph", "toggle_press"):
        words = measures(catalog.entry(name).linkage()).explain()
        assert "dead centre" not in words
        assert words.count("The output turns back at ") == 2
    ram = measures(catalog.entry("whitworth").linkage())
    assert "The slow" not in ram.explain()
    assert "Turning counter-clockwise, the way back is the quick one." in ram.explain()  # it is a quick return


def test_points_of_a_link_that_does_not_turn_travel() -> None:
    """The blade of the wiper goes as the pins of the rockers that carry it: a chord of their swing."""
    linkage = catalog.entry("wiper").linkage()
    blade, rocker = measures(linkage), measures(linkage, output="rocker2")
    arm = math.hypot(20, 120)  # from (320, 0) to (300, 120), in the file
    assert rocker.travel is not None
    assert blade.shift == pytest.approx(2 * arm * math.sin(rocker.travel / 2), rel=1e-3)
    assert "The output blade does not turn; its points travel 120 mm." in blade.explain()
    assert rocker.shift == 0


def test_equal_dwells_are_said_once() -> None:
    """A Geneva drive of four slots moves for (4 - 2)/(2 4) of a turn: 90 degrees of 360 (any book on mechanisms)."""
    words = measures(catalog.entry("geneva").linkage()).explain().splitlines()
    (said,) = [line for line in words if line.startswith("Dwell")]
    # as the wheel is seen in the plots, within one turn
    assert said == "Dwells of 270° each, from 45°, 405°, 765°, 1125°: at 315°, 225°, 135°, 45°."
    assert "It moves during 360° of 1440° of the drive; ratio of motion to dwell 1 : 3." in words


def test_german_terms() -> None:
    text = measures(FourBar(2, 7, 4.5, 5.5).linkage(), speed=rpm(300)).explain("de")
    for term in ("Antrieb läuft um", "Innere Totlage", "Äußere Totlage", "Zeitverhältnis", "Übertragungswinkel"):
        assert term in text
    assert "vom Antrieb selbst bewegt" in measures(FourBar(2, 7, 4.5, 5.5).linkage(), output="crank").explain("de")


def test_sizes_scale_and_mirror() -> None:
    one = measures(CLASS_III, output="4")
    large, mirrored = measures(CLASS_III.scaled(1000), output="4"), measures(CLASS_III.mirrored(), output="4")
    assert large.travel == pytest.approx(one.travel, rel=1e-8)
    assert mirrored.travel == pytest.approx(one.travel, rel=1e-8)
    assert [c.drive for c in large.dead_centres] == pytest.approx([c.drive for c in one.dead_centres], abs=1e-9)
    assert [-c.drive for c in mirrored.dead_centres[::-1]] == pytest.approx(
        [c.drive for c in one.dead_centres], abs=1e-9
    )


@pytest.mark.parametrize("speed", [0, math.nan, math.inf, "fast", True])
def test_wrong_speeds(speed: object) -> None:
    with pytest.raises(LinkageError, match=r"in rad/s other than 0|speed: expected a number"):
        measures(FourBar(2, 7, 4.5, 5.5).linkage(), speed=speed)  # type: ignore[arg-type]


def test_other_wrong_calls() -> None:
    with pytest.raises(LinkageError, match="sliding one"):
        measures(CYLINDER, speed=30)
    with pytest.raises(LinkageError, match="none of"):
        measures(CYLINDER, output="R(0-1)")
    with pytest.raises(LinkageError, match="branch"):
        measures(FourBar(2, 7, 4.5, 5.5).linkage(), branch="++")
    with pytest.raises(LinkageError, match="cannot be assembled"):
        measures(FourBar(1, 2, 3, 40).linkage())
    with pytest.raises(LinkageError, match="one drive"):
        measures(
            Linkage.from_drawing(
                Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)"),
                {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (3, 4), "R(3-4)": (6, 2), "R(0-4)": (6, 0)},
            )
        )


def test_strokes_are_those_between_dead_centres_that_follow_one_another():
    """A gear of 2 to 3 drives a central slider-crank: three strokes of 120 degrees each way in two turns."""
    from gruebler.files.linkages import linkage_from_json

    geared = linkage_from_json(
        {
            "unit": "mm",
            "joints": "R(frame-g1) R(frame-g2) G(g1-g2) R(g2-rod) R(rod-slider) P(frame-slider)",
            "frame": "frame",
            "drives": ["R(frame-g1)"],
            "places": {
                "R(frame-g1)": [0, 0],
                "R(frame-g2)": [50, 0],
                "R(g2-rod)": [50, 15],
                "R(rod-slider)": [130, 0],
                "P(frame-slider)": [130, 0, 0],
                "G(g1-g2)": {"g1": {"at": [0, 0], "radius": 30}, "g2": {"at": [50, 0], "radius": 20}},
            },
        }
    )
    found = measures(geared)
    assert found.span.turns == 2
    assert len(found.dead_centres) == 6
    assert np.degrees([found.phi_forward, found.phi_back]) == pytest.approx([120, 120], abs=1e-8)
    assert found.time_ratio == pytest.approx(1, abs=1e-9)


def test_change_points_that_are_not_known_are_not_told_as_none(monkeypatch):
    def no_circuit(*_, **__):
        raise LinkageError("this linkage has no drive")

    monkeypatch.setattr("gruebler.mechanics.analysis.events.circuit", no_circuit)
    found = measures(parallel_legs())
    assert found.change_points == ()
    assert "Change points of larger groups are not known: this linkage has no drive" in found.explain()
    assert "nicht bekannt: dieses Getriebe hat keinen Antrieb" in found.explain("de")
    assert found.to_json()["change_points_note"] == "this linkage has no drive"


def test_a_part_of_the_range_is_measured_between_its_ends():
    """Crank 25, coupler 70, rocker 40, frame 70: the rocker by triangles, at both ends and at its dead centre."""

    def rocker(crank: float) -> float:
        gap = 25 * np.exp(1j * crank) - 70
        return float(np.angle(gap) % (2 * np.pi) - math.acos((abs(gap) ** 2 + 40**2 - 70**2) / (2 * 40 * abs(gap))))

    linkage = FourBar(25, 70, 40, 70).linkage()
    cycle = drive_cycle(linkage)
    output = find_output(linkage, None)
    dead = math.acos((70**2 + 95**2 - 40**2) / (2 * 70 * 95))  # crank and coupler in line
    part = measures_of(part_of_cycle(cycle, -0.5, 0.5), linkage, output)
    assert [centre.drive for centre in part.dead_centres] == pytest.approx([dead], abs=1e-9)
    assert part.travel == pytest.approx(rocker(-0.5) - rocker(dead), abs=1e-9)
    assert part.transmission.smallest.mu == pytest.approx(math.acos((70**2 + 40**2 - 45**2) / (2 * 70 * 40)), abs=1e-9)
    assert part.explain().startswith("The drive turns from -28.65° to 28.65°.")
    part = measures_of(part_of_cycle(cycle, 1.0, 2.0), linkage, output)
    assert part.dead_centres == ()
    assert part.travel == pytest.approx(rocker(2.0) - rocker(1.0), abs=1e-9)
    # of a limited range the end that is kept has its reason
    linkage = FourBar(65, 70, 40, 70).linkage()
    cycle = drive_cycle(linkage)
    below, above = part_of_cycle(cycle, 0.0, 1.0).span.stops
    assert (below, above) == (cycle.span.stops[0], None)


def test_an_angle_has_four_digits_unless_it_is_a_round_one() -> None:
    """93.12950002° of a Hoecken linkage stood with six digits; what a person types, such as 22.338°, keeps them."""
    shown = [str(angle_message(math.radians(value))) for value in (93.12950002, 22.338, 22.33800000001, -40.0)]
    assert shown == ["93.13°", "22.338°", "22.338°", "-40°"]
