"""Linear algebra modulo a prime in the core: against whole numbers of Python."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.structure.mobility.prime_field import modular_product
from tests.core.plain_elimination import P
from tests.core.plain_elimination import eliminate as plain
from tests.structure.mobility.test_prime_field import matrices, plain_rank, sparse

ANY = 1e18


def packed(rows):
    """Rows as dictionaries in the form of the core."""
    start = np.cumsum([0, *map(len, rows)])
    column = np.array([c for row in rows for c in row], np.int64)
    return start, column, np.array([v for row in rows for v in row.values()], np.int64)


def eliminate(core, rows, columns, most=ANY):
    return core.eliminate(*packed(rows), columns, most, ANY)


@settings(deadline=None)
@given(matrices())
def test_the_same_pivots_and_rows(core, matrix):
    rows, n = sparse(matrix), matrix.shape[1]
    pivots, reduced = plain(rows)
    done, _, _, pivot, start, column, value = eliminate(core, rows, n)
    assert done
    assert len(pivot) == plain_rank(matrix)
    assert pivot.tolist() == pivots
    for k, row in enumerate(reduced):
        part = slice(start[k], start[k + 1])
        assert (np.diff(column[part]) > 0).all()
        assert dict(zip(column[part].tolist(), value[part].tolist(), strict=True)) == row


@settings(deadline=None)
@given(matrices())
def test_solutions(core, matrix):
    """Whatever the free columns are, they stay, and the rows of the matrix vanish."""
    n = matrix.shape[1]
    _, _, _, *form = eliminate(core, sparse(matrix), n)
    free = sorted(set(range(n)) - set(form[0].tolist()))
    start = np.full((n, len(free) + 1), -7)
    start[free] = np.random.default_rng(n).integers(0, P, (len(free), len(free) + 1))
    solutions = core.solve_back(*form, start)
    assert (solutions[free] == start[free]).all()
    assert not modular_product(matrix, solutions).any()


@settings(deadline=None)
@given(matrices(20), st.integers(0, 3))
def test_reduced_rows(core, matrix, turns):
    """The reduced form is known by its shape, and spans what the matrix does."""
    reduced = core.reduce(matrix - turns * P)
    assert len(reduced) == plain_rank(matrix) == plain_rank(np.vstack([matrix, reduced]))
    firsts = [np.flatnonzero(row)[0] for row in reduced]
    assert (np.diff(firsts) > 0).all()
    assert (reduced[:, firsts] == np.eye(len(reduced))).all()


@pytest.mark.parametrize(("m", "n", "rank"), [(230, 250, 230), (260, 260, 131), (110, 300, 97)])
def test_a_large_core(core, m, n, rank):
    random = np.random.default_rng(m + n)
    left, right = random.integers(0, P, (m, rank)), random.integers(0, P, (rank, n))
    right[:, 3:110] *= random.random(right[:, 3:110].shape) < 0.02
    matrix = modular_product(left, right)
    rows = sparse(matrix)
    done, core_rows, core_columns, pivot, *_ = eliminate(core, rows, n)
    assert done
    assert core_rows <= m
    assert core_columns <= n
    assert len(pivot) == plain_rank(matrix)
    for most in ((1e5, ANY), (ANY, 1e3)):
        refused = core.eliminate(*packed(rows), n, *most)
        assert not refused[0]
        assert refused[1:3] == (core_rows, core_columns)


def test_numbers_of_any_size_are_residues(core):
    rows = [{0: 2**62, 1: -(2**63)}, {0: P, 1: 3}, {1: 2 * P}]
    done, _, _, pivot, start, column, value = eliminate(core, rows, 2)
    assert (done, pivot.tolist(), start.tolist()) == (True, [1, 0], [0, 0, 0])
    assert column.tolist() == value.tolist() == []


def test_the_inverse_of_every_kind_of_residue(core):
    for value in (1, 2, P - 1, P - 2, 2**30, 46341, 123_456_789):
        assert core.reduce(np.array([[value, 1]]))[0, 1] * value % P == 1


def test_wrong_calls(core):
    start, column, value = packed([{0: 1, 1: 2}, {1: 3}])
    for arguments in [
        (start.astype(np.int32), column, value),
        (start, column.astype(float), value),
        (start, column, value[None]),
        (None, column, value),
    ]:
        with pytest.raises(TypeError, match="incompatible function arguments"):
            core.eliminate(*arguments, 2, ANY, ANY)
    for arguments, words in [
        ((start + 1, column, value, 2), "start must ascend from 0"),
        ((start[:0], column, value, 2), "start must ascend from 0"),
        ((start[::-1].copy(), column, value, 2), "start must ascend from 0"),
        ((start, column, value[:2], 2), "value must have a number for each column"),
        ((start, column, value, 1), "a column that is none"),
        ((start, column - 1, value, 2), "a column that is none"),
        ((start, column * 0, value, 2), "row 0 has two entries in one column"),
        ((start, column, value, -1), "the number of columns is not negative"),
        ((start, column, value, 2**62), "the number of columns is not negative"),
    ]:
        with pytest.raises(ValueError, match=words):
            core.eliminate(*arguments, ANY, ANY)
    pivot, solutions = np.array([0, 1]), np.zeros((2, 1), np.int64)
    with pytest.raises(ValueError, match="start must have a number for each pivot"):
        core.solve_back(pivot[:1], start, column, value, solutions)
    with pytest.raises(ValueError, match="a pivot stands in a column that is none"):
        core.solve_back(pivot + 1, start, column, value, solutions)
    with pytest.raises(ValueError, match="a column that is none"):
        core.solve_back(pivot, start, column, value, solutions[:1])
    with pytest.raises(TypeError, match="incompatible function arguments"):
        core.reduce(np.zeros((2, 2)))


def test_nothing(core):
    none = np.zeros(0, np.int64)
    done, *sizes, pivot, start, column, value = core.eliminate(np.zeros(1, np.int64), none, none, 0, ANY, ANY)
    assert (done, sizes) == (True, [0, 0])
    assert [pivot.size, start.tolist(), column.size, value.size] == [0, [0], 0, 0]
    assert core.solve_back(pivot, start, column, value, np.zeros((0, 3), np.int64)).shape == (0, 3)
    assert core.reduce(np.zeros((0, 4), np.int64)).shape == (0, 4)
    assert core.reduce(np.zeros((4, 0), np.int64)).shape == (0, 0)
