"""Six-bars whose output rests: fitted circles by hand, designs against poses by intersecting circles in plain numpy."""

import re

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, DwellTask, synthesise, synthesise_dwells, synthesise_structures
from gruebler.design.synthesis.dwell_search import circles_through
from gruebler.files.tasks import read_task, task_from_json, task_to_json
from gruebler.structure.mechanism import Mechanism

REST, SWING = np.radians(90), np.radians(30)


@pytest.fixture(scope="module")
def rockers():
    return synthesise_dwells(DwellTask(dwell=REST, swing=SWING), number=3)


@pytest.fixture(scope="module")
def sliders():
    return synthesise(DwellTask(dwell=np.radians(120), stroke=50), number=1)


def met(centre, radius, other, reach, side):
    """The intersection of two circles to the left (1) or right (-1) of the way from the first centre."""
    gap = other - centre
    along = (radius**2 - reach**2 + np.abs(gap) ** 2) / (2 * np.abs(gap))
    return centre + gap / np.abs(gap) * (along + side * 1j * np.sqrt(radius**2 - along**2))


def side_of(point, start, end):
    return np.sign((np.conj(end - start) * (point - start)).imag)


def poses(design, phi, rod=1.0):
    """The angle of the output (of a slide: its travel), its rod longer by a factor, from the joints as drawn.

    Written without the library's solver and without the search: circles and lines in plain numpy.
    """
    linkage = design.linkage

    def place(name, link):
        number = linkage.mechanism.chain.find_joint(name)
        e = linkage.elements[number, link]
        return complex(*linkage.required_pose[link].put(e.x, e.y)), e

    names = ("R(frame-crank)", "R(crank-coupler)", "R(coupler-rocker)", "R(rocker-frame)")
    links = ("frame", "crank", "coupler", "frame")
    a0, a, b, b0 = (place(name, link)[0] for name, link in zip(names, links, strict=True))
    p, q = place("R(coupler-rod)", "coupler")[0], place("R(rod-output)", "output")[0]
    crank = a0 + (a - a0) * np.exp(1j * (phi - phi[0]))
    rocker = met(crank, abs(b - a), b0, abs(b - b0), side_of(b, a, b0))
    point = crank + (rocker - crank) * (p - a) / (b - a)
    if linkage.mechanism.chain.find_joint("R(output-frame)") is not None:
        pivot = place("R(output-frame)", "frame")[0]
        pin = met(point, rod * abs(q - p), pivot, abs(q - pivot), side_of(q, p, pivot))
        return np.unwrap(np.angle(pin - pivot))
    along = np.exp(1j * place("P(output-frame)", "frame")[1].direction)
    seen, rest = np.conj(along) * (point - q), np.conj(along) * (q - p)
    return seen.real + np.sign(rest.real) * np.sqrt(abs(q - p) ** 2 - seen.imag**2)


@pytest.mark.parametrize("places", [4, 9, 30])
def test_circles_through_points_of_a_circle(places):
    """Of a circle about 3 - 2j with radius 5 by hand; one point moved out makes a deviation everywhere it is seen."""
    z = 3 - 2j + 5 * np.exp(2j * np.pi * np.arange(36) / 36)
    centres, radii, misses = circles_through(z[None], places)
    assert np.abs(centres - (3 - 2j)).max() < 1e-9
    assert np.abs(radii - 5).max() < 1e-9
    assert misses.max() < 1e-6
    z[10] = 3 - 2j + 5.5 * np.exp(2j * np.pi * 10 / 36)
    seen = np.array([10 in [(k + j) % 36 for j in range(places)] for k in range(36)])
    misses = circles_through(z[None], places)[2][0]
    assert misses[~seen].max(initial=0) < 1e-6
    assert misses[seen].min() > 1e-3


def test_fitted_circles_are_those_of_a_linear_system():
    """Kåsa's circle solves x^2 + y^2 = 2 u x + 2 v y + w by least squares: numpy's lstsq for each arc."""
    rng = np.random.default_rng(1)
    t = 2 * np.pi * np.arange(24) / 24
    z = np.exp(1j * t) + 0.3 * np.exp(2j * t + 1) + 0.05 * rng.normal(size=24)
    centres, radii, _ = (part[0] for part in circles_through(z[None], 7))
    for k in range(24):
        arc = np.roll(z, -k)[:7]
        rows = np.column_stack([2 * arc.real, 2 * arc.imag, np.ones(7)])
        u, v, w = np.linalg.lstsq(rows, np.abs(arc) ** 2, rcond=None)[0]
        assert abs(centres[k] - complex(u, v)) < 1e-9 * (1 + abs(complex(u, v)))
        assert radii[k] == pytest.approx(np.sqrt(w + u * u + v * v), rel=1e-9)


def test_the_output_rests_and_swings_as_wanted(rockers):
    assert len(rockers.designs) == 3
    for design in rockers.designs:
        start = design.drives[0]
        resting = poses(design, np.linspace(start, start + REST, 2001))
        turning = poses(design, np.linspace(start, start + 2 * np.pi, 20001))
        assert np.ptp(turning) == pytest.approx(SWING, abs=1e-7)
        assert np.ptp(resting) / 2 == pytest.approx(design.verdict.error * SWING, rel=1e-4)
        assert design.verdict.error < 5e-4


