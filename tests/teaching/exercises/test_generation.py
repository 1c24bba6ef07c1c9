"""Fresh tasks: the same id gives the same task, every task is solved, and marking finds what went wrong."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import GrueblerError
from gruebler.base.text import Readable
from gruebler.structure.chain import Chain
from gruebler.structure.mobility import counted, generic_mobility
from gruebler.teaching.exercises import (
    KINDS,
    LEVELS,
    Mark,
    ascii_key,
    exercise,
    generate,
    grade,
    solution_text,
    solve,
    task_text,
)
from gruebler.teaching.exercises.generation import is_generated
from gruebler.teaching.exercises.solution import formula_number

TASKS = st.builds(generate, st.sampled_from(list(KINDS)), st.integers(0, 999), st.sampled_from(LEVELS))


@settings(max_examples=30)
@given(task=TASKS)
def test_every_fresh_task_is_solved_by_both_ways(task):
    solution = solve(task)
    assert [str(check.text) for check in solution.checks if not check.holds] == []
    assert {asked.key for asked in task.asked} <= set(solution.results)
    for lang in ("en", "de"):
        assert solution_text(task, solution, lang)
        assert task_text(task, lang, solution)
    again = exercise(task.id)
    assert again == task
    assert is_generated(task.id)


@settings(max_examples=30)
@given(task=TASKS)
def test_right_answers_are_right_and_likely_mistakes_get_their_hint(task):
    solution = solve(task)
    right = {key: _written(result.value) for key, result in solution.results.items()}
    assert {one.mark for one in grade(task, right)} == {Mark.RIGHT}
    for mistake in solution.mistakes:
        value = solution[mistake.key]
        close = isinstance(value, float) and abs(mistake.value - value) <= 2e-3 * abs(value)
        if close or (isinstance(value, float) and not math.isfinite(mistake.value)):
            continue
        (one,) = grade(task, {mistake.key: _written(mistake.value)})
        assert one.mark is not Mark.RIGHT
        assert one.hint is not None


def _written(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Readable):
        return value.in_language("de")
    return formula_number(value) if isinstance(value, int | float) else value


def test_other_seeds_give_other_tasks():
    for kind in KINDS:
        for level in LEVELS:
            made, enough = set(), 2 if kind == "dyad" else 8
            for seed in range(12):
                made.add(str(sorted(generate(kind, seed, level).given.items())))
                if len(made) == enough:
                    break
            assert len(made) == enough


def test_fresh_chains_grow_with_the_level():
    kinds = []
    for level in LEVELS:
        found = [Chain.parse(generate("mobility", seed, level).given["chain"]) for seed in range(10)]
        assert all(generic_mobility(chain) == max(counted(chain), 0) for chain in found)
        kinds.append({joint.pair.name for chain in found for joint in chain.joints})
        assert all(bool(chain.multiple_joints) == (level > 1) for chain in found)
    assert kinds == [{"revolute"}, {"revolute", "prismatic"}, {"revolute", "prismatic", "roll_slide"}]


@pytest.mark.parametrize(
    ("id", "key", "answer", "words"),
    [
        ("exercise-6", "F", "3", "double joint"),
        ("exercise-6", "g1", "6", "double joint"),
        ("exercise-6", "n", "5", "frame is a link"),
        ("exercise-6", "F", "-2", "frame is a link"),
        ("exercise-6", "F", "4", "frame does not move"),
        ("exercise-5b", "F", "0", "takes away one motion"),
        ("example-3.4-four-bar", "mu_II*", "101,54", "at most 90"),
        ("example-3.4-four-bar", "mu_min", "143.13", "at most 90"),
        ("exercise-14", "μ_min", "90", "worse side"),
        ("exercise-15", "difference", "9.4", "2·Δφ"),
        ("exercise-15", "H", "70", "eccentric"),
        ("exercise-11", "phi_H2", "90", "half of the time"),
        ("exercise-11", "phi_H2", "1.3694", "radians"),
        ("exercise-11", "H", "4", "factor of 10"),
        ("exercise-15", "difference", "18.4", "the printed answer. Read off a drawing"),
        ("exercise-13", "mu_min2", "78.2", "the printed answer. Misprint"),
        ("exercise-21", "v_B", "248.66", "towards the crank"),
        ("velocity-2-4", "a_B", "-1583.85", "away from the crank: positive"),
        ("exercise-21", "v_B", "-246.74", "small λ"),
        ("exercise-21", "v_B", "-160.92", "negative where the rod falls"),  # -250 sin 37.99°/cos 17.01°
        ("exercise-21", "v_B", "-204.79", "endless rod"),  # -250 sin 55°
        ("exercise-8", "d_max", "110", "full turn"),
        ("exercise-3", "F_after", "-1", "two couplers"),
    ],
)
def test_hints(id, key, answer, words):
    (one,) = grade(exercise(id), {key: answer})
    assert one.mark is Mark.WRONG
    assert words in str(one.hint)


@pytest.mark.parametrize(
    ("answer", "worth"),
    [
        ("78.463", Mark.RIGHT),
        ("78,5", Mark.RIGHT),
        ("78.5°", Mark.RIGHT),
        ("78", Mark.RIGHT),
        ("78.2", Mark.NEAR),
        ("80", Mark.NEAR),
        ("90.1", Mark.WRONG),
        ("8e1", Mark.RIGHT),
        ("1e2", Mark.WRONG),
    ],
)
def test_digits_of_an_answer(answer, worth):
    assert grade(exercise("exercise-11"), {"φ_H2": answer})[0].mark is worth


def test_a_whole_result_is_not_met_nearly():
    """40° + 85° = 125°: no digits are lost on the way to 123."""
    assert grade(exercise("spherical-grashof-1-5"), {"sum_ends": "123"})[0].mark is Mark.WRONG


def test_words_as_answers():
    task = exercise("exercise-7")
    assert [m.mark for m in grade(task, {"turns": "ja", "type": "Kurbelschwinge"})] == [Mark.RIGHT, Mark.RIGHT]
    assert [m.mark for m in grade(task, {"turns": "No", "type": "double crank"})] == [Mark.WRONG, Mark.WRONG]
    assert grade(task, {"type": "crank rocker"})[0].mark is Mark.RIGHT


@pytest.mark.parametrize(
    ("answers", "words"),
    [
        ({"HH": "40"}, r"does not ask for 'HH' \(did you mean 'H'\?\)"),
        ({"H": "forty"}, "expected a number in mm, not forty"),
        ({"H": "nan"}, "expected a number"),
        ({"H": "inf"}, "expected a number"),
        ({"H": "1e9999"}, "expected a number"),
        ({"H": "0e9999"}, "expected a number"),
        ({"H": "40 kg"}, "expected a number in mm"),
        ({"H": "±40"}, "expected a number in mm"),
    ],
)
def test_wrong_calls(answers, words):
    with pytest.raises(GrueblerError, match=words):
        grade(exercise("exercise-11"), answers)


def test_wrong_kinds_and_seeds():
    for call, words in (
        (lambda: generate("gear", 1), "kinds of fresh tasks"),
        (lambda: generate("grashof", 1, 4), "level is 1, 2 or 3"),
        (lambda: generate("grashof", -1), "seed is a whole number"),
        (lambda: exercise("gear-1-1"), "there is no exercise"),
        (lambda: exercise("grashof-9-1"), "level is 1, 2 or 3"),
    ):
        with pytest.raises(GrueblerError, match=words):
            call()


def test_keys_on_every_keyboard():
    for kind in KINDS:
        keys = [ascii_key(key) for key in solve(generate(kind, 3, 3)).results]
        assert len(set(keys)) == len(keys)
        assert all(key.isascii() for key in keys)


@pytest.mark.parametrize(
    ("id", "key", "answer"),
    [
        ("dead-centre-1-7", "H", "60 mm"),
        ("dead-centre-1-7", "l_a", "13cm"),
        ("dead-centre-1-7", "l_a", "0.13 m"),
        ("15", "H", "7.2 cm"),
        ("15", "H", "7,2"),  # as it is printed
        ("15", "H", "71.7"),
        ("11", "phi_H2", "78,5°"),
        ("11", "phi_H2", "78.5 deg"),
        ("11", "phi_H2", "1.3694 rad"),
        ("11", "phi_H2", "-78.5"),
        ("11", "phi_H2", "± 78,5"),
        ("3.2.2-eccentric", "T_min", "0.0848 s"),
    ],
)
def test_answers_with_units(id, key, answer):
    assert grade(exercise(id), {key: answer})[0].mark is Mark.RIGHT


def test_a_unit_counts():
    assert grade(exercise("15"), {"H": "7.2 mm"})[0].mark is Mark.WRONG
    with pytest.raises(GrueblerError, match="without a unit"):
        grade(exercise("6"), {"F": "1 mm"})


def test_the_task_tells_the_unit():
    assert "(in mm)" in task_text(exercise("15"), "en", solve(exercise("15")))
    assert "(in °)" in task_text(exercise("11"), "de", solve(exercise("11")))


def test_of_a_table_one_place_is_asked():
    with pytest.raises(GrueblerError, match=r"exercise-16 does not ask for 'K'.*; it asks for K1_x, K1_y"):
        grade(exercise("16"), {"K": "1"})


def test_counts_get_no_hints_for_lengths():
    (one,) = grade(exercise("6"), {"F": "2"})
    assert (one.mark, one.hint) == (Mark.WRONG, None)


@pytest.mark.parametrize("seed", [27, 28, 35])
def test_strokes_that_are_nearly_twice_the_crank_are_not_asked(seed):
    task = generate("dead-centre", seed, 2)
    assert grade(task, {"H": formula_number(2 * task.given["a"])})[0].mark is not Mark.RIGHT


def test_dyads_are_of_many_kinds():
    made = [generate("dyad", seed, level) for seed in range(15) for level in LEVELS]
    assert len({str(sorted(task.given.items())) for task in made}) > 30
    assert {task.given.get("form") for task in made} == {None, "RRR", "RPR", "RRP"}
    for task in made[:9]:
        assert all(check.holds for check in solve(task).checks)


def test_some_four_bars_are_change_points():
    kinds = {
        solve(generate("grashof", seed, 1))["sum_ends"] == solve(generate("grashof", seed, 1))["sum_others"]
        for seed in range(20)
    }
    assert kinds == {True, False}


def test_the_inner_dead_centre_is_told_only_where_it_may_be_meant():
    assert "v_B_i" not in solve(generate("velocity", 1, 1)).results
    assert "v_B_i" in solve(exercise("21")).results
