"""Proofs for four positions: enclosures against dyads found otherwise, bounds against samples and known designs."""

from dataclasses import replace

import numpy as np
import pytest

from gruebler.design.synthesis import Demands, PositionTask, synthesise_positions
from gruebler.design.synthesis.burmester import burmester_curves
from gruebler.design.synthesis.dyad_cells import FAR, DyadCells, DyadCurve, short_cells
from gruebler.design.synthesis.dyad_families import guiding_dyads
from gruebler.design.synthesis.dyads import SLIDER, Displacements
from gruebler.design.synthesis.enclosures import Enclosure
from gruebler.design.synthesis.family_bounds import bound_notes, excluded
from gruebler.design.synthesis.pair_facts import pair_facts
from gruebler.design.synthesis.partner_bounds import left_of_cranks

FOUR = [(2.071235, -0.032527, 19.8126), (2.036152, 1.429641, 44.4843), (0.706012, 1.606846, 68.1715)]
FOUR += [(0.329970, 2.223983, 92.2134)]
TASK = PositionTask([(x, y, np.radians(a)) for x, y, a in FOUR])


def _task(rng):
    """Four positions far apart, near to each other, or turned a little only, of any size and anywhere."""
    z, angles = rng.normal(size=(4, 2)), np.cumsum(rng.uniform(10, 60, 4)) * rng.choice([-1, 1])
    match rng.integers(4):
        case 0:
            angles = rng.uniform(-180, 180, 4)
        case 1:
            z, angles = np.cumsum(rng.uniform(0.1, 0.5, (4, 2)), axis=0), np.cumsum(rng.uniform(3, 20, 4))
        case 2:
            angles = np.array([0, 1e-3, 2e-3, 30]) * rng.uniform(1, 3)
    places = z * 10.0 ** rng.integers(-3, 4) + 5 * rng.normal()
    return PositionTask([(x, y, np.radians(a)) for (x, y), a in zip(places, angles, strict=True)])


def _dyads_on_lines(given, rng, lines):
    """Pivots whose four places lie on a circle, on random lines of the body, with the circle's centre.

    The circle is the determinant of |z|², x, y, 1: along a line a polynomial of degree three (of degree five by its
    terms, of which two vanish), so that no part of Burmester's curve is followed.
    """
    for _ in range(lines):
        start, turn = complex(*rng.normal(size=2)) * 3, np.exp(1j * rng.uniform(0, np.pi))
        at = 4 * np.cos(np.pi * (np.arange(8) + 0.5) / 8)
        places = np.array([given.images(complex(start + s * turn)) for s in at])
        rows = np.stack([np.abs(places) ** 2, places.real, places.imag, np.ones_like(places.real)], axis=2)
        for s in np.polynomial.Polynomial.fit(at, np.linalg.det(rows), 3).roots():
            if abs(s.imag) > 1e-9:
                continue
            x = complex(start + s.real * turn)
            z = given.images(x)
            matrix = np.stack([z.real, z.imag, np.ones(4)], axis=1)
            (u, v, _), *_ = np.linalg.lstsq(2 * matrix, np.abs(z) ** 2, rcond=None)
            if max(abs(x), abs(complex(u, v))) < FAR:
                yield x, complex(u, v)


def _held(cells, x, m):
    """Whether some cell holds the dyad: one parameter for both pivots."""
    low, high = np.full(len(cells.cells), -1.0), np.ones(len(cells.cells))
    for pivot, seen in ((x, cells.moving), (m, cells.fixed)):
        (slope,) = seen.slopes
        rest = seen.rest + 1e-9 * (1 + abs(pivot))  # how well the dyad itself is known
        with np.errstate(divide="ignore", invalid="ignore"):
            at, reach = (pivot - seen.value) / slope, rest / np.abs(slope)
            half = np.sqrt(reach**2 - at.imag**2)
        low, high = np.maximum(low, at.real - half), np.minimum(high, at.real + half)
    return bool((low <= high).any())  # NaN: no


def _all_held(seed, lines):
    rng = np.random.default_rng(seed)
    given, *_ = Displacements.of((task := _task(rng)).origins, task.turns)
    curve = DyadCurve(given)
    cells, singular = short_cells(curve)
    assert curve.fits
    assert not len(singular)
    covers = [DyadCells(curve, cells)]
    for _ in range(3):
        covers[1:] = [DyadCells(curve, covers[-1].halves(np.ones(len(covers[-1].cells), bool)))]
    dyads = list(_dyads_on_lines(given, rng, lines))
    for cover in covers:
        assert all(_held(cover, x, m) for x, m in dyads), seed
    return len(dyads)


def test_cells_hold_all_dyads_that_lines_of_the_body_meet():
    assert sum(_all_held(seed, 30) for seed in range(6)) > 150


