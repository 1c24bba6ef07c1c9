"""Straight-line quality."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.geometry import coupler_path, linkage_path, longest_piece, path_piece, piece_of_ratio
from gruebler.mechanics.geometry.sizing import crank_length, tangent_windows
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

LENKER = coupler_path(FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4), 8.018753738744802, 2.268046058132576)
CONCHOID = coupler_path(InvertedSliderCrank(30, 50), 90, 0)
LAMBDA = coupler_path(FourBar(20, 50, 50, 40), 100, 0)

# Q_G, window in degrees, its beginning, L/l1 of the isosceles crank-rocker.
QG_TABLE = [
    (1e-06, 29.41365915, 165.293170425, 0.834615432),
    (1e-05, 46.656141647, 156.671929176, 1.314814296),
    (0.0001, 74.089500889, 142.955249556, 2.050372978),
    (0.0005, 102.488237713, 128.755881143, 2.753253004),
    (0.001, 117.905805725, 121.047097137, 3.099352087),
    (0.002, 135.669166983, 112.165416509, 3.457838562),
    (0.003, 147.28144515, 106.359277425, 3.664443871),
    (0.004, 156.115155231, 101.942422385, 3.804739226),
    (0.005, 163.32477378, 98.33761311, 3.907352348),
    (0.006, 169.455607921, 95.27219604, 3.985561965),
    (0.008, 179.581961783, 90.209019108, 4.095101238),
    (0.01, 187.827377087, 86.086311456, 4.164803775),
]


@pytest.mark.parametrize(("ratio", "window", "start", "length"), QG_TABLE)
def test_relative_deviation(ratio, window, start, length):
    found = piece_of_ratio(LENKER, math.pi, ratio)
    assert abs(math.degrees(found.end - found.start) - window) < 2e-7
    assert abs(math.degrees(found.start) - start) < 1e-7
    assert abs(found.length - length) < 5e-9
    assert math.isclose(found.ratio, ratio, rel_tol=1e-7)
    assert abs(math.degrees(found.direction) - 15.79316904826399) < 1e-9


def test_window_given():
    """163.3 degrees: L = 3.907, Dy = 0.0195."""
    half = math.radians(163.3 / 2)
    found = path_piece(LENKER, math.pi - half, math.pi + half, direction=math.radians(15.79316904826399))
    assert abs(found.length - 3.907019046) < 1e-9
    assert abs(found.band - 0.019520446675) < 1e-11
    assert abs(found.ratio - 0.004996250708) < 1e-11


def test_lambda_linkage():
    """1 : 2 : 2.5 with 20 mm: crank angles 90 to 270 degrees, a line of 80 mm within 0.195."""
    found = path_piece(LAMBDA, math.pi / 2, 3 * math.pi / 2, direction=0)
    assert abs(found.length - 80) < 1e-9
    assert abs(found.band - 0.195075) < 1e-6
    assert abs(found.ratio - 0.002438) < 5e-7
    narrow = path_piece(LAMBDA, math.pi / 2, 3 * math.pi / 2)
    assert abs(narrow.band - found.band) < 1e-5
    for band, length in ((0.01, 7.210260387), (0.05, 16.713497735), (0.1, 25.003512870), (0.2, 88.813674830)):
        start, _ = {0.01: (172.255, 0), 0.05: (162.055, 0), 0.1: (153.165, 0), 0.2: (75.375, 0)}[band]
        window = path_piece(LAMBDA, math.radians(start), math.radians(360 - start), direction=0)
        assert abs(window.length - length) < 1e-8
        assert window.band < band


def test_conchoid_linkage():
    """E17: three pieces of the conchoid, against the lines that belong to them."""
    for start, end, band, length, direction in (
        (66.25, 100.75, 0.09885786797, 16.797010527, 130.81807283763575),
        (57.25, 120.75, 0.4977666221, 29.240327460, 132.0407538768386),
        (51.5, 138.75, 0.9939175008, 37.480926940, 133.29337555286986),
    ):
        found = path_piece(CONCHOID, *np.radians([start, end]), direction=np.radians(direction))
        assert abs(found.length - length) < 1e-9
        assert abs(found.band - band) < 2e-5  # the figures are extremes of samples
        assert path_piece(CONCHOID, *np.radians([start, end])).band <= found.band + 1e-6
        longest = longest_piece(CONCHOID, 0, 2 * math.pi, band + 1e-9, samples=721)
        assert longest.length > found.length - 0.2


def test_an_exact_line():
    """Slider-crank a = b: the point opposite to the slider moves on the y axis."""
    exact = coupler_path(SliderCrank(3, 3), -3, 0)
    found = path_piece(exact, 0.2, 1.4)
    assert found.band < 1e-14
    assert abs(found.length - 6 * (math.sin(1.4) - math.sin(0.2))) < 1e-12
    assert abs(found.direction - math.pi / 2) < 1e-12
    assert longest_piece(exact, 0.2, 1.4, 1e-9, samples=50).length == pytest.approx(found.length)


def test_oracle_every_window():
    """The longest piece, against all pairs of ends and many directions of the line."""
    samples, band = 41, 1.0
    parameters = np.linspace(0.3, 3.5, samples)
    points = CONCHOID(parameters)
    best = 0.0
    for angle in np.linspace(0, math.pi, 1801):
        seen = points * np.exp(-1j * angle)
        for i in range(samples):
            across = np.maximum.accumulate(seen.imag[i:]) - np.minimum.accumulate(seen.imag[i:])
            last = i + int(np.searchsorted(across, band, side="right")) - 1
            best = max(best, float(np.ptp(seen.real[i : last + 1])))
    found = longest_piece(CONCHOID, 0.3, 3.5, band, samples=samples)
    assert found.band <= band
    assert found.length == pytest.approx(best, rel=1e-3)


def test_any_linkage_by_moving_it():
    linkage = FourBar(20, 50, 50, 40).linkage({"C": (100, 0)})
    values = np.linspace(1.5, 4.5, 40).reshape(2, 20)
    assert np.allclose(linkage_path(linkage, "C", branch="+")(values), LAMBDA(values))
    with pytest.raises(LinkageError):
        path_piece(linkage_path(FourBar(30, 20, 20, 60).linkage({"C": (5, 5)}), "C"), 0.0, 3.0)


def test_an_ordinary_point():
    """Where the path bends, a window of the wanted ratio is small and still has it."""
    for ratio in (1e-2, 1e-3, 1e-4):
        found = piece_of_ratio(CONCHOID, 3.0, ratio)
        assert math.isclose(found.ratio, ratio, rel_tol=1e-5)


def test_a_mirrored_path_is_as_straight():
    def mirrored(phi):
        return np.conj(LENKER(phi)) * np.exp(0.4j) + 3

    found, other = (piece_of_ratio(path, math.pi, 0.003) for path in (LENKER, mirrored))
    assert other.length == pytest.approx(found.length, rel=1e-9)
    assert other.band == pytest.approx(found.band, rel=1e-8)


def test_what_cannot_be():
    assert piece_of_ratio(coupler_path(SliderCrank(3, 3), -3, 0), 0.8, 0.01, widest=1.0) is None
    with pytest.raises(LinkageError, match="no point at the parameter"):
        path_piece(coupler_path(FourBar(60, 30, 30, 70), 5, 5), 0, 3)
    with pytest.raises(LinkageError, match="ratio must be positive"):
        piece_of_ratio(LENKER, math.pi, 0)
    with pytest.raises(LinkageError, match="bends too much for a relative deviation of 1e-12"):
        piece_of_ratio(CONCHOID, 3.0, 1e-12)
    with pytest.raises(LinkageError, match="one point for each parameter"):
        path_piece(lambda at: at[:2], 0, 1)
    with pytest.raises(LinkageError, match="band must be positive"):
        longest_piece(LENKER, 0, 1, -1)
    with pytest.raises(LinkageError, match="samples must be a whole number"):
        path_piece(LENKER, 0, 1, samples=2)
    with pytest.raises(LinkageError, match="start must be a finite number"):
        path_piece(LENKER, math.nan, 1)


def test_watt_guide_of_the_documents():
    """000/003, exercise 18: rockers 60, coupler 30; within 0.25 to either side F goes from -22.2532 to 22.2545."""
    right, left = (60.0, -15.0), (-60.0, 15.0)
    watt = Linkage.from_drawing(
        Mechanism.parse("R(frame-one) R(one-rod) R(rod-other) R(frame-other); drive=R(frame-one)"),
        {0: left, 1: (0, 15), 2: (0, -15), 3: right},
        points={"F": ("rod", 0.0, 0.0)},
    )
    path = linkage_path(watt, "F")
    points = path(np.radians([-22.414108945517206, -16.042818263663154, 15.699043586584697, 21.130683484424303]))
    ends = [-22.253292093906737, -16.405994505526888, 16.410609544792827, 22.25451920969765]
    assert points.imag == pytest.approx(ends)
    assert abs(points.real) == pytest.approx([0.25, 0.05, 0.05, 0.25], rel=0.005)  # by samples, just inside


def test_crane_guide_of_the_documents():
    """000/003, exercise 19 as it can be read (its figure is lost): C rises by 36.23 mm for phi from 10 to 30.

    The figures of C are those of its table; of the band it is said that it is 0.3308 mm, which is that of few samples.
    """
    frame = math.radians(-47)
    path = coupler_path(FourBar(100, 30, 80, 60), -30, 0)
    seen = path(np.radians([10, 20, 30]) - frame) * np.exp(1j * frame)
    assert seen.real == pytest.approx([84.071616, 84.313472, 84.250006], abs=1e-6)
    assert seen.imag == pytest.approx([43.677859, 62.605636, 79.907617], abs=1e-6)
    found = path_piece(path, math.radians(10) - frame, math.radians(30) - frame, direction=math.pi / 2 - frame)
    fine = path(np.radians(np.linspace(10, 30, 20001)) - frame) * np.exp(1j * frame)
    assert round(found.length, 2) == 36.23
    assert found.length == pytest.approx(np.ptp(fine.imag))
    assert found.band == pytest.approx(np.ptp(fine.real))


@pytest.mark.parametrize(
    ("bar", "point", "branch", "middle", "ends", "height"),
    [  # 000/003, section 3.5.4: Chebyshev's 4 : 5 : 5 : 2 and Roberts's frame 2, coupler 1, legs 1; the widest height
        (FourBar(5, 2, 5, 4), (1, 0), "-", 2, (1.37516174991033, 2.6241191173403196), 4.004996748207649),
        (
            FourBar(1, 1, 1, 2),
            (0.5, -(0.75**0.5)),
            "+",
            1,
            (1.3338547011032014, 0.6665918352267932),
            -0.009998991355327336,
        ),
    ],
)
def test_chebyshev_and_roberts(bar, point, branch, middle, ends, height):
    """The path leaves its line by the band where the tables end; it is symmetric to the middle of the frame."""
    path = coupler_path(bar, *point, branch=branch)

    def at(x):
        return brentq(lambda phi: float((path(np.array([phi])) - x).real[0]), 0.7, 1.25)

    heights = path(np.array([at(ends[0]), at(2 * middle - ends[0])])).imag
    assert heights == pytest.approx([height, height], abs=1e-9)
    found = path_piece(path, at(ends[0]), at(ends[1]), direction=0.0)
    assert found.length == pytest.approx(abs(ends[0] - ends[1]))
    assert found.band == pytest.approx(abs(height - round(height)), rel=1e-6)


def test_a_piece_has_two_ends():
    with pytest.raises(LinkageError, match="two different ends"):
        path_piece(LAMBDA, 1.5, 1.5)


def test_windows_about_a_tangent_are_those_of_the_table():
    """Q_G and L of all windows of a linkage that is moved, against windows found one by one."""
    linkage = FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4).linkage({"K": (8.018753738744802, 2.268046058132576)})
    curve = tangent_windows(linkage, "K", math.pi)
    widths, lengths = (
        np.interp(np.log([row[0] for row in QG_TABLE[1:]]), np.log(curve.ratios), values)
        for values in (np.degrees(curve.widths), curve.lengths / crank_length(linkage))
    )
    assert curve.ratios[0] < 1.1e-6
    assert 0.0199 < curve.ratios[-1] <= 0.02
    assert widths == pytest.approx([row[1] for row in QG_TABLE[1:]], abs=0.02)
    assert lengths == pytest.approx([row[3] for row in QG_TABLE[1:]], abs=1e-3)
    with pytest.raises(LinkageError, match="no windows with Q_G"):
        tangent_windows(linkage, "R(frame-crank)", math.pi)
