"""The worked examples and exercises of the documents 000/003, chapters 3 and 4, and the conchoid linkage."""

import math

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar.four_bar import FourBar
from gruebler.mechanics.fourbar.inverted_slider_crank import InvertedSliderCrank
from gruebler.mechanics.fourbar.slider_crank import SliderCrank

deg = math.degrees


def near(value):
    return pytest.approx(value, rel=1e-9, abs=1e-9)


def test_3_2_1_slider_cranks():
    central = SliderCrank(a=2, b=4.5)
    assert (central.dead_centres.inner.output, central.dead_centres.outer.output, central.stroke) == near((2.5, 6.5, 4))
    assert central.dead_centres.time_ratio == near(1)
    centres = SliderCrank(a=1.7, b=6, e=1.5).dead_centres
    assert (centres.inner.output, centres.outer.output) == near((4.029888335921977, 7.552483035399683))
    assert centres.travel == near(3.5225946994777058)
    assert (deg(centres.outer_line), deg(centres.inner_line)) == near((11.23334384288665, 20.41621012891448))
    assert (deg(centres.phi_max), deg(centres.phi_min)) == near((189.18286628602783, 170.81713371397217))
    assert deg(centres.delta_phi) == near(9.182866286027828)
    assert centres.time_ratio == near(1.1075169227626105)


def test_3_2_2_crank_rockers():
    central = FourBar.central(a=2, b=7, c=4.5)
    assert central.d == near(8.077747210701755)
    assert deg(central.swing) == near(52.775599922485995)
    assert central.is_central
    rocker = FourBar(a=2, b=7, c=4.5, d=5.5)
    centres = rocker.dead_centres
    assert not rocker.is_central
    assert (deg(centres.inner_line), deg(centres.outer_line)) == near((50.47880364135783, 23.19176951002788))
    assert (deg(centres.inner.drive), deg(centres.outer.drive)) == near((230.47880364135784, 23.19176951002788))
    assert (deg(centres.inner.output), deg(centres.outer.output)) == near((121.00758300686714, 51.9636260428764))
    assert deg(centres.delta_phi) == near(27.28703413132995)
    assert (deg(centres.phi_max), deg(centres.phi_min)) == near((207.28703413132996, 152.71296586867004))
    assert deg(rocker.swing) == near(69.04395696399074)
    assert centres.time_ratio == near(1.3573636852131632)
    # The second time is printed as 48.8 ms under the first one's name: a misprint.
    times = centres.times(300)
    assert (times.longest, times.shortest) == near((0.11515946340629442, 0.08484053659370558))
    assert times.difference == near(0.030318926812588842)
    assert times.forward == times.shortest


@pytest.mark.parametrize(
    ("ratio", "b", "time", "offset", "phi", "fraction"),
    [
        (0.4, 5, 4.58257569495584, 0.41742430504416017, 78.46304096718453, 0.43590578315102513),
        (0.2, 10, 9.797958971132712, 0.20204102886728847, 84.26082952273322, 0.4681157195707401),
    ],
)
def test_3_3_way_middle_and_time_middle(ratio, b, time, offset, phi, fraction):
    slider_crank = SliderCrank.from_ratio(a=2, ratio=ratio)
    assert (slider_crank.b, slider_crank.ratio) == near((b, ratio))
    middle = slider_crank.middle
    assert (middle.displacement, middle.time, middle.offset) == near((b, time, offset))
    assert (deg(middle.phi_displacement), deg(middle.phi_time), middle.time_fraction) == near((phi, 90, fraction))


def test_3_4_transmission_angles():
    mu = FourBar(a=2, b=5, c=4, d=5).transmission_angle
    assert (deg(mu.extremes[0].angle), deg(mu.extremes[-1].angle)) == near((36.86989764584401, 101.53695903281549))
    assert (mu.extremes[0].drive, mu.extremes[-1].drive) == near((0, math.pi))
    assert (deg(mu.extremes[0].mu), deg(mu.extremes[-1].mu)) == near((36.86989764584401, 78.46304096718451))
    assert (deg(mu.extremes[0].deviation), deg(mu.extremes[-1].deviation)) == near(
        (53.13010235415599, 11.536959032815489)
    )
    assert deg(mu.smallest.mu) == near(36.86989764584401)
    assert mu.largest.mu == math.pi / 2
    assert not mu.good
    for b, smallest, deviation in (
        (5, 66.42182152179817, 23.578178478201835),
        (10, 78.46304096718453, 11.536959032815489),
    ):
        mu = SliderCrank(a=2, b=b).transmission_angle
        assert (deg(mu.smallest.mu), deg(mu.smallest.deviation)) == near((smallest, deviation))
    mu = SliderCrank(a=3, b=5, e=1).transmission_angle
    assert (deg(mu.smallest.mu), deg(mu.smallest.deviation)) == near((36.86989764584401, 53.13010235415599))
    assert (deg(mu.extremes[0].mu), deg(mu.extremes[0].deviation)) == near((66.42182152179817, 23.578178478201835))
    assert deg(mu.smallest.drive) == 270


