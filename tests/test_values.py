"""Values of two classes are never equal, and every public value is equal to its copies.

The first half walks over all classes of the package; the second makes one value, and another one like it, of every
class of the front door and of what its functions return.
"""

import ast
import dataclasses
import importlib
import inspect
import itertools
import pkgutil
from collections.abc import Iterator
from pathlib import Path

import gruebler as gr
from gruebler.linkages import Circle, Line

SOURCE = Path(gr.__file__).parent

TUPLES = {
    "Branches": "arrays over the same rows, joined one by one",
    "GenevaMotion": "angle and its derivatives in order, taken by number",
    "LeverPose": "what draws a lever, unpacked where it is drawn",
    "SolvedRows": "the arrays that a kernel fills",
    "TableJoint": "a row of a table of another program",
    "TracedCurve": "the arrays that a kernel fills and takes again",
}
"""Public named tuples with more than four fields, and why each is a tuple by nature."""


def modules() -> Iterator[str]:
    for found in pkgutil.walk_packages([str(SOURCE)], "gruebler."):
        if not found.name.endswith("__main__"):
            yield found.name


def classes() -> list[type]:
    """Every class that the package defines, by module and name."""
    seen = {}
    for name in modules():
        module = importlib.import_module(name)
        for each in vars(module).values():
            if inspect.isclass(each) and each.__module__ == name:
                seen[each.__module__, each.__qualname__] = each
    return [seen[key] for key in sorted(seen)]


CLASSES = classes()
NAMED_TUPLES = [each for each in CLASSES if issubclass(each, tuple) and hasattr(each, "_fields")]


def kernel(each: type) -> bool:
    """Whether its room hands it to compiled kernels, which know tuples and no other records."""
    room = each.__module__
    return "._numeric" in room or room.endswith(("_kernels", "_memory"))


def members(node: ast.expr) -> Iterator[str]:
    """The names between the bars of a union."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        yield from members(node.left)
        yield from members(node.right)
    elif isinstance(node, ast.Name):
        yield node.id


def unions() -> Iterator[tuple[str, set[object]]]:
    """Every union of two or more things written anywhere in the package: the place and the members."""
    for name in modules():
        module = importlib.import_module(name)
        known = {key: each for key, each in vars(module).items() if inspect.isclass(each)}
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
                yield f"{name}:{node.lineno}", {known.get(each, each) for each in members(node)}


def test_no_member_of_a_union_is_a_named_tuple():
    """Two members with the same numbers in them would be equal."""
    found = list(unions())
    assert len(found) > 500
    wrong = {place: each for place, union in found for each in union if len(union) > 1 and each in NAMED_TUPLES}
    assert wrong == {}


def test_public_values_of_many_fields_are_no_tuples():
    """A named tuple of more than four fields is an argument of a kernel, private, or has its reason above."""
    wide = {
        each.__name__
        for each in NAMED_TUPLES
        if len(each._fields) > 4 and not kernel(each) and not each.__name__.startswith("_")
    }
    assert wide == set(TUPLES)


def filled(each: type) -> object:
    """A value of a dataclass with 0, 1, 2, ... in its fields, made without its constructor."""
    value = object.__new__(each)
    for number, field in enumerate(dataclasses.fields(each)):
        object.__setattr__(value, field.name, number)
    return value


def test_values_of_two_classes_are_never_equal():
    values = [filled(each) for each in CLASSES if dataclasses.is_dataclass(each) and each.__dataclass_params__.frozen]
    assert len(values) > 250
    equal = [
        (type(one).__name__, type(other).__name__)
        for one, other in itertools.combinations(values, 2)
        if one == other or other == one
    ]
    assert equal == []


def test_elements_of_a_joint_with_the_same_numbers():
    """What led to it: these two were equal and had one hash, so that one linkage moved with the plan of the other."""
    assert Line(0.0, 0.0, 1.0) != Circle(0.0, 0.0, 1.0)
    assert len({Line(0.0, 0.0, 1.0), Circle(0.0, 0.0, 1.0)}) == 2
    assert Line(0.0, 0.0, 1.0) == Line(0, 0, 1)
