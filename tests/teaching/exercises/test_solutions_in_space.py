"""Exercises in space: values worked out by hand and from print, hints, figures."""

import math

import pytest

from gruebler.base.errors import LinkageError
from gruebler.pictures.canvas.shapes import TextShape
from gruebler.teaching.exercises import Mark, exercise, generate, grade, solve
from gruebler.teaching.exercises.grading import common_mistakes
from gruebler.teaching.exercises.in_space import (
    differential,
    differential_in_a_curve,
    spherical_grashof,
    universal_joint,
)
from gruebler.teaching.worksheets.tasks import exercise_figure


def test_a_universal_joint_at_thirty_degrees():
    solution = universal_joint(30, 1000, phi=45)
    assert solution.number("n_min") == pytest.approx(500 * math.sqrt(3))
    assert solution.number("n_max") == pytest.approx(2000 / math.sqrt(3))
    assert solution.number("U") == pytest.approx(0.5 / math.sqrt(3))  # sin 30 tan 30 degrees
    assert math.tan(math.radians(solution.number("ψ"))) == pytest.approx(2 / math.sqrt(3))
    # n cos β/(1 - sin² β cos² φ) = 1000 (√3/2)/(1 - 1/8)
    assert solution.number("n_2") == pytest.approx(1000 * math.sqrt(3) / 2 * 8 / 7)
    assert all(check.holds for check in solution.checks)


@pytest.mark.parametrize(
    ("arcs", "kind"),
    [
        ((30, 80, 60, 70), "crank-rocker"),
        ((70, 80, 60, 30), "double crank"),
        ((150, 100, 120, 110), "crank-rocker"),  # the supplements of the first: the same machine, other ends of axes
    ],
)
def test_types_on_the_sphere(arcs, kind):
    solution = spherical_grashof(*arcs)
    assert solution["type"].in_language("en").startswith(kind)
    assert all(check.holds for check in solution.checks)


def test_supplements_swing_alike():
    one, other = spherical_grashof(30, 80, 60, 70), spherical_grashof(150, 100, 120, 110)
    assert one.number("sum_ends") == other.number("sum_ends") == 110
    assert one.number("ψ_H") == pytest.approx(other.number("ψ_H"))
    assert one.number("μ_min") == pytest.approx(other.number("μ_min"))


def test_a_car_in_a_curve():
    """10 m/s on wheels of 0.6 m: 10/(0.6 π) turns a second; the circles are 9.25 and 10.75 m wide for one of 10."""
    solution = differential_in_a_curve(36, 600, 10, 1.5)
    turns = 600 / (0.6 * math.pi)
    assert solution.number("n_C") == pytest.approx(turns)
    assert solution.number("n_1") == pytest.approx(0.925 * turns)
    assert solution.number("n_2") == pytest.approx(1.075 * turns)
    assert solution.results["n_2"].name.in_language("en") == "speed of the outer wheel"


def test_one_wheel_stands():
    solution = differential(100, 0, 16, 10)
    assert (solution.number("n_2"), solution.number("n_p")) == (200, 160)
    assert "n_p" not in differential(100, 0).results


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: universal_joint(30, 100, phi=90), "between 0 and 90"),
        (lambda: spherical_grashof(10, 10, 10, 80), "cannot be assembled"),
        (lambda: differential_in_a_curve(10, 600, 0.5, 1.5), "half the track"),
    ],
)
def test_what_is_no_task(call, words):
    with pytest.raises(LinkageError, match=words):
        call()


@pytest.mark.parametrize(
    ("id", "key", "value", "words"),
    [
        ("universal-joint-1-7", "n_min", "n_1", "does not turn evenly"),
        ("differential-1-7", "n_2", "n_C", "only while they turn alike"),
    ],
)
def test_hints_in_space(id, key, value, words):
    task = exercise(id)
    given = {"n_1": task.given.get("n"), "n_C": task.given.get("n_C")}[value]
    (one,) = grade(task, {key: str(given)})
    assert one.mark is Mark.WRONG
    assert words in str(one.hint)


@pytest.mark.parametrize("kind", ["universal-joint", "spherical-grashof", "differential"])
def test_fresh_tasks_in_space_have_figures(kind):
    for level in (1, 2, 3):
        task = generate(kind, 5, level)
        assert exercise_figure(task, "de").shapes
    arcs = [sum(generate("spherical-grashof", seed, 2).given[key] for key in "abcd") for seed in range(5)]
    assert min(arcs) > 360
    assert all(check.holds for check in solve(generate(kind, 6, 3)).checks)


@pytest.mark.parametrize("level", [1, 2, 3])
def test_a_differential_is_named_as_its_speeds_are(level):
    """The task asks for n_1, n_2, n_C and, with teeth, for the planets' n_p; no other number stands in its figure."""
    task = generate("differential", 3, level)
    named = [shape.text for shape in exercise_figure(task).shapes if isinstance(shape, TextShape)]
    assert sorted({*named}) == ["1", "2", "C", "p"]
    indices = {key.removeprefix("n_") for key in (*task.given, *(one.key for one in task.asked)) if key[:2] == "n_"}
    assert indices <= {*named}


def test_mistakes_of_a_sum_beyond_a_turn_are_numbers():
    """More than 360 degrees have no sine that a learner could have mistaken for them; the site writes all mistakes."""
    total = solve(generate("spherical-grashof", 0, 2)).number("total")
    assert total > 360
    result = solve(generate("spherical-grashof", 0, 2)).results["total"]
    values = [mistake.value for mistake in common_mistakes(result)]
    assert 180 - total in values
    assert all(map(math.isfinite, values))
