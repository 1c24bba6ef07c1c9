"""The mutants of a text by hand, and those of a room: each compiles, and each is another text."""

from __future__ import annotations

import ast

import pytest

from tests.mutation.__main__ import ROOT, sources, to_run
from tests.mutation.mutants import mutants

TEXT = '''_NEAR = 0.25
_MOST = 4


def near(a, b):
    """1 < 2"""
    if a is b and a == b:
        return True
    return abs(a - b) < _NEAR
'''


def test_all_mutants_of_a_small_text():
    assert [(each.line, each.before, each.after) for each in mutants(TEXT)] == [
        (1, "0.25", "256.0"),
        (2, "4", "5"),
        (7, "a == b", "a != b"),
        (7, "a is b", "a is not b"),
        (7, "a is b and a == b", "a is b or a == b"),
        (8, "True", "False"),
        (9, "a - b", "a + b"),
        (9, "abs(a - b) < _NEAR", "None"),
        (9, "abs(a - b) < _NEAR", "abs(a - b) <= _NEAR"),
    ]
    assert "    return abs((a + b)) < _NEAR\n" in mutants(TEXT)[6].text


def test_the_mutants_of_a_room_are_other_programs():
    for path in sources("mobility"):
        text = (ROOT / path).read_text("utf-8")
        whole = ast.dump(ast.parse(text))
        for each in mutants(text)[::7]:
            assert ast.dump(ast.parse(each.text)) != whole
    assert len(mutants((ROOT / "src/gruebler/structure/mobility/circuits.py").read_text("utf-8"))) > 20
    assert to_run("mobility") == ["tests/structure/mobility", "src/gruebler/structure/mobility"]
    assert to_run("machines/geneva") == ["tests/machines/test_geneva.py", "src/gruebler/machines/geneva.py"]
    with pytest.raises(SystemExit, match="there is no room 'mobilty'"):
        to_run("mobilty")
