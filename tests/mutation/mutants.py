"""What is changed in a source text: comparisons, `and`, `or`, plus, minus, constants with a name, return values."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from copy import copy
from typing import NamedTuple

_COMPARISONS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}


class Mutant(NamedTuple):
    """A source text with one change."""

    line: int
    before: str
    after: str
    text: str


def mutants(text: str) -> list[Mutant]:
    """Every change of a source text, in its order; what stands within f-strings is left alone."""
    found = []
    starts = [0]
    data = text.encode()
    for line in data.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    for node, other in _changes(ast.parse(text)):
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[(node.end_lineno or node.lineno) - 1] + (node.end_col_offset or 0)
        after = ast.unparse(other)
        new = data[:begin] + f"({after})".encode() + data[end:]
        found.append(Mutant(node.lineno, ast.unparse(node), after, new.decode()))
    return sorted(found)


def _changes(tree: ast.Module) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Expressions with what takes their place."""
    for node in tree.body:
        match node:
            case ast.Assign(value=ast.Constant(float() as number) as said):
                yield said, ast.Constant(number * 1024)
            case ast.Assign(value=ast.Constant(int() as number) as said):
                yield said, ast.Constant(number + 1)
    todo: list[ast.AST] = [tree]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.JoinedStr):
            continue
        todo += ast.iter_child_nodes(node)
        match node:
            case ast.Compare(ops=ops):
                for k, op in enumerate(ops):
                    other = copy(node)
                    other.ops = [*ops[:k], _COMPARISONS[type(op)](), *ops[k + 1 :]]
                    yield node, other
            case ast.BoolOp(op, values):
                yield node, ast.BoolOp(ast.Or() if isinstance(op, ast.And) else ast.And(), values)
            case ast.BinOp(left, ast.Add() | ast.Sub() as op, right):
                yield node, ast.BinOp(left, ast.Sub() if isinstance(op, ast.Add) else ast.Add(), right)
            case ast.Return(ast.Constant(bool() as value) as said):
                yield said, ast.Constant(not value)
            case ast.Return(ast.expr() as value) if not isinstance(value, ast.Constant):
                yield value, ast.Constant(None)
