"""Answers are given by the keys of the results or by the symbols that the solutions print."""

from collections import Counter
from dataclasses import replace

import pytest

from gruebler import GrueblerError
from gruebler.teaching.exercises import Mark, all_exercises, generate, grade, solve
from gruebler.teaching.exercises.generation import KINDS

GENERATED = [(kind, seed, level) for kind in KINDS for level in (1, 2, 3) for seed in (1, 2)]


@pytest.mark.parametrize("source", [*all_exercises(), *GENERATED], ids=str)
def test_answers_are_taken_by_the_printed_symbols(source):
    """Every number that a solution prints as ``symbol = number`` is taken back by that symbol, as by its key."""
    task = all_exercises()[source] if isinstance(source, str) else generate(*source)
    solution = solve(task)
    symbols = Counter(result.symbol for result in solution.results.values())
    numbers = {key: one for key, one in solution.results.items() if type(one.value) in (int, float)}
    assert solution.results
    for key, result in numbers.items():
        answer = repr(result.value)
        (by_key,) = grade(task, {key: answer})
        assert (by_key.key, by_key.mark) == (key, Mark.RIGHT)
        if symbols[result.symbol] == 1:
            (by_symbol,) = grade(task, {result.symbol: answer})
            assert replace(by_symbol, name=key) == by_key
            assert by_symbol.name == result.symbol
            assert by_symbol.name == result.symbol
            assert replace(by_symbol, name=key) == by_key
        elif result.symbol not in solution.results:
            with pytest.raises(GrueblerError, match=r"stands for several results") as caught:
                grade(task, {result.symbol: answer})
            assert key in str(caught.value)


def test_the_ratio_of_times_by_its_symbol():
    task = generate("dead-centre", 3, 2)
    assert [one.mark for one in grade(task, {"H": "43,2456", "k": "1,3007"})] == [Mark.RIGHT, Mark.RIGHT]
    with pytest.raises(GrueblerError, match=r"k is answered twice"):
        grade(task, {"time_ratio": "1.3007", "k": "1.3007"})
    with pytest.raises(GrueblerError, match=r"it asks for H, phi_max, time_ratio \(k\)"):
        grade(task, {"j": "1"})
