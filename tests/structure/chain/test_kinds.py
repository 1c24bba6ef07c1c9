"""Kinds of joints are rows: what a pair does is asked by properties, and no code compares names or letters of pairs."""

import ast
import re
from pathlib import Path

import pytest

import gruebler
from gruebler.mechanics.linkages.contacts import CONTACTS
from gruebler.pictures.canvas.symbols import SIGNS
from gruebler.pictures.space.symbols import SOLIDS
from gruebler.structure.chain.pairs import PAIRS
from gruebler.structure.chain.spaces import Freedom, Space
from gruebler.teaching.worksheets.joint_pictures import DRAWINGS

SOURCE = Path(gruebler.__file__).parent
NAMES = {pair.name for pair in PAIRS} | {pair.german for pair in PAIRS}
SYMBOLS = {symbol for pair in PAIRS for symbol in pair.symbols.values()}

# One further row for each pair, in the wings that need something of their own of it.
TABLES = {
    "structure/chain/pairs.py": "the table",
    "mechanics/linkages/contacts.py": "what lies on the links of a joint",
    "pictures/canvas/symbols.py": "signs of structure pictures",
    "pictures/space/symbols.py": "symbols in space",
    "teaching/worksheets/joint_pictures.py": "drawings in perspective",
}
ALLOWED = {
    "structure/assur/forms.py": "the names of the five dyads",
    "mechanics/kinematics/triads.py": "a theorem for each three legs, in letters",
    "files/pylinkage.py": "words of the format",
    "files/pyslvs.py": "words of the format",
    "structure/type_synthesis/selection.py": "how many of each pair are wanted, from the fields of `Requirements`",
    "structure/atlas/parts.py": "how many sliding pairs are wanted",
    "structure/atlas/chain_table.py": "the name of a column",
    "pictures/linkage/picture.py": "P and W are poles there",
    "teaching/catalog/feature_query.py": "the exchanges of type synthesis, a field of `Requirements` each",
    "teaching/exercises/generation.py": "the kinds that a generated exercise has, with their words in its text",
}
FREEDOMS = {*Freedom, "R", "T", "H", "RH", "TH"}
SPACES = {str(space) for space in Space}
FORM = re.compile("[RP]{2,}")
"""Joints in letters, such as RRR, whose meaning is what each of them does."""


def is_kind(node, *, letters=False):
    if not isinstance(node, ast.Constant) or not isinstance(node.value, str) or node.value in SPACES:
        return False
    return node.value in NAMES or (letters and node.value in SYMBOLS) or FORM.fullmatch(node.value) is not None


def made(node):
    """A pair by its name, as `pair("revolute")` makes it."""
    return isinstance(node, ast.Call) and getattr(node.func, "id", "") == "pair" and any(map(is_kind, node.args))


def questions(tree):
    """The lines that ask which pair it is: comparisons, and dictionaries, sets and cases of names."""
    for node in ast.walk(tree):
        match node:
            case ast.Compare():
                sides = [node.left, *node.comparators]
                members = [m for side in sides for m in (side.elts if hasattr(side, "elts") else [side])]
                texts = " ".join(ast.unparse(side) for side in sides)
                of_pairs = re.search(r"\b(pair|kind|symbol)", texts) is not None
                asks = any(is_kind(m, letters=of_pairs) or made(m) for m in members)
                if "direction" in texts or "freedom" in texts:
                    asks = asks or any(isinstance(m, ast.Constant) and m.value in FREEDOMS for m in members)
            case ast.Dict():
                keys = [key for key in node.keys if key is not None]
                asks = any(is_kind(key) or made(key) for key in keys)
                asks = asks or (len(keys) > 1 and all(is_kind(key, letters=True) for key in keys))
            case ast.Set():
                asks = any(is_kind(m) or made(m) for m in node.elts)
            case ast.Tuple() | ast.List():
                asks = sum(is_kind(m) for m in node.elts) > 1
            case ast.Subscript():
                asks = is_kind(node.slice)
            case ast.MatchValue():
                asks = is_kind(node.value)
            case ast.Call(func=ast.Attribute(attr="replace")):  # one symbol written over by another
                asks = any(is_kind(a) or ast.unparse(a).strip("'").removesuffix("(") in SYMBOLS for a in node.args)
            case ast.Call(func=ast.Attribute(attr="get" | "startswith", value=value)):
                starts = {a.value for a in node.args if isinstance(a, ast.Constant) and isinstance(a.value, str)}
                asks = any(map(is_kind, node.args)) or ("direction" in ast.unparse(value) and bool(starts & FREEDOMS))
            case _:
                asks = False
        if asks:
            yield node.lineno


def asking_files():
    found = {}
    for path in sorted(SOURCE.rglob("*.py")):
        lines = sorted(set(questions(ast.parse(path.read_text(encoding="utf-8")))))
        if lines:
            found[path.relative_to(SOURCE).as_posix()] = lines
    return found


def test_no_code_outside_the_tables_asks_which_pair_it_is():
    asking = asking_files()
    assert {name: lines for name, lines in asking.items() if name not in TABLES and name not in ALLOWED} == {}
    assert {name for name in ALLOWED if name not in asking} == set()


@pytest.mark.parametrize(
    "code",
    [
        'joint.pair.name == "revolute"',
        'joint.pair.symbol() in ("R", "P")',
        'dyad.form == "RRP"',
        '{"RR": 6, "PR": 4}[leg.form]',
        'pair.name in {"rolling", "roll_slide"}',
        '{"revolute": 2, "rolling": 2}[kind]',
        'joint.pair == pair("prismatic")',
        'kinds["prismatic"]',
        'direction[0] == "T"',
        'codes = {"R": 0, "P": 1}',
        'text.replace("R(", "D(")',
        'match joint.pair.name:\n    case "revolute":\n        pass',
    ],
)
def test_the_search_finds_each_way_to_ask(code):
    assert [*questions(ast.parse(code))]


@pytest.mark.parametrize("code", ['Chain([("revolute", ends)])', 'Joint(pair("prismatic"), links)', "joint.pair.rolls"])
def test_the_search_passes_what_makes_a_joint_and_what_asks_by_a_property(code):
    assert not [*questions(ast.parse(code))]


def names_in(space):
    return {pair.name for pair in PAIRS if space in pair.freedoms}


def test_every_pair_has_its_row_in_the_other_tables():
    assert {name for row in CONTACTS for name in row.pairs} == names_in(Space.PLANAR)
    assert set(SIGNS) == names_in(Space.PLANAR)
    assert set(DRAWINGS) == names_in(Space.SPATIAL)
    assert set(SOLIDS) == {pair.name for pair in PAIRS}