def test_the_figures_of_the_theory_page(rockers):
    """It says 0.0012 degrees for the best, and 0.0018 with a transmission angle of 42 degrees for another."""
    degrees = [(30 * design.verdict.error, np.degrees(design.verdict.transmission)) for design in rockers.designs]
    assert degrees[0][0] < 0.00125
    assert min(angle for _, angle in degrees) > 30
    assert any(error < 0.00185 and angle > 42 for error, angle in degrees)


def test_a_demanded_transmission_angle_is_kept():
    demands = Demands(transmission=np.radians(50))
    found = synthesise_dwells(DwellTask(dwell=REST, swing=SWING), demands, number=1)
    assert found.designs[0].verdict.transmission > np.radians(50)


def test_a_slider_rests_with_the_stroke_of_the_task(sliders):
    assert len(sliders.designs) == 1
    for design in sliders.designs:
        start = design.drives[0]
        resting = poses(design, np.linspace(start, start + np.radians(120), 2001))
        turning = poses(design, np.linspace(start, start + 2 * np.pi, 20001))
        assert np.ptp(turning) == pytest.approx(50, rel=1e-7)
        assert np.ptp(resting) / 2 == pytest.approx(design.verdict.error * 50, rel=1e-4)
        assert design.verdict.error < 1e-3


def test_deviations_alternate(rockers):
    """Where the largest deviation is least both bounds are reached, one of them on both sides of the other."""
    design = rockers.designs[0]
    values = poses(design, np.linspace(design.drives[0], design.drives[-1], 2001))
    off = values - (values.max() + values.min()) / 2
    reached = np.sign(off[np.abs(off) > 0.9 * np.abs(off).max()])
    assert 1 + np.count_nonzero(np.diff(reached)) >= 3


def test_a_wrong_length_moves_the_rest_as_its_sensitivity_says(rockers):
    """The rod longer by 0.1 %: how the output moves in the middle of the rest, by hand and as foretold."""
    design = rockers.designs[0]
    found = design.sensitivity
    assert found is not None
    (k,) = (k for k, length in enumerate(found.lengths) if length.link == "rod")
    way = np.linspace(design.drives[0], design.drives[1], 101)
    moved = poses(design, way, rod=1.001)[-1] - poses(design, way)[-1]
    assert abs(moved) == pytest.approx(abs(found.moves[1, 0, k]), rel=0.01)


def test_a_long_rest_is_less_exact_and_says_so():
    found = synthesise_dwells(DwellTask(dwell=np.radians(240), swing=SWING), Demands(tolerance=1e-6), number=1)
    assert not found.designs
    assert "strays from its rest" in found.explain()


def test_no_tolerance_is_taken_at_its_word():
    found = synthesise_dwells(DwellTask(dwell=REST, swing=SWING), Demands(tolerance=0), number=1)
    assert not found.designs
    assert "strays from its rest" in found.explain()


def test_a_swing_that_no_output_has_is_told():
    """An output of at most ten cranks swings by more than some tenths of a degree where the crank turns."""
    found = synthesise_dwells(DwellTask(dwell=np.radians(20), swing=np.radians(0.3)), number=1)
    assert not found.designs
    assert "No output that was tried swings by about 0.3°" in found.explain()


@pytest.mark.parametrize(
    ("values", "wrong"),
    [
        ({"dwell": 1.0}, "expected exactly one of swing and stroke, but found none"),
        ({"dwell": 1.0, "swing": 1.0, "stroke": 3.0}, "but found swing and stroke"),
        ({"dwell": 0.0, "swing": 1.0}, "dwell: expected an angle between 0 and 300 degrees, but found 0 degrees"),
        ({"dwell": 6.0, "swing": 1.0}, "dwell: expected an angle between 0 and 300 degrees, but found 343.775 degrees"),
        ({"dwell": 1.0, "stroke": -1.0}, "stroke: expected a positive length, but found -1"),
        ({"dwell": "x", "stroke": 1.0}, "dwell: expected a number, but found 'x'"),
    ],
)
def test_tasks_that_contradict_themselves(values, wrong):
    with pytest.raises(SynthesisError, match=re.escape(wrong)):
        DwellTask(**values)


def test_places_lengths_and_structures_are_refused():
    task = DwellTask(dwell=REST, swing=SWING)
    with pytest.raises(SynthesisError, match="region: a rest is designed without"):
        synthesise_dwells(task, Demands(region=(0, 0, 1, 1)))
    with pytest.raises(SynthesisError, match="lengths: a rest is designed without"):
        synthesise_dwells(task, Demands(lengths=(("crank", 1.0),)))
    watt = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(3-4) R(4-5) R(5-0); frame=0; drive=R(0-1)")
    with pytest.raises(SynthesisError, match="a rest is made by a rod on a coupler curve, not by given structures"):
        synthesise_structures(task, [watt])


@pytest.mark.parametrize("name", ["rest.toml", "rest.json", "rest.csv"])
def test_files_bring_a_task_back(tmp_path, name):
    from gruebler.files.tasks import write_task

    task = DwellTask(dwell=REST, swing=SWING)
    write_task(tmp_path / name, task)
    assert read_task(tmp_path / name) == task
    assert task_from_json(task_to_json(DwellTask(dwell=1.5, stroke=40))) == DwellTask(dwell=1.5, stroke=40)