WAYS = [70, 66.31030293135234, 56.9041575982343, 45.8257569495584, 36.904157598234306, 31.669286779974787, 30]


def test_exercise_2_transfer_function():
    ways = SliderCrank(a=20, b=50).motion(np.radians(np.arange(0, 361, 30))).output.value
    assert ways == near([*WAYS, *WAYS[-2::-1]])


def test_exercises_11_and_13():
    compressor = SliderCrank.from_stroke(40, ratio=0.4)
    assert (compressor.a, compressor.b) == near((20, 50))
    first, second = compressor.phi_at(50)
    assert (deg(first), deg(second)) == near((78.46304096718453, 360 - 78.46304096718453))
    assert 180 - deg(first) == near(101.53695903281547)
    assert deg(compressor.motion(first).transmission_angle) == near(66.92608193436902)
    assert deg(compressor.motion(first).deviation_angle) == near(23.07391806563098)
    smallest = [deg(SliderCrank(a=15, b=b).transmission_angle.smallest.mu) for b in (37.5, 75)]
    assert smallest == near([66.42182152179817, 78.46304096718453])  # printed 78.2


def test_exercise_12_central_crank_rocker():
    rocker = FourBar.central(a=30, b=75, c=60)
    assert (rocker.d, rocker.ratio) == near((91.2414379544733, 0.4))
    mu = rocker.transmission_angle
    assert [deg(x) for x in (mu.extremes[0].angle, mu.extremes[-1].angle, mu.smallest.mu)] == near(
        [52.53503107244442, 127.4649689275556, 52.53503107244442]
    )
    assert mu.good
    assert deg(rocker.swing) == near(60)
    assert rocker.dead_centres.time_ratio == near(1)
    by_swing = FourBar.central_for_swing(math.radians(60), c=60, b=75)
    assert (by_swing.a, by_swing.d) == near((30, 91.2414379544733))
    for missing in "abcd":
        sizes = {name: getattr(rocker, name) for name in "abcd" if name != missing}
        assert getattr(FourBar.central(**sizes), missing) == near(getattr(rocker, missing))
    with pytest.raises(LinkageError, match=r"no central crank-rocker has a = 9, b = 3, c = 4: d\^2 would be -56"):
        FourBar.central(a=9, b=3, c=4)
    with pytest.raises(LinkageError, match="asks for d = 1"):
        FourBar.central(a=7, b=5, c=5)
    with pytest.raises(LinkageError, match="between 0 and pi"):
        FourBar.central_for_swing(4, c=1, b=2)


def test_exercise_14_eccentricity_below():
    linkage = SliderCrank(a=20, b=85, e=-20)
    mu = linkage.transmission_angle
    assert (deg(mu.smallest.mu), deg(mu.largest.mu)) == near((61.92751306414704, 90))
    assert (deg(mu.extremes[-1].drive), deg(mu.extremes[-1].angle)) == near((270, 90))
    centres = linkage.dead_centres
    assert (centres.inner.output, centres.outer.output) == near((61.84658438426491, 103.07764064044152))
    assert centres.travel == near(41.23105625617661)
    assert (-deg(centres.outer_line), -deg(centres.inner_line)) == near((10.980575427612159, 17.92021313939229))
    assert centres.time_ratio == near(1.080199042923794)


STROKES = [0, 6.479212275988488, 23.651714829750546, 44.55557963967942, 61.259070227401594, 70.04821826884083]
STROKES += [71.34750045433046, 66.33766083583288, 55.58066863016991, 39.769060255516564, 21.48695489925298]
STROKES += [6.1426323180972275, 0]