@pytest.mark.slow
def test_cells_hold_ten_thousand_dyads():
    assert sum(_all_held(seed, 500) for seed in range(100, 120)) > 10_000


def test_enclosures_hold_what_they_compute():
    rng = np.random.default_rng(5)
    count = 4000
    z = rng.normal(size=(4, count)) + 1j * rng.normal(size=(4, count))
    wide = 10.0 ** rng.uniform(-3, 0, count)
    first = Enclosure(z[0], (wide * z[1], np.zeros(count)), 0.1 * wide)
    second = Enclosure(z[2], (np.zeros(count), wide * z[3]), 0.1 * wide)

    def centre(enclosure, parameters):
        return enclosure.value + enclosure.slopes[0] * parameters[0] + enclosure.slopes[1] * parameters[1]

    positive = (first * first.conjugate).real
    ways = [
        (first * second, lambda a, b: a * b),
        (first.conjugate - 2 * second, lambda a, b: np.conj(a) - 2 * b),
        (first * second.inverse, lambda a, b: a / b),
        (first.modulus, lambda a, _: np.abs(a)),
        (positive.root, lambda a, _: np.abs(a)),
        (positive.mapped(np.sin(positive.value), np.cos(positive.value), 1.0), lambda a, _: np.sin(np.abs(a) ** 2)),
        (2 - first.imaginary, lambda a, _: 2 - a.imag),
    ]
    known = np.zeros(len(ways), int)
    for _ in range(50):
        parameters = rng.choice([-1, 1, 0.3], (2, count)) * rng.uniform(0.5, 1, (2, 1))
        spots = rng.uniform(0, 1, (2, count)) * np.exp(1j * rng.uniform(0, 2 * np.pi, (2, count)))
        a, b = (centre(z, parameters) + spot * z.rest for z, spot in zip((first, second), spots, strict=True))
        for k, (enclosure, way) in enumerate(ways):
            off = np.abs(way(a, b) - centre(enclosure, parameters))
            assert (off <= enclosure.rest * (1 + 1e-12) + 1e-12).all(), k
            known[k] = np.isfinite(enclosure.rest).sum()
        turn = np.angle(a * np.exp(-1j * centre(first.angle, parameters)))
        assert (np.abs(turn) <= first.angle.rest + 1e-12).all()
    assert known.min() > count / 2


def test_the_family_of_the_example_has_no_better_angle_than_was_found():
    # The search finds 19.5 degrees, confirmed by motion; another program with 900 points of the curve 19.3.
    crank = Demands(crank=True)
    for angle, proved in ((25, True), (19.8, True), (19.4, False)):
        assert (excluded(TASK, replace(crank, transmission=np.radians(angle))).left == 0) == proved
    notes = [str(note) for note in synthesise_positions(TASK, crank).notes]
    assert any(note.startswith("Proved: no four-bar") and "above 19.6°" in note for note in notes), notes
    none = synthesise_positions(TASK, replace(crank, transmission=np.radians(25)))
    assert "Proved: no four-bar of this family with pivots within 30 sizes of the task meets all demands." in [
        str(note) for note in none.notes
    ]


WISHES = (Demands(), Demands(crank=True), Demands(size_ratio=4.0), Demands(crank=True, in_order=False))


def _never_below_a_sample(seed, count):
    task = _task(np.random.default_rng(seed))
    dyads = [dyad for dyad in guiding_dyads(task, count) if not dyad.slides]
    checked = 0
    for wish in WISHES:
        facts = pair_facts(task, dyads, dyads, wish)
        # In any order the way leads through all positions: the worst of them is a bound that the sample keeps.
        good = np.logical_and.reduce([flags for _, flags in facts.met(replace(wish, in_order=True))])
        best = float(facts.transmission[good].max(initial=0.0))
        if best > 1e-3:
            checked += 1
            assert excluded(task, replace(wish, transmission=best - 1e-4), 100_000).left > 0, (seed, wish)
    return checked


def test_nothing_is_excluded_that_a_dense_sample_finds():
    assert sum(_never_below_a_sample(seed, 200) for seed in range(5)) > 3


@pytest.mark.slow
def test_nothing_is_excluded_that_a_denser_sample_of_more_tasks_finds():
    assert sum(_never_below_a_sample(seed, 800) for seed in range(200, 240)) > 30


