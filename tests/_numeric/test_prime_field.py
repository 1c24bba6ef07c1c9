import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler._numeric.prime_field import (
    P,
    echelon,
    inverse,
    left_null_space,
    null_space,
    product,
    reduced,
    transposed,
)


@st.composite
def matrices(draw, largest=60):
    """Matrices of low rank, sparse or dense, so that both the head and the core of the elimination are met."""
    m, n = draw(st.integers(1, largest)), draw(st.integers(1, largest))
    rank = draw(st.integers(1, min(m, n)))
    share = draw(st.sampled_from([0.05, 0.3, 1.0]))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    left = random.integers(0, P, (m, rank)) * (random.random((m, rank)) < share)
    right = random.integers(0, P, (rank, n)) * (random.random((rank, n)) < share)
    return product(left, right)


def sparse(matrix):
    return [{k: int(v) for k, v in enumerate(row) if v} for row in matrix]


def plain_rank(matrix):
    rows = [[int(v) for v in row] for row in matrix]
    done = 0
    for column in range(matrix.shape[1]):
        pivot = next((i for i in range(done, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[done], rows[pivot] = rows[pivot], rows[done]
        scale = inverse(rows[done][column])
        for i in range(done + 1, len(rows)):
            factor = rows[i][column] * scale % P
            if factor:
                rows[i] = [(a - factor * b) % P for a, b in zip(rows[i], rows[done], strict=True)]
        done += 1
    return done


@given(matrices())
@settings(max_examples=60)
def test_rank_null_spaces_and_reduced_form(matrix):
    m, n = matrix.shape
    form = echelon(sparse(matrix), n)
    assert form.rank == plain_rank(matrix) == len(reduced(matrix))
    basis = null_space(form)
    assert basis.shape == (n - form.rank, n)
    assert not product(matrix, basis.T).any()
    assert len(reduced(basis)) == len(basis)
    turned = null_space(echelon(transposed(sparse(matrix), n), m))
    left = left_null_space(matrix)
    assert not product(left, matrix).any()
    assert np.array_equal(reduced(turned), reduced(left))


@given(st.integers(1, P - 1))
def test_inverse(a):
    assert a * inverse(a) % P == 1


@pytest.mark.parametrize("size", [1, 7, 300])
def test_product_against_python_integers(size):
    random = np.random.default_rng(size)
    a, b = random.integers(0, P, (3, size)), random.integers(0, P, (size, 2))
    want = [[sum(int(x) * int(y) for x, y in zip(row, column, strict=True)) % P for column in b.T] for row in a]
    assert product(a, b).tolist() == want