def test_exercise_15_transfer_function_from_the_outer_dead_centre():
    linkage = SliderCrank.from_ratio(a=35, ratio=0.35, e=-20)
    centres = linkage.dead_centres
    assert linkage.b == 100
    assert linkage.stroke == near(71.66371484392198)
    assert deg(centres.phi_max - centres.phi_min) == near(18.801177770498487)  # drawn: 18.4
    assert centres.time_ratio == near(1.1102065807123578)
    assert deg(centres.phi_back) == near(170.59941111475078)
    steps = np.radians(np.arange(0, 361, 30))
    strokes = centres.outer.output - linkage.motion(centres.outer.drive + steps).output.value
    assert strokes == pytest.approx(STROKES, abs=1e-9)
    again = SliderCrank.from_dead_centres(centres.inner.output, centres.outer.output, e=-20)
    assert (again.a, again.b) == near((35, 100))
    again = SliderCrank.from_stroke(linkage.stroke, ratio=0.35, e=-20)
    assert (again.a, again.b) == near((35, 100))
    with pytest.raises(LinkageError, match="below 1"):
        SliderCrank.from_stroke(40, ratio=1.5)
    with pytest.raises(LinkageError, match=r"allows \|e\| = 21 at most, not 25"):
        SliderCrank.from_stroke(40, ratio=0.4, e=25)
    with pytest.raises(LinkageError, match="ratio must be positive, not 0"):
        SliderCrank.from_ratio(a=40, ratio=0)
    with pytest.raises(LinkageError, match="more than 1e9 times any length"):
        SliderCrank(1, 2, e=-1e30)
    with pytest.raises(LinkageError, match="must lie outside"):
        SliderCrank.from_dead_centres(30, 20)


OPEN = {
    "B": (82.07650800998915, 38.13342306015378),
    "vB": (-182.47625729699473, 57.78856986963373),
    "aB": (-1997.7107086190983, -328.1041382170231),
    "theta": 14.608261208112138,
    "psi": 72.42747938634542,
    "rates": (-1.2637910817201943, 4.785205278035138, 25.805259492185364, 45.135747093926994),
    "mu": 57.819218178233285,
    "i": 2.0897745068328852,
}
CROSSED = {
    "B": (54.482052652309946, -36.86723898143606),
    "vB": (-255.8138065435687, 107.67568416919296),
    "aB": (2735.231079529418, 938.2201016226982),
    "theta": -55.00770240714474,
    "psi": -112.82692058537805,
    "rates": (-0.8897876015925671, -6.938783961347902, 73.25621743982727, 53.925729838085616),
    "mu": 57.8192181782333,
    "i": -1.4411747152965746,
}


@pytest.mark.parametrize(("branch", "figures"), [("+", OPEN), ("-", CROSSED)])
def test_3_6_2_velocities_and_accelerations(branch, figures):
    motion = FourBar(a=25, b=70, c=40, d=70).motion(math.radians(55), omega=10, branch=branch)
    assert motion.A.value == near((14.339410908776154, 20.478801107224793))
    assert motion.A.velocity == near((-204.78801107224794, 143.39410908776154))
    assert motion.A.acceleration == near((-1433.9410908776154, -2047.8801107224792))
    assert motion.B.value == near(figures["B"])
    assert motion.B.velocity == near(figures["vB"])
    assert motion.B.acceleration == near(figures["aB"])
    assert (deg(motion.coupler.value), deg(motion.output.value)) == near((figures["theta"], figures["psi"]))
    rates = (motion.coupler.velocity, motion.output.velocity, motion.coupler.acceleration, motion.output.acceleration)
    assert rates == near(figures["rates"])
    assert (deg(motion.mu), float(motion.ratio)) == near((figures["mu"], figures["i"]))


@pytest.mark.parametrize(
    ("branch", "rates"),
    [
        ("+", (3.62577234130548, -1.583234356747855, -6.326626801261231, -37.7103456668183)),
        ("-", (0.6988342931342503, 5.9078409911875855, -15.275095614360728, 16.10862325119635)),
    ],
)
def test_3_6_2_counted_from_the_other_side(branch, rates):
    motion = FourBar(a=25, b=70, c=40, d=70).motion(math.radians(235), omega=10, branch=branch)
    assert (motion.coupler[1], motion.output[1], motion.coupler[2], motion.output[2]) == near(rates)


def test_exercise_21_piston():
    linkage = SliderCrank(a=25, b=70)
    motion = linkage.motion(np.radians([55, 180 - 55]), omega=[10, -10])
    assert motion.output.value == near((81.2768347104936, 52.59801289294129))
    assert motion.output.velocity == near((-248.65793126300107, -160.9180908814948 * -1))
    assert motion.output.acceleration == near((-1143.3459655269419, 1724.5362162282888))
    assert motion.coupler.velocity == near((-2.1422113511945824, -2.1422113511945824))
    assert motion.coupler.acceleration == near((29.18997115129064, 29.18997115129064))
    assert np.degrees(motion.transmission_angle) == near((72.9890596257168, 72.9890596257168))
    assert deg(motion.coupler.value[0]) == near(-17.010940374283187)