@pytest.mark.parametrize("seed", range(10))
def test_a_task_with_a_known_design_is_never_proved_empty(seed):
    rng = np.random.default_rng(seed)
    a, others = 0.0, np.zeros(3)
    while not 0 < a + others.max() < 0.95 * (others.sum() - others.max()):  # a crank that turns, after Grashof
        a, others = rng.uniform(0.3, 1), rng.uniform(1.1, 3, 3)
    b, c, d = others
    pin = a * np.exp(1j * np.sort(rng.uniform(0, 2 * np.pi, 4)))
    along = (b * b - c * c + np.abs(d - pin) ** 2) / (2 * np.abs(d - pin))  # where two circles meet
    coupler = (d - pin) / np.abs(d - pin) * (along + 1j * np.sqrt(b * b - along**2)) / b
    points = pin + complex(*rng.normal(size=2)) * coupler
    task = PositionTask([(p.real, p.imag, np.angle(turn)) for p, turn in zip(points, coupler, strict=True)])
    flattest = max(abs(b * b + c * c - (d - a) ** 2), abs(b * b + c * c - (d + a) ** 2)) / (2 * b * c)
    own = Demands(
        crank=True,
        transmission=float(np.arccos(flattest)) - 1e-6,
        size_ratio=others.max() / a + 1e-6,
        region=(-0.01, -0.01, d + 0.01, 0.01),
    )
    assert excluded(task, own).left > 0
    # A region beside the curve of the centres excludes all at once.
    centres = np.concatenate([piece.fixed for piece in burmester_curves(task, 2000).pieces])
    gaps = [
        (float(np.abs(centres - z).min()), z)
        for z in 3 * (rng.normal(size=200) + 1j * rng.normal(size=200)) + points[0]
    ]
    gap, z = max(gaps, key=lambda row: row[0])
    beside = (z.real - 0.1 * gap, z.imag - 0.1 * gap, z.real + 0.1 * gap, z.imag + 0.1 * gap)
    assert excluded(task, Demands(region=beside)).left == 0


def test_what_is_not_decided_is_told():
    left = excluded(TASK, Demands(crank=True, transmission=np.radians(19.3)), budget=80_000)
    assert 0 < left.left < 1e-3
    # The pair that is left as an example is a dyad each, in the coordinates of the task.
    given, origin, size = Displacements.of(TASK.origins, TASK.turns)
    for fixed, moving in (left.example[:2], left.example[2:]):
        lengths = np.abs(given.images((moving - origin) / size) - (fixed - origin) / size)
        assert np.ptp(lengths) < 1e-2 * lengths.max()
    notes = [str(note) for note in bound_notes(TASK, Demands(crank=True), None)]  # as if none had been found
    assert notes[0].startswith("Not decided: whether a four-bar of this family"), notes


def _slides_below_a_sample(seeds, count):
    """How often a sample of cranks beside a slide has a best angle; below it nothing may be excluded."""
    checked = 0
    for seed in seeds:
        task = _task(np.random.default_rng(seed))
        dyads = guiding_dyads(task, count)
        cranks = [dyad for dyad in dyads if not dyad.slides]
        for slide in [dyad for dyad in dyads if dyad.slides]:
            for wish in (*WISHES, Demands(in_order=False)):
                facts = pair_facts(task, cranks, [slide], wish)
                good = np.logical_and.reduce([flags for _, flags in facts.met(wish)])
                best = float(facts.transmission[good].max(initial=0.0))
                if best > 1e-3:
                    checked += 1
                    assert left_of_cranks(task, replace(wish, transmission=best - 1e-4), slide) > 0, (seed, wish)
    return checked


def test_no_crank_beside_a_slide_is_excluded_that_a_sample_finds():
    assert _slides_below_a_sample(range(12), 200) > 8


@pytest.mark.slow
def test_no_crank_beside_a_slide_is_excluded_that_a_denser_sample_of_more_tasks_finds():
    assert _slides_below_a_sample(range(40), 400) > 40


@pytest.mark.parametrize("seed", range(8))
def test_a_task_with_a_known_slider_crank_is_never_proved_empty(seed):
    """A slider-crank by hand: A on a circle about 0, B on the line y = e at the length b from A."""
    rng = np.random.default_rng(seed)
    a, e = rng.uniform(0.5, 1), rng.uniform(-0.4, 0.4)
    b = a + abs(e) + rng.uniform(0.3, 2)
    pin = a * np.exp(1j * np.sort(rng.uniform(0, 2 * np.pi, 4)))
    coupler = (np.sqrt(b * b - (e - pin.imag) ** 2) + 1j * (e - pin.imag)) / b
    points = pin + complex(*rng.normal(size=2)) * coupler
    task = PositionTask([(p.real, p.imag, np.angle(turn)) for p, turn in zip(points, coupler, strict=True)])
    own = Demands(crank=True, transmission=float(np.arccos((a + abs(e)) / b)) - 1e-6, region=(-0.1, -0.1, 0.1, 0.1))
    slides = [dyad for dyad in guiding_dyads(task, 200) if dyad.kind == SLIDER]
    assert max(left_of_cranks(task, own, slide) for slide in slides) > 0
    # No crank keeps nearly a right angle at all four positions.
    steep = replace(own, transmission=np.radians(89))
    assert not any(left_of_cranks(task, steep, slide) for slide in slides)