CONCHOID = [
    (0, 120.0, 0.0, 20.0, 0.0),
    (30, 102.317779, -32.672422, 28.318259, -31.984754),
    (60, 87.265956, -27.662798, 43.588989, -36.586776),
    (90, 77.174363, -16.304618, 58.309519, -30.963757),
    (120, 68.571429, -7.423075, 70.0, -21.786789),
    (150, 62.315062, -2.431220, 77.447248, -11.167636),
    (180, 60.0, 0.0, 80.0, 0.0),
]


def test_exercise_17_conchoid_linkage():
    linkage = InvertedSliderCrank(a=30, d=50)
    assert linkage.type.name("de") == "schwingende Kurbelschleife"
    table = np.array(CONCHOID)
    motion = linkage.motion(np.radians(table[:, 0]))
    assert motion.point(90).value == pytest.approx(table[:, 1:3], abs=1e-6)
    assert motion.displacement.value == pytest.approx(table[:, 3], abs=1e-6)
    assert np.degrees(motion.coupler.value) == pytest.approx(table[:, 4], abs=1e-6)
    centres = linkage.dead_centres
    assert (deg(linkage.swing), deg(centres.outer.drive)) == near((73.73979529168804, 53.13010235415599))
    assert centres.time_ratio == near(2.387909904636574)
    assert InvertedSliderCrank.for_time_ratio(centres.time_ratio, d=50).a == near(30)
    with pytest.raises(LinkageError, match="above 1"):
        InvertedSliderCrank.for_time_ratio(1, d=50)


# Figures of the joint B and of the coupler point C = A + 2 (B - A) in exercise 20; B in exercise 16.
def test_exercises_16_and_20_coupler_curves():
    motion = FourBar(a=20, b=50, c=50, d=40).motion(np.radians([30, 180, 270]))
    expected = [(79.08595462650173, 88.64495923057413), (40, 80), (0, 80)]
    assert motion.point(100).value == pytest.approx(np.array(expected), rel=1e-9, abs=1e-9)
    motion = FourBar(a=30, b=90, c=100, d=120).motion(np.radians([0, 15, 45]))
    assert motion.B.value[0] == near((64.44444444444444, 83.1479419283098))
    expected = [(10.267581, 56.882613), (14.737892, 66.264364), (18.765841, 81.371415)]
    assert motion.point(45, 40).value == pytest.approx(np.array(expected), abs=1e-6)


@pytest.mark.parametrize(
    ("linkage", "key", "turning"),
    [
        (SliderCrank(2, 5, 1), "slider_crank", ("a",)),
        (SliderCrank(2, 3, -1), "change_point_slider_crank", ("a",)),
        (SliderCrank(5, 2, 1), "slider_rocker_turning_coupler", ("b",)),
        (SliderCrank(3, 2, 1), "change_point_slider_rocker", ("b",)),
        (SliderCrank(2, 2), "isosceles_slider_crank", ("a", "b")),
        (SliderCrank(2, 2.5, 1), "slider_rocker", ()),
        (SliderCrank(2, 2, 4), "single_position", ()),
        (SliderCrank(2, 2, -5), "not_assemblable", ()),
        (InvertedSliderCrank(2, 5, 1), "swinging_guide", ("a",)),
        (InvertedSliderCrank(5, 2, 1), "turning_guide", ("a", "guide")),
        (InvertedSliderCrank(2, 3, 1), "change_point_swinging_guide", ("a",)),
        (InvertedSliderCrank(3, 2, 1), "change_point_turning_guide", ("a", "guide")),
        (InvertedSliderCrank(2, 2), "isosceles_guide", ("a", "guide")),
        (InvertedSliderCrank(2, 2.5, 1), "rocking_guide", ()),
        (InvertedSliderCrank(2, 2, 4), "single_position", ()),
        (InvertedSliderCrank(2, 2, 5), "not_assemblable", ()),
    ],
)
def test_types_of_slider_cranks(linkage, key, turning):
    assert linkage.type.key == key
    assert linkage.turning == turning
    assert (linkage.dead_centres is None) == (turning != ("a",))
    if key == "not_assemblable":
        assert linkage.limits == ()
        with pytest.raises(LinkageError, match="not assemblable"):
            _ = linkage.transmission_angle
